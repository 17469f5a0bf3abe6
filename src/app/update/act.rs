//! What each action does on the screens.

use super::{order, palette};
use crate::app::action::{Action, Step};
use crate::app::effect::Effect;
use crate::app::state::{
    Confirm, Connect, Consequence, HomeItem, Log, Overlay, Screen, Session, State, parse_ranges,
    ranges,
};
use crate::vehicle::Severity;
use crate::vehicle::VehicleId;

pub fn act(state: &mut State, action: Action) -> Vec<Effect> {
    match action {
        Action::Palette(words) => open_palette(state, words),
        Action::Help => state.overlay = Some(Overlay::Help { scroll: 0 }),
        Action::Links => state.overlay = Some(Overlay::Links { scroll: 0 }),
        Action::Ledger => look_back(state, Log::Ledger),
        Action::Notices => look_back(state, Log::Notices),
        Action::Brief => brief(state),
        Action::Move(step) => go(state, step),
        Action::Toggle | Action::SelectAll | Action::Invert => pick(state, action),
        Action::Type(c) => type_ids(state, c),
        Action::Erase => erase(state),
        Action::Submit => return submit(state),
        Action::Escape => escape(state),
        Action::Again => return restart(state),
        Action::Leave => return leave(state),
        Action::Quit => return quit(state),
        Action::Complete | Action::CompleteBack | Action::Older | Action::Newer => {}
    }
    Vec::new()
}

/// Shows a log, its newest entry first of all.
pub fn look_back(state: &mut State, log: Log) {
    state.overlay = Some(Overlay::Log { log, cursor: None });
}

/// Shows the mission's brief, if a mission is flown.
pub fn brief(state: &mut State) {
    if state.flown_mission().is_some() {
        state.overlay = Some(Overlay::Brief);
    } else {
        state.say(Severity::Notice, "no mission is being flown");
    }
}

/// Leaves the program; asks first where something would be lost.
pub fn quit(state: &mut State) -> Vec<Effect> {
    match loss(state) {
        Some(reason) => ask(state, "QUIT", reason, Effect::Quit),
        None => vec![Effect::Quit],
    }
}

/// Leaves the session; asks first where something would be lost.
pub fn leave(state: &mut State) -> Vec<Effect> {
    match loss(state) {
        Some(reason) => ask(state, "LEAVE the session", reason, Effect::LeaveSession),
        None => order::carry_out(state, Consequence::Effect(Effect::LeaveSession)),
    }
}

/// Flies the same mission again; asks first where something would be lost.
pub fn restart(state: &mut State) -> Vec<Effect> {
    if state.flown_mission().is_none() {
        state.say(Severity::Notice, "no mission is being flown");
        return Vec::new();
    }
    match loss(state) {
        Some(reason) => ask(state, "RESTART the mission", reason, Effect::RestartMission),
        None => vec![Effect::RestartMission],
    }
}

/// Ends the mission, after a question.
pub fn abandon(state: &mut State) -> Vec<Effect> {
    if state.session.mission.is_none() || !matches!(state.screen, Screen::Fly { .. }) {
        state.say(Severity::Notice, "no mission is being flown");
        return Vec::new();
    }
    let reason = "the debrief counts what has been reached so far".to_owned();
    ask(state, "ABANDON the mission", reason, Effect::AbandonMission)
}

/// Forgets the session and shows the home screen.
pub fn go_home(state: &mut State) {
    state.session = Session::default();
    state.screen = Screen::Home { cursor: 0 };
}

/// Selects exactly these vehicles, as far as they are there; keeps the selection if none of them is.
pub fn select(state: &mut State, ids: &[VehicleId]) {
    let known = |id: &VehicleId| state.session.vehicles.contains_key(id);
    let (there, missing): (Vec<VehicleId>, Vec<VehicleId>) = ids.iter().partition(|id| known(id));
    if !missing.is_empty() {
        let kept = if there.is_empty() {
            ": the selection stays as it was"
        } else {
            ""
        };
        let text = format!("there is no vehicle {}{kept}", ranges(missing));
        state.say(Severity::Warning, text);
        if there.is_empty() {
            return;
        }
    }
    if let Some(&first) = there.first() {
        state.session.place_cursor(first);
    }
    state.session.selection = there.into_iter().collect();
}

/// What would be lost by ending the session now; a mission that is over loses nothing.
fn loss(state: &State) -> Option<String> {
    if !matches!(state.screen, Screen::Fly { .. }) {
        return None;
    }
    let armed = state.session.armed();
    match (state.session.mission.is_some(), armed) {
        (true, _) => Some("the mission is not over; it would not count".to_owned()),
        (false, 0) => None,
        (false, 1) => Some("1 vehicle is armed".to_owned()),
        (false, _) => Some(format!("{armed} vehicles are armed")),
    }
}

fn ask(state: &mut State, question: &str, reason: String, effect: Effect) -> Vec<Effect> {
    state.overlay = Some(Overlay::Confirm(Confirm {
        question: question.to_owned(),
        reason,
        answer: "y".to_owned(),
        typed: String::new(),
        cancelled: false,
        then: Consequence::Effect(effect),
    }));
    Vec::new()
}

/// A vehicle list that was being typed becomes the targets of the line.
fn open_palette(state: &mut State, words: &str) {
    let targets = match &mut state.screen {
        Screen::Fly { typed } => std::mem::take(typed),
        _ => String::new(),
    };
    let line = if targets.is_empty() {
        words.to_owned()
    } else {
        format!("{targets} {words}")
    };
    palette::open(state, line);
}

fn go(state: &mut State, step: Step) {
    let items = state.home_items().len();
    match &mut state.screen {
        Screen::Home { cursor } => *cursor = step.apply(*cursor, items),
        Screen::Fly { .. } => {
            let row = step.apply(state.session.cursor_row(), state.session.vehicles.len());
            state.session.set_cursor_row(row);
        }
        Screen::Debrief { lines, scroll, .. } => *scroll = step.apply(*scroll, lines.len()),
    }
}

fn pick(state: &mut State, action: Action) {
    let session = &mut state.session;
    let all = session.vehicles.keys().copied();
    match action {
        Action::SelectAll => session.selection = all.collect(),
        Action::Invert => {
            session.selection = all.filter(|id| !session.selection.contains(id)).collect();
        }
        _ => {
            if let Some(id) = session.cursor
                && !session.selection.remove(&id)
            {
                session.selection.insert(id);
            }
        }
    }
}

fn type_ids(state: &mut State, c: char) {
    if let Screen::Fly { typed } = &mut state.screen
        && (c.is_ascii_digit() || !typed.is_empty())
        && typed.len() < 60
    {
        typed.push(c);
    }
}

fn erase(state: &mut State) {
    if let Screen::Fly { typed } = &mut state.screen {
        typed.pop();
    }
}

fn escape(state: &mut State) {
    state.hush();
    if let Screen::Fly { typed } = &mut state.screen {
        if typed.is_empty() {
            state.session.selection.clear();
        }
        typed.clear();
    }
}

fn submit(state: &mut State) -> Vec<Effect> {
    match &mut state.screen {
        Screen::Home { cursor } => {
            let cursor = *cursor;
            let item = state.home_items().get(cursor).copied();
            item.map_or_else(Vec::new, |item| enter(state, item))
        }
        Screen::Fly { typed } if !typed.is_empty() => {
            let typed = std::mem::take(typed);
            match parse_ranges(&typed) {
                Ok(ids) => select(state, &ids),
                Err(text) => state.say(Severity::Warning, text),
            }
            Vec::new()
        }
        _ => Vec::new(),
    }
}

fn enter(state: &mut State, item: HomeItem) -> Vec<Effect> {
    match item {
        HomeItem::Mission(at) => {
            let id = state.missions[at].id.clone();
            state.say(Severity::Info, "starting the mission ...");
            vec![Effect::StartMission(id)]
        }
        HomeItem::Free => {
            state.say(Severity::Info, "starting the simulator ...");
            vec![Effect::StartFree]
        }
        HomeItem::Connect => {
            state.overlay = Some(Overlay::Connect(Connect::default()));
            Vec::new()
        }
        HomeItem::Quit => quit(state),
    }
}
