//! Deeds: what a mission is asked, not an autopilot. Payloads, reports of finds, and the trainee's word before launch.

use std::fmt;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::FindKind;
use crate::geo::LatLon;
use crate::text;
use crate::text::Text;

/// Something that only means anything within a mission.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Deed {
    Mark {
        subject: Subject,
        /// What it is said to be; `None` where the mission asks for one kind only.
        kind: Option<FindKind>,
    },
    /// Take back the report that is nearest to a place.
    Unmark { spot: Spot },
    /// Take a sample where the vehicle is.
    Sample,
    /// Let go of one piece of the vehicle's load.
    Drop,
    /// Open or close the sprayer.
    Spray { on: bool },
    /// Say beforehand what the score will be.
    Predict {
        /// The score that the trainee expects, 0 to 1000.
        points: u16,
    },
    /// Set a goal for the flight.
    Goal(Goal),
    /// Ask for the next hint.
    Hint,
}

impl Deed {
    /// Whether it concerns the mission as a whole: done with one vehicle, it is done with all.
    pub fn is_of_all(&self) -> bool {
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
            | Self::Goal(_)
            | Self::Hint => false,
        }
    }
}

/// What a report is about.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Subject {
    Spot(Spot),
    /// Each contact that has not been reported.
    Contacts {
        /// Only those that two kinds of sensors have seen.
        confirmed: bool,
    },
}

/// A place as it was named.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spot {
    /// Where the vehicle is.
    Here,
    At(LatLon),
    /// From the mission's origin, in metres.
    Offset {
        north_m: f64,
        east_m: f64,
    },
}

/// What a trainee wants to reach, besides the mission's objectives.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Goal {
    /// Be done within this time.
    Time(Duration),
    /// Land every vehicle with at least this much battery, in percent.
    Battery(f64),
    Safety,
    /// Give no command that is refused.
    Commands,
    /// Answer every alert in time.
    Attention,
    /// Reach at least this score.
    Score(u16),
}

impl Goal {
    /// What it asks for, in words.
    pub fn title(self) -> Text {
        match self {
            Self::Time(most) => text!("mission-goal-time", seconds = most.as_secs()),
            Self::Battery(least) => {
                text!("mission-goal-battery", percent = format!("{least:.0}"))
            }
            Self::Safety => text!("mission-goal-safety"),
            Self::Commands => text!("mission-goal-commands"),
            Self::Attention => text!("mission-goal-attention"),
            Self::Score(least) => text!("mission-goal-score", points = least),
        }
    }
}

impl fmt::Display for Goal {
    /// As the grammar writes it, after `goal`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Time(within) => write!(f, "time {}s", within.as_secs_f64()),
            Self::Battery(percent) => write!(f, "battery {percent}%"),
            Self::Safety => f.write_str("safety"),
            Self::Commands => f.write_str("commands"),
            Self::Attention => f.write_str("attention"),
            Self::Score(points) => write!(f, "score {points}"),
        }
    }
}
