//! `FENCE_STATUS`: whether the vehicle is outside its fence.

use mavlink::dialects::ardupilotmega::{FENCE_STATUS_DATA, FenceBreach};

use super::HandlerNotices;
use crate::alert::AlertKind;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Fence, Severity, Vehicle};

/// Applies `FENCE_STATUS`, with a notice when the vehicle leaves the fence or returns.
pub(super) fn apply(
    vehicle: &mut Vehicle,
    data: &FENCE_STATUS_DATA,
    report: &mut HandlerNotices<'_>,
) {
    let fence = Fence {
        breached: data.breach_status != 0,
        breaches: data.breach_count,
        breach_type: data.breach_type as u8,
    };
    let was_breached = vehicle.fence.is_some_and(|before| before.breached);
    vehicle.fence = Some(fence);
    match (was_breached, fence.breached) {
        (false, true) => {
            report.alert(
                Severity::Warning,
                AlertKind::Fence,
                breached(data.breach_type),
            );
        }
        (true, false) => report.say(Severity::Notice, text!("heard-fence-back")),
        _ => {}
    }
}

fn breached(breach: FenceBreach) -> Text {
    match breach {
        FenceBreach::FENCE_BREACH_NONE => text!("heard-fence"),
        FenceBreach::FENCE_BREACH_MINALT => text!("heard-fence-low"),
        FenceBreach::FENCE_BREACH_MAXALT => text!("heard-fence-high"),
        FenceBreach::FENCE_BREACH_BOUNDARY => text!("heard-fence-boundary"),
    }
}
