//! The interface through which a session accesses plan files.

use std::fmt::Debug;

use crate::plan::{Document, FileFormat, ListKind};
use crate::text::Text;

/// Reads and writes files of plans, fences and rally points. Names are as the user typed them.
pub trait PlanShelf: Debug + Send + Sync {
    /// The content of a file.
    ///
    /// # Errors
    /// A text that names the file, and the place of the first fault.
    fn read(&self, file: &str) -> Result<Document, Text>;

    /// Writes a new file and returns its path; no file is replaced.
    ///
    /// # Errors
    /// A text if the file exists or cannot be written.
    fn write(&self, file: &str, kind: ListKind, document: &Document) -> Result<String, Text>;
}

/// The format of a file to write, by its name: `QGC WPL 110` with one list, unless the extension says otherwise.
pub(crate) fn format_of(file: &str, kind: ListKind) -> FileFormat {
    let ending = file.rsplit_once('.').map_or("", |(_, ending)| ending);
    match FileFormat::of_ending(ending) {
        None | Some(FileFormat::Wpl(_)) => FileFormat::Wpl(kind),
        Some(other) => other,
    }
}
