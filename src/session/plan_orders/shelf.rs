//! The files of plans, as a session needs them.

use std::fmt::Debug;

use crate::plan::{Item, ListKind};
use crate::text::Text;

/// Reads and writes files of plans, fences and rally points. Names are as the user typed them.
pub trait PlanShelf: Debug + Send + Sync {
    /// The items of a list in a file.
    ///
    /// # Errors
    /// A text that names the file, the place of the fault, and the fault.
    fn read(&self, file: &str, kind: ListKind) -> Result<Vec<Item>, Text>;

    /// Writes a new file and returns its path; no file is replaced.
    ///
    /// # Errors
    /// A text if the file exists or cannot be written.
    fn write(&self, file: &str, kind: ListKind, items: &[Item]) -> Result<String, Text>;
}
