//! References to other missions, which a file alone cannot prove.

use std::collections::BTreeSet;
use std::ops::Range;

use toml::de::DeTable;

use super::WrittenEntry;
use crate::diagnostic::Diagnostic;
use crate::mission::Mission;

/// What an unlocked mission is written with.
const MISSION: &str = "mission:";

impl Mission {
    /// The id that a mission's file gives it, also where the file has faults; `None` of a file that is no mission.
    pub fn id_of(source: &str) -> Option<String> {
        let (root, _) = DeTable::parse_recoverable(source);
        let root = root.get_ref();
        root.get("objectives")?;
        root.get("id").map(WrittenEntry)?.text().map(str::to_owned)
    }

    /// References to missions that are not among the known ones, by their ids: what it is a drill of, needs, and
    /// unlocks.
    pub fn unknown_missions(&self, known: &BTreeSet<String>) -> Vec<Diagnostic> {
        let Ok(root) = DeTable::parse(&self.source) else {
            return Vec::new();
        };
        let named = named(root.get_ref()).into_iter();
        let unknown = named.filter(|(name, _)| !known.contains(*name));
        let fault = |(name, place): (&str, Range<usize>)| {
            let fault = Diagnostic::new(place, format!("there is no mission `{name}`"));
            fault.with_nearest(name, known.iter().map(String::as_str))
        };
        unknown.map(fault).collect()
    }
}

/// The missions that a file names, with their places, in its order.
fn named<'m>(root: &'m DeTable<'m>) -> Vec<(&'m str, Range<usize>)> {
    let at = |section: &str, key: &str| root.get(section).map(WrittenEntry)?.get(key);
    let items = |section, key| at(section, key).map_or(Vec::new(), WrittenEntry::items);
    let word = |entry: WrittenEntry<'m>| Some((entry.text()?, entry.span()));
    let drill = root.get("drill_of").map(WrittenEntry).and_then(word);
    let needed = items("requires", "missions").into_iter().filter_map(word);
    let medals = at("requires", "medals").and_then(|entry| entry.0.get_ref().as_table());
    let medals = medals.into_iter().flatten();
    let medals = medals.map(|(key, _)| (key.get_ref().as_ref(), key.span()));
    let unlocked = items("rewards", "unlock").into_iter().filter_map(word);
    let unlocked = unlocked.filter_map(|(text, place)| Some((text.strip_prefix(MISSION)?, place)));
    let mut all: Vec<_> = drill
        .into_iter()
        .chain(needed)
        .chain(medals)
        .chain(unlocked)
        .collect();
    all.sort_by_key(|(_, place)| place.start);
    all
}
