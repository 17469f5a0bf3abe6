//! A mission's requirements of a career, and its rewards.

use std::collections::BTreeMap;

use crate::scoring::Medal;

/// What a trainee must have shown before the mission is on offer.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Requires {
    /// Missions that have to be passed, by id.
    pub missions: Vec<String>,
    /// Missions that need a medal, or a better one.
    pub medals: BTreeMap<String, Medal>,
    /// How likely skills have to be mastered, 0 to 1, by their codes `K1` to `K12`.
    pub skills: BTreeMap<String, f64>,
}

/// What passing the mission brings.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Rewards {
    /// Credits for a perfect first pass.
    pub credits: u32,
    /// The tier that experience is counted with; the mission's own where none is written.
    pub xp_tier: u8,
    pub unlock: Vec<Unlock>,
}

/// Something that a passed mission makes available.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unlock {
    /// A part of the catalogue, by id.
    Part(String),
    /// Another mission, by id.
    Mission(String),
    /// A threat that an instructor may have happen.
    Threat(String),
}

/// What may be flown: the fleet's price and its stand-ins.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Outlay {
    /// Credits for all that is flown; `None` where money is no object.
    pub budget: Option<u32>,
    /// Designs that are lent to those who own nothing fit, by id.
    pub loaners: Vec<String>,
}
