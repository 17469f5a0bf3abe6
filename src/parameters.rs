//! Parameters: the list of a vehicle, parameter files, differences between two lists, and what is documented.

use std::sync::Arc;

mod difference;
mod documentation;
mod file;
mod kind;
mod list;
mod packed;
mod station;

pub use difference::{
    ParameterDifference, ParameterFinding, differences, is_same, is_the_vehicles_own,
};
pub use documentation::{
    DocumentedRange, NamedBit, NamedValue, ParameterDocument, ParameterDocuments, ParameterDoubt,
    ReadDocuments,
};
pub use file::{parse, write};
pub use kind::{ParameterEncoding, ParameterType, ParameterUnfit};
pub use list::{HeardParameter, ListedParameter, ParameterList};
pub use packed::{DEFAULTS_FILE, read_defaults};
pub use sortie_sim::{AliasSense, other_name};
pub use station::{StationRight, own_system, right_of};

/// The state of the download of a vehicle's list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Fetching {
    /// The list has not been requested yet.
    #[default]
    NotAsked,
    /// The list is arriving; missing values are requested again.
    UnderWay {
        /// The number of requests in a row that brought nothing new.
        fruitless: u16,
    },
    Complete,
    /// The vehicle is heard but no longer answers. A new request or a reconnected link continues the download.
    Stalled,
}

impl Fetching {
    /// Whether further values are expected.
    pub fn is_under_way(self) -> bool {
        matches!(self, Self::UnderWay { .. })
    }
}

/// The known parameters of a vehicle at one moment. Cloning it copies no value.
#[derive(Debug, Clone, Default)]
pub struct ParameterSnapshot {
    pub list: Arc<ParameterList>,
    /// The state of the download.
    pub fetching: Fetching,
    /// How many times the vehicle has rebooted. After each reboot the list starts again, since settings may have been
    /// lost.
    pub reboots: u32,
    /// What the vehicle itself documents; empty until it has been read.
    pub documents: Arc<ParameterDocuments>,
}

/// A value as text, short enough for its column; a whole number of 32 bits in full.
pub fn shown(value: f64) -> String {
    let plain = written(value);
    if plain.len() <= LONGEST_PLAIN {
        plain
    } else {
        format!("{:e}", value as f32)
    }
}

/// A value as text: a whole number in full, any other as the shortest decimal number that reads as the same `f32`.
pub fn written(value: f64) -> String {
    if is_whole(value) {
        value.to_string()
    } else {
        (value as f32).to_string()
    }
}

/// A value as the number that is [`written`]: `0.1` for the float next to it.
pub fn decimal(value: f64) -> f64 {
    written(value).parse().unwrap_or(value)
}

/// Whether a value is a whole number that an integer parameter can have. Such values are kept to the last digit; all
/// others are floats of 32 bits.
fn is_whole(value: f64) -> bool {
    value.fract() == 0.0 && value.abs() <= f64::from(u32::MAX)
}

/// Longer numbers are shown with an exponent, to fit their column.
const LONGEST_PLAIN: usize = 12;
