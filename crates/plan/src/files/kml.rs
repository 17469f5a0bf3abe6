//! KML 2.2: placemarks with points, lines, rings, polygons and tracks.
//!
//! In shapes from other programs, `altitudeMode` determines the meaning of heights: above sea level
//! (`absolute`), above the ground (`relativeToGround`), or none.

use std::fmt::Write as _;

use super::number::words;
use super::shapes::{self, Feature, Geometry, Heights, Outline, Position, Shape, Spot};
use super::{Parsed, ReadOptions};
use crate::Document;
use crate::fault::{Expected, Fault, FaultKind};

mod element;

use element::Element;

pub(super) fn parse(text: &str, options: ReadOptions) -> Result<Parsed, Vec<Fault>> {
    let root = element::parse(text).map_err(|fault| vec![fault])?;
    let mut placemarks = Vec::new();
    root.find_all("Placemark", &mut placemarks);
    let mut features = Vec::new();
    let mut faults = Vec::new();
    for placemark in placemarks {
        match feature(placemark) {
            Ok(feature) => features.push(feature),
            Err(fault) => faults.push(fault),
        }
    }
    if faults.is_empty() {
        shapes::document(&features, options)
    } else {
        Err(faults)
    }
}

fn feature(placemark: &Element) -> Result<Feature, Fault> {
    let mut shapes = Vec::new();
    for child in &placemark.children {
        add_shapes(child, &mut shapes)?;
    }
    let mut data = Vec::new();
    if let Some(extended) = placemark.child("ExtendedData") {
        extended.find_all("Data", &mut data);
    }
    let data = data.into_iter().filter_map(|it| {
        let value = it.child("value")?;
        let text = value.text.trim().to_owned();
        Some((it.label.clone()?, (text, value.text_span())))
    });
    Ok(Feature {
        shapes,
        data: data.collect(),
        span: placemark.span.clone(),
    })
}

fn add_shapes(element: &Element, shapes: &mut Vec<Shape>) -> Result<(), Fault> {
    let geometry = match element.name.as_str() {
        "MultiGeometry" | "MultiTrack" => {
            return element
                .children
                .iter()
                .try_for_each(|child| add_shapes(child, shapes));
        }
        "Point" => {
            let points = coordinates(element)?;
            let [only] = points.as_slice() else {
                let fault = FaultKind::Expected(Expected::Position);
                return Err(Fault::new(element.span.clone(), fault));
            };
            Geometry::Point(*only)
        }
        "LineString" => Geometry::Line(coordinates(element)?),
        "LinearRing" => Geometry::Polygon(vec![coordinates(element)?]),
        "Polygon" => {
            let mut rings = Vec::new();
            for border in ["outerBoundaryIs", "innerBoundaryIs"] {
                for child in element.children.iter().filter(|child| child.name == border) {
                    let mut found = Vec::new();
                    child.find_all("LinearRing", &mut found);
                    for ring in found {
                        rings.push(coordinates(ring)?);
                    }
                }
            }
            Geometry::Polygon(rings)
        }
        "Track" => Geometry::Line(track(element)?),
        _ => return Ok(()),
    };
    let mode = element
        .child("altitudeMode")
        .map_or("", |mode| mode.text.trim());
    shapes.push(Shape {
        geometry,
        heights: match mode {
            "absolute" => Heights::SeaLevel,
            "relativeToGround" => Heights::Terrain,
            _ => Heights::Unset,
        },
        span: element.span.clone(),
    });
    Ok(())
}

/// The places in an element: `longitude,latitude,height`, separated by white space.
fn coordinates(element: &Element) -> Result<Vec<Position>, Fault> {
    let Some(list) = element.child("coordinates") else {
        return Err(Fault::new(
            element.span.clone(),
            FaultKind::Missing("coordinates"),
        ));
    };
    let found = words(&list.text, list.text_at);
    found
        .into_iter()
        .map(|word| {
            let numbers: Option<Vec<f64>> =
                word.text.split(',').map(|part| part.parse().ok()).collect();
            numbers
                .and_then(|numbers| position(&numbers))
                .ok_or_else(|| Fault::new(word.span(), FaultKind::Expected(Expected::Position)))
        })
        .collect()
}

/// The places of a track: each in its own element, with numbers separated by spaces.
fn track(element: &Element) -> Result<Vec<Position>, Fault> {
    let points = element
        .children
        .iter()
        .filter(|child| child.name == "coord");
    points
        .map(|point| {
            let parts = words(&point.text, point.text_at);
            let numbers: Option<Vec<f64>> = parts.iter().map(|part| part.number().ok()).collect();
            numbers
                .and_then(|numbers| position(&numbers))
                .ok_or_else(|| {
                    Fault::new(point.text_span(), FaultKind::Expected(Expected::Position))
                })
        })
        .collect()
}

fn position(numbers: &[f64]) -> Option<Position> {
    let (lon, lat, height_m) = match numbers {
        [lon, lat] => (lon, lat, None),
        [lon, lat, height_m] => (lon, lat, Some(*height_m)),
        _ => return None,
    };
    Some(Position {
        lat: *lat,
        lon: *lon,
        height_m,
    })
}

/// Writes all lists as one KML document.
pub(super) fn write(document: &Document) -> String {
    let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
                    <kml xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document>\n"
        .to_owned();
    for feature in shapes::features(document) {
        // Writing to a string cannot fail. All names are our own, so nothing needs to be escaped.
        let _ = write!(
            text,
            "<Placemark><name>{}</name><ExtendedData>",
            feature.name
        );
        for (key, datum) in &feature.data {
            let _ = write!(text, "<Data name=\"{key}\"><value>{datum}</value></Data>");
        }
        text.push_str("</ExtendedData>");
        match &feature.outline {
            Outline::Nothing => {}
            Outline::Point(spot) => {
                let _ = write!(text, "<Point>{}</Point>", list(std::slice::from_ref(spot)));
            }
            Outline::Line(spots) => {
                let _ = write!(
                    text,
                    "<LineString><tessellate>1</tessellate>{}</LineString>",
                    list(spots)
                );
            }
            Outline::Ring(spots) => {
                let closed: Vec<Spot> = spots.iter().chain(spots.first()).copied().collect();
                let _ = write!(
                    text,
                    "<Polygon><outerBoundaryIs><LinearRing>{}</LinearRing></outerBoundaryIs></Polygon>",
                    list(&closed)
                );
            }
        }
        text.push_str("</Placemark>\n");
    }
    text.push_str("</Document>\n</kml>\n");
    text
}

fn list(spots: &[Spot]) -> String {
    let places: Vec<String> = spots.iter().map(|spot| spot.words().join(",")).collect();
    format!("<coordinates>{}</coordinates>", places.join(" "))
}
