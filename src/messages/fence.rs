//! `FENCE_STATUS`.

use mavlink::dialects::ardupilotmega::{FENCE_STATUS_DATA, FenceBreach};

use super::Report;
use crate::vehicle::{Fence, Severity, Vehicle};

/// Applies `FENCE_STATUS` and says when the vehicle leaves the fence or is back.
pub(super) fn apply(vehicle: &mut Vehicle, data: &FENCE_STATUS_DATA, report: &mut Report<'_>) {
    let fence = Fence {
        breached: data.breach_status != 0,
        breaches: data.breach_count,
        breach_type: data.breach_type as u8,
    };
    let was_breached = vehicle.fence.is_some_and(|before| before.breached);
    vehicle.fence = Some(fence);
    match (was_breached, fence.breached) {
        (false, true) => {
            let text = format!("fence breached{}", side(data.breach_type));
            report.say(Severity::Warning, text);
        }
        (true, false) => report.say(Severity::Notice, "back inside the fence"),
        _ => {}
    }
}

fn side(breach: FenceBreach) -> &'static str {
    match breach {
        FenceBreach::FENCE_BREACH_NONE => "",
        FenceBreach::FENCE_BREACH_MINALT => " (too low)",
        FenceBreach::FENCE_BREACH_MAXALT => " (too high)",
        FenceBreach::FENCE_BREACH_BOUNDARY => " (boundary)",
    }
}
