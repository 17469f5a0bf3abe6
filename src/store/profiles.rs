//! Profiles: the trainees, their flights, purchases and designs, in one `SQLite` file. Whoever may read its folder may
//! read it.
//!
//! A career is a history that only grows ([`crate::campaign`]); this file keeps it, and a run's whole report with it. Every
//! change is one transaction, written ahead to a log, so that a killed program loses nothing that it has reported as stored,
//! and several consoles may write at the same time. A run's id makes it count once, however often it is handed in.

mod error;
mod flights;
mod mend;
mod possessions;
mod rescue;
mod schema;
#[cfg(test)]
mod tests;
mod transfer;

use std::cmp::Ordering;
use std::fs::{File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use rusqlite::{
    Connection, OpenFlags, OptionalExtension as _, Transaction, TransactionBehavior, params,
};
use serde::{Deserialize, Serialize};

use crate::campaign::Aids;
use crate::notice::sanitised;
use crate::store::sharing;

pub use error::ProfileError;
pub use flights::{PastRun, RunEntry};
pub use mend::MendedRows;
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
    is_read_only: bool,
}

/// A profile: the career of one trainee.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Profile {
    key: i64,
    /// The name; upper and lower case are the same.
    pub name: String,
    /// When it was made, in UTC: `2026-11-20T14:03:22Z`.
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
        match sharing::private_folder(data).and_then(|()| private(&path)) {
            Ok(_) => {}
            // The results of another user, or a folder that is not written to.
            Err(error) if is_forbidden(&error) && path.is_file() => {
                return Ok((Self::read_only(path)?, None));
            }
            Err(error) => return Err(unusable(error)),
        }
        let rescue = rescue::rescue(&path).map_err(unusable)?;
        let connection = Self::connect(&path)?;
        let profiles = Self {
            connection,
            path,
            is_read_only: false,
        };
        Ok((profiles, rescue))
    }

    /// Opens a file that may only be read. Where it is not written to, there is no log beside it; then it is read without
    /// the locks for which `SQLite` would have to write.
    fn read_only(path: PathBuf) -> Result<Self, ProfileError> {
        let database = |error| ProfileError::Database {
            path: path.clone(),
            error,
        };
        let log = PathBuf::from(format!("{}-wal", path.display()));
        let quiet = if log.exists() { "" } else { "?immutable=1" };
        let shown = path.display().to_string();
        let name = shown
            .replace('%', "%25")
            .replace('?', "%3f")
            .replace('#', "%23");
        let flags = OpenFlags::SQLITE_OPEN_READ_ONLY
            | OpenFlags::SQLITE_OPEN_NO_MUTEX
            | OpenFlags::SQLITE_OPEN_URI;
        let connection =
            Connection::open_with_flags(format!("file:{name}{quiet}"), flags).map_err(database)?;
        connection.busy_timeout(PATIENCE).map_err(database)?;
        let found = schema::version(&connection).map_err(database)?;
        match found.cmp(&schema::VERSION) {
            Ordering::Equal => Ok(Self {
                connection,
                path,
                is_read_only: true,
            }),
            Ordering::Greater => Err(ProfileError::Newer {
                path,
                found,
                known: schema::VERSION,
            }),
            Ordering::Less => Err(ProfileError::Older { path }),
        }
    }

    /// Whether it can be read, and not be written.
    pub fn is_read_only(&self) -> bool {
        self.is_read_only
    }

    /// Reads rows that are damaged from the copies, as far as these have them. `None`: none was.
    ///
    /// # Errors
    /// The database cannot be read or written.
    pub fn mend(&mut self) -> Result<Option<MendedRows>, ProfileError> {
        mend::mend_rows(&mut self.connection, &self.path).map_err(|error| self.fault(error))
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

    /// A number that is another one once another program has written.
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

    /// One by name.
    ///
    /// # Errors
    /// There is none of this name; the error tells who there is.
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

    /// A new one.
    ///
    /// # Errors
    /// There is one of this name, the name is none, or the database cannot be written.
    pub fn create(&self, name: &str, when: &str) -> Result<Profile, ProfileError> {
        let name = checked_name(name)?;
        let added = self.connection.execute(
            "INSERT INTO profiles (name, since, settings) VALUES (?1, ?2, ?3) ON CONFLICT DO NOTHING",
            params![name, when, json(&ProfileSettings::default())],
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

    /// Copies the file aside, for the day on which it is damaged.
    ///
    /// # Errors
    /// The copy cannot be written; the last one stays.
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

    /// Everything until its commit, or nothing; other consoles wait.
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

    /// What was stored as JSON. It was written by a version that this program knows: anything else is damage.
    fn read<T: serde::de::DeserializeOwned>(&self, json: &str) -> Result<T, ProfileError> {
        serde_json::from_str(json).map_err(|error| ProfileError::Damaged {
            path: self.path.clone(),
            // It quotes what it found.
            fault: sanitised(&error.to_string()),
        })
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
        name: sanitised(&row.get::<_, String>(1)?),
        since: sanitised(&row.get::<_, String>(2)?),
        // What a newer version has written, or a hand: nothing that is worth losing a profile for.
        settings: serde_json::from_str(&row.get::<_, String>(3)?).unwrap_or_default(),
    })
}

/// Plain structures are always JSON.
fn json<T: serde::Serialize>(value: &T) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

/// Makes sure that there is a file that only the readers of its folder read, before `SQLite` makes one that others may.
fn private(path: &Path) -> io::Result<File> {
    let mut file = OpenOptions::new();
    sharing::open(file.create(true).truncate(false).write(true), path)
}

/// Whether a file is there and must not be written.
fn is_forbidden(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem
    )
}
