//! The time that the rest of a plan takes: legs, stays, jumps, and the landing.

use std::collections::BTreeMap;
use std::time::Duration;

use super::way_home::return_s;
use super::{Plan, Vehicle, VehicleClass};
use crate::geo::{LatLon, wrap_180};
use crate::plan::effort::Pace;
use crate::plan::{HeightFrame, Item, command};

/// The maximum number of items that are followed: jumps can make a plan of any length.
const MOST_ITEMS: usize = 5000;
/// `DO_CHANGE_SPEED`: the kinds of speed over ground, as air speed and as ground speed.
const GROUND_SPEEDS: std::ops::RangeInclusive<f32> = 0.0..=1.0;
/// `DO_JUMP`: a number of repetitions that never ends.
const FOR_EVER: f32 = -1.0;
/// Legs shorter than this are ignored.
const SAME_PLACE_M: f64 = 1.0;
/// A vehicle closer to its place, or to the circle around it, than this has arrived.
const ARRIVED_M: f64 = 3.0;
/// A vehicle that sinks faster than this is landing.
const SINKING_M_S: f32 = 0.2;

/// A plan, and the vehicle that flies it.
pub(super) struct Route<'a> {
    vehicle: &'a Vehicle,
    plan: &'a Plan,
    is_copter: bool,
}

/// Where a vehicle is on its way; heights are above home.
#[derive(Clone, Copy)]
struct Waystate {
    place: LatLon,
    height_m: f64,
    speed_m_s: Option<f64>,
    motion: Motion,
}

/// How a vehicle comes to the start of a leg.
#[derive(Clone, Copy)]
enum Motion {
    /// In any direction: it is on the leg already.
    Unknown,
    Rest,
    /// In this direction, in degrees.
    Along(f64),
}

impl<'a> Route<'a> {
    pub fn of(vehicle: &'a Vehicle, plan: &'a Plan) -> Self {
        let class = vehicle.heartbeat.map(|heartbeat| heartbeat.class);
        Self {
            vehicle,
            plan,
            is_copter: class == Some(VehicleClass::Copter),
        }
    }

    fn item(&self, number: u16) -> Option<&'a Item> {
        self.plan.items.get(usize::from(number))
    }

    /// The place that the vehicle flies to with an item.
    pub fn goal(&self, number: u16) -> Option<LatLon> {
        let item = self.item(number)?;
        match item.command {
            command::RETURN_TO_LAUNCH => self.vehicle.home.map(|home| home.at_point),
            _ if item.is_waypoint() && !item.is_takeoff() => item.place(),
            _ => None,
        }
    }

    /// Whether the vehicle is where it stays for an item; items without a stay have no such place.
    pub fn is_there(&self, number: u16) -> Option<bool> {
        let item = self.item(number)?;
        let stay_s = self.stay_s(item, self.usual_m_s());
        if stay_s.is_some_and(|stay_s| stay_s <= 0.0) {
            return None;
        }
        let centre = item.place()?;
        let off_m = self.vehicle.global?.at_point.distance_m(centre) - circle_m(item);
        Some(off_m.abs() < ARRIVED_M)
    }

    /// The seconds until the next item begins, with the stay at this one's place.
    pub fn current_s(&self, number: u16) -> Option<f64> {
        let mut at = self.start(number)?;
        self.whole_s(self.item(number)?, &mut at, true)
    }

    /// The seconds until the end of the plan.
    pub fn end_s(&self, number: u16) -> Option<f64> {
        let mut at = self.start(number)?;
        let mut jumps: BTreeMap<u16, u16> = self.vehicle.plan_jumps.clone();
        let mut seconds = 0.0;
        let mut next = number;
        let mut is_current = true;
        for _ in 0..MOST_ITEMS {
            let Some(item) = self.item(next) else {
                return Some(seconds);
            };
            if command::is_jump(item.command) {
                next = self.jump(next, item, &mut jumps)?;
                continue;
            }
            if item.command == command::DO_CHANGE_SPEED {
                at.speed_m_s = changed_speed(item).or(at.speed_m_s);
            } else if command::is_navigation(item.command) {
                seconds += self.whole_s(item, &mut at, is_current)?;
                is_current = false;
                // Items after a landing begin when the vehicle is armed again.
                let lands = [command::RETURN_TO_LAUNCH, command::LAND, command::VTOL_LAND];
                if lands.contains(&item.command) {
                    return Some(seconds);
                }
            }
            next = next.checked_add(1)?;
        }
        None
    }

    /// The present state of the vehicle.
    fn start(&self, number: u16) -> Option<Waystate> {
        let global = self.vehicle.global?;
        let passed = self.plan.items.iter().take(usize::from(number)).rev();
        let planned = || {
            let mut changes = passed.filter(|item| item.command == command::DO_CHANGE_SPEED);
            changes.find_map(changed_speed)
        };
        let measured = self.vehicle.cruise.map(|speed| f64::from(speed.speed_m_s));
        let asked = || self.vehicle.asked_speeds.ground_m_s();
        Some(Waystate {
            place: global.at_point,
            height_m: global.altitude_m,
            speed_m_s: measured
                .or_else(planned)
                .or_else(asked)
                .or(self.usual_m_s()),
            motion: Motion::Unknown,
        })
    }

    /// The speed over ground before any has been measured; only that of copters is the same for most of them.
    fn usual_m_s(&self) -> Option<f64> {
        self.is_copter.then(|| Pace::default().speed_m_s)
    }

    /// The seconds to an item's end, with the stay there.
    fn whole_s(&self, item: &Item, at: &mut Waystate, is_current: bool) -> Option<f64> {
        let stay_s = self.stay_s(item, at.speed_m_s)?;
        let arrived = self.vehicle.plan.arrived.filter(|_| is_current);
        if stay_s > 0.0
            && let Some(passed_s) = arrived.and_then(|arrived| self.passed_s(arrived))
        {
            at.motion = Motion::Rest;
            return Some((stay_s - passed_s).max(0.0));
        }
        let way_s = self.way_s(item, at, is_current)?;
        if stay_s > 0.0 {
            at.motion = Motion::Rest;
        }
        Some(way_s + stay_s)
    }

    /// The seconds since a moment of the vehicle's clock.
    fn passed_s(&self, since: Duration) -> Option<f64> {
        let now = self.vehicle.clock()?;
        Some(now.saturating_sub(since).as_secs_f64())
    }

    /// The item after a jump; `None` for one that never ends or leads nowhere.
    fn jump(&self, number: u16, item: &Item, jumps: &mut BTreeMap<u16, u16>) -> Option<u16> {
        let times = item.params[1];
        if times <= FOR_EVER {
            return None;
        }
        let taken = jumps.entry(number).or_insert(0);
        if f32::from(*taken) >= times {
            return number.checked_add(1);
        }
        *taken += 1;
        let target = item.params[0];
        if item.command == command::DO_JUMP {
            return Some(target as u16).filter(|target| *target > 0);
        }
        let is_tag =
            |it: &Item| it.command == command::JUMP_TAG && it.params[0] as u16 == target as u16;
        let tagged = self.plan.items.iter().position(is_tag)?;
        u16::try_from(tagged).ok()
    }

    /// The seconds of the path to an item's end, which becomes the new state.
    fn way_s(&self, item: &Item, at: &mut Waystate, is_current: bool) -> Option<f64> {
        let height_m = self.height_m(item).unwrap_or(at.height_m);
        match item.command {
            command::TAKEOFF | command::VTOL_TAKEOFF => {
                let climb_s = self.vertical_s(height_m - at.height_m);
                at.height_m = height_m.max(at.height_m);
                at.motion = Motion::Rest;
                Some(climb_s)
            }
            command::DELAY => {
                at.motion = Motion::Rest;
                self.delay_s(item, is_current)
            }
            command::RETURN_TO_LAUNCH => self.return_s(at, is_current),
            command::LAND | command::VTOL_LAND => {
                let way_s = self.leg_s(at, item.place().unwrap_or(at.place), at.height_m)?;
                let landing_s = self
                    .is_copter
                    .then(|| Pace::default().landing(at.height_m.max(0.0)).time_s);
                Some(way_s + landing_s?)
            }
            command::LOITER_TURNS => {
                let centre = item.place().unwrap_or(at.place);
                let edge = edge(centre, circle_m(item), at.place);
                self.leg_s(at, edge, height_m)
            }
            flown_to if command::is_flown_to(flown_to) => {
                self.leg_s(at, item.place().unwrap_or(at.place), height_m)
            }
            // It ends at a command of a ground station or a script, or at an altitude.
            _ => None,
        }
    }

    /// The seconds of a straight leg to a place, which becomes the new state: horizontally at the current speed over
    /// ground, vertically no faster than the vehicle climbs and sinks.
    fn leg_s(&self, at: &mut Waystate, place: LatLon, height_m: f64) -> Option<f64> {
        let across_m = at.place.distance_m(place);
        let steep_s = self.vertical_s(height_m - at.height_m);
        let mut across_s = 0.0;
        if across_m >= SAME_PLACE_M {
            let speed_m_s = at.speed_m_s.filter(|speed| *speed > 0.0)?;
            let bearing_deg = at.place.bearing_deg(place);
            across_s = across_m / speed_m_s + self.corner_s(at.motion, bearing_deg, speed_m_s);
            at.motion = Motion::Along(bearing_deg);
        }
        (at.place, at.height_m) = (place, height_m);
        Some(across_s.max(steep_s))
    }

    /// The seconds lost by braking and accelerating at the start of a leg.
    fn corner_s(&self, motion: Motion, bearing_deg: f64, speed_m_s: f64) -> f64 {
        if !self.is_copter {
            return 0.0;
        }
        let pace = Pace {
            speed_m_s,
            ..Pace::default()
        };
        match motion {
            Motion::Unknown => 0.0,
            Motion::Rest => pace.start_s(),
            Motion::Along(before_deg) => pace.corner_s(wrap_180(bearing_deg - before_deg)),
        }
    }

    /// Only copters have rates that are the same for most of them.
    fn vertical_s(&self, climb_m: f64) -> f64 {
        if self.is_copter {
            Pace::default().rise(climb_m).time_s
        } else {
            0.0
        }
    }

    fn return_s(&self, at: &Waystate, is_current: bool) -> Option<f64> {
        let home = self.vehicle.home.filter(|_| self.is_copter)?;
        if is_current && at.place.distance_m(home.at_point) < ARRIVED_M {
            let (pace, height_m) = (Pace::default(), at.height_m.max(0.0));
            let down_m_s = self.vehicle.global.map_or(0.0, |global| global.down_m_s);
            // A vehicle that rises is at the beginning of its return.
            if down_m_s > SINKING_M_S {
                return Some(pace.touchdown(height_m).time_s);
            } else if down_m_s >= -SINKING_M_S {
                return Some(pace.above_home(height_m).time_s);
            }
        }
        let wind = self.vehicle.wind;
        Some(return_s(at.place, home.at_point, at.height_m, wind))
    }

    /// The seconds of a stay at an item's place; `None` for one without a known end.
    fn stay_s(&self, item: &Item, speed_m_s: Option<f64>) -> Option<f64> {
        let first = f64::from(item.params[0]).max(0.0);
        match item.command {
            command::WAYPOINT | command::SPLINE_WAYPOINT | command::LOITER_TIME => Some(first),
            command::LOITER_TURNS => {
                let radius_m = circle_m(item);
                let speed_m_s = speed_m_s?;
                if self.is_copter {
                    let pace = Pace {
                        speed_m_s,
                        ..Pace::default()
                    };
                    return Some(pace.circle_s(first, radius_m));
                }
                let is_known = radius_m > 0.0;
                is_known.then(|| first * std::f64::consts::TAU * radius_m / speed_m_s)
            }
            command::LOITER_UNLIMITED | command::PAYLOAD_PLACE => None,
            _ => Some(0.0),
        }
    }

    /// The seconds of a `NAV_DELAY`, less those that have passed; `None` if it waits for a time of day.
    fn delay_s(&self, item: &Item, is_current: bool) -> Option<f64> {
        let whole_s = f64::from(item.params[0]);
        let since = self.vehicle.plan.since.filter(|_| is_current);
        let passed_s = since.and_then(|since| self.passed_s(since));
        (whole_s > 0.0).then(|| (whole_s - passed_s.unwrap_or(0.0)).max(0.0))
    }

    /// An item's height above home.
    fn height_m(&self, item: &Item) -> Option<f64> {
        let height_m = f64::from(item.altitude_m()?);
        match item.height_frame() {
            // Where the ground is not known, it counts as level.
            HeightFrame::Home | HeightFrame::Terrain => Some(height_m),
            HeightFrame::SeaLevel => {
                let global = self.vehicle.global?;
                Some(height_m - (global.altitude_amsl_m - global.altitude_m))
            }
            HeightFrame::Other => None,
        }
    }
}

/// The new speed over ground, if the item changes that.
fn changed_speed(item: &Item) -> Option<f64> {
    let [kind, speed_m_s, ..] = item.params;
    let is_ground = GROUND_SPEEDS.contains(&kind) && speed_m_s > 0.0;
    is_ground.then(|| f64::from(speed_m_s))
}

/// The radius of an item's circle, in metres; 0 for other items.
fn circle_m(item: &Item) -> f64 {
    match item.command {
        command::LOITER_TURNS => f64::from(item.params[2]).abs(),
        _ => 0.0,
    }
}

/// The point of a circle that is nearest to a place.
fn edge(centre: LatLon, radius_m: f64, from: LatLon) -> LatLon {
    let (north_m, east_m) = centre.offset_to(from);
    let off_m = centre.distance_m(from);
    if off_m > 0.0 {
        let share = radius_m / off_m;
        centre.moved(north_m * share, east_m * share)
    } else {
        centre.moved(radius_m, 0.0)
    }
}
