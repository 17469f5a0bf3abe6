//! Tracks and moments for maps: KML, GPX and `GeoJSON`.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};
use serde_json::{Value, json};

use super::track::{TrackPoint, Tracks, place, time};
use crate::moment::Moment;
use crate::replay::Film;

type Xml = Writer<Vec<u8>>;

/// A moment with the position of its first vehicle; for a moment of the whole flight, the position is that of the first
/// vehicle overall.
fn placed<'a>(
    film: &'a Film,
    tracks: &'a Tracks,
    moments: &'a [Moment],
) -> impl Iterator<Item = (&'a Moment, TrackPoint)> {
    moments.iter().filter_map(move |moment| {
        let named = moment
            .vehicles
            .first()
            .and_then(|&id| u8::try_from(id).ok());
        let track = match named {
            Some(system) => tracks.get(&system),
            None => tracks.values().next(),
        };
        Some((moment, place(film, track?, moment.at)?))
    })
}

/// The label of a moment in other programs, in English.
fn label(moment: &Moment) -> String {
    let vehicles = crate::vehicle_id::ranges(moment.vehicles.iter().copied());
    let colon = if vehicles.is_empty() { "" } else { ": " };
    format!("{vehicles}{colon}{}", moment.text)
}

fn document(write: impl FnOnce(&mut Xml) -> io::Result<()>) -> io::Result<String> {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 1);
    let declaration = BytesDecl::new("1.0", Some("UTF-8"), None);
    xml.write_event(Event::Decl(declaration))?;
    write(&mut xml)?;
    let mut text = String::from_utf8_lossy(&xml.into_inner()).into_owned();
    text.push('\n');
    Ok(text)
}

fn leaf(xml: &mut Xml, name: &str, text: &str) -> io::Result<()> {
    let element = xml.create_element(name);
    element.write_text_content(BytesText::new(text)).map(drop)
}

/// KML: a `gx:Track` per vehicle, which globes play by time, and a placemark per moment.
pub(super) fn kml(film: &Film, tracks: &Tracks, moments: &[Moment]) -> io::Result<String> {
    document(|xml| {
        xml.create_element("kml")
            .with_attribute(("xmlns", "http://www.opengis.net/kml/2.2"))
            .with_attribute(("xmlns:gx", "http://www.google.com/kml/ext/2.2"))
            .write_inner_content(|xml| {
                xml.create_element("Document").write_inner_content(|xml| {
                    leaf(xml, "name", &film.name())?;
                    for (system, track) in tracks {
                        kml_track(xml, &format!("vehicle {system}"), track)?;
                    }
                    for (moment, at) in placed(film, tracks, moments) {
                        kml_moment(xml, moment, at)?;
                    }
                    Ok(())
                })?;
                Ok(())
            })?;
        Ok(())
    })
}

fn kml_track(xml: &mut Xml, name: &str, track: &[TrackPoint]) -> io::Result<()> {
    xml.create_element("Placemark").write_inner_content(|xml| {
        leaf(xml, "name", name)?;
        xml.create_element("gx:Track").write_inner_content(|xml| {
            leaf(xml, "altitudeMode", "absolute")?;
            for point in track {
                leaf(xml, "when", &point.time())?;
            }
            for point in track {
                let coordinates = format!(
                    "{} {} {}",
                    point.lon_deg, point.lat_deg, point.altitude_amsl_m
                );
                leaf(xml, "gx:coord", &coordinates)?;
            }
            Ok(())
        })?;
        Ok(())
    })?;
    Ok(())
}

fn kml_moment(xml: &mut Xml, moment: &Moment, at: TrackPoint) -> io::Result<()> {
    xml.create_element("Placemark").write_inner_content(|xml| {
        leaf(xml, "name", &label(moment))?;
        xml.create_element("TimeStamp")
            .write_inner_content(|xml| leaf(xml, "when", &at.time()))?;
        xml.create_element("Point").write_inner_content(|xml| {
            leaf(xml, "altitudeMode", "absolute")?;
            let coordinates = format!("{},{},{}", at.lon_deg, at.lat_deg, at.altitude_amsl_m);
            leaf(xml, "coordinates", &coordinates)
        })?;
        Ok(())
    })?;
    Ok(())
}

/// GPX 1.1: a waypoint per moment, a track per vehicle.
pub(super) fn gpx(film: &Film, tracks: &Tracks, moments: &[Moment]) -> io::Result<String> {
    document(|xml| {
        xml.create_element("gpx")
            .with_attribute(("version", "1.1"))
            .with_attribute(("creator", "sortie"))
            .with_attribute(("xmlns", "http://www.topografix.com/GPX/1/1"))
            .write_inner_content(|xml| {
                for (moment, at) in placed(film, tracks, moments) {
                    gpx_point(xml, "wpt", at, Some(&label(moment)))?;
                }
                for (system, track) in tracks {
                    xml.create_element("trk").write_inner_content(|xml| {
                        leaf(xml, "name", &format!("vehicle {system}"))?;
                        xml.create_element("trkseg").write_inner_content(|xml| {
                            for point in track {
                                gpx_point(xml, "trkpt", *point, None)?;
                            }
                            Ok(())
                        })?;
                        Ok(())
                    })?;
                }
                Ok(())
            })?;
        Ok(())
    })
}

fn gpx_point(xml: &mut Xml, tag: &str, at: TrackPoint, name: Option<&str>) -> io::Result<()> {
    let (lat, lon) = (at.lat_deg.to_string(), at.lon_deg.to_string());
    xml.create_element(tag)
        .with_attribute(("lat", lat.as_str()))
        .with_attribute(("lon", lon.as_str()))
        .write_inner_content(|xml| {
            leaf(xml, "ele", &at.altitude_amsl_m.to_string())?;
            leaf(xml, "time", &at.time())?;
            name.map_or(Ok(()), |name| leaf(xml, "name", name))
        })?;
    Ok(())
}

/// A line per vehicle with its times, and a point per moment.
pub(super) fn geo_json(film: &Film, tracks: &Tracks, moments: &[Moment]) -> String {
    // A line needs at least two points.
    let drawn = tracks.iter().filter(|(_, track)| track.len() > 1);
    let lines = drawn.map(|(system, track)| {
        let times: Vec<String> = track.iter().map(TrackPoint::time).collect();
        let coordinates: Vec<Value> = track.iter().map(position).collect();
        json!({
            "type": "Feature",
            "properties": {"vehicle": system, "times": times},
            "geometry": {"type": "LineString", "coordinates": coordinates},
        })
    });
    let points = placed(film, tracks, moments).map(|(moment, at)| {
        json!({
            "type": "Feature",
            "properties": {
                "kind": moment.kind.name(),
                "vehicles": moment.vehicles,
                "text": moment.text.to_string(),
                "time": time(at.unix_us),
            },
            "geometry": {"type": "Point", "coordinates": position(&at)},
        })
    });
    let features: Vec<Value> = lines.chain(points).collect();
    let document = json!({"type": "FeatureCollection", "features": features});
    format!("{document:#}\n")
}

fn position(point: &TrackPoint) -> Value {
    json!([point.lon_deg, point.lat_deg, point.altitude_amsl_m])
}
