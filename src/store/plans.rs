//! Files of plans, fences and rally points.

use std::path::Path;

use super::regular::read_regular;
use super::{StoreError, user_path, write};
use crate::plan::{Document, ListKind, ReadOptions};
use crate::session::{PlanShelf, format_of};
use crate::text;
use crate::text::Text;

/// The maximum size of a file, in bytes: a plan of all items that a vehicle can carry is a hundredth of it.
const LONGEST: u64 = 16 * 1024 * 1024;

/// The files of plans on this machine; names are relative to the working directory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlanFiles;

impl PlanShelf for PlanFiles {
    fn read(&self, file: &str) -> Result<Document, Text> {
        let path = user_path(file);
        let bytes = read_regular(&path, LONGEST).map_err(|error| {
            let error = error.to_string();
            text!("refused-plan-unreadable", file = file, error = error)
        })?;
        crate::plan::read(&bytes, &ReadOptions::default())
            .map(|loaded| loaded.document)
            .map_err(|(text, faults)| {
                let at = faults.first().map_or(0, |fault| fault.span.start);
                let before = text.get(..at).unwrap_or_default();
                let line = before.matches('\n').count() + 1;
                let column = before.chars().rev().take_while(|it| *it != '\n').count() + 1;
                text!(
                    "refused-plan-file",
                    file = file,
                    line = line,
                    column = column
                )
            })
    }

    fn write(&self, file: &str, kind: ListKind, document: &Document) -> Result<String, Text> {
        let path = user_path(file);
        let text = crate::plan::write(document, format_of(file, kind))
            .map_err(|_| text!("refused-plan-format", file = file))?;
        save(&path, &text)?;
        Ok(path.display().to_string())
    }
}

fn save(path: &Path, text: &str) -> Result<(), Text> {
    write(path, text, false).map_err(|error| match error {
        StoreError::Exists { .. } => {
            text!("refused-plan-exists", file = path.display().to_string())
        }
        other => Text::from(&other),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: &str = "QGC WPL 110\n\
        0\t1\t0\t16\t0\t0\t0\t0\t50.4501\t30.5234\t170\t1\n\
        1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t20\t1\n";

    #[test]
    fn a_file_is_read_and_a_new_one_written_and_none_is_replaced() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name).display().to_string();
        std::fs::write(path("a.waypoints"), PLAN).expect("written");
        let document = PlanFiles.read(&path("a.waypoints")).expect("valid");
        assert_eq!(document.plan.len(), 1);
        for name in ["b.waypoints", "b.plan", "b.kml", "b.geojson", "b"] {
            let written = PlanFiles.write(&path(name), ListKind::Plan, &document);
            let again = PlanFiles.read(&written.expect("written"));
            assert_eq!(again.expect("valid").plan.len(), 1, "{name}");
            let taken = PlanFiles.write(&path(name), ListKind::Plan, &document);
            assert!(taken.is_err(), "{name}");
        }
    }

    #[test]
    fn faults_have_their_place() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("bad.waypoints");
        std::fs::write(&file, format!("{PLAN}2\t0\tx\n")).expect("written");
        let fault = PlanFiles.read(&file.display().to_string());
        let text = fault.expect_err("a fault").to_string();
        assert!(text.contains('4'), "{text}");
        assert!(PlanFiles.read("/nowhere/at/all").is_err());
    }
}
