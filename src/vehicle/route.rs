//! The time that the rest of a plan takes: legs, stays, jumps, and the landing.

use std::collections::BTreeMap;
use std::time::Duration;

use super::way_home::return_s;
use super::{Plan, Vehicle, VehicleClass};
use crate::geo::LatLon;
use crate::plan::effort::Pace;
use crate::plan::legs::{LegMotion, LegPace, LegStart, changed_speed_m_s, circle_m};
use crate::plan::{HeightFrame, Item, command};

/// The maximum number of items that are followed: jumps can make a plan of any length.
const MOST_ITEMS: usize = 5000;
/// The number of repetitions of a `DO_JUMP` that never ends.
const FOR_EVER: f32 = -1.0;
/// A vehicle closer than this to its place, or to the circle around it, has arrived.
const ARRIVED_M: f64 = 3.0;
/// A vehicle that sinks faster than this is landing.
const SINKING_M_S: f32 = 0.2;

/// A plan, and the vehicle that flies it.
pub(super) struct Route<'a> {
    vehicle: &'a Vehicle,
    plan: &'a Plan,
    is_copter: bool,
}

/// A vehicle's position on its way, and its speed over ground, if known.
#[derive(Clone, Copy)]
struct Waystate {
    at: LegStart,
    speed_m_s: Option<f64>,
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

    /// The place to which an item takes the vehicle; `None` for an item without a place, such as a
    /// takeoff.
    pub fn goal(&self, number: u16) -> Option<LatLon> {
        let item = self.item(number)?;
        match item.command {
            command::RETURN_TO_LAUNCH => self.vehicle.home.map(|home| home.at_point),
            _ if item.is_waypoint() && !item.is_takeoff() => item.place(),
            _ => None,
        }
    }

    /// Whether the vehicle is at the place where it stays for an item; `None` for an item without a
    /// stay.
    pub fn is_there(&self, number: u16) -> Option<bool> {
        let item = self.item(number)?;
        let stay_s = self.pace(self.usual_m_s()).stay_s(item);
        if stay_s.is_some_and(|stay_s| stay_s <= 0.0) {
            return None;
        }
        let centre = item.place()?;
        let off_m = self.vehicle.global?.at_point.distance_m(centre) - circle_m(item);
        Some(off_m.abs() < ARRIVED_M)
    }

    /// The seconds until the next item begins, including the stay at the current place; `None` if
    /// they cannot be estimated.
    pub fn current_s(&self, number: u16) -> Option<f64> {
        let mut way = self.start(number)?;
        self.whole_s(self.item(number)?, &mut way, true)
    }

    /// The seconds until the end of the plan; `None` if they cannot be estimated, or the plan has
    /// no end.
    pub fn end_s(&self, number: u16) -> Option<f64> {
        let mut way = self.start(number)?;
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
                way.speed_m_s = changed_speed_m_s(item).or(way.speed_m_s);
            } else if command::is_navigation(item.command) {
                seconds += self.whole_s(item, &mut way, is_current)?;
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

    /// The current position and speed of the vehicle.
    fn start(&self, number: u16) -> Option<Waystate> {
        let global = self.vehicle.global?;
        let mut passed = self.plan.items.iter().take(usize::from(number)).rev();
        let planned = || passed.find_map(changed_speed_m_s);
        let measured = self.vehicle.cruise.map(|speed| f64::from(speed.speed_m_s));
        let asked = || self.vehicle.asked_speeds.ground_m_s();
        Some(Waystate {
            at: LegStart {
                place: global.at_point,
                height_m: global.altitude_m,
                motion: LegMotion::Unknown,
            },
            speed_m_s: measured
                .or_else(planned)
                .or_else(asked)
                .or(self.usual_m_s()),
        })
    }

    /// The speed over ground before any has been measured; only for copters, most of which have the
    /// same default.
    fn usual_m_s(&self) -> Option<f64> {
        self.is_copter.then(|| Pace::default().speed_m_s)
    }

    /// The seconds until the end of an item, including the stay there.
    fn whole_s(&self, item: &Item, way: &mut Waystate, is_current: bool) -> Option<f64> {
        let stay_s = self.pace(way.speed_m_s).stay_s(item)?;
        let arrived = self.vehicle.plan.arrived.filter(|_| is_current);
        if stay_s > 0.0
            && let Some(passed_s) = arrived.and_then(|arrived| self.passed_s(arrived))
        {
            way.at.motion = LegMotion::Rest;
            return Some((stay_s - passed_s).max(0.0));
        }
        let way_s = self.way_s(item, way, is_current)?;
        if stay_s > 0.0 {
            way.at.motion = LegMotion::Rest;
        }
        Some(way_s + stay_s)
    }

    /// The seconds since a time of the vehicle's clock.
    fn passed_s(&self, since: Duration) -> Option<f64> {
        let now = self.vehicle.clock()?;
        Some(now.saturating_sub(since).as_secs_f64())
    }

    /// The item after a jump; `None` for a jump that never ends or leads nowhere.
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

    /// The seconds of the path to an item's end; `way` is set to the state there.
    fn way_s(&self, item: &Item, way: &mut Waystate, is_current: bool) -> Option<f64> {
        let height_m = self.height_m(item).unwrap_or(way.at.height_m);
        match item.command {
            command::TAKEOFF | command::VTOL_TAKEOFF => {
                let climb_s = self.pace(way.speed_m_s).rise_s(height_m - way.at.height_m);
                way.at.height_m = height_m.max(way.at.height_m);
                way.at.motion = LegMotion::Rest;
                Some(climb_s)
            }
            command::DELAY => {
                way.at.motion = LegMotion::Rest;
                self.delay_s(item, is_current)
            }
            command::RETURN_TO_LAUNCH => self.return_s(way, is_current),
            command::LAND | command::VTOL_LAND => {
                let way_s =
                    self.leg_s(way, item.place().unwrap_or(way.at.place), way.at.height_m)?;
                Some(way_s + self.touchdown_s(item, way.at.height_m)?)
            }
            command::LOITER_TURNS => {
                let centre = item.place().unwrap_or(way.at.place);
                let edge = edge(centre, circle_m(item), way.at.place);
                self.leg_s(way, edge, height_m)
            }
            flown_to if command::is_flown_to(flown_to) => {
                self.leg_s(way, item.place().unwrap_or(way.at.place), height_m)
            }
            // Such an item ends at a command of a ground station or a script, or at an altitude.
            _ => None,
        }
    }

    /// The seconds of a landing at the place; `None` for vehicles whose descent is unknown. A plane touches down at the
    /// end of the leg.
    fn touchdown_s(&self, item: &Item, height_m: f64) -> Option<f64> {
        let class = self.vehicle.class();
        if class == VehicleClass::Plane && item.command == command::LAND {
            return Some(0.0);
        }
        let landing = || Pace::default().landing(height_m.max(0.0));
        self.is_copter.then(|| landing().time_s)
    }

    /// The seconds of a straight leg; moves `way` to its end.
    fn leg_s(&self, way: &mut Waystate, place: LatLon, height_m: f64) -> Option<f64> {
        way.at.fly(place, height_m, self.pace(way.speed_m_s))
    }

    /// The pace at a speed over ground: that of a copter, or only the speed.
    fn pace(&self, speed_m_s: Option<f64>) -> LegPace {
        match speed_m_s {
            Some(speed_m_s) if self.is_copter => LegPace::Copter(Pace {
                speed_m_s,
                ..Pace::default()
            }),
            _ => LegPace::Other(speed_m_s),
        }
    }

    fn return_s(&self, way: &Waystate, is_current: bool) -> Option<f64> {
        let home = self.vehicle.home.filter(|_| self.is_copter)?;
        if is_current && way.at.place.distance_m(home.at_point) < ARRIVED_M {
            let (pace, height_m) = (Pace::default(), way.at.height_m.max(0.0));
            let down_m_s = self.vehicle.global.map_or(0.0, |global| global.down_m_s);
            // A vehicle that rises is at the beginning of its return.
            if down_m_s > SINKING_M_S {
                return Some(pace.touchdown(height_m).time_s);
            } else if down_m_s >= -SINKING_M_S {
                return Some(pace.above_home(height_m).time_s);
            }
        }
        let wind = self.vehicle.wind;
        Some(return_s(way.at.place, home.at_point, way.at.height_m, wind))
    }

    /// The seconds of a `NAV_DELAY`, less those that have passed; `None` if it waits for a time of day.
    fn delay_s(&self, item: &Item, is_current: bool) -> Option<f64> {
        let whole_s = f64::from(item.params[0]);
        let since = self.vehicle.plan.since.filter(|_| is_current);
        let passed_s = since.and_then(|since| self.passed_s(since));
        (whole_s > 0.0).then(|| (whole_s - passed_s.unwrap_or(0.0)).max(0.0))
    }

    /// An item's height above home, in metres; `None` if it has none, or its reference is unknown.
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
