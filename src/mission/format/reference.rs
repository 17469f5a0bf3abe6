//! The reference for mission files, in Markdown, generated from their description.

use std::fmt::Write as _;

use super::POINT_RANGE;
use super::description::{FileKey, FileShape, FileTableDescription, Presence};
use super::value::spaced;

/// The maximum number of names listed within a row; longer lists have their own table in the guide.
const FEW: usize = 4;

/// The reference for a mission file: its head, then each section with its keys and kinds.
pub(in crate::mission) fn reference(file: &FileTableDescription) -> String {
    let (sections, head): (Vec<&FileKey>, Vec<&FileKey>) = file
        .keys
        .iter()
        .partition(|key| key.shape.table().is_some());
    let mut out = "### Before the first section\n\n".to_owned();
    out += &rows(head.into_iter());
    for section in sections {
        let brackets = match section.shape {
            FileShape::List(..) => ["[[", "]]"],
            _ => ["[", "]"],
        };
        let [open, close] = brackets;
        let needed = match section.presence {
            Presence::Needed => " Required.",
            Presence::Optional | Presence::Default(_) => "",
        };
        let (name, about) = (&section.name, section.about);
        // Writing to a `String` cannot fail.
        _ = writeln!(
            out,
            "\n### `{open}{name}{close}`\n\n{}.{needed}\n",
            capital(about)
        );
        if let Some(table) = section.shape.table() {
            out += &table_reference(table);
        }
    }
    out
}

fn table_reference(table: &FileTableDescription) -> String {
    let mut out = rows(table.keys.iter());
    let inner = table.keys.iter().filter_map(|key| key.shape.table());
    for kind in table
        .kinds
        .iter()
        .chain(inner.flat_map(|table| &table.kinds))
    {
        _ = writeln!(out, "\n**`{}`**: {}.", kind.name, kind.about);
        if !kind.own.keys.is_empty() {
            _ = write!(out, "\n{}", rows(kind.own.keys.iter()));
        }
    }
    out
}

/// A row for each key. Keys of inner tables have their outer key as a prefix; a key and its translation share a row.
fn rows<'k>(keys: impl Iterator<Item = &'k FileKey>) -> String {
    let mut out = "| key | value | default | meaning |\n| --- | --- | --- | --- |\n".to_owned();
    for key in keys {
        add_rows(&mut out, "", key);
    }
    out
}

fn add_rows(out: &mut String, before: &str, key: &FileKey) {
    let name = format!("{before}{}", key.name);
    let default = match &key.presence {
        Presence::Needed => "required",
        Presence::Optional => "none",
        Presence::Default(default) => default,
    };
    let (value, about) = (key.shape.words(), key.about);
    _ = writeln!(out, "| `{name}` | {value} | {default} | {about} |");
    let Some(inner) = key.shape.table() else {
        return;
    };
    let mark = match key.shape {
        FileShape::List(..) => "[].",
        _ => ".",
    };
    for inner_key in &inner.keys {
        add_rows(out, &format!("{name}{mark}"), inner_key);
    }
}

impl FileShape {
    /// The table in this shape, directly or in a list.
    fn table(&self) -> Option<&FileTableDescription> {
        match self {
            Self::Table(table) => Some(table),
            Self::List(of, ..) => of.table(),
            Self::Number(..)
            | Self::Whole(..)
            | Self::Flag
            | Self::Text(..)
            | Self::Numbers { .. }
            | Self::Words(_)
            | Self::Named(..)
            | Self::NumberOrWord(_)
            | Self::Map(..) => None,
        }
    }

    fn words(&self) -> String {
        match self {
            Self::Number(low, high, unit) => format!("{low} to {high}{}", spaced(unit)),
            Self::Whole(0, u32::MAX, unit) => format!("a whole number{}", spaced(unit)),
            Self::Whole(low, high, unit) if low == high => format!("{low}{}", spaced(unit)),
            Self::Whole(low, high, unit) => format!("{low} to {high}{}, whole", spaced(unit)),
            Self::Flag => "`true`, `false`".to_owned(),
            Self::Text("", _) => "text".to_owned(),
            Self::Text(form, _) | Self::NumberOrWord(form) => (*form).to_owned(),
            Self::Numbers {
                form, low, high, ..
            } if *low == -POINT_RANGE && *high == POINT_RANGE => {
                format!("`{form}`")
            }
            Self::Numbers {
                form,
                low,
                high,
                unit,
                ..
            } => format!("`{form}`, {low} to {high}{}", spaced(unit)),
            Self::Words(words) => format!("`{}`", words.join("`, `")),
            Self::Named(_, names) if names.len() <= FEW => format!("`{}`", names.join("`, `")),
            Self::Named(what, _) => format!("a {what}"),
            Self::List(of, least, most) => {
                let of = of.words();
                match (least, most) {
                    (_, &usize::MAX) => format!("a list; each: {of}"),
                    (0, most) => format!("a list of up to {most}; each: {of}"),
                    (least, most) => format!("a list of {least} to {most}; each: {of}"),
                }
            }
            Self::Map(names, of) => format!("a table; for each {names}: {}", of.words()),
            Self::Table(_) => "a table".to_owned(),
        }
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters
        .next()
        .map(|letter| letter.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}
