//! The data folder: profiles, recorded runs and records of flights.

use std::path::{Path, PathBuf};

use super::{CliSettings, Failure};
use crate::cli::fault::FileFault;
use crate::config::Readers;
use crate::store::{self, Folders, RecordFiles, RecordLimits, Records, Runs};
use crate::text;
use crate::text::{Locale, Text};

/// The maximum number of unshared files that are named.
const MOST_UNSHARED: usize = 3;

/// The folder of profiles and recorded runs. There is none for a user without a home folder.
#[derive(Debug)]
pub(in crate::cli) struct DataFolder {
    path: Option<PathBuf>,
    /// Whether the user named the folder; the default one need not exist.
    is_named: bool,
}

impl DataFolder {
    /// The folder that the user named, or the default one.
    pub(super) fn new(named: Option<PathBuf>, folders: Option<&Folders>) -> Self {
        Self {
            is_named: named.is_some(),
            path: named.or_else(|| folders.map(|folders| folders.data.clone())),
        }
    }

    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The recorded runs; `None` without a folder.
    pub fn runs(&self) -> Option<Runs> {
        self.path().map(Runs::within)
    }

    /// Checks that the folder exists, if the user named it.
    ///
    /// # Errors
    /// The folder does not exist.
    pub fn require(&self, locale: &Locale) -> Result<(), Failure> {
        let named = self.path().filter(|_| self.is_named);
        // If the path cannot be checked for lack of permission, the later read reports the reason.
        let missing = named.filter(|path| path.try_exists().is_ok_and(|exists| !exists));
        missing.map_or(Ok(()), |path| {
            let text = text!("file-no-data", path = path.display().to_string());
            Err(failed(&text, locale))
        })
    }
}

impl CliSettings {
    /// Where flights are recorded, and how many of them are kept; `None` without a data folder.
    pub fn records(&self) -> Option<Records> {
        let set = &self.config.records;
        let limits = RecordLimits {
            count: set.count as usize,
            bytes: set.space * 1024 * 1024,
        };
        Some(Records::within(self.data.path()?, limits))
    }

    /// Finds a record by its number in the list, its name, or one of its files.
    pub fn find_record(&self, named: &str) -> Result<RecordFiles, Failure> {
        let locale = Locale::new(self.language());
        if !store::user_path(named).is_file() {
            self.require_records(&locale)?;
        }
        Records::find(self.records().as_ref(), named)
            .map_err(|fault| Failure::Invalid(format!("sortie: {}", locale.text(&fault))))
    }

    /// Checks that the records can be listed.
    ///
    /// # Errors
    /// A data folder that the user named does not exist, or the folder of the records cannot be read.
    pub fn require_records(&self, locale: &Locale) -> Result<(), Failure> {
        self.data.require(locale)?;
        let checked = self.records().map_or(Ok(()), |records| records.check());
        checked.map_err(|error| failed(&Text::from(&error), locale))
    }

    /// Lets the group read results, if so configured; creates a missing data folder. Another user's
    /// folder is not changed. What cannot be shared is reported.
    pub fn share_results(&mut self) {
        if let (Readers::Group, Some(data)) = (self.config.results.readers, self.data.path()) {
            let unshared = store::share_with_group(data);
            let first = unshared.iter().take(MOST_UNSHARED);
            self.faults
                .extend(first.map(|it| FileFault::Whole(it.into())));
            let more = unshared.len().saturating_sub(MOST_UNSHARED);
            if more > 0 {
                let text = text!("sharing-more", count = more);
                self.faults.push(FileFault::Whole(text));
            }
        }
    }
}

fn failed(text: &Text, locale: &Locale) -> Failure {
    Failure::Failed(anyhow::anyhow!(locale.text(text)))
}
