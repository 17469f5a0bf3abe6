//! Whether what is asked for can be done: by what the vehicles carry, and in the time that there is.

use std::time::Duration;

use super::{Examined, WrittenEntry};
use crate::mission::Point;
use crate::mission::ground_truth::Load;
use crate::mission::report::distance_m;
use crate::mission::sensor::Sensor;

/// Nobody flies faster from one place to the next.
const SPEED_M_S: f64 = 10.0;

pub(super) fn check(examined: &mut Examined<'_>) {
    for objective in examined.entries("objectives") {
        means(examined, objective);
        time(examined, objective);
    }
    let limit = examined.mission.time_limit;
    for event in examined.entries("events") {
        if event.seconds("at").is_some_and(|at| at >= limit) {
            let place = event.get("at").unwrap_or(event).span();
            examined.add(place, "the mission is over before this happens");
        }
    }
}

/// What an objective needs and nobody carries.
fn means(examined: &mut Examined<'_>, objective: WrittenEntry<'_>) {
    let mission = examined.mission;
    let carries = |loads: &[Load]| {
        let mut fits = mission.fits.iter();
        fits.any(|fit| loads.iter().any(|load| fit.loads.contains_key(load)))
    };
    let any = |wanted: fn(&Sensor) -> bool| mission.sensors.iter().any(|sensor| wanted(sensor));
    let kind = objective.word("kind").unwrap_or_default();
    let missing = match kind {
        "deliver" => match objective.word("load") {
            Some("kit") => (!carries(&[Load::Kit])).then_some("a `kit`"),
            Some("node") => (!carries(&[Load::Node])).then_some("a `node`"),
            _ => None,
        },
        "contain" => (!carries(&[Load::Ball, Load::Spray])).then_some("a `ball` or `spray`"),
        "detect" => {
            (!any(|sensor| sensor.detector().is_some())).then_some("a sensor that finds things")
        }
        "locate" => mission.sensors.is_empty().then_some("a sensor"),
        _ => None,
    };
    if let Some(missing) = missing {
        let place = objective.get("load").or_else(|| objective.get("kind"));
        let place = place.unwrap_or(objective).span();
        examined.add(place, format!("no vehicle carries {missing}"));
    }
}

/// What takes longer than there is time, on the straightest way and without any delay.
fn time(examined: &mut Examined<'_>, objective: WrittenEntry<'_>) {
    let limit = examined.mission.time_limit;
    for key in ["within", "time", "dwell"] {
        // The `within` of most kinds is a distance.
        let is_time = key != "within" || objective.word("kind") == Some("arm_time");
        let needed = objective.seconds(key).filter(|_| is_time);
        if needed.is_some_and(|needed| needed >= limit) {
            let place = objective.get(key).unwrap_or(objective).span();
            let limit_s = limit.as_secs();
            examined.add(place, format!("there are {limit_s} s only"));
        }
    }
    let Some((entry, needed)) = needed(examined, objective) else {
        return;
    };
    if needed >= limit {
        let fault = format!(
            "at {SPEED_M_S} m/s in straight lines this takes {} s, and there are {} s",
            needed.as_secs(),
            limit.as_secs()
        );
        examined.add(entry.span(), fault);
    }
}

/// The least time that an objective takes, with what takes it.
fn needed<'m>(
    examined: &Examined<'m>,
    objective: WrittenEntry<'m>,
) -> Option<(WrittenEntry<'m>, Duration)> {
    let mission = examined.mission;
    let from_pads = |at: Point| {
        let ways = mission.pads.iter().map(|&pad| distance_m(pad, at));
        ways.fold(f64::INFINITY, f64::min)
    };
    let vehicles = mission.vehicles as f64;
    if let Some(gates) = objective.get("gates") {
        let gates_at = gates.items().into_iter().map(WrittenEntry::numbers);
        let points = gates_at.filter_map(|gate| Some([*gate.first()?, *gate.get(1)?]));
        let points: Vec<Point> = points.collect();
        let legs = points.iter().zip(points.iter().skip(1));
        let between: f64 = legs.map(|(&from, &to)| distance_m(from, to)).sum();
        let radius_m = objective.get("radius").and_then(WrittenEntry::number)?;
        // Each gate may be cut by its radius and stand nearer by its jitter.
        let slack_m = radius_m
            + objective
                .get("jitter")
                .and_then(WrittenEntry::number)
                .unwrap_or(0.0);
        let way_m = from_pads(*points.first()?) + between - slack_m * 2.0 * points.len() as f64;
        return Some((gates, flown(way_m)));
    }
    if let Some(places) = objective.get("places") {
        let names = places.items();
        let points = names.iter().filter_map(|name| examined.place(name.text()?));
        let farthest_m = points.map(from_pads).fold(0.0, f64::max);
        let dwell_s = objective.get("dwell").and_then(WrittenEntry::number);
        let dwelling_s = dwell_s.unwrap_or(0.0) * names.len() as f64 / vehicles;
        let dwelling = Duration::try_from_secs_f64(dwelling_s).ok()?;
        return Some((places, dwelling.max(flown(farthest_m))));
    }
    let entry = objective.get("zone")?;
    let mut zones = mission.zones.iter();
    let zone = zones.find(|zone| Some(zone.id.as_str()) == entry.text())?;
    let ways = mission.pads.iter().map(|&pad| zone.shape.distance_m(pad));
    let way = flown(ways.fold(f64::INFINITY, f64::min));
    // Cells are stayed in one after the other.
    let cells = objective.get("target").and_then(WrittenEntry::number);
    let dwell_s = objective.get("dwell").and_then(WrittenEntry::number);
    let staying_s = cells.zip(dwell_s).map_or(0.0, |(cells, s)| cells * s);
    let staying = Duration::try_from_secs_f64(staying_s / vehicles).ok()?;
    Some((entry, way + staying))
}

fn flown(way_m: f64) -> Duration {
    Duration::try_from_secs_f64(way_m.max(0.0) / SPEED_M_S).unwrap_or(Duration::MAX)
}
