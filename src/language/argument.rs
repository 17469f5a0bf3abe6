//! The arguments of a verb, as the table declares them, and their values.

use std::ops::Range;
use std::str::FromStr;

use strum::{EnumString, VariantNames};

use super::VehicleChoice;
use super::names::NameList;
use crate::draft::Items;
use crate::geo::{LatLon, Outline};
use crate::plan::field::FieldUnit;
use crate::text;
use crate::text::Text;

/// The maximum number of choices listed in a usage.
const CHOICES_IN_USAGE: usize = 10;

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
    /// The message that explains it; empty if it is obvious.
    pub help: &'static str,
}

impl Argument {
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

    /// Its meaning and its valid values, such as "height above home, 0.5 to 1000 m".
    pub(super) fn explained(&self) -> Text {
        let meaning = Some(self.meaning()).filter(|text| !text.is_empty());
        let parts = meaning.into_iter().chain(self.kind.limits());
        Text::joined(", ", parts.collect())
    }

    /// Its meaning, without the values.
    pub(super) fn meaning(&self) -> Text {
        match self.help {
            "" => Text::default(),
            id => Text::new(id, Vec::new()),
        }
    }
}

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

/// The kind of value of an argument; it also provides the completions.
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
    /// A name from a list that only the console knows.
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
    /// Items of a list: a number or a range, `3-5`.
    Items,
    /// A command of a plan by its word, such as `waypoint`, or by its name in MAVLink.
    PlanCommand,
    /// A parameter of an item by its name, such as `hold`.
    PlanField,
}

impl Kind {
    /// Whether it is a choice short enough to be listed in a usage.
    pub(super) fn fits_a_usage(self) -> bool {
        !matches!(self, Self::Choice(words) if words.len() > CHOICES_IN_USAGE)
    }

    /// The range of a number as text, or the words of a long choice.
    pub(super) fn limits(self) -> Option<Text> {
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

/// The unit of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    None,
    Metres,
    MetresPerSecond,
    Seconds,
    Degrees,
    DegreesPerSecond,
    Hertz,
    Microseconds,
    Percent,
}

impl Unit {
    /// The unit of a parameter of a plan's item.
    pub fn of_field(unit: FieldUnit) -> Self {
        match unit {
            FieldUnit::None => Self::None,
            FieldUnit::Metres => Self::Metres,
            FieldUnit::MetresPerSecond => Self::MetresPerSecond,
            FieldUnit::Seconds => Self::Seconds,
            FieldUnit::Degrees => Self::Degrees,
            FieldUnit::DegreesPerSecond => Self::DegreesPerSecond,
            FieldUnit::Microseconds => Self::Microseconds,
            FieldUnit::Percent => Self::Percent,
        }
    }

    pub fn symbol(self) -> &'static str {
        self.spellings().first().map_or("", |&(symbol, _)| symbol)
    }

    /// The accepted spellings with their factors; the first is the unit itself.
    pub(super) fn spellings(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::None => &[],
            Self::Metres => &[("m", 1.0), ("km", 1000.0)],
            Self::MetresPerSecond => &[("m/s", 1.0), ("mps", 1.0), ("km/h", 1.0 / 3.6)],
            Self::Seconds => &[
                ("s", 1.0),
                ("sec", 1.0),
                ("min", 60.0),
                ("ms", 0.001),
                ("h", 3600.0),
            ],
            Self::Degrees => &[("deg", 1.0), ("°", 1.0)],
            Self::DegreesPerSecond => &[("deg/s", 1.0), ("°/s", 1.0)],
            Self::Hertz => &[("Hz", 1.0)],
            Self::Microseconds => &[("us", 1.0)],
            Self::Percent => &[("%", 1.0)],
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Flag,
    Number(f64),
    Word(String),
    Vehicles(VehicleChoice),
    Point(LatLon),
    Area(Outline),
    Items(Items),
}

/// A fault in the combination of arguments.
pub(super) struct Problem {
    /// The argument that the fault points at.
    pub argument: &'static str,
    pub message: Text,
}

impl Problem {
    pub fn new(argument: &'static str, message: Text) -> Self {
        Self { argument, message }
    }

    fn missing(argument: &'static str) -> Self {
        Self::new(argument, text!("grammar-is-missing", argument = argument))
    }
}

/// The arguments of one line by name.
#[derive(Debug, Clone, Default)]
pub(super) struct Arguments {
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

    /// The position of an argument.
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
        match self.get(name)? {
            Value::Number(number) => Some(*number),
            Value::Flag
            | Value::Word(_)
            | Value::Vehicles(_)
            | Value::Point(_)
            | Value::Area(_)
            | Value::Items(_) => None,
        }
    }

    pub fn word(&self, name: &str) -> Option<&str> {
        match self.get(name)? {
            Value::Word(word) => Some(word),
            Value::Flag
            | Value::Number(_)
            | Value::Vehicles(_)
            | Value::Point(_)
            | Value::Area(_)
            | Value::Items(_) => None,
        }
    }

    /// All values of a repeatable argument.
    pub fn words(&self, name: &str) -> Vec<&str> {
        let named = self.values.iter().filter(|(known, _, _)| *known == name);
        let words = named.filter_map(|(_, value, _)| match value {
            Value::Word(word) => Some(word.as_str()),
            Value::Flag
            | Value::Number(_)
            | Value::Vehicles(_)
            | Value::Point(_)
            | Value::Area(_)
            | Value::Items(_) => None,
        });
        words.collect()
    }

    pub fn point(&self, name: &str) -> Option<LatLon> {
        match self.get(name)? {
            Value::Point(point) => Some(*point),
            Value::Flag
            | Value::Number(_)
            | Value::Word(_)
            | Value::Vehicles(_)
            | Value::Area(_)
            | Value::Items(_) => None,
        }
    }

    /// Vehicles that the form requires.
    pub fn required_vehicles(&self, name: &'static str) -> Result<VehicleChoice, Problem> {
        self.vehicles(name).ok_or_else(|| Problem::missing(name))
    }

    pub fn vehicles(&self, name: &str) -> Option<VehicleChoice> {
        match self.get(name)? {
            Value::Vehicles(choice) => Some(choice.clone()),
            Value::Flag
            | Value::Number(_)
            | Value::Word(_)
            | Value::Point(_)
            | Value::Area(_)
            | Value::Items(_) => None,
        }
    }

    /// An area that the form requires.
    pub fn required_area(&self, name: &'static str) -> Result<&Outline, Problem> {
        match self.get(name) {
            Some(Value::Area(outline)) => Ok(outline),
            _ => Err(Problem::missing(name)),
        }
    }

    /// Items that the form requires.
    pub fn required_items(&self, name: &'static str) -> Result<Items, Problem> {
        match self.get(name) {
            Some(Value::Items(items)) => Ok(*items),
            _ => Err(Problem::missing(name)),
        }
    }

    /// A number that the form requires.
    pub fn required(&self, name: &'static str) -> Result<f64, Problem> {
        self.number(name).ok_or_else(|| Problem::missing(name))
    }

    /// The meaning of a word of a [`Kind::Choice`].
    ///
    /// # Errors
    /// The word has none.
    pub fn choice<T: FromStr>(&self, name: &'static str) -> Result<Option<T>, Problem> {
        let word = self.word(name).map(str::parse).transpose();
        word.map_err(|_| Problem::new(name, text!("grammar-unknown-word")))
    }

    /// The meaning of a word of a [`Kind::Choice`] that the form requires.
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
