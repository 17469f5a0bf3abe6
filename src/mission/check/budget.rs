//! Whether the budget is enough for the fleet.

use super::Examined;
use crate::mission::price;
use crate::text;

/// Reports a budget below the cheapest fleet that carries the equipment listed in the file. Lent
/// vehicles may cost more.
pub(super) fn check(examined: &mut Examined<'_>) {
    let mission = examined.mission;
    let fleet = examined.section("fleet");
    let written = fleet.and_then(|fleet| fleet.get("budget"));
    let (Some(budget), Some(written)) = (mission.seats.outlay.budget, written) else {
        return;
    };
    let mut prices: Vec<u32> = price::least(mission).collect();
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
