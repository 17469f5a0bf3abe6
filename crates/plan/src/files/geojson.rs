//! `GeoJSON` (RFC 7946). In shapes from other programs, heights are above sea level.

use std::collections::BTreeMap;

use serde_json::{Map, Value as Json, json};

use super::json::{Node, Value};
use super::shapes::{
    self, Datum, Drawn, Feature, Geometry, Heights, Outline, Position, Shape, Spot,
};
use super::{Parsed, ReadOptions, qgc};
use crate::Document;
use crate::fault::{Expected, Fault, FaultKind, Unwritable};

const TYPES: &str = "FeatureCollection, Feature, Point, MultiPoint, LineString, MultiLineString, Polygon, \
                     MultiPolygon, GeometryCollection";

pub(super) fn parse(root: &Node, options: ReadOptions) -> Result<Parsed, Vec<Fault>> {
    let features = features(root).map_err(|fault| vec![fault])?;
    shapes::document(&features, options)
}

fn features(root: &Node) -> Result<Vec<Feature>, Fault> {
    match root.need("type")?.text()? {
        "FeatureCollection" => root.need("features")?.list()?.iter().map(feature).collect(),
        "Feature" => Ok(vec![feature(root)?]),
        _ => Ok(vec![Feature {
            shapes: shapes_of(root)?,
            data: BTreeMap::new(),
            span: root.span.clone(),
        }]),
    }
}

fn feature(node: &Node) -> Result<Feature, Fault> {
    let geometry = node.need("geometry")?;
    let shapes = if matches!(geometry.value, Value::Null) {
        Vec::new()
    } else {
        shapes_of(geometry)?
    };
    let fields = match node.get("properties").map(|it| &it.value) {
        Some(Value::Object(fields)) => fields.as_slice(),
        _ => &[],
    };
    let datum = |(key, node): &(String, Node)| {
        let written = match &node.value {
            Value::Null => "nan".to_owned(),
            Value::Flag(flag) => flag.to_string(),
            Value::Number(number) => number.to_string(),
            Value::Text(text) => text.clone(),
            Value::List(_) | Value::Object(_) => return None,
        };
        Some((key.clone(), (written, node.span.clone())))
    };
    Ok(Feature {
        shapes,
        data: fields.iter().filter_map(datum).collect(),
        span: node.span.clone(),
    })
}

fn shapes_of(node: &Node) -> Result<Vec<Shape>, Fault> {
    let kind = node.need("type")?;
    let name = kind.text()?;
    if name == "GeometryCollection" {
        let parts = node.need("geometries")?.list()?.iter().map(shapes_of);
        return Ok(parts.collect::<Result<Vec<_>, _>>()?.concat());
    }
    let coordinates = node.need("coordinates")?;
    let geometries = match name {
        "Point" => vec![Geometry::Point(position(coordinates)?)],
        "MultiPoint" => positions(coordinates)?
            .into_iter()
            .map(Geometry::Point)
            .collect(),
        "LineString" => vec![Geometry::Line(positions(coordinates)?)],
        "MultiLineString" => rings(coordinates)?
            .into_iter()
            .map(Geometry::Line)
            .collect(),
        "Polygon" => vec![Geometry::Polygon(rings(coordinates)?)],
        "MultiPolygon" => {
            let polygons = coordinates.list()?.iter();
            polygons
                .map(|it| rings(it).map(Geometry::Polygon))
                .collect::<Result<_, _>>()?
        }
        _ => {
            let fault = FaultKind::Expected(Expected::Word(TYPES));
            return Err(Fault::new(kind.span.clone(), fault));
        }
    };
    let shape = |geometry| Shape {
        geometry,
        heights: Heights::SeaLevel,
        span: coordinates.span.clone(),
    };
    Ok(geometries.into_iter().map(shape).collect())
}

fn rings(node: &Node) -> Result<Vec<Vec<Position>>, Fault> {
    node.list()?.iter().map(positions).collect()
}

fn positions(node: &Node) -> Result<Vec<Position>, Fault> {
    node.list()?.iter().map(position).collect()
}

fn position(node: &Node) -> Result<Position, Fault> {
    let [lon, lat, further @ ..] = node.list()? else {
        let fault = FaultKind::Expected(Expected::Position);
        return Err(Fault::new(node.span.clone(), fault));
    };
    Ok(Position {
        lat: lat.number()?,
        lon: lon.number()?,
        height_m: further.first().map(Node::number).transpose()?,
    })
}

/// Writes all lists.
///
/// # Errors
/// A number is infinite.
pub(super) fn write(document: &Document) -> Result<String, Unwritable> {
    qgc::refuse_infinite(document)?;
    let features: Vec<Json> = shapes::features(document).iter().map(drawn).collect();
    let root = json!({ "type": "FeatureCollection", "features": features });
    let text = serde_json::to_string_pretty(&root).unwrap_or_default();
    Ok(text + "\n")
}

fn drawn(feature: &Drawn) -> Json {
    let mut properties = Map::new();
    properties.insert("name".to_owned(), json!(feature.name));
    for (key, datum) in &feature.data {
        let value = match datum {
            Datum::Word(word) => json!(word),
            Datum::Whole(number) => json!(number),
            // The shortest decimal form; NaN becomes null.
            Datum::Real(number) => number
                .to_string()
                .parse::<f64>()
                .map_or(Json::Null, |it| json!(it)),
        };
        properties.insert((*key).to_owned(), value);
    }
    let degrees = |spot: &Spot| json!([f64::from(spot.y) / 1e7, f64::from(spot.x) / 1e7]);
    let geometry = match &feature.outline {
        Outline::Nothing => Json::Null,
        Outline::Point(spot) => json!({ "type": "Point", "coordinates": degrees(spot) }),
        Outline::Line(spots) => {
            let spots: Vec<Json> = spots.iter().map(degrees).collect();
            json!({ "type": "LineString", "coordinates": spots })
        }
        Outline::Ring(spots) => {
            let spots: Vec<Json> = spots.iter().chain(spots.first()).map(degrees).collect();
            json!({ "type": "Polygon", "coordinates": [spots] })
        }
    };
    json!({ "type": "Feature", "properties": properties, "geometry": geometry })
}
