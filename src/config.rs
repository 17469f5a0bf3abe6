//! What a user has set: the console's configuration, whatever file, variable or flag it came from.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::text::Language;

/// The settings; each has a default.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Config {
    /// The language of the screens; `None` follows the shell's locale.
    pub lang: Option<Language>,
    /// The theme's name.
    pub theme: String,
    /// Frames per second at most.
    pub fps: u8,
    /// What curves and maps are drawn with; `None` follows the terminal.
    pub symbols: Option<Symbols>,
    /// Whether the mouse is listened to.
    pub mouse: bool,
    /// The swarm table.
    pub table: Table,
    /// How alerts make themselves noticed.
    pub alerts: Alerts,
    /// Named sequences of lines of the command language.
    pub macros: BTreeMap<String, Vec<String>>,
}

/// What a terminal can show besides letters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Symbols {
    /// Braille patterns, two by four dots in a cell.
    #[default]
    Braille,
    /// Blocks and box characters.
    Block,
    /// Nothing but ASCII.
    Ascii,
}

/// The swarm table.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Table {
    /// The columns from the left, by name; empty means as many as fit.
    pub columns: Vec<String>,
    /// The column to sort by, with a `-` before it for the largest first; empty means by number.
    pub sort: String,
}

/// How alerts make themselves noticed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Alerts {
    /// Whether serious ones ring the bell.
    pub bell: bool,
    /// Whether serious ones ask the terminal for a desktop notification (OSC 9).
    pub notify: bool,
    /// The kinds that stay silent.
    pub mute: Vec<String>,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            lang: None,
            theme: "dark".to_owned(),
            fps: 10,
            symbols: None,
            mouse: false,
            table: Table::default(),
            alerts: Alerts::default(),
            macros: BTreeMap::new(),
        }
    }
}

impl Default for Alerts {
    fn default() -> Self {
        Self {
            bell: true,
            notify: false,
            mute: Vec::new(),
        }
    }
}
