//! The words that could follow a verb of the console and the words before, with what each means.

use super::offer::Names;
use super::table::HANGAR_DEEDS;
use crate::alert::AlertKind;
use crate::app::room_list::Room;
use crate::app::setting::Setting;
use crate::config::Column;
use crate::language::ranges;
use crate::text;
use crate::text::Text;

type Following<'n> = Vec<(&'n str, Text)>;

pub(super) fn nothing<'n>(_: &Names<'n>, _: &[&str]) -> Following<'n> {
    Vec::new()
}

pub(super) fn rooms<'n>(_: &Names<'n>, before: &[&str]) -> Following<'n> {
    first(before, || {
        Room::ALL
            .map(|room| (room.name(), room.explained()))
            .to_vec()
    })
}

pub(super) fn themes<'n>(names: &Names<'n>, before: &[&str]) -> Following<'n> {
    first(before, || {
        let themes = names.themes.iter();
        themes
            .map(|name| (name.as_str(), text!("console-kind-theme")))
            .collect()
    })
}

pub(super) fn missions<'n>(names: &Names<'n>, before: &[&str]) -> Following<'n> {
    first(before, || {
        let missions = names.missions.iter();
        missions
            .map(|it| (it.id.as_str(), it.title.clone()))
            .collect()
    })
}

pub(super) fn injects<'n>(names: &Names<'n>, before: &[&str]) -> Following<'n> {
    first(before, || {
        let injects = names.injects.unwrap_or_default().iter();
        injects
            .map(|it| (it.name.as_str(), it.title.clone()))
            .collect()
    })
}

pub(super) fn macros<'n>(names: &Names<'n>, before: &[&str]) -> Following<'n> {
    first(before, || {
        let macros = names.macros.iter();
        macros
            .map(|(name, lines)| (name.as_str(), Text::verbatim(lines.join("; "))))
            .collect()
    })
}

pub(super) fn groups<'n>(names: &Names<'n>, before: &[&str]) -> Following<'n> {
    first(before, || {
        let groups = names.groups.iter();
        groups
            .map(|(name, ids)| (name.as_str(), ranges(ids.iter().copied()).into()))
            .collect()
    })
}

/// The names of settings, then their values.
pub(super) fn settings<'n>(names: &Names<'n>, before: &[&str]) -> Following<'n> {
    match before {
        [] => Setting::NAMES
            .iter()
            .map(|name| (*name, Setting::explained(name)))
            .collect(),
        ["theme"] => themes(names, &[]),
        [name] => Setting::values(name)
            .iter()
            .map(|value| (*value, Setting::explained(name)))
            .collect(),
        _ => Vec::new(),
    }
}

pub(super) fn params<'n>(_: &Names<'n>, before: &[&str]) -> Following<'n> {
    first(before, || unexplained(["fetch", "save", "load", "diff"]))
}

pub(super) fn processes<'n>(_: &Names<'n>, before: &[&str]) -> Following<'n> {
    first(before, || unexplained(HANGAR_DEEDS.map(|(name, _)| name)))
}

pub(super) fn columns<'n>(_: &Names<'n>, _: &[&str]) -> Following<'n> {
    unexplained(Column::NAMES.iter().copied())
}

pub(super) fn alerts<'n>(_: &Names<'n>, _: &[&str]) -> Following<'n> {
    unexplained(AlertKind::NAMES.iter().copied())
}

/// Words that only the first after the verb could be.
fn first<'n>(before: &[&str], words: impl FnOnce() -> Following<'n>) -> Following<'n> {
    if before.is_empty() {
        words()
    } else {
        Vec::new()
    }
}

fn unexplained<'n>(words: impl IntoIterator<Item = &'n str>) -> Following<'n> {
    let words = words.into_iter();
    words.map(|word| (word, Text::default())).collect()
}
