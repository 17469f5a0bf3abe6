//! The theme file: `inherits = "NAME"` and a table `[roles]` of styles.

use std::collections::BTreeMap;
use std::str::FromStr;

use ratatui::style::{Color, Modifier, Style};
use serde::Deserialize;
use toml::Spanned;

use super::{EMBEDDED, Role};
use crate::diagnostic::Diagnostic;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ThemeFile {
    inherits: Option<Spanned<String>>,
    #[serde(default)]
    roles: BTreeMap<Spanned<String>, StyleEntry>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a field of the theme file"
)]
struct StyleEntry {
    fg: Option<Spanned<String>>,
    bg: Option<Spanned<String>>,
    bold: bool,
    dim: bool,
    italic: bool,
    underline: bool,
    reverse: bool,
}

/// The styles of a theme file, with the inherited ones.
pub fn read(source: &str) -> Result<BTreeMap<Role, Style>, Vec<Diagnostic>> {
    let file: ThemeFile =
        toml::from_str(source).map_err(|error| vec![Diagnostic::from_toml(&error)])?;
    let mut faults = Vec::new();
    let mut styles = match &file.inherits {
        Some(parent) => inherited(parent, &mut faults),
        None => BTreeMap::new(),
    };
    for (name, entry) in &file.roles {
        let known = Role::ALL.iter().find(|(known, _)| *known == name.get_ref());
        let Some(&(_, role)) = known else {
            let names = Role::ALL.iter().map(|&(name, _)| name);
            faults.push(
                Diagnostic::new(name.span(), format!("unknown role `{}`", name.get_ref()))
                    .with_nearest(name.get_ref(), names),
            );
            continue;
        };
        styles.insert(role, style(entry, &mut faults));
    }
    for (name, role) in Role::ALL {
        if faults.is_empty() && !styles.contains_key(&role) {
            faults.push(
                Diagnostic::new(0..0, format!("the role `{name}` has no style"))
                    .with_help("give it one under [roles], or inherit it: inherits = \"dark\""),
            );
        }
    }
    if faults.is_empty() {
        Ok(styles)
    } else {
        Err(faults)
    }
}

fn inherited(parent: &Spanned<String>, faults: &mut Vec<Diagnostic>) -> BTreeMap<Role, Style> {
    let name = parent.get_ref();
    let source = EMBEDDED.iter().find(|(known, _)| known == name);
    let styles = source.and_then(|(_, source)| read(source).ok());
    styles.unwrap_or_else(|| {
        let names = EMBEDDED.iter().map(|&(name, _)| name);
        faults.push(
            Diagnostic::new(parent.span(), format!("no theme is named `{name}`"))
                .with_nearest(name, names),
        );
        BTreeMap::new()
    })
}

fn style(entry: &StyleEntry, faults: &mut Vec<Diagnostic>) -> Style {
    let mut style = Style::new();
    style.fg = entry.fg.as_ref().and_then(|text| colour(text, faults));
    style.bg = entry.bg.as_ref().and_then(|text| colour(text, faults));
    let modifiers = [
        (entry.bold, Modifier::BOLD),
        (entry.dim, Modifier::DIM),
        (entry.italic, Modifier::ITALIC),
        (entry.underline, Modifier::UNDERLINED),
        (entry.reverse, Modifier::REVERSED),
    ];
    for (wanted, modifier) in modifiers {
        if wanted {
            style = style.add_modifier(modifier);
        }
    }
    style
}

fn colour(text: &Spanned<String>, faults: &mut Vec<Diagnostic>) -> Option<Color> {
    let parsed = Color::from_str(text.get_ref()).ok();
    if parsed.is_none() {
        faults.push(
            Diagnostic::new(text.span(), format!("`{}` is no colour", text.get_ref()))
                .with_help("write \"#rrggbb\", a name such as \"light-red\", or 0 to 255 as text"),
        );
    }
    parsed
}
