//! The names of events, errors and reasons in logs by number, as in `ArduPilot` 4.6.

/// The names of events by their number (`EV.Id`).
const EVENTS: &[(u8, &str)] = &[
    (10, "ARMED"),
    (11, "DISARMED"),
    (15, "AUTO_ARMED"),
    (17, "LAND_COMPLETE_MAYBE"),
    (18, "LAND_COMPLETE"),
    (19, "LOST_GPS"),
    (21, "FLIP_START"),
    (22, "FLIP_END"),
    (25, "SET_HOME"),
    (26, "SET_SIMPLE_ON"),
    (27, "SET_SIMPLE_OFF"),
    (28, "NOT_LANDED"),
    (29, "SET_SUPERSIMPLE_ON"),
    (30, "AUTOTUNE_INITIALISED"),
    (31, "AUTOTUNE_OFF"),
    (32, "AUTOTUNE_RESTART"),
    (33, "AUTOTUNE_SUCCESS"),
    (34, "AUTOTUNE_FAILED"),
    (35, "AUTOTUNE_REACHED_LIMIT"),
    (36, "AUTOTUNE_PILOT_TESTING"),
    (37, "AUTOTUNE_SAVEDGAINS"),
    (38, "SAVE_TRIM"),
    (39, "SAVEWP_ADD_WP"),
    (41, "FENCE_ENABLE"),
    (42, "FENCE_DISABLE"),
    (43, "ACRO_TRAINER_OFF"),
    (44, "ACRO_TRAINER_LEVELING"),
    (45, "ACRO_TRAINER_LIMITED"),
    (46, "GRIPPER_GRAB"),
    (47, "GRIPPER_RELEASE"),
    (49, "PARACHUTE_DISABLED"),
    (50, "PARACHUTE_ENABLED"),
    (51, "PARACHUTE_RELEASED"),
    (52, "LANDING_GEAR_DEPLOYED"),
    (53, "LANDING_GEAR_RETRACTED"),
    (54, "MOTORS_EMERGENCY_STOPPED"),
    (55, "MOTORS_EMERGENCY_STOP_CLEARED"),
    (56, "MOTORS_INTERLOCK_DISABLED"),
    (57, "MOTORS_INTERLOCK_ENABLED"),
    (58, "ROTOR_RUNUP_COMPLETE"),
    (59, "ROTOR_SPEED_BELOW_CRITICAL"),
    (60, "EKF_ALT_RESET"),
    (61, "LAND_CANCELLED_BY_PILOT"),
    (62, "EKF_YAW_RESET"),
    (63, "AVOIDANCE_ADSB_ENABLE"),
    (64, "AVOIDANCE_ADSB_DISABLE"),
    (65, "AVOIDANCE_PROXIMITY_ENABLE"),
    (66, "AVOIDANCE_PROXIMITY_DISABLE"),
    (67, "GPS_PRIMARY_CHANGED"),
    (71, "ZIGZAG_STORE_A"),
    (72, "ZIGZAG_STORE_B"),
    (73, "LAND_REPO_ACTIVE"),
    (74, "STANDBY_ENABLE"),
    (75, "STANDBY_DISABLE"),
    (80, "FENCE_FLOOR_ENABLE"),
    (81, "FENCE_FLOOR_DISABLE"),
    (85, "EK3_SOURCES_SET_TO_PRIMARY"),
    (86, "EK3_SOURCES_SET_TO_SECONDARY"),
    (87, "EK3_SOURCES_SET_TO_TERTIARY"),
    (90, "AIRSPEED_PRIMARY_CHANGED"),
    (163, "SURFACED"),
    (164, "NOT_SURFACED"),
    (165, "BOTTOMED"),
    (166, "NOT_BOTTOMED"),
];

/// Parts of the autopilot that report errors (`ERR.Subsys`).
const SUBSYSTEMS: &[(u8, &str)] = &[
    (1, "MAIN"),
    (2, "RADIO"),
    (3, "COMPASS"),
    (4, "OPTFLOW"),
    (5, "FAILSAFE_RADIO"),
    (6, "FAILSAFE_BATT"),
    (7, "FAILSAFE_GPS"),
    (8, "FAILSAFE_GCS"),
    (9, "FAILSAFE_FENCE"),
    (10, "FLIGHT_MODE"),
    (11, "GPS"),
    (12, "CRASH_CHECK"),
    (13, "FLIP"),
    (14, "AUTOTUNE"),
    (15, "PARACHUTES"),
    (16, "EKFCHECK"),
    (17, "FAILSAFE_EKFINAV"),
    (18, "BARO"),
    (19, "CPU"),
    (20, "FAILSAFE_ADSB"),
    (21, "TERRAIN"),
    (22, "NAVIGATION"),
    (23, "FAILSAFE_TERRAIN"),
    (24, "EKF_PRIMARY"),
    (25, "THRUST_LOSS_CHECK"),
    (26, "FAILSAFE_SENSORS"),
    (27, "FAILSAFE_LEAK"),
    (28, "PILOT_INPUT"),
    (29, "FAILSAFE_VIBE"),
    (30, "INTERNAL_ERROR"),
    (31, "FAILSAFE_DEADRECKON"),
];

/// The reasons why a mode was entered (`MODE.Rsn`).
const REASONS: &[(u8, &str)] = &[
    (0, "UNKNOWN"),
    (1, "RC_COMMAND"),
    (2, "GCS_COMMAND"),
    (3, "RADIO_FAILSAFE"),
    (4, "BATTERY_FAILSAFE"),
    (5, "GCS_FAILSAFE"),
    (6, "EKF_FAILSAFE"),
    (7, "GPS_GLITCH"),
    (8, "MISSION_END"),
    (9, "THROTTLE_LAND_ESCAPE"),
    (10, "FENCE_BREACHED"),
    (11, "TERRAIN_FAILSAFE"),
    (12, "BRAKE_TIMEOUT"),
    (13, "FLIP_COMPLETE"),
    (14, "AVOIDANCE"),
    (15, "AVOIDANCE_RECOVERY"),
    (16, "THROW_COMPLETE"),
    (17, "TERMINATE"),
    (18, "TOY_MODE"),
    (19, "CRASH_FAILSAFE"),
    (20, "SOARING_FBW_B_WITH_MOTOR_RUNNING"),
    (21, "SOARING_THERMAL_DETECTED"),
    (22, "SOARING_THERMAL_ESTIMATE_DETERIORATED"),
    (23, "VTOL_FAILED_TRANSITION"),
    (24, "VTOL_FAILED_TAKEOFF"),
    (25, "FAILSAFE"),
    (26, "INITIALISED"),
    (27, "SURFACE_COMPLETE"),
    (28, "BAD_DEPTH"),
    (29, "LEAK_FAILSAFE"),
    (30, "SERVOTEST"),
    (31, "STARTUP"),
    (32, "SCRIPTING"),
    (33, "UNAVAILABLE"),
    (34, "AUTOROTATION_START"),
    (35, "AUTOROTATION_BAILOUT"),
    (36, "SOARING_ALT_TOO_HIGH"),
    (37, "SOARING_ALT_TOO_LOW"),
    (38, "SOARING_DRIFT_EXCEEDED"),
    (39, "RTL_COMPLETE_SWITCHING_TO_VTOL_LAND_RTL"),
    (40, "RTL_COMPLETE_SWITCHING_TO_FIXEDWING_AUTOLAND"),
    (41, "MISSION_CMD"),
    (42, "FRSKY_COMMAND"),
    (43, "FENCE_RETURN_PREVIOUS_MODE"),
    (44, "QRTL_INSTEAD_OF_RTL"),
    (45, "AUTO_RTL_EXIT"),
    (46, "LOITER_ALT_REACHED_QLAND"),
    (47, "LOITER_ALT_IN_VTOL"),
    (48, "RADIO_FAILSAFE_RECOVERY"),
    (49, "QLAND_INSTEAD_OF_RTL"),
    (50, "DEADRECKON_FAILSAFE"),
    (51, "MODE_TAKEOFF_FAILSAFE"),
    (52, "DDS_COMMAND"),
];

/// The error codes (`ERR.ECode`) of the subsystems that have codes of their own.
const CODES: &[(&str, u8, &str)] = &[
    ("CRASH_CHECK", 1, "CRASH"),
    ("CRASH_CHECK", 2, "LOSS_OF_CONTROL"),
    ("EKFCHECK", 0, "VARIANCE_CLEARED"),
    ("EKFCHECK", 2, "BAD_VARIANCE"),
    ("FLIP", 2, "ABANDONED"),
    ("GPS", 0, "GLITCH_CLEARED"),
    ("GPS", 2, "GLITCH"),
    ("BARO", 0, "GLITCH_CLEARED"),
    ("BARO", 2, "GLITCH"),
    ("MAIN", 1, "INS_DELAY"),
    ("RADIO", 2, "LATE_FRAME"),
    ("PARACHUTES", 2, "TOO_LOW"),
    ("PARACHUTES", 3, "LANDED"),
    ("TERRAIN", 2, "MISSING_DATA"),
    ("NAVIGATION", 2, "FAILED_TO_SET_DESTINATION"),
    ("NAVIGATION", 3, "RESTARTED_RTL"),
    ("NAVIGATION", 4, "FAILED_CIRCLE_INIT"),
    ("NAVIGATION", 5, "DEST_OUTSIDE_FENCE"),
    ("EKF_PRIMARY", 0, "LANE_0"),
    ("EKF_PRIMARY", 1, "LANE_1"),
    ("EKF_PRIMARY", 2, "LANE_2"),
];

fn named(table: &[(u8, &'static str)], number: u8) -> Option<&'static str> {
    let row = table.iter().find(|(known, _)| *known == number)?;
    Some(row.1)
}

/// The name of an event, or its number.
pub(super) fn event(id: u8) -> String {
    named(EVENTS, id).map_or_else(|| id.to_string(), str::to_owned)
}

/// The names of an error: its subsystem, and its code.
pub(super) fn error(subsystem: u8, code: u8) -> (String, String) {
    let Some(part) = named(SUBSYSTEMS, subsystem) else {
        return (subsystem.to_string(), code.to_string());
    };
    let own = CODES
        .iter()
        .find(|(name, number, _)| *name == part && *number == code);
    let meaning = match (own, code) {
        (Some((_, _, meaning)), _) => (*meaning).to_owned(),
        (None, 0) => "RESOLVED".to_owned(),
        (None, 1) if part.starts_with("FAILSAFE") => "OCCURRED".to_owned(),
        (None, 4) if !part.starts_with("FAILSAFE") => "UNHEALTHY".to_owned(),
        (None, code) => code.to_string(),
    };
    (part.to_owned(), meaning)
}

/// The name of the reason for a mode; `None` for an unknown one.
pub(super) fn reason(number: u8) -> Option<&'static str> {
    named(REASONS, number).filter(|_| number > 0)
}
