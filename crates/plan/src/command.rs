//! Names for the `MAV_CMD` numbers that have a meaning here. A list may contain any other number as well.

/// Flies to a place.
pub const WAYPOINT: u16 = 16;
/// Circles or hovers without end.
pub const LOITER_UNLIMITED: u16 = 17;
/// Circles a place for a number of turns.
pub const LOITER_TURNS: u16 = 18;
/// Stays at a place for a time.
pub const LOITER_TIME: u16 = 19;
/// Returns to the launch position and lands.
pub const RETURN_TO_LAUNCH: u16 = 20;
/// Lands at a place, or at the current one.
pub const LAND: u16 = 21;
/// Takes off to a height.
pub const TAKEOFF: u16 = 22;
/// Stays at a place until a height is reached.
pub const LOITER_TO_ALTITUDE: u16 = 31;
/// A region of interest; superseded, but old plans still contain it.
pub const ROI: u16 = 80;
/// Flies to a place along a curve.
pub const SPLINE_WAYPOINT: u16 = 82;
/// Takes off vertically (VTOL).
pub const VTOL_TAKEOFF: u16 = 84;
/// Lands vertically, as a VTOL.
pub const VTOL_LAND: u16 = 85;
/// Waits for a time before the next navigation command.
pub const DELAY: u16 = 93;
/// Descends and puts down a load.
pub const PAYLOAD_PLACE: u16 = 94;
/// The highest number of a navigation command.
pub const LAST_NAVIGATION: u16 = 95;
/// Continues at another item: parameter 1 is its number, parameter 2 the number of repetitions.
pub const DO_JUMP: u16 = 177;
/// Delays the next `DO` command.
pub const CONDITION_DELAY: u16 = 112;
/// Sets the speed from here on.
pub const DO_CHANGE_SPEED: u16 = 178;
/// Moves home to a place.
pub const DO_SET_HOME: u16 = 179;
/// Switches the fence on or off.
pub const DO_FENCE_ENABLE: u16 = 207;
/// Acts like a switch of the remote control: parameter 1 is the auxiliary function.
pub const DO_AUX_FUNCTION: u16 = 218;
/// Marks the start of the return path.
pub const DO_RETURN_PATH_START: u16 = 188;
/// Marks the start of a landing sequence.
pub const DO_LAND_START: u16 = 189;
/// A region of interest at a place.
pub const DO_SET_ROI_LOCATION: u16 = 195;
/// A region of interest.
pub const DO_SET_ROI: u16 = 201;
/// A tag that jumps may refer to.
pub const JUMP_TAG: u16 = 600;
/// Continues at a tag: parameter 1 is the tag, parameter 2 the number of repetitions.
pub const DO_JUMP_TAG: u16 = 601;
/// The place to which a vehicle returns after a fence breach.
pub const FENCE_RETURN_POINT: u16 = 5000;
/// A corner of an inclusion polygon; parameter 1 is the number of the polygon's corners.
pub const FENCE_POLYGON_INCLUSION: u16 = 5001;
/// A corner of an exclusion polygon; parameter 1 is the number of the polygon's corners.
pub const FENCE_POLYGON_EXCLUSION: u16 = 5002;
/// An inclusion circle; parameter 1 is its radius in metres.
pub const FENCE_CIRCLE_INCLUSION: u16 = 5003;
/// An exclusion circle; parameter 1 is its radius in metres.
pub const FENCE_CIRCLE_EXCLUSION: u16 = 5004;
/// A place other than home where RTL may end.
pub const RALLY_POINT: u16 = 5100;

/// Commands of a plan whose x and y are a place. Source: MAVLink's `MAV_CMD`, `hasLocation`.
const WITH_PLACE: &[u16] = &[
    WAYPOINT,
    LOITER_UNLIMITED,
    LOITER_TURNS,
    LOITER_TIME,
    LAND,
    TAKEOFF,
    // NAV_FOLLOW and NAV_ARC_WAYPOINT.
    25,
    LOITER_TO_ALTITUDE,
    36,
    ROI,
    SPLINE_WAYPOINT,
    VTOL_TAKEOFF,
    VTOL_LAND,
    PAYLOAD_PLACE,
    DO_SET_HOME,
    DO_RETURN_PATH_START,
    DO_LAND_START,
    DO_SET_ROI_LOCATION,
    DO_SET_ROI,
];

/// Whether a command has a place in x and y.
pub fn has_place(command: u16) -> bool {
    // WAYPOINT_USER_1 to SPATIAL_USER_5.
    let of_users = 31_000..=31_009;
    WITH_PLACE.contains(&command)
        || is_fence(command)
        || command == RALLY_POINT
        || of_users.contains(&command)
}

/// Whether a command is an item of a fence.
pub fn is_fence(command: u16) -> bool {
    (FENCE_RETURN_POINT..=FENCE_CIRCLE_EXCLUSION).contains(&command)
}

/// Whether a command is a corner of a fence's polygon.
pub fn is_corner(command: u16) -> bool {
    matches!(command, FENCE_POLYGON_INCLUSION | FENCE_POLYGON_EXCLUSION)
}

/// Whether a command is a circle of a fence.
pub fn is_circle(command: u16) -> bool {
    matches!(command, FENCE_CIRCLE_INCLUSION | FENCE_CIRCLE_EXCLUSION)
}

/// Whether a command is a navigation command. Navigation commands are carried out one after the
/// other; other commands act in parallel. Source: `AP_Mission::is_nav_cmd`.
pub fn is_navigation(command: u16) -> bool {
    // NAV_SET_YAW_SPEED, NAV_SCRIPT_TIME, NAV_ATTITUDE_TIME.
    command <= LAST_NAVIGATION || matches!(command, 213 | 42_702 | 42_703)
}

/// Whether a command is a jump.
pub fn is_jump(command: u16) -> bool {
    matches!(command, DO_JUMP | DO_JUMP_TAG)
}

/// Whether a command is a takeoff.
pub fn is_takeoff(command: u16) -> bool {
    matches!(command, TAKEOFF | VTOL_TAKEOFF)
}

/// Whether a command ends a flight: afterwards, the vehicle is on the ground or stays where it is.
pub fn is_end(command: u16) -> bool {
    matches!(
        command,
        RETURN_TO_LAUNCH | LAND | VTOL_LAND | LOITER_UNLIMITED
    )
}

/// Whether a vehicle flies to the command's place, which is then part of its path.
pub fn is_flown_to(command: u16) -> bool {
    has_place(command) && command <= PAYLOAD_PLACE && command != ROI
}
