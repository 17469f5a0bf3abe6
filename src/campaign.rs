//! A trainee's career: which missions and parts are open, credits, licences for parts, and skills.
//!
//! A career is an append-only history of [`CareerEntry`]s, which are flights and purchases.
//! Everything else is computed from it: [`CareerStanding::of`] folds a history into credits,
//! experience, licences, parts and skills. The figures are therefore always consistent, and a
//! corrected formula applies to past flights too. Every figure can be traced to its entries.
//!
//! A trainee buys the licence of a part once, and may then use any number of pieces of it in any
//! design. Nothing is sold back. A flight with the trainee's own drones costs credits, also as
//! practice.
//!
//! # How the parts fit
//! - Whether a mission may be flown, and which one is recommended: `course`. How an attempt counts
//!   (exam, graded, daily, practice), and with which seed it is flown: `attempt`, `daily`.
//! - What a flight earns: `flown` makes it an entry, `skill` finds its evidence on skills,
//!   `economy` has the prices of licences, the credits, the experience and the levels, `wear` the
//!   costs of flying.
//! - The standing: `standing` folds the history, and refuses purchases; `knowledge` estimates the
//!   mastery of a skill and when it is due again; `soundness` finds entries that are impossible.
//! - What the trainee sees: `reward` explains the changes by one flight, `growth` the course of the
//!   career, `progress` its state per mission and skill; `aids` decides which hints are still
//!   shown.

mod aids;
mod attempt;
mod course;
mod daily;
mod economy;
mod flown;
mod growth;
mod knowledge;
mod progress;
mod reward;
mod skill;
mod soundness;
mod standing;
#[cfg(test)]
mod tests;
mod wear;

pub use crate::mission::Skill;
pub use crate::mission::Stake;
pub use aids::Aids;
pub use attempt::{
    Attempt, AttemptMeans, AttemptRefusal, AttemptTerms, AttemptTrainee, FlightClaim,
    PracticeReason, SettledFlight, is_practice, next_try, script_stake, without_end,
};
pub use course::{LockReason, MissionCourse, MissionStage, Offer};
pub use daily::{ExamKey, daily_seed, exam_seed};
pub use economy::{STARTER_PARTS, licence_price};
pub use growth::{Growth, SkillMove, Try, Wealth};
pub use knowledge::{Knowledge, Lack, MASTERY_CHANCE, Mastery};
pub use progress::{
    CareerProgress, MissionProgress, MissionState, SkillProgress, TrainingAdvice, VehicleProgress,
};
pub use reward::{OpenedItem, Reward, SkillChange};
pub use skill::{Evidence, EvidenceBasis};
pub use standing::{Best, CareerStanding, ExamResult, PartState, PurchaseRefusal};
pub use wear::{FlownDesign, wear};

use serde::{Deserialize, Serialize};

use crate::scoring::{FlownBy, Medal};

/// A permanent entry of a career.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "entry")]
pub enum CareerEntry {
    Flight(CareerFlight),
    /// A licence to use a part.
    Purchase(Purchase),
}

/// A finished flight in a career. It stores the mission's rewards, so that later changes to the mission do not affect
/// it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CareerFlight {
    /// The id of the mission.
    pub mission: String,
    /// The id of the mission for which this one is a drill.
    pub drill_of: Option<String>,
    /// The tier of the experience earned, 0 to 3.
    pub tier: u8,
    /// Credits for a perfect first pass.
    pub reward: u32,
    /// The number of vehicles.
    pub vehicles: u8,
    pub stake: Stake,
    /// The source of the commands; `None` in careers from older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flown_by: Option<FlownBy>,
    /// The day on which the flight ended, in days since 1970 (UTC).
    pub day: i64,
    /// The score, 0 to 1000.
    pub score: u16,
    /// Whether all mandatory objectives were met.
    pub passed: bool,
    /// The medal, if any.
    pub medal: Option<Medal>,
    /// The evidence on the trainee's skills, in order.
    pub evidence: Vec<Evidence>,
    /// The cost of wear and loss of own parts, in credits.
    pub wear: u32,
    /// Whether the flight came with an imported profile, and is unverified.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub imported: bool,
}

/// The purchase of a kind of part.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Purchase {
    /// The id of the part.
    pub part: String,
    /// The price paid, in credits.
    pub credits: u32,
}
