//! The numbers of the `MAV_CMD`s that mean something here, by name. Any other number may stand in a list as well.

/// To fly to a place.
pub const WAYPOINT: u16 = 16;
/// To circle or hover without end.
pub const LOITER_UNLIMITED: u16 = 17;
/// To fly turns around a place.
pub const LOITER_TURNS: u16 = 18;
/// To stay at a place for a time.
pub const LOITER_TIME: u16 = 19;
/// To return and land.
pub const RETURN_TO_LAUNCH: u16 = 20;
/// To land.
pub const LAND: u16 = 21;
/// To take off.
pub const TAKEOFF: u16 = 22;
/// To stay at a place until a height is reached.
pub const LOITER_TO_ALTITUDE: u16 = 31;
/// A region of interest; superseded, but plans still have it.
pub const ROI: u16 = 80;
/// To fly to a place on a curve.
pub const SPLINE_WAYPOINT: u16 = 82;
/// To take off as a VTOL.
pub const VTOL_TAKEOFF: u16 = 84;
/// To land as a VTOL.
pub const VTOL_LAND: u16 = 85;
/// To wait for a time before the next navigation command.
pub const DELAY: u16 = 93;
/// To descend and put down a load.
pub const PAYLOAD_PLACE: u16 = 94;
/// The last number of a command that navigates.
pub const LAST_NAVIGATION: u16 = 95;
/// To go on at another item: parameter 1 is its number, parameter 2 the number of times.
pub const DO_JUMP: u16 = 177;
/// To fly at another speed from here on.
pub const DO_CHANGE_SPEED: u16 = 178;
/// To move home.
pub const DO_SET_HOME: u16 = 179;
/// The start of the way back.
pub const DO_RETURN_PATH_START: u16 = 188;
/// The start of a landing.
pub const DO_LAND_START: u16 = 189;
/// A region of interest at a place.
pub const DO_SET_ROI_LOCATION: u16 = 195;
/// A region of interest.
pub const DO_SET_ROI: u16 = 201;
/// A tag that jumps may name.
pub const JUMP_TAG: u16 = 600;
/// To go on at a tag: parameter 1 is the tag, parameter 2 the number of times.
pub const DO_JUMP_TAG: u16 = 601;
/// Where a vehicle goes after it broke a fence.
pub const FENCE_RETURN_POINT: u16 = 5000;
/// A corner of an area to stay in; parameter 1 is the number of corners of its polygon.
pub const FENCE_POLYGON_INCLUSION: u16 = 5001;
/// A corner of an area to stay out of.
pub const FENCE_POLYGON_EXCLUSION: u16 = 5002;
/// A circle to stay in; parameter 1 is its radius in metres.
pub const FENCE_CIRCLE_INCLUSION: u16 = 5003;
/// A circle to stay out of.
pub const FENCE_CIRCLE_EXCLUSION: u16 = 5004;
/// A rally point.
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

/// Whether commands of that number have a place in x and y.
pub fn has_place(command: u16) -> bool {
    // WAYPOINT_USER_1 to SPATIAL_USER_5.
    let of_users = 31_000..=31_009;
    WITH_PLACE.contains(&command)
        || is_fence(command)
        || command == RALLY_POINT
        || of_users.contains(&command)
}

/// Whether it is an item of a fence.
pub fn is_fence(command: u16) -> bool {
    (FENCE_RETURN_POINT..=FENCE_CIRCLE_EXCLUSION).contains(&command)
}

/// Whether it is a corner of a fence's polygon.
pub fn is_corner(command: u16) -> bool {
    matches!(command, FENCE_POLYGON_INCLUSION | FENCE_POLYGON_EXCLUSION)
}

/// Whether it is a circle of a fence.
pub fn is_circle(command: u16) -> bool {
    matches!(command, FENCE_CIRCLE_INCLUSION | FENCE_CIRCLE_EXCLUSION)
}

/// Whether it is a takeoff.
pub fn is_takeoff(command: u16) -> bool {
    matches!(command, TAKEOFF | VTOL_TAKEOFF)
}

/// Whether it ends a flight: after it the vehicle is on the ground, or stays where it is.
pub fn is_end(command: u16) -> bool {
    matches!(
        command,
        RETURN_TO_LAUNCH | LAND | VTOL_LAND | LOITER_UNLIMITED
    )
}

/// Whether a vehicle flies to the command's place, so that the place belongs to its path.
pub fn is_flown_to(command: u16) -> bool {
    has_place(command) && command <= PAYLOAD_PLACE && command != ROI
}
