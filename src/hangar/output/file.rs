//! The log files of an instance's output.

use std::fs::{File, OpenOptions};
use std::io::{self, Write as _};
use std::os::unix::fs::OpenOptionsExt as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

use tokio::time::Instant;

const NAME: &str = "output.log";
/// The names of older files, newest first.
const OLDER: [&str; 2] = ["output.log.1", "output.log.2"];
/// The size of a full file, in bytes.
const FILE_LEN: u64 = 1024 * 1024;
/// How long to wait after a failed write.
const AGAIN_AFTER: Duration = Duration::from_secs(10);

/// A log in three files of bounded size. Lines that cannot be written are dropped and counted.
#[derive(Debug)]
pub(super) struct LogFile {
    folder: PathBuf,
    open: Option<(File, u64)>,
    again_at: Option<Instant>,
    lost: u64,
}

impl LogFile {
    pub fn new(folder: PathBuf) -> Self {
        Self {
            folder,
            open: None,
            again_at: None,
            lost: 0,
        }
    }

    /// Writes lines; returns a note when writing starts to fail, and when it works again.
    pub fn write(&mut self, lines: &[String], now: Instant) -> Option<String> {
        if self.again_at.is_some_and(|at| now < at) {
            self.lost += lines.len() as u64;
            return None;
        }
        let path = self.folder.join(NAME);
        match self.append(&path, lines) {
            Ok(()) => {
                self.again_at = None;
                let lost = std::mem::take(&mut self.lost);
                (lost > 0).then(|| {
                    format!(
                        "sortie: {} is written again; {lost} lines are missing in it",
                        path.display()
                    )
                })
            }
            Err(error) => {
                // The next attempt opens the file again.
                self.open = None;
                self.again_at = Some(now + AGAIN_AFTER);
                let is_new = self.lost == 0;
                self.lost += lines.len() as u64;
                is_new.then(|| {
                    format!(
                        "sortie: {} cannot be written; the output is shown, but not stored: {error}",
                        path.display()
                    )
                })
            }
        }
    }

    fn append(&mut self, path: &Path, lines: &[String]) -> io::Result<()> {
        let mut text = String::new();
        if self.lost > 0 {
            text = format!("[{} lines are missing]\n", self.lost);
        }
        for line in lines {
            text.push_str(line);
            text.push('\n');
            if text.len() as u64 >= FILE_LEN {
                self.append_text(path, &text)?;
                text.clear();
            }
        }
        self.append_text(path, &text)
    }

    fn append_text(&mut self, path: &Path, text: &str) -> io::Result<()> {
        let is_full = self.open.as_ref().is_some_and(|(_, len)| *len >= FILE_LEN);
        if is_full {
            self.open = None;
            self.rotate(path)?;
        }
        let (file, len) = match &mut self.open {
            Some(open) => open,
            none => none.insert(open(path)?),
        };
        file.write_all(text.as_bytes())?;
        *len += text.len() as u64;
        Ok(())
    }

    /// Rotates the files; the oldest is dropped.
    fn rotate(&self, path: &Path) -> io::Result<()> {
        let [newer, older] = OLDER.map(|name| self.folder.join(name));
        match std::fs::rename(&newer, older) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => std::fs::rename(path, newer),
        }
    }
}

fn open(path: &Path) -> io::Result<(File, u64)> {
    let file = OpenOptions::new()
        .create(true)
        .append(true)
        .mode(0o600)
        .open(path)?;
    let len = file.metadata()?.len();
    Ok((file, len))
}
