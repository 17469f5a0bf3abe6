//! The faults of a mission file, each with its position.

use std::ops::{Range, RangeInclusive};

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeValue;

use super::name_kind::NameKind;
use crate::diagnostic::{Diagnostic, toml_value};
use crate::text;
use crate::text::{Language, Text};

/// The greatest length of a text, in bytes: three screens of two-byte letters.
const LONGEST_TEXT: usize = 8000;

/// The faults found so far.
#[derive(Debug, Default)]
pub(in crate::mission) struct FileFaults {
    found: Vec<Diagnostic>,
    /// Texts without a translation, which are not faults.
    untranslated: Vec<Diagnostic>,
    translated: bool,
}

impl FileFaults {
    /// Adds a fault at a position.
    pub fn add(&mut self, place: Range<usize>, message: impl Into<Text>) {
        self.push(Diagnostic::new(place, message));
    }

    pub fn push(&mut self, fault: Diagnostic) {
        self.found.push(fault);
    }

    /// Whether there are faults within a place.
    pub fn are_within(&self, place: &Range<usize>) -> bool {
        let mut found = self.found.iter();
        found.any(|fault| place.contains(&fault.span.start))
    }

    /// Whether there are no faults so far.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// All faults, in file order.
    pub fn sorted(mut self) -> Vec<Diagnostic> {
        self.found.sort_by_key(|fault| fault.span.start);
        self.found
    }

    /// The texts without a translation; a single note for a file with no translation at all.
    pub fn take_untranslated(&mut self) -> Vec<Diagnostic> {
        let mut untranslated = std::mem::take(&mut self.untranslated);
        untranslated.sort_by_key(|note| note.span.start);
        if !self.translated {
            untranslated.truncate(1);
            let note = |note: &mut Diagnostic| note.message = text!("mission-english-only");
            untranslated.iter_mut().for_each(note);
        }
        untranslated
    }

    /// Adds a fault for an unknown name, with the known ones as advice.
    pub fn unknown(&mut self, kind: NameKind, written: &Spanned<String>, known: &[&str]) {
        let (what, name) = (kind.text(), written.get_ref());
        let message = if known.is_empty() {
            text!("fault-name-none", what = what, name = name)
        } else {
            let list = known.join(", ");
            text!("fault-name-unknown", what = what, name = name, known = list)
        };
        let fault = Diagnostic::new(written.span(), message);
        self.push(fault.with_nearest(name, known.iter().copied()));
    }

    /// Reads a plain value; if it is invalid, adds a fault and returns `None`.
    pub fn read<'i, T: Deserialize<'i>>(&mut self, value: Spanned<DeValue<'i>>) -> Option<T> {
        toml_value(value).map_err(|fault| self.push(fault)).ok()
    }

    /// A text with the translation under the key `key`, if any.
    pub fn translated(
        &mut self,
        english: Spanned<String>,
        ukrainian: Option<Spanned<String>>,
        key: &str,
    ) -> Text {
        for text in std::iter::once(&english).chain(&ukrainian) {
            if text.get_ref().len() > LONGEST_TEXT {
                let fault = text!("fault-text-long", most = LONGEST_TEXT);
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
        let translation = ukrainian.map(|words| (Language::Ukrainian, words.into_inner()));
        Text::written(english.into_inner(), translation)
    }
}

/// The fault for a value outside its bounds.
pub(in crate::mission) fn not_between(
    name: &str,
    bounds: &RangeInclusive<f64>,
    found: f64,
) -> Text {
    let shown = if found.abs() < 1e9 {
        found.to_string()
    } else {
        format!("{found:e}")
    };
    text!(
        "fault-between-not",
        name = name,
        low = bounds.start().to_string(),
        high = bounds.end().to_string(),
        found = shown
    )
}
