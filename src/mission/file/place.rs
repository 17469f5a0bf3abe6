//! The sections that say where, in what weather and by which rules: `sim`, `weather`, `rules`.

use std::time::Duration;

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeValue;

use super::Faults;
use crate::geo::LatLon;
use crate::mission::Origin;
use crate::mission::weather::{Light, Weather, Wind};

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

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WeatherFile {
    wind: Option<WindFile>,
    gust: Option<Spanned<f64>>,
    temp_c: Option<Spanned<f64>>,
    #[serde(default)]
    light: Light,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WindFile {
    speed: Spanned<f64>,
    dir: Spanned<f64>,
}

pub(super) fn weather(value: Spanned<DeValue<'_>>, faults: &mut Faults) -> Option<Weather> {
    let file: WeatherFile = faults.read_value(value)?;
    let calm = Weather::CALM;
    Some(Weather {
        wind: file.wind.map_or(calm.wind, |wind| Wind {
            speed_m_s: faults.number(&wind.speed, 0.0..=60.0, "speed"),
            from_deg: faults.number(&wind.dir, 0.0..=360.0, "dir"),
        }),
        gust_m_s: file.gust.map_or(calm.gust_m_s, |gust| {
            faults.number(&gust, 0.0..=20.0, "gust")
        }),
        temperature_c: file.temp_c.map_or(calm.temperature_c, |temperature| {
            faults.number(&temperature, -40.0..=60.0, "temp_c")
        }),
        light: file.light,
    })
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
struct RulesFile {
    max_agl: Option<Spanned<f64>>,
    land_reserve_pct: Option<Spanned<f64>>,
    min_separation: Option<Spanned<f64>>,
    pause: Option<bool>,
}

/// What everybody has to keep to.
pub(super) struct RuleSet {
    pub max_height_m: f64,
    pub land_reserve_percent: f64,
    pub separation_m: Option<f64>,
    pub pausable: bool,
}

/// The rules, with their defaults.
pub(super) fn rules(value: Option<Spanned<DeValue<'_>>>, faults: &mut Faults) -> Option<RuleSet> {
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
    let separation = file
        .min_separation
        .map(|metres| faults.number(&metres, 0.0..=1000.0, "min_separation"));
    Some(RuleSet {
        max_height_m: height.unwrap_or(DEFAULT_MAX_HEIGHT_M),
        land_reserve_percent: reserve.unwrap_or(DEFAULT_RESERVE_PERCENT),
        separation_m: separation,
        pausable: file.pause.unwrap_or(true),
    })
}
