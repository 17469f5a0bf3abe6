//! The orders of an instructor's desk and their outcomes, as text.

use crate::class::{
    Deed, ExamPlan, ExamTry, NotedStep, Outcome, Refusal, SubmissionRefusal, Words,
};
use crate::text;
use crate::text::{Language, Text};
use crate::vehicle_id::{VehicleId, ranges};

/// What an order asks for.
pub fn deed_text(deed: &Deed) -> Text {
    match deed {
        Deed::Message { text } => text!("class-deed-message", text = text.as_str()),
        Deed::Hint => text!("class-deed-hint"),
        Deed::Mark { text } if text.is_empty() => text!("class-deed-mark"),
        Deed::Mark { text } => text!("class-deed-mark-text", text = text.as_str()),
        Deed::Freeze => text!("class-deed-freeze"),
        Deed::Resume => text!("class-deed-resume"),
        Deed::Inject { name, when: None } => text!("class-deed-inject", name = name.as_str()),
        Deed::Inject {
            name,
            when: Some(when),
        } => text!(
            "class-deed-inject-when",
            name = name.as_str(),
            when = when.as_str()
        ),
        Deed::Disarm { name: None } => text!("class-deed-disarm-all"),
        Deed::Disarm { name: Some(name) } => text!("class-deed-disarm", name = name.as_str()),
        Deed::Capture { name } if name.is_empty() => text!("class-deed-capture"),
        Deed::Capture { name } => text!("class-deed-capture-name", name = name.as_str()),
        Deed::Recall { situation } => {
            text!("class-deed-recall", situation = situation.as_str())
        }
        Deed::End => text!("class-deed-end"),
        Deed::TakeOver { vehicles } => {
            text!("class-deed-take", vehicles = vehicles_text(vehicles))
        }
        Deed::HandBack { vehicles } => {
            text!("class-deed-give", vehicles = vehicles_text(vehicles))
        }
        Deed::Command { line } => text!("class-deed-command", line = line.as_str()),
        Deed::Fly {
            mission,
            exam,
            hold: true,
        } => {
            let (mission, exam, hold) = (mission.clone(), *exam, false);
            let open = Deed::Fly {
                mission,
                exam,
                hold,
            };
            text!("class-deed-hold", deed = deed_text(&open))
        }
        Deed::Fly {
            mission,
            exam: false,
            ..
        } => text!("class-deed-fly", mission = mission.as_str()),
        Deed::Fly {
            mission,
            exam: true,
            ..
        } => text!("class-deed-exam", mission = mission.as_str()),
        Deed::Examine(opened) => text!(
            "class-deed-try",
            mission = opened.name.mission.as_str(),
            number = opened.name.number,
            tries = opened.tries
        ),
        Deed::Start => text!("class-deed-start"),
        Deed::LookOn => text!("class-deed-look-on"),
        Deed::Step(step) => step_text(step),
    }
}

/// A step of a lesson.
fn step_text(noted: &NotedStep) -> Text {
    let lesson = noted.lesson.as_str();
    match (&noted.step, &noted.when) {
        (None, _) => text!("class-deed-lesson-end", lesson = lesson),
        (Some(step), None) => text!("class-deed-step", lesson = lesson, step = step.as_str()),
        (Some(step), Some(when)) => text!(
            "class-deed-step-when",
            lesson = lesson,
            step = step.as_str(),
            when = when.as_str()
        ),
    }
}

/// The title of an exam.
pub fn exam_title(exam: &ExamPlan) -> Text {
    title_text(&exam.title, exam.title_uk.as_ref())
}

/// The title of the exam of a try, for trainees: the name of its file is for the desk only.
pub fn try_title(opened: &ExamTry) -> Text {
    title_text(&opened.title, opened.title_uk.as_ref())
}

fn title_text(title: &Words, ukrainian: Option<&Words>) -> Text {
    let others = ukrainian.map(|title| (Language::Ukrainian, title.to_string()));
    Text::written(title.as_str(), others)
}

/// What an instructor has done, as a sentence; `None` for orders that are told by their names.
pub fn done_text(instructor: &str, deed: &Deed) -> Option<Text> {
    let named = |id: &'static str| Text::new(id, vec![("instructor", instructor.into())]);
    Some(match deed {
        Deed::Hint => named("class-did-hint"),
        Deed::Freeze => named("class-did-freeze"),
        Deed::Resume => named("class-did-resume"),
        Deed::End => named("class-did-end"),
        Deed::Start => named("class-did-start"),
        Deed::Capture { .. } => named("class-did-capture"),
        Deed::LookOn => named("class-did-show"),
        Deed::Fly { mission, .. } => text!(
            "class-did-fly",
            instructor = instructor,
            mission = mission.as_str()
        ),
        Deed::Examine(opened) if !opened.title.is_empty() => text!(
            "class-did-exam",
            instructor = instructor,
            exam = try_title(opened),
            number = opened.name.number,
            tries = opened.tries
        ),
        Deed::Recall { situation } => text!(
            "class-did-recall",
            instructor = instructor,
            situation = situation.as_str()
        ),
        Deed::TakeOver { vehicles } => {
            let vehicles = vehicles_text(vehicles);
            text!(
                "class-did-take",
                instructor = instructor,
                vehicles = vehicles
            )
        }
        Deed::HandBack { vehicles } => {
            let vehicles = vehicles_text(vehicles);
            text!(
                "class-did-give",
                instructor = instructor,
                vehicles = vehicles
            )
        }
        _ => return None,
    })
}

/// The numbers of vehicles; without numbers, all are meant.
pub fn vehicles_text(vehicles: &[VehicleId]) -> Text {
    if vehicles.is_empty() {
        text!("class-all-vehicles")
    } else {
        ranges(vehicles.iter().copied()).into()
    }
}

/// How an order ended, with what the seat has said about it, beside the order: a step of a lesson whose condition is
/// watched is not called armed, because that would read like a vehicle.
pub fn order_ended_text(deed: &Deed, outcome: Outcome, why: Option<&Words>) -> Text {
    match (deed, outcome) {
        (Deed::Step(_), Outcome::Armed) => text!("class-step-watched"),
        _ => ended_text(outcome, why),
    }
}

/// How an order ended, with what the seat has said about it.
pub fn ended_text(outcome: Outcome, why: Option<&Words>) -> Text {
    match (outcome, why) {
        (Outcome::Refused(refusal), why) => {
            text!("class-refused", reason = refusal_of(refusal, why))
        }
        (other, None) => outcome_text(other),
        (other, Some(why)) => {
            let why = Text::verbatim(why.as_str());
            Text::joined(": ", vec![outcome_text(other), why])
        }
    }
}

/// Why a seat has refused an order: what it has said about it, otherwise the kind of refusal.
pub fn refusal_of(refusal: Refusal, why: Option<&Words>) -> Text {
    let said = why.map(|why| Text::verbatim(why.as_str()));
    said.unwrap_or_else(|| refusal_text(refusal))
}

/// How an order ended.
pub fn outcome_text(outcome: Outcome) -> Text {
    match outcome {
        Outcome::Done => text!("class-done"),
        Outcome::NoEffect => text!("class-no-effect"),
        Outcome::Armed => text!("class-armed"),
        Outcome::UnderWay => text!("class-under-way"),
        Outcome::Disarmed => text!("class-disarmed"),
        Outcome::Refused(refusal) => text!("class-refused", reason = refusal_text(refusal)),
    }
}

fn refusal_text(refusal: Refusal) -> Text {
    match refusal {
        Refusal::Exam => text!("class-refusal-exam"),
        Refusal::NoMission => text!("class-refusal-no-mission"),
        Refusal::NotFlying => text!("class-refusal-not-flying"),
        Refusal::CannotFreeze => text!("class-refusal-cannot-freeze"),
        Refusal::NotFrozen => text!("class-refusal-not-frozen"),
        Refusal::NoHint => text!("class-refusal-no-hint"),
        Refusal::NotRecorded => text!("class-refusal-not-recorded"),
        Refusal::Paused => text!("class-refusal-paused"),
        Refusal::NoInject => text!("class-refusal-no-inject"),
        Refusal::Condition => text!("class-refusal-condition"),
        Refusal::NotArmed => text!("class-refusal-not-armed"),
        Refusal::Flying => text!("class-refusal-flying"),
        Refusal::Locked => text!("class-refusal-locked"),
        Refusal::Flown => text!("class-refusal-flown"),
        Refusal::Practice => text!("class-refusal-practice"),
        Refusal::TooManySituations => text!("class-refusal-too-many-situations"),
        Refusal::NoSituation => text!("class-refusal-no-situation"),
        Refusal::NoVehicle => text!("class-refusal-no-vehicle"),
        Refusal::RealVehicle => text!("class-refusal-real-vehicle"),
        Refusal::NotTaken => text!("class-refusal-not-taken"),
        Refusal::Line => text!("class-refusal-line"),
        Refusal::Vehicle => text!("class-refusal-vehicle"),
    }
}

/// Why the desk does not keep a record.
pub fn submission_refusal_text(refusal: SubmissionRefusal) -> Text {
    match refusal {
        SubmissionRefusal::Unwritable => text!("class-submission-unwritable"),
        SubmissionRefusal::Damaged => text!("class-submission-damaged"),
        SubmissionRefusal::Share => text!("class-submission-share"),
        SubmissionRefusal::Impossible => text!("class-submission-impossible"),
        SubmissionRefusal::Different => text!("class-submission-different"),
    }
}
