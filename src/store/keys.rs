//! The file with the keys of MAVLink signing. Only its owner may read it, and only one console uses
//! it at a time: two would send the same timestamps.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::os::unix::fs::{MetadataExt as _, OpenOptionsExt as _};
use std::path::{Path, PathBuf};

use super::sharing::KEY_FILE;
use super::source::LARGEST_FILE;
use super::{links, output, sharing};
use crate::config::Readers;
use crate::signing::{Keyring, KeyringFault};
use crate::text;
use crate::text::Text;

/// All permissions of users other than the owner.
const OTHERS: u32 = 0o077;

/// The file with the keys, which this program alone writes.
#[derive(Debug)]
pub struct KeyFile {
    path: PathBuf,
    /// The lock, held as long as the keys are used; `None` until there are keys.
    lock: Option<File>,
}

/// Why the keys cannot be used.
#[derive(Debug)]
pub enum KeyFileFault {
    Io {
        path: PathBuf,
        error: io::Error,
    },
    /// Other users have permissions for the file.
    Readable {
        path: PathBuf,
        mode: u32,
    },
    /// The file belongs to another user.
    Foreign {
        path: PathBuf,
    },
    /// Another console uses the keys.
    InUse {
        path: PathBuf,
    },
    Content {
        path: PathBuf,
        fault: KeyringFault,
    },
}

impl From<&KeyFileFault> for Text {
    fn from(fault: &KeyFileFault) -> Self {
        let shown = |path: &Path| path.display().to_string();
        match fault {
            KeyFileFault::Io { path, error } => {
                let error = Self::from(error);
                text!("signing-file-error", path = shown(path), error = error)
            }
            KeyFileFault::Readable { path, mode } => {
                let mode = format!("{mode:04o}");
                text!("signing-file-readable", path = shown(path), mode = mode)
            }
            KeyFileFault::Foreign { path } => text!("signing-file-foreign", path = shown(path)),
            KeyFileFault::InUse { path } => text!("signing-file-in-use", path = shown(path)),
            KeyFileFault::Content { path, fault } => {
                text!(
                    "signing-file-content",
                    path = shown(path),
                    fault = Text::from(*fault)
                )
            }
        }
    }
}

impl KeyFile {
    /// The path of the key file in a data folder.
    pub fn path_within(data: &Path) -> PathBuf {
        data.join(KEY_FILE)
    }

    /// Reads the keys in a data folder, and keeps other consoles from using them. Without a file,
    /// the keyring is empty.
    ///
    /// # Errors
    /// Others could read the file, another console uses it, or it cannot be read.
    pub fn open(data: &Path) -> Result<(Self, Keyring), KeyFileFault> {
        let mut file = Self {
            path: Self::path_within(data),
            lock: None,
        };
        if fs::symlink_metadata(&file.path).is_err_and(|it| it.kind() == io::ErrorKind::NotFound) {
            return Ok((file, Keyring::default()));
        }
        file.lock()?;
        let keys = read(&file.path)?;
        Ok((file, keys))
    }

    /// Reads the keys without locking them; `None` if the file does not exist.
    ///
    /// # Errors
    /// As [`Self::open`], but a file in use is no error.
    pub fn look(data: &Path) -> Result<Option<Keyring>, KeyFileFault> {
        match read(&Self::path_within(data)) {
            Ok(keys) => Ok(Some(keys)),
            Err(KeyFileFault::Io { error, .. }) if error.kind() == io::ErrorKind::NotFound => {
                Ok(None)
            }
            Err(fault) => Err(fault),
        }
    }

    /// Replaces the content: after a crash, the file has either the old or the new content.
    ///
    /// # Errors
    /// The file cannot be written, or another console has begun to use it.
    pub fn write(&mut self, text: &str) -> Result<(), KeyFileFault> {
        if self.lock.is_none() {
            self.lock()?;
            if self.path.exists() {
                // Another console has used it and ended.
                return Err(self.in_use());
            }
        }
        let written = output::write_output(&self.path, text, Readers::Owner);
        written.map_err(|error| self.io(io::Error::other(Text::from(&error).to_string())))
    }

    fn lock(&mut self) -> Result<(), KeyFileFault> {
        if let Some(folder) = self.path.parent() {
            sharing::private_folder(folder).map_err(|error| self.io(error))?;
        }
        let path = self.path.with_extension("lock");
        let mut options = OpenOptions::new();
        options.write(true).create(true).truncate(false).mode(0o600);
        let lock = links::open_own(&mut options, &path).map_err(|error| self.io(error))?;
        match lock.try_lock() {
            // Without file locks, other consoles cannot be detected, so this one counts as the only
            // one.
            Ok(()) | Err(TryLockError::Error(_)) => self.lock = Some(lock),
            Err(TryLockError::WouldBlock) => return Err(self.in_use()),
        }
        Ok(())
    }

    fn in_use(&self) -> KeyFileFault {
        KeyFileFault::InUse {
            path: self.path.clone(),
        }
    }

    fn io(&self, error: io::Error) -> KeyFileFault {
        KeyFileFault::Io {
            path: self.path.clone(),
            error,
        }
    }
}

fn read(path: &Path) -> Result<Keyring, KeyFileFault> {
    let fail = |error| KeyFileFault::Io {
        path: path.to_owned(),
        error,
    };
    // Checked before opening, which would block on a pipe without a writer.
    let facts = fs::metadata(path).map_err(fail)?;
    let mode = facts.mode() & 0o7777;
    if !facts.is_file() || facts.len() > LARGEST_FILE {
        return Err(fail(io::ErrorKind::InvalidData.into()));
    }
    if mode & OTHERS != 0 {
        let path = path.to_owned();
        return Err(KeyFileFault::Readable { path, mode });
    }
    let user = nix::unistd::geteuid();
    if facts.uid() != user.as_raw() && !user.is_root() {
        let path = path.to_owned();
        return Err(KeyFileFault::Foreign { path });
    }
    let text = fs::read_to_string(path).map_err(fail)?;
    Keyring::read(&text).map_err(|fault| KeyFileFault::Content {
        path: path.to_owned(),
        fault,
    })
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::PermissionsExt as _;

    use super::*;
    use crate::signing::{SecretKey, SigningChange};

    fn with_a_key() -> Keyring {
        let mut ring = Keyring::default();
        let fresh = SecretKey::new([0xAB; 32]);
        ring.begin("tcp:127.0.0.1:5760", 3, SigningChange::SetUp, fresh);
        ring
    }

    #[test]
    fn the_file_is_for_its_owner_alone_and_is_read_as_it_was_written() {
        let folder = tempfile::tempdir().expect("a folder");
        let data = folder.path().join("deep");
        let (mut file, none) = KeyFile::open(&data).expect("no file yet");
        assert_eq!(none, Keyring::default());
        let (text, _) = with_a_key().write(0);
        for _ in 0..2 {
            file.write(&text).expect("written");
            let mode = fs::metadata(KeyFile::path_within(&data))
                .expect("a file")
                .mode();
            assert_eq!(mode & 0o777, 0o600);
        }
        drop(file);
        let (_file, keys) = KeyFile::open(&data).expect("readable");
        assert_eq!(keys, Keyring::read(&text).expect("sound"));
    }

    #[test]
    fn a_file_that_others_can_read_is_refused_with_what_to_do() {
        let folder = tempfile::tempdir().expect("a folder");
        let (mut file, _) = KeyFile::open(folder.path()).expect("no file yet");
        file.write(&with_a_key().write(0).0).expect("written");
        drop(file);
        let path = KeyFile::path_within(folder.path());
        for mode in [0o640, 0o604, 0o620] {
            fs::set_permissions(&path, fs::Permissions::from_mode(mode)).expect("it is ours");
            let fault = KeyFile::open(folder.path()).expect_err("refused");
            let words = Text::from(&fault).to_string();
            assert!(words.contains("chmod 600"), "{words}");
            assert!(!words.contains("abab"), "{words}");
        }
    }

    #[test]
    fn a_second_console_does_not_use_the_same_keys() {
        let folder = tempfile::tempdir().expect("a folder");
        let (mut one, _) = KeyFile::open(folder.path()).expect("no file yet");
        let (mut two, _) = KeyFile::open(folder.path()).expect("no file yet");
        one.write("").expect("the first");
        let in_use = |fault| matches!(fault, KeyFileFault::InUse { .. });
        assert!(in_use(two.write("").expect_err("the second")));
        assert!(in_use(
            KeyFile::open(folder.path()).expect_err("the second")
        ));
        drop(one);
        // A process that another test starts holds a copy of the lock until it executes its program.
        let mut tries = (0..100_000).map(|_| KeyFile::open(folder.path()));
        assert!(tries.any(|opened| opened.is_ok()), "the first has ended");
        assert!(in_use(two.write("").expect_err("it has not read the keys")));
    }

    #[test]
    fn a_damaged_file_is_named_by_its_line_without_its_content() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = KeyFile::path_within(folder.path());
        let key = "ab".repeat(31);
        let row =
            format!("stamp = 5\n\n[[vehicle]]\nsystem = 3\nlink = \"tcp:h:1\"\nkey = \"{key}\"\n");
        for text in [row.clone(), row.replace("system = 3", "system = x")] {
            fs::write(&path, &text).expect("written");
            fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).expect("it is ours");
            let fault = KeyFile::open(folder.path()).expect_err("refused");
            let words = Text::from(&fault).to_string();
            assert!(words.contains(" 4") || words.contains(" 5"), "{words}");
            assert!(!words.contains(&key), "{words}");
        }
    }
}
