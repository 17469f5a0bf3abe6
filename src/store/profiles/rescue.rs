//! Copies of the database, and what happens when it is damaged.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use rusqlite::{Connection, ErrorCode, OpenFlags};

use crate::store::utc;
use crate::text;
use crate::text::Text;

/// Copies that are kept: after the newest run, and the one before it.
const COPIES: [&str; 2] = ["backup", "backup-before"];
/// What a check says of a database that is whole.
const SOUND: &str = "ok";

/// A damaged database that was set aside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rescue {
    /// Where the damaged file is now.
    pub damaged: PathBuf,
    /// The copy that took its place; `None`: there was no good one, the profiles begin anew.
    pub copy: Option<PathBuf>,
    /// What is wrong with it.
    pub fault: Text,
}

impl Rescue {
    pub fn text(&self) -> Text {
        let damaged = self.damaged.display().to_string();
        let fault = self.fault.clone();
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
/// place. Of several consoles that see the damage, one does it.
pub(super) fn rescue(path: &Path) -> io::Result<Option<Rescue>> {
    if damage(path).is_none() {
        return Ok(None);
    }
    let lock = lock_file(path)?;
    lock.lock()?;
    // Another console may have been faster.
    let Some(fault) = damage(path) else {
        return Ok(None);
    };
    let copy = good_copy(path);
    let restored = copy
        .as_ref()
        .map(|copy| duplicate(copy, path))
        .transpose()?;
    let when = utc(SystemTime::now()).replace(':', "-");
    let damaged = beside(path, &format!("damaged-{when}"));
    // Whoever is killed from here on leaves no file or an empty one, which the copies show to be damage.
    rename(path, &damaged)?;
    for log in ["-wal", "-shm"] {
        let log_of = |path: &Path| PathBuf::from(format!("{}{log}", path.display()));
        rename(&log_of(path), &log_of(&damaged))?;
    }
    match &restored {
        Some(restored) => fs::rename(restored, path)?,
        None => drop(super::private(path)?),
    }
    sync_folder(path)?;
    Ok(Some(Rescue {
        damaged,
        copy,
        fault,
    }))
}

/// What only one console does at a time, whatever becomes of the database's own file.
fn lock_file(path: &Path) -> io::Result<File> {
    super::private(&beside(path, "lock"))
}

/// What is wrong with a database. An empty file, or none, is a new one where there is no copy. Being busy, or of a file
/// system that refuses, is no damage.
fn damage(path: &Path) -> Option<Text> {
    if is_empty(path) {
        return good_copy(path).map(|_| text!("profiles-fault-empty"));
    }
    let is_damage = |error: &rusqlite::Error| {
        matches!(
            error.sqlite_error_code(),
            Some(ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase)
        )
    };
    match check(path) {
        Ok(word) if word == SOUND => None,
        Ok(words) => Some(faulty(words)),
        Err(error) if is_damage(&error) => Some(faulty(error.to_string())),
        Err(_) => None,
    }
}

/// `SQLite`'s own words are English in every language.
fn faulty(words: String) -> Text {
    text!("profiles-fault-database", words = words)
}

/// What `SQLite` says of a database: [`SOUND`], or what is wrong.
fn check(path: &Path) -> rusqlite::Result<String> {
    let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let connection = Connection::open_with_flags(path, flags)?;
    connection.busy_timeout(super::PATIENCE)?;
    connection.query_row("PRAGMA quick_check(1)", [], |row| row.get(0))
}

/// The copies of a database, the newest first, whether they are there or not.
pub(super) fn copies(path: &Path) -> [PathBuf; 2] {
    COPIES.map(|name| beside(path, name))
}

/// The newest copy of a database that is whole.
fn good_copy(path: &Path) -> Option<PathBuf> {
    copies(path)
        .into_iter()
        .find(|copy| !is_empty(copy) && check(copy).is_ok_and(|word| word == SOUND))
}

fn is_empty(path: &Path) -> bool {
    fs::metadata(path).map_or_else(
        |error| error.kind() == io::ErrorKind::NotFound,
        |file| file.len() == 0,
    )
}

/// Writes a copy once more, beside the database whose place it takes then; it is on the disk before that.
fn duplicate(copy: &Path, path: &Path) -> io::Result<PathBuf> {
    let restored = beside(path, "restored");
    // What is left of a rescue that was interrupted.
    remove(&restored)?;
    let mut file = super::private(&restored)?;
    io::copy(&mut File::open(copy)?, &mut file)?;
    file.sync_all()?;
    Ok(restored)
}

/// Removes what is there.
fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Renames what is there.
fn rename(from: &Path, to: &Path) -> io::Result<()> {
    match fs::rename(from, to) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Makes what was renamed in a file's folder outlive a loss of power.
fn sync_folder(path: &Path) -> io::Result<()> {
    let folder = path.parent().filter(|it| !it.as_os_str().is_empty());
    File::open(folder.unwrap_or(Path::new(".")))?.sync_all()
}

/// Copies the database as it is now. The copy is whole and sound before it takes the place of the last one. Where another
/// console is at it, this one leaves it alone.
pub(super) fn back_up(connection: &Connection, path: &Path) -> rusqlite::Result<()> {
    let [newest, before] = COPIES.map(|name| beside(path, name));
    let fresh = beside(path, "backup-new");
    let io = |error: io::Error| rusqlite::Error::ToSqlConversionFailure(Box::new(error));
    let lock = lock_file(path).map_err(io)?;
    if lock.try_lock().is_err() {
        return Ok(());
    }
    // What is left of a copy that was interrupted, or a link that another user has laid.
    remove(&fresh).map_err(io)?;
    drop(super::private(&fresh).map_err(io)?);
    connection.backup("main", &fresh, None)?;
    let found = check(&fresh)?;
    if found != SOUND {
        let corrupt = rusqlite::ffi::Error::new(rusqlite::ffi::SQLITE_CORRUPT);
        return Err(rusqlite::Error::SqliteFailure(corrupt, Some(found)));
    }
    if newest.exists() {
        fs::rename(&newest, &before).map_err(io)?;
    }
    fs::rename(&fresh, &newest).map_err(io)?;
    sync_folder(path).map_err(io)
}

fn beside(path: &Path, name: &str) -> PathBuf {
    PathBuf::from(format!("{}.{name}", path.display()))
}
