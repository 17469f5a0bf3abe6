//! Parameters: the list of a vehicle's, files of them, and what differs between two.

use std::sync::Arc;

mod difference;
mod file;
mod kind;
mod list;

pub use difference::{
    ParameterDifference, ParameterFinding, differences, is_same, is_the_vehicles_own,
};
pub use file::{parse, write};
pub use kind::{ParameterType, ParameterUnfit};
pub use list::{HeardParameter, ListedParameter, ParameterList};
pub use sortie_sim::{AliasSense, other_name};

/// How far the download of a vehicle's list has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Fetching {
    /// The list was not requested yet.
    #[default]
    NotAsked,
    /// It is coming; what is missing is asked for again.
    UnderWay {
        /// Requests in a row that nothing new came of.
        fruitless: u16,
    },
    Complete,
    /// The vehicle has stopped answering although it is heard. A new request or a link that comes back goes on.
    Stalled,
}

impl Fetching {
    /// Whether more is still expected.
    pub fn is_under_way(self) -> bool {
        matches!(self, Self::UnderWay { .. })
    }
}

/// What is known of a vehicle's parameters at some moment. Cloning it copies no value.
#[derive(Debug, Clone, Default)]
pub struct ParameterSnapshot {
    pub list: Arc<ParameterList>,
    /// How far its download is.
    pub fetching: Fetching,
    /// How often the vehicle has rebooted by now. A list begins anew with each time: settings may have been lost.
    pub reboots: u32,
}

/// A value as it is read and written: the shortest decimal number that means the same `f32`.
pub fn shown(value: f32) -> String {
    let plain = value.to_string();
    if plain.len() <= LONGEST_PLAIN {
        plain
    } else {
        format!("{value:e}")
    }
}

/// Longer numbers are shown with an exponent: columns have their width.
const LONGEST_PLAIN: usize = 12;
