//! The copy of a record that another console is writing: that of the host of a crew, at a member.

use std::path::{Path, PathBuf};

use super::append::AppendFile;
use super::records::{RecordFiles, Records};
use super::{StoreError, records};
use crate::class::{RecordName, RecordPart};
use crate::pilot_in_command::Person;

/// The folder of the copies in the program's data folder. Nothing in it counts for a career.
const FOLDER: &str = "crew";
/// The maximum size of a copy, in bytes.
const LARGEST: u64 = 2 * 1024 * 1024 * 1024;
/// The number of copies in the folder: the oldest are removed.
const KEPT: usize = 20;
/// The parts of a copy.
const PARTS: [RecordPart; 3] = [RecordPart::Journal, RecordPart::Run, RecordPart::Frames];

/// A copy of a record that grows with it.
#[derive(Debug)]
pub struct RecordCopy {
    name: RecordName,
    folder: PathBuf,
    /// The name of its files, without suffix.
    stem: String,
    parts: Vec<(RecordPart, AppendFile)>,
}

impl RecordCopy {
    /// A new copy of the record with a name, in the program's data folder, after making room.
    ///
    /// # Errors
    /// Its files cannot be created.
    pub fn create(data: &Path, name: RecordName) -> Result<Self, StoreError> {
        let folder = data.join(FOLDER);
        std::fs::create_dir_all(&folder).map_err(|error| StoreError::Unwritable {
            path: folder.clone(),
            error,
        })?;
        make_room(&folder);
        let first = name.as_str().to_owned();
        let others = (2..).map(|number| format!("{first}-{number}"));
        let mut stems = std::iter::once(first.clone()).chain(others);
        loop {
            // There is always a next number.
            let stem = stems.next().unwrap_or_default();
            let path = records::part_in(&folder, &stem, RecordPart::Frames);
            if let Some(frames) = AppendFile::create(path)? {
                return Ok(Self {
                    parts: vec![(RecordPart::Frames, frames)],
                    name,
                    folder,
                    stem,
                });
            }
        }
    }

    pub fn name(&self) -> &RecordName {
        &self.name
    }

    /// The path of its frames.
    pub fn frames(&self) -> PathBuf {
        records::part_in(&self.folder, &self.stem, RecordPart::Frames)
    }

    /// Notes whose copy it is, by the name in the crew.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn belongs_to(&self, own: &Person) -> Result<(), StoreError> {
        RecordFiles::beside(&self.frames()).write_viewer(own)
    }

    /// The number of bytes that it has of each part.
    pub fn held(&self) -> Vec<(RecordPart, u64)> {
        let parts = self.parts.iter();
        parts.map(|(part, file)| (*part, file.len())).collect()
    }

    /// Ends the copy; an empty one is removed.
    pub fn close(self) {
        if self.parts.iter().all(|(_, file)| file.len() == 0) {
            RecordFiles::beside(&self.frames()).delete_viewer();
            for (_, file) in &self.parts {
                // What cannot be removed does no harm.
                drop(std::fs::remove_file(file.path()));
            }
        }
    }

    /// Appends bytes to a part.
    ///
    /// # Errors
    /// They cannot be written, or the copy would become too large.
    pub fn append(&mut self, part: RecordPart, bytes: &[u8]) -> Result<(), StoreError> {
        let path = records::part_in(&self.folder, &self.stem, part);
        let unwritable = |error| StoreError::Unwritable {
            path: path.clone(),
            error,
        };
        let size: u64 = self.parts.iter().map(|(_, file)| file.len()).sum();
        if size + bytes.len() as u64 > LARGEST || !PARTS.contains(&part) {
            return Err(unwritable(std::io::ErrorKind::FileTooLarge.into()));
        }
        if let Some((_, file)) = self.parts.iter_mut().find(|(it, _)| *it == part) {
            return file.append(bytes);
        }
        let created = AppendFile::create(path.clone())?;
        let exists = || unwritable(std::io::ErrorKind::AlreadyExists.into());
        let mut file = created.ok_or_else(exists)?;
        file.append(bytes)?;
        self.parts.push((part, file));
        Ok(())
    }
}

/// Removes the oldest copies that no console is writing.
fn make_room(folder: &Path) {
    let mut all = Records::at(folder).list();
    all.retain(|it| !it.is_written());
    let spare = (all.len() + 1).saturating_sub(KEPT);
    for files in all.into_iter().take(spare) {
        // Nothing counts the runs of copies. What cannot be removed stays.
        for path in files.run.iter().chain([&files.review]) {
            drop(std::fs::remove_file(path));
        }
        files.delete_viewer();
        drop(files.delete());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_twenty_copies_are_kept_with_all_their_files() {
        let folder = tempfile::tempdir().expect("a folder");
        let copy = |number: u32| {
            let name = format!("2026-11-{number:02}");
            let name = RecordName::try_from(name).expect("a name");
            let mut copy = RecordCopy::create(folder.path(), name).expect("created");
            copy.belongs_to(&Person::named("anna")).expect("written");
            for part in PARTS {
                copy.append(part, b"x\n").expect("written");
            }
            copy
        };
        // The oldest one is still being written.
        let written = copy(1);
        for number in 2..=23 {
            copy(number).close();
        }
        let entries = std::fs::read_dir(folder.path().join(FOLDER)).expect("a folder");
        let names = entries.map(|it| it.expect("an entry").file_name());
        let names = names.map(|it| it.to_string_lossy()[..10].to_owned());
        let mut names: Vec<String> = names.collect();
        names.sort();
        assert_eq!(names.len(), 4 * (KEPT + 1), "{names:?}");
        names.dedup();
        let newest = (4..=23).map(|number| format!("2026-11-{number:02}"));
        let kept: Vec<String> = std::iter::once("2026-11-01".to_owned())
            .chain(newest)
            .collect();
        assert_eq!(names, kept);
        drop(written);
    }

    #[test]
    fn a_copy_grows_and_replaces_no_other() {
        let folder = tempfile::tempdir().expect("a folder");
        let name = || RecordName::try_from("a".to_owned()).expect("a name");
        let mut first = RecordCopy::create(folder.path(), name()).expect("created");
        first
            .append(RecordPart::Journal, b"one\n")
            .expect("written");
        first
            .append(RecordPart::Journal, b"two\n")
            .expect("written");
        assert!(first.append(RecordPart::Inputs, b"x").is_err());
        let second = RecordCopy::create(folder.path(), name()).expect("created");
        assert_ne!(first.frames(), second.frames());
        let journal = folder.path().join("crew/a.flight.jsonl");
        assert_eq!(std::fs::read(journal).expect("written"), b"one\ntwo\n");
        let held = first.held();
        assert!(held.contains(&(RecordPart::Journal, 8)), "{held:?}");
        // Only an empty one is removed.
        let (full, empty) = (first.frames(), second.frames());
        first.close();
        second.close();
        assert!(full.exists() && !empty.exists());
    }
}
