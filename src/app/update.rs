//! The one function that changes the state.

use super::effect::Effect;
use super::event::Event;
use super::room::{parameters, workshop};
use super::state::State;
use crate::ledger::Entry;

pub(super) mod act;
mod console_line;
mod hangar;
mod keys;
mod links;
pub(super) mod mission;
mod offer;
pub(super) mod order;
mod palette;
pub(super) mod profiles;
mod swarm;
mod telemetry;

/// Takes in what happened and says what the shell has to do.
pub fn update(state: &mut State, event: Event) -> Vec<Effect> {
    let (room, had_overlay) = (state.room, state.overlay.is_some());
    let said = state.message().cloned();
    let mut effects = react(state, event);
    // A message goes with what it was about, unless it has only just been said.
    let is_elsewhere = state.room != room || (state.overlay.is_some() && !had_overlay);
    if is_elsewhere && state.message() == said.as_ref() {
        state.hush();
    }
    effects.extend(telemetry::signals(state));
    workshop::weigh(state);
    effects
}

fn react(state: &mut State, event: Event) -> Vec<Effect> {
    match event {
        Event::Tick { now } => {
            telemetry::tick(state, now);
            return parameters::wanted(state);
        }
        Event::Vehicle(vehicle) => {
            telemetry::vehicle(state, *vehicle);
            return Vec::new();
        }
        Event::Findings(findings) => {
            links::findings(state, findings);
            return Vec::new();
        }
        Event::Traffic(traffic) => {
            links::traffic(state, traffic);
            return Vec::new();
        }
        _ => state.touch(),
    }
    match event {
        Event::Key(key) => return keys::press(state, key),
        Event::Paste(text) => keys::paste(state, &text),
        Event::Started(started) => telemetry::started(state, *started),
        Event::Notice(notice) => telemetry::notice(state, &notice),
        Event::NoticesDropped(count) => state.notices.dropped = count,
        Event::Parameters { vehicle, snapshot } => parameters::arrived(state, vehicle, snapshot),
        Event::ParametersRead { path, text } => parameters::read(state, path, &text),
        Event::ParametersSaved { path } | Event::DesignWritten { path } => {
            parameters::saved(state, &path);
        }
        Event::ParametersExist { path, text } => parameters::exists(state, path, text),
        Event::DesignRead { path, text } => return workshop::read(state, &path, &text),
        Event::DesignExists { path, text } => workshop::exists(state, path, text),
        Event::Row(row) => {
            let ledger = &mut state.session.ledger;
            let was_over = ledger.entry(row.entry).is_none_or(Entry::is_final);
            ledger.apply(&row);
            state.rooms.ledger.spoil();
            if !was_over {
                parameters::tell(state, row.entry);
            }
            return parameters::advance(state);
        }
        Event::Hangar(instances) => hangar::changed(state, &instances),
        Event::NotLaunched(text) => hangar::not_launched(state, text),
        Event::Printed {
            vehicle,
            anew,
            lines,
        } => hangar::printed(state, vehicle, anew, lines),
        Event::Links(links) => state.session.links = links,
        Event::Paused(paused) => mission::paused(state, paused),
        Event::Paths(paths) => state.session.paths = paths,
        Event::Mission(progress) => telemetry::progress(state, *progress),
        Event::MissionEnded(report) => telemetry::ended(state, report),
        Event::Profiles(names) => state.profiles = names,
        Event::Career(career) => {
            profiles::arrived(state, career.map(|career| *career));
            workshop::heard(state);
        }
        Event::Tries(tries) => state.tries = tries,
        Event::Rewarded(reward) => state.reward = Some(*reward),
        Event::Failed(text) => telemetry::failed(state, text),
        Event::Line(line) => return palette::give(state, &line),
        Event::SlowLine(bytes_per_s) => state.slow_line = bytes_per_s,
        Event::Resize { columns, rows } => keys::resize(state, columns, rows),
        Event::Tick { .. } | Event::Vehicle(_) | Event::Findings(_) | Event::Traffic(_) => {}
    }
    Vec::new()
}
