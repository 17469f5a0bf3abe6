//! The state of vehicles as lines, on demand.

use crate::app::State;
use crate::geo::maths;
use crate::language::VehicleChoice;
use crate::text::{Text, figure, text};
use crate::vehicle::Vehicle;
use crate::vehicle_id::ranges;

/// The state of vehicles: the chosen ones, otherwise the targets of a command, otherwise all.
pub(super) fn status(state: &State, choice: Option<&VehicleChoice>) -> Vec<Text> {
    let vehicles = state.session().vehicles();
    let chosen = match choice {
        Some(choice) => state.chosen(choice),
        None if state.session().selection().is_empty() => state.chosen(&VehicleChoice::All),
        None => Ok(state.addressed()),
    };
    let ids = match chosen {
        Ok(ids) => ids,
        Err(fault) => return vec![fault],
    };
    let known: Vec<Text> = ids
        .iter()
        .filter_map(|id| vehicles.get(id))
        .map(|vehicle| vehicle_text(vehicle, state))
        .collect();
    if known.is_empty() {
        return vec![text!("select-missing", vehicles = ranges(ids))];
    }
    known
}

fn vehicle_text(vehicle: &Vehicle, state: &State) -> Text {
    let mut parts: Vec<Text> = Vec::new();
    if let Some(heartbeat) = vehicle.heartbeat {
        parts.push(vehicle.name_of(heartbeat.mode).into());
        let armed = if heartbeat.armed {
            text!("plain-armed")
        } else {
            text!("plain-disarmed")
        };
        parts.push(armed);
    }
    if let Some(at) = vehicle.global {
        let height = format!("{:.1}", at.altitude_m);
        let speed = format!("{:.1}", maths::hypot_f32(at.north_m_s, at.east_m_s));
        parts.push(text!("plain-flight", height = height, speed = speed));
        if let Some(home) = vehicle.home {
            let far = format!("{:.0}", home.at_point.distance_m(at.at_point));
            parts.push(text!("plain-home", distance = far));
        }
    }
    if let Some(left) = vehicle
        .battery()
        .and_then(|battery| battery.remaining_percent)
    {
        parts.push(text!("plain-battery", percent = left));
    }
    if let Some(way_home) = vehicle.way_home() {
        let needed = figure(way_home.needed_percent.ceil(), 0);
        parts.push(text!("plain-way-home", needed = needed));
    }
    if let Some(alert) = state.session().alert(vehicle, state.now()) {
        parts.push(alert.text);
    }
    text!(
        "plain-vehicle",
        vehicle = vehicle.id.to_string(),
        state = Text::joined(", ", parts)
    )
}
