//! Parameters: the list of a vehicle, parameter files, differences between two lists, and what is documented.

use std::sync::Arc;

mod difference;
mod documentation;
mod file;
mod kind;
mod list;
mod packed;

pub use difference::{
    ParameterDifference, ParameterFinding, differences, is_same, is_the_vehicles_own,
};
pub use documentation::{
    DocumentedRange, NamedBit, NamedValue, ParameterDocument, ParameterDocuments, ParameterDoubt,
    ReadDocuments,
};
pub use file::{parse, write};
pub use kind::{ParameterType, ParameterUnfit};
pub use list::{HeardParameter, ListedParameter, ParameterList};
pub use packed::{DEFAULTS_FILE, read_defaults};
pub use sortie_sim::{AliasSense, other_name};

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
}

/// A value as text: the shortest decimal number that reads as the same `f32`.
pub fn shown(value: f32) -> String {
    let plain = value.to_string();
    if plain.len() <= LONGEST_PLAIN {
        plain
    } else {
        format!("{value:e}")
    }
}

/// Longer numbers are shown with an exponent, to fit their column.
const LONGEST_PLAIN: usize = 12;
