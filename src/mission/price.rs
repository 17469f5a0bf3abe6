//! The least that vehicles for the seats of a mission cost.

use super::Mission;
use super::fit::Fit;
use crate::workshop::{self, Design, DesignKind, Part, PartSlot};

/// The price of the cheapest vehicle for each seat that carries the equipment listed in the file, in credits.
pub(super) fn least(mission: &Mission) -> impl Iterator<Item = u32> {
    let seats = mission.seats.asked.iter().zip(mission.seat_kinds());
    seats.map(|(fit, kind)| cheapest_vehicle(kind) + equipment(fit))
}

/// What is left of the budget for each seat, in credits, if the fleet's other vehicles cost in proportion to the least
/// that they can; `None` without a budget.
pub(super) fn shares(mission: &Mission) -> Vec<Option<u32>> {
    let least: Vec<f64> = least(mission).map(f64::from).collect();
    let all: f64 = least.iter().sum();
    let budget = mission.seats.outlay.budget.map(f64::from);
    let share = |least: &f64| budget.map(|budget| (budget * least / all).floor() as u32);
    least.iter().map(share).collect()
}

/// The minimum price of a vehicle of a kind with a part in each slot, in credits, whether or not the parts fit together.
fn cheapest_vehicle(kind: DesignKind) -> u32 {
    let with_frame = |frame: &'static Part| {
        let others = kind.slots().iter().copied();
        let others = others.filter(|slot| slot.is_required() && *slot != PartSlot::Frame);
        let cheapest = others.filter_map(|slot| {
            let parts = workshop::parts_for(slot).filter(|part| part.fits(kind));
            parts.min_by_key(|part| part.credits)
        });
        let bare = Design::new("").with(frame);
        cheapest
            .fold(bare, |design, part| design.with(part))
            .credits()
    };
    workshop::parts_for(PartSlot::Frame)
        .filter(|part| part.fits(kind))
        .map(with_frame)
        .min()
        .unwrap_or_default()
}

/// The price of a vehicle's equipment, in credits.
fn equipment(fit: &Fit) -> u32 {
    let sensors = fit.sensors.iter().map(|sensor| (sensor.id, 1));
    let parts = sensors.chain(fit.tools());
    parts
        .filter_map(|(id, pieces)| Some(workshop::part(id)?.credits * pieces))
        .sum()
}
