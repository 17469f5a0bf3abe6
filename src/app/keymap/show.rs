//! The keymap as a keymap file.

use std::fmt::Write as _;

use super::{Keymap, Meaning, Place};
use crate::app::action::Action;
use crate::text::Locale;

impl Keymap {
    /// An equivalent keymap file. Rows that differ from the default are active; the defaults are comments, ready to
    /// change. Every row has a description.
    pub fn show(&self, locale: &Locale) -> String {
        let default = Self::default();
        let mut text = String::new();
        for place in Place::all() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "[{}] # {}", place.name(), locale.text(&place.title()));
            for binding in self.bindings.iter().filter(|it| it.place == place) {
                let Some(meaning) = written(&binding.meaning) else {
                    continue;
                };
                let mark = if default.bindings.contains(binding) {
                    "# "
                } else {
                    ""
                };
                let (key, meaning) = (quoted(&binding.press.label()), quoted(&meaning));
                let about = locale.text(&self.description(&binding.meaning));
                let _ = writeln!(text, "{mark}{key} = {meaning} # {about}");
            }
            for (press, _) in self.silent.iter().filter(|(_, it)| *it == place) {
                let _ = writeln!(text, "{} = false", quoted(&press.label()));
            }
            text.push('\n');
        }
        let is_bound = |action: Action| {
            let mut bindings = self.bindings.iter();
            bindings.any(|binding| binding.meaning == Meaning::Do(action))
        };
        let unbound = Action::all().filter(|action| !is_bound(*action));
        let free: Vec<&str> = unbound.map(Action::name).collect();
        if !free.is_empty() {
            let _ = writeln!(text, "# without a key: {}", free.join(", "));
        }
        text
    }
}

/// A meaning in the syntax of a keymap file; `None` for [`Meaning::Type`], which is bound to a
/// family of keys rather than to one.
fn written(meaning: &Meaning) -> Option<String> {
    match meaning {
        Meaning::Do(action) => Some(action.name().to_owned()),
        Meaning::Give(line) => Some(line.to_string()),
        Meaning::Write(line) => Some(format!("{} ...", line.trim_end())),
        Meaning::Type => None,
    }
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
