//! The height of a plan's legs above the ground.

use sortie_geo::LatLon;

use super::{Finding, FindingKind, plan_finding};
use crate::{Document, HeightFrame, Home, Item, ListKind, command};

/// The distance between the points of a leg that are checked, in metres: a third of the spacing of the finest files.
const STEP_M: f64 = 10.0;
/// The default minimum height of a leg above the ground, in metres.
pub const USUAL_CLEARANCE_M: f64 = 10.0;
/// The largest difference between the height of home and the ground there that is not reported, in
/// metres.
const HOME_SLACK_M: f64 = 30.0;
/// The default of `RTL_ALT`, in metres above home.
const RETURN_HEIGHT_M: f64 = 15.0;
/// The length below which a leg counts as a climb or descent in place, in metres.
const IN_PLACE_M: f64 = 1.0;

/// A leg of a plan and its height above the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leg {
    /// The item to which the leg leads, counted from 0.
    pub item: usize,
    /// The length of the leg over the ground, in metres.
    pub length_m: f64,
    /// Whether its heights are measured from the ground at both ends, so the vehicle follows the
    /// ground.
    pub follows_ground: bool,
    /// The minimum height above the ground, and its distance from the start of the leg, both in
    /// metres; `None` if a part of the leg is not covered.
    pub lowest: Option<[f64; 2]>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Level {
    AboveSea(f64),
    AboveGround(f64),
}

/// The vehicle's position and height after an item.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Point {
    at: LatLon,
    level: Level,
}

/// The legs of a plan from place to place, with their heights above the ground. If the height of
/// the ground at home is known, heights above home are measured from that ground, because the
/// vehicle stands on it; otherwise from home's height in the file.
pub fn legs(document: &Document, ground_m: &dyn Fn(LatLon) -> Option<f64>) -> Vec<Leg> {
    let home = document
        .home
        .map(|home| (place_of(home), home_m(home, ground_m)));
    let mut here = home.map(|(at, amsl_m)| Point {
        at,
        level: Level::AboveSea(amsl_m),
    });
    let mut legs = Vec::new();
    for (item, it) in document.plan.iter().enumerate() {
        let Some(next) = next_point(it, here, home) else {
            continue;
        };
        // From the ground the vehicle rises in place: a takeoff has no place of its own.
        if let Some(before) = here.filter(|_| !command::is_takeoff(it.command))
            && before.at.distance_m(next.at) > IN_PLACE_M
        {
            legs.push(leg(item, before, next, ground_m));
        }
        here = Some(next);
    }
    legs
}

fn place_of(home: Home) -> LatLon {
    LatLon::from_e7(home.x, home.y)
}

fn home_m(home: Home, ground_m: &dyn Fn(LatLon) -> Option<f64>) -> f64 {
    ground_m(place_of(home)).unwrap_or(f64::from(home.z))
}

/// Where an item leads from a point; `None` if the item does not move the vehicle, or its height is
/// unknown.
fn next_point(item: &Item, here: Option<Point>, home: Option<(LatLon, f64)>) -> Option<Point> {
    if item.command == command::RETURN_TO_LAUNCH {
        let (at, home_m) = home?;
        let least_m = home_m + RETURN_HEIGHT_M;
        let level = match here?.level {
            Level::AboveSea(amsl_m) => Level::AboveSea(amsl_m.max(least_m)),
            Level::AboveGround(height_m) => Level::AboveGround(height_m.max(RETURN_HEIGHT_M)),
        };
        return Some(Point { at, level });
    }
    if !command::is_flown_to(item.command) {
        return None;
    }
    let takes_off = command::is_takeoff(item.command);
    let own = item.place().filter(|_| !takes_off);
    let at = own.or(here.map(|here| here.at)).or(item.place())?;
    let lands = matches!(item.command, command::LAND | command::VTOL_LAND);
    let z = f64::from(item.z);
    // A vehicle lands from its current height, and an item with a height of 0 keeps it.
    if lands || (z == 0.0 && !takes_off) || !z.is_finite() {
        let level = here?.level;
        return Some(Point { at, level });
    }
    let level = match item.height_frame() {
        HeightFrame::SeaLevel => Level::AboveSea(z),
        HeightFrame::Home => Level::AboveSea(home?.1 + z),
        HeightFrame::Terrain => Level::AboveGround(z),
        HeightFrame::Other => return None,
    };
    Some(Point { at, level })
}

fn leg(item: usize, from: Point, to: Point, ground_m: &dyn Fn(LatLon) -> Option<f64>) -> Leg {
    let (north_m, east_m) = from.at.offset_to(to.at);
    let length_m = (north_m * north_m + east_m * east_m).sqrt();
    let empty = Leg {
        item,
        length_m,
        follows_ground: false,
        lowest: None,
    };
    if let (Level::AboveGround(first_m), Level::AboveGround(last_m)) = (from.level, to.level) {
        let along_m = if first_m <= last_m { 0.0 } else { length_m };
        let covered = ground_m(from.at).and(ground_m(to.at));
        return Leg {
            follows_ground: true,
            lowest: covered.map(|_| [first_m.min(last_m), along_m]),
            ..empty
        };
    }
    let amsl = |point: Point| match point.level {
        Level::AboveSea(amsl_m) => Some(amsl_m),
        Level::AboveGround(height_m) => Some(ground_m(point.at)? + height_m),
    };
    let lowest = || {
        let (first_m, last_m) = (amsl(from)?, amsl(to)?);
        let steps = (length_m / STEP_M).ceil().max(1.0) as u32;
        let mut lowest = [f64::INFINITY, 0.0];
        for step in 0..=steps {
            let share = f64::from(step) / f64::from(steps);
            let at = from.at.moved(north_m * share, east_m * share);
            let height_m = first_m + (last_m - first_m) * share - ground_m(at)?;
            if height_m < lowest[0] {
                lowest = [height_m, share * length_m];
            }
        }
        Some(lowest)
    };
    Leg {
        lowest: lowest(),
        ..empty
    }
}

/// The legs that come closer to the ground than `clearance_m`, and those that no terrain file covers.
pub fn check_terrain(
    document: &Document,
    ground_m: &dyn Fn(LatLon) -> Option<f64>,
    clearance_m: f64,
) -> Vec<Finding> {
    let whole = |kind| Finding {
        list: ListKind::Plan,
        item: None,
        kind,
    };
    let home = document.home.and_then(|home| home_fault(home, ground_m));
    let mut findings: Vec<Finding> = home.map(whole).into_iter().collect();
    let mut uncovered = 0;
    for leg in legs(document, ground_m) {
        let frame = document.plan[leg.item].height_frame();
        let kind = match leg.lowest {
            Some([height_m, along_m]) if height_m < clearance_m => FindingKind::LowOverGround {
                height_m: height_m as f32,
                along_m: along_m as f32,
                least_m: clearance_m as f32,
            },
            Some(_) => continue,
            None if frame == HeightFrame::Terrain => FindingKind::NoGround,
            None => {
                uncovered += 1;
                continue;
            }
        };
        findings.push(plan_finding(leg.item, kind));
    }
    findings.extend((uncovered > 0).then(|| whole(FindingKind::Uncovered(uncovered))));
    findings.sort_by_key(|finding| (finding.list, finding.item));
    findings
}

fn home_fault(home: Home, ground_m: &dyn Fn(LatLon) -> Option<f64>) -> Option<FindingKind> {
    let ground = ground_m(place_of(home))?;
    let is_off = (ground - f64::from(home.z)).abs() > HOME_SLACK_M;
    is_off.then_some(FindingKind::HomeHeight {
        home_m: home.z,
        ground_m: ground as f32,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOME: LatLon = LatLon::new(50.45, 30.52);

    fn item(number: u16, frame: u8, north_m: f64, z: f32) -> Item {
        let (x, y) = HOME.moved(north_m, 0.0).to_e7();
        Item {
            command: number,
            frame,
            auto_continue: true,
            x,
            y,
            z,
            ..Item::default()
        }
    }

    fn document(plan: Vec<Item>) -> Document {
        let (x, y) = HOME.to_e7();
        Document {
            home: Some(Home { x, y, z: 100.0 }),
            plan,
            ..Document::default()
        }
    }

    /// Ground at 100 m with a ridge, 60 m high and 400 m wide, 500 m north of home.
    fn ridge_m(place: LatLon) -> f64 {
        let (north_m, _) = HOME.offset_to(place);
        100.0 + 60.0 * (1.0 - (north_m - 500.0).abs() / 200.0).max(0.0)
    }

    fn over(frame: u8, z: f32) -> Vec<FindingKind> {
        let plan = document(vec![
            item(command::TAKEOFF, 3, 0.0, 50.0),
            item(command::WAYPOINT, frame, 1000.0, z),
            item(command::RETURN_TO_LAUNCH, 3, 0.0, 0.0),
        ]);
        let found = check_terrain(&plan, &|at| Some(ridge_m(at)), 10.0).into_iter();
        found.map(|finding| finding.kind).collect()
    }

    #[test]
    fn a_leg_through_a_ridge_is_found_where_it_is_worst() {
        let found = over(3, 50.0);
        let [there, back] = found.as_slice() else {
            panic!("{found:?}");
        };
        for kind in [there, back] {
            let FindingKind::LowOverGround {
                height_m,
                along_m,
                least_m,
            } = kind
            else {
                panic!("{kind:?}");
            };
            assert!(
                (-10.1..-6.0).contains(height_m) && (along_m - 500.0).abs() < 11.0,
                "{kind:?}"
            );
            assert!((least_m - 10.0).abs() < 1e-6, "{kind:?}");
        }
        // 160 m above sea level is 60 m above home, right at the crest; 175 m clears it.
        assert_eq!(over(0, 160.0).len(), 2);
        assert_eq!(over(0, 190.0), vec![]);
        assert_eq!(over(3, 100.0), vec![]);
    }

    #[test]
    fn heights_above_terrain_follow_the_ground() {
        let plan = document(vec![
            item(command::TAKEOFF, 3, 0.0, 50.0),
            item(command::WAYPOINT, 10, 100.0, 30.0),
            item(command::WAYPOINT, 10, 1000.0, 30.0),
        ]);
        let legs = legs(&plan, &|at| Some(ridge_m(at)));
        assert!(!legs[0].follows_ground && legs[1].follows_ground);
        assert_eq!(legs[1].lowest, Some([30.0, 0.0]));
        assert_eq!(check_terrain(&plan, &|at| Some(ridge_m(at)), 10.0), vec![]);
        assert_eq!(check_terrain(&plan, &|at| Some(ridge_m(at)), 35.0).len(), 2);
    }

    #[test]
    fn what_no_file_covers_is_said_once_unless_the_height_needs_it() {
        let plan = document(vec![
            item(command::TAKEOFF, 3, 0.0, 50.0),
            item(command::WAYPOINT, 3, 100.0, 30.0),
            item(command::WAYPOINT, 3, 200.0, 30.0),
            item(command::WAYPOINT, 10, 300.0, 30.0),
        ]);
        let found = check_terrain(&plan, &|_| None, 10.0);
        let kinds: Vec<FindingKind> = found.into_iter().map(|it| it.kind).collect();
        assert_eq!(kinds, [FindingKind::Uncovered(2), FindingKind::NoGround]);
    }

    #[test]
    fn a_home_at_sea_level_is_noticed_and_the_ground_counts() {
        let mut plan = document(vec![
            item(command::TAKEOFF, 3, 0.0, 50.0),
            item(command::WAYPOINT, 3, 100.0, 30.0),
        ]);
        plan.home = plan.home.map(|home| Home { z: 0.0, ..home });
        let found = check_terrain(&plan, &|at| Some(ridge_m(at)), 10.0);
        let kinds: Vec<FindingKind> = found.into_iter().map(|it| it.kind).collect();
        assert_eq!(
            kinds,
            [FindingKind::HomeHeight {
                home_m: 0.0,
                ground_m: 100.0
            }]
        );
    }
}
