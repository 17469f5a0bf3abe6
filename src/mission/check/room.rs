//! Whether everything lies where it can be flown to: within the fence, below the ceiling, outside what is forbidden.

use std::f64::consts::TAU;

use super::{Examined, WrittenEntry};
use crate::mission::Point;
use crate::mission::report::distance_m;
use crate::mission::zone::{Shape, Zone, ZoneKind};

/// Points on the edge of a fence are within it.
const EDGE_M: f64 = 0.01;
/// The edge of a round zone is looked at in so many points.
const POINTS_OF_A_CIRCLE: u32 = 16;

pub(super) fn check(examined: &mut Examined<'_>) {
    pads(examined);
    for objective in examined.entries("objectives") {
        targets(examined, objective);
        heights(examined, objective);
        gates(examined, objective);
    }
}

/// Each within the fence and apart from the others.
fn pads(examined: &mut Examined<'_>) {
    let mission = examined.mission;
    let fleet = examined.section("fleet");
    let pads = fleet.and_then(|fleet| fleet.get("pads"));
    let entries = pads.map_or(Vec::new(), WrittenEntry::items);
    for (index, (&at, entry)) in mission.pads.iter().zip(entries).enumerate() {
        if let Some(what) = obstacle(examined, at, 0.0) {
            let number = index + 1;
            examined.add(entry.span(), format!("pad {number} lies {what}"));
        }
        let before = mission.pads.iter().take(index);
        let near = before.map(|&other| distance_m(at, other));
        let near_m = near.fold(f64::INFINITY, f64::min);
        if near_m < mission.min_separation_m() {
            let apart_m = mission.min_separation_m();
            let fault = format!(
                "this pad is {near_m:.1} m from another one; vehicles must keep {apart_m} m apart"
            );
            examined.add(entry.span(), fault);
        }
    }
}

/// The zone of an objective and the places that it names.
fn targets(examined: &mut Examined<'_>, objective: WrittenEntry<'_>) {
    // What is to be protected is not flown to.
    let guarded = objective.word("kind") == Some("protect");
    if let Some(entry) = objective.get("zone").filter(|_| !guarded) {
        let mut zones = examined.mission.zones.iter();
        let zone = zones.find(|zone| Some(zone.id.as_str()) == entry.text());
        let fence = zone.and_then(|zone| {
            let outer = corners(&zone.shape);
            let fences = fences(examined);
            let left = |fence: &&Zone| outer.iter().any(|&at| is_beyond(fence, at));
            fences.into_iter().find(left)
        });
        if let (Some(zone), Some(fence)) = (zone, fence) {
            let fault = format!(
                "the zone `{}` reaches beyond the fence `{}`",
                zone.id, fence.id
            );
            examined.add(entry.span(), fault);
        }
    }
    let named = objective
        .get("places")
        .map_or(Vec::new(), WrittenEntry::items);
    for entry in named.into_iter().chain(objective.get("place")) {
        let Some(name) = entry.text() else { continue };
        let at = examined.place(name);
        if let Some(what) = at.and_then(|at| obstacle(examined, at, 0.0)) {
            examined.add(entry.span(), format!("the place `{name}` lies {what}"));
        }
    }
}

/// The heights that an objective asks for.
fn heights(examined: &mut Examined<'_>, objective: WrittenEntry<'_>) {
    let ceiling_m = examined.ceiling_m();
    let lowest = |entry: &WrittenEntry<'_>| entry.numbers().first().copied();
    if let Some(entry) = objective.get("heights")
        && lowest(&entry).is_some_and(|low_m| low_m >= ceiling_m)
    {
        let fault = format!("all these heights lie above the highest allowed, {ceiling_m} m");
        examined.add(entry.span(), fault);
    }
}

/// Gates are flown through as they stand.
fn gates(examined: &mut Examined<'_>, objective: WrittenEntry<'_>) {
    let ceiling_m = examined.ceiling_m();
    for gate in objective
        .get("gates")
        .map_or(Vec::new(), WrittenEntry::items)
    {
        let [east_m, north_m, up_m] = gate.numbers()[..] else {
            continue;
        };
        if up_m > ceiling_m {
            let fault = format!("this gate lies above the highest height allowed, {ceiling_m} m");
            examined.add(gate.span(), fault);
        } else if let Some(what) = obstacle(examined, [east_m, north_m], up_m) {
            examined.add(gate.span(), format!("this gate lies {what}"));
        }
    }
}

/// Why nothing may fly at a point.
fn obstacle(examined: &Examined<'_>, at: Point, up_m: f64) -> Option<String> {
    if let Some(fence) = fences(examined).into_iter().find(|it| is_beyond(it, at)) {
        return Some(format!("beyond the fence `{}`", fence.id));
    }
    let mut zones = examined.mission.zones.iter().filter(|zone| zone.active);
    let forbidden = zones.find(|zone| match zone.kind {
        ZoneKind::NoFly { floor_m, ceiling_m } => {
            zone.shape.contains(at) && (floor_m..=ceiling_m).contains(&up_m)
        }
        _ => false,
    });
    forbidden.map(|zone| format!("in the zone `{}`, where nobody may fly", zone.id))
}

fn fences<'m>(examined: &Examined<'m>) -> Vec<&'m Zone> {
    let zones = examined.mission.zones.iter();
    let is_fence = |zone: &&Zone| zone.active && matches!(zone.kind, ZoneKind::Geofence { .. });
    zones.filter(is_fence).collect()
}

fn is_beyond(fence: &Zone, at: Point) -> bool {
    fence.shape.distance_m(at) > EDGE_M
}

/// The corners of a shape, or points of its edge.
fn corners(shape: &Shape) -> Vec<Point> {
    match shape {
        Shape::Polygon(corners) => corners.clone(),
        Shape::Circle { center, radius_m } => (0..POINTS_OF_A_CIRCLE)
            .map(|step| TAU * f64::from(step) / f64::from(POINTS_OF_A_CIRCLE))
            .map(|angle| {
                let (sin, cos) = angle.sin_cos();
                [center[0] + radius_m * sin, center[1] + radius_m * cos]
            })
            .collect(),
    }
}
