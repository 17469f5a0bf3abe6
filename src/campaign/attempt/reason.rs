//! Why an attempt counts only as practice, and why it may not be flown at all.

use super::AttemptMeans;
use crate::campaign::{LockReason, PartState, Stake};
use crate::scoring::MissionFile;
use crate::text;
use crate::text::Text;
use crate::workshop::Part;

/// Why a flight counts only as practice.
#[derive(Debug, Clone, PartialEq)]
pub enum PracticeReason {
    /// The user has chosen the seed of a graded flight.
    ChosenSeed,
    /// A pilot script, or a pipe, gives the commands.
    Script,
    /// The course does not contain the mission: it is neither shipped nor the administrator's.
    OwnMission,
    /// The mission's text differs from that of the course.
    AlteredMission,
    /// The mission is locked for the trainee.
    Locked(Vec<LockReason>),
    /// The trainee does not own all parts of a design.
    MissingParts {
        /// The name of the design.
        design: String,
        /// The parts, and how to get them.
        parts: Vec<(&'static Part, PartState)>,
    },
    /// The airframes are the user's own files.
    OwnAirframes,
    /// A crew flies a mission that is meant for one person.
    Crew,
    /// Time runs slower than in reality.
    SlowMotion,
    /// The record of the flight cannot be confirmed by the files beside it.
    UnconfirmedRecord,
}

impl PracticeReason {
    /// Why flights with a mission file count only as practice; `None` for the course's own.
    pub fn of_file(file: MissionFile) -> Option<Self> {
        match file {
            MissionFile::Course => None,
            MissionFile::Own => Some(Self::OwnMission),
            MissionFile::OtherRevision | MissionFile::Altered => Some(Self::AlteredMission),
        }
    }

    /// The reason as text.
    pub fn text(&self) -> Text {
        match self {
            Self::ChosenSeed => text!("practice-seed"),
            Self::Script => text!("practice-script"),
            Self::OwnMission => text!("practice-own-mission"),
            Self::AlteredMission => text!("practice-altered-mission"),
            Self::Locked(reasons) => {
                let reasons = reasons.iter().map(LockReason::text).collect();
                text!("practice-locked", why = Text::joined("; ", reasons))
            }
            Self::MissingParts { design, parts } => {
                let part_names = parts.iter().map(|(part, _)| part.name()).collect();
                let parts = Text::joined(", ", part_names);
                text!("practice-parts", design = design.as_str(), parts = parts)
            }
            Self::OwnAirframes => text!("practice-airframes"),
            Self::Crew => text!("practice-crew"),
            Self::SlowMotion => text!("practice-slow"),
            Self::UnconfirmedRecord => text!("practice-unconfirmed"),
        }
    }

    /// The reasons for practice, as a sentence.
    pub fn sentence(reasons: &[Self]) -> Text {
        let reasons = reasons.iter().map(Self::text).collect();
        text!("launch-practice", why = Text::joined("; ", reasons))
    }
}

/// Why an attempt may not be flown as requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AttemptRefusal {
    /// Exams are flown by hand.
    ExamByScript,
    /// Exams are flown alone.
    ExamByCrew,
    /// Exams run in real time.
    ExamSpedUp,
    /// The layout of the day is flown by hand: a script would show it in advance.
    DailyByScript,
}

impl AttemptRefusal {
    /// The refusal of an attempt with this stake under these circumstances; `None` if the attempt may be flown.
    pub fn of(wanted: Stake, means: &AttemptMeans) -> Option<Self> {
        let &AttemptMeans {
            flown_by, speedup, ..
        } = means;
        match wanted {
            // Practice would show the layout of the exam.
            Stake::Exam if means.has_crew => Some(Self::ExamByCrew),
            Stake::Exam if !flown_by.is_by_hand() => Some(Self::ExamByScript),
            Stake::Exam if speedup > 1.0 => Some(Self::ExamSpedUp),
            Stake::Daily if !flown_by.is_by_hand() => Some(Self::DailyByScript),
            Stake::Exam | Stake::Daily | Stake::Graded | Stake::Practice => None,
        }
    }

    pub fn text(self) -> Text {
        match self {
            Self::ExamByScript => text!("exam-by-hand"),
            Self::ExamByCrew => text!("exam-alone"),
            Self::ExamSpedUp => text!("exam-real-time"),
            Self::DailyByScript => text!("daily-by-hand"),
        }
    }
}
