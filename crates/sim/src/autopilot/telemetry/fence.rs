//! State of the fence.

use mavlink::dialects::ardupilotmega::{FENCE_STATUS_DATA, MavMessage};

use crate::autopilot::Autopilot;

/// Only sent while a fence is enabled.
pub(super) fn fence_status(autopilot: &Autopilot) -> Option<MavMessage> {
    let report = autopilot.vehicle.fence.report(
        &autopilot.vehicle.tuning.flight.fence,
        autopilot.vehicle.uptime(),
    )?;
    Some(MavMessage::FENCE_STATUS(FENCE_STATUS_DATA {
        breach_time: report.broken_since.as_millis() as u32,
        breach_count: report.breaches,
        breach_status: u8::from(report.is_broken),
        breach_type: report.kind,
        breach_mitigation: report.mitigation,
    }))
}
