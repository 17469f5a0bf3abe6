//! `[[zones]]`: a shape and a kind.

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeValue;

use super::{Draft, Faults, Section, by_kind, check_unique, kinded, take};
use crate::mission::Point;
use crate::mission::zone::{Shape, Zone, ZoneKind};

/// Corners of one polygon.
const MOST_CORNERS: usize = 1000;

/// What reads one zone after the other.
pub(super) fn reader<'i>() -> impl FnMut(Spanned<DeValue<'i>>, &mut Faults) -> Option<Zone> {
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
