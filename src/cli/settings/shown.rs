//! Language and symbols as set, if the terminal can show them.

use super::CliSettings;
use crate::config::Symbols;
use crate::terminal::Environment;
use crate::text::Language;

impl CliSettings {
    /// The language of the output: the one that is set if the terminal shows its letters, otherwise English.
    pub fn language(&self) -> Language {
        // An ASCII terminal would show words of other scripts as question marks.
        if self.symbols() == Symbols::Ascii {
            return Language::English;
        }
        self.config.lang.unwrap_or_default()
    }

    /// The symbols for curves and maps: as set, otherwise the best that the terminal can show.
    pub fn symbols(&self) -> Symbols {
        let symbols = self.config.symbols;
        symbols.unwrap_or_else(|| Environment::of_process().symbols())
    }
}
