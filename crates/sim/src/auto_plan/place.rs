//! The meaning of the places in mission items.

use glam::DVec3;

use super::{AutoPlan, FIRST, sequence};
use crate::cmd;
use crate::plan::Item;
use crate::task::Task;
use crate::vehicle::Vehicle;
use sortie_geo::LatLon;

/// The maximum number of items on a return path.
const ITEMS_MAX: usize = 255;
const HEIGHT_MAX_M: f32 = 1e6;
/// Radii above this, in metres, are stored in steps of 10 m.
const COARSE_RADIUS_M: f64 = 255.0;

impl AutoPlan {
    /// The nearest `DO_LAND_START`. For an item without a place, the place of the next navigation
    /// command is used.
    pub(crate) fn landing_start(&self, vehicle: &Vehicle) -> Option<u16> {
        let items = &vehicle.plans.mission;
        let distance = |at: u16| {
            let item = items.get(usize::from(at))?;
            let placed = if item.x == 0 && item.y == 0 && item.z == 0.0 {
                let next = sequence::next_navigation(items, at, &self.jumps)?;
                items.get(usize::from(next))?
            } else {
                item
            };
            let way = item_point(vehicle, placed, vehicle.datum.home_point())
                - vehicle.believed().position_m;
            Some((at, way.length()))
        };
        (FIRST..items.len() as u16)
            .filter(|&at| {
                items
                    .get(usize::from(at))
                    .is_some_and(|item| item.command == cmd::DO_LAND_START)
            })
            .filter_map(distance)
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(at, _)| at)
    }
}

impl AutoPlan {
    /// The end of the nearest leg after a `DO_RETURN_PATH_START`: the item at which a return path
    /// is joined. `None` without a return path.
    pub(crate) fn return_path(&self, vehicle: &Vehicle) -> Option<u16> {
        let items = &vehicle.plans.mission;
        (FIRST..items.len() as u16)
            .filter(|&at| {
                let item = items.get(usize::from(at));
                item.is_some_and(|item| item.command == cmd::DO_RETURN_PATH_START)
            })
            .filter_map(|at| self.nearest_leg(vehicle, at))
            // Of equally close items, the last counts.
            .reduce(|best, next| if next.0 <= best.0 { next } else { best })
            .map(|(_, at)| at)
    }

    /// The distance to the nearest of the legs from an item onwards, and the item at the end of that leg. The path ends
    /// at a landing or at a `DO_LAND_START`.
    fn nearest_leg(&self, vehicle: &Vehicle, from: u16) -> Option<(f64, u16)> {
        let items = &vehicle.plans.mission;
        let here_m = vehicle.believed().position_m;
        let mut jumps = self.jumps.clone();
        let mut last_m: Option<DVec3> = None;
        let mut best: Option<(f64, u16)> = None;
        let mut at = from;
        for _ in 0..ITEMS_MAX {
            let Some(found) = sequence::next_counting(items, at, &mut jumps, &mut Vec::new())
            else {
                return best;
            };
            at = found + 1;
            let item = items.get(usize::from(found))?;
            if let Some(flat) = item_place(vehicle, item).filter(|_| has_place(item.command)) {
                let point_m = flat.extend(item_down_m(vehicle, item));
                let left_m = last_m.map_or_else(
                    || point_m.distance(here_m),
                    |last_m| distance_to_leg(here_m, last_m, point_m),
                );
                if last_m != Some(point_m) && best.is_none_or(|(least_m, _)| left_m < least_m) {
                    best = Some((left_m, found));
                }
                last_m = Some(point_m);
            }
            if matches!(
                item.command,
                cmd::NAV_LAND | cmd::NAV_VTOL_LAND | cmd::DO_PARACHUTE | cmd::DO_LAND_START
            ) {
                return best;
            }
        }
        None
    }
}

fn has_place(command: u16) -> bool {
    sequence::is_navigation(command)
        || matches!(
            command,
            cmd::DO_SET_HOME
                | cmd::DO_SET_ROI
                | cmd::DO_RETURN_PATH_START
                | cmd::DO_LAND_START
                | cmd::DO_GO_AROUND
        )
}

fn distance_to_leg(here_m: DVec3, from_m: DVec3, to_m: DVec3) -> f64 {
    let leg_m = to_m - from_m;
    let along = (here_m - from_m).dot(leg_m) / leg_m.length_squared().max(1e-9);
    (from_m + leg_m * along.clamp(0.0, 1.0)).distance(here_m)
}

/// The point of an item, in metres north, east and down from the start. A missing place (0, 0) or
/// height (0) is taken from `otherwise`.
pub(super) fn item_point(vehicle: &Vehicle, item: &Item, otherwise: DVec3) -> DVec3 {
    let flat = item_place(vehicle, item).unwrap_or_else(|| otherwise.truncate());
    let down_m = if item.z == 0.0 {
        otherwise.z
    } else {
        item_down_m(vehicle, item)
    };
    flat.extend(down_m)
}

/// The place of an item in metres north and east of the start, if it has one.
pub(super) fn item_place(vehicle: &Vehicle, item: &Item) -> Option<glam::DVec2> {
    let at = LatLon::from_e7(item.x, item.y);
    if (item.x == 0 && item.y == 0) || !at.is_valid() {
        return None;
    }
    let (north, east) = vehicle.datum.start.at.offset_to(at);
    Some(glam::DVec2::new(north, east))
}

/// The height of an item, in metres down from the start; in an unsupported frame, it is measured
/// from home.
pub(super) fn item_down_m(vehicle: &Vehicle, item: &Item) -> f64 {
    let height = if item.z.is_finite() { item.z } else { 0.0 };
    let height_m = f64::from(height.clamp(-HEIGHT_MAX_M, HEIGHT_MAX_M));
    match vehicle.datum.altitude_amsl_m(item.frame, height_m) {
        Some(amsl_m) => vehicle.datum.start.altitude_amsl_m - amsl_m,
        None => vehicle.datum.home_point().z - height_m,
    }
}

/// The source of missing coordinates: the last goal reached, or the vehicle's position.
pub(super) fn reference_point(vehicle: &Vehicle) -> DVec3 {
    if let Task::Route(route) = &vehicle.flight.task
        && route.reached
    {
        route.goal_m()
    } else {
        vehicle.believed().position_m
    }
}

/// The radius of a circle, as it is stored.
pub(super) fn circle_radius_m(item: &Item) -> f64 {
    let asked_m = f64::from(item.params[2]).abs().min(2550.0);
    if asked_m > COARSE_RADIUS_M {
        (asked_m / 10.0).floor() * 10.0
    } else {
        asked_m.floor()
    }
}
