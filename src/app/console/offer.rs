//! What the console's own lines could be: the names that may stand in them, completions, and whole lines.

use std::collections::BTreeMap;

use super::swarm;
use super::{CONSOLE_VERBS, HANGAR_DEEDS, Kind, find};
use crate::app::room_list::Room;
use crate::app::setting::Setting;
use crate::app::state::{Groups, MissionListing, ranges};
use crate::language::Completion;
use crate::mission::Inject;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// The names that words of a console line may be, besides vehicles.
#[derive(Debug, Clone, Copy)]
pub struct Names<'a> {
    /// The themes.
    pub themes: &'a [String],
    /// The missions: id and title.
    pub missions: &'a [MissionListing],
    /// What an instructor may have happen in the mission; `None` without one under way.
    pub injects: Option<&'a [Inject]>,
    /// The macros.
    pub macros: &'a BTreeMap<String, Vec<String>>,
    /// The groups.
    pub groups: &'a Groups,
}

impl<'a> Names<'a> {
    /// The words that could follow a verb, with what each means.
    pub(super) fn following(&self, kind: Kind, before: &[&str]) -> Vec<(&'a str, Text)> {
        match (kind, before) {
            (Kind::Theme, []) | (Kind::Set, ["theme"]) => listed(self.themes, "console-kind-theme"),
            (Kind::Show, []) => Room::ALL
                .map(|room| (room.name(), room.explained()))
                .to_vec(),
            (Kind::Fly, []) => {
                let listing = |it: &'a MissionListing| (it.id.as_str(), it.title.clone());
                self.missions.iter().map(listing).collect()
            }
            (Kind::Inject, []) => {
                let inject = |it: &'a Inject| (it.name.as_str(), it.title.clone());
                self.injects
                    .unwrap_or_default()
                    .iter()
                    .map(inject)
                    .collect()
            }
            (Kind::Macro, []) => {
                let lines = |(name, lines): (&'a String, &'a Vec<String>)| {
                    (name.as_str(), Text::verbatim(lines.join("; ")))
                };
                self.macros.iter().map(lines).collect()
            }
            (Kind::Set, []) => Setting::NAMES
                .iter()
                .map(|name| (*name, Setting::explained(name)))
                .collect(),
            (Kind::Set, [name]) => Setting::values(name)
                .iter()
                .map(|value| (*value, Setting::explained(name)))
                .collect(),
            (Kind::Group, []) => {
                let group = |(name, ids): (&'a String, &'a Vec<VehicleId>)| {
                    (name.as_str(), ranges(ids.iter().copied()).into())
                };
                self.groups.iter().map(group).collect()
            }
            (Kind::Params, []) => ["fetch", "save", "load", "diff"]
                .map(|deed| (deed, Text::default()))
                .to_vec(),
            (Kind::Hangar, []) => HANGAR_DEEDS
                .map(|(deed, _)| (deed, Text::default()))
                .to_vec(),
            (Kind::Swarm(verb), _) => {
                let choices = swarm::choices(verb).into_iter();
                choices.map(|choice| (choice, Text::default())).collect()
            }
            _ => Vec::new(),
        }
    }
}

fn listed<'a>(names: &'a [String], kind: &'static str) -> Vec<(&'a str, Text)> {
    let described = |name: &'a String| (name.as_str(), Text::new(kind, Vec::new()));
    names.iter().map(described).collect()
}

/// What could stand at the end of the line, if the console itself has something to offer.
pub fn complete(line: &str, cursor: usize, names: &Names<'_>) -> Vec<Completion> {
    let before = line.get(..cursor).unwrap_or(line);
    let start = last_word(before);
    let (head, word) = before.split_at(start);
    let completion = |text: &str, hint: Text| Completion {
        text: text.to_owned(),
        hint,
        replaces: start..before.len(),
    };
    let head: Vec<&str> = head.split_whitespace().collect();
    let Some((verb, arguments)) = head.split_first() else {
        let fitting = CONSOLE_VERBS
            .iter()
            .filter(|verb| verb.name.starts_with(word));
        return fitting
            .map(|verb| completion(verb.name, verb.summary()))
            .collect();
    };
    let Some(verb) = find(verb) else {
        return Vec::new();
    };
    let following = names.following(verb.kind, arguments).into_iter();
    following
        .filter(|(name, _)| name.starts_with(word))
        .map(|(name, hint)| completion(name, hint))
        .collect()
}

/// Every line that the console could carry out as it stands, with what it means: rooms, missions, macros, settings.
pub fn lines(names: &Names<'_>) -> Vec<(String, Text)> {
    let mut found = Vec::new();
    for verb in CONSOLE_VERBS {
        match verb.kind {
            Kind::Plain(_) => found.push((verb.name.to_owned(), verb.summary())),
            Kind::Set => {
                for (name, _) in names.following(Kind::Set, &[]) {
                    let values = names.following(Kind::Set, &[name]).into_iter();
                    found.extend(values.map(|(value, hint)| (format!("set {name} {value}"), hint)));
                }
            }
            // The same as `set theme`.
            Kind::Theme | Kind::Group | Kind::Params | Kind::Hangar => {}
            kind => {
                let words = names.following(kind, &[]).into_iter();
                found.extend(words.map(|(word, hint)| (format!("{} {word}", verb.name), hint)));
            }
        }
    }
    found
}

/// Where the last word of a text begins. Blanks may be longer than a byte.
pub fn last_word(text: &str) -> usize {
    text.char_indices()
        .rfind(|(_, c)| c.is_whitespace())
        .map_or(0, |(at, blank)| at + blank.len_utf8())
}
