//! The state of the objectives.

use super::journal::JournalEntry;
use crate::mission::objective::{
    Objective, ObjectiveDetails, ObjectiveScene, ObjectiveStanding, Tracker,
};
use crate::mission::world::World;
use crate::scoring::EventKind;
use crate::text;
use crate::vehicle::Severity;

/// The trackers of the objectives, in the order of the file.
#[derive(Debug, Clone, Default)]
pub(super) struct Goals {
    trackers: Vec<Box<dyn Tracker>>,
    /// Which objectives were met at the last report.
    met: Vec<bool>,
}

impl Goals {
    pub fn new(objectives: &[Objective], world: &World) -> Self {
        let trackers = objectives.iter().map(|it| it.kind.start(world));
        Self {
            trackers: trackers.collect(),
            met: vec![false; objectives.len()],
        }
    }

    /// Advances by a tick; returns the state of each objective.
    pub fn step(&mut self, scene: &ObjectiveScene<'_>) -> Vec<ObjectiveStanding> {
        for tracker in &mut self.trackers {
            tracker.step(scene);
        }
        self.standings(scene)
    }

    pub fn standings(&self, scene: &ObjectiveScene<'_>) -> Vec<ObjectiveStanding> {
        let trackers = self.trackers.iter();
        trackers.map(|tracker| tracker.standing(scene)).collect()
    }

    /// For each objective, whether it can certainly not be met any more.
    pub fn out_of_reach(&self, scene: &ObjectiveScene<'_>) -> Vec<bool> {
        let trackers = self.trackers.iter();
        trackers
            .map(|tracker| tracker.is_out_of_reach(scene))
            .collect()
    }

    pub fn details(&self, scene: &ObjectiveScene<'_>) -> Vec<ObjectiveDetails> {
        let trackers = self.trackers.iter();
        trackers.map(|tracker| tracker.details(scene)).collect()
    }

    /// The entries about objectives that have been met, or are open again, since the last call.
    pub fn changes(
        &mut self,
        objectives: &[Objective],
        standings: &[ObjectiveStanding],
        scene: &ObjectiveScene<'_>,
    ) -> Vec<JournalEntry> {
        let mut entries = Vec::new();
        let states = self.trackers.iter().zip(&mut self.met);
        for ((objective, standing), (tracker, met)) in objectives.iter().zip(standings).zip(states)
        {
            if standing.met == *met {
                continue;
            }
            *met = standing.met;
            let (title, result) = (&objective.title, tracker.details(scene).result);
            let text = if standing.met {
                text!("mission-objective-met", objective = title, result = result)
            } else {
                text!("mission-objective-open", objective = title, result = result)
            };
            let kind = EventKind::Objective;
            entries.push(JournalEntry::new(kind, Severity::Notice, text));
        }
        entries
    }

    /// The objectives' trackers, in the order of the mission file.
    pub fn trackers(&self) -> impl Iterator<Item = &dyn Tracker> {
        self.trackers.iter().map(AsRef::as_ref)
    }
}
