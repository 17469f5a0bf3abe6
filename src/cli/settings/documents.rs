//! The documentation of parameters that the settings name.

use super::{CliSettings, FileFault};
use crate::cli::Failure;
use crate::parameters::{ParameterDocuments, ReadDocuments};
use crate::store;
use crate::text::Text;

impl CliSettings {
    /// The documentation of parameters, if the user has named a file. Faults inside a file that documents something
    /// are reported, but do not end the command.
    ///
    /// # Errors
    /// A file that the command line or the environment names cannot be read, or documents nothing.
    pub fn read_parameter_documents(&mut self) -> Result<ParameterDocuments, Failure> {
        const SETTING: &str = "parameters.documentation";
        let Some(name) = &self.config.parameters.documentation else {
            return Ok(ParameterDocuments::default());
        };
        let named = store::user_path(name);
        let path = match self.sources.folder_of(SETTING) {
            Some(folder) => folder.join(named),
            None => named,
        };
        let source = match store::read_large(&path, "file-documentation") {
            Ok(source) => source,
            Err(error) => {
                self.wrong(SETTING, Text::from(&error))?;
                return Ok(ParameterDocuments::default());
            }
        };
        let ReadDocuments { documents, faults } = ParameterDocuments::read(&source.text);
        if !faults.is_empty() {
            let is_usage = documents.is_empty() && self.sources.has_to_be_right(SETTING);
            self.told(FileFault::Inside(source, faults), is_usage)?;
        }
        Ok(documents)
    }
}
