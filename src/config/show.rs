//! The effective configuration as a configuration file.

use std::fmt::Write as _;

use toml::Value;

use super::{Layers, SETTINGS, Setting, SettingKind};

impl Layers {
    /// A configuration file with every value, and comments with their source. Unset values are comments.
    pub fn show(&self) -> String {
        let mut text = String::new();
        let mut section = "";
        for setting in SETTINGS {
            if setting.section() != section {
                section = setting.section();
                // Writing to a string cannot fail.
                let _ = writeln!(text, "\n[{section}]");
            } else if !text.is_empty() {
                text.push('\n');
            }
            let variable = setting.variable.map(|it| format!(" ({it})"));
            let _ = writeln!(text, "# {}{}", setting.about, variable.unwrap_or_default());
            match setting.kind {
                SettingKind::Lines => self.show_lines(setting, &mut text),
                SettingKind::OneOf(_)
                | SettingKind::Text
                | SettingKind::Whole(..)
                | SettingKind::Flag
                | SettingKind::Words
                | SettingKind::Columns
                | SettingKind::Sort
                | SettingKind::AlertKinds
                | SettingKind::Vehicles => self.show_value(setting, &mut text),
            }
        }
        text
    }

    fn show_value(&self, setting: &Setting, text: &mut String) {
        let key = setting.key();
        let origin = self.origin(setting.name);
        let _ = match self.value(setting.name) {
            Some(value) => writeln!(text, "{key} = {value} # {origin}"),
            None => writeln!(text, "# {key} is not set"),
        };
    }

    fn show_lines(&self, setting: &Setting, text: &mut String) {
        for name in self.names_in(setting.name) {
            if let Some(value) = self.value(name) {
                let key = quoted(&name[setting.name.len() + 1..]);
                let _ = writeln!(text, "{key} = {value} # {}", self.origin(name));
            }
        }
    }
}

/// Every setting as a Markdown table: its name, its default, its environment variable, its meaning.
pub fn setting_reference() -> String {
    let defaults = Layers::default();
    let mut text =
        "| setting | default | variable | meaning |\n| --- | --- | --- | --- |\n".to_owned();
    for setting in SETTINGS {
        let default = match setting.kind {
            SettingKind::Lines => None,
            SettingKind::OneOf(_)
            | SettingKind::Text
            | SettingKind::Whole(..)
            | SettingKind::Flag
            | SettingKind::Words
            | SettingKind::Columns
            | SettingKind::Sort
            | SettingKind::AlertKinds
            | SettingKind::Vehicles => defaults.value(setting.name),
        };
        let shown = default.map(|it| format!("`{it}`")).unwrap_or_default();
        let variable = setting
            .variable
            .map(|it| format!("`{it}`"))
            .unwrap_or_default();
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| `{}` | {shown} | {variable} | {} |",
            setting.name, setting.about
        );
    }
    text
}

/// A key in TOML notation.
fn quoted(key: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !key.is_empty() && key.chars().all(bare) {
        key.to_owned()
    } else {
        Value::String(key.to_owned()).to_string()
    }
}
