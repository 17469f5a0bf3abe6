//! Profiles: the trainees, their flights, purchases and designs, in one `SQLite` file. Anyone who
//! can read its folder can read it.
//!
//! A career is an append-only history ([`crate::campaign`]); this file stores it with the full
//! report of each run. Every change is one transaction with a write-ahead log, so a killed program
//! loses nothing that it has reported as stored, and several consoles may write at the same time. A
//! run with the same id is stored only once.

mod error;
mod flights;
mod mend;
mod opening;
mod possessions;
mod rescue;
mod schema;
#[cfg(test)]
mod tests;
mod transfer;

use std::path::{Path, PathBuf};
use std::time::Duration;

use rusqlite::{Connection, OptionalExtension as _, Transaction, TransactionBehavior, params};
use serde::{Deserialize, Serialize};

use crate::campaign::{Aids, ExamKey};
use crate::notice::sanitised;

pub use error::ProfileError;
pub use flights::{PastRun, RunEntry};
pub use mend::MendedRows;
use opening::private;
pub use rescue::Rescue;
pub use transfer::ProfileFile;

const FILE: &str = "profiles.sqlite";
/// How long a console waits while another one writes.
const PATIENCE: Duration = Duration::from_secs(5);
/// The maximum length of a profile's name, in characters.
const LONGEST_NAME: usize = 40;

/// The profiles of a data folder.
#[derive(Debug)]
pub struct Profiles {
    connection: Connection,
    path: PathBuf,
    is_read_only: bool,
}

/// A profile: the career of one trainee.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Profile {
    key: i64,
    /// The name; case does not matter.
    pub name: String,
    /// The creation time in UTC: `2026-11-20T14:03:22Z`.
    pub since: String,
    pub settings: ProfileSettings,
}

/// Settings of a trainee.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct ProfileSettings {
    /// The language of the screens, if one was chosen: `en` or `uk`.
    pub lang: Option<String>,
    pub aids: Aids,
    /// The key that the profile's exams had under the name with which it was created.
    pub exams: Option<ExamKey>,
}

impl ProfileSettings {
    /// The exam key of a profile with this name and creation time.
    fn exam_key(&self, name: &str, since: &str) -> ExamKey {
        self.exams.unwrap_or_else(|| ExamKey::of(name, since))
    }
}

impl Profile {
    /// The key of the trainee's exams, which makes them differ from other trainees' exams.
    pub fn exam_key(&self) -> ExamKey {
        self.settings.exam_key(&self.name, &self.since)
    }
}

impl Profiles {
    /// Whether the profiles were opened read-only.
    pub fn is_read_only(&self) -> bool {
        self.is_read_only
    }

    /// Checks that changes can be stored.
    ///
    /// # Errors
    /// The profiles were opened read-only.
    pub fn require_writable(&self) -> Result<(), ProfileError> {
        if self.is_read_only {
            let path = self.path.clone();
            return Err(ProfileError::ReadOnly { path });
        }
        Ok(())
    }

    /// Restores damaged rows from the copies that contain them.
    ///
    /// # Errors
    /// The database cannot be read or written.
    pub fn mend(&mut self) -> Result<MendedRows, ProfileError> {
        mend::mend_rows(&mut self.connection, &self.path).map_err(|error| self.fault(error))
    }

    /// A number that changes whenever another program has written to the database.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn changes_elsewhere(&self) -> Result<i64, ProfileError> {
        let version = self
            .connection
            .query_row("PRAGMA data_version", [], |row| row.get(0));
        version.map_err(|error| self.fault(error))
    }

    /// All profiles, by name.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn list(&self) -> Result<Vec<Profile>, ProfileError> {
        let mut query =
            self.ask("SELECT key, name, since, settings FROM profiles ORDER BY name")?;
        let rows = query.query_map([], profile).and_then(Iterator::collect);
        rows.map_err(|error| self.fault(error))
    }

    /// A profile by name.
    ///
    /// # Errors
    /// No profile has this name (the error lists the names), or the database cannot be read.
    pub fn find(&self, name: &str) -> Result<Profile, ProfileError> {
        let mut query =
            self.ask("SELECT key, name, since, settings FROM profiles WHERE name = ?1")?;
        let found = query.query_row([name], profile).optional();
        if let Some(profile) = found.map_err(|error| self.fault(error))? {
            return Ok(profile);
        }
        Err(ProfileError::Unknown {
            name: name.to_owned(),
            known: self
                .list()?
                .into_iter()
                .map(|profile| profile.name)
                .collect(),
        })
    }

    /// Creates a profile.
    ///
    /// # Errors
    /// The name is taken or not valid, or the database cannot be written.
    pub fn create(&self, name: &str, when: &str) -> Result<Profile, ProfileError> {
        let name = checked_name(name)?;
        let settings = ProfileSettings {
            exams: Some(ExamKey::of(name, when)),
            ..ProfileSettings::default()
        };
        let added = self.connection.execute(
            "INSERT INTO profiles (name, since, settings) VALUES (?1, ?2, ?3) ON CONFLICT DO NOTHING",
            params![name, when, json(&settings)],
        );
        match added.map_err(|error| self.fault(error))? {
            0 => Err(ProfileError::Exists {
                name: name.to_owned(),
            }),
            _ => self.find(name),
        }
    }

    /// Removes a profile with all its data.
    ///
    /// # Errors
    /// The database cannot be written.
    pub fn delete(&self, profile: &Profile) -> Result<(), ProfileError> {
        let removed = self
            .connection
            .execute("DELETE FROM profiles WHERE key = ?1", [profile.key]);
        removed.map(drop).map_err(|error| self.fault(error))
    }

    /// Stores the settings of a trainee.
    ///
    /// # Errors
    /// The database cannot be written.
    pub fn set_settings(
        &self,
        profile: &Profile,
        settings: &ProfileSettings,
    ) -> Result<(), ProfileError> {
        let changed = self.connection.execute(
            "UPDATE profiles SET settings = ?2 WHERE key = ?1",
            params![profile.key, json(settings)],
        );
        changed.map(drop).map_err(|error| self.fault(error))
    }

    /// Makes a backup copy.
    ///
    /// # Errors
    /// The copy cannot be written; the last copy stays.
    pub fn back_up(&self) -> Result<(), ProfileError> {
        rescue::back_up(&self.connection, &self.path).map_err(|error| self.fault(error))
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    fn ask(&self, sql: &str) -> Result<rusqlite::Statement<'_>, ProfileError> {
        self.connection
            .prepare(sql)
            .map_err(|error| self.fault(error))
    }

    /// Begins a transaction: everything up to its commit is stored, or nothing; other consoles
    /// wait.
    fn transaction(&self) -> Result<Transaction<'_>, ProfileError> {
        Transaction::new_unchecked(&self.connection, TransactionBehavior::Immediate)
            .map_err(|error| self.fault(error))
    }

    fn fault(&self, error: rusqlite::Error) -> ProfileError {
        let path = self.path.clone();
        match error {
            rusqlite::Error::Utf8Error(_, error) => ProfileError::Damaged {
                path,
                fault: error.to_string(),
            },
            error => ProfileError::Database { path, error },
        }
    }

    /// Parses stored JSON, which this or an older version wrote; anything else is damage.
    fn read<T: serde::de::DeserializeOwned>(&self, json: &str) -> Result<T, ProfileError> {
        serde_json::from_str(json).map_err(|error| ProfileError::Damaged {
            path: self.path.clone(),
            // The message quotes the content, which may contain control characters.
            fault: sanitised(&error.to_string()),
        })
    }
}

/// A profile's name without surrounding spaces, if its length and characters are allowed.
fn checked_name(name: &str) -> Result<&str, ProfileError> {
    let name = name.trim();
    let is_fine =
        (1..=LONGEST_NAME).contains(&name.chars().count()) && !name.chars().any(char::is_control);
    is_fine.then_some(name).ok_or(ProfileError::Name)
}

fn profile(row: &rusqlite::Row<'_>) -> rusqlite::Result<Profile> {
    Ok(Profile {
        key: row.get(0)?,
        name: sanitised(&row.get::<_, String>(1)?),
        since: sanitised(&row.get::<_, String>(2)?),
        // Unknown settings, from a newer version or edited by hand, must not make the profile
        // unreadable.
        settings: serde_json::from_str(&row.get::<_, String>(3)?).unwrap_or_default(),
    })
}

/// The JSON of a plain structure, which can always be serialised.
fn json<T: serde::Serialize>(value: &T) -> String {
    serde_json::to_string(value).unwrap_or_default()
}
