//! Vehicles in a line to the console.

use super::lexer::Word;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::vehicle_id::parse_ranges;

/// Vehicles in a line to the console. They are resolved when the line is carried out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum VehicleChoice {
    All,
    None,
    /// The vehicles in the filtered table.
    Filter,
    /// The vehicles in the filtered table that are not selected.
    Invert,
    /// These vehicles, sorted, each once.
    Ids(Vec<VehicleId>),
    /// A named group, without the `@`.
    Group(String),
}

impl VehicleChoice {
    /// Reads `all`, `1-4,7`, `@red`, `none`, `filter` or `invert`.
    ///
    /// # Errors
    /// The word names no vehicles.
    pub fn read(word: &Word) -> Result<Self, Text> {
        if let Some(group) = word.text.strip_prefix('@') {
            return Ok(Self::Group(group.to_owned()));
        }
        match word.text {
            "none" => Ok(Self::None),
            "filter" => Ok(Self::Filter),
            "invert" => Ok(Self::Invert),
            _ if word.is("all") => Ok(Self::All),
            _ if word.is_targets() => parse_ranges(word.text).map(Self::Ids),
            _ => Err(text!("grammar-no-vehicles", word = word.text)),
        }
    }
}
