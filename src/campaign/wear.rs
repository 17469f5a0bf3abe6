//! The costs of flying.

use crate::workshop::{Design, PartSlot};

/// The share of a battery's life used by a flight.
const BATTERY_SHARE: f64 = 0.01;
/// The share of a motor's life used by an hour in the air.
const MOTOR_SHARE_PER_HOUR: f64 = 0.002;
/// The share of a drone's price that is lost in a crash.
const CRASH_SHARE: f64 = 0.5;

/// One of the trainee's own drones on a flight.
#[derive(Debug, Clone, Copy)]
pub struct FlownDesign<'a> {
    pub design: &'a Design,
    /// Time in the air, in seconds.
    pub airborne_s: f64,
    pub has_crashed: bool,
}

/// The costs of a flight in credits: the wear of batteries and motors, and half the price of crashed drones. A drone
/// that stayed on its pad costs nothing, and neither do lent ones.
pub fn wear<'a>(flown: impl IntoIterator<Item = FlownDesign<'a>>) -> u32 {
    let credits: f64 = flown.into_iter().map(|one| one.wear()).sum();
    credits.round() as u32
}

impl FlownDesign<'_> {
    fn wear(&self) -> f64 {
        if self.airborne_s <= 0.0 && !self.has_crashed {
            return 0.0;
        }
        let price = |slot| -> f64 {
            let pieces = self.design.pieces();
            let of_slot = pieces.filter(|(part, _)| part.slot() == slot);
            of_slot
                .map(|(part, pieces)| f64::from(part.credits * pieces))
                .sum()
        };
        let hours = self.airborne_s / 3600.0;
        let used = price(PartSlot::Battery) * BATTERY_SHARE
            + price(PartSlot::Motor) * MOTOR_SHARE_PER_HOUR * hours;
        let fallen = if self.has_crashed {
            f64::from(self.design.credits()) * CRASH_SHARE
        } else {
            0.0
        };
        used + fallen
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::STARTER_PARTS;
    use crate::workshop::part;

    #[test]
    fn a_flight_wears_batteries_and_motors_and_a_fall_takes_half() {
        let design = STARTER_PARTS.iter().fold(Design::new("quad"), |it, id| {
            it.with(part(id).expect("known"))
        });
        let cost = |airborne_s, has_crashed| {
            let one = FlownDesign {
                design: &design,
                airborne_s,
                has_crashed,
            };
            wear([one, one])
        };
        let price = |id| f64::from(part(id).expect("known").credits);
        let hour = 2.0 * (0.01 * price("b3s5000") + 0.002 * 4.0 * price("m2212_920"));
        assert_eq!(cost(0.0, false), 0, "what stays on the ground is not worn");
        assert_eq!(cost(3600.0, false), hour.round() as u32);
        assert_eq!(
            cost(3600.0, true),
            (hour + f64::from(design.credits())).round() as u32,
            "half of each of two"
        );
    }
}
