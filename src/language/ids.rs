//! Sets of vehicles in the notation `1-4,7`.

use super::Targets;
use crate::text;
use crate::text::Text;
use crate::vehicle::{HIGHEST_VEHICLE, VehicleId};

/// Ids as ranges, `1-4,7`. The ids must be sorted.
pub fn ranges(ids: impl IntoIterator<Item = VehicleId>) -> String {
    Targets::Ids(ids.into_iter().collect()).to_string()
}

/// Reads the notation of [`ranges`], in any order.
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
