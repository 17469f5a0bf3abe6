//! State of the autopilot, its power and its estimator.

use mavlink::dialects::ardupilotmega::{
    AUTOPILOT_VERSION_DATA, BATTERY_STATUS_DATA, EKF_STATUS_REPORT_DATA, EXTENDED_SYS_STATE_DATA,
    GpsFixType, HEARTBEAT_DATA, MEMINFO_DATA, MavAutopilot, MavBatteryFault, MavBatteryFunction,
    MavBatteryType, MavLandedState, MavMessage, MavModeFlag, MavPowerStatus, MavProtocolCapability,
    MavState, MavSysStatusSensor, MavSysStatusSensorExtended, MavType, MavVtolState,
    POWER_STATUS_DATA, SYS_STATUS_DATA, SYSTEM_TIME_DATA,
};

use super::{boot_ms, boot_us};
use crate::autopilot::Autopilot;
use crate::boot::COMMIT;
use crate::flight_log::EPOCH_US;
use crate::kind::VehicleKind;
use crate::mode::ModeId;
use crate::task::Task;

/// Gyro, accelerometer, compass, barometer, GPS, rate, attitude and yaw control, motors, RC, AHRS, battery, pre-arm
/// check, propulsion. Terrain and log are not reported.
const SENSORS: MavSysStatusSensor = GYRO
    .union(ACCELEROMETER)
    .union(COMPASS)
    .union(BAROMETER)
    .union(GPS)
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_ANGULAR_RATE_CONTROL)
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_ATTITUDE_STABILIZATION)
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_YAW_POSITION)
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_MOTOR_OUTPUTS)
    .union(RADIO)
    .union(AHRS)
    .union(BATTERY)
    .union(PREARM_CHECK)
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_PROPULSION);
const GYRO: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_3D_GYRO;
const ACCELEROMETER: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_3D_ACCEL;
const COMPASS: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_3D_MAG;
const BAROMETER: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE;
const GPS: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_GPS;
const RADIO: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_RC_RECEIVER;
const BATTERY: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_BATTERY;
const HEIGHT_CONTROL: MavSysStatusSensor =
    MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_Z_ALTITUDE_CONTROL;
const POSITION_CONTROL: MavSysStatusSensor =
    MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_XY_POSITION_CONTROL;
const AHRS: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_AHRS;
const FENCE: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_GEOFENCE;
const PREARM_CHECK: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_PREARM_CHECK;
/// Missions, fences and rally points, parameters, `COMMAND_INT`, FTP, setpoints of attitude and position, terrain,
/// flight termination, compass calibration, `MAVLink` 2.
const CAPABILITIES: MavProtocolCapability =
    MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MISSION_FLOAT
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_PARAM_FLOAT)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MISSION_INT)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_COMMAND_INT)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_FTP)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_SET_ATTITUDE_TARGET)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_LOCAL_NED)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_GLOBAL_INT)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_TERRAIN)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_FLIGHT_TERMINATION)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_COMPASS_CALIBRATION)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MAVLINK2)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MISSION_FENCE)
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MISSION_RALLY);

/// What a rover cannot do.
const ONLY_IN_FLIGHT: MavProtocolCapability =
    MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_TERRAIN
        .union(MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_FLIGHT_TERMINATION);

pub(super) fn heartbeat(autopilot: &Autopilot) -> MavMessage {
    let vehicle = &autopilot.vehicle;
    let mut base_mode = MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
    base_mode |= match vehicle.kind {
        VehicleKind::Copter => {
            MavModeFlag::MAV_MODE_FLAG_STABILIZE_ENABLED
                | MavModeFlag::MAV_MODE_FLAG_MANUAL_INPUT_ENABLED
        }
        VehicleKind::Rover(_) if vehicle.flight.mode.is_steered() => {
            MavModeFlag::MAV_MODE_FLAG_MANUAL_INPUT_ENABLED
        }
        VehicleKind::Rover(_) => MavModeFlag::empty(),
    };
    if autopilot.vehicle.flight.mode.autonomous {
        base_mode |= MavModeFlag::MAV_MODE_FLAG_GUIDED_ENABLED;
    }
    if autopilot.vehicle.safety.armed {
        base_mode |= MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED;
    }
    MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        custom_mode: u32::from(autopilot.reported_mode()),
        mavtype: vehicle_type(autopilot),
        autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        base_mode,
        system_status: system_status(autopilot),
        mavlink_version: 3,
    })
}

/// The type of the vehicle: a rover is a boat by a parameter.
pub(super) fn vehicle_type(autopilot: &Autopilot) -> MavType {
    let vehicle = &autopilot.vehicle;
    match &vehicle.tuning.flight.helm {
        None => vehicle.plant.airframe.vehicle_type(),
        Some(helm) if helm.is_boat => MavType::MAV_TYPE_SURFACE_BOAT,
        Some(_) => MavType::MAV_TYPE_GROUND_ROVER,
    }
}

fn system_status(autopilot: &Autopilot) -> MavState {
    let vehicle = &autopilot.vehicle;
    let is_idle = match vehicle.kind {
        VehicleKind::Copter => vehicle.safety.landed && !vehicle.boot.is_initialising(),
        VehicleKind::Rover(_) => vehicle.flight.mode.id == ModeId::Hold,
    };
    let is_in_emergency = match vehicle.kind {
        VehicleKind::Copter => autopilot.failsafe.is_active(),
        VehicleKind::Rover(_) => autopilot.failsafe.has_lost_a_link(),
    };
    if is_in_emergency {
        MavState::MAV_STATE_CRITICAL
    } else if is_idle {
        MavState::MAV_STATE_STANDBY
    } else {
        MavState::MAV_STATE_ACTIVE
    }
}

/// The sensors and functions that are present, in use, and healthy.
fn sensors(autopilot: &Autopilot) -> [MavSysStatusSensor; 3] {
    let [mut present, mut enabled] = match autopilot.vehicle.kind {
        VehicleKind::Copter => [SENSORS | HEIGHT_CONTROL | POSITION_CONTROL, SENSORS],
        VehicleKind::Rover(_) => rover_sensors(autopilot),
    };
    if autopilot
        .vehicle
        .boot
        .early_fix()
        .is_some_and(|(kind, _)| kind == GpsFixType::GPS_FIX_TYPE_NO_GPS)
    {
        present.remove(GPS);
        enabled.remove(GPS);
    }
    if !autopilot.vehicle.boot.has_reference() {
        enabled.remove(AHRS);
    }
    if autopilot.vehicle.flight.mode.controls_height {
        enabled.insert(HEIGHT_CONTROL);
    }
    if autopilot.vehicle.flight.mode.autonomous {
        enabled.insert(POSITION_CONTROL);
    }
    let fence = autopilot
        .vehicle
        .fence
        .health(&autopilot.vehicle.tuning.flight.fence);
    if fence.is_enabled {
        enabled.insert(FENCE);
    }
    if fence.is_present {
        present.insert(FENCE);
    }
    // A missing fence is never breached: ground stations check only this bit.
    let healthy = if fence.is_healthy {
        enabled | FENCE
    } else {
        enabled & !FENCE
    };
    [present, enabled, healthy & !failed(autopilot)]
}

/// The sensors and functions of a rover that are present and in use: it controls its attitude and its yaw only while it
/// is not steered by hand.
fn rover_sensors(autopilot: &Autopilot) -> [MavSysStatusSensor; 2] {
    let mode = autopilot.vehicle.flight.mode;
    let control = MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_ANGULAR_RATE_CONTROL
        | MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_ATTITUDE_STABILIZATION
        | MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_YAW_POSITION
        | POSITION_CONTROL;
    let present = (SENSORS | control) & !MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_PROPULSION;
    let in_use = match mode.id {
        ModeId::Manual | ModeId::Hold => MavSysStatusSensor::empty(),
        ModeId::Acro => MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_ANGULAR_RATE_CONTROL,
        _ => control,
    };
    let out_of_use = control & !in_use;
    [present, present & !out_of_use]
}

fn failed(autopilot: &Autopilot) -> MavSysStatusSensor {
    let faults = &autopilot.vehicle.tuning.faults;
    let failures = [
        (!autopilot.is_armable(), PREARM_CHECK),
        (
            !autopilot.vehicle.boot.has_reference() || autopilot.failsafe.falls_back(),
            AHRS,
        ),
        (faults.gyro_failed, GYRO),
        (faults.accelerometer_failed, ACCELEROMETER),
        (!autopilot.vehicle.estimator.compass_is_healthy(), COMPASS),
        (faults.barometers[0].disabled, BAROMETER),
        (autopilot.failsafe.radio_is_lost(), RADIO),
        (autopilot.failsafe.battery_is_down(), BATTERY),
    ];
    failures
        .into_iter()
        .filter(|(is_so, _)| *is_so)
        .fold(MavSysStatusSensor::empty(), |bits, (_, bit)| bits | bit)
}

pub(super) fn sys_status(autopilot: &Autopilot) -> MavMessage {
    let [present, enabled, health] = sensors(autopilot);
    let none = MavSysStatusSensorExtended::empty();
    MavMessage::SYS_STATUS(SYS_STATUS_DATA {
        onboard_control_sensors_present: present,
        onboard_control_sensors_enabled: enabled,
        onboard_control_sensors_health: health,
        voltage_battery: (autopilot.vehicle.plant.battery.voltage_v * 1000.0) as u16,
        current_battery: (autopilot.vehicle.plant.battery.current_a * 100.0) as i16,
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
    voltages[0] = (autopilot.vehicle.plant.battery.voltage_v * 1000.0) as u16;
    MavMessage::BATTERY_STATUS(BATTERY_STATUS_DATA {
        current_consumed: autopilot.vehicle.plant.battery.consumed_mah as i32,
        energy_consumed: (autopilot.vehicle.plant.battery.consumed_wh * 36.0) as i32,
        temperature: i16::MAX,
        voltages,
        current_battery: (autopilot.vehicle.plant.battery.current_a * 100.0) as i16,
        id: 0,
        battery_function: MavBatteryFunction::MAV_BATTERY_FUNCTION_UNKNOWN,
        mavtype: MavBatteryType::MAV_BATTERY_TYPE_UNKNOWN,
        battery_remaining: remaining(autopilot),
        charge_state: autopilot.failsafe.charge_state(),
        fault_bitmask: MavBatteryFault::empty(),
        ..Default::default()
    })
}

pub(super) fn remaining(autopilot: &Autopilot) -> i8 {
    autopilot
        .vehicle
        .plant
        .battery
        .remaining_percent(autopilot.vehicle.tuning.battery_capacity_mah)
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
    let ratios = autopilot.vehicle.estimator.ratios();
    let flags = if autopilot.vehicle.boot.is_over() {
        autopilot.vehicle.estimator.flags()
    } else {
        autopilot.vehicle.boot.flags()
    };
    MavMessage::EKF_STATUS_REPORT(EKF_STATUS_REPORT_DATA {
        velocity_variance: ratios.velocity as f32,
        pos_horiz_variance: ratios.position as f32,
        pos_vert_variance: ratios.height as f32,
        compass_variance: ratios.compass as f32,
        flags,
        ..Default::default()
    })
}

pub(super) fn extended_sys_state(autopilot: &Autopilot) -> MavMessage {
    let descending = matches!(&autopilot.vehicle.flight.task, Task::Land(_))
        || matches!(&autopilot.vehicle.flight.task, Task::Return(way) if way.landing().is_some());
    if autopilot.vehicle.kind != VehicleKind::Copter {
        return MavMessage::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA::default());
    }
    let landed_state = if autopilot.vehicle.safety.landed {
        MavLandedState::MAV_LANDED_STATE_ON_GROUND
    } else if matches!(autopilot.vehicle.flight.task, Task::Takeoff(_)) {
        MavLandedState::MAV_LANDED_STATE_TAKEOFF
    } else if descending || autopilot.vehicle.flight.mode.id == ModeId::Land {
        MavLandedState::MAV_LANDED_STATE_LANDING
    } else {
        MavLandedState::MAV_LANDED_STATE_IN_AIR
    };
    MavMessage::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA {
        vtol_state: MavVtolState::MAV_VTOL_STATE_MC,
        landed_state,
    })
}

pub(super) fn autopilot_version(autopilot: &Autopilot) -> MavMessage {
    let mut uid2 = [0; 18];
    uid2[..8].copy_from_slice(&autopilot.vehicle.board_id.to_le_bytes());
    uid2[8] = autopilot.vehicle.system;
    let mut capabilities = CAPABILITIES;
    let hands_out_files = autopilot.vehicle.parameters.hands_out_files();
    capabilities.set(
        MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_FTP,
        hands_out_files,
    );
    if autopilot.vehicle.kind != VehicleKind::Copter {
        capabilities.remove(ONLY_IN_FLIGHT);
    }
    MavMessage::AUTOPILOT_VERSION(AUTOPILOT_VERSION_DATA {
        capabilities,
        flight_sw_version: 0x0406_0000,
        flight_custom_version: COMMIT,
        uid2,
        ..Default::default()
    })
}
