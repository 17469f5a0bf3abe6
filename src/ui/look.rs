//! How things are shown to this user: colours, words, symbols.

use std::sync::Arc;

use ratatui::style::Style;

use super::theme::{Role, Theme};
use crate::config::Symbols;
use crate::notice::sanitised;
use crate::text::{Locale, Text};

/// Colours, words and symbols; every widget is handed one.
#[derive(Debug, Clone, Default)]
pub struct Look {
    pub theme: Theme,
    pub locale: Arc<Locale>,
    /// What curves and maps are drawn with.
    pub symbols: Symbols,
}

impl Look {
    /// The style of a role.
    pub fn style(&self, role: Role) -> Style {
        self.theme.style(role)
    }

    /// A text in words that are safe to show on one line.
    pub fn text(&self, text: &Text) -> String {
        sanitised(&self.locale.text(text))
    }

    /// A message without arguments in words. It may have several lines.
    pub fn say(&self, id: &str) -> String {
        self.locale.say(id)
    }
}
