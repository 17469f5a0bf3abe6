//! The command line's history across sessions: an entry per line, newest last, readable only by the
//! user.

use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::os::unix::fs::{DirBuilderExt as _, OpenOptionsExt as _};
use std::path::{Path, PathBuf};

use super::links;

/// The number of lines kept.
const HISTORY_KEPT: usize = 200;
/// The maximum size of a history file, in bytes; sortie never writes a larger one, and leaves larger ones alone.
const LONGEST: u64 = 1024 * 1024;

/// The file of the history. Several consoles may add to it at the same time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct History {
    path: PathBuf,
}

impl History {
    /// The history in the program's state folder.
    pub fn within(state: &Path) -> Self {
        Self {
            path: state.join("history"),
        }
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The lines of earlier sessions, oldest first, each once; shortens a long file.
    ///
    /// # Errors
    /// The file exists, but is too large, or cannot be read or shortened.
    pub fn read(&self) -> io::Result<Vec<String>> {
        match fs::metadata(&self.path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(error),
            Ok(file) if !file.is_file() || file.len() > LONGEST => {
                let text = format!("{} is not a history", self.path.display());
                return Err(io::Error::new(io::ErrorKind::InvalidData, text));
            }
            Ok(_) => {}
        }
        let bytes = fs::read(&self.path)?;
        let text = String::from_utf8_lossy(&bytes);
        let all: Vec<&str> = text.lines().filter(|line| is_plain(line)).collect();
        let mut lines: Vec<String> = Vec::new();
        for line in all.iter().rev() {
            if lines.len() < HISTORY_KEPT && !lines.iter().any(|known| known == line) {
                lines.push((*line).to_owned());
            }
        }
        lines.reverse();
        if all.len() > 2 * HISTORY_KEPT {
            self.replace(&lines)?;
        }
        Ok(lines)
    }

    /// Adds a line, unless it is blank or contains control characters.
    ///
    /// # Errors
    /// The line cannot be written.
    pub fn add(&self, line: &str) -> io::Result<()> {
        if !is_plain(line) {
            return Ok(());
        }
        let mut private = OpenOptions::new();
        private.create(true).append(true).mode(0o600);
        // A single write, so that lines of several consoles do not mix.
        self.folder()?;
        let mut file = links::open_own(&mut private, &self.path)?;
        file.write_all(format!("{line}\n").as_bytes())
    }

    fn replace(&self, lines: &[String]) -> io::Result<()> {
        let new = self.path.with_extension("new");
        let mut private = OpenOptions::new();
        private.create(true).write(true).truncate(true).mode(0o600);
        let mut text = lines.join("\n");
        text.push('\n');
        links::open_own(&mut private, &new)?.write_all(text.as_bytes())?;
        fs::rename(new, &self.path)
    }

    /// Creates the folder, private as the specification requires.
    fn folder(&self) -> io::Result<()> {
        let folder = self.path.parent().unwrap_or(Path::new("."));
        fs::DirBuilder::new()
            .recursive(true)
            .mode(0o700)
            .create(folder)
    }
}

/// Whether a line could come from the command line: it is not blank and has no control characters.
fn is_plain(line: &str) -> bool {
    !line.trim().is_empty() && !line.chars().any(char::is_control)
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::{PermissionsExt as _, lchown, symlink};

    use super::*;

    #[test]
    fn lines_come_back_once_in_the_order_of_their_last_use() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let history = History::within(&folder.path().join("new/sortie"));
        assert_eq!(history.read().expect("nothing yet"), Vec::<String>::new());
        for line in ["all arm", "rtl", "all arm", "", "a\u{1b}[2Jb"] {
            history.add(line).expect("written");
        }
        assert_eq!(history.read().expect("read"), ["rtl", "all arm"]);
        let mode = |path: &Path| fs::metadata(path).expect("there").permissions().mode() & 0o777;
        assert_eq!(mode(&history.path), 0o600);
        assert_eq!(mode(history.path.parent().expect("a folder")), 0o700);
    }

    #[test]
    fn a_long_history_is_shortened() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let history = History::within(folder.path());
        for number in 0..=2 * HISTORY_KEPT {
            history.add(&format!("altitude {number}")).expect("written");
        }
        let lines = history.read().expect("read");
        assert_eq!(lines.len(), HISTORY_KEPT);
        assert_eq!(lines.last().map(String::as_str), Some("altitude 400"));
        let text = fs::read_to_string(&history.path).expect("read");
        assert_eq!(text.lines().count(), HISTORY_KEPT);
    }

    #[test]
    fn a_link_of_another_user_is_not_followed() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let target = folder.path().join("target");
        fs::write(&target, "kept").expect("written");
        let history = History::within(folder.path());
        symlink(&target, &history.path).expect("linked");
        history.add("rtl").expect("the user's own link is followed");
        assert_eq!(fs::read_to_string(&target).expect("there"), "keptrtl\n");
        // Only the superuser can change the owner of a link; without that, the test ends here.
        if lchown(&history.path, Some(65_533), None).is_err() {
            return;
        }
        assert!(history.add("land").is_err());
        assert_eq!(fs::read_to_string(&target).expect("there"), "keptrtl\n");
    }

    #[test]
    fn what_is_no_history_is_left_alone() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::create_dir(folder.path().join("history")).expect("created");
        assert!(History::within(folder.path()).read().is_err());
    }
}
