//! The theme file: `inherits = "NAME"` and a table `[roles]` of styles.

use std::collections::BTreeMap;
use std::ops::Range;
use std::str::FromStr;

use ratatui::style::{Color, Modifier, Style};
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Role, Theme, ThemeFile, Themes};
use crate::diagnostic::Diagnostic;
use crate::text;

type Styles = BTreeMap<Role, Style>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ThemeDocument {
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

/// The themes being read, each inherited by the theme before it.
pub struct Lineage<'a> {
    themes: &'a Themes,
    names: Vec<String>,
}

impl<'a> Lineage<'a> {
    pub fn new(themes: &'a Themes, name: &str) -> Self {
        let names = vec![name.to_owned()];
        Self { themes, names }
    }

    fn inherited(&self, parent: &Spanned<String>) -> Result<Styles, Diagnostic> {
        let name = parent.get_ref();
        if let Some(circle) = self.circle(name) {
            let text = text!("theme-circle", circle = circle);
            return Err(Diagnostic::new(parent.span(), text));
        }
        let is_itself = self.names.last() == Some(name);
        if let Some(file) = self.own(name) {
            let further = Self {
                themes: self.themes,
                names: [&self.names[..], std::slice::from_ref(name)].concat(),
            };
            return read(&file.text, &further).map_err(|faults| {
                let first = faults
                    .first()
                    .map(|fault| fault.text(&file.path, &file.text));
                let text = text!("theme-faulty-parent", name = name);
                Diagnostic::new(parent.span(), text).with_help(first.unwrap_or_default())
            });
        }
        // An embedded theme inherits only embedded ones.
        let embedded = Theme::named(name).map(|theme| theme.styles);
        embedded.ok_or_else(|| {
            let text = if is_itself {
                text!("theme-inherits-itself", name = name)
            } else {
                text!("theme-unknown", name = name)
            };
            let known = self.themes.names();
            let others = known.filter(|known| !self.names.iter().any(|name| name == known));
            Diagnostic::new(parent.span(), text).with_nearest(name, others)
        })
    }

    /// The theme file for `name`, not the embedded theme. If a user's `dark` inherits `dark`, it
    /// inherits the embedded one.
    fn own(&self, name: &str) -> Option<&'a ThemeFile> {
        let is_itself = self.names.last().is_some_and(|last| last == name);
        self.themes.own(name).filter(|_| !is_itself)
    }

    /// The themes of the inheritance cycle through `parent`, if there is one.
    fn circle(&self, parent: &str) -> Option<String> {
        let mut names = self.names.clone();
        let mut next = parent.to_owned();
        loop {
            let here = Self {
                themes: self.themes,
                names,
            };
            let file = here.own(&next)?;
            names = here.names;
            let is_passed = names.contains(&next);
            names.push(next);
            if is_passed {
                return Some(names.join(" -> "));
            }
            let document: ThemeDocument = toml::from_str(&file.text).ok()?;
            next = document.inherits?.into_inner();
        }
    }
}

/// The styles of a theme file, with the inherited ones.
pub fn read(source: &str, lineage: &Lineage<'_>) -> Result<Styles, Vec<Diagnostic>> {
    let faults = roles_without_table(source);
    if !faults.is_empty() {
        return Err(faults);
    }
    let file: ThemeDocument =
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
            faults.push(unknown_role(name.get_ref(), name.span()));
            continue;
        };
        styles.insert(role, style(entry, &mut faults));
    }
    for (_, role) in Role::ALL {
        let stand_in = role.stand_in().and_then(|other| styles.get(&other));
        if let Some(&style) = stand_in {
            styles.entry(role).or_insert(style);
        }
    }
    for (name, role) in Role::ALL {
        if faults.is_empty() && !styles.contains_key(&role) {
            faults.push(
                Diagnostic::new(0..0, text!("theme-no-style", name = name))
                    .with_help(text!("theme-no-style-advice")),
            );
        }
    }
    if faults.is_empty() {
        Ok(styles)
    } else {
        Err(faults)
    }
}

/// The faults of roles that are not tables, because the TOML reader's messages would name Rust types.
fn roles_without_table(source: &str) -> Vec<Diagnostic> {
    let (document, _) = DeTable::parse_recoverable(source);
    let roles = document.get_ref().get("roles").map(Spanned::get_ref);
    let Some(DeValue::Table(roles)) = roles else {
        return Vec::new();
    };
    let mut faults = Vec::new();
    for (name, value) in roles {
        let word = name.get_ref().as_ref();
        if !matches!(value.get_ref(), DeValue::Table(_)) {
            let colour = value.get_ref().as_str().unwrap_or("#ff0000");
            let example = format!("{word} = {{ fg = \"{colour}\" }}");
            let text = text!("theme-role-table", name = word);
            let help = text!("theme-role-table-advice", example = example);
            faults.push(Diagnostic::new(value.span(), text).with_help(help));
            if Role::ALL.iter().all(|(known, _)| *known != word) {
                faults.push(unknown_role(word, name.span()));
            }
        }
    }
    faults.sort_by_key(|fault| fault.span.start);
    faults
}

fn unknown_role(name: &str, span: Range<usize>) -> Diagnostic {
    let names = Role::ALL.map(|(name, _)| name);
    Diagnostic::new(span, text!("theme-unknown-role", name = name))
        .with_help(text!("theme-roles-are", roles = names.join(", ")))
        .with_nearest(name, names)
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

fn colour(written: &Spanned<String>, faults: &mut Vec<Diagnostic>) -> Option<Color> {
    let parsed = Color::from_str(written.get_ref()).ok();
    if parsed.is_none() {
        faults.push(
            Diagnostic::new(
                written.span(),
                text!("theme-no-colour", word = written.get_ref()),
            )
            .with_help(text!("theme-no-colour-advice")),
        );
    }
    parsed
}
