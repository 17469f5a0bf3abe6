//! Whether zones have a shape and an effect, and leave room for what is to be done in them.

use super::{Examined, WrittenEntry};
use crate::mission::Point;
use crate::mission::event::Action;
use crate::mission::zone::{Shape, Zone, ZoneKind};

/// A zone is looked at in so many points along each side of the rectangle around it.
const POINTS_OF_A_SIDE: u32 = 60;
/// Of a task zone, so much may be forbidden at most.
const MOST_FORBIDDEN: f64 = 0.9;

pub(super) fn check(examined: &mut Examined<'_>) {
    let mission = examined.mission;
    for (zone, entry) in mission.zones.iter().zip(examined.entries("zones")) {
        shape(examined, zone, entry);
        let needs_radio = matches!(
            zone.kind,
            ZoneKind::RadioJam { .. } | ZoneKind::CommShadow(_)
        );
        if needs_radio && mission.radio.is_none() {
            let place = entry.get("kind").unwrap_or(entry).span();
            let kind = entry.word("kind").unwrap_or_default();
            let fault =
                format!("a `{kind}` needs the section `radio`: without it nothing is jammed");
            examined.add(place, fault);
        }
    }
    for objective in examined.entries("objectives") {
        forbidden(examined, objective);
    }
}

/// A polygon whose sides cross has an inside that nobody meant.
fn shape(examined: &mut Examined<'_>, zone: &Zone, entry: WrittenEntry<'_>) {
    let Shape::Polygon(corners) = &zone.shape else {
        return;
    };
    let Some((first, second)) = crossing(corners) else {
        return;
    };
    let place = entry.get("polygon").unwrap_or(entry).span();
    let side = |from: usize| format!("{} and {}", from + 1, (from + 1) % corners.len() + 1);
    let fault = format!(
        "the polygon crosses itself: its side between corners {} and that between corners {}",
        side(first),
        side(second)
    );
    examined.add(place, fault);
}

/// The first two sides that cross, each by the corner that it begins at.
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

/// The zone of an objective, where nobody may fly over nearly all of it for the whole mission.
fn forbidden(examined: &mut Examined<'_>, objective: WrittenEntry<'_>) {
    // What is to be protected is not flown to.
    let Some(entry) = objective.get("zone") else {
        return;
    };
    if objective.word("kind") == Some("protect") {
        return;
    }
    let mission = examined.mission;
    let mut zones = mission.zones.iter();
    let Some(zone) = zones.find(|zone| Some(zone.id.as_str()) == entry.text()) else {
        return;
    };
    let heights = objective
        .get("heights")
        .map_or(Vec::new(), WrittenEntry::numbers);
    let low_m = heights.first().copied().unwrap_or(0.0);
    let high_m = heights.get(1).copied().unwrap_or(f64::INFINITY);
    let high_m = high_m.min(examined.ceiling_m());
    let is_lifted = |place: usize| {
        let mut actions = mission.events.iter().flat_map(|event| &event.actions);
        actions.any(|action| matches!(action, Action::Zone(index, false) if *index == place))
    };
    let closes = |(place, other): &(usize, &Zone)| match other.kind {
        ZoneKind::NoFly { floor_m, ceiling_m } => {
            other.active && floor_m <= low_m && high_m <= ceiling_m && !is_lifted(*place)
        }
        _ => false,
    };
    let all = mission.zones.iter().enumerate();
    let closed: Vec<&Zone> = all.filter(closes).map(|(_, zone)| zone).collect();
    if share_within(&zone.shape, &closed) > MOST_FORBIDDEN {
        let names = closed.iter().map(|zone| format!("`{}`", zone.id));
        let fault = format!(
            "nobody may fly over more than nine tenths of the zone `{}`: {}",
            zone.id,
            names.collect::<Vec<_>>().join(", ")
        );
        examined.add(entry.span(), fault);
    }
}

/// Which share of a shape lies in one of the zones.
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
