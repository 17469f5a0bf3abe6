//! The command that switches the fence on and off.

use mavlink::dialects::ardupilotmega::MavResult;

use super::{Command, done};
use crate::autopilot::Autopilot;
use crate::link::Link;

/// Switches the fence: 0 is off, 1 on, 2 only the floor off.
pub(super) fn enable(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    match command.p[0] as u16 {
        on @ (0 | 1) => done(autopilot.vehicle.enable_fence(on == 1)),
        2 => {
            autopilot.vehicle.fence.disable_floor();
            MavResult::MAV_RESULT_ACCEPTED
        }
        _ => MavResult::MAV_RESULT_FAILED,
    }
}
