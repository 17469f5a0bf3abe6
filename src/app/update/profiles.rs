//! Choosing, creating and leaving a profile.

use crossterm::event::KeyEvent;

use crate::app::State;
use crate::app::action::Action;
use crate::app::effect::{CareerEffect, Effect, Effects};
use crate::app::keymap::Place;
use crate::app::room::home;
use crate::app::state::{Activity, Career, Overlay, Prompt, Purpose, Trainee};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Opens the list of profiles; refused during a mission, because the result belongs to the
/// mission's trainee.
pub fn open(state: &mut State) {
    let is_mission = matches!(state.session.activity, Some(Activity::Mission { .. }));
    if is_mission && !state.session.task.over && state.replay.is_none() {
        state.say(Severity::Notice, text!("profiles-in-flight"));
        return;
    }
    let cursor = if state.training.career.is_some() {
        let mut trainees = state.training().trainees().into_iter();
        trainees.position(|trainee| state.training().is_current(&trainee))
    } else {
        None
    };
    // A guest most likely wants a profile: the first one, or a new one.
    let cursor = cursor.unwrap_or(0);
    state.overlay = Some(Overlay::Profiles { cursor });
}

/// Handles a key while the list of profiles is open.
pub fn key(state: &mut State, cursor: usize, key: KeyEvent) -> Effects {
    let trainees = state.training().trainees();
    let cursor = match state.keymap.action(key, Place::List) {
        Some(Action::Escape) => return Effects::none(),
        Some(Action::Submit) => {
            let trainee = trainees.get(cursor).cloned();
            return trainee.map_or_else(Effects::none, |trainee| take(state, trainee));
        }
        Some(Action::Move(step)) => step.apply(cursor, trainees.len()),
        _ => cursor,
    };
    state.overlay = Some(Overlay::Profiles { cursor });
    Effects::none()
}

fn take(state: &mut State, trainee: Trainee) -> Effects {
    if state.training().is_current(&trainee) {
        return Effects::none();
    }
    match trainee {
        Trainee::Known(name) => Effects::from(Effect::Career(CareerEffect::Choose(name))),
        Trainee::Guest => Effects::from(Effect::Career(CareerEffect::Leave)),
        Trainee::New => {
            state.overlay = Some(Overlay::Prompt(Prompt::new(Purpose::NewProfile)));
            Effects::none()
        }
    }
}

/// Creates a profile. The prompt stays open until the profile exists, or shows the error.
///
/// # Errors
/// The name is empty.
pub fn created(state: &mut State, entered: &str) -> Result<Effects, Text> {
    let name = entered.trim();
    if name.is_empty() {
        return Err(text!("profiles-nameless"));
    }
    state.overlay = Some(Overlay::Prompt(Prompt {
        input: entered.into(),
        ..Prompt::new(Purpose::NewProfile)
    }));
    Ok(Effects::from(Effect::Career(CareerEffect::Create(
        name.to_owned(),
    ))))
}

/// Stores the trainee's career. If the trainee is another one or has one more flight, the home
/// screen's cursor moves to the recommended mission.
pub fn arrived(state: &mut State, career: Option<Career>) {
    let seen = |career: &Career| (career.name.clone(), career.standing.flights());
    let before = state.training.career.as_ref().map(seen);
    let now = career.as_ref().map(seen);
    let next_mission = career.as_ref().and_then(Career::next_mission);
    let next = next_mission.map(str::to_owned);
    state.training.career = career;
    if before == now {
        return;
    }
    home::point_at(state, next.as_deref());
    let name = |seen: &Option<(String, u32)>| seen.as_ref().map(|(name, _)| name.clone());
    if name(&before) != name(&now) {
        // The chosen fleets belong to another trainee.
        state.training.fleets.clear();
        if let Some(language) = state
            .training
            .career
            .as_ref()
            .and_then(|career| career.language)
        {
            state.speak(language);
        }
        if is_asking(state) {
            state.overlay = None;
        }
    }
}

fn is_asking(state: &State) -> bool {
    matches!(&state.overlay, Some(Overlay::Prompt(prompt)) if prompt.purpose == Purpose::NewProfile)
}
