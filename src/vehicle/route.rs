//! The time that the rest of a plan takes: legs, stays, jumps, and the landing.

use std::collections::BTreeMap;

use super::way_home;
use super::{Plan, Vehicle, VehicleClass};
use crate::geo::{LatLon, maths, wrap_180};
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

    /// The seconds until the current item is done, without a stay at its place.
    pub fn current_s(&self, number: u16) -> Option<f64> {
        let mut at = self.start(number)?;
        self.way_s(self.item(number)?, &mut at, true)
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
                seconds += self.way_s(item, &mut at, is_current)?;
                is_current = false;
                let stay_s = stay_s(item, at.speed_m_s)?;
                if stay_s > 0.0 {
                    at.motion = Motion::Rest;
                }
                seconds += stay_s;
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
            speed_m_s: measured.or_else(planned).or_else(asked),
            motion: Motion::Unknown,
        })
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

    /// The seconds of the way to an item's end, which becomes the new state.
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
            command::RETURN_TO_LAUNCH => self.return_s(at),
            command::LAND | command::VTOL_LAND => {
                let way_s = self.leg_s(at, item.place().unwrap_or(at.place), at.height_m)?;
                let landing_s = self.is_copter.then(|| way_home::landing_s(at.height_m));
                Some(way_s + landing_s?)
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

    /// The seconds lost by braking and gathering speed at the start of a leg: a copter comes nearly to rest at a right
    /// angle, and hardly slows down where the way goes nearly straight on.
    fn corner_s(&self, motion: Motion, bearing_deg: f64, speed_m_s: f64) -> f64 {
        let share = match motion {
            Motion::Unknown => 0.0,
            Motion::Rest => 1.0,
            Motion::Along(before_deg) => {
                let turn = wrap_180(bearing_deg - before_deg).to_radians();
                (1.0 - maths::cos(turn)).min(1.0)
            }
        };
        if !self.is_copter {
            return 0.0;
        }
        let pace = Pace::default();
        share * (speed_m_s / pace.accel_m_s2 + pace.accel_m_s2 / pace.jerk_m_s3)
    }

    /// Only copters have rates that are the same for most of them.
    fn vertical_s(&self, climb_m: f64) -> f64 {
        if self.is_copter {
            Pace::default().rise(climb_m).time_s
        } else {
            0.0
        }
    }

    fn return_s(&self, at: &Waystate) -> Option<f64> {
        let home = self.vehicle.home.filter(|_| self.is_copter)?;
        let wind = self.vehicle.wind;
        Some(way_home::return_s(
            at.place,
            home.at_point,
            at.height_m,
            wind,
        ))
    }

    /// The seconds of a `NAV_DELAY`, less those that have passed; `None` if it waits for a time of day.
    fn delay_s(&self, item: &Item, is_current: bool) -> Option<f64> {
        let whole_s = f64::from(item.params[0]);
        let passed_s = match (self.vehicle.plan.since, self.vehicle.link.last_heard) {
            (Some(since), Some(now)) if is_current => now.saturating_sub(since).as_secs_f64(),
            _ => 0.0,
        };
        (whole_s > 0.0).then(|| (whole_s - passed_s).max(0.0))
    }

    /// An item's height above home.
    fn height_m(&self, item: &Item) -> Option<f64> {
        let height_m = f64::from(item.altitude_m()?);
        match item.height_frame() {
            HeightFrame::Home => Some(height_m),
            HeightFrame::SeaLevel => {
                let global = self.vehicle.global?;
                Some(height_m - (global.altitude_amsl_m - global.altitude_m))
            }
            HeightFrame::Terrain | HeightFrame::Other => None,
        }
    }
}

/// The new speed over ground, if the item changes that.
fn changed_speed(item: &Item) -> Option<f64> {
    let [kind, speed_m_s, ..] = item.params;
    let is_ground = GROUND_SPEEDS.contains(&kind) && speed_m_s > 0.0;
    is_ground.then(|| f64::from(speed_m_s))
}

/// The seconds of a stay at an item's place; `None` for one without a known end.
fn stay_s(item: &Item, speed_m_s: Option<f64>) -> Option<f64> {
    let first = f64::from(item.params[0]).max(0.0);
    match item.command {
        command::WAYPOINT | command::SPLINE_WAYPOINT | command::LOITER_TIME => Some(first),
        command::LOITER_TURNS => {
            let radius_m = f64::from(item.params[2]).abs();
            let speed_m_s = speed_m_s.filter(|_| radius_m > 0.0)?;
            Some(first * std::f64::consts::TAU * radius_m / speed_m_s)
        }
        command::LOITER_UNLIMITED | command::PAYLOAD_PLACE => None,
        _ => Some(0.0),
    }
}
