//! Vehicles that fly their plans: in the table, on the map, and in the room of one vehicle.

use std::sync::Arc;
use std::time::Duration;

use sortie::app::event::TerminalEvent;
use sortie::app::room::map::{SketchKind, sketches};
use sortie::config::Symbols;
use sortie::plan::Item;
use sortie::text::Language;
use sortie::vehicle::{
    LegSpeed, Plan, PlanPhase, PlanProgress, Stored, Target, Transfer, Vehicle, VehicleClass,
};

use super::{check, map};
use crate::fixtures;
use crate::harness::Console;

/// A plan of this many legs of 60 m, which ends in a return.
fn plan(legs: usize) -> Plan {
    let item = |command: u16, north_m: f64, east_m: f64| {
        let (x, y) = fixtures::HOME.moved(north_m, east_m).to_e7();
        Item {
            command,
            frame: 3,
            auto_continue: true,
            params: [0.0; 4],
            x,
            y,
            z: 20.0,
        }
    };
    let corners = (0..legs).map(|at| {
        let along_m = 60.0 * (at / 2 + 1) as f64;
        item(16, along_m, if at % 4 < 2 { -40.0 } else { 60.0 })
    });
    let begin = [item(16, 0.0, 0.0), item(22, 0.0, 0.0)];
    Plan {
        items: begin
            .into_iter()
            .chain(corners)
            .chain([item(20, 0.0, 0.0)])
            .collect(),
        home_first: true,
    }
}

/// A vehicle that flies its plan at 8 m/s.
pub fn flying(id: u16, north_m: f64, current: u16) -> Vehicle {
    let mut vehicle = fixtures::airborne(id, north_m, 20.0);
    if let Some(heartbeat) = &mut vehicle.heartbeat {
        heartbeat.mode = VehicleClass::Copter.mode("AUTO").expect("a mode");
    }
    vehicle.target = Some(Target {
        at_point: plan(10).items[usize::from(current)].place(),
        altitude_m: Some(20.0),
        velocity_m_s: None,
        at: Duration::ZERO,
    });
    vehicle.cruise = LegSpeed::after(None, 8.0, Duration::ZERO);
    vehicle.plans.plan = Stored {
        content: Some(Arc::new(plan(10))),
        transfer: Transfer::Done,
    };
    vehicle.plan = PlanProgress {
        current,
        total: Some(12),
        phase: Some(PlanPhase::Active),
        ..PlanProgress::default()
    };
    vehicle
}

/// Three vehicles on their plans, one of which pauses, and one on the ground.
fn swarm() -> Console {
    let mut console = Console::flying(0);
    let mut paused = flying(2, 150.0, 5);
    paused.plan.phase = Some(PlanPhase::Paused);
    for vehicle in [
        flying(1, 20.0, 2),
        paused,
        flying(3, 290.0, 10),
        fixtures::parked(4),
    ] {
        console.vehicle(vehicle);
    }
    console.at(5);
    console
}

#[test]
fn the_table_shows_item_way_and_times() {
    check("fly_plans", &swarm());
}

#[test]
fn the_map_shows_the_leg_that_is_flown() {
    let mut console = swarm();
    console.press("M");
    let (columns, rows) = (120, 40);
    console.hear(TerminalEvent::Resize { columns, rows });
    console.press("z");
    let size = (columns, rows);
    let text = map::drawn(&console, Symbols::Braille, Language::English, size);
    insta::assert_snapshot!("map_leg_120x40", text);
}

#[test]
fn the_room_of_a_vehicle_shows_the_leg_that_is_flown() {
    let mut console = swarm();
    console.press("V");
    check("vehicle_plan", &console);
}

#[test]
fn a_pause_is_shown_in_the_table_on_the_map_and_for_the_vehicle() {
    let mut console = swarm();
    let row = |screen: &str, id: &str| {
        let mut rows = screen.lines();
        rows.find(|row| row.contains(id))
            .unwrap_or_default()
            .to_owned()
    };
    let paused = row(&console.screen(80, 24), "  2 AUTO");
    assert!(
        paused.contains("AUTO ||") && paused.contains("5/12"),
        "{paused}"
    );
    let others = row(&console.screen(80, 24), "  1 AUTO");
    assert!(
        !others.contains("||") && others.contains("2/12"),
        "{others}"
    );
    assert!(row(&console.screen(200, 50), "▲  2").contains("paused"));
    console.press("j");
    assert!(console.screen(80, 24).contains("5/12: paused"));
    console.press("M");
    assert!(console.screen(120, 40).contains("w5/12 ||"));
    console.press("V");
    assert!(console.screen(80, 24).contains("AUTO ARMED paused"));
}

#[test]
fn plans_on_the_map_have_the_colours_and_signs_of_their_vehicles() {
    let mut console = swarm();
    console.press("*").press("M");
    let (columns, rows) = (120, 40);
    console.hear(TerminalEvent::Resize { columns, rows });
    console.press("z");
    let own = sketches(console.state()).into_iter();
    let own = own.filter(|it| it.kind == SketchKind::Plan && it.points.len() > 1);
    let vehicles: Vec<Option<u16>> = own.map(|it| it.vehicle).collect();
    assert_eq!(vehicles, [Some(1), Some(2), Some(3)]);
    let size = (columns, rows);
    let braille = map::drawn(&console, Symbols::Braille, Language::English, size);
    assert!(!braille.contains("■:w"), "colours tell them apart");
    let ascii = map::drawn(&console, Symbols::Ascii, Language::English, size);
    for sign in ["o:w", "^:w", "#:w"] {
        assert!(ascii.contains(sign), "{sign} in {ascii}");
    }
}
