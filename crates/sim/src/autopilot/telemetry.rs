//! Telemetry of the vehicle: one builder per message, picked by message id.

#![expect(deprecated, reason = "the real vehicle still speaks these messages")]

mod extra;
mod fence;
mod health;
mod motion;
mod navigation;
mod sensors;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    ADSB_VEHICLE_DATA, AHRS_DATA, AHRS2_DATA, AIS_VESSEL_DATA, AOA_SSA_DATA, ATTITUDE_DATA,
    ATTITUDE_QUATERNION_DATA, ATTITUDE_TARGET_DATA, AUTOPILOT_STATE_FOR_GIMBAL_DEVICE_DATA,
    AUTOPILOT_VERSION_DATA, BATTERY_STATUS_DATA, BATTERY2_DATA, CAMERA_CAPTURE_STATUS_DATA,
    CAMERA_FEEDBACK_DATA, CAMERA_FOV_STATUS_DATA, CAMERA_INFORMATION_DATA, CAMERA_SETTINGS_DATA,
    DEEPSTALL_DATA, DISTANCE_SENSOR_DATA, EFI_STATUS_DATA, EKF_STATUS_REPORT_DATA,
    ESC_TELEMETRY_1_TO_4_DATA, EXTENDED_SYS_STATE_DATA, FENCE_STATUS_DATA, GENERATOR_STATUS_DATA,
    GIMBAL_DEVICE_ATTITUDE_STATUS_DATA, GIMBAL_MANAGER_INFORMATION_DATA,
    GIMBAL_MANAGER_STATUS_DATA, GLOBAL_POSITION_INT_DATA, GPS_GLOBAL_ORIGIN_DATA, GPS_RAW_INT_DATA,
    GPS_RTK_DATA, GPS2_RAW_DATA, GPS2_RTK_DATA, HEARTBEAT_DATA, HIGH_LATENCY2_DATA,
    HOME_POSITION_DATA, HWSTATUS_DATA, LOCAL_POSITION_NED_DATA, MAG_CAL_PROGRESS_DATA,
    MAG_CAL_REPORT_DATA, MEMINFO_DATA, MISSION_CURRENT_DATA, MISSION_ITEM_REACHED_DATA, MavMessage,
    NAV_CONTROLLER_OUTPUT_DATA, OPTICAL_FLOW_DATA, PARAM_VALUE_DATA, PID_TUNING_DATA,
    POSITION_TARGET_GLOBAL_INT_DATA, POSITION_TARGET_LOCAL_NED_DATA, POWER_STATUS_DATA,
    RANGEFINDER_DATA, RAW_IMU_DATA, RC_CHANNELS_DATA, RC_CHANNELS_RAW_DATA,
    RC_CHANNELS_SCALED_DATA, RELAY_STATUS_DATA, RPM_DATA, SCALED_IMU_DATA, SCALED_IMU2_DATA,
    SCALED_IMU3_DATA, SCALED_PRESSURE_DATA, SCALED_PRESSURE2_DATA, SCALED_PRESSURE3_DATA,
    SERVO_OUTPUT_RAW_DATA, SIM_STATE_DATA, SIMSTATE_DATA, SYS_STATUS_DATA, SYSTEM_TIME_DATA,
    UAVIONIX_ADSB_OUT_STATUS_DATA, VFR_HUD_DATA, VIBRATION_DATA, WATER_DEPTH_DATA,
    WINCH_STATUS_DATA, WIND_DATA,
};

use self::Builder::{Always, Sometimes};
use super::Autopilot;
use crate::kind::VehicleKind;
use crate::schedule::{TERRAIN_REPORT, TERRAIN_REQUEST};

/// Messages for which the real vehicle accepts requests, but which it does not send without the hardware.
const SILENT: &[u32] = &[
    PARAM_VALUE_DATA::ID,
    RC_CHANNELS_SCALED_DATA::ID,
    RC_CHANNELS_RAW_DATA::ID,
    OPTICAL_FLOW_DATA::ID,
    GPS2_RAW_DATA::ID,
    GPS_RTK_DATA::ID,
    GPS2_RTK_DATA::ID,
    DISTANCE_SENSOR_DATA::ID,
    SCALED_PRESSURE3_DATA::ID,
    RANGEFINDER_DATA::ID,
    CAMERA_FEEDBACK_DATA::ID,
    BATTERY2_DATA::ID,
    MAG_CAL_PROGRESS_DATA::ID,
    MAG_CAL_REPORT_DATA::ID,
    PID_TUNING_DATA::ID,
    DEEPSTALL_DATA::ID,
    EFI_STATUS_DATA::ID,
    RPM_DATA::ID,
    CAMERA_INFORMATION_DATA::ID,
    CAMERA_SETTINGS_DATA::ID,
    CAMERA_CAPTURE_STATUS_DATA::ID,
    CAMERA_FOV_STATUS_DATA::ID,
    GIMBAL_MANAGER_INFORMATION_DATA::ID,
    GIMBAL_MANAGER_STATUS_DATA::ID,
    GIMBAL_DEVICE_ATTITUDE_STATUS_DATA::ID,
    AIS_VESSEL_DATA::ID,
    GENERATOR_STATUS_DATA::ID,
    WINCH_STATUS_DATA::ID,
    UAVIONIX_ADSB_OUT_STATUS_DATA::ID,
    AOA_SSA_DATA::ID,
];
/// Those of rovers alone.
const SILENT_OF_ROVERS: &[u32] = &[WATER_DEPTH_DATA::ID];
/// The message about traffic, one aircraft at a time: each serial port has its own progress through
/// the list.
pub(crate) const TRAFFIC: u32 = ADSB_VEHICLE_DATA::ID;
/// The message that cannot be requested, because the vehicle sends it together with another one.
const UNASKABLE: u32 = TERRAIN_REPORT;

/// The builder of a message, which is sent at any time or only in some states.
#[derive(Clone, Copy)]
enum Builder {
    Always(fn(&Autopilot) -> MavMessage),
    Sometimes(fn(&Autopilot) -> Option<MavMessage>),
}

impl Builder {
    fn build(self, autopilot: &Autopilot) -> Option<MavMessage> {
        match self {
            Always(build) => Some(build(autopilot)),
            Sometimes(build) => build(autopilot),
        }
    }
}

/// Message ids with their builders, in ascending order.
const TABLE: &[(u32, Builder)] = &[
    (HEARTBEAT_DATA::ID, Always(health::heartbeat)),
    (SYS_STATUS_DATA::ID, Always(health::sys_status)),
    (SYSTEM_TIME_DATA::ID, Always(health::system_time)),
    (GPS_RAW_INT_DATA::ID, Always(sensors::gps_raw_int)),
    (SCALED_IMU_DATA::ID, Always(extra::scaled_imu)),
    (RAW_IMU_DATA::ID, Always(sensors::raw_imu)),
    (SCALED_PRESSURE_DATA::ID, Always(sensors::scaled_pressure)),
    (ATTITUDE_DATA::ID, Always(motion::attitude)),
    (
        ATTITUDE_QUATERNION_DATA::ID,
        Always(motion::attitude_quaternion),
    ),
    (
        LOCAL_POSITION_NED_DATA::ID,
        Sometimes(motion::local_position_ned),
    ),
    (
        GLOBAL_POSITION_INT_DATA::ID,
        Always(motion::global_position_int),
    ),
    (SERVO_OUTPUT_RAW_DATA::ID, Always(extra::servo_output_raw)),
    (
        MISSION_CURRENT_DATA::ID,
        Always(navigation::mission_current),
    ),
    (
        MISSION_ITEM_REACHED_DATA::ID,
        Always(extra::mission_item_reached),
    ),
    (
        GPS_GLOBAL_ORIGIN_DATA::ID,
        Sometimes(navigation::gps_global_origin),
    ),
    (
        NAV_CONTROLLER_OUTPUT_DATA::ID,
        Sometimes(navigation::nav_controller_output),
    ),
    (RC_CHANNELS_DATA::ID, Always(extra::rc_channels)),
    (VFR_HUD_DATA::ID, Always(motion::vfr_hud)),
    (ATTITUDE_TARGET_DATA::ID, Always(extra::attitude_target)),
    (
        POSITION_TARGET_LOCAL_NED_DATA::ID,
        Sometimes(navigation::position_target_local_ned),
    ),
    (
        POSITION_TARGET_GLOBAL_INT_DATA::ID,
        Sometimes(navigation::position_target_global_int),
    ),
    (SIM_STATE_DATA::ID, Always(extra::sim_state)),
    (SCALED_IMU2_DATA::ID, Always(sensors::scaled_imu2)),
    (POWER_STATUS_DATA::ID, Always(health::power_status)),
    (SCALED_IMU3_DATA::ID, Always(extra::scaled_imu3)),
    (TERRAIN_REQUEST, Always(extra::terrain_request)),
    (TERRAIN_REPORT, Always(extra::terrain_report)),
    (SCALED_PRESSURE2_DATA::ID, Always(extra::scaled_pressure2)),
    (BATTERY_STATUS_DATA::ID, Always(health::battery_status)),
    (
        AUTOPILOT_VERSION_DATA::ID,
        Always(health::autopilot_version),
    ),
    (MEMINFO_DATA::ID, Always(health::meminfo)),
    (FENCE_STATUS_DATA::ID, Sometimes(fence::fence_status)),
    (AHRS_DATA::ID, Always(motion::ahrs)),
    (SIMSTATE_DATA::ID, Always(motion::simstate)),
    (HWSTATUS_DATA::ID, Always(extra::hwstatus)),
    (WIND_DATA::ID, Sometimes(sensors::wind)),
    (AHRS2_DATA::ID, Always(motion::ahrs2)),
    (
        EKF_STATUS_REPORT_DATA::ID,
        Always(health::ekf_status_report),
    ),
    (HIGH_LATENCY2_DATA::ID, Always(extra::high_latency2)),
    (VIBRATION_DATA::ID, Always(sensors::vibration)),
    (HOME_POSITION_DATA::ID, Sometimes(navigation::home_position)),
    (
        EXTENDED_SYS_STATE_DATA::ID,
        Always(health::extended_sys_state),
    ),
    (
        AUTOPILOT_STATE_FOR_GIMBAL_DEVICE_DATA::ID,
        Always(extra::state_for_gimbal),
    ),
    (RELAY_STATUS_DATA::ID, Always(extra::relay_status)),
    (ESC_TELEMETRY_1_TO_4_DATA::ID, Always(extra::esc_telemetry)),
];

/// The current message with an id; `None` if the vehicle has none.
pub(crate) fn message(id: u32, autopilot: &Autopilot) -> Option<MavMessage> {
    builder(id)?.build(autopilot)
}

/// The messages that are sent, by id.
pub(crate) fn sent() -> impl Iterator<Item = u32> {
    TABLE.iter().map(|(id, _)| *id).chain([TRAFFIC])
}

/// Messages that can be requested, but are never sent.
pub(crate) fn silent(kind: VehicleKind) -> impl Iterator<Item = u32> {
    let own: &[u32] = match kind {
        VehicleKind::Copter => &[],
        VehicleKind::Rover(_) => SILENT_OF_ROVERS,
    };
    SILENT.iter().chain(own).copied()
}

/// Whether the message can be requested.
pub(crate) fn is_known(id: u32, kind: VehicleKind) -> bool {
    let is_sent = id == TRAFFIC || builder(id).is_some();
    id != UNASKABLE && (is_sent || silent(kind).any(|silent| silent == id))
}

fn builder(id: u32) -> Option<Builder> {
    let at = TABLE.binary_search_by_key(&id, |(known, _)| *known).ok()?;
    TABLE.get(at).map(|(_, builder)| *builder)
}

fn boot_ms(autopilot: &Autopilot) -> u32 {
    autopilot.vehicle.uptime().as_millis() as u32
}

fn boot_us(autopilot: &Autopilot) -> u64 {
    autopilot.vehicle.uptime().as_micros() as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wind::Wind;
    use mavlink::Message as _;

    #[test]
    fn the_table_is_sorted_and_each_builder_makes_its_own_message() {
        assert!(TABLE.windows(2).all(|pair| pair[0].0 < pair[1].0));
        let mut autopilot = Autopilot::new(
            crate::VehicleKind::Copter,
            1,
            crate::tests::start(),
            crate::Airframe::shared_default(),
            Wind::new(0, 0),
        );
        for _ in 0..200 {
            autopilot.step();
        }
        for &(id, builder) in TABLE {
            if let Some(message) = builder.build(&autopilot) {
                assert_eq!(message.message_id(), id);
            }
        }
    }
}
