//! The state of a vehicle, the most important rows first.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Span;

use super::VehicleSubject;
use super::row::{LABEL, UNKNOWN, arrow, labelled, number};
use super::tape::shown_deg;
use crate::alert::AlertKind;
use crate::app::state::History;
use crate::geo::LatLon;
use crate::text;
use crate::text::figure;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::gauge::battery_role;
use crate::ui::widget::{clock, put, severity_role, wrap};
use crate::vehicle::{Battery, LandedState, Vehicle};

/// The distance below which no direction to a point is shown, in metres.
const HERE_M: f64 = 1.0;
/// The label of the alert, and the maximum number of its rows.
const WARNING: &str = "vehicle-ready";
const WARNING_ROWS: usize = 2;

/// A row: the id of its label, its value, and the role of the value.
type Entry = (&'static str, String, Role);

/// Draws as many rows as fit.
pub(super) fn draw(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let look = subject.look;
    let inner = Panel::new(look, area).titled(&look.say("vehicle-state"), buffer);
    let width = usize::from(inner.width).saturating_sub(LABEL);
    let mode = labelled(look, &look.say("vehicle-mode"), mode(subject.vehicle, look));
    put(buffer, inner, 0, &mode);
    let mut row = 1;
    for (id, value, role) in entries(subject) {
        let label = look.say(id);
        // Only the alert can be long; it has no columns.
        let parts = if id == WARNING {
            wrap(&value, width)
        } else {
            vec![value]
        };
        for (at, part) in parts.into_iter().take(WARNING_ROWS).enumerate() {
            let label = if at == 0 { label.as_str() } else { "" };
            let value = vec![Span::styled(part, look.style(role))];
            put(buffer, inner, row, &labelled(look, label, value));
            row += 1;
        }
    }
}

fn entries(subject: &VehicleSubject<'_>) -> Vec<Entry> {
    let (vehicle, look) = (subject.vehicle, subject.look);
    let mut entries = vec![ready(subject)];
    entries.extend(control(vehicle, look));
    let held = vehicle.held.map(|held| held.text());
    entries.extend(held.map(|held| ("vehicle-held", held, Role::Danger)));
    entries.extend([
        ("vehicle-altitude", altitude(vehicle, look), Role::Text),
        ("vehicle-speed", speed(vehicle, look), Role::Text),
        ("vehicle-battery", battery(vehicle), charge_role(vehicle)),
        ("vehicle-home", home(vehicle, look), Role::Text),
        ("vehicle-target", target(vehicle, look), Role::Text),
        flight(subject),
        link(subject),
        ("vehicle-wind", wind(vehicle, look), Role::Text),
        ("vehicle-ground", metres(vehicle.rangefinder_m), Role::Text),
        ("vehicle-place-of", place(vehicle), Role::Text),
        ("vehicle-load", load(vehicle), Role::Text),
        ("vehicle-firmware", firmware(vehicle), Role::Text),
        board(vehicle, look),
    ]);
    entries
}

/// The mode, whether the vehicle is armed, and whether it flies.
fn mode(vehicle: &Vehicle, look: &Look) -> Vec<Span<'static>> {
    let span = |text: String, role| Span::styled(text, look.style(role));
    let Some(heartbeat) = vehicle.heartbeat else {
        return vec![span(look.say("vehicle-no-heartbeat"), Role::Warning)];
    };
    let (armed, armed_role) = if heartbeat.armed {
        ("vehicle-armed", Role::Armed)
    } else {
        ("vehicle-disarmed", Role::Muted)
    };
    let landed = match vehicle.landed {
        LandedState::Undefined => String::new(),
        LandedState::OnGround => look.say("vehicle-on-ground"),
        LandedState::InAir if vehicle.has_paused() => look.say("vehicle-paused"),
        LandedState::InAir => look.say("vehicle-in-air"),
        LandedState::Takeoff => look.say("vehicle-taking-off"),
        LandedState::Landing => look.say("vehicle-landing"),
    };
    let intended = vehicle.mode_not_reached().map(|mode| {
        let text = text!("vehicle-mode-set", mode = vehicle.name_of(mode));
        format!(" {}", look.text(&text))
    });
    let role = if vehicle.has_paused() {
        Role::Warning
    } else {
        Role::Accent
    };
    let mode = vehicle.name_of(heartbeat.mode);
    vec![
        span(format!("{mode}{} ", intended.unwrap_or_default()), role),
        span(look.say(armed), armed_role),
        span(format!(" {landed}"), role),
    ]
}

/// The alert, or whether the vehicle can be armed.
fn ready(subject: &VehicleSubject<'_>) -> Entry {
    let (vehicle, look) = (subject.vehicle, subject.look);
    if let Some(alert) = subject.state.session().alert(vehicle, subject.state.now()) {
        // If the alert is about arming, it lists all reasons.
        let text = if alert.kind == AlertKind::Prearm && !vehicle.prearm.is_empty() {
            vehicle.prearm.join("; ")
        } else {
            look.text(&alert.text)
        };
        return (WARNING, text, severity_role(alert.severity));
    }
    if vehicle.armed() {
        (WARNING, look.say("vehicle-fine"), Role::Ok)
    } else if vehicle.ready_to_arm() {
        (WARNING, look.say("vehicle-ready-to-arm"), Role::Ready)
    } else {
        (WARNING, look.say("vehicle-not-ready"), Role::Warning)
    }
}

/// The ground station in control, if the vehicle announces it.
fn control(vehicle: &Vehicle, look: &Look) -> Option<Entry> {
    let control = vehicle.control?;
    let (text, role) = match control.owner {
        None => (text!("vehicle-control-free"), Role::Text),
        Some(_) if vehicle.is_controlled_here() => (text!("vehicle-control-here"), Role::Ok),
        Some(owner) => (
            text!("vehicle-control-station", station = owner),
            Role::Warning,
        ),
    };
    let mut value = look.text(&text);
    if control.takeover {
        let open = look.say("vehicle-control-open");
        value = format!("{value}, {open}");
    }
    Some(("vehicle-control", value, role))
}

fn altitude(vehicle: &Vehicle, look: &Look) -> String {
    vehicle.global.map_or(UNKNOWN.to_owned(), |global| {
        let text = text!(
            "vehicle-heights",
            altitude = number(Some(global.altitude_m as f32), 1),
            sea = number(Some(global.altitude_amsl_m as f32), 0)
        );
        look.text(&text)
    })
}

fn speed(vehicle: &Vehicle, look: &Look) -> String {
    let ground = number(vehicle.ground_speed_m_s(), 1);
    let air = number(vehicle.hud.map(|hud| hud.airspeed_m_s), 1);
    look.text(&text!("vehicle-speeds", ground = ground, air = air))
}

/// The role of the lowest charge, as in the table: a good one needs no colour.
fn charge_role(vehicle: &Vehicle) -> Role {
    let charges = vehicle
        .batteries
        .iter()
        .filter_map(|pack| pack.remaining_percent);
    match charges.min().map(battery_role) {
        Some(role @ (Role::Warning | Role::Danger)) => role,
        _ => Role::Text,
    }
}

fn battery(vehicle: &Vehicle) -> String {
    if vehicle.batteries.is_empty() {
        return UNKNOWN.to_owned();
    }
    let packs = vehicle.batteries.iter().map(pack);
    packs.collect::<Vec<_>>().join(" | ")
}

fn pack(pack: &Battery) -> String {
    let parts = [
        pack.remaining_percent.map(|left| format!("{left} %")),
        pack.voltage_v
            .map(|volts| format!("{} V", number(Some(volts), 1))),
        pack.current_a
            .map(|amps| format!("{} A", number(Some(amps), 1))),
        pack.consumed_mah
            .map(|mah| format!("{} mAh", number(Some(mah), 0))),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" ")
}

/// Distance and bearing to a point, with an arrow relative to the vehicle's heading.
fn way(vehicle: &Vehicle, to: LatLon, look: &Look) -> Option<String> {
    let here = vehicle.global?.at_point;
    let distance_m = here.distance_m(to);
    if !distance_m.is_finite() {
        return None;
    }
    if distance_m < HERE_M {
        return Some(look.say("vehicle-here"));
    }
    let bearing_deg = here.bearing_deg(to);
    let shown = shown_deg(bearing_deg as f32);
    let heading_deg = vehicle.heading_deg().map(f64::from);
    let arrow = heading_deg.map_or(String::new(), |heading_deg| {
        format!("{} ", arrow(bearing_deg - heading_deg, look.symbols))
    });
    Some(format!("{arrow}{} m  {shown}°", figure(distance_m, 0)))
}

fn home(vehicle: &Vehicle, look: &Look) -> String {
    vehicle
        .home
        .and_then(|home| way(vehicle, home.at_point, look))
        .unwrap_or_else(|| UNKNOWN.to_owned())
}

fn target(vehicle: &Vehicle, look: &Look) -> String {
    let Some(target) = vehicle.target else {
        return UNKNOWN.to_owned();
    };
    let way = target.at_point.and_then(|to| way(vehicle, to, look));
    let height = target.altitude_m.map(|altitude_m| {
        let altitude = number(Some(altitude_m as f32), 0);
        look.text(&text!("vehicle-target-height", altitude = altitude))
    });
    let velocity = target.velocity_m_s.map(|[north, east, down]| {
        let [north, east, up] = [north, east, -down].map(|part| number(Some(part), 1));
        look.text(&text!(
            "vehicle-target-velocity",
            north = north,
            east = east,
            up = up
        ))
    });
    // ArduPilot reports a target place or a target speed; if there is a place, the speed is not a target.
    let aimed_at = velocity.filter(|_| way.is_none());
    let parts: Vec<String> = [way, height, aimed_at].into_iter().flatten().collect();
    if parts.is_empty() {
        UNKNOWN.to_owned()
    } else {
        parts.join("  ")
    }
}

/// How long the vehicle has been armed, or was armed in its last flight.
fn flight(subject: &VehicleSubject<'_>) -> Entry {
    let history = subject.state.session().histories().of(subject.vehicle.id);
    let time = history.map(History::armed_for).filter(|it| !it.is_zero());
    match time.map(clock) {
        Some(time) if !subject.vehicle.armed() => {
            let text = text!("vehicle-flight-last", time = time);
            (
                "vehicle-flight-before",
                subject.look.text(&text),
                Role::Text,
            )
        }
        time => {
            let time = time.unwrap_or_else(|| UNKNOWN.to_owned());
            ("vehicle-flight", time, Role::Text)
        }
    }
}

fn link(subject: &VehicleSubject<'_>) -> Entry {
    const ID: &str = "vehicle-link";
    let (link, look) = (&subject.vehicle.link, subject.look);
    if link.lost {
        let silent = subject
            .state
            .now()
            .saturating_sub(link.last_heard.unwrap_or_default());
        let text = text!("vehicle-link-lost", seconds = silent.as_secs());
        return (ID, look.text(&text), Role::Danger);
    }
    if link.received == 0 {
        return (ID, UNKNOWN.to_owned(), Role::Muted);
    }
    let trip = link.round_trip.map_or(UNKNOWN.to_owned(), |trip| {
        format!("{} ms", trip.as_millis())
    });
    let text = text!(
        "vehicle-link-good",
        percent = u32::from(link.percent()),
        trip = trip
    );
    (ID, look.text(&text), Role::Text)
}

fn wind(vehicle: &Vehicle, look: &Look) -> String {
    vehicle.wind.map_or(UNKNOWN.to_owned(), |wind| {
        // An autopilot without a wind estimate reports a speed of 0 and the direction north.
        if wind.speed_m_s == 0.0 && wind.from_deg == 0.0 {
            return look.say("vehicle-wind-unknown");
        }
        let text = text!(
            "vehicle-wind-from",
            speed = number(Some(wind.speed_m_s), 1),
            from = shown_deg(wind.from_deg)
        );
        look.text(&text)
    })
}

fn metres(value_m: Option<f32>) -> String {
    match number(value_m, 1) {
        unknown if unknown == UNKNOWN => unknown,
        known => format!("{known} m"),
    }
}

fn place(vehicle: &Vehicle) -> String {
    let point = vehicle.global.map(|global| global.at_point);
    point.map_or(UNKNOWN.to_owned(), |point| {
        format!("{:.6} {:.6}", point.lat_deg, point.lon_deg)
    })
}

fn load(vehicle: &Vehicle) -> String {
    let load = vehicle.health.map(|health| health.load_percent);
    match number(load, 0) {
        unknown if unknown == UNKNOWN => unknown,
        known => format!("{known} %"),
    }
}

fn firmware(vehicle: &Vehicle) -> String {
    match vehicle.firmware_name() {
        unknown if unknown.is_empty() => UNKNOWN.to_owned(),
        known => known,
    }
}

/// The id of the autopilot's board, and whether another vehicle with the same number is heard.
fn board(vehicle: &Vehicle, look: &Look) -> Entry {
    let board = vehicle.version.and_then(|version| version.board);
    let board = board.map_or_else(|| UNKNOWN.to_owned(), |board| board.to_string());
    if vehicle.twin.is_none() {
        return ("vehicle-board", board, Role::Text);
    }
    let twin = look.text(&text!("vehicle-board-twin", system = vehicle.system));
    ("vehicle-board", format!("{board} {twin}"), Role::Danger)
}
