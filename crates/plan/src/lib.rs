//! The lists that a MAVLink vehicle carries on board: its plan, its fence and its rally points
//! (`MAV_MISSION_TYPE`). Items keep every field of the wire, so that what was read can be written back unchanged.

#![warn(missing_docs)]

mod item;

pub use item::{HeightFrame, Item, ListKind};
