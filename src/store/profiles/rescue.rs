//! Backups of the database, and its rescue from damage.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use rusqlite::{Connection, ErrorCode, OpenFlags};

use crate::store::utc;
use crate::text;
use crate::text::Text;

/// The two backups: after the newest run, and before it.
const COPIES: [&str; 2] = ["backup", "backup-before"];
/// The result of a successful check.
const SOUND: &str = "ok";

/// A damaged database that was set aside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rescue {
    /// The new path of the damaged file.
    pub damaged: PathBuf,
    /// The copy that replaced the damaged file; `None` if there was no good copy: the profiles then
    /// start empty.
    pub copy: Option<PathBuf>,
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

/// Checks a database before use. A damaged database is renamed, together with its log, and the
/// newest good copy replaces it. If several consoles detect the damage, only one of them does this.
pub(super) fn rescue(path: &Path) -> io::Result<Option<Rescue>> {
    if damage(path).is_none() {
        return Ok(None);
    }
    let lock = lock_file(path)?;
    lock.lock()?;
    // Another console may have rescued it already.
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
    // If the program is killed from here on, the file is missing or empty, which counts as damage while copies
    // exist.
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

/// The lock for work that only one console may do at a time, independent of the database's file.
fn lock_file(path: &Path) -> io::Result<File> {
    super::private(&beside(path, "lock"))
}

/// The damage of a database, if any. A missing or empty file is a new database if there is no copy.
/// A busy database or a file system that refuses access is not damage.
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

/// The fault with `SQLite`'s own message, which is English in every language.
fn faulty(words: String) -> Text {
    text!("profiles-fault-database", words = words)
}

/// The result of `SQLite`'s check: [`SOUND`], or a description of the damage.
fn check(path: &Path) -> rusqlite::Result<String> {
    let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let connection = Connection::open_with_flags(path, flags)?;
    connection.busy_timeout(super::PATIENCE)?;
    connection.query_row("PRAGMA quick_check(1)", [], |row| row.get(0))
}

/// The paths of the copies, newest first, whether they exist or not.
pub(super) fn copies(path: &Path) -> [PathBuf; 2] {
    COPIES.map(|name| beside(path, name))
}

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

/// Duplicates a copy next to the database that it will replace, and syncs it to the disk.
fn duplicate(copy: &Path, path: &Path) -> io::Result<PathBuf> {
    let restored = beside(path, "restored");
    // Removes what an interrupted rescue has left.
    remove(&restored)?;
    let mut file = super::private(&restored)?;
    io::copy(&mut File::open(copy)?, &mut file)?;
    file.sync_all()?;
    Ok(restored)
}

/// Removes a file, if it exists.
fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Renames a file, if it exists.
fn rename(from: &Path, to: &Path) -> io::Result<()> {
    match fs::rename(from, to) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Makes renames in a file's folder survive a loss of power.
fn sync_folder(path: &Path) -> io::Result<()> {
    let folder = path.parent().filter(|it| !it.as_os_str().is_empty());
    File::open(folder.unwrap_or(Path::new(".")))?.sync_all()
}

/// Backs up the database. The copy is checked before it replaces the last one. If another console
/// is making a backup, this console does not.
pub(super) fn back_up(connection: &Connection, path: &Path) -> rusqlite::Result<()> {
    let [newest, before] = COPIES.map(|name| beside(path, name));
    let fresh = beside(path, "backup-new");
    let io = |error: io::Error| rusqlite::Error::ToSqlConversionFailure(Box::new(error));
    let lock = lock_file(path).map_err(io)?;
    if lock.try_lock().is_err() {
        return Ok(());
    }
    // Removes what an interrupted copy has left, or a link planted by another user.
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
