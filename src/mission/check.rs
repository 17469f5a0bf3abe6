//! Faults of sense: a mission that can be read, and cannot be flown as it is meant.
//!
//! [`Mission::check`] looks at what single sections cannot know of one another. It reads the mission's file once
//! more, so that every fault has its place.

use std::ops::Range;
use std::time::Duration;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::zone::ZoneKind;
use super::{Mission, Point};
use crate::diagnostic::Diagnostic;

mod budget;
mod events;
mod idle;
mod others;
mod reach;
mod room;
mod scores;
mod zones;

/// A mission under examination.
struct Examined<'m> {
    mission: &'m Mission,
    root: &'m DeTable<'m>,
    found: Vec<Diagnostic>,
}

/// One table of an array of the file, as it is written.
#[derive(Clone, Copy)]
struct WrittenEntry<'m>(&'m Spanned<DeValue<'m>>);

impl Mission {
    /// What is wrong with it although every section is right: places out of bounds, things that nobody can do, or
    /// that nobody has to do anything for. In the order of the file.
    pub fn check(&self) -> Vec<Diagnostic> {
        // It has been read before.
        let Ok(root) = DeTable::parse(&self.source) else {
            return Vec::new();
        };
        let mut examined = Examined {
            mission: self,
            root: root.get_ref(),
            found: Vec::new(),
        };
        zones::check(&mut examined);
        room::check(&mut examined);
        budget::check(&mut examined);
        reach::check(&mut examined);
        idle::check(&mut examined);
        events::check(&mut examined);
        scores::check(&mut examined);
        let mut found = examined.found;
        found.sort_by_key(|fault| fault.span.start);
        found
    }
}

impl<'m> Examined<'m> {
    fn add(&mut self, place: Range<usize>, message: impl Into<String>) {
        self.found.push(Diagnostic::new(place, message.into()));
    }

    /// A section that is a table.
    fn section(&self, name: &str) -> Option<WrittenEntry<'m>> {
        self.root.get(name).map(WrittenEntry)
    }

    /// The tables of a section that has several.
    fn entries(&self, name: &str) -> Vec<WrittenEntry<'m>> {
        let list = self.root.get(name);
        let list = list.and_then(|value| value.get_ref().as_array());
        list.into_iter().flatten().map(WrittenEntry).collect()
    }

    /// The highest height that the rules and the fences allow.
    fn ceiling_m(&self) -> f64 {
        let fences = self.mission.zones.iter().filter(|zone| zone.active);
        let ceilings = fences.filter_map(|zone| match zone.kind {
            ZoneKind::Geofence { ceiling_m } => ceiling_m,
            _ => None,
        });
        ceilings.fold(self.mission.max_height_m, f64::min)
    }

    /// A pad, or a place of the file.
    fn place(&self, name: &str) -> Option<Point> {
        let pad = name.strip_prefix("pad").and_then(|it| it.parse().ok());
        let pad = pad.and_then(|number: usize| self.mission.pads.get(number.checked_sub(1)?));
        let mut places = self.mission.places.iter();
        let named = places.find(|(known, _)| known == name).map(|(_, at)| at);
        named.or(pad).copied()
    }
}

impl<'m> WrittenEntry<'m> {
    fn span(self) -> Range<usize> {
        self.0.span()
    }

    fn get(self, key: &str) -> Option<Self> {
        self.0.get_ref().get(key).map(WrittenEntry)
    }

    /// The items of an array.
    fn items(self) -> Vec<Self> {
        let list = self.0.get_ref().as_array();
        list.into_iter().flatten().map(WrittenEntry).collect()
    }

    fn text(self) -> Option<&'m str> {
        self.0.get_ref().as_str()
    }

    /// The text of a key.
    fn word(self, key: &str) -> Option<&'m str> {
        self.get(key)?.text()
    }

    fn number(self) -> Option<f64> {
        match self.0.get_ref() {
            DeValue::Integer(number) => {
                let digits = number.as_str();
                i64::from_str_radix(digits, number.radix())
                    .ok()
                    .map(|number| number as f64)
            }
            DeValue::Float(number) => number.as_str().parse().ok(),
            _ => None,
        }
    }

    /// The numbers of an array: a point, a gate, a pair of heights.
    fn numbers(self) -> Vec<f64> {
        self.items().into_iter().filter_map(Self::number).collect()
    }

    /// A length of time by its key, in seconds.
    fn seconds(self, key: &str) -> Option<Duration> {
        let seconds = self.get(key)?.number()?;
        Duration::try_from_secs_f64(seconds).ok()
    }
}
