//! Settings that the command line changes for as long as the console runs.

use crate::config::{Config, SETTINGS, SettingKind, Symbols};
use crate::text;
use crate::text::{Language, Text};

/// One setting with its value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Setting {
    Theme(String),
    Lang(Language),
    /// What curves and maps are drawn with.
    Symbols(Symbols),
    /// Frames per second at most.
    Fps(u8),
    /// Whether serious alerts ring the bell.
    Bell(bool),
    /// Whether serious alerts ask for a desktop notification.
    Notify(bool),
}

impl Setting {
    /// The names of the settings.
    pub const NAMES: &[&str] = &["theme", "lang", "symbols", "fps", "bell", "notify"];

    /// What a setting is about.
    pub fn explained(name: &str) -> Text {
        Text::new(format!("setting-{name}"), Vec::new())
    }

    /// The values that a setting may have, where they can be listed.
    pub fn values(name: &str) -> &'static [&'static str] {
        match kind(name) {
            Some(SettingKind::OneOf(values)) => values,
            Some(SettingKind::Flag) => &["on", "off"],
            _ => &[],
        }
    }

    /// Reads a value.
    ///
    /// # Errors
    /// What the value should be.
    pub fn read(name: &str, value: &str) -> Result<Self, Text> {
        let found = match name {
            "theme" => Some(Self::Theme(value.to_owned())),
            "lang" => Language::of(value).map(Self::Lang),
            "symbols" => match value {
                "braille" => Some(Self::Symbols(Symbols::Braille)),
                "block" => Some(Self::Symbols(Symbols::Block)),
                "ascii" => Some(Self::Symbols(Symbols::Ascii)),
                _ => None,
            },
            "fps" => {
                let Some(SettingKind::Whole(least, most)) = kind(name) else {
                    return Err(text!("console-unknown", word = value));
                };
                let is_within = |fps: &u8| (least..=most).contains(&i64::from(*fps));
                let number = value.parse().ok().filter(is_within);
                let fault = || text!("setting-fps-range", least = least, most = most);
                return number.map(Self::Fps).ok_or_else(fault);
            }
            "bell" => switch(value).map(Self::Bell),
            "notify" => switch(value).map(Self::Notify),
            _ => None,
        };
        found.ok_or_else(|| text!("console-unknown", word = value))
    }

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

/// What a setting may be, by the configuration; the command line leaves its section out.
fn kind(name: &str) -> Option<SettingKind> {
    let mut all = SETTINGS.iter();
    all.find(|setting| setting.key() == name)
        .map(|setting| setting.kind)
}

fn switch(value: &str) -> Option<bool> {
    match value {
        "on" => Some(true),
        "off" => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_that_is_offered_can_be_set() {
        for name in Setting::NAMES {
            for value in Setting::values(name) {
                let setting = Setting::read(name, value).expect(value);
                let mut config = Config::default();
                setting.apply(&mut config);
            }
        }
    }

    #[test]
    fn frames_per_second_have_bounds() {
        assert_eq!(Setting::read("fps", "5"), Ok(Setting::Fps(5)));
        for value in ["0", "61", "x", "-1"] {
            assert!(Setting::read("fps", value).is_err(), "{value}");
        }
    }
}
