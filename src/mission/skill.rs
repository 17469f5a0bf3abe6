//! The competencies of a swarm operator that missions require and objectives demonstrate.

use serde::{Deserialize, Serialize};
use strum::{EnumString, IntoStaticStr, VariantArray};

use crate::text;
use crate::text::Text;

/// A competency of a swarm operator; the codes are those of mission files.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Hash,
    Serialize,
    Deserialize,
    EnumString,
    IntoStaticStr,
    VariantArray,
)]
pub enum Skill {
    /// Checks before flight, and arming.
    K1,
    /// Choice of flight modes and commands.
    K2,
    /// Flight to positions and along routes.
    K3,
    /// Management of battery energy.
    K4,
    /// Behaviour when links fail, and failsafes.
    K5,
    K6,
    /// Interpretation of sensor readings.
    K7,
    /// Response to alerts and threats.
    K8,
    /// Separation between vehicles, and airspace limits.
    K9,
    /// Division of work among the vehicles of a swarm.
    K10,
    /// Design of vehicles for a task.
    K11,
    /// Judgement of one's own work.
    K12,
    /// Plans: making them, checking them, flying them.
    K13,
}

impl Skill {
    /// All skills in the order of their codes.
    pub const ALL: &[Self] = <Self as VariantArray>::VARIANTS;

    /// `K1` to `K13`, as in mission files.
    pub fn code(self) -> &'static str {
        self.into()
    }

    /// The skill with this code, if any.
    pub fn of(code: &str) -> Option<Self> {
        code.parse().ok()
    }

    /// Its name on the screen.
    pub fn title(self) -> Text {
        match self {
            Self::K1 => text!("skill-arming"),
            Self::K2 => text!("skill-commands"),
            Self::K3 => text!("skill-navigation"),
            Self::K4 => text!("skill-energy"),
            Self::K5 => text!("skill-links"),
            Self::K6 => text!("skill-coverage"),
            Self::K7 => text!("skill-sensors"),
            Self::K8 => text!("skill-threats"),
            Self::K9 => text!("skill-separation"),
            Self::K10 => text!("skill-swarm"),
            Self::K11 => text!("skill-design"),
            Self::K12 => text!("skill-judgement"),
            Self::K13 => text!("skill-plans"),
        }
    }
}
