//! The kinds in a report, with the names that documents have for them.

use std::fmt;

use serde::{Deserialize, Serialize};

/// What a timeline's event is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum EventKind {
    /// An objective was reached, or is open again.
    Objective,
    /// A danger, or the time running out.
    Alert,
    /// An alert was answered by what it asked for.
    Answer,
    /// A safety rule was broken.
    Rule,
    /// A vehicle refused a command.
    Rejected,
    /// The trainee asked for a hint.
    Hint,
    /// The flight came to its end.
    Phase,
    /// A sample was taken.
    Sample,
    /// A load was released, used up or replaced.
    Load,
    /// The flight was paused.
    Pause,
    /// The mission file's events told something.
    #[serde(rename = "event")]
    MissionEvent,
    /// The instructor made something happen.
    Inject,
}

/// What flew the vehicles of a flight.
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
    /// The backend of a name; `None` for a name that no version has written.
    pub fn named(name: &str) -> Option<Self> {
        let mut all = [Self::Embedded, Self::ArduPilot].into_iter();
        all.find(|backend| backend.name() == name)
    }

    /// Its name in documents and on the command line.
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

/// What gave the commands of a flight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, strum::Display)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum FlownBy {
    /// A person at a console.
    #[default]
    Hand,
    /// A pilot script, or lines from a pipe.
    Script,
    /// A pilot script that comes with the program.
    BundledPilot,
}

/// How the text of a mission compares with the mission of the course that has its id.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, strum::Display)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum MissionFile {
    /// It is the mission of the course.
    Course,
    /// It is of another revision than that of the course.
    OtherRevision,
    /// It is of the same revision as that of the course, and says something else.
    Altered,
    /// The course has no mission of this id.
    Own,
}

/// The grade of a score, the best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ScoreGrade {
    /// 950 points and more.
    S,
    /// 850 points and more.
    A,
    /// 700 points and more.
    B,
    /// 550 points and more.
    C,
    /// 400 points and more.
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

    /// The letter, the same in every language.
    pub fn letter(self) -> char {
        match self {
            Self::S => 'S',
            Self::A => 'A',
            Self::B => 'B',
            Self::C => 'C',
            Self::D => 'D',
            Self::F => 'F',
        }
    }
}
