//! The file of a session.

use super::wire::Refusal;
use crate::parameters::Parameters;
use crate::plan::ListKind;
use crate::transfer::content::FileContent;
use crate::transfer::tree::{self, Disk, NO_SPACE};

/// The maximum size of a parameter file or plan file that is being written, in bytes.
const MOST_WRITTEN: usize = 64 * 1024;

/// A file that is being read or written.
#[derive(Debug, Clone)]
pub(super) enum Open {
    Reading(FileContent),
    /// A file on the disk, by its path.
    Writing(String),
    WritingParameters(Vec<u8>),
    WritingPlan(ListKind, Vec<u8>),
}

impl Open {
    /// Reads bytes at an offset, up to a limit.
    pub(super) fn read(
        &mut self,
        parameters: &Parameters,
        offset: usize,
        len: usize,
    ) -> Result<Vec<u8>, Refusal> {
        let Self::Reading(content) = self else {
            return Err(Refusal::Fail);
        };
        let bytes = content.read(parameters, offset, len)?;
        if bytes.is_empty() {
            return Err(Refusal::EndOfFile);
        }
        Ok(bytes.to_vec())
    }

    /// Writes bytes at an offset.
    pub(super) fn write(
        &mut self,
        disk: &mut Disk,
        offset: usize,
        bytes: &[u8],
    ) -> Result<(), Refusal> {
        match self {
            Self::Reading(_) => return Err(Refusal::Fail),
            Self::Writing(path) => disk.write(path, offset, bytes)?,
            Self::WritingParameters(file) | Self::WritingPlan(_, file) => {
                if offset.saturating_add(bytes.len()) > MOST_WRITTEN {
                    return Err(Refusal::System(NO_SPACE));
                }
                tree::write_into(file, offset, bytes);
            }
        }
        Ok(())
    }
}
