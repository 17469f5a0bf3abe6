//! Profiles: who trains here, what they flew, bought and designed, in one `SQLite` file for their eyes only.
//!
//! A career is a history that only grows ([`crate::campaign`]); this file keeps it, and a run's whole report with it. Every
//! change is one transaction, written ahead to a log, so that a killed program loses nothing that it has reported as stored,
//! and several consoles may write at the same time. A run's id makes it count once, however often it is handed in.

mod rescue;
mod schema;
#[cfg(test)]
mod tests;
mod transfer;

use std::fs::OpenOptions;
use std::io;
use std::os::unix::fs::{DirBuilderExt as _, OpenOptionsExt as _};
use std::path::{Path, PathBuf};
use std::time::Duration;

use rusqlite::{Connection, OptionalExtension as _, TransactionBehavior, params};

use crate::campaign::{Course, Entry, Flight, Purchase, Refusal, Standing};
use crate::scoring::Report;
use crate::text;
use crate::text::Text;
use crate::workshop::Design;

pub use rescue::Rescue;
pub use transfer::ProfileFile;

/// The file in the program's folder for data.
const FILE: &str = "profiles.sqlite";
/// How long one console waits for another's write.
const PATIENCE: Duration = Duration::from_secs(5);
/// Letters of a profile's name.
const LONGEST_NAME: usize = 40;

/// The profiles of a data folder.
#[derive(Debug)]
pub struct Profiles {
    connection: Connection,
    path: PathBuf,
}

/// Somebody who trains here.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Profile {
    key: i64,
    /// The name; upper and lower case are the same.
    pub name: String,
    /// When it was made, in UTC: `2026-11-20T14:03:22Z`.
    pub since: String,
    /// The language of the screens, if one was chosen: `en` or `uk`.
    pub lang: Option<String>,
}

/// A finished run, to be stored.
#[derive(Debug, Clone, PartialEq)]
pub struct RunEntry {
    /// What no other run is called: its recording's name.
    pub id: String,
    /// When it ended, in UTC.
    pub when: String,
    /// What it means to the career.
    pub flight: Flight,
    /// Everything about it: revision, seed, ledger, events, score.
    pub report: Report,
    /// The airframes that flew, a TOML design for each drone that was built; empty for the mission's own drones.
    pub airframes: Vec<String>,
    /// The recorded run's file, if it was recorded.
    pub recording: Option<String>,
}

/// Why profiles cannot be had.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.text())]
pub enum ProfileError {
    /// The folder or the file cannot be read or written.
    Unusable {
        /// The file.
        path: PathBuf,
        /// Why not.
        error: io::Error,
    },
    /// A newer version of the program made it.
    Newer {
        /// The file.
        path: PathBuf,
        /// The version of its tables.
        found: i32,
        /// The newest version that this program knows.
        known: i32,
    },
    /// The database says no.
    Database {
        /// The file.
        path: PathBuf,
        /// What it says.
        error: rusqlite::Error,
    },
    /// There is no such profile.
    Unknown {
        /// Who was asked for.
        name: String,
        /// Who there is.
        known: Vec<String>,
    },
    /// There is one of this name.
    Exists {
        /// Which.
        name: String,
    },
    /// The name is none.
    Name,
    /// A file that should be a profile is none.
    NoProfile {
        /// What is wrong with it.
        fault: String,
    },
    /// A part cannot be bought.
    Refused(Refusal),
}

impl ProfileError {
    /// In words.
    pub fn text(&self) -> Text {
        let shown = |path: &Path| path.display().to_string();
        match self {
            Self::Unusable { path, error } => {
                text!(
                    "profiles-unusable",
                    path = shown(path),
                    error = error.to_string()
                )
            }
            Self::Newer { path, found, known } => {
                text!(
                    "profiles-newer",
                    path = shown(path),
                    found = *found,
                    known = *known
                )
            }
            Self::Database { path, error } => {
                text!(
                    "profiles-database",
                    path = shown(path),
                    error = error.to_string()
                )
            }
            Self::Unknown { name, known } if known.is_empty() => {
                text!("profiles-unknown-first", name = name.as_str())
            }
            Self::Unknown { name, known } => {
                text!(
                    "profiles-unknown",
                    name = name.as_str(),
                    known = known.join(", ")
                )
            }
            Self::Exists { name } => text!("profiles-exists", name = name.as_str()),
            Self::Name => text!("profiles-name", most = LONGEST_NAME),
            Self::NoProfile { fault } => text!("profiles-no-profile", fault = fault.as_str()),
            Self::Refused(refusal) => refusal.text(),
        }
    }
}

impl Profiles {
    /// Opens the profiles of a data folder; makes folder and file if need be. A damaged file is set aside and replaced by
    /// the last good copy, which the [`Rescue`] tells.
    ///
    /// # Errors
    /// The folder is not writable, or a newer version of the program made the file. Neither is changed then.
    pub fn open(data: &Path) -> Result<(Self, Option<Rescue>), ProfileError> {
        let path = data.join(FILE);
        let unusable = |error| ProfileError::Unusable {
            path: path.clone(),
            error,
        };
        std::fs::DirBuilder::new()
            .recursive(true)
            .mode(0o700)
            .create(data)
            .map_err(unusable)?;
        private(&path).map_err(unusable)?;
        let rescue = rescue::rescue(&path).map_err(unusable)?;
        let connection = Self::connect(&path)?;
        Ok((Self { connection, path }, rescue))
    }

    fn connect(path: &Path) -> Result<Connection, ProfileError> {
        let database = |error| ProfileError::Database {
            path: path.to_owned(),
            error,
        };
        let mut connection = Connection::open(path).map_err(database)?;
        connection.busy_timeout(PATIENCE).map_err(database)?;
        // What was reported as stored is on the disk, even if the machine loses power.
        connection
            .execute_batch(
                "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;",
            )
            .map_err(database)?;
        let found = schema::migrate(&mut connection).map_err(database)?;
        if found > schema::VERSION {
            return Err(ProfileError::Newer {
                path: path.to_owned(),
                found,
                known: schema::VERSION,
            });
        }
        Ok(connection)
    }

    /// Everybody, by name.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn list(&self) -> Result<Vec<Profile>, ProfileError> {
        let mut query = self.ask("SELECT key, name, since, lang FROM profiles ORDER BY name")?;
        let rows = query.query_map([], profile).and_then(Iterator::collect);
        rows.map_err(|error| self.fault(error))
    }

    /// One by name.
    ///
    /// # Errors
    /// There is none of this name; the error tells who there is.
    pub fn find(&self, name: &str) -> Result<Profile, ProfileError> {
        let mut query = self.ask("SELECT key, name, since, lang FROM profiles WHERE name = ?1")?;
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

    /// A new one.
    ///
    /// # Errors
    /// There is one of this name, the name is none, or the database cannot be written.
    pub fn create(&self, name: &str, when: &str) -> Result<Profile, ProfileError> {
        let name = checked_name(name)?;
        let added = self.connection.execute(
            "INSERT INTO profiles (name, since) VALUES (?1, ?2) ON CONFLICT DO NOTHING",
            params![name, when],
        );
        match added.map_err(|error| self.fault(error))? {
            0 => Err(ProfileError::Exists {
                name: name.to_owned(),
            }),
            _ => self.find(name),
        }
    }

    /// Removes a profile with all that it has.
    ///
    /// # Errors
    /// The database cannot be written.
    pub fn delete(&self, profile: &Profile) -> Result<(), ProfileError> {
        let removed = self
            .connection
            .execute("DELETE FROM profiles WHERE key = ?1", [profile.key]);
        removed.map(drop).map_err(|error| self.fault(error))
    }

    /// Remembers a language.
    ///
    /// # Errors
    /// The database cannot be written.
    pub fn set_lang(&self, profile: &Profile, lang: Option<&str>) -> Result<(), ProfileError> {
        let changed = self.connection.execute(
            "UPDATE profiles SET lang = ?2 WHERE key = ?1",
            params![profile.key, lang],
        );
        changed.map(drop).map_err(|error| self.fault(error))
    }

    /// What a profile's career consists of, oldest first.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn history(&self, profile: &Profile) -> Result<Vec<Entry>, ProfileError> {
        let mut query = self.ask("SELECT entry FROM entries WHERE profile = ?1 ORDER BY number")?;
        let rows = query
            .query_map([profile.key], |row| row.get::<_, String>(0))
            .and_then(Iterator::collect::<Result<Vec<_>, _>>);
        let rows = rows.map_err(|error| self.fault(error))?;
        rows.iter().map(|json| self.read(json)).collect()
    }

    /// The reports of a profile's runs of one mission, or of all, oldest first.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn reports(
        &self,
        profile: &Profile,
        mission: Option<&str>,
    ) -> Result<Vec<(String, Report)>, ProfileError> {
        let mut query = self.ask(
            "SELECT runs.ended, runs.report FROM runs JOIN entries USING (profile, id)
             WHERE profile = ?1 AND (?2 IS NULL OR mission = ?2) ORDER BY number",
        )?;
        let rows = query
            .query_map(params![profile.key, mission], |row| {
                Ok((row.get::<_, String>(0)?, row.get::<_, String>(1)?))
            })
            .and_then(Iterator::collect::<Result<Vec<_>, _>>);
        let rows = rows.map_err(|error| self.fault(error))?;
        rows.into_iter()
            .map(|(when, json)| Ok((when, self.read(&json)?)))
            .collect()
    }

    /// Stores a finished run. Handed in again it changes nothing; tells whether it was new.
    ///
    /// # Errors
    /// The database cannot be written; nothing of the run is stored then.
    pub fn store(&mut self, profile: &Profile, run: &RunEntry) -> Result<bool, ProfileError> {
        let path = self.path.clone();
        let fault = |error| ProfileError::Database {
            path: path.clone(),
            error,
        };
        let entry = json(&Entry::Flight(run.flight.clone()));
        let transaction = self
            .connection
            .transaction_with_behavior(TransactionBehavior::Immediate)
            .map_err(fault)?;
        let is_new = transaction
            .execute(
                "INSERT INTO entries (profile, id, at, entry) VALUES (?1, ?2, ?3, ?4) ON CONFLICT DO NOTHING",
                params![profile.key, run.id, run.when, entry],
            )
            .map_err(fault)?
            > 0;
        if is_new {
            let row = RunRow {
                id: &run.id,
                ended: &run.when,
                airframes: &run.airframes,
                recording: run.recording.as_deref(),
                report: &run.report,
            };
            row.insert(&transaction, profile.key).map_err(fault)?;
        }
        transaction.commit().map_err(fault)?;
        Ok(is_new)
    }

    /// Buys the right to use a part. Two consoles cannot spend the same credits.
    ///
    /// # Errors
    /// Why it cannot be bought, or that the database cannot be written; nothing is paid then.
    pub fn buy(
        &mut self,
        profile: &Profile,
        part: &str,
        course: &Course,
        when: &str,
    ) -> Result<Purchase, ProfileError> {
        let path = self.path.clone();
        let fault = |error| ProfileError::Database {
            path: path.clone(),
            error,
        };
        self.connection
            .execute_batch("BEGIN IMMEDIATE")
            .map_err(fault)?;
        let bought = self.buy_within(profile, part, course, when);
        let end = if bought.is_ok() { "COMMIT" } else { "ROLLBACK" };
        self.connection.execute_batch(end).map_err(fault)?;
        bought
    }

    fn buy_within(
        &self,
        profile: &Profile,
        part: &str,
        course: &Course,
        when: &str,
    ) -> Result<Purchase, ProfileError> {
        let standing = Standing::of(&self.history(profile)?);
        let purchase = standing.buy(part, course).map_err(ProfileError::Refused)?;
        let entry = json(&Entry::Purchase(purchase.clone()));
        let added = self.connection.execute(
            "INSERT INTO entries (profile, id, at, entry) VALUES (?1, ?2, ?3, ?4)",
            params![profile.key, format!("part {part}"), when, entry],
        );
        added.map_err(|error| self.fault(error))?;
        Ok(purchase)
    }

    /// A profile's designs, by name.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn designs(&self, profile: &Profile) -> Result<Vec<Design>, ProfileError> {
        let mut query = self.ask("SELECT design FROM designs WHERE profile = ?1 ORDER BY name")?;
        let rows = query
            .query_map([profile.key], |row| row.get::<_, String>(0))
            .and_then(Iterator::collect::<Result<Vec<_>, _>>);
        let rows = rows.map_err(|error| self.fault(error))?;
        // A design with a part that this version does not know is left out here, and stays in the file.
        Ok(rows
            .iter()
            .filter_map(|toml| Design::from_toml(toml).ok())
            .collect())
    }

    /// Keeps a design, in place of one of the same name.
    ///
    /// # Errors
    /// The database cannot be written.
    pub fn keep_design(&self, profile: &Profile, design: &Design) -> Result<(), ProfileError> {
        let kept = self.connection.execute(
            "INSERT INTO designs (profile, name, design) VALUES (?1, ?2, ?3)
             ON CONFLICT (profile, name) DO UPDATE SET name = excluded.name, design = excluded.design",
            params![profile.key, design.name, design.to_toml()],
        );
        kept.map(drop).map_err(|error| self.fault(error))
    }

    /// Removes a design.
    ///
    /// # Errors
    /// The database cannot be written.
    pub fn drop_design(&self, profile: &Profile, name: &str) -> Result<(), ProfileError> {
        let removed = self.connection.execute(
            "DELETE FROM designs WHERE profile = ?1 AND name = ?2",
            params![profile.key, name],
        );
        removed.map(drop).map_err(|error| self.fault(error))
    }

    /// Copies the file aside, if the last copy is old or this one holds something new; after a good start and a stored run.
    ///
    /// # Errors
    /// The copy cannot be written; the last one stays.
    pub fn back_up(&self) -> Result<(), ProfileError> {
        rescue::back_up(&self.connection, &self.path).map_err(|error| self.fault(error))
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    fn ask(&self, sql: &str) -> Result<rusqlite::Statement<'_>, ProfileError> {
        self.connection
            .prepare(sql)
            .map_err(|error| self.fault(error))
    }

    fn fault(&self, error: rusqlite::Error) -> ProfileError {
        ProfileError::Database {
            path: self.path.clone(),
            error,
        }
    }

    /// What was stored as JSON. It was written by a version that this program knows: anything else is damage.
    fn read<T: serde::de::DeserializeOwned>(&self, json: &str) -> Result<T, ProfileError> {
        serde_json::from_str(json).map_err(|error| ProfileError::NoProfile {
            fault: format!("{}: {error}", self.path.display()),
        })
    }
}

/// A finished run as the tables have it.
struct RunRow<'a> {
    id: &'a str,
    ended: &'a str,
    airframes: &'a [String],
    recording: Option<&'a str>,
    report: &'a Report,
}

impl RunRow<'_> {
    fn insert(&self, connection: &Connection, profile: i64) -> rusqlite::Result<usize> {
        let report = self.report;
        connection.execute(
            "INSERT INTO runs (profile, id, ended, mission, revision, seed, backend, score, passed, airframes, report, recording)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12)",
            params![
                profile,
                self.id,
                self.ended,
                report.mission,
                report.revision,
                // SQLite has no unsigned integers; the bits are the same.
                report.seed as i64,
                report.backend,
                report.score,
                report.passed,
                json(&self.airframes),
                json(report),
                self.recording,
            ],
        )
    }
}

/// A name that can be a profile's.
fn checked_name(name: &str) -> Result<&str, ProfileError> {
    let name = name.trim();
    let is_fine =
        (1..=LONGEST_NAME).contains(&name.chars().count()) && !name.chars().any(char::is_control);
    is_fine.then_some(name).ok_or(ProfileError::Name)
}

fn profile(row: &rusqlite::Row<'_>) -> rusqlite::Result<Profile> {
    Ok(Profile {
        key: row.get(0)?,
        name: row.get(1)?,
        since: row.get(2)?,
        lang: row.get(3)?,
    })
}

/// Plain structures are always JSON.
fn json<T: serde::Serialize>(value: &T) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

/// Makes sure that there is a file that only its owner reads, before `SQLite` makes one that others may.
fn private(path: &Path) -> io::Result<()> {
    let mut file = OpenOptions::new();
    file.create(true).truncate(false).write(true).mode(0o600);
    file.open(path).map(drop)
}
