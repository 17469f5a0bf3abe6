//! Actions with the same effect in every room.

use super::{mission, order, pace, palette, profiles, replay};
use crate::app::State;
use crate::app::action::{Action, SelectAction};
use crate::app::effect::{Effect, Effects, SessionEffect};
use crate::app::room::{self, Room, RoomRequest, fly, standing};
use crate::app::state::{Activity, Consequence, FlightView, HelpPage, Log, Overlay};
use crate::mission::Stake;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::{parse_ranges, ranges};

/// The greatest length of a typed vehicle list, in characters.
const LONGEST_LIST: usize = 60;

pub fn act(state: &mut State, action: Action) -> Effects {
    if let Some(requests) = room::act(state, action) {
        return requested(state, requests);
    }
    match action {
        Action::Show(room) => show(state, room),
        Action::CommandLine => open_palette(state, ""),
        Action::Help => state.overlay = Some(Overlay::Help(HelpPage::default())),
        Action::Notices => look_back(state, Log::Notices),
        Action::Brief => brief(state),
        Action::Move(step) => fly::move_cursor(state, step),
        Action::Select(action) => select_by(state, action),
        Action::Submit => submit(state),
        Action::Escape => escape(state),
        Action::Again => return mission::restart(state, false),
        Action::AgainAlike => return mission::restart(state, true),
        Action::PauseMission => return mission::turn(state),
        Action::Faster => return pace::faster(state),
        Action::UsualPace => return pace::usual(state),
        Action::Replay(action) => return replay::act(state, action),
        Action::Abandon => return mission::abandon(state),
        Action::Leave => return leave(state),
        Action::Profiles => profiles::open(state),
        Action::Quit => return quit(state),
        Action::Acknowledge => fly::acknowledge_pressing(state),
        Action::Aids => {
            let requests = standing::change_aids(state);
            return requested(state, requests);
        }
        // Only prompts and some rooms handle these actions.
        Action::View(_)
        | Action::Line(_)
        | Action::Start(_)
        | Action::Debrief(_)
        | Action::Map(_)
        | Action::Ledger(_)
        | Action::Parameters(_)
        | Action::Plans(_)
        | Action::Draw(_)
        | Action::Messages(_)
        | Action::Hangar(_)
        | Action::Workshop(_) => {}
    }
    Effects::none()
}

/// Carries out a room's requests.
fn requested(state: &mut State, requests: Vec<RoomRequest>) -> Effects {
    let mut effects = Effects::none();
    for request in requests {
        effects.extend(match request {
            RoomRequest::Effect(effect) => Effects::from(effect),
            RoomRequest::EndSession { question, effect } => guarded(state, question, effect),
            RoomRequest::Fly(launch) => mission::start(state, launch),
            RoomRequest::Exam(mission) => mission::start_exam(state, &mission),
            RoomRequest::Write(line) => {
                open_palette(state, &line);
                Effects::none()
            }
            RoomRequest::Show(room) => {
                show(state, room);
                Effects::none()
            }
            RoomRequest::Leave => leave(state),
            RoomRequest::Quit => quit(state),
        });
    }
    effects
}

pub fn show(state: &mut State, room: Room) {
    state.hush();
    state.room = room;
    room::entered(state, room);
}

/// Opens a log at its newest entry.
pub fn look_back(state: &mut State, log: Log) {
    state.overlay = Some(Overlay::Log { log, cursor: None });
}

/// Shows the mission's brief.
pub fn brief(state: &mut State) {
    show(state, Room::Mission);
}

/// Quits the program; asks first if something would be lost.
pub fn quit(state: &mut State) -> Effects {
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

/// Carries out an effect that ends the session; asks first if something would be lost.
pub fn guarded(state: &mut State, question: Text, effect: Effect) -> Effects {
    match loss(state) {
        Some(reason) => ask(state, question, reason, effect),
        None => order::carry_out(state, Consequence::Effect(effect)),
    }
}

/// Leaves the session; asks first if something would be lost.
pub fn leave(state: &mut State) -> Effects {
    guarded(
        state,
        text!("ask-leave"),
        Effect::Session(SessionEffect::Leave),
    )
}

/// Drops the session and shows the home screen. The debrief stays until another session starts.
pub fn go_home(state: &mut State) {
    state.session = FlightView::default();
    state.replay = None;
    state.ghost = None;
    let debrief = state.rooms.debrief.take();
    state.rooms.forget_session();
    state.rooms.debrief = debrief;
    state.typing.targets.clear();
    state.room = Room::Home;
}

/// Selects exactly those of these vehicles that exist; keeps the selection if none does.
pub fn select(state: &mut State, ids: &[VehicleId]) {
    let known = |id: &VehicleId| state.session.vehicles.contains_key(id);
    let (there, missing): (Vec<VehicleId>, Vec<VehicleId>) = ids.iter().partition(|id| known(id));
    if !missing.is_empty() {
        let vehicles = ranges(missing);
        let text = if there.is_empty() {
            text!("select-missing-all", vehicles = vehicles)
        } else {
            text!("select-missing", vehicles = vehicles)
        };
        state.say(Severity::Warning, text);
        if there.is_empty() {
            return;
        }
    }
    if let Some(&first) = there.first() {
        state.session.choice.place_cursor(first);
    }
    state.session.choice.selection = there.into_iter().collect();
}

/// The loss if the session ended now; `None` once the mission is over.
pub fn loss(state: &State) -> Option<Text> {
    let session = &state.session;
    // A mission that has not begun is only cancelled.
    let is_mission = matches!(session.activity, Some(Activity::Mission { .. }));
    let is_waiting = session.is_starting() || (is_mission && !session.has_flight_begun());
    let has_not_begun = is_waiting && session.armed() == 0;
    if session.task.over || session.activity.is_none() || has_not_begun || state.replay.is_some() {
        return None;
    }
    match (state.session.task.progress.is_some(), state.session.armed()) {
        (true, _) => Some(match session.activity {
            Some(Activity::Mission {
                stake: Stake::Exam, ..
            }) => text!("ask-exam-ends"),
            Some(Activity::Mission {
                stake: Stake::Graded | Stake::Daily,
                ..
            }) => text!("ask-given-up"),
            Some(
                Activity::Mission {
                    stake: Stake::Practice,
                    ..
                }
                | Activity::Free
                | Activity::Connected { .. },
            )
            | None => text!("ask-mission-lost"),
        }),
        (false, 0) => None,
        (false, armed) => Some(text!("ask-armed", count = armed)),
    }
}

/// Asks before an effect.
pub fn ask(state: &mut State, question: Text, reason: Text, effect: Effect) -> Effects {
    state.ask(question, reason, Consequence::Effect(effect));
    Effects::none()
}

/// Opens the command line. A vehicle list being typed becomes the targets.
pub fn open_palette(state: &mut State, words: &str) {
    let targets = std::mem::take(&mut state.typing.targets);
    let line = if targets.is_empty() {
        words.to_owned()
    } else {
        format!("{targets} {words}")
    };
    palette::open(state, line);
}

fn select_by(state: &mut State, action: SelectAction) {
    match action {
        SelectAction::Toggle => toggle(state),
        SelectAction::SelectAll => select_all(state),
        SelectAction::Invert => invert(state),
        SelectAction::Erase => {
            state.typing.targets.pop();
        }
    }
}

/// Selects or deselects the vehicle under the cursor.
fn toggle(state: &mut State) {
    let session = &mut state.session;
    if let Some(id) = session.choice.cursor
        && !session.choice.selection.remove(&id)
    {
        session.choice.selection.insert(id);
    }
}

/// Selects the vehicles in the table: those hidden by a filter are never selected.
fn select_all(state: &mut State) {
    state.session.choice.selection = state.rooms.fly.rows().iter().copied().collect();
}

/// Inverts the selection within the table.
fn invert(state: &mut State) {
    let shown = state.rooms.fly.rows().iter().copied();
    let selected = &state.session.choice.selection;
    let others = shown.filter(|id| !selected.contains(id)).collect();
    state.session.choice.selection = others;
}

/// Adds a character to the vehicle list, which begins with a digit.
pub fn type_ids(state: &mut State, c: char) {
    if (c.is_ascii_digit() || !state.typing.targets.is_empty())
        && state.typing.targets.len() < LONGEST_LIST
    {
        state.typing.targets.push(c);
    }
}

fn escape(state: &mut State) {
    state.hush();
    if state.typing.targets.is_empty() {
        state.session.choice.selection.clear();
    }
    state.typing.targets.clear();
}

fn submit(state: &mut State) {
    if state.typing.targets.is_empty() {
        return;
    }
    let typed = std::mem::take(&mut state.typing.targets);
    match parse_ranges(&typed) {
        Ok(ids) => select(state, &ids),
        Err(text) => state.say(Severity::Warning, text),
    }
}
