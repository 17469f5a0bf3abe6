//! Reviews of records: small files next to them, which stay when old records are removed.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read as _, Write as _};
use std::path::Path;

use super::{REVIEW, RecordFiles, Records, StoreError, sharing, undeletable, unwritable};
use crate::review::Review;
use crate::text;
use crate::text::Text;

const LONGEST: u64 = 1024 * 1024;

impl RecordFiles {
    /// The review of the record, if there is one.
    ///
    /// # Errors
    /// A text if it cannot be read, or is not a review.
    pub fn read_review(&self) -> Result<Option<Review>, Text> {
        match read(&self.review) {
            Ok(text) => Review::read(&text).map(Some),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(text!("review-unreadable", error = error.to_string())),
        }
    }

    /// Writes the review of the record; an earlier one is replaced as a whole.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write_review(&self, review: &Review) -> Result<(), StoreError> {
        let part = self.review.with_extension("json.part");
        let write = || {
            let mut options = OpenOptions::new();
            let mut file = sharing::open(options.create(true).truncate(true).write(true), &part)?;
            file.write_all(review.to_json().as_bytes())?;
            file.sync_all()?;
            fs::rename(&part, &self.review)
        };
        write().map_err(|error| unwritable(&self.review, error))
    }

    /// Removes the record's review, if there is one.
    ///
    /// # Errors
    /// The review cannot be removed.
    pub fn delete_review(&self) -> Result<(), StoreError> {
        match fs::remove_file(&self.review) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(undeletable(&self.review, error))
            }
            Ok(()) | Err(_) => Ok(()),
        }
    }
}

impl Records {
    /// The newest review of each mission that one profile has flown, by the mission's id; `whose`
    /// is the name of the profile, or `None` for flights without a profile.
    pub fn newest_reviews(&self, whose: Option<&str>) -> BTreeMap<String, Review> {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let mut names: Vec<_> = entries
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .filter(|name| name.ends_with(REVIEW))
            .collect();
        // Names begin with the date and time, so a mission's newest review replaces the others.
        names.sort();
        let mut newest = BTreeMap::new();
        for name in names {
            let text = read(&self.folder.join(name)).ok();
            let review = text.and_then(|text| Review::read(&text).ok());
            let Some(review) = review.filter(|it| it.profile.as_deref() == whose) else {
                continue;
            };
            if let Some(mission) = review.mission.clone() {
                newest.insert(mission, review);
            }
        }
        newest
    }
}

fn read(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    File::open(path)?.take(LONGEST).read_to_string(&mut text)?;
    Ok(text)
}
