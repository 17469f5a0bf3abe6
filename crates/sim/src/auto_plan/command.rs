//! The vehicle's names for the commands of a plan.

use crate::cmd;

/// Names as in the vehicle's texts.
const NAMES: &[(u16, &str)] = &[
    (cmd::NAV_WAYPOINT, "WP"),
    (cmd::NAV_LOITER_UNLIM, "LoitUnlim"),
    (cmd::NAV_LOITER_TURNS, "LoitTurns"),
    (cmd::NAV_LOITER_TIME, "LoitTime"),
    (cmd::NAV_RETURN_TO_LAUNCH, "RTL"),
    (cmd::NAV_LAND, "Land"),
    (cmd::NAV_TAKEOFF, "Takeoff"),
    (cmd::NAV_CONTINUE_AND_CHANGE_ALT, "ContinueAndChangeAlt"),
    (cmd::NAV_LOITER_TO_ALT, "LoitAltitude"),
    (cmd::NAV_SPLINE_WAYPOINT, "SplineWP"),
    (cmd::NAV_ALTITUDE_WAIT, "AltitudeWait"),
    (cmd::NAV_VTOL_TAKEOFF, "VTOLTakeoff"),
    (cmd::NAV_VTOL_LAND, "VTOLLand"),
    (cmd::NAV_GUIDED_ENABLE, "GuidedEnable"),
    (cmd::NAV_DELAY, "Delay"),
    (cmd::NAV_PAYLOAD_PLACE, "PayloadPlace"),
    (cmd::CONDITION_DELAY, "CondDelay"),
    (cmd::CONDITION_DISTANCE, "CondDist"),
    (cmd::CONDITION_YAW, "CondYaw"),
    (cmd::DO_JUMP, "Jump"),
    (cmd::DO_CHANGE_SPEED, "ChangeSpeed"),
    (cmd::DO_SET_HOME, "SetHome"),
    (cmd::DO_SET_RELAY, "SetRelay"),
    (cmd::DO_REPEAT_RELAY, "RepeatRelay"),
    (cmd::DO_SET_SERVO, "SetServo"),
    (cmd::DO_REPEAT_SERVO, "RepeatServo"),
    (cmd::DO_RETURN_PATH_START, "ReturnPathStart"),
    (cmd::DO_LAND_START, "LandStart"),
    (cmd::DO_GO_AROUND, "Go Around"),
    (cmd::DO_PAUSE_CONTINUE, "PauseContinue"),
    (cmd::DO_SET_REVERSE, "SetReverse"),
    (cmd::DO_SET_ROI, "SetROI"),
    (cmd::DO_DIGICAM_CONFIGURE, "DigiCamCfg"),
    (cmd::DO_DIGICAM_CONTROL, "DigiCamCtrl"),
    (cmd::DO_MOUNT_CONTROL, "MountControl"),
    (cmd::DO_SET_CAM_TRIGG_DIST, "SetCamTrigDst"),
    (cmd::DO_FENCE_ENABLE, "FenceEnable"),
    (cmd::DO_PARACHUTE, "Parachute"),
    (cmd::DO_INVERTED_FLIGHT, "InvertedFlight"),
    (cmd::DO_GRIPPER, "Gripper"),
    (cmd::DO_AUTOTUNE_ENABLE, "AutoTuneEnable"),
    (cmd::NAV_SET_YAW_SPEED, "SetYawSpd"),
    (cmd::DO_SET_RESUME_REPEAT_DIST, "SetRepeatDist"),
    (cmd::DO_SPRAYER, "Sprayer"),
    (cmd::DO_SEND_SCRIPT_MESSAGE, "Scripting"),
    (cmd::DO_AUX_FUNCTION, "AuxFunction"),
    (cmd::DO_GUIDED_LIMITS, "GuidedLimits"),
    (cmd::DO_ENGINE_CONTROL, "EngineControl"),
    (cmd::SET_CAMERA_ZOOM, "SetCameraZoom"),
    (cmd::SET_CAMERA_FOCUS, "SetCameraFocus"),
    (cmd::SET_CAMERA_SOURCE, "SetCameraSource"),
    (cmd::JUMP_TAG, "Tag"),
    (cmd::DO_JUMP_TAG, "JumpToTag"),
    (cmd::DO_GIMBAL_MANAGER_PITCHYAW, "GimbalPitchYaw"),
    (cmd::IMAGE_START_CAPTURE, "ImageStartCapture"),
    (cmd::IMAGE_STOP_CAPTURE, "ImageStopCapture"),
    (cmd::VIDEO_START_CAPTURE, "VideoStartCapture"),
    (cmd::VIDEO_STOP_CAPTURE, "VideoStopCapture"),
    (cmd::DO_VTOL_TRANSITION, "VTOLTransition"),
    (cmd::DO_WINCH, "Winch"),
    (cmd::NAV_SCRIPT_TIME, "NavScriptTime"),
    (cmd::NAV_ATTITUDE_TIME, "NavAttitudeTime"),
];

/// Commands that the mission itself carries out: they complete at once and are never reported as
/// reached.
const QUIET: &[u16] = &[
    cmd::DO_SET_RELAY,
    cmd::DO_REPEAT_RELAY,
    cmd::DO_SET_SERVO,
    cmd::DO_REPEAT_SERVO,
    cmd::DO_DIGICAM_CONFIGURE,
    cmd::DO_DIGICAM_CONTROL,
    cmd::DO_SET_CAM_TRIGG_DIST,
    cmd::DO_PARACHUTE,
    cmd::DO_GRIPPER,
    cmd::DO_SET_RESUME_REPEAT_DIST,
    cmd::DO_SPRAYER,
    cmd::DO_SEND_SCRIPT_MESSAGE,
    cmd::DO_AUX_FUNCTION,
    cmd::SET_CAMERA_ZOOM,
    cmd::SET_CAMERA_FOCUS,
    cmd::SET_CAMERA_SOURCE,
    cmd::JUMP_TAG,
    cmd::DO_GIMBAL_MANAGER_PITCHYAW,
    cmd::IMAGE_START_CAPTURE,
    cmd::IMAGE_STOP_CAPTURE,
    cmd::VIDEO_START_CAPTURE,
    cmd::VIDEO_STOP_CAPTURE,
];

/// The name of a command.
pub(super) fn name(number: u16) -> &'static str {
    let at = NAMES.binary_search_by_key(&number, |(known, _)| *known);
    at.ok()
        .and_then(|at| NAMES.get(at))
        .map_or("?", |(_, name)| name)
}

/// Whether the command completes at once and is not reported as reached.
pub(super) fn is_quiet(number: u16) -> bool {
    QUIET.contains(&number)
}

/// Whether the command acts at once and is reported as reached.
pub(super) fn acts_at_once(number: u16) -> bool {
    matches!(
        number,
        cmd::DO_CHANGE_SPEED
            | cmd::DO_SET_HOME
            | cmd::DO_SET_ROI
            | cmd::DO_MOUNT_CONTROL
            | cmd::DO_GUIDED_LIMITS
            | cmd::DO_FENCE_ENABLE
            | cmd::DO_WINCH
            | cmd::DO_RETURN_PATH_START
            | cmd::DO_LAND_START
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_are_sorted_so_that_each_is_found() {
        assert!(NAMES.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(name(cmd::NAV_WAYPOINT), "WP");
        assert_eq!(name(9999), "?");
    }
}
