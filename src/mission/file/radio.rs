//! `[radio]` and `[instructor]`.

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeValue;

use super::Faults;
use crate::mission::Point;
use crate::mission::event::standard::Standard;
use crate::mission::radio::{Model, Radio, Set};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RadioFile {
    model: Spanned<String>,
    station: Option<Spanned<Point>>,
    antenna: Option<Spanned<f64>>,
    relays: Option<bool>,
}

/// Reads the radio that all vehicles carry.
pub(super) fn radio(
    value: Spanned<DeValue<'_>>,
    station: Option<&Point>,
    faults: &mut Faults,
) -> Option<Radio> {
    let file: RadioFile = faults.read_value(value)?;
    let Some(model) = Model::by_id(file.model.get_ref()) else {
        let known: Vec<&str> = Model::all().map(|model| model.id).collect();
        faults.unknown("radio", &file.model, &known);
        return None;
    };
    let set = Set::of(model);
    let station = match &file.station {
        Some(station) => faults.point(station, "station"),
        None => station.copied().unwrap_or_default(),
    };
    Some(Radio {
        own: Some(Set {
            relays: file.relays.unwrap_or(set.relays),
            ..set
        }),
        station,
        antenna_m: file.antenna.map_or(Radio::USUAL_ANTENNA_M, |antenna| {
            faults.number(&antenna, 0.5..=100.0, "antenna")
        }),
    })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct InstructorFile {
    #[serde(default)]
    may_inject: Vec<Spanned<String>>,
}

/// What an instructor may have happen.
pub(super) fn may_inject(value: Spanned<DeValue<'_>>, faults: &mut Faults) -> Option<Vec<String>> {
    let file: InstructorFile = faults.read_value(value)?;
    for name in &file.may_inject {
        if Standard::named(name.get_ref()).is_none() {
            faults.unknown("threat", name, &Standard::names());
        }
    }
    let names = file.may_inject.into_iter();
    Some(names.map(Spanned::into_inner).collect())
}
