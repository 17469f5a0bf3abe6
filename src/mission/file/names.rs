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
            let fault = "`pad`, `pad1`, `c1`, `gate1`, `peak` and `next` are names of the flight's own places";
            faults.add(file.id.span(), fault);
        }
        check_unique(&mut seen, &file.id, faults);
        let at = faults.point(&file.at, "at");
        Some((file.id.into_inner(), at))
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
    ["pad", "c", "gate"].into_iter().any(numbered) || ["peak", "next"].contains(&name)
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
