//! The desk lets missions be flown.

use std::time::Duration;

use super::super::super::loss::loss;
use super::super::super::{home, show};
use super::{BegunOrder, OrderTrace, is_exam};
use crate::app::State;
use crate::app::effect::{Effect, Effects, Launch, SessionEffect};
use crate::app::room::Room;
use crate::app::state::{Activity, OpenTry, SeatPlace};
use crate::campaign::{MissionStage, Stake};
use crate::class::{ExamTry, Outcome, Refusal, TryName};
use crate::class_text::try_title;
use crate::text;
use crate::vehicle::Severity;

/// Begins the flight of a mission with its brief, unless another flight would be lost. One of the same mission that is
/// under way is that flight already.
pub(super) fn fly(state: &State, mission: &str, is_exam: bool) -> Result<BegunOrder, Refusal> {
    if is_under_way(state, mission, is_exam) {
        return Ok(BegunOrder {
            effects: Effects::none(),
            trace: OrderTrace::Flight(flights(state).saturating_sub(1)),
        });
    }
    begin_flight(state, mission, is_exam)
}

/// Whether a mission is flown whose time has begun, and that is not over.
pub(super) fn is_under_way(state: &State, mission: &str, is_exam: bool) -> bool {
    let flown = state.flown_mission();
    let is_meant = match &state.session.activity {
        Some(Activity::Mission { stake: flown, .. }) => is_exam == (*flown == Stake::Exam),
        Some(Activity::Free | Activity::Connected { .. }) | None => false,
    };
    is_meant
        && has_mission(state)
        && state.session.has_flight_begun()
        && flown.is_some_and(|flown| flown.id == mission)
}

fn flights(state: &State) -> u32 {
    state.class.seat().map_or(0, |place| place.flights)
}

fn begin_flight(state: &State, mission: &str, is_exam: bool) -> Result<BegunOrder, Refusal> {
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
    Ok(BegunOrder {
        effects: Effect::Session(SessionEffect::StartMission(launch)).into(),
        trace: OrderTrace::Flight(flights(state)),
    })
}

/// Opens a try of an exam with the brief of its mission. One that is open already is open; one that was is not
/// opened again.
pub(super) fn examine(state: &mut State, opened: &ExamTry) -> Result<BegunOrder, Refusal> {
    let place = state.class.seat();
    if place.and_then(SeatPlace::flown_try) == Some(&opened.name) {
        let trace = OrderTrace::Flight(place.map_or(0, |place| place.flights) - 1);
        return Ok(BegunOrder {
            effects: Effects::none(),
            trace,
        });
    }
    let is_same = |name: &TryName| name.is_same_try(&opened.name);
    // The desk has given an earlier opening up; it sees that this one is flown.
    if place.and_then(SeatPlace::flown_try).is_some_and(is_same) {
        return Err(Refusal::Flying);
    }
    let is_known = place.is_some_and(|place| place.tries.iter().any(is_same));
    if is_known || opened.name.number > opened.tries || opened.within_s == 0 {
        return Err(Refusal::Flown);
    }
    let mission = opened.name.mission.as_str();
    let begun = begin_flight(state, mission, true)?;
    // Without designs of the trainee: all fly the mission's own vehicles.
    let launch = Launch {
        stake: Stake::Exam,
        drawn: Some(opened.seed),
        ..Launch::graded(mission)
    };
    let until = state.wall + Duration::from_secs(opened.within_s.into());
    if let Some(place) = state.class.seat_mut() {
        place.exam = Some(OpenTry {
            name: opened.name.clone(),
            title: try_title(opened),
            tries: opened.tries,
            flight: place.flights + 1,
            until,
            is_ended: false,
        });
    }
    Ok(BegunOrder {
        effects: Effect::Session(SessionEffect::StartMission(launch)).into(),
        ..begun
    })
}

/// How the order to open a try has ended; `None` before the flight is there.
pub(super) fn try_outcome(
    state: &mut State,
    opened: &ExamTry,
    trace: OrderTrace,
) -> Option<Outcome> {
    let OrderTrace::Flight(before) = trace else {
        return None;
    };
    let mission = opened.name.mission.as_str();
    if !is_flown(state, mission, before) {
        return None;
    }
    let place = state.class.seat_mut()?;
    if place.flown_try() != Some(&opened.name) {
        return Some(Outcome::NoEffect);
    }
    place.tries.insert(opened.name.clone());
    Some(Outcome::Done)
}

/// Ends a try whose time is up, also while the desk is away. The clock of a brief starts first, so that every try has a
/// record.
pub(super) fn end_late(state: &mut State) -> Effects {
    let wall = state.wall;
    let place = state.class.seat();
    let open = place.and_then(SeatPlace::open_try);
    let is_late = open.is_some_and(|it| wall >= it.until && !it.is_ended);
    if !is_late || state.session.task.over || state.session.activity.is_none() {
        return Effects::none();
    }
    if !state.session.has_flight_begun() {
        if !state.session.is_starting() && state.session.is_reading() {
            show::show(state, Room::Fly);
            state.session.leave_brief();
        }
        return Effects::none();
    }
    if let Some(open) = state.class.seat_mut().and_then(|it| it.exam.as_mut()) {
        open.is_ended = true;
    }
    super::tell(state, Severity::Warning, text!("class-exam-time-up"));
    Effect::Session(SessionEffect::Stop).into()
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
    let flown = state.flown_mission();
    flights(state) > before && flown.is_some_and(|flown| flown.id == mission)
}

/// Lets the time of a mission begin whose brief is shown; if its vehicles are still starting, after that. The time of
/// one that is over has begun.
pub(super) fn start(state: &State) -> Result<BegunOrder, Refusal> {
    if state.flown_mission().is_none() || state.replay.is_some() {
        return Err(Refusal::NoMission);
    }
    Ok(BegunOrder {
        effects: Effects::none(),
        trace: OrderTrace::Flight(flights(state)),
    })
}

/// Lets the time of this flight begin once its vehicles have started; `None` while they do.
pub(super) fn begin(state: &mut State, flight: u32) -> Option<Outcome> {
    if flights(state) != flight || state.flown_mission().is_none() {
        return Some(Outcome::Refused(Refusal::NoMission));
    }
    if state.session.task.over {
        return Some(Outcome::Done);
    }
    if state.session.is_starting() {
        return None;
    }
    if let Some(place) = state.class.seat_mut() {
        place.held = None;
    }
    if state.session.is_reading() {
        show::show(state, Room::Fly);
        state.session.leave_brief();
    }
    Some(Outcome::Done)
}

/// Ends the mission; one whose time has not begun is left without a score. In an exam, it has to begin first: the
/// flight counts.
pub(super) fn stop(state: &mut State) -> Result<BegunOrder, Refusal> {
    if !has_mission(state) {
        return Err(Refusal::NoMission);
    }
    if state.session.has_flight_begun() {
        return Ok(SessionEffect::Stop.into());
    }
    if is_exam(state) {
        return Err(Refusal::NotFlying);
    }
    if let Some(place) = state.class.seat_mut() {
        place.held = None;
    }
    home::go_home(state);
    Ok(SessionEffect::Leave.into())
}

/// Lets the trainee start a mission that the desk wanted to start, when the desk is gone. The brief is shown, so that
/// its time does not begin by itself.
pub(super) fn free_brief(state: &mut State) {
    let wall = state.wall;
    let Some(place) = state.class.seat_mut() else {
        return;
    };
    if !place.is_held() || place.hears_desk(wall) {
        return;
    }
    place.held = None;
    if state.session.is_reading() {
        show::show(state, Room::Mission);
        super::tell(state, Severity::Warning, text!("class-brief-freed"));
    }
}

/// Whether a mission is flown that is not over.
fn has_mission(state: &State) -> bool {
    state.flown_mission().is_some() && !state.session.task.over && state.replay.is_none()
}
