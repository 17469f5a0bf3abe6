//! The faults of the files, as commands print them and the console shows them.

use super::{CliSettings, FileFault};
use crate::text;
use crate::text::{Locale, Text};

impl CliSettings {
    /// Prints the faults of the files on standard error.
    pub fn complain(&self) {
        let locale = Locale::new(self.language());
        for fault in &self.faults {
            crate::cli::show(&fault.explained(&locale));
        }
    }

    /// The settings, once the faults of the files have been printed on standard error.
    pub fn complained(&self) -> &Self {
        self.complain();
        self
    }

    /// The faults of the files, and a language that cannot be shown, as warnings for the console.
    pub fn warnings(&self) -> Vec<Text> {
        let faults = self.faults.iter().flat_map(FileFault::texts);
        let ignored = faults.map(|fault| text!("config-faulty", fault = fault));
        self.withheld_language_text()
            .into_iter()
            .chain(ignored)
            .collect()
    }

    /// Whether a configuration file has faults, so that a setting may be missing.
    pub fn has_faulty_configuration(&self) -> bool {
        self.faults.iter().any(|fault| match fault {
            FileFault::Inside(source, _) => self.sources.has_read(&source.name),
            FileFault::Whole(_) | FileFault::Closed { .. } => true,
        })
    }
}
