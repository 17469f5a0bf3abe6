//! The plans that a mission puts on board before the flight: sound plans, and plans with a fault
//! that the seed selects.

use std::sync::Arc;

use rand::seq::SliceRandom as _;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use super::zone::{Zone, ZoneKind};
use super::{Mission, Point};
use crate::geo::maths;
use crate::plan::{Document, Home, Item, command, frame};
use crate::session::Want;
use crate::text;
use crate::text::Text;

/// The random stream of faults; sensors, hazards, zones and events use others.
const STREAM: u64 = 1 << 39;
/// How far a displaced place lies beyond its proper one, in metres.
const ASTRAY_M: f64 = 400.0;
/// The duration of a hold that drains any battery, in seconds.
const LONG_STAY_S: f32 = 3000.0;
/// The fence of heights and the fence of areas, as bits of `FENCE_TYPE`.
const HEIGHTS_AND_AREAS: f64 = 5.0;

/// The plans and the fence on board at the start of a mission.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct BoardSetup {
    /// Whether the fences of the mission are loaded into the vehicles and switched on.
    pub has_fence: bool,
    /// The sound plan of each vehicle, in the order of the pads; empty if the mission has no plans.
    pub routes: Vec<Route>,
    /// The number of plans with a fault.
    pub faulty: usize,
    /// The faults to choose from, at least as many as there are faulty plans.
    pub faults: Vec<PlanFault>,
}

/// The sound plan of one vehicle: takeoff, these places, return.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Route {
    /// The height above home, in metres.
    pub up_m: f64,
    pub points: Vec<Point>,
}

/// A fault in a plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PlanFault {
    /// The height of a place is measured from sea level.
    SeaLevel,
    /// A place lies far beyond its proper one.
    Outside,
    /// A jump repeats the plan without end.
    Endless,
    /// A hold at a place drains the battery.
    Stay,
    /// The plan is that of another vehicle.
    Copied,
    /// Two places are left out.
    Gap,
    /// The plan ends in the air.
    NoReturn,
}

impl PlanFault {
    /// All faults by their names in files.
    pub const ALL: [(&str, Self); 7] = [
        ("sea_level", Self::SeaLevel),
        ("outside", Self::Outside),
        ("endless", Self::Endless),
        ("stay", Self::Stay),
        ("copied", Self::Copied),
        ("gap", Self::Gap),
        ("no_return", Self::NoReturn),
    ];

    /// The fault's description after the flight.
    pub fn title(self) -> Text {
        match self {
            Self::SeaLevel => text!("plan-fault-sea-level"),
            Self::Outside => text!("plan-fault-outside"),
            Self::Endless => text!("plan-fault-endless"),
            Self::Stay => text!("plan-fault-stay"),
            Self::Copied => text!("plan-fault-copied"),
            Self::Gap => text!("plan-fault-gap"),
            Self::NoReturn => text!("plan-fault-no-return"),
        }
    }
}

impl BoardSetup {
    /// The fault of each vehicle's plan, in the order of the pads; `None` for a sound one, empty without plans.
    pub fn drawn(&self, seed: u64) -> Vec<Option<PlanFault>> {
        let mut random = random(seed);
        let mut vehicles: Vec<usize> = (0..self.routes.len()).collect();
        vehicles.shuffle(&mut random);
        let mut faults = self.faults.clone();
        faults.shuffle(&mut random);
        let mut drawn = vec![None; self.routes.len()];
        for (vehicle, fault) in vehicles.into_iter().zip(faults).take(self.faulty) {
            drawn[vehicle] = Some(fault);
        }
        drawn
    }
}

/// The random stream of the faults' order. Each vehicle's fault draws its details with a seed of its own.
fn random(seed: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(STREAM);
    random
}

impl Mission {
    /// The demands on a seat's vehicle before the flight: its lists, and the fence switched on.
    pub(crate) fn board_wants(&self, seat: usize, seed: u64) -> Vec<Want> {
        let mut wants = Vec::new();
        let document = self.board_document(seat, seed);
        if self.board.has_fence {
            let ceilings = self.fences().filter_map(|zone| zone.kind.fence_ceiling_m());
            let ceiling_m = ceilings.fold(self.rules.max_height_m, f64::min);
            let settings = [
                ("FENCE_TYPE", HEIGHTS_AND_AREAS),
                ("FENCE_ALT_MAX", ceiling_m),
                ("FENCE_ENABLE", 1.0),
            ];
            wants.extend(settings.map(|(name, value)| Want::Parameter { name, value }));
        }
        if document != Document::default() {
            wants.push(Want::Lists(Arc::new(document)));
        }
        wants
    }

    /// The lists on board a vehicle at the start.
    pub(crate) fn board_document(&self, seat: usize, seed: u64) -> Document {
        let fence = self.fences().filter(|_| self.board.has_fence);
        let mut document = Document {
            fence: fence.flat_map(|zone| self.fence_items(zone)).collect(),
            ..Document::default()
        };
        if let (Some(route), Some(&pad)) = (self.board.routes.get(seat), self.seats.pads.get(seat))
        {
            let fault = self.board.drawn(seed).get(seat).copied().flatten();
            let (x, y) = self.site.origin.place(pad).to_e7();
            document.home = Some(Home {
                x,
                y,
                z: self.site.origin.altitude_amsl_m as f32,
            });
            document.plan = match fault {
                None => self.sound_plan(pad, route),
                Some(fault) => self.faulty_plan(seat, fault, seed),
            };
        }
        document
    }

    /// The zones that vehicles must not leave.
    pub(super) fn fences(&self) -> impl Iterator<Item = &Zone> {
        let zones = self.site.zones.iter();
        zones.filter(|zone| matches!(zone.kind, ZoneKind::Geofence { .. }))
    }

    fn fence_items(&self, zone: &Zone) -> Vec<Item> {
        let corners = zone.shape.corners();
        let count = corners.len() as f32;
        let corner = |&at: &Point| Item {
            params: [count, 0.0, 0.0, 0.0],
            ..self.item(command::FENCE_POLYGON_INCLUSION, at, 0.0)
        };
        corners.iter().map(corner).collect()
    }

    fn item(&self, command: u16, at: Point, up_m: f64) -> Item {
        let (x, y) = self.site.origin.place(at).to_e7();
        Item {
            command,
            frame: frame::ABOVE_HOME,
            auto_continue: true,
            params: [0.0; 4],
            x,
            y,
            z: up_m as f32,
        }
    }

    /// Takeoff, the places, return.
    fn sound_plan(&self, pad: Point, route: &Route) -> Vec<Item> {
        let waypoint = |&at: &Point| self.item(command::WAYPOINT, at, route.up_m);
        let takeoff = self.item(command::TAKEOFF, pad, route.up_m);
        let back = Item {
            command: command::RETURN_TO_LAUNCH,
            frame: frame::ABOVE_HOME,
            auto_continue: true,
            ..Item::default()
        };
        let places = route.points.iter().map(waypoint);
        [takeoff].into_iter().chain(places).chain([back]).collect()
    }

    /// The plan of a vehicle with a fault. Item 0 is the takeoff; places follow.
    fn faulty_plan(&self, seat: usize, fault: PlanFault, seed: u64) -> Vec<Item> {
        let mut random = random(seed.wrapping_add(1 + seat as u64));
        let (pad, route) = (self.seats.pads[seat], &self.board.routes[seat]);
        let mut plan = self.sound_plan(pad, route);
        // A place in the middle: neither the first nor the last.
        let last = route.points.len().saturating_sub(1).max(2);
        let middle = random.random_range(1..last);
        match fault {
            PlanFault::SeaLevel => plan[middle + 1].frame = frame::SEA_LEVEL,
            PlanFault::Outside => {
                let at = route.points[middle];
                let [east, north] = [at[0] - pad[0], at[1] - pad[1]];
                let away = 1.0 + ASTRAY_M / maths::hypot(east, north).max(1.0);
                let astray = [pad[0] + east * away, pad[1] + north * away];
                plan[middle + 1] = self.item(command::WAYPOINT, astray, route.up_m);
            }
            PlanFault::Endless => {
                let jump = Item {
                    command: command::DO_JUMP,
                    auto_continue: true,
                    // Back to the first place, which is item 2 counted from home, without end.
                    params: [2.0, -1.0, 0.0, 0.0],
                    ..Item::default()
                };
                plan.insert(plan.len() - 1, jump);
            }
            PlanFault::Stay => plan[middle + 1].params[0] = LONG_STAY_S,
            PlanFault::Copied => {
                let others = self.board.routes.len();
                let other = (seat + random.random_range(1..others.max(2))) % others;
                plan = self.sound_plan(self.seats.pads[other], &self.board.routes[other]);
            }
            PlanFault::Gap => {
                // Removes the end of one leg and the beginning of the next one, which leads back,
                // so that two lanes are missing.
                let pairs = last / 2;
                let first = 2 * random.random_range(0..pairs.max(1)) + 1;
                plan.drain(first + 1..first + 3);
            }
            PlanFault::NoReturn => {
                plan.pop();
            }
        }
        plan
    }
}

#[cfg(test)]
mod tests;
