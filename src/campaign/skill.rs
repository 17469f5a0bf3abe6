//! The competencies of a swarm operator, and what a flight tells of them.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use strum::{EnumString, IntoStaticStr, VariantArray};

use crate::mission::Mission;
use crate::scoring::{Component, Report};
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
    /// Coverage of areas.
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
}

impl Skill {
    /// All skills in the order of their codes.
    pub const ALL: &[Self] = <Self as VariantArray>::VARIANTS;

    /// `K1` to `K12`, as in mission files.
    pub fn code(self) -> &'static str {
        self.into()
    }

    /// The skill of a code.
    pub fn of(code: &str) -> Option<Self> {
        code.parse().ok()
    }

    /// Its name for people.
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
        }
    }

    /// The skill that an objective of a kind shows, in a mission with so many drones: one alone is no swarm.
    pub fn of_objective(kind: &str, vehicles: usize) -> Option<Self> {
        Some(match kind {
            "arm_time" => Self::K1,
            "land_with" => Self::K4,
            "link" => Self::K5,
            "sample_cells" | "coverage" | "perimeter" => Self::K6,
            "map_error" | "locate" | "detect" | "dose" => Self::K7,
            "protect" | "contain" | "deliver" | "recover" | "formation" if vehicles > 1 => {
                Self::K10
            }
            "hover" | "gates" | "visit" | "land_on" | "standoff" | "deliver" | "recover" => {
                Self::K3
            }
            _ => return None,
        })
    }
}

impl Skill {
    /// The skill that a component of the score stands for.
    fn of_component(component: Component) -> Option<Self> {
        match component {
            Component::Command => Some(Self::K2),
            Component::Energy => Some(Self::K4),
            Component::Attention => Some(Self::K8),
            Component::Safety => Some(Self::K9),
            Component::Utilisation => Some(Self::K10),
            Component::Objective | Component::Quality | Component::Time => None,
        }
    }
}

/// One opportunity to show a skill, and how well it went.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    /// The skill that was shown.
    pub skill: Skill,
    /// How well it went, 0 to 1.
    pub outcome: f64,
    /// What was looked at.
    pub what: Text,
}

/// A prediction that is off by so many points shows nothing.
const BLIND_POINTS: f64 = 250.0;
/// Outcomes are kept to this fraction, so that a career comes back from a file as it was.
const STEPS: f64 = 1000.0;

impl Evidence {
    fn new(skill: Skill, outcome: f64, what: Text) -> Self {
        Self {
            skill,
            outcome: (outcome.clamp(0.0, 1.0) * STEPS).round() / STEPS,
            what,
        }
    }

    /// What a flight of a mission tells: every objective of the skill that its kind needs, the components of the score that
    /// stand for one, and the prediction. Nothing for a flight that was given up before anything was commanded.
    pub fn of(report: &Report, mission: &Mission) -> Vec<Self> {
        if report.ledger.is_empty() {
            return Vec::new();
        }
        let kinds: BTreeMap<&str, &str> = mission.objective_kinds().collect();
        let objectives = report.objectives.iter().filter_map(|objective| {
            let skill = Skill::of_objective(kinds.get(objective.id.as_str())?, mission.vehicles)?;
            let share = objective.points / objective.points_max.max(f64::EPSILON);
            Some(Self::new(skill, share, objective.title.clone()))
        });
        let has_flown = report.usage.iter().any(|used| used.airborne_s > 0.0);
        let components = report.components.iter().filter_map(|shown| {
            let component = Component::ALL
                .into_iter()
                .find(|it| it.title() == shown.name)?;
            let skill = Skill::of_component(component)?;
            // A component without weight had nothing to judge, and neither had one of a flight that never began.
            let is_shown = has_flown || component == Component::Command;
            (is_shown && shown.weight > 0.0)
                .then(|| Self::new(skill, shown.value, shown.name.clone()))
        });
        let prediction = report.prediction.iter().map(|prediction| {
            let off = f64::from(prediction.error.unsigned_abs()) / BLIND_POINTS;
            Self::new(Skill::K12, 1.0 - off, text!("skill-prediction"))
        });
        objectives.chain(components).chain(prediction).collect()
    }
}
