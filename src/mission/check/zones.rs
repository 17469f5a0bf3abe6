//! Whether zones have a valid shape and an effect, and leave room for the task in them.

use super::{Examined, ExaminedObjective};
use crate::mission::Point;
use crate::mission::event::Action;
use crate::mission::format::WrittenValue;
use crate::mission::zone::{Shape, Zone, ZoneKind};
use crate::text;

/// The number of test points along each side of a zone's bounding rectangle.
const POINTS_OF_A_SIDE: u32 = 60;
/// The largest share of a task zone that may be forbidden.
const MOST_FORBIDDEN: f64 = 0.9;

pub(super) fn check(examined: &mut Examined<'_>) {
    let mission = examined.mission;
    for (zone, written) in mission.site.zones.iter().zip(examined.tables("zones")) {
        shape(examined, zone, written);
        let jams = match zone.kind {
            ZoneKind::RadioJam { .. } => Some("radio_jam"),
            ZoneKind::CommShadow(_) => Some("comm_shadow"),
            ZoneKind::Task
            | ZoneKind::Geofence { .. }
            | ZoneKind::NoFly { .. }
            | ZoneKind::GnssJam { .. }
            | ZoneKind::GnssGlitch { .. }
            | ZoneKind::People { .. } => None,
        };
        if let Some(kind) = jams.filter(|_| mission.site.radio.is_none()) {
            let fault = text!("check-jams-nothing", kind = kind);
            examined.add(written.span_of("kind"), fault);
        }
    }
    for objective in examined.objectives() {
        forbidden(examined, &objective);
    }
}

/// Reports a polygon whose sides cross: the zone then covers an area that was not intended.
fn shape(examined: &mut Examined<'_>, zone: &Zone, written: &WrittenValue) {
    let Shape::Polygon(corners) = &zone.shape else {
        return;
    };
    let Some((first, second)) = crossing(corners) else {
        return;
    };
    let place = written.span_of("polygon");
    let side = |from: usize| {
        let (from, to) = (from + 1, (from + 1) % corners.len() + 1);
        text!("check-corners", from = from, to = to)
    };
    let fault = text!("check-crossed", first = side(first), second = side(second));
    examined.add(place, fault);
}

/// The first two sides that cross, each given by the index of its first corner; `None` if no sides
/// cross.
fn crossing(corners: &[Point]) -> Option<(usize, usize)> {
    let side = |from: usize| {
        Some((
            *corners.get(from)?,
            *corners.get((from + 1) % corners.len())?,
        ))
    };
    let sides = || (0..corners.len()).filter_map(|from| Some((from, side(from)?)));
    sides().find_map(|(first, (a, b))| {
        let mut later = sides().skip(first + 1);
        let crossed = later.find(|&(_, (c, d))| cross(a, b, c, d))?;
        Some((first, crossed.0))
    })
}

/// Whether the lines from `a` to `b` and from `c` to `d` cross; touching is not crossing.
fn cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    // On which side of the line from `from` to `to` a point lies.
    let turn = |from: Point, to: Point, at: Point| {
        (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])
    };
    turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0
}

/// Reports an objective's zone that is almost entirely forbidden for the whole mission.
fn forbidden(examined: &mut Examined<'_>, objective: &ExaminedObjective<'_>) {
    let Some(zone) = objective.demands.zone else {
        return;
    };
    let mission = examined.mission;
    let [low_m, highest_m] = objective.demands.heights_m.unwrap_or([0.0, f64::INFINITY]);
    let high_m = highest_m.min(examined.ceiling_m());
    let is_lifted = |place: usize| {
        let mut actions = mission.events.iter().flat_map(|event| &event.actions);
        actions.any(|action| matches!(action, Action::Zone(index, false) if *index == place))
    };
    let closes = |(place, other): &(usize, &Zone)| {
        other.active && other.kind.forbids_all(low_m, high_m) && !is_lifted(*place)
    };
    let all = mission.site.zones.iter().enumerate();
    let closed: Vec<&Zone> = all.filter(closes).map(|(_, zone)| zone).collect();
    if share_within(&zone.shape, &closed) > MOST_FORBIDDEN {
        let names = closed.iter().map(|zone| format!("`{}`", zone.id));
        let fault = text!(
            "check-forbidden",
            zone = &zone.id,
            zones = names.collect::<Vec<_>>().join(", ")
        );
        examined.add(objective.written.span_of("zone"), fault);
    }
}

/// The share of a shape that lies in any of the zones.
fn share_within(shape: &Shape, zones: &[&Zone]) -> f64 {
    let ([west, south], [east, north]) = shape.bounds();
    let along = |from: f64, to: f64, step: u32| {
        from + (to - from) * (f64::from(step) + 0.5) / f64::from(POINTS_OF_A_SIDE)
    };
    let (mut inside, mut covered) = (0_u32, 0_u32);
    for column in 0..POINTS_OF_A_SIDE {
        for row in 0..POINTS_OF_A_SIDE {
            let at = [along(west, east, column), along(south, north, row)];
            if shape.contains(at) {
                inside += 1;
                covered += u32::from(zones.iter().any(|zone| zone.shape.contains(at)));
            }
        }
    }
    f64::from(covered) / f64::from(inside.max(1))
}
