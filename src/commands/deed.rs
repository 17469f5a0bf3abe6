//! Deeds: commands to the mission, not to an autopilot. They concern payloads, reports of contacts,
//! and the trainee's prediction and goal.

use std::fmt;
use std::time::Duration;

use serde::{Deserialize, Serialize};
use strum::{EnumString, IntoStaticStr, VariantNames};

use super::FindKind;
use crate::geo::LatLon;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A command to the mission.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Deed {
    Mark {
        subject: Subject,
        /// The reported kind; `None` if the mission has only one kind.
        kind: Option<FindKind>,
    },
    /// Withdraw the report nearest to a place.
    Unmark { spot: Spot },
    /// Take a sample at the vehicle's position.
    Sample,
    /// Release one piece of the vehicle's load.
    Drop,
    /// Open or close the sprayer.
    Spray { on: bool },
    /// Predict the score before takeoff.
    Predict {
        /// The expected score, 0 to 1000.
        points: u16,
    },
    /// Rate the workload when asked, from 1 (almost nothing to do) to 5 (too much).
    Workload {
        /// The rating, 1 to 5.
        level: u8,
    },
    /// Set a goal for the flight.
    Goal(Goal),
    /// Ask for the next hint.
    Hint,
}

impl Deed {
    /// The vehicles that carry it out: the first one, if the result would be the same for every vehicle.
    pub fn doers<'a>(&self, vehicles: &'a [VehicleId]) -> &'a [VehicleId] {
        if self.is_of_all() {
            &vehicles[..vehicles.len().min(1)]
        } else {
            vehicles
        }
    }

    /// Whether the command has the same result for every vehicle.
    fn is_of_all(&self) -> bool {
        match self {
            Self::Mark {
                subject: Subject::Spot(spot),
                ..
            }
            | Self::Unmark { spot } => *spot != Spot::Here,
            Self::Mark {
                subject: Subject::Contacts { .. },
                ..
            } => true,
            Self::Sample
            | Self::Drop
            | Self::Spray { .. }
            | Self::Predict { .. }
            | Self::Workload { .. }
            | Self::Goal(_)
            | Self::Hint => false,
        }
    }
}

/// The subject of a report.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Subject {
    Spot(Spot),
    Contacts {
        /// Whether to report only contacts seen by two kinds of sensors.
        confirmed: bool,
    },
}

/// A place in the form in which it was given.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spot {
    /// The current position of the vehicle.
    Here,
    At(LatLon),
    /// Metres from the mission's origin.
    Offset {
        north_m: f64,
        east_m: f64,
    },
}

/// A trainee's own goal, besides the mission's objectives.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Goal {
    /// Finish within this time.
    Time(Duration),
    /// Land every vehicle with at least this much battery, in percent.
    Battery(f64),
    /// Reach at least this score.
    Score(u16),
    /// Lose no points in one component of the score.
    #[serde(untagged)]
    Faultless(GoalComponent),
}

/// The components of the score that a trainee can set as a goal.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Serialize,
    Deserialize,
    EnumString,
    IntoStaticStr,
    VariantNames,
)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
pub enum GoalComponent {
    /// Break no safety rule.
    Safety,
    /// Give no refused command.
    Commands,
    /// Answer every alert in time.
    Attention,
}

impl Goal {
    pub fn title(self) -> Text {
        match self {
            Self::Time(most) => text!("mission-goal-time", seconds = most.as_secs()),
            Self::Battery(least) => {
                text!("mission-goal-battery", percent = format!("{least:.0}"))
            }
            Self::Faultless(GoalComponent::Safety) => text!("mission-goal-safety"),
            Self::Faultless(GoalComponent::Commands) => text!("mission-goal-commands"),
            Self::Faultless(GoalComponent::Attention) => text!("mission-goal-attention"),
            Self::Score(least) => text!("mission-goal-score", points = least),
        }
    }
}

impl fmt::Display for Goal {
    /// Writes the goal in the grammar's notation after `goal`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Time(within) => write!(f, "time {}s", within.as_secs_f64()),
            Self::Battery(percent) => write!(f, "battery {percent}%"),
            Self::Faultless(component) => f.write_str(component.into()),
            Self::Score(points) => write!(f, "score {points}"),
        }
    }
}
