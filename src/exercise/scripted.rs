//! A pilot script flown through a mission.

use std::sync::Arc;

use super::Exercise;
use crate::comparison::{ComparedFlight, FlightCourse};
use crate::diagnostic::Diagnostic;
use crate::language::{Context, Script};
use crate::mission::Mission;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// Reads a pilot script for a mission; only the mission's vehicles and places are valid.
///
/// # Errors
/// The faults of the script.
pub fn read_script(text: &str, mission: &Mission) -> Result<Script, Vec<Diagnostic>> {
    let vehicles: Vec<VehicleId> = (1..=mission.seats.count as VehicleId).collect();
    let (places, areas) = (mission.places_to_name(), mission.named_areas());
    let context = Context {
        places: Some(&places),
        areas: Some(&areas),
        vehicles: &vehicles,
        ..Context::default()
    };
    Script::parse(text, &context)
}

/// Flies a script in the embedded simulator, to be compared with another flight of the mission.
pub fn fly_compared(
    mission: Arc<Mission>,
    seed: u64,
    script: Script,
    name: Text,
) -> ComparedFlight {
    let mut exercise = Exercise::new(mission, seed, script, Vec::new());
    let mut course = FlightCourse::default();
    while !exercise.is_over() {
        exercise.step();
        if exercise.now() >= course.next() {
            course.note(exercise.vehicles(), exercise.flight());
        }
        drop(exercise.take_notices());
    }
    let report = exercise.close();
    course.finish(name, report, &exercise.flight().progress())
}
