//! The speed-up of simulated time: higher while nothing happens, and reset when an event needs
//! attention.

use std::collections::BTreeSet;

use super::replay;
use crate::alert::AlertKind;
use crate::app::State;
use crate::app::action::Action;
use crate::app::effect::{Effect, Effects, PaceChange, SessionEffect};
use crate::app::event::{Event, SessionEvent, VehicleEvent};
use crate::app::state::{Activity, rate};
use crate::commands::FindKind;
use crate::ledger::{RowState, RowUpdate};
use crate::mission::{ObjectiveState, Progress, ShownContact, Stake};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// The highest speed-up of free flight.
const FREE_FLIGHT_MOST: f64 = 100.0;
const KEY_FACTOR: f64 = 2.0;

/// Doubles the speed-up, up to the limit; in a replay, raises the rate. In a mission, the key works
/// only while a command is under way; otherwise an extra key press would use up the mission's time
/// and the battery.
pub fn faster(state: &mut State) -> Effects {
    if state.replay.is_some() {
        return replay::change_rate(state, true);
    }
    let is_mission = matches!(state.session.activity, Some(Activity::Mission { .. }));
    if is_mission && !is_anything_under_way(state) {
        return refuse(state, text!("speedup-nothing-to-wait-for"));
    }
    let pace = state.session.timing.pace;
    let most = most(state).max(pace.usual);
    if pace.now >= most && obstacle(state, most).is_none() {
        return refuse(state, text!("speedup-limit", most = rate(most)));
    }
    set(state, (pace.now * KEY_FACTOR).min(most))
}

/// Returns to the speed-up at the start of the session; in a replay, lowers the rate.
pub fn usual(state: &mut State) -> Effects {
    if state.replay.is_some() {
        return replay::change_rate(state, false);
    }
    set(state, state.session.timing.pace.usual)
}

/// Sets the speed-up over the wall clock, or shows why that is not possible; in a replay, sets the
/// rate.
pub fn set(state: &mut State, speedup: f64) -> Effects {
    if state.replay.is_some() {
        return replay::set_rate(state, speedup);
    }
    let now = state.session.timing.pace.now;
    let is_same = (speedup - now).abs() < f64::EPSILON;
    let same = || is_same.then(|| text!("speedup-same", rate = rate(now)));
    match obstacle(state, speedup).or_else(same) {
        Some(reason) => refuse(state, reason),
        None => change(PaceChange::wanted(speedup)),
    }
}

fn refuse(state: &mut State, reason: Text) -> Effects {
    state.say(Severity::Warning, reason);
    Effects::none()
}

fn change(change: PaceChange) -> Effects {
    Effects::from(Effect::Session(SessionEffect::Speedup(change)))
}

/// Applies a change of the speed-up.
pub fn changed(state: &mut State, change: PaceChange) {
    let session = &mut state.session;
    session.timing.pace.now = change.speedup;
    if session.activity == Some(Activity::Free) {
        session.timing.clock.go(state.now, change.speedup);
    }
    let rate = rate(change.speedup);
    if let Some(reason) = change.because {
        let is_real_time = (change.speedup - 1.0).abs() < f64::EPSILON;
        let text = if is_real_time {
            text!("speedup-back", reason = reason)
        } else {
            text!("speedup-back-to", rate = rate, reason = reason)
        };
        state.say(Severity::Notice, text);
    } else if state.session.timing.pace.is_fast() {
        let key = state.key(Action::UsualPace);
        if is_anything_under_way(state) {
            let text = text!("speedup-is", rate = rate, key = key);
            state.say(Severity::Notice, text);
        } else {
            let text = text!("speedup-idle", rate = rate, key = key);
            state.say(Severity::Warning, text);
        }
    } else {
        state.say(Severity::Notice, text!("speedup-usual", rate = rate));
    }
}

/// Whether a command is still under way.
fn is_anything_under_way(state: &State) -> bool {
    let mut entries = state.session.commands.ledger.entries();
    entries.any(|entry| !entry.is_final())
}

/// The state before an event, to decide whether the event needs attention.
pub struct Watch {
    /// The reason found in the event itself.
    reason: Option<Text>,
    alerts: BTreeSet<(VehicleId, AlertKind)>,
}

/// Captures the state before an event; `None` unless time runs faster than usual.
pub fn watch(state: &State, event: &Event) -> Option<Watch> {
    (state.session.timing.pace.is_fast() && state.replay.is_none()).then(|| Watch {
        reason: reason(state, event),
        alerts: open_alerts(state),
    })
}

/// The reason to return to the usual pace: one in the event itself, or a new alert; `None` if there
/// is neither.
pub fn news(state: &State, before: Watch) -> Option<Text> {
    before.reason.or_else(|| new_alert(state, &before.alerts))
}

/// Returns to the usual pace, with the reason for the notice.
pub fn fall_back(state: &State, reason: Text) -> Effects {
    change(PaceChange {
        speedup: state.session.timing.pace.usual,
        because: Some(reason),
    })
}

fn open_alerts(state: &State) -> BTreeSet<(VehicleId, AlertKind)> {
    let open = state.session.alerts.open();
    open.map(|(id, one)| (id, one.alert.kind)).collect()
}

fn new_alert(state: &State, known: &BTreeSet<(VehicleId, AlertKind)>) -> Option<Text> {
    let open = state.session.alerts.open();
    let (vehicle, one) = open
        .filter(|(id, one)| !known.contains(&(*id, one.alert.kind)))
        .min_by_key(|(_, one)| one.alert.severity)?;
    let alert = one.alert.text.clone();
    Some(text!("speedup-alert", vehicle = vehicle, alert = alert))
}

/// The reason why an event needs attention; `None` if it needs none.
fn reason(state: &State, event: &Event) -> Option<Text> {
    match event {
        Event::Vehicle(VehicleEvent::Row(row)) => said_by_vehicle(state, row),
        Event::Session(SessionEvent::Mission(progress)) => said_by_mission(state, progress),
        Event::Notice(notice) => {
            (notice.severity <= Severity::Warning).then(|| notice.text.clone())
        }
        Event::Tick { .. }
        | Event::Terminal(_)
        | Event::Program(_)
        | Event::Vehicle(_)
        | Event::Link(_)
        | Event::Process(_)
        | Event::Session(_)
        | Event::Replay(_)
        | Event::Career(_)
        | Event::Class(_)
        | Event::Crew(_)
        | Event::File(_)
        | Event::Tried(_)
        | Event::NoticesDropped(_)
        | Event::Answer(_)
        | Event::Failed(_) => None,
    }
}

/// A command that ended otherwise than intended, or the end of the last movement under way.
fn said_by_vehicle(state: &State, row: &RowUpdate) -> Option<Text> {
    let verb = state.session.commands.ledger.entry(row.entry)?.verb;
    let is_end = verb.movement.moves() && row.state.is_final();
    let is_broken_off = is_end && row.state == RowState::Superseded;
    let needs_a_person = row.state.is_failure() || is_broken_off;
    let (verb, vehicle) = (verb.name, row.vehicle);
    (needs_a_person || is_end && !moves_after(state, row)).then(|| {
        if row.state == RowState::Done {
            return text!("speedup-done", verb = verb, vehicle = vehicle);
        }
        let state = row.state.text();
        text!("speedup-row", verb = verb, vehicle = vehicle, state = state)
    })
}

/// Whether another movement is still under way after an update of this one.
fn moves_after(state: &State, update: &RowUpdate) -> bool {
    let moving = state.session.commands.ledger.entries();
    let mut moving = moving.filter(|entry| entry.verb.movement.moves());
    moving.any(|entry| {
        let mut rows = entry.rows.iter();
        let is_ended = |vehicle| entry.id == update.entry && vehicle == update.vehicle;
        rows.any(|row| !row.state.is_final() && !is_ended(row.vehicle))
    })
}

fn said_by_mission(state: &State, progress: &Progress) -> Option<Text> {
    let known = state.session.task.progress.as_ref()?;
    let alerts = &progress.alerts;
    let is_known = |text: &Text| known.alerts.iter().any(|old| old.text == *text);
    if alerts.len() > known.alerts.len() {
        let new = alerts.iter().find(|it| !is_known(&it.text));
        return new.or(alerts.first()).map(|it| it.text.clone());
    }
    if let Some(contact) = new_contact(progress, known) {
        return Some(text!("speedup-contact", contact = &contact.name));
    }
    let mut objectives = progress.objectives.iter().zip(&known.objectives);
    let (changed, _) = objectives.find(|(new, old)| new.state != old.state)?;
    let title = &changed.title;
    Some(match changed.state {
        ObjectiveState::Met => text!("speedup-met", objective = title),
        ObjectiveState::Missed => text!("speedup-missed", objective = title),
        ObjectiveState::Open => text!("speedup-open", objective = title),
    })
}

/// A contact that was not known before. Of a fire, which has dozens of contacts, only the first counts.
fn new_contact<'a>(progress: &'a Progress, known: &Progress) -> Option<&'a ShownContact> {
    let is_known = |new: &ShownContact| {
        let is_fire = new.kind == FindKind::Fire;
        let mut known = known.contacts.iter();
        known.any(|old| old.name == new.name || is_fire && old.kind == FindKind::Fire)
    };
    progress.contacts.iter().find(|new| !is_known(new))
}

fn most(state: &State) -> f64 {
    let listing = state.session.task.listing.as_ref();
    listing.map_or(FREE_FLIGHT_MOST, |listing| listing.most_speedup)
}

/// The reason why a speed-up is not possible; `None` if it is.
fn obstacle(state: &State, speedup: f64) -> Option<Text> {
    let session = &state.session;
    match &session.activity {
        None => Some(text!("speedup-nothing")),
        _ if session.task.over => Some(text!("deed-over")),
        _ if session.hangar.is_some() => Some(text!("speedup-not-processes")),
        Some(Activity::Connected { .. }) => Some(text!("speedup-not-real")),
        Some(Activity::Free) => (speedup > FREE_FLIGHT_MOST)
            .then(|| text!("speedup-too-much", most = rate(FREE_FLIGHT_MOST))),
        Some(Activity::Mission { stake, .. }) => {
            let (usual, most) = (session.timing.pace.usual, most(state));
            if speedup < usual {
                Some(text!("speedup-too-little", least = rate(usual)))
            } else if speedup > most && *stake == Stake::Exam {
                Some(text!("speedup-not-in-exams"))
            } else if speedup > most && most <= 1.0 {
                Some(text!("speedup-not-allowed"))
            } else {
                let is_too_much = speedup > most.max(usual);
                is_too_much.then(|| text!("speedup-too-much", most = rate(most)))
            }
        }
    }
}
