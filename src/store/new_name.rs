//! Naming finished files without replacing another file, also on file systems without hard links.

use std::fs::{self, OpenOptions};
use std::io;
use std::path::Path;

/// Creates a hard link; file systems without them refuse it.
pub(super) type LinkFile = fn(&Path, &Path) -> io::Result<()>;

/// Renames a finished draft. Unlike [`fs::rename`], it never replaces a file that has that name,
/// even one that appears in the meantime. Where hard links exist, the draft also keeps its own
/// name, and the caller removes it.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`] if the name is taken, or another error if the folder cannot be
/// written.
pub fn give_new_name(draft: &Path, name: &Path) -> io::Result<()> {
    give_new_name_by(|from, to| fs::hard_link(from, to), draft, name)
}

pub(super) fn give_new_name_by(link: LinkFile, draft: &Path, name: &Path) -> io::Result<()> {
    match link(draft, name) {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => {}
        linked => return linked,
    }
    // An empty file of our own reserves the name first, so that the rename replaces nothing else.
    OpenOptions::new().write(true).create_new(true).open(name)?;
    let renamed = fs::rename(draft, name);
    if renamed.is_err() {
        drop(fs::remove_file(name));
    }
    renamed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn with_or_without_hard_links_no_file_is_replaced() {
        let refuse: LinkFile = |_, _| Err(io::ErrorKind::PermissionDenied.into());
        for link in [refuse, |from, to| fs::hard_link(from, to)] {
            let folder = tempfile::tempdir().expect("a folder");
            let [draft, name] = ["draft", "name"].map(|it| folder.path().join(it));
            fs::write(&draft, "first").expect("written");
            give_new_name_by(link, &draft, &name).expect("the name is free");
            fs::write(&draft, "second").expect("written");
            let taken = give_new_name_by(link, &draft, &name).expect_err("the name is taken");
            assert_eq!(taken.kind(), io::ErrorKind::AlreadyExists);
            assert_eq!(fs::read_to_string(&draft).expect("kept"), "second");
            let nowhere = folder.path().join("missing/name");
            assert!(give_new_name_by(link, &draft, &nowhere).is_err());
        }
    }

    #[test]
    fn without_hard_links_the_draft_becomes_the_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let [draft, name] = ["draft", "name"].map(|it| folder.path().join(it));
        fs::write(&draft, "text").expect("written");
        let refuse: LinkFile = |_, _| Err(io::ErrorKind::Unsupported.into());
        give_new_name_by(refuse, &draft, &name).expect("the name is free");
        assert_eq!(fs::read_to_string(&name).expect("there"), "text");
        assert!(!draft.exists());
    }
}
