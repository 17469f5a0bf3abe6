//! What a vehicle documents about itself: MAVLink's component metadata. A vehicle names a general file
//! (`COMPONENT_METADATA`), which names the others: the documentation of its parameters and of its events. PX4 has them on
//! board, compressed (`.json.xz`). Source: `component_information.md` and `ftp.md` of MAVLink's guide.

mod events;
mod general;
mod packing;

pub use events::{EventDocuments, ReadEvents};
pub use general::{MetadataFile, MetadataKind, MetadataPlace, general};
pub use packing::{LARGEST_PACKED, is_packed, unpacked};
