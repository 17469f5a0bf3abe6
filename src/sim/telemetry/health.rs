//! State of the autopilot, its power and its estimator.

use mavlink::dialects::ardupilotmega::{
    AUTOPILOT_VERSION_DATA, BATTERY_STATUS_DATA, EKF_STATUS_REPORT_DATA, EXTENDED_SYS_STATE_DATA,
    EkfStatusFlags, HEARTBEAT_DATA, MEMINFO_DATA, MavAutopilot, MavBatteryChargeState,
    MavBatteryFunction, MavBatteryType, MavLandedState, MavMessage, MavModeFlag, MavPowerStatus,
    MavProtocolCapability, MavState, MavSysStatusSensor, MavSysStatusSensorExtended, MavType,
    MavVtolState, POWER_STATUS_DATA, SYS_STATUS_DATA, SYSTEM_TIME_DATA,
};

use super::{boot_ms, boot_us};
use crate::sim::autopilot::Autopilot;
use crate::sim::mode;
use crate::sim::task::Task;

/// Gyro, accelerometer, compass, barometer, GPS, rate, attitude and yaw control, motors, RC, AHRS, battery,
/// pre-arm check, propulsion. Fence, terrain and log are not simulated and not claimed.
const SENSORS: u32 = 0x5221_9C2F;
const HEIGHT_CONTROL: u32 = 0x2000;
const POSITION_CONTROL: u32 = 0x4000;
const AHRS: u32 = 0x0020_0000;
const FENCE: u32 = 0x0010_0000;
const PREARM_CHECK: u32 = 0x1000_0000;
/// Estimator flags with a constant-position assumption, and with GPS.
const EKF_WAITING: u16 = 0x00A7;
const EKF_GOOD: u16 = 0x033F;
/// When the world's clock starts: 2026-01-01, in microseconds of the Unix epoch.
const EPOCH_US: u64 = 1_767_225_600_000_000;

pub(super) fn heartbeat(autopilot: &Autopilot) -> MavMessage {
    let mut base_mode = MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
        | MavModeFlag::MAV_MODE_FLAG_STABILIZE_ENABLED
        | MavModeFlag::MAV_MODE_FLAG_MANUAL_INPUT_ENABLED;
    if autopilot.mode.autonomous {
        base_mode |= MavModeFlag::MAV_MODE_FLAG_GUIDED_ENABLED;
    }
    if autopilot.safety.armed {
        base_mode |= MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED;
    }
    MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        custom_mode: u32::from(autopilot.reported_mode()),
        mavtype: MavType::MAV_TYPE_QUADROTOR,
        autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        base_mode,
        system_status: if autopilot.failsafe.is_active() {
            MavState::MAV_STATE_CRITICAL
        } else if autopilot.safety.landed {
            MavState::MAV_STATE_STANDBY
        } else {
            MavState::MAV_STATE_ACTIVE
        },
        mavlink_version: 3,
    })
}

pub(super) fn sys_status(autopilot: &Autopilot) -> MavMessage {
    let mut enabled = SENSORS;
    if autopilot.mode.controls_height {
        enabled |= HEIGHT_CONTROL;
    }
    if autopilot.mode.autonomous {
        enabled |= POSITION_CONTROL;
    }
    // A fence that does not exist is never breached: ground stations look at this bit alone.
    let mut health = enabled | FENCE;
    if !autopilot.is_armable() {
        health &= !PREARM_CHECK;
    }
    if !autopilot.is_ready() {
        health &= !AHRS;
    }
    let none = MavSysStatusSensorExtended::empty();
    MavMessage::SYS_STATUS(SYS_STATUS_DATA {
        onboard_control_sensors_present: MavSysStatusSensor::from_bits_truncate(
            SENSORS | HEIGHT_CONTROL | POSITION_CONTROL,
        ),
        onboard_control_sensors_enabled: MavSysStatusSensor::from_bits_truncate(enabled),
        onboard_control_sensors_health: MavSysStatusSensor::from_bits_truncate(health),
        voltage_battery: (autopilot.tuning.battery_voltage_v * 1000.0) as u16,
        current_battery: (autopilot.battery.current_a * 100.0) as i16,
        battery_remaining: remaining(autopilot),
        onboard_control_sensors_present_extended: none,
        onboard_control_sensors_enabled_extended: none,
        onboard_control_sensors_health_extended: none,
        ..Default::default()
    })
}

pub(super) fn system_time(autopilot: &Autopilot) -> MavMessage {
    MavMessage::SYSTEM_TIME(SYSTEM_TIME_DATA {
        time_unix_usec: EPOCH_US + boot_us(autopilot),
        time_boot_ms: boot_ms(autopilot),
    })
}

pub(super) fn battery_status(autopilot: &Autopilot) -> MavMessage {
    let mut voltages = [u16::MAX; 10];
    voltages[0] = (autopilot.tuning.battery_voltage_v * 1000.0) as u16;
    MavMessage::BATTERY_STATUS(BATTERY_STATUS_DATA {
        current_consumed: autopilot.battery.consumed_mah as i32,
        energy_consumed: (autopilot.battery.consumed_wh * 36.0) as i32,
        temperature: i16::MAX,
        voltages,
        current_battery: (autopilot.battery.current_a * 100.0) as i16,
        id: 0,
        battery_function: MavBatteryFunction::MAV_BATTERY_FUNCTION_UNKNOWN,
        mavtype: MavBatteryType::MAV_BATTERY_TYPE_UNKNOWN,
        battery_remaining: remaining(autopilot),
        charge_state: MavBatteryChargeState::MAV_BATTERY_CHARGE_STATE_OK,
        ..Default::default()
    })
}

fn remaining(autopilot: &Autopilot) -> i8 {
    autopilot
        .battery
        .remaining_percent(autopilot.tuning.battery_capacity_mah)
}

pub(super) fn power_status(_autopilot: &Autopilot) -> MavMessage {
    MavMessage::POWER_STATUS(POWER_STATUS_DATA {
        Vcc: 5000,
        Vservo: 0,
        flags: MavPowerStatus::empty(),
    })
}

pub(super) fn meminfo(_autopilot: &Autopilot) -> MavMessage {
    MavMessage::MEMINFO(MEMINFO_DATA {
        brkval: 0,
        freemem: u16::MAX,
        freemem32: 131_072,
    })
}

pub(super) fn ekf_status_report(autopilot: &Autopilot) -> MavMessage {
    let flags = if autopilot.is_ready() {
        EKF_GOOD
    } else {
        EKF_WAITING
    };
    MavMessage::EKF_STATUS_REPORT(EKF_STATUS_REPORT_DATA {
        pos_horiz_variance: 0.01,
        compass_variance: 0.03,
        flags: EkfStatusFlags::from_bits_truncate(flags),
        ..Default::default()
    })
}

pub(super) fn extended_sys_state(autopilot: &Autopilot) -> MavMessage {
    let descending = matches!(&autopilot.task, Task::Land(_))
        || matches!(&autopilot.task, Task::Return(way) if way.landing().is_some());
    let landed_state = if autopilot.safety.landed {
        MavLandedState::MAV_LANDED_STATE_ON_GROUND
    } else if matches!(autopilot.task, Task::Takeoff(_)) {
        MavLandedState::MAV_LANDED_STATE_TAKEOFF
    } else if descending || autopilot.mode.number == mode::LAND {
        MavLandedState::MAV_LANDED_STATE_LANDING
    } else {
        MavLandedState::MAV_LANDED_STATE_IN_AIR
    };
    MavMessage::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA {
        vtol_state: MavVtolState::MAV_VTOL_STATE_MC,
        landed_state,
    })
}

/// Only what is served: no FTP, no missions, fences or rally points, no terrain, no attitude targets, no
/// compass calibration.
#[expect(
    deprecated,
    reason = "the bit that ArduCopter sets; its successor has the same meaning"
)]
pub(super) fn autopilot_version(autopilot: &Autopilot) -> MavMessage {
    let mut uid2 = [0; 18];
    uid2[..8].copy_from_slice(&autopilot.board_id.to_le_bytes());
    uid2[8] = autopilot.system;
    MavMessage::AUTOPILOT_VERSION(AUTOPILOT_VERSION_DATA {
        capabilities: MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_PARAM_FLOAT
            | MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_COMMAND_INT
            | MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_LOCAL_NED
            | MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_GLOBAL_INT
            | MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_FLIGHT_TERMINATION
            | MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MAVLINK2,
        uid: autopilot.board_id,
        flight_sw_version: 0x0406_0000,
        flight_custom_version: *b"sortie\0\0",
        uid2,
        ..Default::default()
    })
}
