//! What is wrong with a file of settings, and how it is told.

use std::env;
use std::io::IsTerminal as _;
use std::path::Path;

use crate::cli::Failure;
use crate::diagnostic::Diagnostic;
use crate::notice::{sanitised, sanitised_lines};
use crate::store::Source;
use crate::text::Text;

/// What is wrong with a file.
#[derive(Debug)]
pub(in crate::cli) enum SettingsFault {
    Inside(Source, Diagnostic),
    /// The whole of it.
    Whole(Text),
}

impl SettingsFault {
    /// In one line, which has no room for the folder.
    pub fn text(&self) -> Text {
        match self {
            Self::Inside(source, fault) => {
                let path = Path::new(&source.name);
                let name = path.file_name().unwrap_or(path.as_os_str());
                fault.text(&name.to_string_lossy(), &source.text)
            }
            Self::Whole(text) => text.clone(),
        }
    }

    /// With the lines around it.
    pub fn explained(&self) -> String {
        match self {
            Self::Inside(source, fault) => {
                let colour = std::io::stderr().is_terminal() && env::var_os("NO_COLOR").is_none();
                fault.render(&sanitised(&source.name), &source.text, colour)
            }
            Self::Whole(text) => sanitised_lines(&format!("sortie: {text}")),
        }
    }
}

/// Each fault with the file that it is in.
pub(super) fn faults_of(source: &Source, faults: Vec<Diagnostic>) -> Vec<SettingsFault> {
    let faults = faults.into_iter();
    faults
        .map(|fault| SettingsFault::Inside(source.clone(), fault))
        .collect()
}

/// The failure of a program whose files have these faults.
pub(super) fn explained(faults: &[SettingsFault]) -> Failure {
    let texts: Vec<String> = faults.iter().map(SettingsFault::explained).collect();
    Failure::Shown(texts.join("\n\n"))
}
