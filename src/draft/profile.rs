//! The profile of a plan: the legs with their lengths, times and slopes, and the heights along them.

use super::place::place;
use crate::geo::{LatLon, Terrain, wrap_180};
use crate::plan::effort::Pace;
use crate::plan::{Document, HeightFrame, Item, command};

/// Legs shorter than this have no direction, in metres.
const SAME_PLACE_M: f64 = 1.0;
/// A wait before the next item to fly to.
const CONDITION_DELAY: u16 = 112;

/// An item that the vehicle flies to, and the leg that leads there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// The item, counted from 0.
    pub item: usize,
    pub place: LatLon,
    /// Metres above home, on arrival. Heights above terrain count as if unknown ground were level.
    pub height_m: f64,
    /// The length of the leg over the ground, in metres.
    pub leg_m: f64,
    /// How much higher its end is than its start, in metres.
    pub climb_m: f64,
    /// The seconds that the leg takes, with the stay at its end.
    pub leg_s: f64,
    /// The length of all legs so far, in metres.
    pub along_m: f64,
    /// Whether the vehicle lands there.
    pub lands: bool,
}

impl Stop {
    /// The slope of its leg in percent; `None` for a leg straight up or down.
    pub fn slope_percent(&self) -> Option<f64> {
        (self.leg_m >= 1.0).then(|| self.climb_m / self.leg_m * 100.0)
    }
}

/// The course of a plan, without the repetitions of its jumps.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Profile {
    /// The place where the path begins.
    pub start: Option<LatLon>,
    pub stops: Vec<Stop>,
    pub length_m: f64,
    pub time_s: f64,
    /// Whether jumps repeat parts of it; length and time leave these out.
    pub repeats: bool,
}

impl Profile {
    /// The place at a distance along the path.
    pub fn place_at(&self, along_m: f64) -> Option<LatLon> {
        let to = self.stops.iter().position(|stop| stop.along_m >= along_m)?;
        let end = self.stops[to];
        let start = to.checked_sub(1).map(|at| self.stops[at].place);
        let from = start.or(self.start).unwrap_or(end.place);
        let (north_m, east_m) = from.offset_to(end.place);
        let share = if end.leg_m > 0.0 {
            1.0 - (end.along_m - along_m) / end.leg_m
        } else {
            1.0
        };
        Some(from.moved(north_m * share, east_m * share))
    }

    /// The stop of an item.
    pub fn at(&self, item: usize) -> Option<&Stop> {
        self.stops.iter().find(|stop| stop.item == item)
    }
}

/// The height of an item above home; `None` if that needs the height of home and it is not known. Where the ground is
/// not known, it counts as level.
pub fn height_above_home(document: &Document, item: &Item, ground: &Terrain) -> Option<f64> {
    match item.height_frame() {
        HeightFrame::SeaLevel => Some(f64::from(item.z - document.home?.z)),
        HeightFrame::Terrain => {
            let below_m = ground_above_home(document, place(item)?, ground).unwrap_or(0.0);
            Some(f64::from(item.z) + below_m)
        }
        HeightFrame::Home | HeightFrame::Other => Some(f64::from(item.z)),
    }
}

/// The height of the ground at a place above the ground at home, in metres; `None` if either is not known.
pub fn ground_above_home(document: &Document, at: LatLon, ground: &Terrain) -> Option<f64> {
    let home = document.home?;
    let home_m = ground.height_m(LatLon::from_e7(home.x, home.y))?;
    Some(ground.height_m(at)? - home_m)
}

struct Course<'a> {
    ground: &'a Terrain,
    at: Option<LatLon>,
    height_m: f64,
    /// The direction in which the vehicle arrives, in degrees; `None` at rest.
    along_deg: Option<f64>,
    pace: Pace,
    profile: Profile,
}

/// The course of a document's plan over a ground.
pub fn profile(document: &Document, pace: Pace, ground: &Terrain) -> Profile {
    let home = document.home.map(|home| LatLon::from_e7(home.x, home.y));
    let mut course = Course {
        at: home,
        height_m: 0.0,
        along_deg: None,
        pace,
        profile: Profile {
            start: home,
            ..Profile::default()
        },
        ground,
    };
    for (index, item) in document.plan.iter().enumerate() {
        match item.command {
            command::DO_CHANGE_SPEED if item.params[1] > 0.0 => {
                course.pace.speed_m_s = f64::from(item.params[1]);
            }
            command::DO_JUMP | command::DO_JUMP_TAG => course.profile.repeats = true,
            command::DELAY | CONDITION_DELAY => {
                course.profile.time_s += f64::from(item.params[0].max(0.0));
                // Only a delay is a stop; a condition holds back the next action.
                if item.command == command::DELAY {
                    course.along_deg = None;
                }
            }
            command::RETURN_TO_LAUNCH => course.go_home(index, home),
            flown if command::is_flown_to(flown) => course.fly(document, index, item),
            _ => {}
        }
    }
    course.profile
}

impl Course<'_> {
    fn fly(&mut self, document: &Document, index: usize, item: &Item) {
        let lands = matches!(
            item.command,
            command::LAND | command::VTOL_LAND | command::PAYLOAD_PLACE
        );
        let has_place = (item.x, item.y) != (0, 0) && !command::is_takeoff(item.command);
        let goal = has_place.then(|| item.point()).or(self.at);
        let height_m = if lands {
            self.height_m
        } else {
            height_above_home(document, item, self.ground).unwrap_or(self.height_m)
        };
        let stay_s = self.stay_s(item);
        self.go(index, goal, height_m, stay_s);
        if stay_s > 0.0 || command::is_takeoff(item.command) {
            self.along_deg = None;
        }
        if lands {
            let height_m = std::mem::take(&mut self.height_m);
            self.land(self.pace.landing(height_m.max(0.0)).time_s);
        }
    }

    /// The seconds that the vehicle stays at an item.
    fn stay_s(&self, item: &Item) -> f64 {
        let [first, _, third, _] = item.params.map(f64::from);
        match item.command {
            command::WAYPOINT | command::SPLINE_WAYPOINT | command::LOITER_TIME => first.max(0.0),
            command::LOITER_TURNS => self.pace.circle_s(first, third),
            _ => 0.0,
        }
    }

    fn go(&mut self, item: usize, place: Option<LatLon>, height_m: f64, stay_s: f64) {
        let Some(place) = place else {
            return;
        };
        let leg_m = self.at.map_or(0.0, |from| from.distance_m(place));
        let climb_m = height_m - self.height_m;
        let across_s = self.across_s(place, leg_m);
        let leg_s = across_s.max(self.pace.rise(climb_m).time_s) + stay_s;
        self.stop(Stop {
            item,
            place,
            height_m,
            leg_m,
            climb_m,
            leg_s,
            along_m: self.profile.length_m + leg_m,
            lands: false,
        });
    }

    /// The seconds of a level leg, with the corner before it.
    fn across_s(&mut self, place: LatLon, leg_m: f64) -> f64 {
        let Some(from) = self.at.filter(|_| leg_m >= SAME_PLACE_M) else {
            return 0.0;
        };
        let bearing_deg = from.bearing_deg(place);
        let before = self.along_deg.replace(bearing_deg);
        let lost_s = match before {
            Some(before_deg) => self.pace.corner_s(wrap_180(bearing_deg - before_deg)),
            None => self.pace.start_s(),
        };
        leg_m / self.pace.speed_m_s + lost_s
    }

    fn go_home(&mut self, item: usize, home: Option<LatLon>) {
        let Some(place) = home else {
            return;
        };
        let leg_m = self.at.map_or(0.0, |from| from.distance_m(place));
        let height_m = self.height_m;
        let along_m = self.profile.length_m + leg_m;
        self.stop(Stop {
            item,
            place,
            height_m,
            leg_m,
            climb_m: 0.0,
            leg_s: 0.0,
            along_m,
            lands: false,
        });
        let return_s = self.pace.homeward(leg_m, height_m.max(0.0), 0.0).time_s;
        self.height_m = 0.0;
        self.land(return_s);
    }

    fn stop(&mut self, stop: Stop) {
        let profile = &mut self.profile;
        profile.length_m = stop.along_m;
        profile.time_s += stop.leg_s;
        profile.stops.push(stop);
        (self.at, self.height_m) = (Some(stop.place), stop.height_m);
    }

    /// Ends the last leg on the ground, after some seconds more.
    fn land(&mut self, seconds: f64) {
        self.along_deg = None;
        if let Some(stop) = self.profile.stops.last_mut() {
            stop.lands = true;
            stop.leg_s += seconds;
            self.profile.time_s += seconds;
        }
    }
}
