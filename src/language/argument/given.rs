//! The values of a line's arguments.

use std::ops::Range;
use std::str::FromStr;

use strum::EnumTryAs;

use super::kind::Switch;
use crate::diagnostic::Diagnostic;
use crate::draft::Items;
use crate::geo::{LatLon, Outline};
use crate::language::VehicleChoice;
use crate::text;
use crate::text::Text;

#[derive(Debug, Clone, PartialEq, EnumTryAs)]
pub(in crate::language) enum Value {
    Flag,
    Number(f64),
    Word(String),
    Vehicles(VehicleChoice),
    Point(LatLon),
    Area(Outline),
    Items(Items),
}

/// A fault in the combination of arguments.
pub(in crate::language) struct Problem {
    /// The argument that the fault points at.
    pub argument: &'static str,
    pub message: Text,
    detail: Option<Box<ProblemDetail>>,
}

/// The place of a fault inside its argument, and advice; boxed because few faults have them.
#[derive(Default)]
struct ProblemDetail {
    part: Option<Range<usize>>,
    help: Option<Text>,
}

impl Problem {
    pub fn new(argument: &'static str, message: Text) -> Self {
        Self {
            argument,
            message,
            detail: None,
        }
    }

    /// A fault in a part of an argument that is a text of its own.
    pub fn within(argument: &'static str, fault: Diagnostic) -> Self {
        let part = Some(fault.span);
        let help = fault.help;
        Self {
            argument,
            message: fault.message,
            detail: Some(Box::new(ProblemDetail { part, help })),
        }
    }

    /// The same fault, with advice on how to repair it.
    pub fn with_help(mut self, help: Text) -> Self {
        self.detail.get_or_insert_default().help = Some(help);
        self
    }

    /// The fault in a line in which its argument has this place.
    pub fn at(self, argument: Range<usize>) -> Diagnostic {
        let ProblemDetail { part, help } = self.detail.map(|detail| *detail).unwrap_or_default();
        let span = match part {
            Some(part) => argument.start + part.start..argument.start + part.end,
            None => argument,
        };
        Diagnostic {
            span,
            message: self.message,
            help,
        }
    }

    fn missing(argument: &'static str) -> Self {
        Self::new(argument, text!("grammar-is-missing", argument = argument))
    }
}

/// The arguments of one line by name.
#[derive(Debug, Clone, Default)]
pub(in crate::language) struct Arguments {
    values: Vec<(&'static str, Value, Range<usize>)>,
}

impl Arguments {
    pub fn insert(&mut self, name: &'static str, value: Value, span: Range<usize>) {
        self.values.push((name, value, span));
    }

    fn get(&self, name: &str) -> Option<&Value> {
        self.values
            .iter()
            .find(|(known, _, _)| *known == name)
            .map(|(_, value, _)| value)
    }

    /// The position of an argument; `None` if it was not given.
    pub fn span(&self, name: &str) -> Option<Range<usize>> {
        self.values
            .iter()
            .find(|(known, _, _)| *known == name)
            .map(|(_, _, span)| span.clone())
    }

    pub fn flag(&self, name: &str) -> bool {
        self.get(name).is_some()
    }

    pub fn number(&self, name: &str) -> Option<f64> {
        self.get(name)?.try_as_number_ref().copied()
    }

    pub fn word(&self, name: &str) -> Option<&str> {
        self.get(name)?.try_as_word_ref().map(String::as_str)
    }

    /// All values of a repeatable argument.
    pub fn words(&self, name: &str) -> Vec<&str> {
        let named = self.values.iter().filter(|(known, _, _)| *known == name);
        let words = named.filter_map(|(_, value, _)| value.try_as_word_ref());
        words.map(String::as_str).collect()
    }

    pub fn point(&self, name: &str) -> Option<LatLon> {
        self.get(name)?.try_as_point_ref().copied()
    }

    /// All places of a repeatable argument.
    pub fn points(&self, name: &str) -> Vec<LatLon> {
        let named = self.values.iter().filter(|(known, _, _)| *known == name);
        let points = named.filter_map(|(_, value, _)| value.try_as_point_ref());
        points.copied().collect()
    }

    /// Vehicles that the form requires.
    pub fn required_vehicles(&self, name: &'static str) -> Result<VehicleChoice, Problem> {
        self.vehicles(name).ok_or_else(|| Problem::missing(name))
    }

    pub fn vehicles(&self, name: &str) -> Option<VehicleChoice> {
        self.get(name)?.try_as_vehicles_ref().cloned()
    }

    pub fn area(&self, name: &str) -> Option<&Outline> {
        self.get(name)?.try_as_area_ref()
    }

    /// An area that the form requires.
    pub fn required_area(&self, name: &'static str) -> Result<&Outline, Problem> {
        self.area(name).ok_or_else(|| Problem::missing(name))
    }

    /// Items that the form requires.
    pub fn required_items(&self, name: &'static str) -> Result<Items, Problem> {
        let items = self.get(name).and_then(Value::try_as_items_ref);
        items.copied().ok_or_else(|| Problem::missing(name))
    }

    /// A number that the form requires.
    pub fn required(&self, name: &'static str) -> Result<f64, Problem> {
        self.number(name).ok_or_else(|| Problem::missing(name))
    }

    /// The meaning of a word of a [`Kind::Choice`](super::Kind::Choice); `None` if the word is
    /// missing.
    ///
    /// # Errors
    /// The word has no meaning.
    pub fn choice<T: FromStr>(&self, name: &'static str) -> Result<Option<T>, Problem> {
        let word = self.word(name).map(str::parse).transpose();
        word.map_err(|_| Problem::new(name, text!("grammar-unknown-word")))
    }

    /// The meaning of a word of a [`Kind::Choice`](super::Kind::Choice) that the form requires.
    ///
    /// # Errors
    /// There is no word, or it has no meaning.
    pub fn required_choice<T: FromStr>(&self, name: &'static str) -> Result<T, Problem> {
        self.choice(name)?.ok_or_else(|| Problem::missing(name))
    }

    /// Whether a [`Switch`] that the form requires is on.
    ///
    /// # Errors
    /// There is no such word.
    pub fn required_switch(&self, name: &'static str) -> Result<bool, Problem> {
        Ok(match self.required_choice(name)? {
            Switch::On => true,
            Switch::Off => false,
        })
    }

    /// A word that the form requires.
    pub fn required_word(&self, name: &'static str) -> Result<&str, Problem> {
        self.word(name).ok_or_else(|| Problem::missing(name))
    }

    /// A point that the form requires.
    pub fn required_point(&self, name: &'static str) -> Result<LatLon, Problem> {
        self.point(name).ok_or_else(|| Problem::missing(name))
    }
}
