//! Whether a folder of the program can be written, and what to do if it cannot.

use std::path::Path;

use nix::errno::Errno;
use nix::unistd::{AccessFlags, access};

use super::HostFinding;
use crate::sitl::quoted;
use crate::store::other_owner;

/// With less free space than this, logs soon fill a disk: a flying instance writes about a megabyte a minute.
const LEAST_FREE_MIB: u64 = 512;

/// The use of a folder, on which the advice depends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FolderUse {
    /// Profiles and records, for which read access may be enough.
    Results,
    /// Files of this user alone.
    Files,
}

impl FolderUse {
    fn elsewhere(self) -> &'static str {
        match self {
            Self::Results => "set another folder with --data or SORTIE_DATA",
            Self::Files => "set another folder with the XDG variables",
        }
    }
}

/// A folder that cannot be written.
struct ClosedFolder<'a> {
    about: &'a str,
    path: &'a Path,
    used_for: FolderUse,
    /// The folder itself, or its nearest existing parent.
    there: &'a Path,
    error: Errno,
    /// The name of the existing folder's owner, if that is another user.
    owner: Option<String>,
    /// Whether the files in the existing folder can be read.
    is_readable: bool,
}

/// Whether a folder can be written, or created.
pub(super) fn folder(about: &str, path: &Path, used_for: FolderUse) -> HostFinding {
    // A missing folder is created when it is needed, so its nearest existing parent is checked.
    let there = path
        .ancestors()
        .find(|folder| folder.exists())
        .unwrap_or(Path::new("/"));
    let name = path.display();
    let made = if there == path {
        ""
    } else {
        " (created when needed)"
    };
    if !there.is_dir() {
        let mend = format!("move {} away: it is not a folder", there.display());
        return HostFinding::fault(about, format!("{name} cannot be created"), mend);
    }
    if let Err(error) = access(there, AccessFlags::W_OK | AccessFlags::X_OK) {
        let closed = ClosedFolder {
            about,
            path,
            used_for,
            there,
            error,
            owner: other_owner(there),
            is_readable: access(there, AccessFlags::R_OK | AccessFlags::X_OK).is_ok(),
        };
        return closed.finding();
    }
    match free_mib(there) {
        Some(free) if free < LEAST_FREE_MIB => HostFinding::note(
            about,
            format!("{name}{made}, {free} MiB free"),
            "free some space: records of flights, and logs of SITL if you use it, will soon fill it",
        ),
        Some(free) => HostFinding::ok(about, format!("{name}{made}, {} GiB free", free / 1024)),
        None => HostFinding::ok(about, format!("{name}{made}")),
    }
}

impl ClosedFolder<'_> {
    fn finding(&self) -> HostFinding {
        if self.there == self.path {
            self.existing()
        } else {
            self.missing()
        }
    }

    fn existing(&self) -> HostFinding {
        let (name, elsewhere) = (self.path.display(), self.used_for.elsewhere());
        let (state, access) = match (self.error, &self.owner) {
            (Errno::EROFS, _) => (
                "is mounted read-only".to_owned(),
                "mount it writable".to_owned(),
            ),
            (_, Some(owner)) => (
                format!("belongs to {owner}"),
                format!("ask {owner} for access"),
            ),
            (error, None) => {
                let found = format!("{name} cannot be written: {error}");
                let mend = format!("chmod u+wx {}, or {elsewhere}", shell_word(self.path));
                return HostFinding::fault(self.about, found, mend);
            }
        };
        if self.used_for == FolderUse::Results && self.is_readable {
            let found = format!("{name} {state}: results can be read only");
            return HostFinding::note(self.about, found, format!("to store results, {elsewhere}"));
        }
        let found = format!("{name} {state} and cannot be written");
        HostFinding::fault(self.about, found, format!("{access}, or {elsewhere}"))
    }

    fn missing(&self) -> HostFinding {
        let (name, elsewhere) = (self.path.display(), self.used_for.elsewhere());
        let there = self.there.display();
        let (found, mend) = match (self.error, &self.owner) {
            (Errno::EROFS, _) => (
                format!("{name} cannot be created: {there} is mounted read-only"),
                format!("mount {there} writable, or {elsewhere}"),
            ),
            (_, Some(owner)) if self.is_readable => (
                format!("{name} cannot be created: {there} belongs to {owner}"),
                format!("ask {owner} to create it for you, or {elsewhere}"),
            ),
            (_, Some(owner)) => (
                format!("{name} cannot be reached: {there} belongs to {owner}"),
                format!("ask {owner} for access, or {elsewhere}"),
            ),
            (error, None) => (
                format!("{name} cannot be created: {error}"),
                format!("chmod u+wx {}, or {elsewhere}", shell_word(self.there)),
            ),
        };
        HostFinding::fault(self.about, found, mend)
    }
}

/// A path in a command for a shell.
pub(super) fn shell_word(path: &Path) -> String {
    quoted(&path.display().to_string()).into_owned()
}

fn free_mib(path: &Path) -> Option<u64> {
    let facts = nix::sys::statvfs::statvfs(path).ok()?;
    Some(facts.blocks_available() * facts.fragment_size() / 1024 / 1024)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::CheckResult;
    use super::*;

    #[test]
    fn a_folder_is_judged_by_what_is_there_of_it() {
        let home = tempfile::tempdir().expect("a temporary folder");
        let within = home.path().join("a/b");
        let finding = folder("state", &within, FolderUse::Files);
        assert_ne!(finding.verdict, CheckResult::Fault);
        assert!(
            finding.found.contains("created when needed"),
            "{}",
            finding.found
        );
        fs::write(home.path().join("a"), "").expect("it is written");
        let finding = folder("state", &within, FolderUse::Files);
        assert_eq!(finding.verdict, CheckResult::Fault);
    }

    fn closed(there: &'static str, error: Errno, owner: Option<&str>) -> ClosedFolder<'static> {
        ClosedFolder {
            about: "data",
            path: Path::new("/srv/class/anna"),
            used_for: FolderUse::Results,
            there: Path::new(there),
            error,
            owner: owner.map(str::to_owned),
            is_readable: true,
        }
    }

    #[test]
    fn a_closed_folder_has_the_advice_that_helps() {
        let (own, above) = ("/srv/class/anna", "/srv/class");
        for (closed, verdict, found, mend) in [
            (
                closed(own, Errno::EROFS, None),
                CheckResult::Note,
                "/srv/class/anna is mounted read-only: results can be read only",
                "to store results, set another folder",
            ),
            (
                closed(own, Errno::EACCES, Some("anna")),
                CheckResult::Note,
                "/srv/class/anna belongs to anna: results can be read only",
                "to store results, set another folder",
            ),
            (
                closed(own, Errno::EACCES, None),
                CheckResult::Fault,
                "/srv/class/anna cannot be written: EACCES",
                "chmod u+wx /srv/class/anna, or",
            ),
            (
                closed(above, Errno::EACCES, Some("root")),
                CheckResult::Fault,
                "/srv/class/anna cannot be created: /srv/class belongs to root",
                "ask root to create it for you, or",
            ),
            (
                closed(above, Errno::EROFS, Some("root")),
                CheckResult::Fault,
                "/srv/class/anna cannot be created: /srv/class is mounted read-only",
                "mount /srv/class writable, or",
            ),
        ] {
            let finding = closed.finding();
            assert_eq!(finding.verdict, verdict, "{found}");
            assert!(finding.found.starts_with(found), "{}", finding.found);
            let advice = finding.mend.expect("advice");
            assert!(advice.starts_with(mend), "{advice}");
        }
    }

    #[test]
    fn a_folder_that_cannot_even_be_read_is_a_fault() {
        let closed = ClosedFolder {
            is_readable: false,
            ..closed("/srv/class/anna", Errno::EACCES, Some("anna"))
        };
        let finding = closed.finding();
        assert_eq!(finding.verdict, CheckResult::Fault);
        let advice = finding.mend.expect("advice");
        assert!(advice.starts_with("ask anna for access"), "{advice}");
    }
}
