//! The groups of fields that make up a mission.

use std::time::Duration;

use super::format::WrittenValue;
use super::hazard::Hazard;
use super::sensor::Sensor;
use super::zone::Zone;
use super::{Clue, Hint, LessonStep, Origin, Outlay, Point, Requires, Rewards};
use super::{fit, radio, weather};
use crate::crew::Post;
use crate::diagnostic::Diagnostic;
use crate::sim::VehicleKind;
use crate::text::Text;
use crate::workshop::Design;

/// The file that a mission was read from.
#[derive(Debug, Default)]
pub struct MissionSource {
    pub text: String,
    /// The parsed file with the position of every value.
    pub(super) written: WrittenValue,
    /// Texts that have no translation; not faults.
    pub untranslated: Vec<Diagnostic>,
}

/// The description of a mission for lists and its brief.
#[derive(Debug)]
pub struct MissionSummary {
    pub brief: Text,
    /// Difficulty, 0 (first steps) to 3.
    pub tier: u8,
    /// Its topics, for lists and searches.
    pub tags: Vec<String>,
    pub authors: Vec<String>,
    /// The id of the mission that it is a drill for, if it is a drill.
    pub drill_of: Option<String>,
}

/// The place of a mission in a career.
#[derive(Debug)]
pub struct CareerTerms {
    /// The requirements for the mission to be offered.
    pub requires: Requires,
    /// Credits, experience and unlocks for passing the mission.
    pub rewards: Rewards,
}

/// The rules of a flight: the limits for its vehicles, and whether the trainee may pause it, speed it up and set
/// protected parameters.
#[derive(Debug)]
pub struct FlightRules {
    pub time_limit: Duration,
    /// Whether pausing is allowed.
    pub pausable: bool,
    /// The maximum speed-up in flight.
    pub most_speedup: f64,
    /// Protected parameters that may be set in this mission.
    pub open_parameters: Vec<String>,
    pub(crate) max_height_m: f64,
    pub(crate) land_reserve_percent: f64,
    /// The minimum distance between vehicles in the air, in metres; `None` if the mission does not set it.
    pub(crate) separation_m: Option<f64>,
}

/// The advice to the trainee.
#[derive(Debug, Default)]
pub struct MissionAdvice {
    /// Whether the trainee can ask for hints; an exam gives none.
    pub gives_hints: bool,
    /// Advice by phase of the flight.
    pub hints: Vec<Hint>,
    /// Advice that the trainee can ask for, which may cost points.
    pub clues: Vec<Clue>,
    /// The steps of a guided lesson.
    pub lesson: Vec<LessonStep>,
}

/// The area of a mission and the hazards in it.
#[derive(Debug)]
pub struct MissionSite {
    pub(crate) origin: Origin,
    pub(crate) weather: weather::Weather,
    pub(crate) zones: Vec<Zone>,
    pub(crate) places: Vec<(String, Point)>,
    pub(crate) hazards: Vec<Box<dyn Hazard>>,
    /// The ids of the hazards in the file, in the same order.
    pub(crate) hazard_ids: Vec<String>,
    /// The radio model; `None` if the mission does not model the radio.
    pub(crate) radio: Option<radio::Radio>,
}

/// The vehicles of a mission: their pads, their equipment, and the drones built for them.
#[derive(Debug)]
pub struct MissionSeats {
    /// The number of vehicles.
    pub count: usize,
    /// The limit on the fleet's price, and the drones that the mission lends.
    pub outlay: Outlay,
    pub(crate) pads: Vec<Point>,
    /// Every sensor that some vehicle carries.
    pub(crate) sensors: Vec<&'static Sensor>,
    /// The equipment of each vehicle, in the order of the pads.
    pub(crate) fits: Vec<fit::Fit>,
    /// The equipment of the mission's own drones, which built drones must also provide.
    pub(crate) asked: Vec<fit::Fit>,
    /// The kind of each vehicle, in the order of the pads.
    pub(crate) kinds: Vec<VehicleKind>,
    /// The designs of the vehicles built for the mission, in the order of their pads; empty if the
    /// mission's own vehicles fly. Seats of a kind without a design have the mission's own vehicles.
    pub(crate) designs: Vec<Design>,
    /// The places of a crew that flies the mission; empty if it is meant for one person.
    pub crew: Vec<Post>,
}

impl MissionSeats {
    /// Whether the vehicles carry two kinds of detectors, so that one can confirm the finds of the other.
    pub(crate) fn can_confirm(&self) -> bool {
        let sensors = self.sensors.iter();
        sensors.filter(|sensor| sensor.detector().is_some()).count() > 1
    }
}
