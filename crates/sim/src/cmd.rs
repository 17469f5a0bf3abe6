//! The numbers of the `MAV_CMD`s that the vehicle supports, by name. They are plain numbers, since
//! any number may arrive.

#![expect(
    deprecated,
    reason = "ground stations in use still send what the dialect calls superseded"
)]

use mavlink::dialects::ardupilotmega::MavCmd;

pub(crate) const NAV_WAYPOINT: u16 = MavCmd::MAV_CMD_NAV_WAYPOINT as u16;
pub(crate) const NAV_LOITER_UNLIM: u16 = MavCmd::MAV_CMD_NAV_LOITER_UNLIM as u16;
pub(crate) const NAV_LOITER_TURNS: u16 = MavCmd::MAV_CMD_NAV_LOITER_TURNS as u16;
pub(crate) const NAV_LOITER_TIME: u16 = MavCmd::MAV_CMD_NAV_LOITER_TIME as u16;
pub(crate) const NAV_RETURN_TO_LAUNCH: u16 = MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH as u16;
pub(crate) const NAV_LAND: u16 = MavCmd::MAV_CMD_NAV_LAND as u16;
pub(crate) const NAV_TAKEOFF: u16 = MavCmd::MAV_CMD_NAV_TAKEOFF as u16;
pub(crate) const NAV_CONTINUE_AND_CHANGE_ALT: u16 =
    MavCmd::MAV_CMD_NAV_CONTINUE_AND_CHANGE_ALT as u16;
pub(crate) const NAV_LOITER_TO_ALT: u16 = MavCmd::MAV_CMD_NAV_LOITER_TO_ALT as u16;
pub(crate) const DO_FOLLOW: u16 = MavCmd::MAV_CMD_DO_FOLLOW as u16;
pub(crate) const NAV_SPLINE_WAYPOINT: u16 = MavCmd::MAV_CMD_NAV_SPLINE_WAYPOINT as u16;
pub(crate) const NAV_ALTITUDE_WAIT: u16 = MavCmd::MAV_CMD_NAV_ALTITUDE_WAIT as u16;
pub(crate) const NAV_VTOL_TAKEOFF: u16 = MavCmd::MAV_CMD_NAV_VTOL_TAKEOFF as u16;
pub(crate) const NAV_VTOL_LAND: u16 = MavCmd::MAV_CMD_NAV_VTOL_LAND as u16;
pub(crate) const NAV_GUIDED_ENABLE: u16 = MavCmd::MAV_CMD_NAV_GUIDED_ENABLE as u16;
pub(crate) const NAV_DELAY: u16 = MavCmd::MAV_CMD_NAV_DELAY as u16;
pub(crate) const NAV_PAYLOAD_PLACE: u16 = MavCmd::MAV_CMD_NAV_PAYLOAD_PLACE as u16;
pub(crate) const NAV_LAST: u16 = MavCmd::MAV_CMD_NAV_LAST as u16;
pub(crate) const CONDITION_DELAY: u16 = MavCmd::MAV_CMD_CONDITION_DELAY as u16;
pub(crate) const CONDITION_DISTANCE: u16 = MavCmd::MAV_CMD_CONDITION_DISTANCE as u16;
pub(crate) const CONDITION_YAW: u16 = MavCmd::MAV_CMD_CONDITION_YAW as u16;
pub(crate) const DO_SET_MODE: u16 = MavCmd::MAV_CMD_DO_SET_MODE as u16;
pub(crate) const DO_JUMP: u16 = MavCmd::MAV_CMD_DO_JUMP as u16;
pub(crate) const DO_CHANGE_SPEED: u16 = MavCmd::MAV_CMD_DO_CHANGE_SPEED as u16;
pub(crate) const DO_SET_HOME: u16 = MavCmd::MAV_CMD_DO_SET_HOME as u16;
pub(crate) const DO_SET_RELAY: u16 = MavCmd::MAV_CMD_DO_SET_RELAY as u16;
pub(crate) const DO_REPEAT_RELAY: u16 = MavCmd::MAV_CMD_DO_REPEAT_RELAY as u16;
pub(crate) const DO_SET_SERVO: u16 = MavCmd::MAV_CMD_DO_SET_SERVO as u16;
pub(crate) const DO_REPEAT_SERVO: u16 = MavCmd::MAV_CMD_DO_REPEAT_SERVO as u16;
pub(crate) const DO_FLIGHTTERMINATION: u16 = MavCmd::MAV_CMD_DO_FLIGHTTERMINATION as u16;
pub(crate) const DO_RETURN_PATH_START: u16 = MavCmd::MAV_CMD_DO_RETURN_PATH_START as u16;
pub(crate) const DO_LAND_START: u16 = MavCmd::MAV_CMD_DO_LAND_START as u16;
pub(crate) const DO_GO_AROUND: u16 = MavCmd::MAV_CMD_DO_GO_AROUND as u16;
pub(crate) const DO_REPOSITION: u16 = MavCmd::MAV_CMD_DO_REPOSITION as u16;
pub(crate) const DO_PAUSE_CONTINUE: u16 = MavCmd::MAV_CMD_DO_PAUSE_CONTINUE as u16;
pub(crate) const DO_SET_REVERSE: u16 = MavCmd::MAV_CMD_DO_SET_REVERSE as u16;
pub(crate) const DO_SET_ROI_LOCATION: u16 = MavCmd::MAV_CMD_DO_SET_ROI_LOCATION as u16;
pub(crate) const DO_SET_ROI_NONE: u16 = MavCmd::MAV_CMD_DO_SET_ROI_NONE as u16;
pub(crate) const DO_SET_ROI_SYSID: u16 = MavCmd::MAV_CMD_DO_SET_ROI_SYSID as u16;
pub(crate) const DO_SET_ROI: u16 = MavCmd::MAV_CMD_DO_SET_ROI as u16;
pub(crate) const DO_DIGICAM_CONFIGURE: u16 = MavCmd::MAV_CMD_DO_DIGICAM_CONFIGURE as u16;
pub(crate) const DO_DIGICAM_CONTROL: u16 = MavCmd::MAV_CMD_DO_DIGICAM_CONTROL as u16;
pub(crate) const DO_MOUNT_CONFIGURE: u16 = MavCmd::MAV_CMD_DO_MOUNT_CONFIGURE as u16;
pub(crate) const DO_MOUNT_CONTROL: u16 = MavCmd::MAV_CMD_DO_MOUNT_CONTROL as u16;
pub(crate) const DO_SET_CAM_TRIGG_DIST: u16 = MavCmd::MAV_CMD_DO_SET_CAM_TRIGG_DIST as u16;
pub(crate) const DO_FENCE_ENABLE: u16 = MavCmd::MAV_CMD_DO_FENCE_ENABLE as u16;
pub(crate) const DO_PARACHUTE: u16 = MavCmd::MAV_CMD_DO_PARACHUTE as u16;
pub(crate) const DO_MOTOR_TEST: u16 = MavCmd::MAV_CMD_DO_MOTOR_TEST as u16;
pub(crate) const DO_INVERTED_FLIGHT: u16 = MavCmd::MAV_CMD_DO_INVERTED_FLIGHT as u16;
pub(crate) const DO_GRIPPER: u16 = MavCmd::MAV_CMD_DO_GRIPPER as u16;
pub(crate) const DO_AUTOTUNE_ENABLE: u16 = MavCmd::MAV_CMD_DO_AUTOTUNE_ENABLE as u16;
pub(crate) const NAV_SET_YAW_SPEED: u16 = MavCmd::MAV_CMD_NAV_SET_YAW_SPEED as u16;
pub(crate) const DO_SET_RESUME_REPEAT_DIST: u16 = MavCmd::MAV_CMD_DO_SET_RESUME_REPEAT_DIST as u16;
pub(crate) const DO_SPRAYER: u16 = MavCmd::MAV_CMD_DO_SPRAYER as u16;
pub(crate) const DO_SEND_SCRIPT_MESSAGE: u16 = MavCmd::MAV_CMD_DO_SEND_SCRIPT_MESSAGE as u16;
pub(crate) const DO_AUX_FUNCTION: u16 = MavCmd::MAV_CMD_DO_AUX_FUNCTION as u16;
pub(crate) const DO_GUIDED_LIMITS: u16 = MavCmd::MAV_CMD_DO_GUIDED_LIMITS as u16;
pub(crate) const DO_ENGINE_CONTROL: u16 = MavCmd::MAV_CMD_DO_ENGINE_CONTROL as u16;
pub(crate) const DO_SET_MISSION_CURRENT: u16 = MavCmd::MAV_CMD_DO_SET_MISSION_CURRENT as u16;
pub(crate) const PREFLIGHT_CALIBRATION: u16 = MavCmd::MAV_CMD_PREFLIGHT_CALIBRATION as u16;
pub(crate) const PREFLIGHT_STORAGE: u16 = MavCmd::MAV_CMD_PREFLIGHT_STORAGE as u16;
pub(crate) const PREFLIGHT_REBOOT_SHUTDOWN: u16 = MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN as u16;
pub(crate) const MISSION_START: u16 = MavCmd::MAV_CMD_MISSION_START as u16;
pub(crate) const COMPONENT_ARM_DISARM: u16 = MavCmd::MAV_CMD_COMPONENT_ARM_DISARM as u16;
pub(crate) const RUN_PREARM_CHECKS: u16 = MavCmd::MAV_CMD_RUN_PREARM_CHECKS as u16;
pub(crate) const GET_HOME_POSITION: u16 = MavCmd::MAV_CMD_GET_HOME_POSITION as u16;
pub(crate) const START_RX_PAIR: u16 = MavCmd::MAV_CMD_START_RX_PAIR as u16;
pub(crate) const GET_MESSAGE_INTERVAL: u16 = MavCmd::MAV_CMD_GET_MESSAGE_INTERVAL as u16;
pub(crate) const SET_MESSAGE_INTERVAL: u16 = MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL as u16;
pub(crate) const REQUEST_MESSAGE: u16 = MavCmd::MAV_CMD_REQUEST_MESSAGE as u16;
pub(crate) const REQUEST_AUTOPILOT_CAPABILITIES: u16 =
    MavCmd::MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES as u16;
pub(crate) const SET_CAMERA_ZOOM: u16 = MavCmd::MAV_CMD_SET_CAMERA_ZOOM as u16;
pub(crate) const STORAGE_FORMAT: u16 = MavCmd::MAV_CMD_STORAGE_FORMAT as u16;
pub(crate) const SET_CAMERA_FOCUS: u16 = MavCmd::MAV_CMD_SET_CAMERA_FOCUS as u16;
pub(crate) const SET_CAMERA_SOURCE: u16 = MavCmd::MAV_CMD_SET_CAMERA_SOURCE as u16;
pub(crate) const JUMP_TAG: u16 = MavCmd::MAV_CMD_JUMP_TAG as u16;
pub(crate) const DO_JUMP_TAG: u16 = MavCmd::MAV_CMD_DO_JUMP_TAG as u16;
pub(crate) const DO_GIMBAL_MANAGER_PITCHYAW: u16 =
    MavCmd::MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW as u16;
pub(crate) const DO_GIMBAL_MANAGER_CONFIGURE: u16 =
    MavCmd::MAV_CMD_DO_GIMBAL_MANAGER_CONFIGURE as u16;
pub(crate) const IMAGE_START_CAPTURE: u16 = MavCmd::MAV_CMD_IMAGE_START_CAPTURE as u16;
pub(crate) const IMAGE_STOP_CAPTURE: u16 = MavCmd::MAV_CMD_IMAGE_STOP_CAPTURE as u16;
pub(crate) const VIDEO_START_CAPTURE: u16 = MavCmd::MAV_CMD_VIDEO_START_CAPTURE as u16;
pub(crate) const VIDEO_STOP_CAPTURE: u16 = MavCmd::MAV_CMD_VIDEO_STOP_CAPTURE as u16;
pub(crate) const AIRFRAME_CONFIGURATION: u16 = MavCmd::MAV_CMD_AIRFRAME_CONFIGURATION as u16;
pub(crate) const CONTROL_HIGH_LATENCY: u16 = MavCmd::MAV_CMD_CONTROL_HIGH_LATENCY as u16;
pub(crate) const DO_VTOL_TRANSITION: u16 = MavCmd::MAV_CMD_DO_VTOL_TRANSITION as u16;
pub(crate) const NAV_RALLY_POINT: u16 = MavCmd::MAV_CMD_NAV_RALLY_POINT as u16;
pub(crate) const DO_SET_SAFETY_SWITCH_STATE: u16 =
    MavCmd::MAV_CMD_DO_SET_SAFETY_SWITCH_STATE as u16;
pub(crate) const DO_ADSB_OUT_IDENT: u16 = MavCmd::MAV_CMD_DO_ADSB_OUT_IDENT as u16;
pub(crate) const CAN_FORWARD: u16 = MavCmd::MAV_CMD_CAN_FORWARD as u16;
pub(crate) const SOLO_BTN_FLY_CLICK: u16 = MavCmd::MAV_CMD_SOLO_BTN_FLY_CLICK as u16;
pub(crate) const SOLO_BTN_FLY_HOLD: u16 = MavCmd::MAV_CMD_SOLO_BTN_FLY_HOLD as u16;
pub(crate) const SOLO_BTN_PAUSE_CLICK: u16 = MavCmd::MAV_CMD_SOLO_BTN_PAUSE_CLICK as u16;
pub(crate) const FIXED_MAG_CAL_YAW: u16 = MavCmd::MAV_CMD_FIXED_MAG_CAL_YAW as u16;
pub(crate) const SET_EKF_SOURCE_SET: u16 = MavCmd::MAV_CMD_SET_EKF_SOURCE_SET as u16;
pub(crate) const DO_START_MAG_CAL: u16 = MavCmd::MAV_CMD_DO_START_MAG_CAL as u16;
pub(crate) const DO_ACCEPT_MAG_CAL: u16 = MavCmd::MAV_CMD_DO_ACCEPT_MAG_CAL as u16;
pub(crate) const DO_CANCEL_MAG_CAL: u16 = MavCmd::MAV_CMD_DO_CANCEL_MAG_CAL as u16;
pub(crate) const DO_SEND_BANNER: u16 = MavCmd::MAV_CMD_DO_SEND_BANNER as u16;
pub(crate) const ACCELCAL_VEHICLE_POS: u16 = MavCmd::MAV_CMD_ACCELCAL_VEHICLE_POS as u16;
pub(crate) const DO_WINCH: u16 = MavCmd::MAV_CMD_DO_WINCH as u16;
pub(crate) const BATTERY_RESET: u16 = MavCmd::MAV_CMD_BATTERY_RESET as u16;
pub(crate) const DEBUG_TRAP: u16 = MavCmd::MAV_CMD_DEBUG_TRAP as u16;
pub(crate) const SCRIPTING: u16 = MavCmd::MAV_CMD_SCRIPTING as u16;
pub(crate) const NAV_SCRIPT_TIME: u16 = MavCmd::MAV_CMD_NAV_SCRIPT_TIME as u16;
pub(crate) const NAV_ATTITUDE_TIME: u16 = MavCmd::MAV_CMD_NAV_ATTITUDE_TIME as u16;
pub(crate) const EXTERNAL_POSITION_ESTIMATE: u16 =
    MavCmd::MAV_CMD_EXTERNAL_POSITION_ESTIMATE as u16;
