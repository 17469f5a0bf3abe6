//! The grades of a class: a file beside the record for each grader and rubric.

use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{ClassRecords, KeptRecord, names_in, safe};
use crate::comparison::FlightBookmark;
use crate::grading::{GradeSheet, GradedFlight, Rubric};
use crate::record::MissionClock;
use crate::store::class_results::{RescoredFlight, rescored};
use crate::store::{StoreError, sharing};
use crate::text;
use crate::text::Text;

/// What stands between the name of the record and those of rubric and grader.
const GRADES: &str = ".grades.";

/// A grader's sheet for a flight.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptSheet {
    /// The trainee's user name.
    pub user: String,
    /// The name of the record.
    pub record: String,
    pub sheet: GradeSheet,
}

impl ClassRecords {
    /// A flight with the grades that a grader has given it so far. `back` counts flights from the trainee's newest one,
    /// which is 0.
    ///
    /// # Errors
    /// A text if the trainee has handed in no flight, or the record or the grades cannot be read.
    pub fn graded(
        &self,
        user: &str,
        back: usize,
        rubric: &Arc<Rubric>,
        grader: &str,
    ) -> Result<GradedFlight, Text> {
        let records = self.of(user);
        let at = records.len().checked_sub(back + 1);
        let Some((at, kept)) = at.and_then(|at| Some((at, records.get(at)?))) else {
            return Err(text!("grading-no-record", user = user));
        };
        let RescoredFlight { stored, report, .. } = rescored(kept)?;
        let elements = rubric.elements();
        let evidence = elements.map(|element| {
            let kinds = element.evidence.iter();
            kinds.filter_map(|kind| kind.of(&report)).collect()
        });
        let sheet = read_sheet(&self.sheet_path(user, &kept.files.stem, &rubric.name, grader))?;
        Ok(GradedFlight {
            user: user.to_owned(),
            record: kept.files.stem.clone(),
            title: report.title.clone(),
            when: stored.head.when.clone(),
            score: report.score,
            number: at + 1,
            flights: records.len(),
            evidence: evidence.collect(),
            bookmarks: bookmarks(kept),
            sheet: sheet.unwrap_or_else(|| GradeSheet::new(rubric, grader)),
            rubric: Arc::clone(rubric),
        })
    }

    /// Keeps the grades of a flight, in the place of those that the grader gave it before.
    ///
    /// # Errors
    /// The file cannot be written; the grades from before remain.
    pub fn keep_sheet(
        &self,
        user: &str,
        record: &str,
        sheet: &GradeSheet,
    ) -> Result<(), StoreError> {
        let path = self.sheet_path(user, record, &sheet.rubric, &sheet.grader);
        let unwritable = |error: io::Error| StoreError::Unwritable {
            path: path.clone(),
            error,
        };
        let text = toml::to_string_pretty(sheet)
            .map_err(|error| unwritable(io::Error::other(error.to_string())))?;
        let beside = path.with_extension("new");
        sharing::open(
            OpenOptions::new().create(true).write(true).truncate(true),
            &beside,
        )
        .and_then(|mut file| {
            file.write_all(text.as_bytes())?;
            file.sync_all()
        })
        .and_then(|()| fs::rename(&beside, &path))
        .map_err(unwritable)
    }

    /// All sheets of the class: by trainee and record, and why others cannot be read.
    pub fn sheets(&self) -> (Vec<KeptSheet>, Vec<Text>) {
        let (mut sheets, mut faults) = (Vec::new(), Vec::new());
        for kept in self.all() {
            let folder = self.folder.join(safe(&kept.user));
            let prefix = format!("{}{GRADES}", kept.files.stem);
            let mut names = names_in(&folder);
            names.retain(|name| name.starts_with(&prefix) && name.ends_with(".toml"));
            names.sort();
            for name in names {
                match read_sheet(&folder.join(name)) {
                    Ok(Some(sheet)) => sheets.push(KeptSheet {
                        user: kept.user.clone(),
                        record: kept.files.stem.clone(),
                        sheet,
                    }),
                    Ok(None) => {}
                    Err(fault) => faults.push(fault),
                }
            }
        }
        (sheets, faults)
    }

    fn sheet_path(&self, user: &str, record: &str, rubric: &str, grader: &str) -> PathBuf {
        let name = format!("{record}{GRADES}{rubric}.{grader}.toml");
        self.folder.join(safe(user)).join(safe(&name))
    }
}

/// The sheet in a file; `None` if there is no such file.
fn read_sheet(path: &Path) -> Result<Option<GradeSheet>, Text> {
    let text = match fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(unreadable(path, &error.to_string())),
    };
    let sheet = toml::from_str(&text);
    let sheet = sheet.map_err(|error: toml::de::Error| unreadable(path, error.message()))?;
    Ok(Some(sheet))
}

fn unreadable(path: &Path, fault: &str) -> Text {
    let path = path.display().to_string();
    text!("grading-unreadable", path = path, fault = fault)
}

/// The bookmarks in the journal of a record; none without a journal that can be read.
fn bookmarks(kept: &KeptRecord) -> Vec<FlightBookmark> {
    let journal = kept.files.read_journal().ok().flatten();
    journal.map_or_else(Vec::new, |journal| {
        let recorded: Vec<_> = journal.bookmarks().collect();
        FlightBookmark::of_moments(&recorded, &MissionClock::of(&journal))
    })
}
