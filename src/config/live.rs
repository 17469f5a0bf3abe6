//! Settings that the command line can change while the console runs.

use super::{Config, Symbols};
use crate::text::Language;

/// A setting that can change at run time, with its value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LiveSetting {
    /// The theme by its name.
    Theme(String),
    Lang(Language),
    /// The symbols for curves and maps.
    Symbols(Symbols),
    /// The maximum number of frames per second.
    Fps(u8),
    /// Whether serious alerts ring the bell.
    Bell(bool),
    /// Whether serious alerts request a desktop notification.
    Notify(bool),
}

impl LiveSetting {
    /// Applies the change to the settings in use.
    pub fn apply(&self, config: &mut Config) {
        match self {
            Self::Theme(name) => config.theme.clone_from(name),
            Self::Lang(language) => config.lang = Some(*language),
            Self::Symbols(symbols) => config.symbols = Some(*symbols),
            Self::Fps(fps) => config.fps = *fps,
            Self::Bell(on) => config.alerts.bell = *on,
            Self::Notify(on) => config.alerts.notify = *on,
        }
    }
}
