//! Opening the database: for writing, or read-only if the folder or the file must not be written.

use std::cmp::Ordering;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use nix::errno::Errno;
use nix::unistd::{AccessFlags, access};
use rusqlite::{Connection, ErrorCode, OpenFlags};

use super::{FILE, PATIENCE, ProfileError, Profiles, Rescue, rescue, schema};
use crate::store::sharing;

impl Profiles {
    /// Opens the profiles of a data folder; creates folder and file if needed. Profiles that must
    /// not be written are opened read-only. A damaged file is set aside and replaced by the last
    /// good copy, which the [`Rescue`] reports.
    ///
    /// # Errors
    /// The folder or the file cannot be created, or a newer version of the program wrote the file.
    /// Neither is changed then.
    pub fn open(data: &Path) -> Result<(Self, Option<Rescue>), ProfileError> {
        let path = data.join(FILE);
        let unusable = |error| ProfileError::Unusable {
            path: path.clone(),
            error,
        };
        match sharing::private_folder(data).and_then(|()| private(&path)) {
            // `SQLite` must be able to write its log beside the file.
            Ok(_) if is_closed(data) => return Ok((Self::read_only(path)?, None)),
            Ok(_) => {}
            // The results belong to another user, or the folder is read-only.
            Err(error) if is_forbidden(&error) && path.is_file() => {
                return Ok((Self::read_only(path)?, None));
            }
            Err(error) => return Err(forbidden(&path).unwrap_or_else(|| unusable(error))),
        }
        let rescue = rescue::rescue(&path).map_err(unusable)?;
        let connection = connect(&path)?;
        let profiles = Self {
            connection,
            path,
            is_read_only: false,
        };
        Ok((profiles, rescue))
    }

    /// Opens the profiles of a data folder to read them: a missing folder or file is not created and has no profiles. As
    /// with [`open`](Self::open), a damaged file is replaced.
    ///
    /// # Errors
    /// The profiles cannot be read, or a newer version of the program wrote the file.
    pub fn open_to_read(data: &Path) -> Result<(Self, Option<Rescue>), ProfileError> {
        let path = data.join(FILE);
        // A file that is missing beside its copies is damage.
        let copies = rescue::copies(&path);
        if is_missing(data) || (is_missing(&path) && copies.iter().all(|copy| is_missing(copy))) {
            return Ok((Self::none(path)?, None));
        }
        Self::open(data).map_err(|error| match error {
            ProfileError::Unusable { path, error } => {
                // Without write permission, the file could not be created; a reader gets the reason
                // why it cannot be read.
                let error = fs::metadata(&path).err().unwrap_or(error);
                ProfileError::Unreadable { path, error }
            }
            other => other,
        })
    }

    /// An empty, read-only set of profiles without a file.
    fn none(path: PathBuf) -> Result<Self, ProfileError> {
        let empty = || {
            let mut connection = Connection::open_in_memory()?;
            schema::migrate(&mut connection)?;
            connection.pragma_update(None, "query_only", true)?;
            Ok(connection)
        };
        match empty() {
            Ok(connection) => Ok(Self {
                connection,
                path,
                is_read_only: true,
            }),
            Err(error) => Err(ProfileError::Database { path, error }),
        }
    }

    /// Opens a file read-only. In a read-only folder without a log beside the file, it is read without the locks that
    /// `SQLite` would have to write.
    pub(super) fn read_only(path: PathBuf) -> Result<Self, ProfileError> {
        if let Some(forbidden) = forbidden(&path) {
            return Err(forbidden);
        }
        let database = |error| unread(&path, error);
        let log = beside(&path, "wal");
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
}

fn connect(path: &Path) -> Result<Connection, ProfileError> {
    let database = |error| ProfileError::Database {
        path: path.to_owned(),
        error,
    };
    let mut connection = Connection::open(path).map_err(database)?;
    connection.busy_timeout(PATIENCE).map_err(database)?;
    // Data reported as stored is on the disk, even if the machine loses power.
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

/// Creates a file that is private, or readable by those who can read its folder, before `SQLite`
/// would create a public one.
pub(super) fn private(path: &Path) -> io::Result<File> {
    let mut file = OpenOptions::new();
    sharing::open(file.create(true).truncate(false).write(true), path)
}

fn beside(path: &Path, name: &str) -> PathBuf {
    PathBuf::from(format!("{}-{name}", path.display()))
}

/// The error of a file that this user may not read; `None` if it may be read or belongs to this user.
fn forbidden(path: &Path) -> Option<ProfileError> {
    let is_refused = access(path, AccessFlags::R_OK) == Err(Errno::EACCES);
    is_refused.then(|| of_another(path)).flatten()
}

/// The error of a file in the folder of another user; `None` if it belongs to this user.
fn of_another(path: &Path) -> Option<ProfileError> {
    let folder = path.parent().unwrap_or(path);
    // In a folder that this user may not enter, only the folder shows its owner.
    let owner = sharing::other_owner(path).or_else(|| sharing::other_owner(folder))?;
    Some(ProfileError::Forbidden {
        path: path.to_owned(),
        owner,
        is_folder_unshared: sharing::lacks_only_the_group_bit(folder),
    })
}

/// Why a database cannot be read: the log needs an index, which only a process that may write to
/// the folder can create.
fn unread(path: &Path, error: rusqlite::Error) -> ProfileError {
    let log = beside(path, "wal");
    let path = path.to_owned();
    let is_closed = error.sqlite_error_code() == Some(ErrorCode::CannotOpen);
    if is_closed && log.exists() && !beside(&path, "shm").exists() {
        ProfileError::LogAlone { path, log }
    } else {
        ProfileError::Database { path, error }
    }
}

fn is_missing(path: &Path) -> bool {
    fs::metadata(path).is_err_and(|error| error.kind() == io::ErrorKind::NotFound)
}

/// Whether the error means that the file exists and must not be written.
fn is_forbidden(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem
    )
}

/// Whether files can neither be created in the folder nor removed from it.
fn is_closed(folder: &Path) -> bool {
    let found = access(folder, AccessFlags::W_OK | AccessFlags::X_OK);
    matches!(found, Err(Errno::EACCES | Errno::EROFS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_that_cannot_be_read_without_its_index_is_named() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join(FILE);
        let refused = || {
            let code = rusqlite::ffi::Error::new(rusqlite::ffi::SQLITE_CANTOPEN);
            unread(&path, rusqlite::Error::SqliteFailure(code, None))
        };
        assert!(matches!(refused(), ProfileError::Database { .. }));
        fs::write(beside(&path, "wal"), "log").expect("written");
        assert!(matches!(refused(), ProfileError::LogAlone { .. }));
        fs::write(beside(&path, "shm"), "index").expect("written");
        assert!(matches!(refused(), ProfileError::Database { .. }));
    }

    #[test]
    fn a_file_of_another_user_without_a_shared_folder_is_named_with_the_way_out() {
        let said = |is_folder_unshared| {
            let path = PathBuf::from("/srv/class/anna/profiles.sqlite");
            let owner = "anna".to_owned();
            let error = ProfileError::Forbidden {
                path,
                owner,
                is_folder_unshared,
            };
            error.text().to_string()
        };
        let unshared = said(true);
        for part in [
            "belongs to anna",
            "/srv/class/anna has no setgid bit",
            "`sortie doctor`",
        ] {
            assert!(unshared.contains(part), "{part}: {unshared}");
        }
        assert!(said(false).contains("ask anna for access"));
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join(FILE);
        fs::write(&path, "").expect("written");
        assert!(forbidden(&path).is_none(), "it belongs to this user");
        assert!(of_another(&path).is_none(), "it belongs to this user");
        // Only the superuser can give a folder away.
        if std::os::unix::fs::chown(folder.path(), Some(65_534), None).is_ok() {
            let hidden = folder.path().join("hidden");
            let error = of_another(&hidden).expect("the folder has another owner");
            let shown = error.text().to_string();
            assert!(
                shown.contains("belongs to nobody") || shown.contains("belongs to user 65534"),
                "{shown}"
            );
        }
    }
}
