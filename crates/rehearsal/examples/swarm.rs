//! Measures how long a rehearsal takes: 32 vehicles that fly for about ten minutes, side by side.
//!
//! `cargo run --release -p sortie-rehearsal --example swarm`

use std::error::Error;
use std::time::Instant;

use sortie_geo::LatLon;
use sortie_plan::{Document, Home, Item, command};
use sortie_rehearsal::{Conditions, Participant, rehearse};

const VEHICLES: u32 = 32;
const SPACING_M: f64 = 20.0;

fn item(command: u16, at: LatLon, z: f32) -> Item {
    let (x, y) = at.to_e7();
    Item {
        command,
        frame: 3,
        auto_continue: true,
        x,
        y,
        z,
        ..Item::default()
    }
}

/// A vehicle that flies north along a line, back again, and home.
fn participant(number: u32) -> Participant {
    let start = LatLon::new(50.4501, 30.5234).moved(0.0, SPACING_M * f64::from(number));
    let (x, y) = start.to_e7();
    let mut plan = vec![item(command::TAKEOFF, start, 20.0)];
    for leg in 0..12 {
        let north_m = if leg % 2 == 0 { 400.0 } else { 20.0 };
        plan.push(item(command::WAYPOINT, start.moved(north_m, 0.0), 20.0));
    }
    plan.push(item(command::RETURN_TO_LAUNCH, start, 0.0));
    Participant {
        document: Document {
            home: Some(Home { x, y, z: 170.0 }),
            plan,
            ..Document::default()
        },
        airframe: None,
        charge_percent: None,
        delay_s: 0.0,
        parameters: Vec::new(),
        fence_switch: None,
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let swarm: Vec<Participant> = (0..VEHICLES).map(participant).collect();
    let begun = Instant::now();
    let outcome = rehearse(&swarm, &Conditions::default())?;
    let taken = begun.elapsed();
    let conflicts = outcome.conflicts().count();
    println!(
        "{VEHICLES} vehicles, {:.0} s of flight, {conflicts} conflicts: {:.2} s",
        outcome.simulated_s,
        taken.as_secs_f64()
    );
    Ok(())
}
