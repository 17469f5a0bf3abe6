//! The records that a seat hands in, and what the desk says about them.

use super::tell;
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects};
use crate::class::{
    Consent, HandInOutcome, RecordName, Submission, SubmissionEnd, SubmissionRefusal,
};
use crate::class_text::submission_refusal_text;
use crate::text;
use crate::vehicle::Severity;

/// The record of a mission is complete: it is handed in if the trainee has joined.
pub fn recorded(state: &State, record: RecordName) -> Effects {
    let seat = state.class.seat().map(|place| &place.seat);
    if seat.is_some_and(|seat| seat.consent() == Consent::Given) {
        Effects::from(Effect::Class(ClassEffect::HandIn(record)))
    } else {
        Effects::none()
    }
}

/// A record can be handed in.
pub fn offered(state: &mut State, submission: Submission) {
    if let Some(place) = state.class.seat_mut() {
        place.seat.hand_in_mut().offer(submission);
    }
}

/// A record cannot be read, so it stays where it is.
pub fn unreadable(state: &mut State, record: RecordName, error: String) -> Effects {
    if let Some(place) = state.class.seat_mut() {
        place.seat.hand_in_mut().forget(&record);
    }
    let text = text!("class-not-handed-in", reason = error);
    tell(state, Severity::Warning, text);
    Effects::from(Effect::Class(ClassEffect::Settle(record)))
}

/// The desk has answered a record.
pub fn settled(state: &mut State, record: RecordName, end: SubmissionEnd) -> Effects {
    let wall = state.wall;
    let Some(place) = state.class.seat_mut() else {
        return Effects::none();
    };
    let Some(outcome) = place.seat.hand_in_mut().settle(&record, end, wall) else {
        return Effects::none();
    };
    let (severity, text) = match outcome {
        HandInOutcome::Kept => (Severity::Notice, text!("class-handed-in")),
        HandInOutcome::Later(refusal) => {
            let reason = submission_refusal_text(refusal);
            (
                Severity::Warning,
                text!("class-handed-in-later", reason = reason),
            )
        }
        HandInOutcome::Never(refusal) => {
            let reason = submission_refusal_text(refusal);
            (
                Severity::Warning,
                text!("class-not-handed-in", reason = reason),
            )
        }
    };
    tell(state, severity, text);
    match outcome {
        HandInOutcome::Later(_) => Effects::none(),
        HandInOutcome::Kept | HandInOutcome::Never(_) => {
            Effects::from(Effect::Class(ClassEffect::Settle(record)))
        }
    }
}

/// The desk has refused a record.
pub fn not_kept(
    state: &mut State,
    user: &str,
    record: &RecordName,
    refusal: SubmissionRefusal,
    words: Option<String>,
) {
    let reason = match words {
        Some(words) => words.into(),
        None => submission_refusal_text(refusal),
    };
    let text = text!(
        "class-not-kept",
        user = user,
        record = record.as_str(),
        reason = reason
    );
    tell(state, Severity::Warning, text);
}
