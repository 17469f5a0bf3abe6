//! Faults of meaning: a mission that can be parsed, but not flown as intended.
//!
//! [`Mission::check`] examines the relations between sections. The kind of an objective returns its demands
//! ([`Demands`]); the mission has the position of each value in the file.
//!
//! # How the parts fit
//! - Can it be flown: `room` (every place is allowed), `board` (the plans on board stay inside the fences), `zones`,
//!   `budget` (the fleet is affordable), `events` (each can occur).
//! - Can it be passed, and not without effort: `reach` (objectives, with this equipment and in this time), `idle`
//!   (nothing is met by doing nothing), `scores` (points and medals), `hints` (they do not give too much away).
//! - What one file cannot show: `others`, references to other missions.

use std::ops::Range;

use super::Mission;
use super::format::WrittenValue;
use super::objective::{Demands, Objective};
use crate::diagnostic::Diagnostic;
use crate::text::Text;

mod board;
mod budget;
mod events;
mod hints;
mod idle;
mod others;
mod reach;
mod room;
mod scores;
mod zones;

struct Examined<'m> {
    mission: &'m Mission,
    found: Vec<Diagnostic>,
}

/// The demands of an objective, and its position in the file.
struct ExaminedObjective<'m> {
    demands: Demands<'m>,
    written: &'m WrittenValue,
}

impl Mission {
    /// The faults of a mission whose sections are all valid: places out of bounds, objectives that cannot be met or
    /// are met from the start. In file order.
    pub fn check(&self) -> Vec<Diagnostic> {
        let mut examined = Examined {
            mission: self,
            found: Vec::new(),
        };
        zones::check(&mut examined);
        room::check(&mut examined);
        board::check(&mut examined);
        budget::check(&mut examined);
        reach::check(&mut examined);
        idle::check(&mut examined);
        events::check(&mut examined);
        scores::check(&mut examined);
        hints::check(&mut examined);
        let mut found = examined.found;
        found.sort_by_key(|fault| fault.span.start);
        found
    }
}

impl<'m> Examined<'m> {
    fn add(&mut self, place: Range<usize>, message: impl Into<Text>) {
        self.found.push(Diagnostic::new(place, message));
    }

    /// A section of the file that is a table.
    fn section(&self, name: &str) -> Option<&'m WrittenValue> {
        self.mission.file.written.get(name)
    }

    /// The tables of a section that can occur several times.
    fn tables(&self, name: &str) -> &'m [WrittenValue] {
        self.mission.file.written.items_of(name)
    }

    fn objectives(&self) -> impl Iterator<Item = ExaminedObjective<'m>> + use<'m> {
        let objectives = self.mission.objectives.iter();
        let all = objectives.zip(self.tables("objectives"));
        all.map(|(objective, written): (&Objective, _)| ExaminedObjective {
            demands: objective.kind.demands(),
            written,
        })
    }

    /// The greatest height that the rules and the fences allow.
    fn ceiling_m(&self) -> f64 {
        let fences = self.mission.site.zones.iter().filter(|zone| zone.active);
        let ceilings = fences.filter_map(|zone| zone.kind.fence_ceiling_m());
        ceilings.fold(self.mission.rules.max_height_m, f64::min)
    }
}
