//! Speed limits, and when they must be sent again.
//!
//! ArduCopter resets them to its parameters whenever GUIDED begins a different kind of control: a speed that was set
//! before or during a takeoff is lost with the first `goto` (`ModeGuided::pva_control_start`). Each place to fly to is
//! therefore followed by the commanded speeds.

use mavlink::dialects::ardupilotmega::{MavCmd, SpeedType};

use super::encode::{self, LongFields};
use crate::text::Text;
use crate::vehicle::{SpeedAxis, Vehicle};
use crate::wire::Outgoing;

/// The command that changes a speed limit.
pub const CHANGE_SPEED: u16 = MavCmd::MAV_CMD_DO_CHANGE_SPEED as u16;

pub(super) fn fields(axis: SpeedAxis, speed_m_s: f64) -> LongFields {
    // -1 leaves the throttle unchanged.
    let changed = [speed_type(axis), speed_m_s as f32, -1.0];
    LongFields::new(MavCmd::MAV_CMD_DO_CHANGE_SPEED, &changed)
}

/// The messages that repeat the commanded speeds, one for each.
///
/// # Errors
/// The vehicle cannot be addressed.
pub fn asked_again(vehicle: &Vehicle) -> Result<Vec<Outgoing>, Text> {
    let asked = vehicle.asked_speeds.all();
    asked
        .map(|(axis, speed_m_s)| encode::long(vehicle, &fields(axis, speed_m_s), 0))
        .collect()
}

/// The `SPEED_TYPE` of MAVLink.
fn speed_type(axis: SpeedAxis) -> f32 {
    let kind = match axis {
        SpeedAxis::Ground => SpeedType::SPEED_TYPE_GROUNDSPEED,
        SpeedAxis::Climb => SpeedType::SPEED_TYPE_CLIMB_SPEED,
        SpeedAxis::Descend => SpeedType::SPEED_TYPE_DESCENT_SPEED,
    };
    f32::from(kind as u8)
}
