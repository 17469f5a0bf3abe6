//! Whether the budget buys what is to be flown.

use super::Examined;
use crate::mission::fit::Fit;
use crate::mission::hazard::Load;

/// The cheapest vehicle that the parts catalogue has, in credits: a frame with four arms, motors, propellers and speed
/// controllers for them, battery, autopilot, satellite receiver, power module, radio and wiring.
const CHEAPEST_VEHICLE: u32 = 30 + 4 * (20 + 2 + 10) + 20 + 75 + 45 + 30 + 20 + 15;
/// What pieces are let go with.
const DROPPER: u32 = 45;

/// A budget below the cheapest fleet that carries what the file says. The dearest vehicles are those that are lent.
pub(super) fn check(examined: &mut Examined<'_>) {
    let mission = examined.mission;
    let fleet = examined.section("fleet");
    let written = fleet.and_then(|fleet| fleet.get("budget"));
    let (Some(budget), Some(written)) = (mission.outlay.budget, written) else {
        return;
    };
    let mut prices: Vec<u32> = mission.fits.iter().map(price).collect();
    prices.sort_unstable();
    let bought = prices.len().saturating_sub(mission.outlay.loaners.len());
    let least: u32 = prices.iter().take(bought).sum();
    if budget < least {
        let fault = format!(
            "`budget` buys nothing to fly: the cheapest fleet with these sensors and loads costs {least} credits"
        );
        examined.add(written.span(), fault);
    }
}

/// The least that a vehicle with this fit costs.
fn price(fit: &Fit) -> u32 {
    let sensors = fit.sensors.iter().map(|sensor| sensor.credits);
    let pieces = fit.loads.iter().map(|(load, count)| count * piece(*load));
    let drops = fit.loads.keys().any(|load| piece(*load) > 0);
    CHEAPEST_VEHICLE + sensors.sum::<u32>() + pieces.sum::<u32>() + u32::from(drops) * DROPPER
}

fn piece(load: Load) -> u32 {
    match load {
        Load::Ball | Load::Node => 60,
        Load::Kit => 25,
        // The catalogue has no sprayer.
        Load::Spray => 0,
    }
}
