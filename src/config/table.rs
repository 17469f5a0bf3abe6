//! The settings of the swarm table: its columns, and the column that orders the rows. The rows are ordered in `app`:
//! `state/column` compares two vehicles, `arrange` in `room/fly` sorts.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use strum::{EnumString, IntoStaticStr, VariantNames};

use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TableConfig {
    /// The columns from the left; empty means as many as fit.
    pub columns: Vec<Column>,
    /// The order of the rows.
    pub sort: TableSort,
}

/// A column of the swarm table, in the order of display. Its names are used in the configuration and in commands.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, EnumString, IntoStaticStr, VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Column {
    Id,
    Name,
    /// The groups that the vehicle belongs to.
    Group,
    /// Who flies the vehicle, where several people fly.
    Pilot,
    Mode,
    /// Whether the vehicle is armed, or ready to be armed.
    Armed,
    /// On the ground or in the air.
    State,
    /// Height above home in metres.
    #[strum(serialize = "alt")]
    Altitude,
    Speed,
    #[strum(serialize = "bat")]
    Battery,
    /// Kind of GPS fix, and satellites.
    Gps,
    /// The share of the vehicle's messages that arrive.
    Link,
    Home,
    /// The newest command and its state.
    Command,
    /// Distance to the vehicle's target.
    ToGo,
    Heading,
    Climb,
    /// Voltage of the main pack.
    #[strum(serialize = "volt")]
    Voltage,
    #[strum(serialize = "amps")]
    Current,
    Used,
    /// Horizontal dilution of precision.
    Hdop,
    /// Round-trip time of a message.
    RoundTrip,
    /// The worst test ratio of the EKF.
    Ekf,
    #[strum(serialize = "vibe")]
    Vibration,
    /// The plan item that is being flown.
    Item,
    /// The distance and the time to the plan item that is being flown.
    Next,
    /// The time to the end of the plan.
    End,
    /// Height above mean sea level in metres.
    Sea,
    #[strum(serialize = "lat")]
    Latitude,
    #[strum(serialize = "lon")]
    Longitude,
    /// The most serious alert, and its duration.
    Alert,
}

/// The order of the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TableSort {
    pub column: Column,
    /// Whether the largest value comes first.
    pub reversed: bool,
}

impl Column {
    /// The names of all columns.
    pub const NAMES: &'static [&'static str] = Self::VARIANTS;

    pub fn name(self) -> &'static str {
        self.into()
    }

    pub fn title(self) -> Text {
        Text::new(format!("column-{}", self.name()), Vec::new())
    }

    /// The column with this name.
    ///
    /// # Errors
    /// There is no such column; the span covers the whole word.
    pub fn read(word: &str) -> Result<Self, Diagnostic> {
        word.parse().map_err(|_| {
            Diagnostic::new(0..word.len(), text!("fly-no-column", word = word))
                .with_help(text!("fly-columns-are", columns = Self::NAMES.join(" ")))
                .with_nearest(word, Self::NAMES.iter().copied())
        })
    }
}

impl TableSort {
    /// Sorted by vehicle number; the default.
    pub const BY_ID: Self = Self {
        column: Column::Id,
        reversed: false,
    };

    /// Reads `bat`, or `-bat` for the largest first.
    ///
    /// # Errors
    /// There is no such column; the span covers the whole word.
    pub fn read(word: &str) -> Result<Self, Diagnostic> {
        let name = word.strip_prefix('-');
        let column = Column::read(name.unwrap_or(word)).map_err(|fault| Diagnostic {
            span: 0..word.len(),
            ..fault
        })?;
        Ok(Self {
            column,
            reversed: name.is_some(),
        })
    }

    /// The name of the column in lower case, for files.
    pub fn name(self) -> String {
        let mark = if self.reversed { "-" } else { "" };
        format!("{mark}{}", self.column.name())
    }
}

impl Default for TableSort {
    fn default() -> Self {
        Self::BY_ID
    }
}

impl Serialize for Column {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for Column {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        Self::read(&word).map_err(|fault| D::Error::custom(fault.message))
    }
}

/// Writes the default order as an empty string.
impl Serialize for TableSort {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if *self == Self::default() {
            return serializer.serialize_str("");
        }
        serializer.serialize_str(&self.name())
    }
}

impl<'de> Deserialize<'de> for TableSort {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        if word.is_empty() {
            return Ok(Self::default());
        }
        Self::read(&word).map_err(|fault| D::Error::custom(fault.message))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_orders_read_back() {
        for name in Column::NAMES {
            assert_eq!(Column::read(name).map(Column::name), Ok(*name));
            let reversed = format!("-{name}");
            assert_eq!(
                TableSort::read(&reversed).map(TableSort::name),
                Ok(reversed)
            );
        }
        assert!(TableSort::read("colour").is_err());
    }
}
