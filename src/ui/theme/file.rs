//! The theme file: `inherits = "NAME"` and a table `[roles]` of styles.

use std::collections::BTreeMap;
use std::str::FromStr;

use ratatui::style::{Color, Modifier, Style};
use serde::Deserialize;
use toml::Spanned;

use super::{Role, Theme, Themes};
use crate::diagnostic::Diagnostic;

type Styles = BTreeMap<Role, Style>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
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

/// The themes that are being read, each inherited by the one before it.
pub struct Lineage<'a> {
    themes: &'a Themes,
    names: Vec<String>,
}

impl<'a> Lineage<'a> {
    pub fn new(themes: &'a Themes, name: &str) -> Self {
        let names = vec![name.to_owned()];
        Self { themes, names }
    }

    /// The styles that the last theme inherits from `parent`, or why there are none.
    fn inherited(&self, parent: &Spanned<String>) -> Result<Styles, Diagnostic> {
        let name = parent.get_ref();
        let is_itself = self.names.last() == Some(name);
        // A user's `dark` that inherits `dark` means the embedded one.
        let own = self.themes.own(name).filter(|_| !is_itself);
        if own.is_some() && self.names.contains(name) {
            let circle = [&self.names[..], std::slice::from_ref(name)]
                .concat()
                .join(" -> ");
            return Err(Diagnostic::new(
                parent.span(),
                format!("themes inherit each other in a circle: {circle}"),
            ));
        }
        if let Some(file) = own {
            let further = Self {
                themes: self.themes,
                names: [&self.names[..], std::slice::from_ref(name)].concat(),
            };
            return read(&file.text, &further).map_err(|faults| {
                let first = faults.first();
                let first = first.map(|fault| fault.one_line(&file.path, &file.text));
                let text = format!("the theme `{name}` is faulty itself");
                Diagnostic::new(parent.span(), text).with_help(first.unwrap_or_default())
            });
        }
        // An embedded theme knows only embedded ones.
        let embedded = Theme::named(name).map(|theme| theme.styles);
        embedded.ok_or_else(|| {
            let text = if is_itself {
                format!("the theme `{name}` inherits itself")
            } else {
                format!("no theme is named `{name}`")
            };
            let known = self.themes.names();
            let others = known.filter(|known| !self.names.iter().any(|name| name == known));
            Diagnostic::new(parent.span(), text).with_nearest(name, others)
        })
    }
}

/// The styles of a theme file, with the inherited ones.
pub fn read(source: &str, lineage: &Lineage<'_>) -> Result<Styles, Vec<Diagnostic>> {
    let file: Document =
        toml::from_str(source).map_err(|error| vec![Diagnostic::from_toml(&error)])?;
    let mut faults = Vec::new();
    let mut styles = match &file.inherits {
        Some(parent) => lineage.inherited(parent).unwrap_or_else(|fault| {
            faults.push(fault);
            Styles::new()
        }),
        None => Styles::new(),
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
