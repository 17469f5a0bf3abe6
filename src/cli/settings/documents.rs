//! The documentation of parameters and events that the settings name.

use super::{CliSettings, FileFault};
use crate::cli::Failure;
use crate::metadata::EventDocuments;
use crate::parameters::{ParameterDocuments, ReadDocuments};
use crate::store::{self, Source};
use crate::text::Text;

const PARAMETERS: &str = "parameters.documentation";
const EVENTS: &str = "events.documentation";

impl CliSettings {
    /// The documentation of parameters, if the user has named a file. Faults inside a file that documents something
    /// are reported, but do not end the command.
    ///
    /// # Errors
    /// A file that the command line or the environment names cannot be read, or documents nothing.
    pub fn read_parameter_documents(&mut self) -> Result<ParameterDocuments, Failure> {
        let named = self.config.parameters.documentation.clone();
        let Some(source) = self.documentation(PARAMETERS, named, "file-documentation")? else {
            return Ok(ParameterDocuments::default());
        };
        let ReadDocuments { documents, faults } = ParameterDocuments::read(&source.text);
        if !faults.is_empty() {
            let is_usage = documents.is_empty() && self.sources.has_to_be_right(PARAMETERS);
            self.told(FileFault::Inside(source, faults), is_usage)?;
        }
        Ok(documents)
    }

    /// The texts of events, if the user has named a file. Events with faults are left out, and stay numbers.
    ///
    /// # Errors
    /// A file that the command line or the environment names cannot be read, or documents nothing.
    pub fn read_event_documents(&mut self) -> Result<EventDocuments, Failure> {
        let named = self.config.events.documentation.clone();
        let Some(source) = self.documentation(EVENTS, named, "file-events")? else {
            return Ok(EventDocuments::default());
        };
        match EventDocuments::read(&source.text) {
            Ok(read) => {
                for fault in &read.faults {
                    tracing::warn!("{}: {fault}", source.name);
                }
                Ok(read.documents)
            }
            Err(fault) => {
                let placed = Text::verbatim(format!("{}: {fault}", source.name));
                self.wrong(EVENTS, placed)?;
                Ok(EventDocuments::default())
            }
        }
    }

    /// The file that a setting names; `kind` is the id of the message that names the expected kind of file.
    fn documentation(
        &mut self,
        setting: &'static str,
        named: Option<String>,
        kind: &'static str,
    ) -> Result<Option<Source>, Failure> {
        let Some(named) = named else {
            return Ok(None);
        };
        let named = store::user_path(&named);
        let path = match self.sources.folder_of(setting) {
            Some(folder) => folder.join(named),
            None => named,
        };
        match store::read_documentation(&path, kind) {
            Ok(source) => Ok(Some(source)),
            Err(error) => {
                self.wrong(setting, Text::from(&error))?;
                Ok(None)
            }
        }
    }
}
