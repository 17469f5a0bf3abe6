//! Parameters of an item that the vehicle would store with a different value.

use super::{letters, shortened};
use crate::Item;

/// A parameter that does not fit into the vehicle's storage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnstorableValue {
    /// The command of the item.
    pub command: u16,
    /// The number of the parameter, from 1 to 7.
    pub parameter: u8,
    /// The value in the item.
    pub written: f32,
    /// The value that the vehicle would store.
    pub stored: f32,
}

/// The parameters of a plan's item that the vehicle would store as other values, beyond the
/// rounding of its storage. Parameters that the vehicle does not keep, or keeps only as a direction
/// or a flag, do not count.
pub fn unstorable_values(item: &Item) -> impl Iterator<Item = UnstorableValue> {
    let [p1, p2, p3, p4] = item.params;
    let values = [p1, p2, p3, p4, item.x as f32, item.y as f32, item.z];
    let kept = letters(item.command).copied().unwrap_or(*b".......");
    let command = item.command;
    let numbered = (1..).zip(kept).zip(values);
    numbered.filter_map(move |((parameter, letter), written)| {
        let slack = rounding(letter, written)?;
        let stored = shortened(letter, written);
        // A parameter that is not set has no value to lose.
        let is_other = !written.is_nan() && (stored - written).abs() > slack;
        is_other.then_some(UnstorableValue {
            command,
            parameter,
            written,
            stored,
        })
    })
}

/// How far a stored value may be from the written one: fractions are cut off, and in large radii
/// the last digit too. `None` where the vehicle stores the value exactly, or not as a number.
fn rounding(letter: u8, written: f32) -> Option<f32> {
    match letter {
        b't' if written > 0.0 && written < 1.0 => Some(1.0 / 256.0),
        b'r' if written.abs() > 255.0 => Some(10.0),
        b'B' | b'b' | b'H' | b'h' | b'r' | b's' | b't' => Some(1.0),
        b'c' => Some(0.011),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::board::commands;

    fn found(command: u16, params: [f32; 4]) -> Vec<(u8, f32, f32)> {
        let item = Item {
            command,
            params,
            ..Item::default()
        };
        unstorable_values(&item)
            .map(|it| (it.parameter, it.written, it.stored))
            .collect()
    }

    #[test]
    fn values_out_of_range_are_found_with_what_would_be_stored() {
        for (command, params, expected) in [
            (19, [-5.0, 0.0, 0.0, 0.0], vec![(1, -5.0, 65_531.0)]),
            (16, [70_000.0, 0.0, 0.0, 0.0], vec![(1, 70_000.0, 4464.0)]),
            (
                18,
                [300.0, 0.0, 3000.0, 0.0],
                vec![(1, 300.0, 255.0), (3, 3000.0, 2550.0)],
            ),
            (183, [9.0, 70_000.0, 0.0, 0.0], vec![(2, 70_000.0, 4464.0)]),
            (
                177,
                [2.0, 40_000.0, 0.0, 0.0],
                vec![(2, 40_000.0, -25_536.0)],
            ),
            (94, [700.0, 0.0, 0.0, 0.0], vec![(1, 700.0, 44.64)]),
            (93, [5.0, 200.0, -1.0, -1.0], vec![(2, 200.0, -56.0)]),
        ] {
            assert_eq!(found(command, params), expected, "command {command}");
        }
    }

    #[test]
    fn rounding_and_unused_parameters_are_no_faults() {
        for (command, params) in [
            (16, [3.9, 500.0, -5.0, f32::NAN]),
            (17, [0.0, 0.0, -80.5, 0.0]),
            (18, [0.3, 0.0, 777.0, 2.0]),
            (18, [2.5, 0.0, -255.4, 1.0]),
            (19, [30.5, 0.0, 45.0, 2.0]),
            (21, [0.0, 0.0, 0.0, f32::NAN]),
            (93, [70_000.0, -1.0, -1.0, -1.0]),
            (94, [3.257, 0.0, 0.0, 0.0]),
            (115, [45.6, 400.0, -1.0, 1.0]),
            (177, [2.0, -1.0, 0.0, 0.0]),
            (184, [9.0, 1700.0, 300.0, 400.0]),
        ] {
            assert_eq!(found(command, params), [], "command {command}");
        }
    }

    #[test]
    fn parameters_five_to_seven_of_commands_without_a_place_count_too() {
        let item = Item {
            command: 202,
            x: 256,
            y: 255,
            ..Item::default()
        };
        let numbers: Vec<u8> = unstorable_values(&item).map(|it| it.parameter).collect();
        assert_eq!(numbers, [5]);
    }

    proptest! {
        #[test]
        fn what_is_stored_is_stored_again_as_it_is(
            at in 0..64usize,
            params in proptest::array::uniform4(-1e6f32..1e6),
        ) {
            let commands: Vec<u16> = commands().map(|(number, _)| number).collect();
            let command = commands[at % commands.len()];
            let item = Item { command, params, ..Item::default() };
            let stored = crate::board::plan_item(&item).expect("finite numbers");
            prop_assert_eq!(unstorable_values(&stored).count(), 0, "{:?}", stored);
        }
    }
}
