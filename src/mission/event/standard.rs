//! What an instructor can have happen in every mission that allows it, without an event in its file.

use std::time::Duration;

use super::Action;
use super::fault::{Fault, FaultKind, Victim};
use super::mover::{MoverKind, Spawn};
use super::weather::{Change, Element, Target};
use crate::mission::{Mission, Point};
use crate::scoring::AlertLevel;
use crate::text;
use crate::text::Text;

/// The names of all of them.
pub(in crate::mission) const NAMES: [&str; 9] = [
    "gust",
    "wind_shift",
    "gnss_jam",
    "link_loss",
    "motor_fail",
    "battery_cold",
    "battery_cell",
    "person",
    "aircraft",
];

/// How long what passes by itself lasts.
const WHILE: Duration = Duration::from_secs(20);
/// How far on either side of the place of work an aircraft comes and goes.
const APPROACH_M: f64 = 600.0;
/// The same for people.
const WALK_M: f64 = 40.0;

/// What it is called, for people.
pub(in crate::mission) fn title(name: &str) -> Option<Text> {
    Some(match name {
        "gust" => text!("threat-gust"),
        "wind_shift" => text!("threat-wind-shift"),
        "gnss_jam" => text!("threat-gnss-jam"),
        "link_loss" => text!("threat-link-loss"),
        "motor_fail" => text!("threat-motor-fail"),
        "battery_cold" => text!("threat-battery-cold"),
        "battery_cell" => text!("threat-battery-cell"),
        "person" => text!("threat-person"),
        "aircraft" => text!("threat-aircraft"),
        _ => return None,
    })
}

/// What it does.
pub(super) fn actions(name: &str, mission: &Mission) -> Vec<Action> {
    let Some(text) = title(name) else {
        return Vec::new();
    };
    let level = match name {
        "person" | "aircraft" | "motor_fail" => AlertLevel::Critical,
        _ => AlertLevel::Warning,
    };
    let told = Action::Alert {
        level,
        text,
        ok: None,
        within: level.usual_limit(),
    };
    let mut actions = vec![deed(name, mission)];
    // Of what breaks on board, the telemetry tells.
    if !matches!(actions[0], Action::Fault(_)) {
        actions.push(told);
    }
    actions
}

fn deed(name: &str, mission: &Mission) -> Action {
    let more_wind = |element, more, lasts| {
        Action::Weather(Change {
            element,
            to: Target::More(more),
            ramp: Duration::from_secs(4),
            lasts,
        })
    };
    let fault = |kind, to, lasts| {
        Action::Fault(Fault {
            kind,
            victim: Victim::Chance,
            to,
            lasts,
        })
    };
    match name {
        "gust" => more_wind(Element::WindSpeed, 7.0, Some(WHILE)),
        "wind_shift" => more_wind(Element::WindDirection, 60.0, None),
        "gnss_jam" => fault(FaultKind::Gps, 1.0, Some(WHILE)),
        "link_loss" => fault(FaultKind::Link, 1.0, Some(WHILE)),
        "motor_fail" => fault(FaultKind::Motor, 0.75, None),
        "battery_cold" => fault(FaultKind::Battery, 0.9, None),
        "battery_cell" => fault(FaultKind::Battery, 0.8, None),
        "person" => Action::Spawn(passer_by(mission)),
        _ => Action::Spawn(overflight(mission)),
    }
}

fn passer_by(mission: &Mission) -> Spawn {
    let [east, north] = place_of_work(mission);
    Spawn {
        id: "person".to_owned(),
        kind: MoverKind::Person,
        path: vec![[east - WALK_M, north], [east + WALK_M, north]],
        speed_m_s: 1.2,
        height_m: 0.0,
        keep_out_m: 15.0,
        jitter_m: 5.0,
    }
}

fn overflight(mission: &Mission) -> Spawn {
    let [east, north] = place_of_work(mission);
    Spawn {
        id: "aircraft".to_owned(),
        kind: MoverKind::Aircraft,
        path: vec![[east - APPROACH_M, north], [east + APPROACH_M, north]],
        speed_m_s: 30.0,
        height_m: 80.0,
        keep_out_m: 60.0,
        jitter_m: 20.0,
    }
}

/// The middle of the first zone with something to do in it, or the first pad.
fn place_of_work(mission: &Mission) -> Point {
    let mut tasks = mission.zones.iter();
    let task = tasks.find(|zone| zone.kind == crate::mission::zone::ZoneKind::Task);
    let middle = task.map(|zone| {
        let (low, high) = zone.shape.bounds();
        [
            f64::midpoint(low[0], high[0]),
            f64::midpoint(low[1], high[1]),
        ]
    });
    middle
        .or_else(|| mission.pads.first().copied())
        .unwrap_or_default()
}
