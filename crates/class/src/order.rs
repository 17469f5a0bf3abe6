//! What a desk asks of a seat.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{ExamTry, Words};

/// How long an order may take. Later it is not sent any more: a freeze that arrives minutes after it was meant would
/// do harm.
pub(super) const ANSWERED_WITHIN: Duration = Duration::from_secs(10);

/// The identity of an order. A seat carries out each order once, however often it arrives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct OrderId {
    /// The opening of the desk that gave it: the numbers of a desk that is opened again start anew.
    pub desk: u64,
    /// Its number, counted from 1.
    pub number: u32,
}

/// An order to a seat.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Order {
    /// The id, which makes the order unique within a class.
    pub id: OrderId,
    /// What is to be done.
    pub deed: Deed,
}

/// What is to be done at a seat.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Deed {
    /// Show a message to the trainee.
    Message {
        /// The text that the trainee reads.
        text: Words,
    },
    /// Give the mission's next hint, at its price.
    Hint,
    /// Set a bookmark in the record of the flight.
    Mark {
        /// Its text; may be empty.
        text: Words,
    },
    /// Stop the time of the flight.
    Freeze,
    /// Let the time of a frozen flight pass again.
    Resume,
    /// Trigger an inject of the mission.
    Inject {
        /// The name that the mission gives it.
        name: Words,
        /// The condition in the language of mission files that triggers it; at once without one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        when: Option<Words>,
    },
    /// Remove armed injects, which then no longer wait for their conditions.
    Disarm {
        /// Only those with this name; all without one.
        name: Option<Words>,
    },
    /// Keep the situation of the flight, to return to it later.
    Capture {
        /// What it is called.
        name: Words,
    },
    /// Return to a situation that was captured in this flight, which is frozen then.
    Recall {
        /// The name of the situation, or its number, counted from 1.
        situation: Words,
    },
    /// End the mission: the flight is scored as it stands.
    End,
    /// Make the instructor the pilot in command of vehicles.
    TakeOver {
        /// Their numbers; empty for all.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        vehicles: Vec<u16>,
    },
    /// Hand vehicles back to the trainee.
    HandBack {
        /// Their numbers; empty for all.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        vehicles: Vec<u16>,
    },
    /// Carry out a command of the instructor to vehicles that the instructor flies.
    Command {
        /// The line in the language of the command line.
        line: Words,
    },
    /// Begin the flight of a mission, with its brief.
    Fly {
        /// The id of the mission.
        mission: Words,
        /// Whether the flight is an exam.
        #[serde(default, skip_serializing_if = "is_false")]
        exam: bool,
        /// Whether the trainee stays in the brief until the desk starts the mission.
        #[serde(default, skip_serializing_if = "is_false")]
        hold: bool,
    },
    /// Open a try of an exam, with the brief of its mission.
    Examine(ExamTry),
    /// Let the time of a mission begin whose brief is still shown.
    Start,
    /// Let the trainee look on at what the desk shows to the class.
    LookOn,
    /// Note which step of a lesson the seat is at, and report when its condition holds.
    Step(NotedStep),
}

/// A step of a lesson, as a seat notes it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct NotedStep {
    /// The name of the lesson.
    pub lesson: Words,
    /// The step; `None` when the lesson has ended at this seat.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step: Option<Words>,
    /// The mission that the condition is about; without one, any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mission: Option<Words>,
    /// The condition that the step waits for. While it waits, the outcome is [`Outcome::Armed`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<Words>,
    /// Whether the instructor has gone back to it: it waits for the instructor, without its condition.
    #[serde(default, skip_serializing_if = "is_false")]
    pub is_held: bool,
    /// The number of steps that the seat went through before it. A step to which the instructor has gone back has the
    /// number that it had.
    #[serde(default)]
    pub before: u32,
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde passes fields by reference"
)]
fn is_false(value: &bool) -> bool {
    !value
}

impl Deed {
    /// The deed as a record of a flight keeps it: the trainee can read the record, so the seed of a try is not in it.
    #[must_use]
    pub fn for_record(&self) -> Self {
        match self {
            Self::Examine(opened) => Self::Examine(ExamTry {
                seed: 0,
                ..opened.clone()
            }),
            other => other.clone(),
        }
    }

    /// Whether the deed is permitted in an exam. Of those that change a flight, only its end is: a freeze would give
    /// the trainee time to think. A bookmark changes nothing, and grades need it.
    pub fn is_for_exams(&self) -> bool {
        matches!(
            self,
            Self::Message { .. }
                | Self::Mark { .. }
                | Self::End
                | Self::Start
                | Self::Step(_)
                | Self::Examine(_)
        )
    }

    /// Whether the trainee is not told: knowing that the desk has caused a fault would give it away.
    pub fn is_hidden(&self) -> bool {
        matches!(
            self,
            Self::Inject { .. } | Self::Disarm { .. } | Self::Step(_)
        )
    }

    /// Whether a flight cannot be as before afterwards.
    pub fn is_final(&self) -> bool {
        matches!(self, Self::End)
    }
}

/// How an order ended at a seat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// It was carried out, and its effect was seen.
    Done,
    /// It was carried out, but its effect was not seen in time.
    NoEffect,
    /// It waits for its condition. Another outcome follows.
    Armed,
    /// It is being carried out. Another outcome follows.
    UnderWay,
    /// It no longer waits: the desk has disarmed it, or the flight has ended.
    Disarmed,
    /// It was not carried out.
    Refused(Refusal),
}

/// Why a seat did not carry out an order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Refusal {
    /// The order is not permitted in exams.
    Exam,
    /// The seat flies no mission.
    NoMission,
    /// The flight has not begun, or is over.
    NotFlying,
    /// The flight cannot be frozen: its vehicles are not simulated by the console.
    CannotFreeze,
    /// The flight is not frozen.
    NotFrozen,
    /// The mission has no hint for this moment.
    NoHint,
    /// The seat does not record the flight.
    NotRecorded,
    /// The flight is paused.
    Paused,
    /// The mission does not permit this inject.
    NoInject,
    /// The condition names something that the mission does not have.
    Condition,
    /// No such inject is armed.
    NotArmed,
    /// A flight is under way, which the order would end.
    Flying,
    /// The mission is locked in the trainee's career, so it cannot be an exam.
    Locked,
    /// The try was flown already, or there are no more tries.
    Flown,
    /// At this seat, the flight would be practice: the console has a mission or airframes of its own, or slow motion.
    Practice,
    /// The seat keeps as many situations as it can.
    TooManySituations,
    /// No such situation was captured in this flight.
    NoSituation,
    /// The flight has no such vehicle.
    NoVehicle,
    /// The vehicles may be real, and the trainee's configuration does not permit others to fly them.
    RealVehicle,
    /// The trainee flies the vehicle: the instructor has not taken it over.
    NotTaken,
    /// The line cannot be read, or is no command to vehicles.
    Line,
    /// A vehicle refused the command, or it does not suit the vehicle.
    Vehicle,
}
