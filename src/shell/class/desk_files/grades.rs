//! Grades that still have to be written: none are lost while a disk is full.

use std::collections::BTreeMap;

use crate::grading::{GradeSheet, GradedFlight};
use crate::store::ClassRecords;
use crate::text::Text;

/// Which sheet is meant: those of several rubrics stand beside each other.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct SheetKey {
    user: String,
    record: String,
    rubric: String,
}

/// The newest sheet of each flight that is not written yet.
#[derive(Debug, Default)]
pub(super) struct UnwrittenGrades {
    sheets: BTreeMap<SheetKey, GradeSheet>,
    /// Whether the instructor was told that some wait.
    is_told: bool,
}

/// What is to be told after grades were written, or not.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct GradesOutcome {
    /// How many sheets still wait.
    pub count: usize,
    /// Why; `None` if none do any more.
    pub fault: Option<Text>,
}

impl UnwrittenGrades {
    /// Adds a sheet, in place of an older one of the same flight.
    pub fn put(&mut self, user: String, record: String, sheet: GradeSheet) {
        let rubric = sheet.rubric.clone();
        let key = SheetKey {
            user,
            record,
            rubric,
        };
        self.sheets.insert(key, sheet);
    }

    /// The sheet of a flight that is not written yet.
    pub fn of(&self, flight: &GradedFlight) -> Option<&GradeSheet> {
        self.sheets.get(&SheetKey {
            user: flight.user.clone(),
            record: flight.record.clone(),
            rubric: flight.sheet.rubric.clone(),
        })
    }

    /// Writes as many as possible. Returns what is to be told, if something went wrong or is well again.
    pub fn write(&mut self, shelf: &ClassRecords) -> Option<GradesOutcome> {
        let mut fault = None;
        self.sheets.retain(|key, sheet| {
            let kept = shelf.keep_sheet(&key.user, &key.record, sheet);
            let is_left = kept.is_err();
            fault = kept.err().map(|error| Text::from(&error)).or(fault.take());
            is_left
        });
        let count = self.sheets.len();
        let was_told = std::mem::replace(&mut self.is_told, count > 0);
        (count > 0 || was_told).then_some(GradesOutcome { count, fault })
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::sync::Arc;

    use super::*;
    use crate::store;

    #[test]
    fn grades_wait_while_they_cannot_be_written() {
        let data = tempfile::tempdir().expect("a folder");
        let shelf = ClassRecords::within(data.path(), "9-A");
        let rubric = Arc::new(store::rubric("notechs").expect("it is built in"));
        let sheet = GradeSheet::new(&rubric, "petro");
        let mut grades = UnwrittenGrades::default();
        grades.put("anna".to_owned(), "one".to_owned(), sheet.clone());
        // The folder of the trainee is a file.
        fs::create_dir_all(shelf.folder()).expect("it is writable");
        fs::write(shelf.folder().join("anna"), "").expect("it is writable");
        let outcome = grades.write(&shelf).expect("it fails");
        assert_eq!(outcome.count, 1);
        assert!(outcome.fault.is_some());
        // A newer sheet takes its place.
        grades.put("anna".to_owned(), "one".to_owned(), sheet);
        fs::remove_file(shelf.folder().join("anna")).expect("it is there");
        fs::create_dir(shelf.folder().join("anna")).expect("it is writable");
        let outcome = grades.write(&shelf).expect("it is well again");
        assert_eq!(
            outcome,
            GradesOutcome {
                count: 0,
                fault: None
            }
        );
        assert_eq!(grades.write(&shelf), None);
    }
}
