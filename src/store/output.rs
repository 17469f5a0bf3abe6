//! Writing a file completely or not at all, whatever the path is: a file, a link, a device, a FIFO or standard
//! output.

use std::ffi::OsStr;
use std::fs::{File, Metadata, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::{fs, io};

use super::{StoreError, give_new_name, links};
use crate::config::Readers;

/// The path that stands for standard output.
const STANDARD_OUTPUT: &str = "-";
/// The mode of files that are not a trainee's results.
const PUBLIC: u32 = 0o666;
/// The maximum number of links in a chain, as in Linux.
const MOST_LINKS: usize = 40;

/// Writes a text file completely or not at all: a reader finds either the old file or the new one.
///
/// A link stays a link; its target is written. A file that is replaced keeps its mode, and its owner if the system
/// allows it. Anything that is not a regular file (a device, a FIFO) is written to; a FIFO needs a reader.
///
/// # Errors
/// It cannot be written, or it exists already and must not be replaced.
pub fn write(path: &Path, text: &str, replace: bool) -> Result<(), StoreError> {
    write_with_mode(path, text, replace, PUBLIC)
}

fn write_with_mode(path: &Path, text: &str, replace: bool, mode: u32) -> Result<(), StoreError> {
    let written = match present(path) {
        Ok(Some(found)) if found.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(Some(found)) if !found.is_file() || links::is_open_file(path) => append(path, text),
        Ok(Some(_)) if !replace => Err(io::ErrorKind::AlreadyExists.into()),
        Ok(Some(found)) => replace_file(path, text, &found),
        Ok(None) if replace => put_file(path, text, mode),
        Ok(None) => create_file(path, text, mode),
        Err(error) => Err(error),
    };
    written.map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => StoreError::Exists {
            path: path.to_owned(),
        },
        _ => StoreError::Unwritable {
            path: path.to_owned(),
            error,
        },
    })
}

/// Writes results of a trainee: `-` is standard output, a file is replaced. `readers` may read a new file.
///
/// # Errors
/// It cannot be written.
pub fn write_output(path: &Path, text: &str, readers: Readers) -> Result<(), StoreError> {
    if path != Path::new(STANDARD_OUTPUT) {
        let mode = match readers {
            Readers::Owner => 0o600,
            Readers::Group => 0o640,
        };
        return write_with_mode(path, text, true, mode);
    }
    let mut output = io::stdout().lock();
    let written = output.write_all(text.as_bytes());
    written
        .and_then(|()| output.flush())
        .map_err(|error| StoreError::Unwritable {
            path: path.to_owned(),
            error,
        })
}

/// The metadata of a path, with links followed.
fn present(path: &Path) -> io::Result<Option<Metadata>> {
    match fs::metadata(path) {
        Ok(found) => Ok(Some(found)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

#[cfg(unix)]
fn append(path: &Path, text: &str) -> io::Result<()> {
    use std::os::unix::fs::OpenOptionsExt as _;

    // A FIFO without a reader is an error here; otherwise it would block the console.
    let flags = nix::fcntl::OFlag::O_NONBLOCK.bits();
    let target = OpenOptions::new()
        .append(true)
        .custom_flags(flags)
        .open(path)?;
    let mut flags = nix::fcntl::OFlag::from_bits_truncate(nix::fcntl::fcntl(
        &target,
        nix::fcntl::FcntlArg::F_GETFL,
    )?);
    flags.remove(nix::fcntl::OFlag::O_NONBLOCK);
    nix::fcntl::fcntl(&target, nix::fcntl::FcntlArg::F_SETFL(flags))?;
    (&target).write_all(text.as_bytes())
}

#[cfg(not(unix))]
fn append(path: &Path, text: &str) -> io::Result<()> {
    let mut target = OpenOptions::new().append(true).open(path)?;
    target.write_all(text.as_bytes())
}

fn replace_file(path: &Path, text: &str, found: &Metadata) -> io::Result<()> {
    let target = fs::canonicalize(path)?;
    let part = TemporaryFile::write(&target, text, PartMode::Of(found))?;
    fs::rename(&part.path, &target)
}

/// Writes a new file; one that has appeared in the meantime is replaced.
fn put_file(path: &Path, text: &str, mode: u32) -> io::Result<()> {
    let target = end_of_links(path)?;
    let part = TemporaryFile::write(&target, text, PartMode::New(mode))?;
    fs::rename(&part.path, &target)
}

/// Writes a new file; one that has appeared in the meantime stays.
fn create_file(path: &Path, text: &str, mode: u32) -> io::Result<()> {
    let target = end_of_links(path)?;
    let part = TemporaryFile::write(&target, text, PartMode::New(mode))?;
    give_new_name(&part.path, &target)
}

/// The target of a dangling link; any other path unchanged.
fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    let mut end = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&end) {
            Ok(leads_to) => end = end.parent().unwrap_or(Path::new("")).join(leads_to),
            Err(_) => return Ok(end),
        }
    }
    Err(io::Error::other("too many links follow one another"))
}

/// The mode of a part file.
#[derive(Clone, Copy)]
enum PartMode<'a> {
    /// Mode and owner of the file that it will replace.
    Of(&'a Metadata),
    /// These bits, reduced by the umask.
    New(u32),
}

/// A temporary file beside the target, removed when it is no longer needed.
struct TemporaryFile {
    path: PathBuf,
}

impl TemporaryFile {
    /// Writes the text to a new file beside the target.
    fn write(target: &Path, text: &str, mode: PartMode<'_>) -> io::Result<Self> {
        let Some(name) = target.file_name() else {
            return Err(io::ErrorKind::IsADirectory.into());
        };
        let mut beside = OsStr::new(".").to_owned();
        beside.push(name);
        beside.push(format!(".{}.part", std::process::id()));
        let path = target.with_file_name(beside);
        // Removes what a killed program left; a link planted there must not be followed.
        drop(fs::remove_file(&path));
        let mut file = new_file(&path, mode)?;
        let part = Self { path };
        file.write_all(text.as_bytes())?;
        file.sync_all()?;
        Ok(part)
    }
}

impl Drop for TemporaryFile {
    /// Removes the part, unless it has become the file.
    fn drop(&mut self) {
        drop(fs::remove_file(&self.path));
    }
}

/// A new file that is never more accessible than the one it will replace.
#[cfg(unix)]
fn new_file(path: &Path, mode: PartMode<'_>) -> io::Result<File> {
    use std::os::unix::fs::{MetadataExt as _, OpenOptionsExt as _, fchown};

    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    let replaced = match mode {
        PartMode::New(mode) => return options.mode(mode).open(path),
        PartMode::Of(replaced) => replaced,
    };
    let file = options.mode(0o600).open(path)?;
    // Only the superuser can change the owner; otherwise the new file belongs to this user.
    drop(fchown(&file, Some(replaced.uid()), Some(replaced.gid())));
    file.set_permissions(replaced.permissions())?;
    Ok(file)
}

#[cfg(not(unix))]
fn new_file(path: &Path, _: PartMode<'_>) -> io::Result<File> {
    OpenOptions::new().write(true).create_new(true).open(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().expect("a folder")
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("readable").flatten();
        let mut names: Vec<String> = entries
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[cfg(unix)]
    mod unix {
        use std::os::unix::fs::{PermissionsExt as _, symlink};
        use std::process::Command;
        use std::thread;

        use super::*;

        #[test]
        fn a_link_stays_and_its_target_keeps_its_mode() {
            let folder = folder();
            let (target, link) = (folder.path().join("target"), folder.path().join("link"));
            fs::write(&target, "old").expect("written");
            fs::set_permissions(&target, fs::Permissions::from_mode(0o640)).expect("ours");
            symlink("target", &link).expect("made");
            write(&link, "new", true).expect("written");
            assert!(link.is_symlink());
            assert_eq!(fs::read_to_string(&target).expect("readable"), "new");
            let mode = fs::metadata(&target).expect("there").permissions().mode();
            assert_eq!(mode & 0o777, 0o640);
            assert_eq!(names(folder.path()), ["link", "target"]);
        }

        #[test]
        fn results_are_for_their_trainee_alone_unless_a_group_may_read_them() {
            let folder = folder();
            for (readers, expected) in [(Readers::Owner, 0o600), (Readers::Group, 0o640)] {
                let path = folder.path().join(format!("{readers:?}"));
                write_output(&path, "text", readers).expect("written");
                let mode = fs::metadata(&path).expect("there").permissions().mode();
                assert_eq!(mode & 0o777, expected);
            }
        }

        /// Only the superuser can give a file away.
        #[test]
        fn a_file_that_is_replaced_keeps_its_owner() {
            use std::os::unix::fs::{MetadataExt as _, chown};

            let folder = folder();
            let path = folder.path().join("report");
            write(&path, "old", true).expect("written");
            if chown(&path, Some(12_345), Some(12_346)).is_err() {
                return;
            }
            write_output(&path, "new", Readers::Owner).expect("written");
            let found = fs::metadata(&path).expect("there");
            assert_eq!((found.uid(), found.gid()), (12_345, 12_346));
            assert_eq!(fs::read_to_string(&path).expect("readable"), "new");
        }

        #[test]
        fn a_link_to_a_file_that_is_not_there_yet_makes_it() {
            let folder = folder();
            let link = folder.path().join("link");
            symlink("target", &link).expect("made");
            write(&link, "new", false).expect("written");
            assert!(link.is_symlink());
            assert_eq!(fs::read_to_string(&link).expect("readable"), "new");
        }

        #[test]
        fn a_device_is_written_into() {
            let folder = folder();
            let link = folder.path().join("null");
            symlink("/dev/null", &link).expect("made");
            write(&link, "text", true).expect("it takes everything");
            assert!(link.is_symlink());
            assert_eq!(names(folder.path()), ["null"]);
        }

        #[test]
        #[cfg(target_os = "linux")]
        fn a_device_that_is_full_is_an_error() {
            let folder = folder();
            let full = folder.path().join("full");
            symlink("/dev/full", &full).expect("made");
            let error = write(&full, "text", true).expect_err("it takes nothing");
            assert!(matches!(error, StoreError::Unwritable { .. }));
            assert_eq!(names(folder.path()), ["full"]);
        }

        #[test]
        #[cfg(target_os = "linux")]
        fn a_file_in_memory_is_a_file() {
            let Ok(folder) = tempfile::tempdir_in("/dev/shm") else {
                return;
            };
            let path = folder.path().join("report");
            write(&path, "first", true).expect("written");
            write(&path, "again", true).expect("written");
            assert_eq!(fs::read_to_string(&path).expect("readable"), "again");
            write(&path, "not", false).expect_err("it is there");
        }

        #[test]
        fn a_link_to_a_link_leads_to_the_new_file() {
            let folder = folder();
            let (one, two) = (folder.path().join("one"), folder.path().join("two"));
            symlink("two", &one).expect("made");
            symlink("three", &two).expect("made");
            write(&one, "text", false).expect("written");
            assert_eq!(names(folder.path()), ["one", "three", "two"]);
        }

        #[test]
        fn a_fifo_without_a_reader_holds_up_nothing() {
            let folder = folder();
            let fifo = folder.path().join("fifo");
            let made = Command::new("mkfifo").arg(&fifo).status().expect("it runs");
            assert!(made.success());
            write(&fifo, "text", true).expect_err("nothing reads it");
        }

        #[test]
        fn the_reader_of_a_fifo_gets_the_text() {
            let folder = folder();
            let fifo = folder.path().join("fifo");
            let made = Command::new("mkfifo").arg(&fifo).status().expect("it runs");
            assert!(made.success());
            let reader = {
                let fifo = fifo.clone();
                thread::spawn(move || fs::read_to_string(fifo).expect("readable"))
            };
            // Without a reader, writing fails.
            while write(&fifo, "text", true).is_err() {
                thread::yield_now();
            }
            assert_eq!(reader.join().expect("it ends"), "text");
        }
    }
}
