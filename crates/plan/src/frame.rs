//! Names for the `MAV_FRAME` numbers of items. Older autopilots also use the `_INT` variants of
//! these, which [`HeightFrame`](crate::HeightFrame) recognises.

/// Heights above mean sea level (`MAV_FRAME_GLOBAL`); also the frame of fence items, which have no
/// height.
pub const SEA_LEVEL: u8 = 0;
/// No place: the parameters are plain numbers (`MAV_FRAME_MISSION`).
pub const MISSION: u8 = 2;
/// Heights above home (`MAV_FRAME_GLOBAL_RELATIVE_ALT`).
pub const ABOVE_HOME: u8 = 3;
/// Heights above the ground below (`MAV_FRAME_GLOBAL_TERRAIN_ALT`).
pub const ABOVE_TERRAIN: u8 = 10;
