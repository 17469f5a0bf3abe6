//! The readers of a trainee's results: the trainee alone, or also a group.
//!
//! The data folder's mode decides: if its group may read it and its set-group-ID bit is set, its
//! files are readable by the group, in folders of the same kind.

use std::fs::{self, DirBuilder, File, OpenOptions, Permissions};
use std::io;
use std::os::unix::fs::{
    DirBuilderExt as _, MetadataExt as _, OpenOptionsExt as _, PermissionsExt as _,
};
use std::path::{Path, PathBuf};

use super::links;
use crate::config::Readers;

/// The file with the signing keys, which is never shared.
pub(super) const KEY_FILE: &str = "signing.toml";
/// The mode bits of a shared folder: set-group-ID, and read and execute for the group.
const SHARED_FOLDER: u32 = 0o2050;
/// The mode bit of a file in a shared folder: read for the group.
const SHARED_FILE: u32 = 0o040;

/// The folder of recorded runs in a data folder.
pub const RUNS: &str = "runs";
/// The beginning of the names of the profiles' database, its journals and its copies.
const PROFILES: &str = "profiles.sqlite";

/// Lets the group of a data folder read the results in it: profiles and recorded runs. Creates the
/// folder if needed. Other files are not changed, because the folder may hold more than results.
///
/// # Errors
/// The folder cannot be created, or belongs to another user.
pub fn share_with_group(data: &Path) -> io::Result<()> {
    private_folder(data)?;
    allow(data, SHARED_FOLDER)?;
    results(data).iter().try_for_each(|path| share(path))
}

/// Lets the group read a file, or a folder and everything in it; links are not followed.
fn share(path: &Path) -> io::Result<()> {
    let kind = fs::symlink_metadata(path)?.file_type();
    if kind.is_file() {
        return allow(path, SHARED_FILE);
    }
    if kind.is_dir() {
        allow(path, SHARED_FOLDER)?;
        for entry in fs::read_dir(path)? {
            share(&entry?.path())?;
        }
    }
    Ok(())
}

/// The files and folders of a data folder that hold results.
fn results(data: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(data).into_iter().flatten().flatten();
    let is_result = |entry: &fs::DirEntry| {
        let name = entry.file_name();
        name == RUNS || name.to_string_lossy().starts_with(PROFILES)
    };
    entries
        .filter(is_result)
        .map(|entry| entry.path())
        .collect()
}

/// A difference between the configured readers and those that the modes of a data folder allow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SharingFault {
    /// The settings let the group read, but the folder, or one of the results in it, lacks the mode
    /// for it. The kernel drops a set-group-ID bit silently if the folder's owner is not in its
    /// group.
    NotShared,
    /// The settings let the group read, but this many files and folders belong to another group.
    OtherGroup(usize),
    /// The settings let only the owner read, but the group still can.
    StillShared,
}

/// Compares the configured readers with the modes of an existing data folder; `None` if they agree.
pub fn sharing_fault(data: &Path, readers: Readers) -> Option<SharingFault> {
    let facts = fs::metadata(data).ok()?;
    let mode = facts.permissions().mode();
    match readers {
        Readers::Group if !is_shared(data) || count_results(data, &is_closed) > 0 => {
            Some(SharingFault::NotShared)
        }
        Readers::Group => match count_results(data, &|it| it.gid() != facts.gid()) {
            0 => None,
            count => Some(SharingFault::OtherGroup(count)),
        },
        Readers::Owner => {
            let is_readable = |it: &fs::Metadata| it.permissions().mode() & SHARED_FILE != 0;
            let is_open = mode & 0o010 != 0;
            let is_read = is_shared(data) || (is_open && count_results(data, &is_readable) > 0);
            is_read.then_some(SharingFault::StillShared)
        }
    }
}

/// Whether a file or folder lacks the mode of its kind in a shared folder.
fn is_closed(facts: &fs::Metadata) -> bool {
    let needed = if facts.is_dir() {
        SHARED_FOLDER
    } else {
        SHARED_FILE
    };
    facts.permissions().mode() & needed != needed
}

/// The number of results in a data folder, files and folders, that have a property.
fn count_results(data: &Path, is_so: &dyn Fn(&fs::Metadata) -> bool) -> usize {
    results(data).iter().map(|path| count(path, is_so)).sum()
}

/// The number of files and folders at this path and below it that have a property; links are not
/// followed.
fn count(path: &Path, is_so: &dyn Fn(&fs::Metadata) -> bool) -> usize {
    match fs::symlink_metadata(path) {
        Ok(facts) if facts.is_dir() => {
            let entries = fs::read_dir(path).into_iter().flatten().flatten();
            let below: usize = entries.map(|entry| count(&entry.path(), is_so)).sum();
            below + usize::from(is_so(&facts))
        }
        Ok(facts) if facts.is_file() => usize::from(is_so(&facts)),
        Ok(_) | Err(_) => 0,
    }
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

/// Opens a file for writing with these options; a new file gets the readers of its folder.
///
/// # Errors
/// The file cannot be opened.
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
        made(&data.join("profiles.sqlite"));
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
        assert_eq!(count_results(&data, &|_| true), 1);
    }

    /// The kernel drops the bit where the owner is not in the group of the folder.
    #[test]
    fn a_folder_of_runs_without_its_set_group_id_bit_is_not_shared() {
        let home = tempfile::tempdir().expect("a folder");
        let data = home.path().join("data");
        share_with_group(&data).expect("ours");
        folder_within(&data, &data.join(RUNS)).expect("made");
        assert_eq!(sharing_fault(&data, Readers::Group), None);
        let closed = Permissions::from_mode(0o750);
        fs::set_permissions(data.join(RUNS), closed).expect("ours");
        let fault = sharing_fault(&data, Readers::Group);
        assert_eq!(fault, Some(SharingFault::NotShared));
    }

    #[test]
    fn files_that_are_no_results_keep_their_modes() {
        let home = tempfile::tempdir().expect("a folder");
        private_folder(&home.path().join(".ssh")).expect("made");
        for name in ["notes", ".ssh/id", KEY_FILE] {
            made(&home.path().join(name));
        }
        share_with_group(home.path()).expect("ours");
        let modes =
            [".ssh", "notes", ".ssh/id", KEY_FILE].map(|name| mode(&home.path().join(name)));
        assert_eq!(modes, [0o700, 0o600, 0o600, 0o600]);
    }

    #[test]
    fn what_is_in_a_shared_folder_is_shared_and_nothing_else() {
        let home = tempfile::tempdir().expect("a folder");
        let data = home.path().join("data");
        let (early, late) = (data.join("profiles.sqlite"), data.join("runs/late"));
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
