//! The enumerations in a report, with their names in JSON.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::text;
use crate::text::Text;

/// The kind of an event in the timeline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum EventKind {
    /// An objective was reached, or is open again.
    Objective,
    /// A danger, or a time limit that is near.
    Alert,
    /// An alert was answered.
    Answer,
    /// A safety rule was broken.
    Rule,
    /// A vehicle refused a command.
    Rejected,
    /// The trainee asked for a hint.
    Hint,
    Phase,
    /// A sample was taken.
    Sample,
    /// A load was released, used up or replaced.
    Load,
    /// The flight was paused.
    Pause,
    /// A message from the mission file's events.
    #[serde(rename = "event")]
    MissionEvent,
    /// An inject of the instructor.
    Inject,
}

/// The simulator of a flight's vehicles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FlightBackend {
    /// The simulator inside the program.
    #[default]
    Embedded,
    /// ArduPilot's SITL, a process per vehicle.
    ArduPilot,
}

impl FlightBackend {
    /// The backend with a name; `None` for an unknown name.
    pub fn named(name: &str) -> Option<Self> {
        let mut all = [Self::Embedded, Self::ArduPilot].into_iter();
        all.find(|backend| backend.name() == name)
    }

    /// Its name in JSON and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Embedded => "embedded",
            Self::ArduPilot => "ardupilot",
        }
    }
}

impl fmt::Display for FlightBackend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// How far a flight of a mission has come, or how it ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FlightOutcome {
    /// The flight is not over.
    #[default]
    Flying,
    /// All mandatory objectives are met.
    Passed,
    /// A mandatory objective is not met.
    Failed,
    /// The time was up before the objectives were met.
    #[serde(rename = "timed out")]
    TimedOut,
    /// The instructor ended it; it is scored as it stood.
    Stopped,
    /// The trainee gave up.
    Abandoned,
}

impl FlightOutcome {
    pub fn is_over(self) -> bool {
        self != Self::Flying
    }

    /// Its name on the screen.
    pub fn title(self) -> Text {
        match self {
            // Only a record without an end gives a report of such a flight.
            Self::Flying => text!("mission-not-finished"),
            Self::Passed => text!("mission-passed"),
            Self::Failed => text!("mission-failed"),
            Self::TimedOut => text!("mission-timed-out"),
            Self::Stopped => text!("mission-stopped"),
            Self::Abandoned => text!("mission-abandoned"),
        }
    }
}

/// The source of a flight's commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, strum::Display)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum FlownBy {
    /// A person at a console.
    #[default]
    Hand,
    /// A pilot script, or lines from a pipe.
    Script,
    /// A pilot script of the program.
    BundledPilot,
}

impl FlownBy {
    /// Whether a person gave the commands.
    pub fn is_by_hand(self) -> bool {
        match self {
            Self::Hand => true,
            Self::Script | Self::BundledPilot => false,
        }
    }
}

/// How the text of a mission compares with that of the course's mission with the same id.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, strum::Display)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum MissionFile {
    /// The mission is that of the course.
    Course,
    /// The revision of the mission differs from that of the course.
    OtherRevision,
    /// It has the same revision as the course's mission, but a different text.
    Altered,
    /// The course has no mission with this id.
    Own,
}

/// The grade of a score, best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ScoreGrade {
    /// 950 points or more.
    S,
    /// 850 points or more.
    A,
    /// 700 points or more.
    B,
    /// 550 points or more.
    C,
    /// 400 points or more.
    D,
    /// Fewer than 400 points.
    F,
}

impl ScoreGrade {
    /// The grade of a score of 0 to 1000 points.
    pub fn of(points: u16) -> Self {
        match points {
            950.. => Self::S,
            850.. => Self::A,
            700.. => Self::B,
            550.. => Self::C,
            400.. => Self::D,
            _ => Self::F,
        }
    }
}
