//! Reading a mission file. Every section is read on its own, so that one fault does not hide the others; what
//! refers to another section is checked after that one was read.

use crate::text;
use crate::text::{Language, Text};
use std::ops::RangeInclusive;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::objective::Objective;
use super::{Mission, Point};
use crate::diagnostic::Diagnostic;

mod campaign;
mod draft;
mod events;
mod fleet;
mod head;
mod hints;
mod names;
mod place;
mod points;
mod radio;
mod sections;
mod zones;

/// Points may lie this far from the origin on each axis; the flat earth of [`crate::geo`] holds no farther.
pub(super) const POINT_RANGE: f64 = 20_000.0;

/// Bytes of one text: three screens full of letters of two bytes.
const LONGEST_TEXT: usize = 8000;

/// No mission is shorter; a limit below this has been reported as a fault of its own.
const SHORTEST_LIMIT: std::time::Duration = std::time::Duration::from_secs(10);

/// Keys of the file that stand before its first section.
pub(super) const HEAD: [&str; 11] = [
    "schema", "id", "rev", "title", "title_uk", "tier", "tags", "authors", "brief", "brief_uk",
    "drill_of",
];
/// The sections.
pub(super) const SECTIONS: [&str; 15] = [
    "requires",
    "rewards",
    "sim",
    "weather",
    "places",
    "zones",
    "hazards",
    "fleet",
    "rules",
    "objectives",
    "events",
    "radio",
    "instructor",
    "hints",
    "scoring",
];

pub(super) use draft::Draft;
pub(super) use events::action_keys;
pub(super) use zones::zone_kinds;

/// Which of two values is the better one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Better {
    Higher,
    Lower,
}

/// A table of the file with its place.
pub(super) type Section<'i> = Spanned<DeTable<'i>>;
/// What reads one kind of a section that has kinds.
pub(super) type Reader<T> = fn(Section<'_>, &Draft, &mut Faults) -> Option<T>;

/// The faults found so far.
#[derive(Debug, Default)]
pub(super) struct Faults {
    found: Vec<Diagnostic>,
    /// Texts without a translation, which are no faults.
    untranslated: Vec<Diagnostic>,
    /// Whether there is any translation.
    translated: bool,
}

/// Reads a mission file.
pub(super) fn read(source: &str) -> Result<Mission, Vec<Diagnostic>> {
    let root = DeTable::parse(source).map_err(|error| vec![Diagnostic::from_toml(&error)])?;
    let mut faults = Faults::default();
    let mission = sections::mission(root, &mut faults);
    let mut found = faults.found;
    found.sort_by_key(|fault| fault.span.start);
    match mission {
        Some(mission) if found.is_empty() => {
            let mut untranslated = faults.untranslated;
            untranslated.sort_by_key(|note| note.span.start);
            if !faults.translated {
                // One note for a file that nobody has begun to translate.
                untranslated.truncate(1);
                let note = |note: &mut Diagnostic| note.message = text!("mission-english-only");
                untranslated.iter_mut().for_each(note);
            }
            Ok(Mission {
                untranslated,
                source: source.to_owned(),
                ..mission
            })
        }
        _ if found.is_empty() => Err(vec![Diagnostic::new(0..0, "this is no mission file")]),
        _ => Err(found),
    }
}

impl Faults {
    /// Adds a fault at a place.
    pub fn add(&mut self, span: std::ops::Range<usize>, message: impl Into<Text>) {
        self.found.push(Diagnostic::new(span, message));
    }

    /// Adds a fault about a name that is not among the known ones.
    pub fn unknown(&mut self, what: &str, written: &Spanned<String>, known: &[&str]) {
        let list = if known.is_empty() {
            "none".to_owned()
        } else {
            known.join(", ")
        };
        let name = written.get_ref();
        let fault = Diagnostic::new(
            written.span(),
            format!("unknown {what} `{name}`; known: {list}"),
        );
        self.found
            .push(fault.with_nearest(name, known.iter().copied()));
    }

    /// Reads a table into a type; a fault in it is added and gives `None`.
    pub fn read<'i, T: Deserialize<'i>>(&mut self, section: Section<'i>) -> Option<T> {
        let span = section.span();
        self.keep(T::deserialize(toml::de::Deserializer::from(section)), span)
    }

    /// The same for any value.
    pub fn read_value<'i, T: Deserialize<'i>>(&mut self, value: Spanned<DeValue<'i>>) -> Option<T> {
        let span = value.span();
        self.keep(
            T::deserialize(toml::de::ValueDeserializer::from(value)),
            span,
        )
    }

    fn keep<T>(
        &mut self,
        result: Result<T, toml::de::Error>,
        span: std::ops::Range<usize>,
    ) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(error) => {
                let message = in_plain_words(error.message());
                let fault = Diagnostic::new(error.span().unwrap_or(span), message.as_str());
                // "unknown field `x`, expected one of `a`, `b`": the names stand in backquotes.
                let mut quoted = message.split('`').skip(1).step_by(2);
                let unknown = message.starts_with("unknown ");
                // Of names of one letter, all are equally close.
                let named = |written: &&str| unknown && written.len() > 1;
                self.found.push(match quoted.next().filter(named) {
                    Some(written) => fault.with_nearest(written, quoted),
                    None => fault,
                });
                None
            }
        }
    }

    /// A text with its translation, if there is one, which `key` would name.
    pub fn written(
        &mut self,
        english: Spanned<String>,
        ukrainian: Option<Spanned<String>>,
        key: &str,
    ) -> Text {
        for text in std::iter::once(&english).chain(&ukrainian) {
            if text.get_ref().len() > LONGEST_TEXT {
                let fault = format!("a text may have {LONGEST_TEXT} bytes");
                self.add(text.span(), fault);
            }
        }
        match &ukrainian {
            None => {
                let note = text!("mission-untranslated", key = key);
                self.untranslated
                    .push(Diagnostic::new(english.span(), note));
            }
            Some(words) if words.get_ref().trim().is_empty() => {
                self.add(words.span(), text!("mission-translation-empty", key = key));
            }
            Some(_) => self.translated = true,
        }
        let translated = ukrainian.map(|words| (Language::Ukrainian, words.into_inner()));
        Text::written(english.into_inner(), translated)
    }

    /// A number that must lie in a range; NaN never does.
    pub fn number(&mut self, value: &Spanned<f64>, range: RangeInclusive<f64>, name: &str) -> f64 {
        if !range.contains(value.get_ref()) {
            let (low, high, number) = (range.start(), range.end(), *value.get_ref());
            let written = if number.abs() < 1e9 {
                number.to_string()
            } else {
                format!("{number:e}")
            };
            let message = format!("`{name}` must lie between {low} and {high}, not {written}");
            self.add(value.span(), message);
        }
        *value.get_ref()
    }

    /// A number that may be left out.
    pub fn optional(
        &mut self,
        value: Option<&Spanned<f64>>,
        usual: f64,
        range: RangeInclusive<f64>,
        name: &str,
    ) -> f64 {
        value.map_or(usual, |value| self.number(value, range, name))
    }

    /// What is asked for, and from where on a part of it counts, which must lie on the worse side of it.
    pub fn target(
        &mut self,
        (target, partial_from): (&Spanned<f64>, &Spanned<f64>),
        range: RangeInclusive<f64>,
        better: Better,
    ) -> (f64, f64) {
        let worst = 0.0..=*range.end();
        let asked = self.number(target, range, "target");
        let from = self.number(partial_from, worst, "partial_from");
        let (is_worse, message) = match better {
            Better::Higher => (from < asked, "`partial_from` must be below `target`"),
            Better::Lower => (
                from > asked,
                "`partial_from` must be above `target`: less is better here",
            ),
        };
        if !is_worse {
            self.add(partial_from.span(), message);
        }
        (asked, from)
    }

    /// Heights from the lowest to the highest; any, where none are written.
    pub fn heights(&mut self, value: Option<&Spanned<[f64; 2]>>) -> [f64; 2] {
        let Some(value) = value else {
            return [f64::NEG_INFINITY, f64::INFINITY];
        };
        let [low, high] = *value.get_ref();
        if !(0.0 <= low && low < high && high <= 1000.0) {
            self.add(value.span(), "`heights` must be [low, high], 0 to 1000 m");
        }
        [low, high]
    }

    /// A point that must not lie too far away.
    pub fn point(&mut self, value: &Spanned<Point>, name: &str) -> Point {
        let range = -POINT_RANGE..=POINT_RANGE;
        if !value.get_ref().iter().all(|axis| range.contains(axis)) {
            let message =
                format!("`{name}` must lie within {POINT_RANGE} m of the origin, as [east, north]");
            self.add(value.span(), message);
        }
        *value.get_ref()
    }
}

/// A message of the TOML reader with the field's words in the place of the program's types.
fn in_plain_words(message: &str) -> String {
    const TYPES: [(&str, &str); 7] = [
        ("f64", "a number"),
        ("u8", "a whole number, 0 to 255"),
        ("u16", "a whole number, 0 to 65535"),
        ("u32", "a whole number, 0 or more"),
        ("u64", "a whole number, 0 or more"),
        ("usize", "a whole number, 0 or more"),
        ("i64", "a whole number"),
    ];
    let named = TYPES.iter().find_map(|(name, words)| {
        let before = message.strip_suffix(name)?;
        let before = before.strip_suffix("expected ")?;
        Some(format!("{before}expected {words}"))
    });
    named.unwrap_or_else(|| message.to_owned())
}

/// A length of time; `None` for what is none, of which the range check has told already.
fn seconds(value: f64) -> Option<std::time::Duration> {
    std::time::Duration::try_from_secs_f64(value).ok()
}

/// What all sections with kinds have in common.
struct Kinded<'i> {
    id: Spanned<String>,
    kind: Spanned<String>,
    rest: Section<'i>,
}

/// Takes `id` and `kind` out of a section; a missing one is a fault.
fn kinded<'i>(section: Spanned<DeValue<'i>>, faults: &mut Faults) -> Option<Kinded<'i>> {
    let span = section.span();
    let DeValue::Table(mut table) = section.into_inner() else {
        faults.add(span, "a table is needed here");
        return None;
    };
    let id: Option<Spanned<String>> = take(&mut table, "id", &span, faults);
    let kind = take(&mut table, "kind", &span, faults);
    let id = id.filter(|id| {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        let good =
            !id.get_ref().is_empty() && id.get_ref().len() <= 32 && id.get_ref().chars().all(plain);
        if !good {
            faults.add(id.span(), "an id is 1 to 32 letters, digits, `-` and `_`");
        }
        good
    });
    Some(Kinded {
        id: id?,
        kind: kind?,
        rest: Spanned::new(span, table),
    })
}

/// Takes a required key out of a table.
fn take<'i, T: Deserialize<'i>>(
    table: &mut DeTable<'i>,
    key: &str,
    place: &std::ops::Range<usize>,
    faults: &mut Faults,
) -> Option<T> {
    let Some(value) = table.remove(key) else {
        faults.add(place.clone(), format!("missing field `{key}`"));
        return None;
    };
    faults.read_value(value)
}

/// Takes a key that may be missing out of a table.
fn take_optional<'i, T: Deserialize<'i>>(
    table: &mut DeTable<'i>,
    key: &str,
    faults: &mut Faults,
) -> Option<T> {
    faults.read_value(table.remove(key)?)
}

/// Reads the section's kind with the reader that the table of kinds names.
fn by_kind<T>(
    what: &str,
    section: Kinded<'_>,
    kinds: &[(&str, Reader<T>)],
    draft: &Draft,
    faults: &mut Faults,
) -> Option<T> {
    let Some((_, reader)) = kinds
        .iter()
        .find(|(name, _)| name == section.kind.get_ref())
    else {
        let known: Vec<&str> = kinds.iter().map(|(name, _)| *name).collect();
        faults.unknown(&format!("{what} kind"), &section.kind, &known);
        return None;
    };
    reader(section.rest, draft, faults)
}

/// Reports ids that occur twice.
fn check_unique(seen: &mut Vec<String>, id: &Spanned<String>, faults: &mut Faults) {
    if seen.contains(id.get_ref()) {
        faults.add(
            id.span(),
            format!("the id `{}` is used twice", id.get_ref()),
        );
    }
    seen.push(id.get_ref().clone());
}

/// An objective's common part, once its kind is read.
fn objective(
    section: Spanned<DeValue<'_>>,
    draft: &mut Draft,
    seen: &mut Vec<String>,
    faults: &mut Faults,
) -> Option<Objective> {
    let mut section = kinded(section, faults)?;
    check_unique(seen, &section.id, faults);
    let span = section.rest.span();
    let table = section.rest.get_mut();
    let title = take::<Spanned<String>>(table, "title", &span, faults);
    let title_uk = take_optional::<Spanned<String>>(table, "title_uk", faults);
    let value = take::<Spanned<f64>>(table, "value", &span, faults);
    let mandatory = take_optional::<bool>(table, "mandatory", faults).unwrap_or(false);
    let (id, place) = (section.id.get_ref().clone(), section.id.span());
    draft.objective.clone_from(&id);
    let kind_name = section.kind.get_ref().clone();
    let kind = by_kind("objective", section, super::objective::KINDS, draft, faults)?;
    draft.surveys.extend(kind.survey().cloned());
    let drawn = kind.place_names();
    if let Some(name) = drawn.iter().find(|name| draft.drawn.contains(name)) {
        let fault =
            format!("an earlier objective has a place `{name}`: one of them may have gates");
        faults.add(place, fault);
    }
    draft.drawn.extend(drawn);
    Some(Objective {
        id,
        title: faults.written(title?, title_uk, "title_uk"),
        value: faults.number(&value?, 0.1..=1000.0, "value"),
        mandatory,
        kind_name,
        kind,
    })
}
