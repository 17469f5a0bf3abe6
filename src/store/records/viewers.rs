//! Who looks at the copy of a record that another console has written: a small file beside the copy.

use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::{RecordFiles, StoreError, sharing, unwritable};
use crate::crew::CrewViewpoint;
use crate::pilot_in_command::Person;
use crate::record::Head;

/// The suffix of the file.
const VIEWER: &str = ".viewer.json";

/// The owner of a copy.
#[derive(Debug, Serialize, Deserialize)]
struct Viewer {
    /// The name of its owner in the crew.
    own: Person,
}

impl RecordFiles {
    fn viewer(&self) -> PathBuf {
        self.review.with_file_name(format!("{}{VIEWER}", self.stem))
    }

    /// Notes the name that the owner of a copy has in the crew; an earlier one is replaced.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write_viewer(&self, own: &Person) -> Result<(), StoreError> {
        let path = self.viewer();
        let write = || {
            let mut options = OpenOptions::new();
            let mut file = sharing::open(options.create(true).truncate(true).write(true), &path)?;
            let text = serde_json::to_vec(&Viewer { own: own.clone() })?;
            file.write_all(&text)
        };
        write().map_err(|error: io::Error| unwritable(&path, error))
    }

    /// Who looks at whose flight, if it is a member's copy of the record with this head.
    pub fn viewpoint(&self, head: &Head) -> Option<CrewViewpoint> {
        let text = fs::read(self.viewer()).ok()?;
        let Viewer { own } = serde_json::from_slice(&text).ok()?;
        let host = head.host.clone()?;
        Some(CrewViewpoint { own, host })
    }

    pub(in crate::store) fn delete_viewer(&self) {
        // Most records are no copies.
        drop(fs::remove_file(self.viewer()));
    }
}
