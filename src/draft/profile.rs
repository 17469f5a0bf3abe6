//! The profile of a plan: the legs with their lengths, times and slopes, and the heights along them.

use super::place::place;
use crate::geo::{LatLon, Terrain};
use crate::plan::effort::Pace;
use crate::plan::legs::{LegMotion, LegPace, LegStart, changed_speed_m_s, turns_m};
use crate::plan::{Document, HeightFrame, Item, command};

/// An item that the vehicle flies to, and the leg that leads there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// The item, counted from 0.
    pub item: usize,
    pub place: LatLon,
    /// Height above home on arrival, in metres. Unknown ground counts as level with home.
    pub height_m: f64,
    /// The length of the leg over the ground, in metres.
    pub leg_m: f64,
    /// The length of the turns at the end of the leg, in metres.
    pub turns_m: f64,
    /// How much higher the end of the leg is than its start, in metres.
    pub climb_m: f64,
    /// The duration of the leg in seconds, including the stay at its end.
    pub leg_s: f64,
    /// The length of the path on arrival, before the turns, in metres.
    pub along_m: f64,
    /// Whether the vehicle lands there.
    pub lands: bool,
}

impl Stop {
    /// The length of the leg with the turns at its end, in metres.
    pub fn way_m(&self) -> f64 {
        self.leg_m + self.turns_m
    }

    /// The length of the path when the vehicle leaves the stop, in metres.
    pub fn left_m(&self) -> f64 {
        self.along_m + self.turns_m
    }

    /// The slope of the leg in percent; `None` for a leg straight up or down.
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
    /// Whether jumps repeat parts of the plan; length and time leave the repetitions out.
    pub repeats: bool,
}

impl Profile {
    /// The place at a distance along the path, in metres; `None` beyond its end. Turns count as
    /// their centre.
    pub fn place_at(&self, along_m: f64) -> Option<LatLon> {
        let to = self
            .stops
            .iter()
            .position(|stop| stop.left_m() >= along_m)?;
        let end = self.stops[to];
        let start = to.checked_sub(1).map(|at| self.stops[at].place);
        let from = start.or(self.start).unwrap_or(end.place);
        let (north_m, east_m) = from.offset_to(end.place);
        let share = if end.leg_m > 0.0 {
            (1.0 - (end.along_m - along_m) / end.leg_m).min(1.0)
        } else {
            1.0
        };
        Some(from.moved(north_m * share, east_m * share))
    }

    /// The stop of an item, given by its index; `None` if the vehicle does not fly to it.
    pub fn at(&self, item: usize) -> Option<&Stop> {
        self.stops.iter().find(|stop| stop.item == item)
    }
}

/// The height of an item above home; `None` if the conversion needs the height of home, which is
/// not known. Unknown ground counts as level.
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
    /// Where the vehicle is; `None` before the first place is known.
    at: Option<LegStart>,
    pace: Pace,
    profile: Profile,
}

/// The course of a document's plan over `ground`.
pub fn profile(document: &Document, pace: Pace, ground: &Terrain) -> Profile {
    let home = document.home.map(|home| LatLon::from_e7(home.x, home.y));
    let mut course = Course {
        at: home.map(on_the_ground),
        pace,
        profile: Profile {
            start: home,
            ..Profile::default()
        },
        ground,
    };
    for (index, item) in document.plan.iter().enumerate() {
        match item.command {
            command::DO_CHANGE_SPEED => {
                let speed_m_s = changed_speed_m_s(item);
                course.pace.speed_m_s = speed_m_s.unwrap_or(course.pace.speed_m_s);
            }
            command::DO_JUMP | command::DO_JUMP_TAG => course.profile.repeats = true,
            command::DELAY | command::CONDITION_DELAY => {
                course.profile.time_s += f64::from(item.params[0].max(0.0));
                // Only a delay is a stop; a condition holds back the next action.
                if item.command == command::DELAY {
                    course.rest();
                }
            }
            command::RETURN_TO_LAUNCH => course.go_home(index, home),
            flown if command::is_flown_to(flown) => course.fly(document, index, item),
            _ => {}
        }
    }
    course.profile
}

fn on_the_ground(place: LatLon) -> LegStart {
    LegStart {
        place,
        height_m: 0.0,
        motion: LegMotion::Rest,
    }
}

impl Course<'_> {
    fn fly(&mut self, document: &Document, index: usize, item: &Item) {
        let lands = matches!(
            item.command,
            command::LAND | command::VTOL_LAND | command::PAYLOAD_PLACE
        );
        let has_place = (item.x, item.y) != (0, 0) && !command::is_takeoff(item.command);
        let goal = has_place.then(|| item.point());
        let Some(goal) = goal.or(self.at.map(|at| at.place)) else {
            return;
        };
        let from = self.at.unwrap_or_else(|| on_the_ground(goal));
        let height_m = if lands {
            from.height_m
        } else {
            height_above_home(document, item, self.ground).unwrap_or(from.height_m)
        };
        // A stay without an end counts as none.
        let stay_s = LegPace::Copter(self.pace).stay_s(item).unwrap_or(0.0);
        let stop = self.go(index, from, goal, height_m);
        self.stop(Stop {
            turns_m: turns_m(item),
            leg_s: stop.leg_s + stay_s,
            ..stop
        });
        if stay_s > 0.0 || command::is_takeoff(item.command) {
            self.rest();
        }
        if lands {
            self.land(self.pace.landing(height_m.max(0.0)).time_s);
        }
    }

    /// Flies a leg to an item, without the stay at its end.
    fn go(&mut self, item: usize, from: LegStart, place: LatLon, height_m: f64) -> Stop {
        let mut at = from;
        let flown_s = at.fly(place, height_m, LegPace::Copter(self.pace));
        let leg_m = from.place.distance_m(place);
        self.at = Some(at);
        Stop {
            item,
            place,
            height_m,
            leg_m,
            turns_m: 0.0,
            climb_m: height_m - from.height_m,
            leg_s: flown_s.unwrap_or(0.0),
            along_m: self.profile.length_m + leg_m,
            lands: false,
        }
    }

    fn go_home(&mut self, item: usize, home: Option<LatLon>) {
        let Some(place) = home else {
            return;
        };
        let from = self.at.unwrap_or_else(|| on_the_ground(place));
        let leg_m = from.place.distance_m(place);
        self.stop(Stop {
            item,
            place,
            height_m: from.height_m,
            leg_m,
            turns_m: 0.0,
            climb_m: 0.0,
            leg_s: 0.0,
            along_m: self.profile.length_m + leg_m,
            lands: false,
        });
        self.at = Some(on_the_ground(place));
        let height_m = from.height_m.max(0.0);
        self.land(self.pace.homeward(leg_m, height_m, 0.0).time_s);
    }

    fn stop(&mut self, stop: Stop) {
        let profile = &mut self.profile;
        profile.length_m = stop.left_m();
        profile.time_s += stop.leg_s;
        profile.stops.push(stop);
    }

    fn rest(&mut self) {
        if let Some(at) = &mut self.at {
            at.motion = LegMotion::Rest;
        }
    }

    /// Ends the last leg on the ground, `seconds` later.
    fn land(&mut self, seconds: f64) {
        self.at = self.at.map(|at| on_the_ground(at.place));
        if let Some(stop) = self.profile.stops.last_mut() {
            stop.lands = true;
            stop.leg_s += seconds;
            self.profile.time_s += seconds;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Home;

    /// Home, a waypoint 100 m to the north, two turns of 50 m there, and the return.
    fn orbit() -> Document {
        let home = LatLon::new(50.45, 30.52);
        let item = |command, north_m: f64, params| {
            let (x, y) = home.moved(north_m, 0.0).to_e7();
            Item {
                command,
                frame: 3,
                params,
                x,
                y,
                z: 20.0,
                ..Item::default()
            }
        };
        let (x, y) = home.to_e7();
        Document {
            home: Some(Home { x, y, z: 170.0 }),
            plan: vec![
                item(command::TAKEOFF, 0.0, [0.0; 4]),
                item(command::LOITER_TURNS, 100.0, [2.0, 0.0, -50.0, 0.0]),
                item(command::RETURN_TO_LAUNCH, 0.0, [0.0; 4]),
            ],
            ..Document::default()
        }
    }

    #[test]
    fn the_length_includes_turns() {
        let course = profile(&orbit(), Pace::default(), &Terrain::default());
        let circles_m = 2.0 * std::f64::consts::TAU * 50.0;
        assert!((course.length_m - 200.0 - circles_m).abs() < 0.5);
        let turns = course.at(1).expect("a stop");
        assert!((turns.way_m() - 100.0 - circles_m).abs() < 0.5);
        assert!((turns.leg_m - 100.0).abs() < 0.5, "slopes count the leg");
        let back = course.at(2).expect("a stop");
        assert!((back.along_m - course.length_m).abs() < 0.01);
    }

    /// While the vehicle turns, it counts as at the centre; the way back begins after the turns.
    #[test]
    fn turns_count_as_their_centre() {
        let course = profile(&orbit(), Pace::default(), &Terrain::default());
        let centre = course.at(1).expect("a stop").place;
        let away_m = |along_m| centre.distance_m(course.place_at(along_m).expect("a place"));
        assert!(away_m(150.0) < 0.5 && away_m(700.0) < 0.5);
        assert!((away_m(course.length_m - 40.0) - 60.0).abs() < 0.5);
    }
}
