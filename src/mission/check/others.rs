//! References to other missions, which cannot be checked with one file alone.

use std::collections::BTreeSet;
use std::ops::Range;

use toml::de::DeTable;

use crate::diagnostic::Diagnostic;
use crate::mission::format::WrittenValue;
use crate::mission::{Mission, Unlock};
use crate::text;

/// A mission that a file names, with the position of the name.
struct NamedMission<'m> {
    id: &'m str,
    written: Range<usize>,
}

impl Mission {
    /// The id in a mission's source, even if the file has faults; `None` if it is not a mission.
    pub fn id_of(source: &str) -> Option<String> {
        let (root, _) = DeTable::parse_recoverable(source);
        let root = root.get_ref();
        root.get("objectives")?;
        root.get("id")?.get_ref().as_str().map(str::to_owned)
    }

    /// References to missions whose ids are not among the known ones: the mission that this one is
    /// a drill of, those that it requires, and those that it unlocks.
    pub fn unknown_missions(&self, known: &BTreeSet<String>) -> Vec<Diagnostic> {
        let named = self.named_missions().into_iter();
        let unknown = named.filter(|named| !known.contains(named.id));
        let fault = |named: NamedMission<'_>| {
            let fault =
                Diagnostic::new(named.written, text!("check-mission-unknown", id = named.id));
            fault.with_nearest(named.id, known.iter().map(String::as_str))
        };
        unknown.map(fault).collect()
    }

    /// The missions that the file names, in file order.
    fn named_missions(&self) -> Vec<NamedMission<'_>> {
        let named = |id, written| NamedMission { id, written };
        let value = |section: &str, key: &str| self.file.written.get(section)?.get(key);
        let items = |section, key| value(section, key).map_or(&[][..], WrittenValue::items);
        let drill = self
            .summary
            .drill_of
            .as_deref()
            .map(|id| named(id, self.file.written.span_of("drill_of")));
        let needed = self
            .career
            .requires
            .missions
            .iter()
            .zip(items("requires", "missions"));
        let medals = self.career.requires.medals.keys().filter_map(|id| {
            let medal = value("requires", "medals")?.get(id)?;
            Some(named(id, medal.key.clone()))
        });
        let unlocked = self
            .career
            .rewards
            .unlock
            .iter()
            .zip(items("rewards", "unlock"))
            .filter_map(|(unlock, written)| match unlock {
                Unlock::Mission(id) => Some(named(id, written.span.clone())),
                Unlock::Part(_) | Unlock::Threat(_) | Unlock::Vehicle(_) => None,
            });
        let mut all: Vec<_> = drill.into_iter().collect();
        all.extend(needed.map(|(id, written)| named(id, written.span.clone())));
        all.extend(medals);
        all.extend(unlocked);
        all.sort_by_key(|named| named.written.start);
        all
    }
}
