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

use nix::unistd::{Uid, User, geteuid};

use super::links;
use crate::config::Readers;
use crate::text;
use crate::text::Text;

/// The file with the signing keys, which is never shared.
pub(super) const KEY_FILE: &str = "signing.toml";
/// The mode bits of a shared folder: set-group-ID, and read and execute for the group.
const SHARED_FOLDER: u32 = 0o2050;
/// The mode bit of a file in a shared folder: read for the group.
const SHARED_FILE: u32 = 0o040;

/// The folder of recorded runs in a data folder.
pub const RUNS: &str = "runs";
/// The beginning of the names of the profiles' database, its journals and its copies.
pub const PROFILES_FILE: &str = "profiles.sqlite";

/// A file or folder that could not be shared with the group.
#[derive(Debug)]
pub struct Unshared {
    pub path: PathBuf,
    pub error: io::Error,
}

impl From<&Unshared> for Text {
    fn from(unshared: &Unshared) -> Self {
        let Unshared { path, error } = unshared;
        let shown = path.display().to_string();
        match other_owner(path) {
            Some(owner) => text!("sharing-foreign", path = shown, owner = owner),
            None if error.kind() == GROUP_BIT_DROPPED => text!("sharing-group-bit", path = shown),
            None => text!("sharing-failed", path = shown, error = Text::from(error)),
        }
    }
}

/// Lets the group of a data folder read the results in it: profiles and recorded runs. Creates the
/// folder if needed. Other files are not changed, because the folder may hold more than results,
/// and nothing in the unshared folder of another user is. Returns what could not be shared; the
/// rest is.
pub fn share_with_group(data: &Path) -> Vec<Unshared> {
    share_by(data, &allow_all)
}

/// The kind of error of a set-group-ID bit that the kernel drops silently, because the folder's
/// owner is not in its group.
const GROUP_BIT_DROPPED: io::ErrorKind = io::ErrorKind::Unsupported;

/// Adds missing bits to the mode of a path, and checks that they are set.
fn allow_all(path: &Path, bits: u32) -> io::Result<()> {
    allow(path, bits)?;
    let mode = fs::metadata(path)?.permissions().mode();
    if mode & bits == bits {
        Ok(())
    } else {
        Err(GROUP_BIT_DROPPED.into())
    }
}

/// Adds bits to the mode of a path.
type Allow<'a> = &'a dyn Fn(&Path, u32) -> io::Result<()>;

fn share_by(data: &Path, allow: Allow<'_>) -> Vec<Unshared> {
    let mut unshared = Vec::new();
    if let Err(error) = private_folder(data).and_then(|()| allow(data, SHARED_FOLDER)) {
        if other_owner(data).is_some() {
            return unshared;
        }
        let path = data.to_owned();
        unshared.push(Unshared { path, error });
    }
    for path in results(data) {
        share(&path, allow, &mut unshared);
    }
    unshared
}

/// Lets the group read a file, or a folder and everything in it; links are not followed.
fn share(path: &Path, allow: Allow<'_>, unshared: &mut Vec<Unshared>) {
    let shared = fs::symlink_metadata(path).and_then(|facts| {
        if facts.is_file() {
            return allow(path, SHARED_FILE);
        }
        if facts.is_dir() {
            let allowed = allow(path, SHARED_FOLDER);
            for entry in fs::read_dir(path)? {
                share(&entry?.path(), allow, unshared);
            }
            return allowed;
        }
        Ok(())
    });
    match shared {
        // A file that is gone by now, such as a log of the database, needs no readers.
        Err(error) if error.kind() != io::ErrorKind::NotFound => unshared.push(Unshared {
            path: path.to_owned(),
            error,
        }),
        _ => {}
    }
}

/// The name of the owner of a file or folder, or the user id if it has no name; `None` if this user
/// owns it.
pub fn other_owner(path: &Path) -> Option<String> {
    let owner = Uid::from_raw(fs::metadata(path).ok()?.uid());
    let named = || User::from_uid(owner).ok().flatten().map(|user| user.name);
    (owner != geteuid()).then(|| named().unwrap_or_else(|| format!("user {owner}")))
}

/// The files and folders of a data folder that hold results.
fn results(data: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(data).into_iter().flatten().flatten();
    let is_result = |entry: &fs::DirEntry| {
        let name = entry.file_name();
        name == RUNS || name.to_string_lossy().starts_with(PROFILES_FILE)
    };
    entries
        .filter(is_result)
        .map(|entry| entry.path())
        .collect()
}

/// A difference between the configured readers and those that the modes of a data folder allow.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SharingFault {
    /// The group may read, but cannot read these results of another user than the folder's owner, who alone may
    /// change that.
    Foreign(Vec<PathBuf>),
    /// The group may read, but the folder, or one of the results in it, lacks the mode for it. The
    /// kernel drops a set-group-ID bit silently if the folder's owner is not in its group.
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
        Readers::Group if !is_shared(data) => Some(SharingFault::NotShared),
        Readers::Group if found_results(data, &is_closed).next().is_some() => {
            let is_foreign = |it: &fs::Metadata| is_closed(it) && it.uid() != facts.uid();
            let foreign: Vec<PathBuf> = found_results(data, &is_foreign).collect();
            Some(if foreign.is_empty() {
                SharingFault::NotShared
            } else {
                SharingFault::Foreign(foreign)
            })
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

/// The results in a data folder, files and folders, that have a property.
fn found_results(
    data: &Path,
    is_so: &dyn Fn(&fs::Metadata) -> bool,
) -> impl Iterator<Item = PathBuf> {
    let mut found = Vec::new();
    for path in results(data) {
        find(&path, is_so, &mut found);
    }
    found.sort();
    found.into_iter()
}

/// The number of results in a data folder, files and folders, that have a property.
fn count_results(data: &Path, is_so: &dyn Fn(&fs::Metadata) -> bool) -> usize {
    found_results(data, is_so).count()
}

/// Adds the files and folders from this one down that have a property; links are not followed.
fn find(path: &Path, is_so: &dyn Fn(&fs::Metadata) -> bool, found: &mut Vec<PathBuf>) {
    let Ok(facts) = fs::symlink_metadata(path) else {
        return;
    };
    if (facts.is_dir() || facts.is_file()) && is_so(&facts) {
        found.push(path.to_owned());
    }
    if facts.is_dir() {
        let entries = fs::read_dir(path).into_iter().flatten().flatten();
        entries.for_each(|entry| find(&entry.path(), is_so, found));
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

/// Whether the group of a folder may read it, but new files in it do not get that group.
pub(super) fn lacks_only_the_group_bit(folder: &Path) -> bool {
    const FOR_GROUP: u32 = 0o050;
    let facts = fs::metadata(folder);
    facts.is_ok_and(|facts| facts.permissions().mode() & SHARED_FOLDER == FOR_GROUP)
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

    fn shared(data: &Path) {
        let unshared = share_with_group(data);
        assert!(unshared.is_empty(), "{unshared:?}");
    }

    /// A file that belongs to another user; `None` if this user may not give files away.
    fn given_away(path: &Path) -> Option<()> {
        made(path);
        std::os::unix::fs::chown(path, Some(65_534), None).ok()
    }

    /// The superuser may change the modes of all files, so only the finding is tested with it.
    #[test]
    fn results_of_another_user_are_found_by_name() {
        let home = tempfile::tempdir().expect("a folder");
        let data = home.path().join("data");
        shared(&data);
        folder_within(&data, &data.join(RUNS)).expect("made");
        let foreign = data.join("runs/foreign");
        if given_away(&foreign).is_none() {
            return;
        }
        assert_eq!(sharing_fault(&data, Readers::Group), None);
        fs::set_permissions(&foreign, Permissions::from_mode(0o600)).expect("the superuser may");
        let fault = sharing_fault(&data, Readers::Group);
        assert_eq!(fault, Some(SharingFault::Foreign(vec![foreign])));
    }

    #[test]
    fn what_cannot_be_shared_does_not_keep_the_rest_from_being_shared() {
        let home = tempfile::tempdir().expect("a folder");
        let data = home.path().join("data");
        private_folder(&data.join(RUNS)).expect("made");
        for name in ["a", "c"] {
            made(&data.join(RUNS).join(name));
        }
        // The superuser, as whom tests may run, could change the mode of any file.
        let refused = data.join(RUNS).join("b");
        made(&refused);
        let unshared = share_by(&data, &|path, bits| {
            if path == refused {
                return Err(io::ErrorKind::PermissionDenied.into());
            }
            allow(path, bits)
        });
        let named: Vec<&PathBuf> = unshared.iter().map(|it| &it.path).collect();
        assert_eq!(named, [&refused]);
        let modes = ["a", "c"].map(|name| mode(&data.join(RUNS).join(name)));
        assert_eq!(modes, [0o640, 0o640]);
    }

    #[test]
    fn what_is_not_shared_is_named_with_its_owner() {
        let unshared = |path: &str| {
            let path = PathBuf::from(path);
            let error = io::ErrorKind::PermissionDenied.into();
            Text::from(&Unshared { path, error }).to_string()
        };
        let owner = other_owner(Path::new("/proc/1"));
        let said = unshared("/proc/1");
        match owner {
            Some(owner) => assert!(said.contains(&format!("belongs to {owner}")), "{said}"),
            None => assert!(said.contains("permission denied"), "{said}"),
        }
        let path = PathBuf::from("/tmp/none");
        let error = GROUP_BIT_DROPPED.into();
        let said = Text::from(&Unshared { path, error }).to_string();
        assert!(said.contains("only root can set the setgid bit"), "{said}");
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
        shared(&data);
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
        shared(&data);
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
        shared(home.path());
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
        shared(&data);
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
