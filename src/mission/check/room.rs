//! Whether vehicles can fly to every place: within the fence, below the ceiling, outside forbidden zones.

use std::f64::consts::TAU;

use super::{Examined, ExaminedObjective};
use crate::geo::maths;
use crate::mission::Point;
use crate::mission::objective::GateRoute;
use crate::mission::report::distance_m;
use crate::mission::zone::{Shape, Zone, ZoneKind};
use crate::text;
use crate::text::Text;

/// The tolerance by which points on the edge of a fence count as inside.
const EDGE_M: f64 = 0.01;
/// The number of points at which the edge of a round zone is tested.
const POINTS_OF_A_CIRCLE: u32 = 16;

pub(super) fn check(examined: &mut Examined<'_>) {
    pads(examined);
    for objective in examined.objectives() {
        zone(examined, &objective);
        places(examined, &objective);
        heights(examined, &objective);
        gates(examined, &objective);
    }
}

/// Reports pads outside the fence or too close together.
fn pads(examined: &mut Examined<'_>) {
    let mission = examined.mission;
    let written = examined
        .section("fleet")
        .map_or(&[][..], |fleet| fleet.items_of("pads"));
    for (index, (&at, written)) in mission.seats.pads.iter().zip(written).enumerate() {
        let place = written.span.clone();
        if let Some(what) = obstacle(examined, at, 0.0) {
            let number = index + 1;
            examined.add(
                place.clone(),
                text!("check-pad-lies", number = number, obstacle = what),
            );
        }
        let before = mission.seats.pads.iter().take(index);
        let near = before.map(|&other| distance_m(at, other));
        let near_m = near.fold(f64::INFINITY, f64::min);
        if near_m < mission.min_separation_m() {
            let apart_m = mission.min_separation_m();
            let fault = text!(
                "check-pads-near",
                near = format!("{near_m:.1}"),
                apart = apart_m.to_string()
            );
            examined.add(place, fault);
        }
    }
}

fn zone(examined: &mut Examined<'_>, objective: &ExaminedObjective<'_>) {
    let Some(zone) = objective.demands.zone else {
        return;
    };
    let outer = corners(&zone.shape);
    let left = |fence: &&Zone| outer.iter().any(|&at| is_beyond(fence, at));
    if let Some(fence) = fences(examined).into_iter().find(left) {
        let fault = text!("check-zone-fence", zone = &zone.id, fence = &fence.id);
        examined.add(objective.written.span_of("zone"), fault);
    }
}

fn places(examined: &mut Examined<'_>, objective: &ExaminedObjective<'_>) {
    let places = objective.demands.places.as_ref();
    for place in places.map_or(&[][..], |places| places.all) {
        if let Some(what) = obstacle(examined, place.at, 0.0) {
            let fault = text!("check-place-lies", name = &place.name, obstacle = what);
            examined.add(place.written.clone(), fault);
        }
    }
}

fn heights(examined: &mut Examined<'_>, objective: &ExaminedObjective<'_>) {
    let ceiling_m = examined.ceiling_m();
    let heights_m = objective.demands.heights_m;
    if heights_m.is_some_and(|[low_m, _]| low_m >= ceiling_m) {
        let fault = text!("check-heights", height = ceiling_m.to_string());
        examined.add(objective.written.span_of("heights"), fault);
    }
}

/// Reports gates where vehicles may not fly.
fn gates(examined: &mut Examined<'_>, objective: &ExaminedObjective<'_>) {
    let ceiling_m = examined.ceiling_m();
    let route = objective.demands.route;
    let gates = route.map_or(&[][..], GateRoute::gates);
    for (index, &[east_m, north_m, up_m]) in gates.iter().enumerate() {
        let place = objective.written.span_of_item("gates", index);
        if up_m > ceiling_m {
            let fault = text!("check-gate-high", height = ceiling_m.to_string());
            examined.add(place, fault);
        } else if let Some(what) = obstacle(examined, [east_m, north_m], up_m) {
            examined.add(place, text!("check-gate-lies", obstacle = what));
        }
    }
}

/// Why flying at a point is forbidden, if it is.
fn obstacle(examined: &Examined<'_>, at: Point, up_m: f64) -> Option<Text> {
    if let Some(fence) = fences(examined).into_iter().find(|it| is_beyond(it, at)) {
        return Some(text!("check-beyond", fence = &fence.id));
    }
    let mut zones = examined
        .mission
        .site
        .zones
        .iter()
        .filter(|zone| zone.active);
    let forbidden = zones.find(|zone| zone.kind.forbids_all(up_m, up_m) && zone.shape.contains(at));
    forbidden.map(|zone| text!("check-no-flights", zone = &zone.id))
}

fn fences<'m>(examined: &Examined<'m>) -> Vec<&'m Zone> {
    let zones = examined.mission.site.zones.iter();
    let is_fence = |zone: &&Zone| zone.active && matches!(zone.kind, ZoneKind::Geofence { .. });
    zones.filter(is_fence).collect()
}

fn is_beyond(fence: &Zone, at: Point) -> bool {
    fence.shape.distance_m(at) > EDGE_M
}

/// The corners of a shape, or points on its edge.
fn corners(shape: &Shape) -> Vec<Point> {
    match shape {
        Shape::Polygon(corners) => corners.clone(),
        Shape::Circle { center, radius_m } => (0..POINTS_OF_A_CIRCLE)
            .map(|step| TAU * f64::from(step) / f64::from(POINTS_OF_A_CIRCLE))
            .map(|angle| {
                let (sin, cos) = maths::sin_cos(angle);
                [center[0] + radius_m * sin, center[1] + radius_m * cos]
            })
            .collect(),
    }
}
