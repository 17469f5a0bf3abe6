//! The kinds of values.

use strum::{EnumString, VariantNames};

use super::unit::Unit;
use crate::language::names::NameList;
use crate::text;
use crate::text::Text;

const CHOICES_IN_USAGE: usize = 10;
/// The bound, in both directions, from which a range only guards against typing errors.
const BOUNDLESS: f64 = 100_000.0;

/// The words of a switch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Switch {
    On,
    Off,
}

impl Switch {
    pub const KIND: Kind = Kind::Choice(Self::VARIANTS);
}

/// The kind of value of an argument; it also determines the completions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// No value, only the keyword.
    Flag,
    /// A number with a unit, from a minimum to a maximum.
    Number(Unit, f64, f64),
    /// A whole number with a unit, from a minimum to a maximum.
    Whole(Unit, f64, f64),
    /// One of these words.
    Choice(&'static [&'static str]),
    /// A flight mode, by name or number.
    Mode,
    /// A named place, or latitude and longitude in degrees.
    Point,
    Area,
    Parameter,
    /// A MAVLink message, by name or id.
    Message,
    /// A `MAV_CMD`, by name or number.
    MavCommand,
    /// A name from a list that the console provides.
    Name(NameList),
    /// The name of a group, existing or new, with or without `@`.
    Group,
    /// Vehicles for the console: targets, `none`, `filter` or `invert`. They are resolved when the line is carried
    /// out.
    Vehicles,
    /// A column of the swarm table, with `-` before it for descending order.
    Sort,
    /// The rest of the line, as typed.
    Rest,
    /// The rest of the line, as typed; the names of a list are proposed.
    Proposed(NameList),
    /// The fields of a message, `NAME=VALUE`: the rest of the line, as typed.
    Fields,
    /// The file of a plan: the rest of the line, as typed.
    PlanFile,
    /// Items of a list: a number or a range, `3-5`.
    Items,
    /// A command of a plan by its word, such as `waypoint`, or by its name in MAVLink.
    PlanCommand,
    /// A parameter of an item by its name, such as `hold`.
    PlanField,
}

impl Kind {
    /// Whether the kind is a choice short enough to be listed in a usage line.
    pub(in crate::language) fn fits_a_usage(self) -> bool {
        !matches!(self, Self::Choice(words) if words.len() > CHOICES_IN_USAGE)
    }

    /// What helps to write a value: [`limits`](Self::limits), but of a range so wide that it only guards against typing
    /// errors, the unit alone.
    pub(in crate::language) fn advice(self) -> Option<Text> {
        match self {
            Self::Number(unit, least, greatest) if -least >= BOUNDLESS && greatest >= BOUNDLESS => {
                let symbol = unit.symbol();
                (!symbol.is_empty()).then(|| text!("grammar-in-unit", unit = symbol))
            }
            _ => self.limits(),
        }
    }

    /// The range of a number as text, or the words of a long choice; `None` for other kinds.
    pub(in crate::language) fn limits(self) -> Option<Text> {
        if let Self::Choice(words) = self
            && !self.fits_a_usage()
        {
            return Some(words.join(", ").into());
        }
        let (Self::Number(unit, least, greatest) | Self::Whole(unit, least, greatest)) = self
        else {
            return None;
        };
        let (least, most) = (least.to_string(), greatest.to_string());
        let is_endless = greatest >= f64::from(f32::MAX);
        Some(match unit.symbol() {
            "" if is_endless => text!("grammar-a-number"),
            symbol if is_endless => text!("grammar-in-unit", unit = symbol),
            "" => text!("grammar-range", least = least, most = most),
            symbol => text!(
                "grammar-range-in-unit",
                least = least,
                most = most,
                unit = symbol
            ),
        })
    }
}
