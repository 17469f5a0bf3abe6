//! `[[places]]`: named points.

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeValue;

use super::{Draft, Faults, check_unique};
use crate::mission::Point;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaceFile {
    id: Spanned<String>,
    at: Spanned<Point>,
}

/// What reads one place after the other.
pub(super) fn reader<'i>()
-> impl FnMut(Spanned<DeValue<'i>>, &mut Faults) -> Option<(String, Point)> {
    let mut seen = Vec::new();
    move |value, faults| {
        let file: PlaceFile = faults.read_value(value)?;
        let name = file.id.get_ref();
        if !is_name(name) {
            let fault = "a place's id begins with a letter: 2 to 32 letters, digits, `-` and `_`";
            faults.add(file.id.span(), fault);
        } else if is_taken(name) {
            let fault = "`pad`, `pad1`, `c1`, `gate1`, `peak`, `peak1` and `next` are names of the flight's own places";
            faults.add(file.id.span(), fault);
        }
        check_unique(&mut seen, &file.id, faults);
        let at = faults.point(&file.at, "at");
        Some((file.id.into_inner(), at))
    }
}

/// The ids of all places, as they are written.
pub(super) fn written(places: Option<&Spanned<DeValue<'_>>>) -> Vec<Spanned<String>> {
    let tables = places.and_then(|value| value.get_ref().as_array());
    let ids = tables.into_iter().flatten();
    let ids = ids.filter_map(|table| table.get_ref().get("id"));
    let text = |id: &Spanned<DeValue<'_>>| {
        Some(Spanned::new(id.span(), id.get_ref().as_str()?.to_owned()))
    };
    ids.filter_map(text).collect()
}

/// Cells have names of their own; the objectives bring them.
pub(super) fn check_no_cells(ids: &[Spanned<String>], draft: &Draft, faults: &mut Faults) {
    for survey in &draft.surveys {
        let is_cell = |name: &str| survey.cells.iter().any(|cell| cell.name == name);
        for id in ids.iter().filter(|id| is_cell(id.get_ref())) {
            let (name, survey) = (id.get_ref(), &survey.id);
            faults.add(id.span(), format!("`{name}` is a cell of `{survey}`"));
        }
    }
}

/// One letter alone would read as an axis of `goto`.
fn is_name(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    (2..=32).contains(&name.len())
        && name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(plain)
}

fn is_taken(name: &str) -> bool {
    let numbered = |prefix| {
        let rest = name.strip_prefix(prefix);
        rest.is_some_and(|rest: &str| rest.chars().all(|c| c.is_ascii_digit()))
    };
    ["pad", "c", "gate", "peak"].into_iter().any(numbered) || name == "next"
}

impl Draft {
    /// A place of the file, or a pad.
    pub fn place(&self, name: &Spanned<String>, faults: &mut Faults) -> Option<Point> {
        let pads = self.pads.iter().enumerate();
        let pads = pads.map(|(index, &pad)| (format!("pad{}", index + 1), pad));
        let all: Vec<(String, Point)> = self.places.iter().cloned().chain(pads).collect();
        let found = all.iter().find(|(known, _)| known == name.get_ref());
        if found.is_none() {
            let known: Vec<&str> = all.iter().map(|(known, _)| known.as_str()).collect();
            self.refers_to_nothing("place", name, &known, faults);
        }
        found.map(|(_, at)| *at)
    }
}
