//! Where each setting comes from.

use std::ops::Range;
use std::path::{Path, PathBuf};

use super::check;
use crate::config::{Layers, Origin};
use crate::diagnostic::Diagnostic;
use crate::store::Source;

/// The settings with the source of each.
#[derive(Debug, Default)]
pub(in crate::cli) struct SettingSources {
    pub layers: Layers,
    /// The configuration file, which need not exist.
    pub file: Option<PathBuf>,
    /// Whether the user named the configuration file, so its faults are usage errors.
    pub is_file_named: bool,
    /// The configuration files that could be read.
    read: Vec<Source>,
}

/// The place of a setting's value in a configuration file.
pub(super) struct SettingPlace {
    pub source: Source,
    pub span: Range<usize>,
}

impl SettingSources {
    /// The default settings, before anything has been read.
    pub fn new(file: Option<PathBuf>, is_file_named: bool) -> Self {
        Self {
            file,
            is_file_named,
            ..Self::default()
        }
    }

    /// Applies a configuration file over the present settings; returns its faults.
    pub fn lay_on(&mut self, source: &Source, themes: &[String]) -> Vec<Diagnostic> {
        let check = |setting: &str, word: &str| check(setting, word, themes);
        let read = self.layers.file(&source.name, &source.text, &check);
        self.read.push(source.clone());
        read.err().unwrap_or_default()
    }

    /// Whether a file is one of the configuration files that could be read.
    pub fn has_read(&self, name: &str) -> bool {
        self.read.iter().any(|source| source.name == name)
    }

    /// Whether a setting comes from the command line or the environment.
    pub fn is_named(&self, setting: &str) -> bool {
        matches!(
            self.layers.origin(setting),
            Origin::Flag(_) | Origin::Environment(_)
        )
    }

    /// Whether a setting comes from a flag of the command line.
    pub fn is_flag(&self, setting: &str) -> bool {
        matches!(self.layers.origin(setting), Origin::Flag(_))
    }

    /// Whether a setting comes from a file.
    pub fn is_of_file(&self, setting: &str) -> bool {
        matches!(self.layers.origin(setting), Origin::File { .. })
    }

    /// Whether a wrong value is a usage error: it was set by a flag, by the environment or by a
    /// file that was named, and not by a file that is read by default.
    pub fn has_to_be_right(&self, setting: &str) -> bool {
        match self.layers.origin(setting) {
            Origin::Flag(_) | Origin::Environment(_) => true,
            Origin::File { name, .. } => {
                let named = self.file.as_ref().filter(|_| self.is_file_named);
                named.is_some_and(|file| file.display().to_string() == *name)
            }
            Origin::Default => false,
        }
    }

    /// The folder of the configuration file that sets this setting; `None` if no file does.
    pub fn folder_of(&self, setting: &str) -> Option<PathBuf> {
        match self.layers.origin(setting) {
            Origin::File { name, .. } => {
                let folder = Path::new(name).parent();
                Some(folder.unwrap_or(Path::new("")).to_owned())
            }
            Origin::Default | Origin::Environment(_) | Origin::Flag(_) => None,
        }
    }

    /// The place of a setting's value; `None` unless it comes from a file.
    pub(super) fn place_of(&self, setting: &str) -> Option<SettingPlace> {
        match self.layers.origin(setting) {
            Origin::File { name, span, .. } => {
                let mut read = self.read.iter();
                let source = read.find(|source| source.name == *name)?.clone();
                let span = span.clone();
                Some(SettingPlace { source, span })
            }
            Origin::Default | Origin::Environment(_) | Origin::Flag(_) => None,
        }
    }
}
