//! The grades of a class: a file beside the record for each grader and rubric.

use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{ClassRecords, KeptRecord, names_in, safe};
use crate::grading::{FlightChoice, GradeSheet, GradedFlight, RecordBookmark, Rubric};
use crate::moment::Moment;
use crate::record::MissionClock;
use crate::store::class_results::{RescoredFlight, rescored};
use crate::store::{StoreError, sharing};
use crate::text;
use crate::text::Text;

/// What stands between the name of the record and those of rubric and grader.
const GRADES: &str = ".grades.";
const ENDING: &str = ".toml";

/// A grader's sheet for a flight.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptSheet {
    /// The trainee's user name.
    pub user: String,
    /// The name of the trainee's profile, if there was one.
    pub profile: Option<String>,
    /// The name of the record.
    pub record: String,
    pub sheet: GradeSheet,
}

impl ClassRecords {
    /// A flight with the grades that a grader has given it so far; flights and grades that cannot be read are passed
    /// over.
    ///
    /// # Errors
    /// A text if there is no such flight, or why none can be read.
    pub fn graded(
        &self,
        user: &str,
        choice: &FlightChoice,
        rubric: &Arc<Rubric>,
        grader: &str,
    ) -> Result<GradedFlight, Text> {
        let records = self.of(user);
        let flights = records.len();
        let mut skipped = Vec::new();
        for (at, kept) in chosen(&records, choice) {
            match self.graded_record(kept, rubric, grader) {
                Ok(flight) => {
                    return Ok(GradedFlight {
                        number: at + 1,
                        flights,
                        skipped,
                        ..flight
                    });
                }
                Err(fault) => skipped.push(fault),
            }
        }
        Err(match (skipped.into_iter().next(), choice) {
            (Some(fault), _) => fault,
            (None, FlightChoice::Newest) => text!("grading-no-record", user = user),
            (None, FlightChoice::Older(_)) => text!("grading-oldest"),
            (None, FlightChoice::Newer(_)) => text!("grading-newest"),
        })
    }

    fn graded_record(
        &self,
        kept: &KeptRecord,
        rubric: &Arc<Rubric>,
        grader: &str,
    ) -> Result<GradedFlight, Text> {
        let RescoredFlight { stored, report, .. } = rescored(kept)?;
        let elements = rubric.elements();
        let evidence = elements.map(|element| {
            let kinds = element.evidence.iter();
            kinds.filter_map(|kind| kind.of(&report)).collect()
        });
        let record = &kept.files.stem;
        let path = self.sheet_path(&kept.user, record, &rubric.name, grader);
        let sheet = read_sheet(&path)?.unwrap_or_else(|| GradeSheet::new(rubric, grader));
        if sheet.rubric != rubric.name || sheet.grader != grader {
            return Err(unreadable(&path, &text!("grading-foreign")));
        }
        Ok(GradedFlight {
            user: kept.user.clone(),
            profile: stored.head.profile.clone(),
            record: record.clone(),
            title: report.title.clone(),
            when: stored.head.when.clone(),
            score: report.score,
            number: 1,
            flights: 1,
            evidence: evidence.collect(),
            bookmarks: bookmarks(kept),
            sheet,
            rubric: Arc::clone(rubric),
            skipped: Vec::new(),
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
            let outline = kept.files.run_outline();
            let profile = outline.and_then(|(head, _)| head.profile);
            let folder = self.folder.join(safe(&kept.user));
            let prefix = format!("{}{GRADES}", kept.files.stem);
            let mut names = names_in(&folder);
            names.retain(|name| name.starts_with(&prefix) && name.ends_with(ENDING));
            names.sort();
            for name in names {
                match read_sheet(&folder.join(name)) {
                    Ok(Some(sheet)) => sheets.push(KeptSheet {
                        user: kept.user.clone(),
                        profile: profile.clone(),
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
        // Points separate the parts of the name.
        let [rubric, grader] = [rubric, grader].map(|it| it.replace('.', "_"));
        let name = format!("{record}{GRADES}{rubric}.{grader}{ENDING}");
        self.folder.join(safe(user)).join(safe(&name))
    }
}

/// The flights to be tried, the nearest to the chosen one first, with their positions. Records have the names of their
/// times.
fn chosen<'a>(records: &'a [KeptRecord], choice: &FlightChoice) -> Vec<(usize, &'a KeptRecord)> {
    let all = records.iter().enumerate();
    match choice {
        FlightChoice::Newest => all.rev().collect(),
        FlightChoice::Older(than) => all.filter(|(_, it)| it.files.stem < *than).rev().collect(),
        FlightChoice::Newer(than) => all.filter(|(_, it)| it.files.stem > *than).collect(),
    }
}

/// The sheet in a file; `None` if there is no such file.
fn read_sheet(path: &Path) -> Result<Option<GradeSheet>, Text> {
    let text = match fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(unreadable(path, &Text::verbatim(error.to_string()))),
    };
    let sheet = toml::from_str(&text);
    let sheet = sheet
        .map_err(|error: toml::de::Error| unreadable(path, &Text::verbatim(error.message())))?;
    Ok(Some(sheet))
}

fn unreadable(path: &Path, fault: &Text) -> Text {
    let path = path.display().to_string();
    text!("grading-unreadable", path = path, fault = fault.clone())
}

/// The bookmarks in the journal of a record; none without a journal that can be read.
fn bookmarks(kept: &KeptRecord) -> Vec<RecordBookmark> {
    let Some(journal) = kept.files.read_journal().ok().flatten() else {
        return Vec::new();
    };
    let clock = MissionClock::of(&journal);
    let bookmark = |moment: Moment| RecordBookmark {
        recorded: moment.at,
        at: clock.mission_time(moment.at).unwrap_or_default(),
        text: moment.text.to_string(),
    };
    journal.bookmarks().map(bookmark).collect()
}
