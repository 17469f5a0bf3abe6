//! `DO_AUX_FUNCTION`: a function of the transmitter's switches, triggered by a ground station.

use mavlink::dialects::ardupilotmega::{MavResult, MavSeverity};

use super::{Command, done};
use crate::autopilot::Autopilot;
use crate::link::Link;
use crate::radio::SwitchPosition;

pub(super) fn switch(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let (Some(function), Some(position)) = (command.whole(0), command.whole(1)) else {
        return MavResult::MAV_RESULT_DENIED;
    };
    let Some(position) = SwitchPosition::numbered(position) else {
        return MavResult::MAV_RESULT_DENIED;
    };
    let Ok(function) = u16::try_from(function) else {
        let text = format!("Invalid channel option ({function})");
        autopilot.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        return MavResult::MAV_RESULT_FAILED;
    };
    done(autopilot.run_function(function, position))
}
