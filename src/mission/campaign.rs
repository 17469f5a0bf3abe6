//! A mission's requirements for a career, and its rewards.

use std::collections::BTreeMap;

use crate::scoring::Medal;
use crate::workshop::DesignKind;

/// The achievements required before the mission is offered.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Requires {
    /// Missions that must be passed, by id.
    pub missions: Vec<String>,
    /// The minimum medal for each listed mission, by id.
    pub medals: BTreeMap<String, Medal>,
    /// The minimum probability of mastery of each skill, 0 to 1, by its code `K1` to `K13`.
    pub skills: BTreeMap<String, f64>,
}

/// The rewards for passing the mission.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Rewards {
    /// Credits for a perfect first pass.
    pub credits: u32,
    /// The tier that sets the experience; the mission's own by default.
    pub xp_tier: u8,
    pub unlock: Vec<Unlock>,
}

/// A reward that passing a mission unlocks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unlock {
    /// A part of the catalogue, by id.
    Part(String),
    /// Another mission, by id.
    Mission(String),
    /// A threat that an instructor may trigger.
    Threat(String),
    /// A kind of vehicle: the parts that only this kind takes.
    Vehicle(DesignKind),
}

/// The limits of a fleet: its price, and the drones that are lent.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Outlay {
    /// Credits for the whole fleet; `None` without a limit.
    pub budget: Option<u32>,
    /// Designs lent to trainees who own no suitable one, by id.
    pub loaners: Vec<String>,
}
