//! The content of the cells of the swarm table.

use std::time::Duration;

use crate::alert::AlertKind;
use crate::app::State;
use crate::app::room::map::PAUSED;
use crate::app::state::{FlightView, Standing};
use crate::config::Column;
use crate::ledger::RowState;
use crate::text;
use crate::text::{Text, figure};
use crate::ui::look::{Badge, Look};
use crate::ui::theme::Role;
use crate::ui::widget::gauge::{battery_role, link_role};
use crate::ui::widget::{clip, leg, row_role, severity_role, short_clock, told_apart, width};
use crate::vehicle::{FixType, LandedState, Severity, Vehicle};

/// A text, and its role.
pub type Cell = (String, Role);

/// The states of a command that are shown without a figure.
const STATES: [RowState; 10] = [
    RowState::Queued,
    RowState::Sent,
    RowState::SentOnly,
    RowState::Accepted,
    RowState::NoEffect,
    RowState::Refused,
    RowState::TimedOut,
    RowState::Superseded,
    RowState::Overtaken,
    RowState::Barred,
];

/// Words that many rows contain, looked up once.
pub struct Words {
    pub armed: String,
    pub ready: String,
    pub off: String,
    pub ground: String,
    pub air: String,
    pub takeoff: String,
    pub landing: String,
    pub moving: String,
    pub still: String,
    pub paused: String,
    pub lost: String,
    pub done: String,
    pub over: String,
    pub own: String,
    states: Vec<(RowState, String)>,
}

impl Words {
    /// Looks up the words in a language.
    pub fn new(look: &Look) -> Self {
        Self {
            armed: look.say("fly-armed"),
            ready: look.say("fly-ready"),
            off: look.say("fly-off"),
            ground: look.say("fly-ground"),
            air: look.say("fly-air"),
            takeoff: look.say("fly-takeoff"),
            landing: look.say("fly-landing"),
            moving: look.say("fly-moving"),
            still: look.say("fly-still"),
            paused: look.say("fly-paused"),
            lost: look.say("fly-lost"),
            done: look.say("fly-done"),
            over: look.say("fly-over"),
            own: look.say("fly-own"),
            states: STATES
                .map(|state| (state, look.text(&short(state))))
                .to_vec(),
        }
    }

    fn state(&self, state: RowState) -> String {
        let known = self.states.iter().find(|(known, _)| *known == state);
        known.map_or_else(String::new, |(_, word)| word.clone())
    }
}

/// The state of a command, short enough for a cell.
fn short(state: RowState) -> Text {
    match state {
        RowState::NoEffect => text!("fly-no-effect"),
        RowState::TimedOut => text!("fly-timed-out"),
        other => other.name(),
    }
}

/// The data from which the cells of a row are made.
pub struct Row<'a> {
    pub vehicle: &'a Vehicle,
    pub state: &'a State,
    pub words: &'a Words,
    pub selected: bool,
}

/// A vehicle's cell in a column of this width.
pub fn cell(column: Column, row: &Row<'_>, look: &Look, width: usize) -> Cell {
    let session = row.state.session();
    let number = |decimals: usize| {
        let value = column.number(row.vehicle, session);
        value.map_or_else(unknown, |value| (figure(value, decimals), Role::Text))
    };
    match column {
        Column::Id => id(row),
        Column::Name => (look.text(&FlightView::name(row.vehicle)), Role::Muted),
        Column::Group => teams(row),
        Column::Pilot => pilot(row, width),
        Column::Mode => mode(row),
        Column::Armed => armed(row),
        Column::State => landed(row),
        Column::Battery => battery(row.vehicle),
        Column::Gps => gps(row.vehicle, look),
        Column::Link => link(row),
        Column::Command => command(row, look, width),
        Column::Item => item(row.vehicle),
        Column::Next => way(row.vehicle),
        Column::End => end(row.vehicle),
        Column::Alert => alert(row, look, width),
        Column::Altitude
        | Column::Speed
        | Column::Climb
        | Column::Voltage
        | Column::Current
        | Column::Hdop
        | Column::Ekf => number(1),
        Column::Latitude | Column::Longitude => number(6),
        Column::Home
        | Column::ToGo
        | Column::Heading
        | Column::Used
        | Column::RoundTrip
        | Column::Vibration
        | Column::Sea => number(0),
    }
}

fn unknown() -> Cell {
    ("-".to_owned(), Role::Muted)
}

fn id(row: &Row<'_>) -> Cell {
    let badge = Badge::of_vehicle(row.vehicle.id);
    if row.vehicle.twin.is_some() {
        return (format!("{}!", row.vehicle.id), Role::Danger);
    }
    (row.vehicle.id.to_string(), badge.role)
}

/// The vehicle's teams, in the colour of the first.
fn teams(row: &Row<'_>) -> Cell {
    let session = row.state.session();
    let names = session.groups_of(row.vehicle.id);
    let first = names.first().and_then(|first| {
        let mut all = session.groups().keys();
        all.position(|name| name == first)
    });
    let role = first.map_or(Role::Muted, |place| Badge::of_team(place).role);
    (names.join(" "), role)
}

/// The pilot's name, shortened so that it differs from those of the others.
fn pilot(row: &Row<'_>, room: usize) -> Cell {
    let pilots = row.state.session().pilots();
    let Some(pilot) = pilots.of(row.vehicle.id) else {
        return (row.words.own.clone(), Role::Text);
    };
    let all: Vec<String> = pilots.names().into_iter().map(str::to_owned).collect();
    let place = all.iter().position(|it| it == pilot.name());
    let mut shown = told_apart(&all, room);
    let name = place.map(|at| shown.swap_remove(at));
    (name.unwrap_or_default(), Role::Warning)
}

/// Whether another person flies the vehicle, and the user has chosen columns without the pilot.
fn is_pilot_hidden(row: &Row<'_>) -> bool {
    let chosen = &row.state.config().table.columns;
    let is_other = || row.state.session().pilots().of(row.vehicle.id).is_some();
    !chosen.is_empty() && !chosen.contains(&Column::Pilot) && is_other()
}

fn mode(row: &Row<'_>) -> Cell {
    let vehicle = row.vehicle;
    let Some(mode) = vehicle.short_mode_name() else {
        return unknown();
    };
    if vehicle.has_paused() {
        (format!("{mode} {PAUSED}"), Role::Warning)
    } else if vehicle.held.is_some() {
        (format!("{mode} RC"), Role::Danger)
    } else if is_pilot_hidden(row) {
        (format!("{mode} @"), Role::Warning)
    } else if let Some(station) = vehicle.barred_by() {
        (format!("{mode} @{station}"), Role::Warning)
    } else {
        (mode, Role::Text)
    }
}

fn armed(row: &Row<'_>) -> Cell {
    let (vehicle, words) = (row.vehicle, row.words);
    if vehicle.heartbeat.is_none() {
        unknown()
    } else if vehicle.armed() {
        (words.armed.clone(), Role::Armed)
    } else if has_crashed(row) {
        unknown()
    } else if vehicle.ready_to_arm() {
        (words.ready.clone(), Role::Ready)
    } else {
        (words.off.clone(), Role::Muted)
    }
}

/// Whether the vehicle has crashed, whatever its arming checks report.
fn has_crashed(row: &Row<'_>) -> bool {
    let mut alerts = row.state.session().alerts().of(row.vehicle.id);
    alerts.any(|one| one.alert.kind == AlertKind::Crash)
}

fn landed(row: &Row<'_>) -> Cell {
    let words = row.words;
    let text = match row.vehicle.landed {
        _ if row.vehicle.is_on_surface() => return on_surface(row),
        LandedState::Undefined => return unknown(),
        LandedState::OnGround => return (words.ground.clone(), Role::Muted),
        LandedState::InAir if row.vehicle.has_paused() => {
            return (words.paused.clone(), Role::Warning);
        }
        LandedState::InAir => &words.air,
        LandedState::Takeoff => &words.takeoff,
        LandedState::Landing => &words.landing,
    };
    (text.clone(), Role::Text)
}

/// Whether a rover or boat moves or stands.
fn on_surface(row: &Row<'_>) -> Cell {
    let (vehicle, words) = (row.vehicle, row.words);
    if vehicle.global.is_none() {
        unknown()
    } else if vehicle.moves() {
        (words.moving.clone(), Role::Text)
    } else {
        (words.still.clone(), Role::Muted)
    }
}

fn battery(vehicle: &Vehicle) -> Cell {
    let battery = vehicle.battery();
    let Some(left) = battery.and_then(|battery| battery.remaining_percent) else {
        let voltage = battery.and_then(|battery| battery.voltage_v);
        return voltage.map_or_else(unknown, |voltage| (figure(voltage, 1), Role::Text));
    };
    (format!("{left}%"), calm(battery_role(left)))
}

fn gps(vehicle: &Vehicle, look: &Look) -> Cell {
    let Some(gps) = vehicle.gps else {
        return unknown();
    };
    let role = if gps.fix < FixType::Fix3d {
        Role::Warning
    } else {
        Role::Text
    };
    let satellites = gps
        .satellites
        .map_or(String::new(), |count| format!(" {count}"));
    let fix = look.text(&gps.fix.text());
    (format!("{fix}{satellites}"), role)
}

fn link(row: &Row<'_>) -> Cell {
    let link = &row.vehicle.link;
    if link.lost {
        return (row.words.lost.clone(), Role::Danger);
    }
    (format!("{}%", link.percent()), calm(link_role(link)))
}

/// The role in a table, where only problems have a colour.
fn calm(role: Role) -> Role {
    if role == Role::Ok { Role::Text } else { role }
}

fn item(vehicle: &Vehicle) -> Cell {
    match vehicle.plan.total {
        Some(total) if total > 0 => (format!("{}/{total}", vehicle.plan.current), Role::Text),
        _ => unknown(),
    }
}

/// The distance and the time to the next place.
fn way(vehicle: &Vehicle) -> Cell {
    let way = vehicle.plan_leg().and_then(|leg| leg::way(&leg));
    way.map_or_else(unknown, |way| (way, Role::Text))
}

fn end(vehicle: &Vehicle) -> Cell {
    let end = vehicle.plan_leg().and_then(|leg| leg::end(&leg));
    end.map_or_else(unknown, |end| (end, Role::Text))
}

fn command(row: &Row<'_>, look: &Look, room: usize) -> Cell {
    let Some((entry, line)) = row.state.session().latest(row.vehicle.id) else {
        return (String::new(), Role::Muted);
    };
    let state = match line.state {
        RowState::Done if line.ended_by.is_some() => row.words.over.clone(),
        RowState::Done if !entry.watches_effects() => row.words.state(RowState::Accepted),
        RowState::Done => row.words.done.clone(),
        RowState::InProgress(percent) => format!("{percent} %"),
        RowState::Sent if line.tries > 1 => look.text(&text!("fly-try", count = line.tries)),
        other => row.words.state(other),
    };
    // The state must not be cut off.
    let left = room.saturating_sub(width(&state) + 1);
    let text = format!("{} {state}", clip(entry.verb.name, left));
    let role = match line.ended_by {
        Some(_) => Role::Muted,
        None => row_role(line.state),
    };
    (text, role)
}

/// The most serious alert and its duration; a serious one has a mark before it until it is
/// acknowledged.
fn alert(row: &Row<'_>, look: &Look, room: usize) -> Cell {
    let session = row.state.session();
    let Some(one) = session.alerts().worst(row.vehicle.id) else {
        return (String::new(), Role::Text);
    };
    let calm = session.alerts().is_calm(one);
    let is_serious = one.alert.severity <= Severity::Error;
    let mark = if is_serious && !calm { "! " } else { "" };
    let role = if calm {
        Role::Muted
    } else if is_serious {
        Role::Alert
    } else {
        severity_role(one.alert.severity)
    };
    let text = since(
        one,
        session.time(one.since),
        look,
        room.saturating_sub(mark.len()),
    );
    (format!("{mark}{text}"), role)
}

/// The text and the duration of an alert within a width; the duration is dropped before the text is cut.
pub fn since(one: &Standing, at: Duration, look: &Look, room: usize) -> String {
    let what = look.text(&one.alert.text);
    let clock = short_clock(at);
    let long = look.text(&text!("alert-since", what = &what, clock = &clock));
    if width(&long) <= room {
        return long;
    }
    let short = format!("{what} ({clock})");
    if width(&short) <= room {
        return short;
    }
    clip(&what, room)
}
