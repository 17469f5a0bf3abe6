//! Symbolic links in paths that the program writes on its own: links of the user are followed,
//! those of others are not.
//!
//! In a folder writable by others, a link planted there could redirect a write into any of this
//! user's files.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::os::unix::fs::{MetadataExt as _, OpenOptionsExt as _};
use std::path::{Path, PathBuf};

use nix::fcntl::OFlag;

/// The maximum number of links in a chain, as in Linux.
const MOST_LINKS: usize = 40;
/// The superuser, whose links lead to devices such as `/dev/stderr`.
const ROOT: u32 = 0;

/// Opens a file with these options, through links of this user and of the superuser only.
///
/// # Errors
/// A link belongs to another user, too many follow one another, or the file cannot be opened.
pub fn open_own(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    if is_open_file(path) {
        return options.open(path);
    }
    let target = end_of_links(path, nix::unistd::geteuid().as_raw())?;
    // If a link replaces the target in the meantime, that is an error.
    let flags = OFlag::O_NOFOLLOW.bits();
    options.custom_flags(flags).open(target)
}

/// Whether a path names an open file, such as `/dev/stdout`, and not an entry of a folder.
pub(super) fn is_open_file(path: &Path) -> bool {
    let is_descriptor = path.parent().is_some_and(|folder| folder.ends_with("fd"));
    let is_standard = path == Path::new("/dev/stdout") || path == Path::new("/dev/stderr");
    is_standard || (is_descriptor && (path.starts_with("/dev") || path.starts_with("/proc")))
}

/// The target of the links at the end of a path, if all belong to this user or to the superuser.
fn end_of_links(path: &Path, user: u32) -> io::Result<PathBuf> {
    let mut end = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::symlink_metadata(&end) {
            Ok(facts) if facts.is_symlink() && ![user, ROOT].contains(&facts.uid()) => {
                let text = format!("{} is a link of another user", end.display());
                return Err(io::Error::new(io::ErrorKind::PermissionDenied, text));
            }
            Ok(facts) if facts.is_symlink() => {
                let leads_to = fs::read_link(&end)?;
                end = end.parent().unwrap_or(Path::new("")).join(leads_to);
            }
            Ok(_) | Err(_) => return Ok(end),
        }
    }
    Err(io::Error::other("too many links follow one another"))
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::{lchown, symlink};

    use super::*;

    /// A user id that is neither that of the superuser nor that of the tester.
    const OTHER: u32 = 65_533;

    #[test]
    fn only_links_of_the_user_and_of_the_superuser_are_followed() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let [target, near, far] = ["target", "near", "far"].map(|name| folder.path().join(name));
        fs::write(&target, "kept").expect("written");
        symlink("target", &near).expect("linked");
        symlink(&near, &far).expect("linked");
        let owner = fs::symlink_metadata(&near).expect("there").uid();
        assert_eq!(end_of_links(&far, owner).expect("ours"), target);
        // Only the superuser can change the owner of a link; otherwise the test checks the rule with the id of another
        // user.
        let is_given = lchown(&near, Some(OTHER), None).is_ok();
        let stranger = if is_given { owner } else { OTHER };
        let refused = end_of_links(&far, stranger).expect_err("a link of another user");
        assert_eq!(refused.kind(), io::ErrorKind::PermissionDenied);
        if is_given {
            let mut options = OpenOptions::new();
            assert!(open_own(options.write(true).truncate(true), &far).is_err());
            assert_eq!(fs::read_to_string(&target).expect("there"), "kept");
        }
    }

    #[test]
    fn links_in_a_circle_end() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let [one, two] = ["one", "two"].map(|name| folder.path().join(name));
        symlink(&two, &one).expect("linked");
        symlink(&one, &two).expect("linked");
        let mut options = OpenOptions::new();
        assert!(open_own(options.append(true), &one).is_err());
    }
}
