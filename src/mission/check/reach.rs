//! Whether the objectives can be met: with the equipment of the vehicles, and in the time allowed.

use std::ops::Range;
use std::time::Duration;

use super::{Examined, ExaminedObjective};
use crate::mission::event::Trigger;
use crate::mission::objective::GateRoute;
use crate::mission::report::distance_m;
use crate::mission::{Mission, Point};
use crate::text;

/// The greatest speed assumed between two places.
const SPEED_M_S: f64 = 10.0;

pub(super) fn check(examined: &mut Examined<'_>) {
    for objective in examined.objectives() {
        equipment(examined, &objective);
        time(examined, &objective);
    }
    let limit = examined.mission.rules.time_limit;
    let events = examined.mission.events.iter();
    for (event, written) in events.zip(examined.tables("events")) {
        if matches!(event.trigger, Trigger::At(at) if at >= limit) {
            examined.add(written.span_of("at"), text!("check-event-late"));
        }
    }
}

/// Reports equipment that an objective needs and no vehicle carries.
fn equipment(examined: &mut Examined<'_>, objective: &ExaminedObjective<'_>) {
    let Some(demanded) = objective.demands.equipment else {
        return;
    };
    if !demanded.equipment.is_carried(&examined.mission.seats.fits) {
        let place = objective.written.span_of(demanded.key);
        examined.add(place, demanded.equipment.missing());
    }
}

/// Reports objectives that take longer than the time allowed, even on the shortest path and without delay.
fn time(examined: &mut Examined<'_>, objective: &ExaminedObjective<'_>) {
    let limit = examined.mission.rules.time_limit;
    let limit_s = limit.as_secs();
    for demanded in &objective.demands.times {
        if demanded.time >= limit {
            let place = objective.written.span_of(demanded.key);
            examined.add(place, text!("check-too-long", limit = limit_s));
        }
    }
    let Some(least) = LeastTime::of(examined.mission, objective) else {
        return;
    };
    if least.time >= limit {
        let fault = text!(
            "check-too-far",
            speed = SPEED_M_S.to_string(),
            needed = least.time.as_secs(),
            limit = limit_s
        );
        examined.add(least.place, fault);
    }
}

/// The minimum time that an objective takes, and the activity that takes it.
struct LeastTime {
    time: Duration,
    place: Range<usize>,
}

impl LeastTime {
    fn of(mission: &Mission, objective: &ExaminedObjective<'_>) -> Option<Self> {
        let demands = &objective.demands;
        let place = |key| objective.written.span_of(key);
        // The vehicles share the work.
        let vehicles = u32::try_from(mission.seats.count.max(1)).unwrap_or(u32::MAX);
        let staying = demands.staying / vehicles;
        if let Some(route) = demands.route {
            return Some(Self {
                time: flown(along_m(mission, route)?),
                place: place("gates"),
            });
        }
        if let Some(places) = &demands.places {
            let ways = places.all.iter().map(|to| from_pads_m(mission, to.at));
            return Some(Self {
                time: staying.max(flown(ways.fold(0.0, f64::max))),
                place: place(places.key),
            });
        }
        let zone = demands.zone?;
        let ways = mission
            .seats
            .pads
            .iter()
            .map(|&pad| zone.shape.distance_m(pad));
        let way = flown(ways.fold(f64::INFINITY, f64::min));
        Some(Self {
            time: way.saturating_add(staying),
            place: place("zone"),
        })
    }
}

/// The length of the shortest path from a pad through all gates, in metres; `None` without gates.
fn along_m(mission: &Mission, route: &GateRoute) -> Option<f64> {
    let gates = route.gates().iter();
    let points: Vec<Point> = gates
        .map(|&[east_m, north_m, _]| [east_m, north_m])
        .collect();
    let legs = points.iter().zip(points.iter().skip(1));
    let between_m: f64 = legs.map(|(&from, &to)| distance_m(from, to)).sum();
    let slack_m = route.slack_m() * 2.0 * points.len() as f64;
    Some(from_pads_m(mission, *points.first()?) + between_m - slack_m)
}

/// The distance from the nearest pad, in metres.
fn from_pads_m(mission: &Mission, at: Point) -> f64 {
    let ways = mission.seats.pads.iter().map(|&pad| distance_m(pad, at));
    ways.fold(f64::INFINITY, f64::min)
}

fn flown(way_m: f64) -> Duration {
    Duration::try_from_secs_f64(way_m.max(0.0) / SPEED_M_S).unwrap_or(Duration::MAX)
}
