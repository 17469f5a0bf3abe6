//! The readers of a trainee's results: the trainee alone, or also a group.
//!
//! The data folder's mode decides: if its group may read it and its set-group-ID bit is set, its
//! files are readable by the group, in folders of the same kind.

use std::fs::{self, DirBuilder, File, OpenOptions, Permissions};
use std::io;
use std::os::unix::fs::{
    DirBuilderExt as _, MetadataExt as _, OpenOptionsExt as _, PermissionsExt as _,
};
use std::path::Path;

use super::links;
use crate::config::Readers;

/// The file with the signing keys, which is never shared.
pub(super) const KEY_FILE: &str = "signing.toml";
/// The mode bits of a shared folder: set-group-ID, and read and execute for the group.
const SHARED_FOLDER: u32 = 0o2050;
/// The mode bit of a file in a shared folder: read for the group.
const SHARED_FILE: u32 = 0o040;

/// Lets the group of a data folder read everything in it but the signing keys; creates the folder if needed.
///
/// # Errors
/// The folder cannot be created, or belongs to another user.
pub fn share_with_group(data: &Path) -> io::Result<()> {
    private_folder(data)?;
    allow(data, SHARED_FOLDER)?;
    for entry in fs::read_dir(data)? {
        let entry = entry?;
        let kind = entry.file_type()?;
        if kind.is_dir() {
            share_with_group(&entry.path())?;
        } else if kind.is_file() && entry.file_name() != KEY_FILE {
            allow(&entry.path(), SHARED_FILE)?;
        }
    }
    Ok(())
}

/// A difference between the configured readers and those that the modes of a data folder allow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SharingFault {
    /// The group may read, but the folder lacks the mode for it. The kernel drops a set-group-ID bit silently if the
    /// folder's owner is not in its group.
    NotShared,
    /// The group may read, but this many files and folders belong to another group.
    OtherGroup(usize),
    /// Only the owner may read, but the group still can.
    StillShared,
}

/// Compares the configured readers with the modes of an existing data folder; `None` if they agree.
pub fn sharing_fault(data: &Path, readers: Readers) -> Option<SharingFault> {
    let facts = fs::metadata(data).ok()?;
    let mode = facts.permissions().mode();
    match readers {
        Readers::Group if !is_shared(data) => Some(SharingFault::NotShared),
        Readers::Group => match count_below(data, &|it| it.gid() != facts.gid()) {
            0 => None,
            count => Some(SharingFault::OtherGroup(count)),
        },
        Readers::Owner => {
            let is_readable = |it: &fs::Metadata| it.permissions().mode() & SHARED_FILE != 0;
            let is_open = mode & 0o010 != 0;
            let is_read = is_shared(data) || (is_open && count_below(data, &is_readable) > 0);
            is_read.then_some(SharingFault::StillShared)
        }
    }
}

/// The number of files and folders below a folder with a property; links are not followed.
fn count_below(folder: &Path, is_so: &dyn Fn(&fs::Metadata) -> bool) -> usize {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let count = |entry: fs::DirEntry| match entry.metadata() {
        Ok(facts) if facts.is_dir() => {
            usize::from(is_so(&facts)) + count_below(&entry.path(), is_so)
        }
        Ok(facts) if facts.is_file() => usize::from(is_so(&facts)),
        Ok(_) | Err(_) => 0,
    };
    entries.map(count).sum()
}

/// Creates a folder, and those above it, for its owner alone.
///
/// # Errors
/// It cannot be created.
pub(super) fn private_folder(path: &Path) -> io::Result<()> {
    DirBuilder::new().recursive(true).mode(0o700).create(path)
}

/// Creates a folder inside another, with the same readers.
///
/// # Errors
/// It cannot be created.
pub(super) fn folder_within(above: &Path, path: &Path) -> io::Result<()> {
    if !is_shared(above) {
        return private_folder(path);
    }
    // The folder inherits the group and the set-group-ID bit, which an owner outside the group
    // could not set afterwards.
    DirBuilder::new().recursive(true).mode(0o750).create(path)?;
    allow(path, SHARED_FOLDER)
}

/// Opens a file for writing with these options; a new one gets the readers of its folder.
///
/// # Errors
/// It cannot be opened.
pub(super) fn open(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    let file = links::open_own(options.mode(0o600), path)?;
    let folder = path.parent().filter(|it| !it.as_os_str().is_empty());
    if is_shared(folder.unwrap_or(Path::new("."))) {
        allow(path, SHARED_FILE)?;
    }
    Ok(file)
}

fn is_shared(folder: &Path) -> bool {
    let facts = fs::metadata(folder);
    facts.is_ok_and(|facts| facts.permissions().mode() & SHARED_FOLDER == SHARED_FOLDER)
}

/// Adds missing bits to the mode of a path.
fn allow(path: &Path, bits: u32) -> io::Result<()> {
    let mode = fs::metadata(path)?.permissions().mode();
    if mode & bits == bits {
        return Ok(());
    }
    fs::set_permissions(path, Permissions::from_mode(mode | bits))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mode(path: &Path) -> u32 {
        let facts = fs::metadata(path).expect("it is there");
        facts.permissions().mode() & 0o7777
    }

    fn made(path: &Path) {
        let mut options = OpenOptions::new();
        open(options.create(true).append(true), path).expect("made");
    }

    #[test]
    fn modes_that_differ_from_the_readers_set_are_found() {
        let home = tempfile::tempdir().expect("a folder");
        let data = home.path().join("data");
        let fault = |readers| sharing_fault(&data, readers);
        assert_eq!(fault(Readers::Group), None, "it does not exist yet");
        private_folder(&data).expect("made");
        made(&data.join("early"));
        assert_eq!(fault(Readers::Owner), None);
        assert_eq!(fault(Readers::Group), Some(SharingFault::NotShared));
        share_with_group(&data).expect("ours");
        assert_eq!(fault(Readers::Group), None);
        assert_eq!(fault(Readers::Owner), Some(SharingFault::StillShared));
        let closed = |bits| fs::set_permissions(&data, Permissions::from_mode(bits)).expect("ours");
        // The folder hides files whose modes are still open.
        closed(0o700);
        assert_eq!(fault(Readers::Owner), None);
        closed(0o750);
        assert_eq!(fault(Readers::Owner), Some(SharingFault::StillShared));
        assert_eq!(count_below(&data, &|_| true), 1);
    }

    #[test]
    fn what_is_in_a_shared_folder_is_shared_and_nothing_else() {
        let home = tempfile::tempdir().expect("a folder");
        let data = home.path().join("data");
        let (early, late) = (data.join("early"), data.join("runs/late"));
        private_folder(&data).expect("made");
        made(&early);
        assert_eq!((mode(&data), mode(&early)), (0o700, 0o600));
        share_with_group(&data).expect("ours");
        assert_eq!((mode(&data), mode(&early)), (0o2750, 0o640));
        folder_within(&data, &data.join("runs")).expect("made");
        made(&late);
        assert_eq!((mode(&data.join("runs")), mode(&late)), (0o2750, 0o640));
        // Not every folder readable for a group is meant to be shared.
        let other = home.path().join("other");
        private_folder(&other).expect("made");
        allow(&other, 0o055).expect("ours");
        made(&other.join("file"));
        assert_eq!(mode(&other.join("file")), 0o600);
    }
}
