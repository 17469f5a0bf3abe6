//! The sections that say where and with what: `sim`, `weather`, `rules`, `fleet`.

use std::time::Duration;

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeValue;

use super::Faults;
use crate::geo::LatLon;
use crate::mission::sensor::{SENSORS, Sensor};
use crate::mission::{Origin, Point, Wind};

/// More than a console can fly.
const MOST_VEHICLES: usize = 250;
const DEFAULT_MAX_HEIGHT_M: f64 = 120.0;
const DEFAULT_RESERVE_PERCENT: f64 = 20.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SimFile {
    time_limit: Spanned<f64>,
    origin: OriginFile,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OriginFile {
    lat: Spanned<f64>,
    lon: Spanned<f64>,
    alt: Spanned<f64>,
    heading: Option<Spanned<f64>>,
}

pub(super) fn sim(value: Spanned<DeValue<'_>>, faults: &mut Faults) -> Option<(Duration, Origin)> {
    let file: SimFile = faults.read_value(value)?;
    let limit_s = faults.number(
        &file.time_limit,
        super::SHORTEST_LIMIT.as_secs_f64()..=86_400.0,
        "time_limit",
    );
    let origin = Origin {
        at: LatLon::new(
            faults.number(&file.origin.lat, -85.0..=85.0, "lat"),
            faults.number(&file.origin.lon, -180.0..=180.0, "lon"),
        ),
        altitude_amsl_m: faults.number(&file.origin.alt, -500.0..=9000.0, "alt"),
        heading_deg: file.origin.heading.map_or(0.0, |heading| {
            faults.number(&heading, 0.0..=360.0, "heading")
        }),
    };
    super::seconds(limit_s).map(|limit| (limit, origin))
}

/// No wind.
pub(super) const CALM: Wind = Wind {
    speed_m_s: 0.0,
    from_deg: 0.0,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WeatherFile {
    wind: WindFile,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WindFile {
    speed: Spanned<f64>,
    dir: Spanned<f64>,
}

pub(super) fn weather(value: Spanned<DeValue<'_>>, faults: &mut Faults) -> Option<Wind> {
    let file: WeatherFile = faults.read_value(value)?;
    Some(Wind {
        speed_m_s: faults.number(&file.wind.speed, 0.0..=60.0, "speed"),
        from_deg: faults.number(&file.wind.dir, 0.0..=360.0, "dir"),
    })
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
struct RulesFile {
    max_agl: Option<Spanned<f64>>,
    land_reserve_pct: Option<Spanned<f64>>,
}

/// Highest height in metres and battery reserve in percent, with their defaults.
pub(super) fn rules(
    value: Option<Spanned<DeValue<'_>>>,
    faults: &mut Faults,
) -> Option<(f64, f64)> {
    let file: RulesFile = value.map_or_else(
        || Some(RulesFile::default()),
        |value| faults.read_value(value),
    )?;
    let height = file
        .max_agl
        .map(|height| faults.number(&height, 1.0..=10_000.0, "max_agl"));
    let reserve = file
        .land_reserve_pct
        .map(|percent| faults.number(&percent, 0.0..=100.0, "land_reserve_pct"));
    Some((
        height.unwrap_or(DEFAULT_MAX_HEIGHT_M),
        reserve.unwrap_or(DEFAULT_RESERVE_PERCENT),
    ))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FleetFile {
    max_vehicles: Spanned<usize>,
    pads: Spanned<Vec<Spanned<Point>>>,
    #[serde(default)]
    sensors: Vec<Spanned<String>>,
}

/// What flies, and from where.
pub(super) struct Fleet {
    pub pads: Vec<Point>,
    pub sensors: Vec<&'static Sensor>,
}

pub(super) fn fleet(value: Spanned<DeValue<'_>>, faults: &mut Faults) -> Option<Fleet> {
    let file: FleetFile = faults.read_value(value)?;
    let (count, pads) = (*file.max_vehicles.get_ref(), file.pads.get_ref());
    if !(1..=MOST_VEHICLES).contains(&count) {
        faults.add(
            file.max_vehicles.span(),
            format!("`max_vehicles` must lie between 1 and {MOST_VEHICLES}"),
        );
    } else if pads.len() != count {
        faults.add(
            file.pads.span(),
            format!("{count} vehicles need {count} pads, not {}", pads.len()),
        );
    }
    let mut sensors = Vec::new();
    for name in &file.sensors {
        match SENSORS.iter().find(|sensor| sensor.id == name.get_ref()) {
            Some(sensor) => sensors.push(sensor),
            None => faults.unknown("sensor", name, &SENSORS.each_ref().map(|sensor| sensor.id)),
        }
    }
    Some(Fleet {
        pads: pads.iter().map(|pad| faults.point(pad, "pads")).collect(),
        sensors,
    })
}
