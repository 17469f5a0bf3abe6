//! Words: free texts, ids, and names from a list.

use toml::Spanned;
use toml::de::DeValue;

use super::FileValue;
use crate::diagnostic::Diagnostic;
use crate::mission::format::description::FileShape;
use crate::mission::format::draft::Draft;
use crate::mission::format::name_kind::NameKind;
use crate::mission::sensor::Sensor;
use crate::text;
use crate::text::Text;

#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct TextValue {
    form: &'static str,
    rule: Option<TextRule>,
    /// All possible values, for the description; the reader checks which are allowed.
    names: Option<fn() -> Vec<&'static str>>,
}

/// A rule for texts, and the fault of a text that breaks it.
type TextRule = (fn(&str) -> bool, &'static str);

/// Any text; `form` describes it where that is not obvious.
pub(in crate::mission) const fn text(form: &'static str) -> TextValue {
    TextValue {
        form,
        rule: None,
        names: None,
    }
}

/// A text that follows a rule.
pub(in crate::mission) const fn text_by(
    form: &'static str,
    rule: fn(&str) -> bool,
    fault: &'static str,
) -> TextValue {
    TextValue {
        form,
        rule: Some((rule, fault)),
        names: None,
    }
}

/// The id of a table.
pub(in crate::mission::format) const fn id() -> TextValue {
    text_by("1 to 32 letters, digits, `-` and `_`", is_id, "fault-id")
}

/// The id of a sensor. The reader checks whether the fleet carries it.
pub(in crate::mission::format) const fn sensor_id() -> TextValue {
    TextValue {
        form: "sensor",
        rule: None,
        names: Some(Sensor::ids),
    }
}

fn is_id(id: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    (1..=32).contains(&id.len()) && id.chars().all(plain)
}

impl FileValue for TextValue {
    type Out = Spanned<String>;

    fn shape(&self) -> FileShape {
        match self.names {
            Some(names) => FileShape::Named(self.form, names()),
            None => FileShape::Text(self.form, None),
        }
    }

    fn read(
        &self,
        _: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<Spanned<String>> {
        let place = written.span();
        let text = Spanned::new(place.clone(), draft.faults.read::<String>(written)?);
        match self.rule {
            Some((rule, fault)) if !rule(text.get_ref()) => {
                draft.faults.add(place, Text::new(fault, Vec::new()));
                None
            }
            _ => Some(text),
        }
    }
}

#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct WordValue<T: 'static>(&'static [(&'static str, T)]);

/// One of the given words, each with its value.
pub(in crate::mission) const fn word<T>(words: &'static [(&'static str, T)]) -> WordValue<T> {
    WordValue(words)
}

impl<T: Copy + PartialEq> FileValue for WordValue<T> {
    type Out = T;

    fn shape(&self) -> FileShape {
        FileShape::Words(self.0.iter().map(|(word, _)| *word).collect())
    }

    fn read(&self, _: &str, written: Spanned<DeValue<'_>>, draft: &mut Draft) -> Option<T> {
        let place = written.span();
        let word: String = draft.faults.read(written)?;
        let found = self.0.iter().find(|(known, _)| *known == word);
        if found.is_none() {
            let known: Vec<&str> = self.0.iter().map(|(known, _)| *known).collect();
            let message = text!(
                "fault-value-unknown",
                name = &word,
                known = known.join(", ")
            );
            let fault = Diagnostic::new(place, message);
            draft.faults.push(match word.len() {
                // One-letter words are all equally similar.
                0 | 1 => fault,
                _ => fault.with_nearest(&word, known),
            });
        }
        found.map(|(_, meant)| *meant)
    }

    fn show(&self, meant: &T) -> String {
        let found = self.0.iter().find(|(_, known)| known == meant);
        found.map_or_else(String::new, |(word, _)| format!("`{word}`"))
    }
}

#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct NamedValue<T> {
    kind: NameKind,
    names: fn() -> Vec<&'static str>,
    find: fn(&str) -> Option<T>,
}

/// A value by its name, with the list of all names and the function that finds the value.
pub(in crate::mission) const fn named<T>(
    kind: NameKind,
    names: fn() -> Vec<&'static str>,
    find: fn(&str) -> Option<T>,
) -> NamedValue<T> {
    NamedValue { kind, names, find }
}

impl<T> FileValue for NamedValue<T> {
    type Out = T;

    fn shape(&self) -> FileShape {
        FileShape::Named(self.kind.word(), (self.names)())
    }

    fn read(&self, _: &str, written: Spanned<DeValue<'_>>, draft: &mut Draft) -> Option<T> {
        let place = written.span();
        let name = Spanned::new(place, draft.faults.read::<String>(written)?);
        let found = (self.find)(name.get_ref());
        if found.is_none() {
            draft.faults.unknown(self.kind, &name, &(self.names)());
        }
        found
    }
}
