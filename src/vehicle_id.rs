//! The numbers of vehicles, and sets of them in the notation `1-4,7`.

use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::text;
use crate::text::Text;

/// The number by which users and the command language address a vehicle. It is the vehicle's system id, unless a swarm
/// is larger than the 255 ids of MAVLink.
pub type VehicleId = u16;

/// The highest number of a vehicle, since tables have room for four digits.
pub const HIGHEST_VEHICLE: VehicleId = 9999;

/// Vehicles by number, written as [`ranges`].
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct VehicleIds(Vec<VehicleId>);

impl VehicleIds {
    /// The numbers, sorted, each once.
    pub fn iter(&self) -> impl Iterator<Item = VehicleId> {
        self.0.iter().copied()
    }
}

impl From<Vec<VehicleId>> for VehicleIds {
    fn from(mut ids: Vec<VehicleId>) -> Self {
        ids.sort_unstable();
        ids.dedup();
        Self(ids)
    }
}

impl FromStr for VehicleIds {
    type Err = Text;

    fn from_str(text: &str) -> Result<Self, Text> {
        parse_ranges(text).map(Self)
    }
}

impl TryFrom<String> for VehicleIds {
    type Error = Text;

    fn try_from(text: String) -> Result<Self, Text> {
        text.parse()
    }
}

impl From<VehicleIds> for String {
    fn from(ids: VehicleIds) -> Self {
        ranges(ids.0)
    }
}

/// Ids as ranges, `1-4,7`. The ids must be sorted.
pub fn ranges(ids: impl IntoIterator<Item = VehicleId>) -> String {
    let ids: Vec<VehicleId> = ids.into_iter().collect();
    let runs = ids.chunk_by(|a, b| a.checked_add(1) == Some(*b));
    let parts = runs.map(|run| match run {
        [first, .., last] => format!("{first}-{last}"),
        one => one.first().copied().unwrap_or_default().to_string(),
    });
    parts.collect::<Vec<_>>().join(",")
}

/// Reads the notation of [`ranges`], with its parts in any order; the numbers returned are sorted,
/// each once.
///
/// # Errors
/// A text if a part is neither a number from 1 to 9999 nor a range of them.
pub fn parse_ranges(text: &str) -> Result<Vec<VehicleId>, Text> {
    let mut ids = Vec::new();
    for part in text.split(',') {
        let (first, last) = part.split_once('-').unwrap_or((part, part));
        let number = |word: &str| match word.trim().parse::<VehicleId>() {
            Ok(id) if (1..=HIGHEST_VEHICLE).contains(&id) => Ok(id),
            _ => Err(text!("ids-wrong", word = part)),
        };
        let (first, last) = (number(first)?, number(last)?);
        ids.extend(first.min(last)..=first.max(last));
    }
    ids.sort_unstable();
    ids.dedup();
    Ok(ids)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn ranges_are_short_and_exact() {
        assert_eq!(ranges([1, 2, 3, 4, 7, 9, 10, 255]), "1-4,7,9-10,255");
        assert_eq!(ranges([]), "");
        assert_eq!(parse_ranges("9-7,1"), Ok(vec![1, 7, 8, 9]));
        for wrong in ["", "0", "10000", "1-", "1,,2", "a", "-3"] {
            assert!(parse_ranges(wrong).is_err(), "{wrong}");
        }
    }

    proptest! {
        #[test]
        fn what_is_written_reads_back(ids in proptest::collection::btree_set(1..=HIGHEST_VEHICLE, 1..40)) {
            let ids: Vec<_> = ids.into_iter().collect();
            prop_assert_eq!(parse_ranges(&ranges(ids.clone())), Ok(ids));
        }
    }
}
