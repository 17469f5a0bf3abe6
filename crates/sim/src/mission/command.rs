//! The commands of a mission by number (`MAV_CMD`), and what the vehicle calls them.

pub(crate) const NAV_WAYPOINT: u16 = 16;
pub(super) const NAV_LOITER_UNLIM: u16 = 17;
pub(super) const NAV_LOITER_TURNS: u16 = 18;
pub(super) const NAV_LOITER_TIME: u16 = 19;
pub(super) const NAV_RETURN_TO_LAUNCH: u16 = 20;
pub(super) const NAV_LAND: u16 = 21;
pub(super) const NAV_TAKEOFF: u16 = 22;
pub(super) const NAV_LOITER_TO_ALT: u16 = 31;
pub(super) const NAV_SPLINE_WAYPOINT: u16 = 82;
pub(super) const NAV_VTOL_TAKEOFF: u16 = 84;
pub(super) const NAV_VTOL_LAND: u16 = 85;
pub(super) const NAV_GUIDED_ENABLE: u16 = 92;
pub(super) const NAV_DELAY: u16 = 93;
pub(super) const NAV_PAYLOAD_PLACE: u16 = 94;
/// The last number that means navigation.
pub(super) const NAV_LAST: u16 = 95;
pub(super) const CONDITION_DELAY: u16 = 112;
pub(super) const CONDITION_DISTANCE: u16 = 114;
pub(super) const CONDITION_YAW: u16 = 115;
pub(crate) const DO_JUMP: u16 = 177;
pub(super) const DO_CHANGE_SPEED: u16 = 178;
pub(super) const DO_SET_HOME: u16 = 179;
pub(super) const DO_SET_SERVO: u16 = 183;
pub(super) const DO_RETURN_PATH_START: u16 = 188;
pub(super) const DO_LAND_START: u16 = 189;
pub(super) const DO_SET_ROI: u16 = 201;
pub(super) const DO_MOUNT_CONTROL: u16 = 205;
pub(super) const DO_FENCE_ENABLE: u16 = 207;
pub(super) const NAV_SET_YAW_SPEED: u16 = 213;
pub(super) const DO_GUIDED_LIMITS: u16 = 222;
pub(super) const JUMP_TAG: u16 = 600;
pub(super) const DO_JUMP_TAG: u16 = 601;
const DO_WINCH: u16 = 42600;

/// Names as they stand in the texts of the vehicle.
const NAMES: &[(u16, &str)] = &[
    (NAV_WAYPOINT, "WP"),
    (NAV_LOITER_UNLIM, "LoitUnlim"),
    (NAV_LOITER_TURNS, "LoitTurns"),
    (NAV_LOITER_TIME, "LoitTime"),
    (NAV_RETURN_TO_LAUNCH, "RTL"),
    (NAV_LAND, "Land"),
    (NAV_TAKEOFF, "Takeoff"),
    (30, "ContinueAndChangeAlt"),
    (NAV_LOITER_TO_ALT, "LoitAltitude"),
    (NAV_SPLINE_WAYPOINT, "SplineWP"),
    (83, "AltitudeWait"),
    (NAV_VTOL_TAKEOFF, "VTOLTakeoff"),
    (NAV_VTOL_LAND, "VTOLLand"),
    (NAV_GUIDED_ENABLE, "GuidedEnable"),
    (NAV_DELAY, "Delay"),
    (NAV_PAYLOAD_PLACE, "PayloadPlace"),
    (CONDITION_DELAY, "CondDelay"),
    (CONDITION_DISTANCE, "CondDist"),
    (CONDITION_YAW, "CondYaw"),
    (DO_JUMP, "Jump"),
    (DO_CHANGE_SPEED, "ChangeSpeed"),
    (DO_SET_HOME, "SetHome"),
    (181, "SetRelay"),
    (182, "RepeatRelay"),
    (DO_SET_SERVO, "SetServo"),
    (184, "RepeatServo"),
    (DO_RETURN_PATH_START, "ReturnPathStart"),
    (DO_LAND_START, "LandStart"),
    (191, "Go Around"),
    (193, "PauseContinue"),
    (194, "SetReverse"),
    (DO_SET_ROI, "SetROI"),
    (202, "DigiCamCfg"),
    (203, "DigiCamCtrl"),
    (DO_MOUNT_CONTROL, "MountControl"),
    (206, "SetCamTrigDst"),
    (DO_FENCE_ENABLE, "FenceEnable"),
    (208, "Parachute"),
    (210, "InvertedFlight"),
    (211, "Gripper"),
    (212, "AutoTuneEnable"),
    (NAV_SET_YAW_SPEED, "SetYawSpd"),
    (215, "SetRepeatDist"),
    (216, "Sprayer"),
    (217, "Scripting"),
    (218, "AuxFunction"),
    (DO_GUIDED_LIMITS, "GuidedLimits"),
    (223, "EngineControl"),
    (531, "SetCameraZoom"),
    (532, "SetCameraFocus"),
    (534, "SetCameraSource"),
    (JUMP_TAG, "Tag"),
    (DO_JUMP_TAG, "JumpToTag"),
    (1000, "GimbalPitchYaw"),
    (2000, "ImageStartCapture"),
    (2001, "ImageStopCapture"),
    (2500, "VideoStartCapture"),
    (2501, "VideoStopCapture"),
    (3000, "VTOLTransition"),
    (DO_WINCH, "Winch"),
    (42702, "NavScriptTime"),
    (42703, "NavAttitudeTime"),
];

/// Commands that the mission itself carries out: over at once, and never reported as reached.
const QUIET: &[u16] = &[
    181, 182, 183, 184, 202, 203, 206, 208, 211, 215, 216, 217, 218, 531, 532, 534, 600, 1000,
    2000, 2001, 2500, 2501,
];

/// The name of a command.
pub(super) fn name(number: u16) -> &'static str {
    let at = NAMES.binary_search_by_key(&number, |(known, _)| *known);
    at.ok()
        .and_then(|at| NAMES.get(at))
        .map_or("?", |(_, name)| name)
}

/// Whether the command is over at once and not reported as reached.
pub(super) fn is_quiet(number: u16) -> bool {
    QUIET.contains(&number)
}

/// Commands that act at once and are reported as reached.
pub(super) fn acts_at_once(number: u16) -> bool {
    matches!(
        number,
        DO_CHANGE_SPEED
            | DO_SET_HOME
            | DO_SET_ROI
            | DO_MOUNT_CONTROL
            | DO_GUIDED_LIMITS
            | DO_FENCE_ENABLE
            | DO_WINCH
            | DO_RETURN_PATH_START
            | DO_LAND_START
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_are_sorted_so_that_each_is_found() {
        assert!(NAMES.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(name(NAV_WAYPOINT), "WP");
        assert_eq!(name(9999), "?");
    }
}
