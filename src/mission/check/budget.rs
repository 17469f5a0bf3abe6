//! Whether the budget is enough for the fleet.

use super::Examined;
use crate::mission::fit::Fit;
use crate::mission::fleet::FLAIL;
use crate::mission::needs;
use crate::text;
use crate::workshop::{self, Design, DesignKind, Part, PartSlot};

/// Reports a budget below the cheapest fleet that carries the equipment listed in the file. Lent
/// vehicles may cost more.
pub(super) fn check(examined: &mut Examined<'_>) {
    let mission = examined.mission;
    let fleet = examined.section("fleet");
    let written = fleet.and_then(|fleet| fleet.get("budget"));
    let (Some(budget), Some(written)) = (mission.seats.outlay.budget, written) else {
        return;
    };
    let mut prices: Vec<u32> = mission
        .seats
        .fits
        .iter()
        .zip(mission.seat_kinds())
        .map(|(fit, kind)| cheapest_vehicle(kind) + price(fit))
        .collect();
    prices.sort_unstable();
    let bought = prices
        .len()
        .saturating_sub(mission.seats.outlay.loaners.len());
    let least: u32 = prices.iter().take(bought).sum();
    if budget < least {
        let fault = text!("check-budget", least = least);
        examined.add(written.span.clone(), fault);
    }
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
fn price(fit: &Fit) -> u32 {
    let sensors = fit.sensors.iter().map(|sensor| (sensor.id, 1));
    let loads = fit.loads.iter().map(|(load, count)| (*load, *count));
    let flail = fit.flail.then_some((FLAIL, 1));
    let parts = sensors.chain(needs::parts(loads)).chain(flail);
    parts
        .filter_map(|(id, pieces)| Some(workshop::part(id)?.credits * pieces))
        .sum()
}
