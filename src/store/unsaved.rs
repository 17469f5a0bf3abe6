//! The unsaved drafts of consoles. Each console has its own file in the data folder and keeps it
//! locked as long as it runs: another console opens only files that have been left behind.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use super::append::AppendFile;
use super::regular::read_regular_text;
use super::{StoreError, sharing};

/// The maximum size of a file, in bytes.
const LONGEST: u64 = 16 * 1024 * 1024;
/// The beginning and the end of the file names; consoles of earlier versions wrote a file without a
/// number.
const NAME: &str = "unsaved-drafts";
const ENDING: &str = ".txt";

/// The unsaved drafts of a console.
#[derive(Debug)]
pub struct UnsavedDrafts {
    data: PathBuf,
    own: Option<AppendFile>,
    /// Files that other consoles have left behind, until the drafts in them are in this console's
    /// own file.
    adopted: Vec<AdoptedFile>,
}

/// A file of a console that has ended.
#[derive(Debug)]
struct AdoptedFile {
    path: PathBuf,
    /// Keeps other consoles from opening the same drafts.
    _lock: File,
}

impl UnsavedDrafts {
    /// The drafts of a console that has none yet, in this data folder.
    pub fn new(data: &Path) -> Self {
        Self {
            data: data.to_owned(),
            own: None,
            adopted: Vec::new(),
        }
    }

    fn folder(&self) -> PathBuf {
        self.data.join("plans")
    }

    /// The texts that consoles have left behind, except those that another console has open. Their files stay until
    /// [`keep`](Self::keep) has written the drafts.
    pub fn adopt(&mut self) -> Vec<String> {
        let entries = fs::read_dir(self.folder()).into_iter().flatten().flatten();
        let mut paths: Vec<PathBuf> = entries
            .filter(|entry| is_drafts_file(&entry.file_name().to_string_lossy()))
            .map(|entry| entry.path())
            .collect();
        paths.sort_unstable();
        let mut texts = Vec::new();
        for path in paths {
            let Some(lock) = locked(&path) else {
                continue;
            };
            let text = read_regular_text(&path, LONGEST).unwrap_or_default();
            if !text.is_empty() {
                texts.push(text);
                self.adopted.push(AdoptedFile { path, _lock: lock });
            }
        }
        texts
    }

    /// Writes the unsaved drafts to a new file, and then removes this console's earlier file and
    /// the adopted files of other consoles; `None` only removes them.
    ///
    /// # Errors
    /// A file cannot be written or removed.
    pub fn keep(&mut self, text: Option<&str>) -> Result<(), StoreError> {
        let newer = text.map(|text| self.written(text)).transpose()?;
        // The earlier files stay locked until they are removed.
        let former = std::mem::replace(&mut self.own, newer);
        let former_path = former.as_ref().map(AppendFile::path);
        let adopted = self.adopted.iter().map(|file| file.path.as_path());
        for path in former_path.into_iter().chain(adopted) {
            remove(path)?;
        }
        self.adopted.clear();
        Ok(())
    }

    fn written(&self, text: &str) -> Result<AppendFile, StoreError> {
        let folder = self.folder();
        sharing::folder_within(&self.data, &folder).map_err(|error| StoreError::Unwritable {
            path: folder.clone(),
            error,
        })?;
        let mut number = 1;
        loop {
            let path = folder.join(format!("{NAME}-{number}{ENDING}"));
            if let Some(mut file) = AppendFile::create(path)? {
                file.append(text.as_bytes())?;
                // The earlier file is removed next.
                file.sync()?;
                return Ok(file);
            }
            number += 1;
        }
    }
}

fn is_drafts_file(name: &str) -> bool {
    let number = name
        .strip_prefix(NAME)
        .and_then(|it| it.strip_suffix(ENDING));
    number.is_some_and(|it| it.is_empty() || it.starts_with('-'))
}

/// The file with its lock; `None` if another console holds it.
fn locked(path: &Path) -> Option<File> {
    // Opening a FIFO would wait for its writer.
    let file = path.is_file().then(|| File::open(path).ok()).flatten()?;
    let is_open = matches!(file.try_lock(), Err(TryLockError::WouldBlock));
    // Without file locks, another console cannot be seen.
    (!is_open).then_some(file)
}

fn remove(path: &Path) -> Result<(), StoreError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(StoreError::Unwritable {
            path: path.to_owned(),
            error,
        }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files(data: &Path) -> usize {
        fs::read_dir(data.join("plans")).map_or(0, Iterator::count)
    }

    fn left_behind(data: &Path) -> Vec<String> {
        UnsavedDrafts::new(data).adopt()
    }

    #[test]
    fn drafts_are_kept_after_their_console_and_removed() {
        let folder = tempfile::tempdir().expect("a folder");
        let data = folder.path();
        let mut console = UnsavedDrafts::new(data);
        console.keep(None).expect("nothing to remove");
        for text in ["one", "another"] {
            console.keep(Some(text)).expect("written");
            assert_eq!(files(data), 1);
        }
        drop(console);
        assert_eq!(left_behind(data), ["another"]);
        let mut next = UnsavedDrafts::new(data);
        assert_eq!(next.adopt(), ["another"]);
        drop(next);
        assert_eq!(left_behind(data), ["another"], "it was not kept elsewhere");
        let mut last = UnsavedDrafts::new(data);
        assert_eq!(last.adopt(), ["another"]);
        last.keep(None).expect("removed");
        assert_eq!(files(data), 0);
    }

    #[test]
    fn consoles_do_not_share_their_drafts() {
        let folder = tempfile::tempdir().expect("a folder");
        let data = folder.path();
        let mut first = UnsavedDrafts::new(data);
        first.keep(Some("first")).expect("written");
        let mut second = UnsavedDrafts::new(data);
        assert!(second.adopt().is_empty(), "the first console has them open");
        second.keep(Some("second")).expect("written");
        second.keep(None).expect("removed");
        second.keep(Some("second")).expect("written");
        drop((first, second));
        let mut third = UnsavedDrafts::new(data);
        let mut texts = third.adopt();
        texts.sort_unstable();
        assert_eq!(texts, ["first", "second"]);
        assert!(left_behind(data).is_empty(), "the third has them open now");
        third.keep(Some("both")).expect("written");
        assert_eq!(files(data), 1);
    }

    #[test]
    fn the_file_of_an_earlier_version_is_opened() {
        let folder = tempfile::tempdir().expect("a folder");
        let data = folder.path();
        fs::create_dir(data.join("plans")).expect("created");
        for name in ["unsaved-drafts.txt", "1-plan.waypoints"] {
            fs::write(data.join("plans").join(name), name).expect("written");
        }
        assert_eq!(left_behind(data), ["unsaved-drafts.txt"]);
    }
}
