//! HEARTBEAT: mode, armed state, type and status.

use mavlink::dialects::ardupilotmega::{HEARTBEAT_DATA, MavAutopilot, MavModeFlag, MavType};

use super::HandlerNotices;
use super::idle::IdleWatch;
use crate::text;
use crate::vehicle::{Heartbeat, Mode, Severity, SystemStatus, Vehicle, VehicleClass};

const TYPE_GROUND_STATION: u8 = MavType::MAV_TYPE_GCS as u8;
/// The autopilot type of a component that is not a flight controller.
const AUTOPILOT_NONE: u8 = MavAutopilot::MAV_AUTOPILOT_INVALID as u8;
const FLAG_ARMED: u8 = MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED.bits();

/// The numbers of a HEARTBEAT, even those without a name in the dialect.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beat {
    custom_mode: u32,
    mav_type: u8,
    autopilot: u8,
    base_mode: u8,
    status: u8,
}

impl From<&HEARTBEAT_DATA> for Beat {
    fn from(data: &HEARTBEAT_DATA) -> Self {
        Self {
            custom_mode: data.custom_mode,
            mav_type: data.mavtype as u8,
            autopilot: data.autopilot as u8,
            base_mode: data.base_mode.bits(),
            status: data.system_status as u8,
        }
    }
}

impl Beat {
    /// Reads the payload in wire order.
    pub(super) fn from_payload(payload: &[u8; 255]) -> Self {
        let [
            mode0,
            mode1,
            mode2,
            mode3,
            mav_type,
            autopilot,
            base_mode,
            status,
            ..,
        ] = *payload;
        Self {
            custom_mode: u32::from_le_bytes([mode0, mode1, mode2, mode3]),
            mav_type,
            autopilot,
            base_mode,
            status,
        }
    }

    fn is_autopilot(self) -> bool {
        self.mav_type != TYPE_GROUND_STATION && self.autopilot != AUTOPILOT_NONE
    }
}

/// Applies a heartbeat of the vehicle's autopilot component; others are ignored.
pub(super) fn apply(
    vehicle: &mut Vehicle,
    beat: Beat,
    idle: &mut IdleWatch,
    report: &mut HandlerNotices<'_>,
) {
    if !beat.is_autopilot() {
        return;
    }
    let class = VehicleClass::from_mav_type(beat.mav_type);
    let heartbeat = Heartbeat {
        mav_type: beat.mav_type,
        autopilot: beat.autopilot,
        class,
        mode: Mode {
            class: match beat.autopilot {
                Heartbeat::ARDUPILOT => class,
                Heartbeat::PX4 => VehicleClass::Px4,
                _ => VehicleClass::Other,
            },
            number: beat.custom_mode,
        },
        armed: beat.base_mode & FLAG_ARMED != 0,
        status: SystemStatus::from_wire(beat.status),
        at: report.now,
    };
    let before = vehicle.heartbeat.replace(heartbeat);
    if !heartbeat.armed {
        // The old target no longer applies, and the plan begins anew.
        vehicle.target = None;
        vehicle.plan_jumps.clear();
    }
    if !vehicle.flies_plan() {
        vehicle.cruise = None;
    }
    let cause = idle.note_heartbeat(vehicle, report.now);
    let Some(before) = before else { return };
    if before.mode != heartbeat.mode {
        report.say(
            Severity::Notice,
            text!("heard-mode", mode = vehicle.name_of(heartbeat.mode)),
        );
        // The new mode reports its own target, or has none.
        vehicle.target = None;
    }
    if before.armed != heartbeat.armed {
        vehicle.idle_disarm = cause;
        let text = match cause {
            _ if heartbeat.armed => text!("heard-armed"),
            Some(cause) => text!("heard-disarmed-idle", reason = cause.text()),
            None => text!("heard-disarmed"),
        };
        report.say(Severity::Notice, text);
        if heartbeat.armed {
            vehicle.prearm.clear();
        }
    }
}
