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
/// A link stays a link; its target is written. A file that is replaced keeps its mode, and its
/// owner if the system allows it. Anything that is not a regular file (a device, a FIFO) is written
/// to; a FIFO needs a reader.
///
/// # Errors
/// The file cannot be written, or it exists already and must not be replaced.
pub fn write(path: &Path, text: &str, replace: bool) -> Result<(), StoreError> {
    write_with_mode(path, text, replace, PUBLIC)
}

fn write_with_mode(path: &Path, text: &str, replace: bool, mode: u32) -> Result<(), StoreError> {
    let written = match present(path) {
        Ok(Some(found)) if found.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(Some(found)) if leads_on(path, &found) => {
            appending(path).and_then(|mut target| target.write_all(text.as_bytes()))
        }
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
        _ => unwritable(path, error),
    })
}

/// Writes results of a trainee: `-` is standard output, an existing file is replaced. `readers`
/// determines who may read a new file.
///
/// # Errors
/// The output cannot be written.
pub fn write_output(path: &Path, text: &str, readers: Readers) -> Result<(), StoreError> {
    if !is_standard_output(path) {
        let mode = match readers {
            Readers::Owner => 0o600,
            Readers::Group => 0o640,
        };
        return write_with_mode(path, text, true, mode);
    }
    print(text).map_err(|error| unwritable(path, error))
}

/// Writes a text to an output that must not exist yet: `-` is standard output, and a device or a
/// FIFO is written to.
///
/// # Errors
/// The output cannot be written, or it exists already.
pub fn write_new_output(path: &Path, text: &str) -> Result<(), StoreError> {
    if is_standard_output(path) {
        return print(text).map_err(|error| unwritable(path, error));
    }
    write(path, text, false)
}

/// Whether a path stands for a stream: standard output (`-`), a device, a FIFO or an open file.
pub fn is_stream(path: &Path) -> bool {
    let is_other = |found: &Metadata| leads_on(path, found) && !found.is_dir();
    is_standard_output(path) || matches!(present(path), Ok(Some(found)) if is_other(&found))
}

/// Opens the stream that a path stands for; `None` if it stands for none.
///
/// # Errors
/// The stream cannot be opened: a FIFO without a reader, for example.
pub fn open_stream(path: &Path) -> Result<Option<Box<dyn io::Write>>, StoreError> {
    if is_standard_output(path) {
        return Ok(Some(Box::new(io::stdout())));
    }
    if !is_stream(path) {
        return Ok(None);
    }
    match appending(path) {
        Ok(target) => Ok(Some(Box::new(target))),
        Err(error) => Err(unwritable(path, error)),
    }
}

fn is_standard_output(path: &Path) -> bool {
    path == Path::new(STANDARD_OUTPUT)
}

/// Whether an existing path is not a regular file, or names an open file.
fn leads_on(path: &Path, found: &Metadata) -> bool {
    !found.is_file() || links::is_open_file(path)
}

fn print(text: &str) -> io::Result<()> {
    let mut output = io::stdout().lock();
    output.write_all(text.as_bytes())?;
    output.flush()
}

fn unwritable(path: &Path, error: io::Error) -> StoreError {
    StoreError::Unwritable {
        path: path.to_owned(),
        error,
    }
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
fn appending(path: &Path) -> io::Result<File> {
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
    Ok(target)
}

#[cfg(not(unix))]
fn appending(path: &Path) -> io::Result<File> {
    OpenOptions::new().append(true).open(path)
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

/// The path to which the links at the end of a path lead, whether it exists or not; a path that is
/// no link is unchanged.
///
/// # Errors
/// Too many links follow one another.
pub fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    let mut end = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&end) {
            Ok(leads_to) => end = end.parent().unwrap_or(Path::new("")).join(leads_to),
            Err(_) => return Ok(end),
        }
    }
    Err(io::Error::other("too many links follow one another"))
}

/// The mode of a temporary file.
#[derive(Clone, Copy)]
enum PartMode<'a> {
    /// The mode and the owner of the file to be replaced.
    Of(&'a Metadata),
    /// These bits, reduced by the umask.
    New(u32),
}

/// A temporary file beside the target, removed when it is no longer needed.
struct TemporaryFile {
    path: PathBuf,
}

impl TemporaryFile {
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
    /// Removes the temporary file, unless it has become the target.
    fn drop(&mut self) {
        drop(fs::remove_file(&self.path));
    }
}

/// A new file that is never more accessible than the file that it will replace.
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
mod tests;
