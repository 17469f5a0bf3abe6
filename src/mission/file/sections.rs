//! The sections of a mission file, one function each.

use std::time::Duration;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{
    Draft, Faults, HEAD, SECTIONS, Section, by_kind, check_unique, kinded, objective, take,
};
use crate::diagnostic::Diagnostic;
use crate::geo::LatLon;
use crate::mission::hazard::{self, Hazard};
use crate::mission::objective::Objective;
use crate::mission::sensor::{SENSORS, Sensor};
use crate::mission::zone::{Shape, Zone, ZoneKind};
use crate::mission::{Hint, Mission, Origin, Phase, Point, Wind};
use crate::scoring::{Component, Gate, Medals, Rules, Weights};

/// The only version of the format so far.
const SCHEMA: u32 = 1;
/// More than a console can fly.
const MOST_VEHICLES: usize = 250;
/// Corners of one polygon.
const MOST_CORNERS: usize = 1000;

/// Reads all sections; `None` where one that is needed could not be read.
pub(super) fn mission(root: Section<'_>, faults: &mut Faults) -> Option<Mission> {
    let span = root.span();
    let mut root = root.into_inner();
    check_keys(&root, faults);
    let sections: Vec<_> = SECTIONS
        .iter()
        .map(|name| (*name, root.remove(*name)))
        .collect();
    let head = HEAD
        .iter()
        .filter_map(|name| root.remove_entry(*name))
        .collect();
    let head: Option<HeadFile> = faults.read(Spanned::new(span, head));
    let mut sections: std::collections::BTreeMap<_, _> = sections.into_iter().collect();
    let mut section = |name: &str| sections.remove(name).flatten();
    let mut needed = |name: &'static str, faults: &mut Faults| {
        let found = section(name);
        if found.is_none() {
            faults.add(0..0, format!("the section `{name}` is missing"));
        }
        found
    };
    let sim = needed("sim", faults).and_then(|value| sim(value, faults));
    let fleet = needed("fleet", faults).and_then(|value| fleet(value, faults));
    let goals = needed("objectives", faults);
    let scoring = needed("scoring", faults);
    let wind = section("weather").map_or(Some(CALM), |value| weather(value, faults));
    let rules = section("rules").map_or(Some((120.0, 20.0)), |value| rules(value, faults));
    let mut draft = Draft {
        zones: array(section("zones"), faults, zone_reader()),
        sensors: fleet
            .as_ref()
            .map_or(Vec::new(), |fleet| fleet.sensors.clone()),
        ..Draft::default()
    };
    let hazards: Vec<Box<dyn Hazard>> = hazards(section("hazards"), &draft, faults);
    let hints = array(section("hints"), faults, |value, faults| {
        faults.read_value::<HintFile>(value).map(Hint::from)
    });
    let objectives = objectives(goals, &mut draft, faults);
    let (sim, ids) = (
        sim?,
        objectives.iter().map(|o| o.id.clone()).collect::<Vec<_>>(),
    );
    let scoring = rules_of_scoring(scoring?, &ids, sim.0, faults)?;
    let (head, fleet, (max_height_m, land_reserve_percent)) =
        (head?.checked(faults), fleet?, rules?);
    Some(Mission {
        id: head.id.into_inner(),
        rev: head.rev,
        title: head.title.into_inner(),
        brief: head.brief,
        tier: head.tier,
        tags: head.tags,
        authors: head.authors,
        vehicles: fleet.pads.len(),
        time_limit: sim.0,
        hints,
        scoring,
        origin: sim.1,
        wind: wind?,
        pads: fleet.pads,
        sensors: fleet.sensors,
        zones: draft.zones,
        hazards,
        objectives,
        max_height_m,
        land_reserve_percent,
    })
}

/// Unknown keys on the top level.
fn check_keys(root: &DeTable<'_>, faults: &mut Faults) {
    let known = || HEAD.iter().chain(&SECTIONS).copied();
    for (key, _) in root {
        let name = key.get_ref().as_ref();
        if !known().any(|known| known == name) {
            let fault = Diagnostic::new(key.span(), format!("unknown key `{name}`"));
            faults.0.push(fault.with_nearest(name, known()));
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HeadFile {
    schema: Spanned<u32>,
    id: Spanned<String>,
    rev: u32,
    title: Spanned<String>,
    #[serde(default)]
    tier: u8,
    #[serde(default)]
    tags: Vec<String>,
    #[serde(default)]
    authors: Vec<String>,
    brief: String,
}

impl HeadFile {
    fn checked(self, faults: &mut Faults) -> Self {
        if *self.schema.get_ref() != SCHEMA {
            faults.add(
                self.schema.span(),
                format!("this program reads schema {SCHEMA} only"),
            );
        }
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        if self.id.get_ref().is_empty()
            || self.id.get_ref().len() > 40
            || !self.id.get_ref().chars().all(plain)
        {
            faults.add(
                self.id.span(),
                "a mission's id is 1 to 40 small letters, digits and `-`",
            );
        }
        if !(1..=60).contains(&self.title.get_ref().chars().count()) {
            faults.add(self.title.span(), "`title` must have 1 to 60 characters");
        }
        self
    }
}

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

fn sim(value: Spanned<DeValue<'_>>, faults: &mut Faults) -> Option<(Duration, Origin)> {
    let file: SimFile = faults.read_value(value)?;
    let limit_s = faults.number(&file.time_limit, 10.0..=86_400.0, "time_limit");
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
    seconds(limit_s).map(|limit| (limit, origin))
}

/// `None` for what is no length of time; the range check has said so already.
fn seconds(value: f64) -> Option<Duration> {
    Duration::try_from_secs_f64(value).ok()
}

const CALM: Wind = Wind {
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

fn weather(value: Spanned<DeValue<'_>>, faults: &mut Faults) -> Option<Wind> {
    let file: WeatherFile = faults.read_value(value)?;
    Some(Wind {
        speed_m_s: faults.number(&file.wind.speed, 0.0..=60.0, "speed"),
        from_deg: faults.number(&file.wind.dir, 0.0..=360.0, "dir"),
    })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RulesFile {
    max_agl: Option<Spanned<f64>>,
    land_reserve_pct: Option<Spanned<f64>>,
}

fn rules(value: Spanned<DeValue<'_>>, faults: &mut Faults) -> Option<(f64, f64)> {
    let file: RulesFile = faults.read_value(value)?;
    Some((
        file.max_agl.map_or(120.0, |height| {
            faults.number(&height, 1.0..=10_000.0, "max_agl")
        }),
        file.land_reserve_pct.map_or(20.0, |percent| {
            faults.number(&percent, 0.0..=100.0, "land_reserve_pct")
        }),
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

struct Fleet {
    pads: Vec<Point>,
    sensors: Vec<&'static Sensor>,
}

fn fleet(value: Spanned<DeValue<'_>>, faults: &mut Faults) -> Option<Fleet> {
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

/// Reads an array of tables; a missing one is empty.
fn array<'i, T>(
    value: Option<Spanned<DeValue<'i>>>,
    faults: &mut Faults,
    mut read: impl FnMut(Spanned<DeValue<'i>>, &mut Faults) -> Option<T>,
) -> Vec<T> {
    let Some(value) = value else {
        return Vec::new();
    };
    let span = value.span();
    let DeValue::Array(items) = value.into_inner() else {
        faults.add(span, "an array of tables is needed here, as in [[zones]]");
        return Vec::new();
    };
    items
        .into_iter()
        .filter_map(|item| read(item, faults))
        .collect()
}

fn zone_reader<'i>() -> impl FnMut(Spanned<DeValue<'i>>, &mut Faults) -> Option<Zone> {
    let mut seen = Vec::new();
    move |value, faults| {
        let mut section = kinded(value, faults)?;
        check_unique(&mut seen, &section.id, faults);
        let shape = shape(&mut section.rest, faults);
        let id = section.id.get_ref().clone();
        let kind = by_kind("zone", section, ZONE_KINDS, &Draft::default(), faults)?;
        Some(Zone {
            id,
            kind,
            shape: shape?,
        })
    }
}

const ZONE_KINDS: &[(&str, super::Reader<ZoneKind>)] = &[("task", task), ("geofence", geofence)];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TaskFile {}

fn task(section: Section<'_>, _: &Draft, faults: &mut Faults) -> Option<ZoneKind> {
    faults.read::<TaskFile>(section).map(|_| ZoneKind::Task)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GeofenceFile {
    ceiling: Option<Spanned<f64>>,
}

fn geofence(section: Section<'_>, _: &Draft, faults: &mut Faults) -> Option<ZoneKind> {
    let file: GeofenceFile = faults.read(section)?;
    Some(ZoneKind::Geofence {
        ceiling_m: file
            .ceiling
            .map(|ceiling| faults.number(&ceiling, 1.0..=10_000.0, "ceiling")),
    })
}

/// Takes a shape out of a zone: `polygon`, or `center` and `radius`.
fn shape(section: &mut Section<'_>, faults: &mut Faults) -> Option<Shape> {
    let span = section.span();
    let table = section.get_mut();
    let circle = table.contains_key("center") || table.contains_key("radius");
    if circle == table.contains_key("polygon") {
        faults.add(
            span,
            "a zone has either `polygon`, or `center` and `radius`",
        );
        return None;
    }
    if circle {
        let center = take::<Spanned<Point>>(table, "center", &span, faults);
        let radius = take::<Spanned<f64>>(table, "radius", &span, faults);
        let (center, radius) = (center?, radius?);
        return Some(Shape::Circle {
            center: faults.point(&center, "center"),
            radius_m: faults.number(&radius, 0.1..=super::POINT_RANGE, "radius"),
        });
    }
    let corners: Spanned<Vec<Spanned<Point>>> = take(table, "polygon", &span, faults)?;
    if !(3..=MOST_CORNERS).contains(&corners.get_ref().len()) {
        faults.add(
            corners.span(),
            format!("a polygon has 3 to {MOST_CORNERS} corners"),
        );
        return None;
    }
    Some(Shape::Polygon(
        corners
            .get_ref()
            .iter()
            .map(|corner| faults.point(corner, "polygon"))
            .collect(),
    ))
}

fn hazards(
    value: Option<Spanned<DeValue<'_>>>,
    draft: &Draft,
    faults: &mut Faults,
) -> Vec<Box<dyn Hazard>> {
    let mut seen = Vec::new();
    array(value, faults, |value, faults| {
        let section = kinded(value, faults)?;
        check_unique(&mut seen, &section.id, faults);
        by_kind("hazard", section, hazard::KINDS, draft, faults)
    })
}

fn objectives(
    value: Option<Spanned<DeValue<'_>>>,
    draft: &mut Draft,
    faults: &mut Faults,
) -> Vec<Objective> {
    let place = value.as_ref().map(Spanned::span);
    let before = faults.0.len();
    let mut seen = Vec::new();
    let objectives = array(value, faults, |value, faults| {
        objective(value, draft, &mut seen, faults)
    });
    let none_mandatory = !objectives.iter().any(|objective| objective.mandatory);
    if let Some(place) = place.filter(|_| none_mandatory && faults.0.len() == before) {
        faults.add(
            place,
            "at least one objective must be `mandatory`, or the mission can never be passed",
        );
    }
    objectives
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HintFile {
    phase: Phase,
    text: String,
}

impl From<HintFile> for Hint {
    fn from(file: HintFile) -> Self {
        Self {
            phase: file.phase,
            text: file.text,
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScoringFile {
    weights: Option<Spanned<WeightsFile>>,
    par: ParFile,
    medals: Option<Spanned<MedalsFile>>,
    #[serde(default)]
    gold_requires: Vec<Spanned<String>>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
struct WeightsFile {
    objective: f64,
    quality: f64,
    time: f64,
    energy: f64,
    safety: f64,
    command: f64,
    attention: f64,
    utilisation: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ParFile {
    time: Spanned<f64>,
    energy_wh: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MedalsFile {
    gold: u16,
    silver: u16,
    bronze: u16,
}

fn rules_of_scoring(
    value: Spanned<DeValue<'_>>,
    objectives: &[String],
    time_limit: Duration,
    faults: &mut Faults,
) -> Option<Rules> {
    let file: ScoringFile = faults.read_value(value)?;
    let par_s = faults.number(&file.par.time, 1.0..=86_400.0, "time");
    if par_s >= time_limit.as_secs_f64() {
        faults.add(
            file.par.time.span(),
            "the par time must be shorter than `time_limit`",
        );
    }
    let names = || {
        Component::ALL
            .map(Component::name)
            .into_iter()
            .chain(["crashes"])
            .chain(objectives.iter().map(String::as_str))
    };
    let mut gold_requires = Vec::new();
    for text in &file.gold_requires {
        match Gate::parse(text.get_ref()) {
            Ok(gate) if names().any(|name| name == gate.name()) => gold_requires.push(gate),
            Ok(gate) => {
                let fault = Diagnostic::new(
                    text.span(),
                    format!("unknown name `{}` in a gate", gate.name()),
                );
                faults.0.push(fault.with_nearest(gate.name(), names()));
            }
            Err(reason) => faults.add(text.span(), reason),
        }
    }
    Some(Rules {
        weights: file
            .weights
            .map_or_else(Weights::default, |weights| weights_of(&weights, faults)),
        par_time: seconds(par_s)?,
        par_energy_wh: faults.number(&file.par.energy_wh, 0.01..=1e6, "energy_wh"),
        time_limit,
        medals: medals(file.medals.as_ref(), faults),
        gold_requires,
    })
}

fn weights_of(file: &Spanned<WeightsFile>, faults: &mut Faults) -> Weights {
    let w = file.get_ref();
    let all = [
        w.objective,
        w.quality,
        w.time,
        w.energy,
        w.safety,
        w.command,
        w.attention,
        w.utilisation,
    ];
    let sum: f64 = all.iter().sum();
    if !all.iter().all(|weight| (0.0..=1.0).contains(weight)) {
        faults.add(file.span(), "every weight must lie between 0 and 1");
    } else if (sum - 1.0).abs() > 1e-6 {
        faults.add(
            file.span(),
            format!("the weights must sum to 1, not {sum:.3}"),
        );
    }
    Weights(all)
}

fn medals(file: Option<&Spanned<MedalsFile>>, faults: &mut Faults) -> Medals {
    let Some(file) = file else {
        return Medals {
            gold: 850,
            silver: 700,
            bronze: 550,
        };
    };
    let &MedalsFile {
        gold,
        silver,
        bronze,
    } = file.get_ref();
    if !(bronze < silver && silver < gold && gold <= 1000) {
        faults.add(
            file.span(),
            "medals must rise from bronze to gold, 1000 at most",
        );
    }
    Medals {
        gold,
        silver,
        bronze,
    }
}
