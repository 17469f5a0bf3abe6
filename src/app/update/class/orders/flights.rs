//! The desk lets missions be flown.

use super::super::super::loss::loss;
use super::super::super::show;
use super::{BegunOrder, OrderTrace};
use crate::app::State;
use crate::app::effect::{Effect, Effects, Launch, SessionEffect};
use crate::app::room::Room;
use crate::app::state::Activity;
use crate::campaign::{MissionStage, Stake};
use crate::class::{Outcome, Refusal};

/// Begins the flight of a mission with its brief, unless another flight would be lost.
pub(super) fn fly(state: &State, mission: &str, is_exam: bool) -> Result<BegunOrder, Refusal> {
    let is_connected = matches!(state.session.activity, Some(Activity::Connected { .. }));
    if loss(state).is_some() || is_connected && state.replay.is_none() {
        return Err(Refusal::Flying);
    }
    if is_exam && is_locked(state, mission) {
        return Err(Refusal::Locked);
    }
    let launch = Launch {
        stake: if is_exam { Stake::Exam } else { Stake::Graded },
        ..state.training().launch(mission)
    };
    let flights = state.class.seat().map_or(0, |place| place.flights);
    Ok(BegunOrder {
        effects: Effect::Session(SessionEffect::StartMission(launch)).into(),
        trace: OrderTrace::Flight(flights),
    })
}

/// Whether the trainee's career does not permit the mission yet: it would be flown for practice.
fn is_locked(state: &State, mission: &str) -> bool {
    let stage = state
        .training()
        .career()
        .and_then(|career| career.stage(mission));
    matches!(stage, Some(MissionStage::Locked(_)))
}

/// Whether the flight of a mission has begun after this many others.
pub(super) fn is_flown(state: &State, mission: &str, before: u32) -> bool {
    let flights = state.class.seat().map_or(0, |place| place.flights);
    let flown = state.flown_mission();
    flights > before && flown.is_some_and(|flown| flown.id == mission)
}

/// Lets the time of a mission begin whose brief is shown; if its vehicles are still starting, after that.
pub(super) fn start(state: &State) -> Result<BegunOrder, Refusal> {
    if !has_mission(state) {
        return Err(Refusal::NoMission);
    }
    let flights = state.class.seat().map_or(0, |place| place.flights);
    Ok(BegunOrder {
        effects: Effects::none(),
        trace: OrderTrace::Flight(flights),
    })
}

/// Lets the time of this flight begin once its vehicles have started; `None` while they do.
pub(super) fn begin(state: &mut State, flight: u32) -> Option<Outcome> {
    let flights = state.class.seat().map_or(0, |place| place.flights);
    if flights != flight || !has_mission(state) {
        return Some(Outcome::Refused(Refusal::NoMission));
    }
    if state.session.is_starting() {
        return None;
    }
    if state.session.is_reading() {
        show::show(state, Room::Fly);
        state.session.leave_brief();
    }
    Some(Outcome::Done)
}

/// Whether a mission is flown that is not over.
fn has_mission(state: &State) -> bool {
    state.flown_mission().is_some() && !state.session.task.over && state.replay.is_none()
}
