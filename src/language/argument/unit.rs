//! The units of numbers, and their spellings.

use crate::plan::field::FieldUnit;

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
    pub(in crate::language) fn spellings(self) -> &'static [(&'static str, f64)] {
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

/// The value of an item's parameter with its unit, as a line may contain it.
pub fn field_text(value: f32, unit: FieldUnit) -> String {
    format!("{value}{}", Unit::of_field(unit).symbol())
}
