//! The one function that changes the state.
//!
//! # How the parts fit
//! - A key goes to the overlay that is open, otherwise through the keymap (`keys`): `act` carries out what works in
//!   every room, `show` changes the room, `palette` edits, completes (`offer`) and runs a line, `typing` and `prompt`
//!   edit other texts, `reader` moves through help and logs, `latin` reads a line typed in the Ukrainian layout.
//! - A line: `order` finds the targets of a command to vehicles, asks before a dangerous one and opens its ledger
//!   entry; `own_fence` decides whether its target lies outside a vehicle's own fence. `console_line` carries out
//!   lines for the console, with `alert_line`, `drafts`, `forget`, `forwards`, `radio`, `selection` and
//!   `vehicle_files` for their subjects. `macros` checks all lines of a macro before the first one is given, `batch`
//!   sets parameters one after another, `program` refuses what programs may not give.
//! - `consequence` carries out what was confirmed. `loss` finds what would be lost if the session ended now, and
//!   `ending` asks before that; `home` leads home after it.
//! - The course of a session: `start`, `mission` (pause, restart, give up), `replay`, `review`, `ghost`, `sticks`;
//!   `crew` is what the host of a crew and its members do, `relay` what members ask for; `pace` decides when the speed-up may rise, and which event resets it.
//! - Reports of the shell: `telemetry` (time, vehicles, notices, and the signals that are due), `links`, `hangar`,
//!   `files`, `profiles`.

use super::State;
use super::effect::{Effects, FileKind};
use super::event::{
    CareerEvent, Event, FileEvent, LinkEvent, ProcessEvent, SessionEvent, TerminalEvent,
    VehicleEvent,
};
use super::room::{files as room_files, parameters, plans, workshop};
use super::state::{Overlay, Room};
use crate::ledger::{Given, LedgerEntry, RowUpdate};
use crate::vehicle::Severity;

mod act;
mod alert_line;
mod batch;
mod class;
mod consequence;
mod console_line;
mod crew;
mod drafts;
mod ending;
mod files;
mod forget;
mod forwards;
mod ghost;
mod hangar;
mod home;
mod keys;
mod latin;
mod links;
mod loss;
mod macros;
mod mission;
mod offer;
mod order;
mod own_fence;
mod pace;
mod palette;
mod profiles;
mod program;
mod prompt;
mod radio;
mod reader;
mod relay;
mod replay;
mod review;
mod selection;
mod show;
mod start;
mod sticks;
mod telemetry;
mod typing;
mod vehicle_files;

/// Handles an event and returns the work for the shell.
pub fn update(state: &mut State, event: Event) -> Effects {
    let (room, had_overlay) = (state.room, state.overlay.is_some());
    let said = state.message().cloned();
    let held = sticks::held(state);
    let watch = pace::watch(state, &event);
    let witnessed = class::witnessed(state, &event);
    let is_tick = matches!(event, Event::Tick { .. });
    let mut effects = react(state, event);
    // A message disappears with its subject, unless it has only just appeared.
    let is_elsewhere = state.room != room || (state.overlay.is_some() && !had_overlay);
    if is_elsewhere && state.message() == said.as_ref() {
        state.hush();
    }
    effects.extend(sticks::released(state, held));
    effects.extend(telemetry::signals(state));
    effects.extend(palette::wanted(state));
    effects.extend(plans::wanted_ground(state));
    if let Some(reason) = watch.and_then(|before| pace::news(state, before)) {
        effects.extend(pace::fall_back(state, reason));
    }
    class::follow(state, is_tick, witnessed, &mut effects);
    workshop::weigh(state);
    stay_with_vehicles(state);
    mission::leave_brief(state);
    effects
}

/// Shows the vehicles where a session would show the hangar or the brief: the plain console prints
/// these as lines.
fn stay_with_vehicles(state: &mut State) {
    let is_waiting = state.room == Room::Hangar && state.session.is_starting();
    if !state.display.has_rooms && (is_waiting || state.room == Room::Mission) {
        state.room = Room::Fly;
    }
}

fn react(state: &mut State, event: Event) -> Effects {
    match event {
        Event::Tick { now, wall } => {
            telemetry::tick(state, now, wall);
            let mut effects = parameters::wanted(state);
            effects.extend(plans::keep(state));
            effects.extend(vehicle_files::wanted(state));
            effects.extend(sticks::tick(state));
            effects.extend(crew::tick(state));
            return effects;
        }
        Event::Terminal(event) => return terminal(state, event),
        Event::Program(line) => return program::give(state, &line),
        Event::Vehicle(event) => return vehicle(state, event),
        Event::Link(event) => return link(state, event),
        Event::Process(event) => processes(state, event),
        Event::Session(event) => {
            let has_begun = matches!(event, SessionEvent::Started(_));
            session(state, event);
            if has_begun {
                return crew::began(state);
            }
        }
        Event::Replay(event) => replay::happened(state, event),
        Event::Career(event) => career(state, event),
        Event::Class(event) => return class::happened(state, event),
        Event::Crew(event) => return crew::happened(state, event),
        Event::File(event) => return file(state, event),
        Event::Tried(tried) => {
            state.touch();
            plans::tried(state, tried);
        }
        Event::Notice(notice) => telemetry::notice(state, &notice),
        Event::NoticesDropped(count) => telemetry::dropped(state, count),
        Event::Answer(text) => telemetry::answer(state, text),
        Event::Failed(text) => telemetry::failed(state, text),
    }
    Effects::none()
}

fn terminal(state: &mut State, event: TerminalEvent) -> Effects {
    state.touch();
    match event {
        TerminalEvent::Key(key) => return keys::press(state, key),
        TerminalEvent::Line(line) => return palette::give(state, &line),
        TerminalEvent::Paste(text) => keys::paste(state, &text),
        TerminalEvent::Click { column, row } => keys::click(state, column, row),
        TerminalEvent::Resize { columns, rows } => keys::resize(state, columns, rows),
        TerminalEvent::Choose(action) => return keys::choose(state, action),
        TerminalEvent::Told => told(state),
        TerminalEvent::SlowLine(bytes_per_s) => state.display.slow_line = bytes_per_s,
    }
    Effects::none()
}

/// Clears the messages and overlays that the plain console has printed.
fn told(state: &mut State) {
    state.hush();
    if !matches!(state.overlay, Some(Overlay::Confirm(_))) {
        state.overlay = None;
    }
    if state.session.activity.is_some() && state.rooms.debrief.session().is_none() {
        state.room = Room::Fly;
    }
}

fn vehicle(state: &mut State, event: VehicleEvent) -> Effects {
    match event {
        // Many vehicles report often: redraw only if the snapshot differs.
        VehicleEvent::Telemetry(vehicle) => {
            telemetry::vehicle(state, vehicle);
            return Effects::none();
        }
        VehicleEvent::Parameters { vehicle, snapshot } => {
            parameters::arrived(state, vehicle, snapshot);
        }
        VehicleEvent::Given {
            at,
            line,
            verb,
            risk,
            by,
            vehicles,
        } => {
            let given = Given {
                line: line.as_str(),
                verb,
                risk,
                by: by.as_ref(),
            };
            state.session.commands.open(at, given, &vehicles);
            state.rooms.ledger.spoil();
        }
        VehicleEvent::Row(row) => {
            state.touch();
            return order_advanced(state, &row);
        }
        VehicleEvent::Folder(folder) => room_files::listed(state, folder),
        VehicleEvent::Foreign(command) => {
            state.session.commands.ledger.note_foreign(command);
            state.rooms.ledger.spoil();
        }
        VehicleEvent::Paths(paths) => state.session.paths = paths,
        VehicleEvent::Pilots(pilots) => state.session.pilots = pilots,
        VehicleEvent::Rehearsed(findings) => state.session.note_rehearsal(findings),
    }
    state.touch();
    Effects::none()
}

/// Updates the ledger with an order's progress, and sends batch commands that waited for it.
fn order_advanced(state: &mut State, row: &RowUpdate) -> Effects {
    let ledger = &mut state.session.commands.ledger;
    let was_over = ledger.entry(row.entry).is_none_or(LedgerEntry::is_final);
    ledger.apply(row);
    state.rooms.ledger.spoil();
    if !was_over {
        parameters::tell(state, row.entry);
    }
    room_files::advanced(state, row);
    tell_failure(state, row);
    batch::advance(state)
}

/// Says on the last line why a vehicle did not do what was asked of it, in rooms that command vehicles and do not show
/// the ledger.
fn tell_failure(state: &mut State, row: &RowUpdate) {
    let shows_ledger = state.room == Room::Fly || !state.room.shows_vehicles();
    if shows_ledger || !row.state.is_failure() {
        return;
    }
    let Some(entry) = state.session.commands.ledger.entry(row.entry) else {
        return;
    };
    if entry.by.is_some() {
        // It was not the user who commanded.
        return;
    }
    let Some(failed) = entry.rows.iter().find(|it| it.vehicle == row.vehicle) else {
        return;
    };
    let text = parameters::fate(failed, &entry.rows);
    state.say(Severity::Warning, text);
}

fn link(state: &mut State, event: LinkEvent) -> Effects {
    match event {
        LinkEvent::Summaries(summaries) => {
            state.session.connections.links = summaries;
            state.touch();
        }
        LinkEvent::Forwards(forwards) => forwards::changed(state, forwards),
        // Both come every second: redraw only if they differ or are on the screen.
        LinkEvent::Findings(findings) => links::findings(state, findings),
        LinkEvent::Traffic(traffic) => return links::traffic(state, traffic),
    }
    Effects::none()
}

fn processes(state: &mut State, event: ProcessEvent) {
    state.touch();
    match event {
        ProcessEvent::Instances(instances) => hangar::changed(state, &instances),
        ProcessEvent::NotLaunched(text) => hangar::not_launched(state, text),
        ProcessEvent::Printed {
            vehicle,
            anew,
            lines,
        } => hangar::printed(state, vehicle, anew, lines),
    }
}

fn session(state: &mut State, event: SessionEvent) {
    state.touch();
    match event {
        SessionEvent::Started(started) => start::started(state, *started),
        SessionEvent::Ended => home::go_home(state),
        SessionEvent::Paused(paused) => mission::paused(state, paused),
        SessionEvent::Speedup(change) => pace::changed(state, change),
        SessionEvent::Mission(progress) => telemetry::progress(state, *progress),
        SessionEvent::MissionEnded(report) => telemetry::ended(state, report),
        SessionEvent::Instructed(order) => class::instructed(state, &order),
        SessionEvent::Recalled(flight) => class::recalled(state, *flight),
        SessionEvent::Ghost(other) => ghost::arrived(state, *other),
    }
}

fn career(state: &mut State, event: CareerEvent) {
    state.touch();
    match event {
        CareerEvent::Profiles(names) => state.training.profiles = names,
        CareerEvent::Career(career) => {
            profiles::arrived(state, career.map(|career| *career));
            workshop::heard(state);
        }
        CareerEvent::Tries(tries) => state.training.tries = tries,
        CareerEvent::Reviews(reviews) => state.training.reviews = reviews,
        CareerEvent::Rewarded(reward) => state.training.reward = Some(*reward),
        CareerEvent::AtRisk(count) => state.training.at_risk = count,
    }
}

fn file(state: &mut State, event: FileEvent) -> Effects {
    state.touch();
    match event {
        FileEvent::Read { kind, path, text } => match kind {
            FileKind::Parameters => parameters::read(state, path, &text),
            FileKind::Design => workshop::read(state, &path, &text),
            FileKind::Plan => plans::read(state, &path, &text),
            FileKind::Review | FileKind::Statistics => {}
        },
        FileEvent::Ground { folder, terrain } => plans::ground_read(state, &folder, terrain),
        FileEvent::Listed { folder, names } => palette::listed(state, &folder, names),
        FileEvent::Kept { text } => plans::restore(state, &text),
        FileEvent::Written { path } => files::written(state, &path),
        FileEvent::Exists { kind, path, text } => return files::exists(state, kind, path, text),
    }
    Effects::none()
}
