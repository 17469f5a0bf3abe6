//! The form of an item that the vehicle's truncation does not change.

use super::letters;
use crate::Item;

/// An item of a mission with numbers that survive the vehicle's truncation: a height such as 20.3
/// m, which as a float is a little less, would be kept as 20.29 m. Sent in this form, an item is
/// kept to the centimetre, and an item that the vehicle sends back stays the same however often it
/// is sent again.
#[must_use]
pub fn as_sent(item: &Item) -> Item {
    let Some(kept) = letters(item.command) else {
        return *item;
    };
    let mut sent = *item;
    for (place, value) in sent.params.iter_mut().enumerate() {
        if kept[place] == b'c' {
            *value = surviving(*value);
        }
    }
    if kept[4] == b'L' {
        sent.z = surviving(sent.z);
    }
    sent
}

/// A number close to a whole hundredth, as the nearest float that truncation does not lower; other
/// numbers are unchanged.
fn surviving(value: f32) -> f32 {
    let hundredths = f64::from(value) * 100.0;
    let whole = hundredths.round();
    // The rounding errors of a float, of its product and of the factor on the way back.
    let error = 0.001 + hundredths.abs() * 2e-7;
    if !value.is_finite() || (hundredths - whole).abs() > error {
        return value;
    }
    let mut sent = (whole / 100.0) as f32;
    for _ in 0..4 {
        if (sent * 100.0).trunc() as i64 == whole as i64 {
            return sent;
        }
        sent = if whole < 0.0 {
            sent.next_down()
        } else {
            sent.next_up()
        };
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::plan_item;
    use crate::command;

    /// All heights from -50 m to 300 m, in steps of a centimetre.
    #[test]
    fn heights_survive_any_number_of_transfers() {
        for centimetres in -5_000..30_000 {
            let height = f64::from(centimetres) / 100.0;
            let mut now = at(height as f32);
            for _ in 0..3 {
                now = plan_item(&as_sent(&now)).expect("known");
                let kept = (f64::from(now.z) * 100.0).round();
                assert!(
                    (kept - f64::from(centimetres)).abs() < 0.5,
                    "{height} {}",
                    now.z
                );
            }
        }
        let between = at(20.257);
        assert_eq!(as_sent(&between), between);
    }

    fn at(height_m: f32) -> Item {
        Item {
            command: command::WAYPOINT,
            frame: 3,
            z: height_m,
            ..Item::default()
        }
    }
}
