//! A mission's requirements of a career, and its rewards.

use std::collections::BTreeMap;

use crate::scoring::Medal;

/// What a trainee must have achieved before the mission is offered.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Requires {
    /// Missions that have to be passed, by id.
    pub missions: Vec<String>,
    /// The least medal for each listed mission, by id.
    pub medals: BTreeMap<String, Medal>,
    /// The least probability of mastery of each skill, 0 to 1, by its code `K1` to `K12`.
    pub skills: BTreeMap<String, f64>,
}

/// What passing the mission brings.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Rewards {
    /// Credits for a perfect first pass.
    pub credits: u32,
    /// The tier that sets the experience; the mission's own by default.
    pub xp_tier: u8,
    pub unlock: Vec<Unlock>,
}

/// What passing a mission unlocks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unlock {
    /// A part of the catalogue, by id.
    Part(String),
    /// Another mission, by id.
    Mission(String),
    /// A threat that an instructor may trigger.
    Threat(String),
}

/// Limits of the fleet: its price, and the drones that are lent.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Outlay {
    /// Credits for the whole fleet; `None` without a limit.
    pub budget: Option<u32>,
    /// Designs lent to trainees that own no suitable one, by id.
    pub loaners: Vec<String>,
}
