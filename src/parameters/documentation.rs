//! What is documented about parameters: the files of ArduPilot (`apm.pdef.xml`, `apm.pdef.json`) and PX4
//! (`parameters.json`).
//!
//! Such a file describes one version of one firmware, so its limits are advice: a value outside of them may be right
//! for the vehicle.

use std::collections::BTreeMap;

use super::is_whole;
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

mod json;
mod xml;

/// A documented bit has a number below this: parameters are sent with 32 bits.
const BITS: u32 = 32;

/// The documentation of parameters, by name.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ParameterDocuments {
    by_name: BTreeMap<String, ParameterDocument>,
}

/// The documentation of one parameter; texts are empty if the file has none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ParameterDocument {
    /// What the parameter sets, in a few words.
    pub title: String,
    pub description: String,
    /// The unit of the value, as the firmware writes it.
    pub unit: String,
    pub range: Option<DocumentedRange>,
    /// The step between sensible values.
    pub increment: Option<f64>,
    /// The meaning of single values, in ascending order.
    pub values: Vec<NamedValue>,
    /// The meaning of the bits of a mask, in ascending order.
    pub bits: Vec<NamedBit>,
    /// Whether a new value takes effect only after a reboot.
    pub needs_reboot: bool,
}

/// The documented limits of a value; a missing limit is infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DocumentedRange {
    pub least: f64,
    pub most: f64,
}

/// A value with its meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedValue {
    pub value: f64,
    pub name: String,
}

/// A bit of a mask with its meaning.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedBit {
    /// Its number, from 0.
    pub bit: u32,
    pub name: String,
}

/// A file of documentation as far as it could be read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadDocuments {
    pub documents: ParameterDocuments,
    /// Every fault, with its place; the part of a parameter that has a fault is left out.
    pub faults: Vec<Diagnostic>,
}

/// Why a value contradicts the documentation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParameterDoubt {
    OutsideRange(DocumentedRange),
    /// Only certain values are documented, and this is none of them.
    NotListed,
    /// The mask has bits without a documented meaning.
    UnknownBits,
}

impl ParameterDocuments {
    /// Reads a file of documentation: XML or JSON.
    pub fn read(text: &str) -> ReadDocuments {
        let content = text.trim_start_matches('\u{feff}').trim_start();
        if content.starts_with('<') {
            return xml::read(text);
        }
        if content.starts_with('{') {
            return json::read(text);
        }
        let fault = Diagnostic::new(0..0, text!("documentation-unknown"));
        ReadDocuments {
            faults: vec![fault.with_help(text!("documentation-unknown-help"))],
            ..ReadDocuments::default()
        }
    }

    /// The documentation of a parameter, if there is any.
    pub fn get(&self, name: &str) -> Option<&ParameterDocument> {
        self.by_name.get(name)
    }

    /// The number of documented parameters.
    pub fn len(&self) -> usize {
        self.by_name.len()
    }

    /// Whether nothing is documented.
    pub fn is_empty(&self) -> bool {
        self.by_name.is_empty()
    }

    /// Adds a parameter. If a file documents one twice, the first counts.
    fn add(&mut self, name: &str, mut document: ParameterDocument) {
        document.values.sort_by(|a, b| a.value.total_cmp(&b.value));
        document.bits.sort_by_key(|bit| bit.bit);
        self.by_name.entry(name.to_owned()).or_insert(document);
    }
}

impl ParameterDocument {
    /// The meaning of a value: its name, or the names of its bits; `None` if neither is documented.
    pub fn meaning(&self, value: f64) -> Option<String> {
        if let Some(named) = self.values.iter().find(|it| is_equal(it.value, value)) {
            return Some(named.name.clone());
        }
        let mask = mask(value).filter(|mask| *mask != 0)?;
        let is_set = |bit: &&NamedBit| mask & (1 << bit.bit) != 0;
        let names: Vec<&str> = self
            .bits
            .iter()
            .filter(is_set)
            .map(|it| it.name.as_str())
            .collect();
        (!names.is_empty()).then(|| names.join(" + "))
    }

    /// The meaning of a value, otherwise its unit; empty if neither is documented.
    pub fn remark(&self, value: f64) -> String {
        self.meaning(value).unwrap_or_else(|| self.unit.clone())
    }

    /// The meaning of a value or its unit, and the parameter's title, on one line.
    pub fn about(&self, value: f64) -> String {
        let parts = [self.remark(value), self.title.clone()];
        let known: Vec<String> = parts.into_iter().filter(|it| !it.is_empty()).collect();
        known.join(" · ")
    }

    /// Why a value contradicts the documentation; `None` if it does not.
    pub fn doubt(&self, value: f64) -> Option<ParameterDoubt> {
        if self.values.iter().any(|it| is_equal(it.value, value)) {
            return None;
        }
        if let Some(range) = self.range {
            let is_inside = (range.least..=range.most).contains(&value);
            return (!is_inside).then_some(ParameterDoubt::OutsideRange(range));
        }
        if !self.bits.is_empty() {
            let known = self.bits.iter().fold(0, |mask, bit| mask | 1 << bit.bit);
            let is_known = mask(value).is_some_and(|mask| mask & !known == 0);
            return (!is_known).then_some(ParameterDoubt::UnknownBits);
        }
        (!self.values.is_empty()).then_some(ParameterDoubt::NotListed)
    }
}

impl DocumentedRange {
    /// The range of two limits; `None` if neither is finite, or the range is empty.
    fn new(least: f64, most: f64) -> Option<Self> {
        let is_range = least <= most && (least.is_finite() || most.is_finite());
        is_range.then_some(Self { least, most })
    }

    /// The limits in words.
    pub fn text(self) -> Text {
        let (least, most) = (self.least.to_string(), self.most.to_string());
        match (self.least.is_finite(), self.most.is_finite()) {
            (true, true) => text!("documentation-range", least = least, most = most),
            (true, false) => text!("documentation-least", least = least),
            (false, _) => text!("documentation-most", most = most),
        }
    }
}

impl ParameterDoubt {
    /// The warning in words, for a value of the parameter of that name.
    pub fn text(self, name: &str, value: f64) -> Text {
        let value = value.to_string();
        match self {
            Self::OutsideRange(range) => text!(
                "documentation-outside",
                name = name,
                value = value,
                range = range.text()
            ),
            Self::NotListed => text!("documentation-not-listed", name = name, value = value),
            Self::UnknownBits => text!("documentation-unknown-bits", name = name, value = value),
        }
    }
}

/// Whether a value is the documented one, which may have been rounded to a float.
#[expect(
    clippy::float_cmp,
    reason = "a documented value is meant exactly, but for the rounding of fractions to a float"
)]
fn is_equal(documented: f64, value: f64) -> bool {
    let is_rounded = !is_whole(documented) || !is_whole(value);
    documented == value || is_rounded && documented as f32 == value as f32
}

/// A value as a mask; `None` if it is not a whole number of 32 bits.
fn mask(value: f64) -> Option<u32> {
    let is_mask = value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value);
    is_mask.then_some(value as u32)
}

/// A text on one line, without control characters, which would disturb the screen.
fn plain(text: &str) -> String {
    let is_gap = |letter: char| letter.is_whitespace() || letter.is_control();
    let words = text.split(is_gap).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join(" ")
}

/// The number of a documented bit, if parameters have it.
fn bit_number(written: &str) -> Option<u32> {
    written.trim().parse().ok().filter(|bit| *bit < BITS)
}

#[cfg(test)]
mod tests;
