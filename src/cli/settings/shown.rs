//! Language and symbols as set, as far as the terminal can show them.

use super::CliSettings;
use crate::config::Symbols;
use crate::terminal::Environment;
use crate::text::Language;

impl CliSettings {
    /// The language that is written: the one that is set where the terminal shows its letters, else English.
    pub fn language(&self) -> Language {
        // Words of other scripts would be nothing but question marks.
        if self.symbols() == Symbols::Ascii {
            return Language::English;
        }
        self.config.lang.unwrap_or_default()
    }

    /// What curves and maps are drawn with: as set, else as the terminal can.
    pub fn symbols(&self) -> Symbols {
        let symbols = self.config.symbols;
        symbols.unwrap_or_else(|| Environment::of_process().symbols())
    }
}
