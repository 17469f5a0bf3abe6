//! Export and import of a profile, to move it to another machine.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use rusqlite::{TransactionBehavior, params};
use serde::{Deserialize, Serialize};

use super::flights::RunRow;
use super::{Profile, ProfileError, ProfileSettings, Profiles, checked_name, json};
use crate::campaign::{CareerEntry, ExamKey};
use crate::notice::sanitised;
use crate::scoring::Report;
use crate::store::runs::is_moment;

mod claim;

const SCHEMA: u32 = 1;
/// The maximum size of a profile file, in bytes.
const LARGEST: u64 = 256 * 1024 * 1024;
/// The maximum length of an id or a name in a profile file, in bytes.
const LONGEST_LINE: usize = 200;

/// A profile with all its data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProfileFile {
    /// The version of the format.
    sortie_profile: u32,
    /// The profile's name when it was exported.
    pub name: String,
    since: String,
    settings: ProfileSettings,
    entries: Vec<EntryDocument>,
    runs: Vec<RunDocument>,
    designs: Vec<DesignDocument>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct EntryDocument {
    id: String,
    at: String,
    entry: CareerEntry,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct RunDocument {
    id: String,
    ended: String,
    airframes: Vec<String>,
    recording: Option<String>,
    report: Report,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct DesignDocument {
    name: String,
    design: String,
}

impl ProfileFile {
    /// Reads the file of an exported profile.
    ///
    /// # Errors
    /// The file cannot be read, or is not a profile; the error names the file.
    pub fn open(path: &Path) -> Result<Self, ProfileError> {
        let shown = path.display();
        let mut text = String::new();
        let read = File::open(path).and_then(|file| file.take(LARGEST).read_to_string(&mut text));
        read.map_err(|error| ProfileError::NoProfile {
            fault: format!("{shown}: {error}"),
        })?;
        Self::read(&text).map_err(|error| match error {
            ProfileError::NoProfile { fault } => ProfileError::NoProfile {
                fault: format!("{shown}: {fault}"),
            },
            other @ (ProfileError::Unusable { .. }
            | ProfileError::Unreadable { .. }
            | ProfileError::Forbidden { .. }
            | ProfileError::ReadOnly { .. }
            | ProfileError::Newer { .. }
            | ProfileError::Older { .. }
            | ProfileError::LogAlone { .. }
            | ProfileError::Database { .. }
            | ProfileError::Damaged { .. }
            | ProfileError::Unknown { .. }
            | ProfileError::Exists { .. }
            | ProfileError::Name
            | ProfileError::Refused(_)) => other,
        })
    }

    /// Reads an exported profile.
    ///
    /// # Errors
    /// The text is not a profile, has an unknown version, or contains impossible entries.
    pub fn read(source: &str) -> Result<Self, ProfileError> {
        let fault = |fault: String| ProfileError::NoProfile { fault };
        let file: Self =
            serde_json::from_str(source).map_err(|error| fault(sanitised(&error.to_string())))?;
        if file.sortie_profile != SCHEMA {
            let found = file.sortie_profile;
            return Err(fault(format!(
                "sortie_profile {found}, this program reads {SCHEMA}"
            )));
        }
        match file.fault() {
            Some(found) => Err(fault(found)),
            None => Ok(file),
        }
    }

    /// The first impossible entry, in English; `None` if there is none. The file is untrusted.
    fn fault(&self) -> Option<String> {
        let since = || faulty_moment("since", &self.since);
        let entries = || {
            self.entries.iter().find_map(|row| {
                let fault = faulty_line("id", &row.id)
                    .or_else(|| faulty_moment("at", &row.at))
                    .or_else(|| row.entry.fault());
                fault.map(|fault| format!("entry {:?}: {fault}", row.id))
            })
        };
        let runs = || {
            self.runs.iter().find_map(|run| {
                let recording = run.recording.iter();
                let fault = faulty_moment("ended", &run.ended)
                    .or_else(|| recording.into_iter().find_map(|it| faulty_file(it)));
                fault.map(|fault| format!("run {:?}: {fault}", run.id))
            })
        };
        let mut designs = self.designs.iter();
        since()
            .or_else(entries)
            .or_else(runs)
            .or_else(|| designs.find_map(|row| faulty_line("design", &row.name)))
    }

    /// The key of the trainee's exams, which makes them differ from other trainees' exams.
    fn exam_key(&self) -> ExamKey {
        self.settings.exam_key(&self.name, &self.since)
    }

    pub fn write(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

impl Profiles {
    /// Exports a profile with all its data.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn export(&self, profile: &Profile) -> Result<ProfileFile, ProfileError> {
        Ok(ProfileFile {
            sortie_profile: SCHEMA,
            name: profile.name.clone(),
            since: profile.since.clone(),
            settings: profile.settings.clone(),
            entries: self.entry_rows(profile)?,
            runs: self.run_rows(profile)?,
            designs: self.design_rows(profile)?,
        })
    }

    fn entry_rows(&self, profile: &Profile) -> Result<Vec<EntryDocument>, ProfileError> {
        let sql = "SELECT id, at, entry FROM entries WHERE profile = ?1 ORDER BY number";
        let mut query = self.ask(sql)?;
        let rows = query
            .query_map([profile.key], |row| {
                Ok((row.get(0)?, row.get(1)?, row.get::<_, String>(2)?))
            })
            .and_then(Iterator::collect::<Result<Vec<_>, _>>)
            .map_err(|error| self.fault(error))?;
        rows.into_iter()
            .map(|(id, at, entry)| {
                let entry = self.read(&entry)?;
                Ok(EntryDocument { id, at, entry })
            })
            .collect()
    }

    fn run_rows(&self, profile: &Profile) -> Result<Vec<RunDocument>, ProfileError> {
        let sql = "SELECT id, runs.ended, airframes, recording, report
             FROM runs JOIN entries USING (profile, id) WHERE profile = ?1 ORDER BY number";
        let mut query = self.ask(sql)?;
        let rows = query
            .query_map([profile.key], |row| {
                let (airframes, report) = (row.get::<_, String>(2)?, row.get::<_, String>(4)?);
                Ok((row.get(0)?, row.get(1)?, airframes, row.get(3)?, report))
            })
            .and_then(Iterator::collect::<Result<Vec<_>, _>>)
            .map_err(|error| self.fault(error))?;
        rows.into_iter()
            .map(|(id, ended, airframes, recording, report)| {
                Ok(RunDocument {
                    id,
                    ended,
                    airframes: self.read(&airframes)?,
                    recording,
                    report: self.read(&report)?,
                })
            })
            .collect()
    }

    fn design_rows(&self, profile: &Profile) -> Result<Vec<DesignDocument>, ProfileError> {
        let sql = "SELECT name, design FROM designs WHERE profile = ?1 ORDER BY name";
        let mut query = self.ask(sql)?;
        query
            .query_map([profile.key], |row| {
                Ok(DesignDocument {
                    name: row.get(0)?,
                    design: row.get(1)?,
                })
            })
            .and_then(Iterator::collect)
            .map_err(|error| self.fault(error))
    }

    /// Imports a profile completely or not at all, under a free name.
    ///
    /// # Errors
    /// The name is taken or not valid; the database cannot be written.
    pub fn import(&mut self, file: &ProfileFile, name: &str) -> Result<Profile, ProfileError> {
        let name = checked_name(name)?;
        if self
            .list()?
            .iter()
            .any(|profile| profile.name.eq_ignore_ascii_case(name))
        {
            return Err(ProfileError::Exists {
                name: name.to_owned(),
            });
        }
        let path = self.path.clone();
        let taken = import(&mut self.connection, file, name);
        taken.map_err(|error| ProfileError::Database { path, error })?;
        self.find(name)
    }
}

fn import(
    connection: &mut rusqlite::Connection,
    file: &ProfileFile,
    name: &str,
) -> rusqlite::Result<()> {
    let settings = ProfileSettings {
        // Even under another name, exams that were taken have to keep their seeds.
        exams: Some(file.exam_key()),
        ..file.settings.clone()
    };
    let transaction = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
    transaction.execute(
        "INSERT INTO profiles (name, since, settings) VALUES (?1, ?2, ?3)",
        params![name, file.since, json(&settings)],
    )?;
    let key = transaction.last_insert_rowid();
    for row in &file.entries {
        transaction.execute(
            "INSERT INTO entries (profile, id, at, entry) VALUES (?1, ?2, ?3, ?4)",
            params![key, row.id, row.at, json(&row.entry)],
        )?;
    }
    for run in &file.runs {
        let row = RunRow {
            id: &run.id,
            ended: &run.ended,
            airframes: &run.airframes,
            recording: run.recording.as_deref(),
            report: &run.report,
        };
        row.insert(&transaction, key)?;
    }
    for row in &file.designs {
        transaction.execute(
            "INSERT INTO designs (profile, name, design) VALUES (?1, ?2, ?3)",
            params![key, row.name, row.design],
        )?;
    }
    transaction.commit()
}

fn faulty_moment(name: &str, text: &str) -> Option<String> {
    (!is_moment(text)).then(|| format!("`{name}` is not a time such as 2026-11-20T14:03:22Z"))
}

fn faulty_line(name: &str, text: &str) -> Option<String> {
    let is_line = (1..=LONGEST_LINE).contains(&text.len()) && !text.chars().any(char::is_control);
    (!is_line).then(|| format!("`{name}` is not one line of 1 to {LONGEST_LINE} bytes"))
}

fn faulty_file(name: &str) -> Option<String> {
    let is_path = name.contains('/');
    faulty_line("recording", name)
        .or_else(|| is_path.then(|| "`recording` is not a file name".to_owned()))
}
