//! The files that ground stations have put on the vehicle. They survive a reboot.

use std::collections::BTreeMap;

/// The maximum number of bytes of all files together.
const MOST_BYTES: usize = 128 * 1024;
/// The maximum number of files and folders together.
const MOST_NODES: usize = 256;
/// Error numbers of the operating system that the vehicle passes on.
pub(super) const NO_SUCH_FILE: u8 = 2;
pub(super) const EXISTS: u8 = 17;
pub(super) const IS_A_FOLDER: u8 = 21;
pub(super) const INVALID: u8 = 22;
pub(super) const NO_SPACE: u8 = 28;
pub(super) const READ_ONLY: u8 = 30;
const NOT_EMPTY: u8 = 39;

/// One line of a folder's listing; a folder has no length.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct FolderEntry {
    pub(super) name: String,
    pub(super) len: Option<usize>,
}

impl FolderEntry {
    pub(super) fn folder(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            len: None,
        }
    }

    pub(super) fn file(name: &str, len: usize) -> Self {
        Self {
            name: name.to_owned(),
            len: Some(len),
        }
    }
}

/// Files and folders by their path without a leading slash; `None` for a folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Disk(BTreeMap<String, Option<Vec<u8>>>);

impl Default for Disk {
    fn default() -> Self {
        Self(BTreeMap::from([("terrain".to_owned(), None)]))
    }
}

impl Disk {
    /// The content of a folder; `None` if it does not exist.
    pub(super) fn entries(&self, folder: &str) -> Option<Vec<FolderEntry>> {
        if !self.is_folder(folder) {
            return None;
        }
        let here = self.0.iter().filter_map(|(path, node)| {
            let (parent, name) = split(path);
            (parent == folder).then(|| FolderEntry {
                name: name.to_owned(),
                len: node.as_ref().map(Vec::len),
            })
        });
        Some(here.collect())
    }

    /// The bytes of a file.
    pub(super) fn read(&self, path: &str) -> Result<&[u8], u8> {
        match self.0.get(path) {
            Some(Some(bytes)) => Ok(bytes),
            Some(None) => Err(IS_A_FOLDER),
            None if path.is_empty() => Err(IS_A_FOLDER),
            None => Err(NO_SUCH_FILE),
        }
    }

    /// Creates an empty file; replaces a file of that name.
    pub(super) fn create(&mut self, path: &str) -> Result<(), u8> {
        if self.is_folder(path) {
            return Err(IS_A_FOLDER);
        }
        self.0.remove(path);
        self.add(path, Some(Vec::new()))
    }

    /// Writes into a file; a gap before the offset reads as zeros.
    pub(super) fn write(&mut self, path: &str, offset: usize, bytes: &[u8]) -> Result<(), u8> {
        let used: usize = self.0.values().flatten().map(Vec::len).sum();
        let Some(Some(file)) = self.0.get_mut(path) else {
            return Err(NO_SUCH_FILE);
        };
        let grown = offset
            .saturating_add(bytes.len())
            .saturating_sub(file.len());
        if used.saturating_add(grown) > MOST_BYTES {
            return Err(NO_SPACE);
        }
        write_into(file, offset, bytes);
        Ok(())
    }

    pub(super) fn make_folder(&mut self, path: &str) -> Result<(), u8> {
        if path.is_empty() || self.0.contains_key(path) {
            return Err(EXISTS);
        }
        self.add(path, None)
    }

    /// Removes a file or an empty folder.
    pub(super) fn remove(&mut self, path: &str) -> Result<(), u8> {
        if self
            .entries(path)
            .is_some_and(|entries| !entries.is_empty())
        {
            return Err(NOT_EMPTY);
        }
        self.0.remove(path).map(|_| ()).ok_or(NO_SUCH_FILE)
    }

    /// Renames a file or an empty folder; replaces a file that has the new name.
    pub(super) fn rename(&mut self, from: &str, to: &str) -> Result<(), u8> {
        if !self.0.contains_key(from) {
            return Err(NO_SUCH_FILE);
        }
        if self.is_folder(to) || self.entries(from).is_some_and(|held| !held.is_empty()) {
            return Err(NOT_EMPTY);
        }
        if !self.is_folder(split(to).0) {
            return Err(NO_SUCH_FILE);
        }
        if let Some(node) = self.0.remove(from) {
            self.0.insert(to.to_owned(), node);
        }
        Ok(())
    }

    fn is_folder(&self, path: &str) -> bool {
        path.is_empty() || matches!(self.0.get(path), Some(None))
    }

    fn add(&mut self, path: &str, node: Option<Vec<u8>>) -> Result<(), u8> {
        if !self.is_folder(split(path).0) {
            return Err(NO_SUCH_FILE);
        }
        if self.0.len() >= MOST_NODES {
            return Err(NO_SPACE);
        }
        self.0.insert(path.to_owned(), node);
        Ok(())
    }
}

/// Writes into bytes that grow as needed; a gap before the offset reads as zeros.
pub(super) fn write_into(file: &mut Vec<u8>, offset: usize, bytes: &[u8]) {
    let end = offset.saturating_add(bytes.len());
    if file.len() < end {
        file.resize(end, 0);
    }
    if let Some(room) = file.get_mut(offset..end) {
        room.copy_from_slice(bytes);
    }
}

/// A path without empty parts and without `.`.
pub(super) fn clean(path: &str) -> String {
    let parts = path
        .split('/')
        .filter(|part| !part.is_empty() && *part != ".");
    parts.collect::<Vec<_>>().join("/")
}

fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('/').unwrap_or(("", path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_and_folders_behave_as_on_a_disk() {
        let mut disk = Disk::default();
        assert_eq!(disk.create("a/b.txt"), Err(NO_SUCH_FILE));
        assert_eq!(disk.make_folder("a"), Ok(()));
        assert_eq!(disk.make_folder("a"), Err(EXISTS));
        assert_eq!(disk.create("a/b.txt"), Ok(()));
        assert_eq!(disk.write("a/b.txt", 2, b"xy"), Ok(()));
        assert_eq!(disk.read("a/b.txt"), Ok(&b"\0\0xy"[..]));
        assert_eq!(disk.entries("a"), Some(vec![FolderEntry::file("b.txt", 4)]));
        assert_eq!(disk.remove("a"), Err(NOT_EMPTY));
        assert_eq!(disk.rename("a/b.txt", "c"), Ok(()));
        assert_eq!(disk.remove("a"), Ok(()));
        assert_eq!(disk.read("a/b.txt"), Err(NO_SUCH_FILE));
        let names = [FolderEntry::file("c", 4), FolderEntry::folder("terrain")];
        assert_eq!(disk.entries(""), Some(names.to_vec()));
    }

    #[test]
    fn the_disk_is_full_at_some_time() {
        let mut disk = Disk::default();
        disk.create("big").expect("room");
        assert_eq!(disk.write("big", u32::MAX as usize, b"x"), Err(NO_SPACE));
        assert_eq!(disk.write("big", MOST_BYTES - 1, b"x"), Ok(()));
        assert_eq!(disk.write("big", MOST_BYTES, b"x"), Err(NO_SPACE));
    }

    #[test]
    fn paths_are_cleaned() {
        assert_eq!(clean("/./a//b/"), "a/b");
        assert_eq!(clean("/"), "");
    }
}
