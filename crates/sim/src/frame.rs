//! The numbers of the `MAV_FRAME`s that the vehicle supports, by name, and the reference of their
//! heights. They are plain numbers, since any number may arrive.

#![expect(
    deprecated,
    reason = "ground stations in use still send what the dialect calls superseded"
)]

use mavlink::dialects::ardupilotmega::MavFrame;

pub(crate) const GLOBAL: u8 = MavFrame::MAV_FRAME_GLOBAL as u8;
pub(crate) const LOCAL_NED: u8 = MavFrame::MAV_FRAME_LOCAL_NED as u8;
/// The frame of the place in a `COMMAND_LONG`.
pub(crate) const GLOBAL_RELATIVE_ALT: u8 = MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT as u8;
const GLOBAL_INT: u8 = MavFrame::MAV_FRAME_GLOBAL_INT as u8;
const GLOBAL_RELATIVE_ALT_INT: u8 = MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT as u8;
pub(crate) const LOCAL_OFFSET_NED: u8 = MavFrame::MAV_FRAME_LOCAL_OFFSET_NED as u8;
pub(crate) const BODY_NED: u8 = MavFrame::MAV_FRAME_BODY_NED as u8;
pub(crate) const BODY_OFFSET_NED: u8 = MavFrame::MAV_FRAME_BODY_OFFSET_NED as u8;
const GLOBAL_TERRAIN_ALT: u8 = MavFrame::MAV_FRAME_GLOBAL_TERRAIN_ALT as u8;
const GLOBAL_TERRAIN_ALT_INT: u8 = MavFrame::MAV_FRAME_GLOBAL_TERRAIN_ALT_INT as u8;

/// The reference of a height in a global frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum HeightOrigin {
    Sea,
    Home,
    Terrain,
}

impl HeightOrigin {
    /// The origin of a frame's heights; `None` if the vehicle has no such global frame.
    pub(crate) fn of(frame: u8) -> Option<Self> {
        match frame {
            GLOBAL | GLOBAL_INT => Some(Self::Sea),
            GLOBAL_RELATIVE_ALT | GLOBAL_RELATIVE_ALT_INT => Some(Self::Home),
            GLOBAL_TERRAIN_ALT | GLOBAL_TERRAIN_ALT_INT => Some(Self::Terrain),
            _ => None,
        }
    }
}
