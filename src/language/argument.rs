//! The arguments of a verb, as the table declares them, and their values.

use super::names::NameList;
use crate::text::Text;

mod given;
mod kind;
mod unit;

pub(super) use given::{Arguments, Problem, Value};
pub use kind::{Kind, Switch};
pub use unit::{Unit, field_text};

/// One argument of a [`Form`](super::Form).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Argument {
    /// Its name for the builder; in capitals, it is the placeholder of its value in the usage.
    pub name: &'static str,
    /// The word before the value; empty for a value alone.
    pub keyword: &'static str,
    /// The kind of value.
    pub kind: Kind,
    /// Whether it is optional.
    pub optional: bool,
    /// Whether it can be repeated.
    pub repeated: bool,
    /// The id of the text that explains it; empty if it is obvious.
    pub help: &'static str,
}

impl Argument {
    /// Whether it is a text for people or a name of the user's own, in any language; other words to the end of the line
    /// are files, addresses, times or settings.
    pub(super) fn is_free_text(&self) -> bool {
        matches!(self.kind, Kind::Rest | Kind::Proposed(_)) && matches!(self.name, "text" | "name")
    }

    /// Whether it is a seat of the class, which may also be the last word of a line.
    pub(super) fn is_seat(&self) -> bool {
        self.kind == Kind::Name(NameList::Seat)
    }

    /// A value without a keyword.
    pub(super) const fn value(name: &'static str, kind: Kind, help: &'static str) -> Self {
        Self {
            name,
            keyword: "",
            kind,
            optional: false,
            repeated: false,
            help,
        }
    }

    /// A value after its keyword.
    pub(super) const fn keyed(
        keyword: &'static str,
        name: &'static str,
        kind: Kind,
        help: &'static str,
    ) -> Self {
        Self {
            name,
            keyword,
            kind,
            optional: false,
            repeated: false,
            help,
        }
    }

    /// A keyword without a value.
    pub(super) const fn flag(keyword: &'static str, help: &'static str) -> Self {
        Self {
            name: keyword,
            keyword,
            kind: Kind::Flag,
            optional: false,
            repeated: false,
            help,
        }
    }

    /// The argument, made optional.
    pub(super) const fn optional(self) -> Self {
        Self {
            optional: true,
            ..self
        }
    }

    /// The argument, made repeatable and optional.
    pub(super) const fn repeated(self) -> Self {
        Self {
            optional: true,
            repeated: true,
            ..self
        }
    }

    /// The placeholder of the value in a usage line: its name in capitals, or a short list of choices.
    pub(super) fn placeholder(&self) -> String {
        match self.kind {
            Kind::Choice(words) if self.kind.fits_a_usage() => words.join("|"),
            Kind::Point => "LAT LON|PLACE".to_owned(),
            Kind::Sort => "[-]COLUMN".to_owned(),
            _ => self.name.to_uppercase(),
        }
    }

    /// Keyword and value in a usage line.
    pub(super) fn usage(&self) -> String {
        let more = if self.repeated { "..." } else { "" };
        match (self.keyword, self.kind) {
            (keyword, Kind::Flag) => keyword.to_owned(),
            ("", _) => format!("{}{more}", self.placeholder()),
            (keyword, _) => format!("{keyword} {}{more}", self.placeholder()),
        }
    }

    /// A fault in a number, with its argument, so that the reader knows which of several numbers is meant.
    pub(super) fn about(&self, message: Text) -> Text {
        match self.kind {
            Kind::Number(..) | Kind::Whole(..) => {
                Text::joined(": ", vec![self.placeholder().into(), message])
            }
            _ => message,
        }
    }

    /// The argument's meaning and its valid values, such as "height above home, 0.5 to 1000 m".
    pub(super) fn explained(&self) -> Text {
        let meaning = Some(self.meaning()).filter(|text| !text.is_empty());
        let parts = meaning.into_iter().chain(self.kind.advice());
        Text::joined(", ", parts.collect())
    }

    /// The argument's meaning, without the values.
    pub(super) fn meaning(&self) -> Text {
        match self.help {
            "" => Text::default(),
            id => Text::new(id, Vec::new()),
        }
    }
}
