//! The interface through which a session accesses plan files.

use std::fmt::Debug;

use crate::commands::protected_item;
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

/// The files of a flight that counts: no plan with items that move home or switch the fence.
#[derive(Debug)]
pub struct GuardedShelf<S>(pub S);

impl<S: PlanShelf> PlanShelf for GuardedShelf<S> {
    fn read(&self, file: &str) -> Result<Document, Text> {
        let document = self.0.read(file)?;
        match protected_item(&document) {
            None => Ok(document),
            Some(item) => Err(item.refusal()),
        }
    }

    fn write(&self, file: &str, kind: ListKind, document: &Document) -> Result<String, Text> {
        self.0.write(file, kind, document)
    }
}

/// The format of a file to write, by its name: `QGC WPL 110` with one list, unless the extension says otherwise.
pub(crate) fn format_of(file: &str, kind: ListKind) -> FileFormat {
    let ending = file.rsplit_once('.').map_or("", |(_, ending)| ending);
    match FileFormat::of_ending(ending) {
        None | Some(FileFormat::Wpl(_)) => FileFormat::Wpl(kind),
        Some(other) => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Files with one item each, by its command.
    #[derive(Debug)]
    struct OneItem;

    impl PlanShelf for OneItem {
        fn read(&self, file: &str) -> Result<Document, Text> {
            let mut numbers = file.split(' ');
            let mut number = || numbers.next().and_then(|it| it.parse().ok()).unwrap_or(0);
            let (waypoint, last) = (item(command::WAYPOINT, 0), item(number(), number()));
            Ok(Document {
                plan: vec![waypoint, last],
                ..Document::default()
            })
        }

        fn write(&self, file: &str, _: ListKind, _: &Document) -> Result<String, Text> {
            Ok(file.to_owned())
        }
    }

    fn item(command: u16, first: u16) -> Item {
        Item {
            command,
            frame: 3,
            auto_continue: true,
            params: [f32::from(first), 0.0, 0.0, 0.0],
            x: 0,
            y: 0,
            z: 20.0,
        }
    }

    #[test]
    fn a_plan_that_changes_home_or_the_fence_is_refused_with_the_item() {
        let shelf = GuardedShelf(OneItem);
        for (file, name) in [
            ("179 1", "DO_SET_HOME"),
            ("207 0", "DO_FENCE_ENABLE"),
            ("218 11", "DO_AUX_FUNCTION"),
        ] {
            let said = shelf.read(file).expect_err(file).to_string();
            assert!(said.contains("item 2") && said.contains(name), "{said}");
            OneItem.read(file).expect("in practice");
        }
        for file in ["16 0", "178 1", "218 9", "20 0"] {
            shelf.read(file).expect(file);
        }
    }
}
