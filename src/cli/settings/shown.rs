//! Language and symbols as set, if the terminal can show them.

use super::CliSettings;
use crate::config::Symbols;
use crate::terminal::Environment;
use crate::text;
use crate::text::{Language, Text};

impl CliSettings {
    /// The language of the output: the one that is set if the terminal shows its letters, otherwise English.
    pub fn language(&self) -> Language {
        // An ASCII terminal would show words of other scripts as question marks.
        if self.symbols() == Symbols::Ascii {
            return Language::English;
        }
        self.config.lang.unwrap_or_default()
    }

    /// The language that is set, if English is used instead because the locale or the symbols allow no other letters.
    pub fn withheld_language(&self) -> Option<Language> {
        let set = self.config.lang.unwrap_or_default();
        (set != self.language()).then_some(set)
    }

    /// A notice that the language that is set is not used; `None` if it is.
    pub fn withheld_language_text(&self) -> Option<Text> {
        let language = self.withheld_language()?.code();
        let is_chosen = self.config.symbols == Some(Symbols::Ascii);
        Some(if is_chosen {
            text!("lang-withheld-ascii", language = language)
        } else {
            text!("lang-withheld", language = language)
        })
    }

    /// The symbols for curves and maps: as set, otherwise the best that the terminal can show.
    pub fn symbols(&self) -> Symbols {
        let symbols = self.config.symbols;
        symbols.unwrap_or_else(|| Environment::of_process().symbols())
    }
}
