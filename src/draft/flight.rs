//! The figures of a trial: how each draft was flown, and how close the vehicles came to each other.

use crate::rehearsal::{Approach, Flown, Outcome};
use crate::vehicle_id::VehicleId;

/// The flights of a trial.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TrialFlight {
    /// The drafts, in their order.
    pub pilots: Vec<TrialPilot>,
    /// The closest approach of each pair of vehicles that were in the air together; the closest
    /// pair first.
    pub closest: Vec<Approach>,
}

/// A draft as it was flown.
#[derive(Debug, Clone, PartialEq)]
pub struct TrialPilot {
    /// The name of the draft.
    pub name: String,
    /// The vehicle, if several fly one draft.
    pub sharer: Option<VehicleId>,
    pub flown: Flown,
}

impl TrialFlight {
    pub(super) fn of(drafts: &[super::TrialDraft], outcome: &Outcome) -> Self {
        let pilots = drafts.iter().zip(&outcome.vehicles);
        Self {
            pilots: pilots
                .map(|(draft, flown)| TrialPilot {
                    name: draft.name.clone(),
                    sharer: draft.sharer,
                    flown: *flown,
                })
                .collect(),
            closest: outcome.closest.clone(),
        }
    }

    /// The pairs of vehicles that came too close to each other.
    pub fn conflicts(&self) -> impl Iterator<Item = &Approach> {
        self.closest.iter().filter(|pair| pair.is_conflict())
    }
}
