//! Files with the height of the ground.

use std::io::ErrorKind;
use std::path::Path;

use super::{StoreError, read_start};
use crate::geo::{Square, Terrain};
use crate::text;
use crate::text::Text;

/// The maximum size of a file, in bytes: more than 3601 by 3601 points of two bytes each.
const MOST_BYTES: u64 = 26_000_000;

/// Reads the file of a square in a folder; returns `false` if there is none.
///
/// # Errors
/// It cannot be read, or its size does not match either resolution.
pub fn add_square(terrain: &mut Terrain, folder: &Path, square: Square) -> Result<bool, Text> {
    let path = folder.join(square.file_name());
    let bytes = match read_start(&path, MOST_BYTES) {
        Ok(bytes) => bytes,
        Err(StoreError::Unreadable { error, .. }) if error.kind() == ErrorKind::NotFound => {
            return Ok(false);
        }
        Err(error) => return Err(Text::from(&error)),
    };
    terrain.add(square, &bytes).map_err(|wrong| {
        let path = path.display().to_string();
        text!("plan-terrain-size", path = path, bytes = wrong.0)
    })?;
    Ok(true)
}
