//! Places and shapes on the command line.

use std::path::Path;

use super::super::{Failure, invalid, load};
use crate::cli::fault::FileFault;
use crate::geo::LatLon;
use crate::plan::generate::source;
use crate::plan::{Document, Item, ReadOptions};
use crate::text;
use crate::text::{Locale, Text};

/// A place, with its height above sea level in metres if it was given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Degrees {
    pub(super) at: LatLon,
    pub(super) amsl_m: Option<f64>,
}

/// The places of an option, in the order written.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Places(pub(super) Vec<Degrees>);

pub(super) fn parse_degrees(text: &str) -> Result<Degrees, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let (lat, lon, amsl_m) = match numbers.as_deref() {
        Ok([lat, lon]) => (*lat, *lon, None),
        Ok([lat, lon, amsl_m]) => (*lat, *lon, Some(*amsl_m)),
        Ok(_) | Err(_) => {
            return Err("expected LAT,LON or LAT,LON,ALT, such as 50.45,30.52,180".to_owned());
        }
    };
    let at = LatLon::new(lat, lon);
    let heights = -1000.0..=20_000.0;
    if !at.is_valid() {
        return Err("latitude is -90 to 90 and longitude -180 to 180".to_owned());
    }
    if amsl_m.is_some_and(|amsl_m| !heights.contains(&amsl_m)) {
        return Err("the height above sea level is -1000 to 20000 m".to_owned());
    }
    Ok(Degrees { at, amsl_m })
}

pub(super) fn parse_places(text: &str) -> Result<Places, String> {
    let places: Result<Vec<Degrees>, String> = text.split_whitespace().map(parse_degrees).collect();
    Ok(Places(places?))
}

/// A shape, given by a file or by its places.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShapeSource<'a> {
    pub(super) file: Option<&'a Path>,
    pub(super) points: Option<&'a Places>,
    pub(super) area: Option<u16>,
}

impl ShapeSource<'_> {
    fn document(&self, locale: &Locale) -> Result<Document, Failure> {
        let missing = || invalid(&text!("plan-generate-no-shape"), locale);
        let path = self.file.ok_or_else(missing)?;
        let loaded = load(path, ReadOptions::default());
        Ok(loaded.map_err(FileFault::failure)?.document)
    }

    fn fault(&self, text: &Text, locale: &Locale) -> Failure {
        let name = self.file.map(|path| path.display().to_string());
        let parts = vec![name.unwrap_or_default().into(), text.clone()];
        invalid(&Text::joined(": ", parts), locale)
    }

    /// The outline of the area, and its holes.
    pub(super) fn rings(&self, locale: &Locale) -> Result<Vec<Vec<LatLon>>, Failure> {
        if let Some(points) = self.points {
            return Ok(vec![points.0.iter().map(|place| place.at).collect()]);
        }
        let mut areas = source::areas(&self.document(locale)?);
        let count = areas.len();
        let chosen = match self.area {
            Some(number) => usize::from(number) - 1,
            None if count > 1 => {
                let text = text!("plan-generate-which-area", count = count);
                return Err(self.fault(&text, locale));
            }
            None => 0,
        };
        if chosen < count {
            Ok(areas.swap_remove(chosen))
        } else {
            let text = text!("plan-generate-no-area", count = count);
            Err(self.fault(&text, locale))
        }
    }

    /// The areas of the file that must not be entered, as items of a fence.
    pub(super) fn keep_out(&self, locale: &Locale) -> Result<Vec<Item>, Failure> {
        match self.file {
            Some(_) => Ok(source::keep_out(&self.document(locale)?.fence)),
            None => Ok(Vec::new()),
        }
    }

    /// The places of a line.
    pub(super) fn line(&self, locale: &Locale) -> Result<Vec<LatLon>, Failure> {
        if let Some(points) = self.points {
            return Ok(points.0.iter().map(|place| place.at).collect());
        }
        let line = source::line(&self.document(locale)?);
        if line.len() < 2 {
            return Err(self.fault(&text!("plan-generate-no-line"), locale));
        }
        Ok(line)
    }

    /// The place in `given`, otherwise the first of `--points`, otherwise the first in the file.
    pub(super) fn place(&self, given: Option<Degrees>, locale: &Locale) -> Result<LatLon, Failure> {
        let written = self.points.and_then(|points| points.0.first());
        if let Some(place) = given.as_ref().or(written) {
            return Ok(place.at);
        }
        let places = source::places(&self.document(locale)?);
        let first = places.first().copied();
        first.ok_or_else(|| self.fault(&text!("plan-generate-no-point"), locale))
    }
}
