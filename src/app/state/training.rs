//! The missions, designs and fleets of the trainee, and the results so far.

use std::collections::BTreeMap;

use super::{Career, MissionListing};
use crate::app::effect::Launch;
use crate::campaign::Reward;
use crate::review::Review;
use crate::scoring::TryReport;
use crate::text::Text;
use crate::workshop::Design;

/// The missions, the designs, the profiles and the current trainee's career.
#[derive(Debug, Clone, Default)]
pub struct Training {
    pub(in crate::app) missions: Vec<MissionListing>,
    /// The trainee's attempts at the missions' current revisions, by mission id, oldest first.
    pub(in crate::app) tries: BTreeMap<String, Vec<TryReport>>,
    /// The trainee's newest review of each mission, by mission id.
    pub(in crate::app) reviews: BTreeMap<String, Review>,
    /// The trainee's career; `None` without a profile.
    pub(in crate::app) career: Option<Career>,
    /// The rewards of the last flight; `None` once another session has started.
    pub(in crate::app) reward: Option<Reward>,
    /// The number of flights that could not be stored yet, and are lost if the program ends.
    pub(in crate::app) at_risk: usize,
    /// The names of all profiles.
    pub(in crate::app) profiles: Vec<String>,
    /// The designs chosen for missions, by mission id: one for all seats or one per seat; empty if
    /// the mission lends its drones.
    pub(in crate::app) fleets: BTreeMap<String, Vec<Design>>,
    /// The designs that all users share: those of the program and of the administrator.
    pub(in crate::app) stock: Vec<Design>,
}

/// One line of the list of profiles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Trainee {
    /// A saved profile, by its name.
    Known(String),
    /// The entry to create a profile.
    New,
    /// A guest, whose flights are not saved.
    Guest,
}

impl Training {
    pub fn missions(&self) -> &[MissionListing] {
        &self.missions
    }

    /// The trainee's career; `None` without a profile.
    pub fn career(&self) -> Option<&Career> {
        self.career.as_ref()
    }

    /// The rewards of the last flight; `None` once another session has started.
    pub fn reward(&self) -> Option<&Reward> {
        self.reward.as_ref()
    }

    /// The trainee's attempts at a mission's current revision, oldest first.
    pub fn tries(&self, mission: &str) -> &[TryReport] {
        self.tries.get(mission).map_or(&[], Vec::as_slice)
    }

    /// The trainee's best attempt that counts and earned points; the first one if several are
    /// equal.
    pub fn best_try(&self, mission: &str) -> Option<&TryReport> {
        let tries = self.tries(mission).iter();
        let ended = tries.filter(|one| one.score > Some(0) && !one.is_practice);
        ended.rev().max_by_key(|one| one.score)
    }

    /// The designs chosen for a mission, which are dealt to the seats of their kinds; empty if the
    /// mission lends its vehicles.
    pub fn fleet(&self, mission: &str) -> &[Design] {
        self.fleets.get(mission).map_or(&[], Vec::as_slice)
    }

    /// A graded flight of a mission with the drones chosen for it.
    pub fn launch(&self, mission: &str) -> Launch {
        Launch {
            fleet: self.fleet(mission).to_vec(),
            ..Launch::graded(mission)
        }
    }

    /// Why the mission is locked for the trainee; `None` if it is open, or without a profile.
    pub fn lock(&self, mission: &str) -> Option<Text> {
        self.career.as_ref()?.lock(mission)
    }

    /// The entries of the list of profiles, in order.
    pub fn trainees(&self) -> Vec<Trainee> {
        let known = self.profiles.iter().cloned().map(Trainee::Known);
        known.chain([Trainee::New, Trainee::Guest]).collect()
    }

    /// Whether this is the current trainee.
    pub fn is_current(&self, trainee: &Trainee) -> bool {
        let current = self.career.as_ref().map(|career| &career.name);
        match trainee {
            Trainee::Known(name) => current == Some(name),
            Trainee::New => false,
            Trainee::Guest => current.is_none(),
        }
    }
}
