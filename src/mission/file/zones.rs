//! `[[zones]]`: a shape and a kind.

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeValue;

use super::{Draft, Faults, Section, by_kind, check_unique, kinded, take, take_optional};
use crate::mission::Point;
use crate::mission::zone::{Shadow, Shape, Zone, ZoneKind};

/// Zones without a ceiling reach up to here.
const HIGHEST_M: f64 = 10_000.0;
/// Corners of one polygon.
const MOST_CORNERS: usize = 1000;

/// What reads one zone after the other.
pub(super) fn reader<'i>() -> impl FnMut(Spanned<DeValue<'i>>, &mut Faults) -> Option<Zone> {
    let mut seen = Vec::new();
    move |value, faults| {
        let mut section = kinded(value, faults)?;
        check_unique(&mut seen, &section.id, faults);
        let shape = shape(&mut section.rest, faults);
        let active = take_optional::<bool>(section.rest.get_mut(), "active", faults);
        let jitter: Option<Spanned<f64>> = take_optional(section.rest.get_mut(), "jitter", faults);
        let id = section.id.get_ref().clone();
        let kind = by_kind("zone", section, ZONE_KINDS, &Draft::default(), faults)?;
        if let Some(jitter) = jitter.as_ref().filter(|_| is_fixed(kind)) {
            let message = "objectives and rules go by this zone: the seed cannot move it";
            faults.add(jitter.span(), message);
        }
        Some(Zone {
            id,
            kind,
            shape: shape?,
            active: active.unwrap_or(true),
            jitter_m: jitter.map_or(0.0, |jitter| faults.number(&jitter, 0.0..=1000.0, "jitter")),
        })
    }
}

/// Whether it lies where the file says with every seed: objectives and hazards are made for the place.
fn is_fixed(kind: ZoneKind) -> bool {
    matches!(kind, ZoneKind::Task | ZoneKind::Geofence { .. })
}

/// The names of all kinds.
pub(in crate::mission) fn zone_kinds() -> impl Iterator<Item = &'static str> {
    ZONE_KINDS.iter().map(|(name, _)| *name)
}

const ZONE_KINDS: &[(&str, super::Reader<ZoneKind>)] = &[
    ("task", task),
    ("geofence", geofence),
    ("no_fly", no_fly),
    ("gnss_jam", gnss_jam),
    ("gnss_glitch", gnss_glitch),
    ("people", people),
    ("radio_jam", radio_jam),
    ("comm_shadow", comm_shadow),
];

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
            .map(|ceiling| faults.number(&ceiling, 1.0..=HIGHEST_M, "ceiling")),
    })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NoFlyFile {
    floor: Option<Spanned<f64>>,
    ceiling: Option<Spanned<f64>>,
}

fn no_fly(section: Section<'_>, _: &Draft, faults: &mut Faults) -> Option<ZoneKind> {
    let span = section.span();
    let file: NoFlyFile = faults.read(section)?;
    let mut height = |value: Option<Spanned<f64>>, name, otherwise| {
        value.map_or(otherwise, |value| {
            faults.number(&value, 0.0..=HIGHEST_M, name)
        })
    };
    let floor_m = height(file.floor, "floor", 0.0);
    let ceiling_m = height(file.ceiling, "ceiling", HIGHEST_M);
    if floor_m >= ceiling_m {
        faults.add(span, "the `floor` must lie below the `ceiling`");
    }
    Some(ZoneKind::NoFly { floor_m, ceiling_m })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GnssJamFile {
    edge: Option<Spanned<f64>>,
}

fn gnss_jam(section: Section<'_>, _: &Draft, faults: &mut Faults) -> Option<ZoneKind> {
    let file: GnssJamFile = faults.read(section)?;
    let edge_m = edge(file.edge, faults);
    Some(ZoneKind::GnssJam { edge_m })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GnssGlitchFile {
    offset: Spanned<Point>,
}

fn gnss_glitch(section: Section<'_>, _: &Draft, faults: &mut Faults) -> Option<ZoneKind> {
    let file: GnssGlitchFile = faults.read(section)?;
    let offset_m = faults.point(&file.offset, "offset");
    Some(ZoneKind::GnssGlitch { offset_m })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PeopleFile {
    below: Spanned<f64>,
}

fn people(section: Section<'_>, _: &Draft, faults: &mut Faults) -> Option<ZoneKind> {
    let file: PeopleFile = faults.read(section)?;
    let below_m = faults.number(&file.below, 1.0..=1000.0, "below");
    Some(ZoneKind::People { below_m })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RadioJamFile {
    noise: Spanned<f64>,
    edge: Option<Spanned<f64>>,
}

fn radio_jam(section: Section<'_>, _: &Draft, faults: &mut Faults) -> Option<ZoneKind> {
    let file: RadioJamFile = faults.read(section)?;
    let noise_db = faults.number(&file.noise, 0.0..=100.0, "noise");
    let edge_m = edge(file.edge, faults);
    Some(ZoneKind::RadioJam { noise_db, edge_m })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CommShadowFile {
    height: Option<Spanned<f64>>,
    loss: Option<Spanned<f64>>,
}

fn comm_shadow(section: Section<'_>, _: &Draft, faults: &mut Faults) -> Option<ZoneKind> {
    let span = section.span();
    let file: CommShadowFile = faults.read(section)?;
    let shadow = match (file.height, file.loss) {
        (Some(height), None) => Shadow::Ridge {
            height_m: faults.number(&height, 1.0..=5000.0, "height"),
        },
        (None, Some(loss)) => Shadow::Inside {
            loss_db: faults.number(&loss, 0.0..=200.0, "loss"),
        },
        _ => {
            let message = "a `comm_shadow` has either the `height` of a ridge in m, or the `loss` \
                           of who is in it in dB";
            faults.add(span, message);
            return None;
        }
    };
    Some(ZoneKind::CommShadow(shadow))
}

/// How far around a zone its effect can be felt.
fn edge(value: Option<Spanned<f64>>, faults: &mut Faults) -> f64 {
    value.map_or(0.0, |edge| faults.number(&edge, 0.0..=1000.0, "edge"))
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
        for key in ["polygon", "center", "radius"] {
            table.remove(key);
        }
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
