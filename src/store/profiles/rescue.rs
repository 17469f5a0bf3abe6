//! Copies of the database, and what happens when it is damaged.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use rusqlite::{Connection, ErrorCode, OpenFlags};

use crate::store::utc;
use crate::text;
use crate::text::Text;

/// Copies that are kept: after the newest run, and the one before it.
const COPIES: [&str; 2] = ["backup", "backup-before"];

/// A damaged database that was set aside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rescue {
    /// Where the damaged file is now.
    pub damaged: PathBuf,
    /// The copy that took its place; `None`: there was no good one, the profiles begin anew.
    pub copy: Option<PathBuf>,
    /// What is wrong with it.
    pub fault: String,
}

impl Rescue {
    /// In words.
    pub fn text(&self) -> Text {
        let damaged = self.damaged.display().to_string();
        let fault = self.fault.as_str();
        match &self.copy {
            Some(copy) => text!(
                "profiles-rescued",
                damaged = damaged,
                copy = copy.display().to_string(),
                fault = fault
            ),
            None => text!("profiles-lost", damaged = damaged, fault = fault),
        }
    }
}

/// Looks at a database before it is used. One that is damaged is renamed, with its log, and the newest good copy takes its
/// place.
pub(super) fn rescue(path: &Path) -> io::Result<Option<Rescue>> {
    let Some(fault) = damage(path) else {
        return Ok(None);
    };
    let when = utc(SystemTime::now()).replace(':', "-");
    let damaged = beside(path, &format!("damaged-{when}"));
    fs::rename(path, &damaged)?;
    for log in ["-wal", "-shm"] {
        let log_of = |path: &Path| PathBuf::from(format!("{}{log}", path.display()));
        match fs::rename(log_of(path), log_of(&damaged)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
    }
    let copy = COPIES
        .iter()
        .map(|name| beside(path, name))
        .find(|copy| copy.exists() && damage(copy).is_none());
    drop(super::private(path)?);
    if let Some(copy) = &copy {
        fs::write(path, fs::read(copy)?)?;
    }
    Ok(Some(Rescue {
        damaged,
        copy,
        fault,
    }))
}

/// What is wrong with a database; an empty file is a new one. Being busy, or of a file system that refuses, is no damage.
fn damage(path: &Path) -> Option<String> {
    let is_damage = |error: &rusqlite::Error| {
        matches!(
            error.sqlite_error_code(),
            Some(ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase)
        )
    };
    let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let connection = Connection::open_with_flags(path, flags).ok()?;
    connection.busy_timeout(super::PATIENCE).ok()?;
    let found = connection.query_row("PRAGMA quick_check(1)", [], |row| row.get::<_, String>(0));
    match found {
        Ok(word) if word == "ok" => None,
        Ok(fault) => Some(fault),
        Err(error) if is_damage(&error) => Some(error.to_string()),
        Err(_) => None,
    }
}

/// Copies the database as it is now. The copy is whole before it takes the place of the last one. Where another console is
/// at it, this one leaves it alone.
pub(super) fn back_up(connection: &Connection, path: &Path) -> rusqlite::Result<()> {
    let [newest, before] = COPIES.map(|name| beside(path, name));
    let fresh = beside(path, "backup-new");
    let io = |error: io::Error| rusqlite::Error::ToSqlConversionFailure(Box::new(error));
    let file = super::private(&fresh).map_err(io)?;
    if file.try_lock().is_err() {
        return Ok(());
    }
    // What is left of a copy that was interrupted.
    file.set_len(0).map_err(io)?;
    connection.backup("main", &fresh, None)?;
    if newest.exists() {
        fs::rename(&newest, &before).map_err(io)?;
    }
    fs::rename(&fresh, &newest).map_err(io)
}

fn beside(path: &Path, name: &str) -> PathBuf {
    PathBuf::from(format!("{}.{name}", path.display()))
}
