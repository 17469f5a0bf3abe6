//! The end of a session or of the program, after a question if something would be lost.

use super::loss::loss;
use super::{class, consequence};
use crate::app::State;
use crate::app::effect::{Effect, Effects, SessionEffect};
use crate::app::room;
use crate::app::state::Consequence;
use crate::class_text::exam_title;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Quits the program; asks first if something would be lost.
pub fn quit(state: &mut State) -> Effects {
    let at_risk = state.training.at_risk;
    if at_risk > 0 {
        let unstored = text!("career-ask-quit-reason", count = at_risk);
        let reasons = loss(state).into_iter().chain([unstored]).collect();
        let reason = Text::joined("; ", reasons);
        return ask(state, text!("ask-quit"), reason, Effect::Quit);
    }
    let ungraded = state.rooms.class.unwritten_grades;
    if ungraded > 0 {
        let reason = text!("grading-ask-quit-reason", count = ungraded);
        return ask(state, text!("ask-quit"), reason, Effect::Quit);
    }
    let of_class = class::left_behind(state);
    if let Some(exam) = open_exam(state) {
        let exam = text!("class-exam-ask-quit-reason", exam = exam);
        let reason = Text::joined("; ", std::iter::once(exam).chain(of_class).collect());
        state.ask(text!("ask-quit"), reason, Consequence::EndExamAndQuit);
        return Effects::none();
    }
    if !of_class.is_empty() {
        let reasons = loss(state).into_iter().chain(of_class).collect();
        let reason = Text::joined("; ", reasons);
        return ask(state, text!("ask-quit"), reason, Effect::Quit);
    }
    if loss(state).is_none() && !room::workshop::is_saved(state) {
        let name = state.rooms.workshop.bench.design().name.clone();
        let reason = text!("bench-ask-quit-reason", name = name);
        return ask(state, text!("ask-quit"), reason, Effect::Quit);
    }
    if loss(state).is_none() && !room::plans::is_kept(state) {
        let reason = text!("draft-ask-quit-reason");
        return ask(state, text!("ask-quit"), reason, Effect::Quit);
    }
    guarded(state, text!("ask-quit"), Effect::Quit)
}

/// The name of the exam that the desk holds, if it has not ended.
fn open_exam(state: &State) -> Option<Text> {
    let exam = state.class.desk()?.exam()?;
    let is_open = exam.has_begun() && !exam.is_stopped();
    is_open.then(|| exam_title(exam.plan()))
}

/// Carries out an effect that ends the session; asks first if something would be lost.
pub fn guarded(state: &mut State, question: Text, effect: Effect) -> Effects {
    if let Some(reason) = hosts_flight(state).filter(|_| effect != Effect::Quit) {
        state.say(Severity::Notice, reason);
        return Effects::none();
    }
    match loss(state) {
        Some(reason) => ask(state, question, reason, effect),
        None => consequence::carry_out(state, Consequence::Effect(effect)),
    }
}

/// Why this console begins no flight of its own: at a member of a crew.
pub fn hosts_flight(state: &State) -> Option<Text> {
    state.crew.member().map(|_| text!("crew-stay"))
}

/// Leaves the session; asks first if something would be lost. A member of a crew has no session of its own, and leaves
/// the crew.
pub fn leave(state: &mut State) -> Effects {
    if state.crew.member().is_some() {
        return quit(state);
    }
    guarded(
        state,
        text!("ask-leave"),
        Effect::Session(SessionEffect::Leave),
    )
}

/// Asks for a confirmation of an effect.
pub fn ask(state: &mut State, question: Text, reason: Text, effect: Effect) -> Effects {
    state.ask(question, reason, Consequence::Effect(effect));
    Effects::none()
}
