//! Objectives: the results that a trainee must reach. One file per kind.
//!
//! # How the parts fit
//! - What was seen: `coverage`, `checked`, `detect`, `locate`, `perimeter`, and for surveys `sample_cells` and
//!   `map_error`.
//! - How vehicles flew: `stops` and `route` (gates, places), `hover`, `formation`, `standoff`, `land_on`, `recover`
//!   (back on a pad, with enough battery), `arm_time` (armed soon after they were ready).
//! - What was brought, saved or cleared: `deliver`, `protect`, `clear`. What must not happen: `dose` (too much radiation), `link` (a
//!   weak link at work). What came before the flight: `plans`.
//! - `demands` is what an objective requires of its mission, for the check of the file.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::time::Duration;

use super::Point;
use super::contact::Contact;
use super::craft::Craft;
use super::format::{CountTarget, FileTable, KindOf, ObjectiveTarget, number};
use super::ground_truth::Release;
use super::planning::PlanLog;
use super::report::Mark;
use super::skill::Skill;
use super::survey::{Survey, SurveyPlan};
use super::world::World;
use crate::scoring::Product;
use crate::text::Text;
use crate::vehicle::VehicleId;
pub(crate) use demands::{DemandedEquipment, DemandedPlaces, DemandedTime, Demands, Equipment};
pub(crate) use route::GateRoute;

mod arm_time;
mod checked;
mod clear;
mod coverage;
mod deliver;
mod demands;
mod detect;
mod dose;
mod formation;
mod hover;
mod land_on;
mod link;
mod locate;
mod map_error;
mod perimeter;
mod plans;
mod protect;
mod recover;
mod route;
mod sample_cells;
mod standoff;
mod stops;

/// An objective of a mission.
#[derive(Debug)]
pub(crate) struct Objective {
    pub id: String,
    pub title: Text,
    /// Its share of the objectives' points, 0 to 1.
    pub value: f64,
    /// Whether the mission fails without the objective.
    pub mandatory: bool,
    pub kind: Box<dyn ObjectiveKind>,
}

/// A find that an objective requires.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sought {
    /// The hazard's index in the file.
    pub hazard: usize,
    /// The greatest distance of a correct report from the object, in metres.
    pub within_m: f64,
}

/// The condition for an attempt at an objective. Without an attempt, the trainee has not failed at it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Trying {
    Always,
    /// The trainee has reported a find.
    Report,
    /// Part of the objective was reached.
    Progress,
}

/// A square of ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GroundPatch {
    pub at: Point,
    /// Length of its sides, in metres.
    pub side_m: f64,
}

/// The behaviour of a kind of objective.
pub(crate) trait ObjectiveKind: Debug + Send + Sync {
    /// The skill that the objective demonstrates in a mission with this many vehicles; swarm skills
    /// need several.
    fn skill(&self, vehicles: usize) -> Option<Skill>;

    /// The conditions for an attempt at the objective.
    fn trying(&self) -> Trying {
        Trying::Progress
    }

    /// The survey that the objective needs, if any.
    fn survey(&self) -> Option<&SurveyPlan> {
        None
    }

    /// The find that the objective requires, if any.
    fn sought(&self) -> Option<Sought> {
        None
    }

    /// The objective's demands on the mission; none for kinds that any flight can meet.
    fn demands(&self) -> Demands<'_> {
        Demands::default()
    }

    /// The unit of the measured quantity; empty for counts and shares.
    fn measure_unit(&self) -> &'static str {
        ""
    }

    /// The names of the places that the objective's tracker adds.
    fn place_names(&self) -> Vec<String> {
        Vec::new()
    }

    /// Starts the tracker of a flight in a world.
    fn start(&self, world: &World) -> Box<dyn Tracker>;
}

/// Copies trackers whose type is not known; every tracker with a copy has it.
pub(crate) trait TrackerClone {
    fn boxed(&self) -> Box<dyn Tracker>;
}

impl<T: Tracker + Clone + 'static> TrackerClone for T {
    fn boxed(&self) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Tracker> {
    fn clone(&self) -> Self {
        (**self).boxed()
    }
}

/// Watches one objective during a flight.
pub(crate) trait Tracker: TrackerClone + Debug + Send + Sync {
    /// Advances by a [`TICK`](super::TICK), for kinds with a memory of their own.
    fn step(&mut self, _scene: &ObjectiveScene<'_>) {}

    /// The state of the objective.
    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding;

    /// Whether the objective can certainly not be met any more.
    fn is_out_of_reach(&self, _scene: &ObjectiveScene<'_>) -> bool {
        false
    }

    /// The state of the objective for people.
    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails;

    /// The ground that had to be searched and was not searched.
    fn gaps(&self) -> Vec<GroundPatch> {
        Vec::new()
    }

    /// The ground that had to be searched and was searched.
    fn swept(&self) -> Vec<GroundPatch> {
        Vec::new()
    }

    /// The ground on the trainee's map, for kinds that keep one.
    fn mapped(&self, _world: &World) -> Vec<GroundPatch> {
        Vec::new()
    }

    /// Places that the seed decides, by name, and the next one to go to.
    fn places(&self) -> Vec<(String, Point)> {
        Vec::new()
    }
}

/// The state of a flight that trackers see in one step.
pub(crate) struct ObjectiveScene<'a> {
    pub now: Duration,
    /// Whether the flight is over, or its time is up.
    pub over: bool,
    pub vehicles: &'a [Craft],
    pub surveys: &'a [Survey],
    pub world: &'a World,
    pub marks: &'a [Mark],
    /// The finds of the detectors.
    pub contacts: &'a [Contact],
    /// Each vehicle's link margin in dB; empty if the mission does not model the radio.
    pub margins_db: &'a BTreeMap<VehicleId, f64>,
    pub releases: &'a [Release],
    /// The commands about the plans on board.
    pub plans: &'a PlanLog,
}

impl<'a> ObjectiveScene<'a> {
    /// A scene before anything has happened.
    pub fn empty(world: &'a World) -> Self {
        Self {
            now: Duration::ZERO,
            over: false,
            vehicles: &[],
            surveys: &[],
            world,
            marks: &[],
            contacts: &[],
            margins_db: const { &BTreeMap::new() },
            releases: &[],
            plans: const { &PlanLog::NONE },
        }
    }

    /// The survey that belongs to an objective, by the objective's id.
    pub fn survey(&self, id: &str) -> Option<&Survey> {
        self.surveys.iter().find(|survey| survey.plan.id == id)
    }
}

/// The state of an objective in numbers, which every step of a flight needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ObjectiveStanding {
    /// The share of it that is reached, 0 to 1.
    pub fraction: f64,
    /// The measured quantity, which the conditions for gold and for events refer to.
    pub measure: f64,
    pub met: bool,
    /// Whether the flight can end as far as this objective is concerned.
    pub settled: bool,
    /// Whether it is about the landing, the last task of a flight.
    pub landing: bool,
}

/// The state of an objective for people. Made only when it is read: its texts cost more time than the rest of a step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ObjectiveDetails {
    /// The product, such as a map, for kinds that have one.
    pub product: Option<Product>,
    /// The result as text.
    pub result: Text,
    /// The missing part of the objective, during the flight; `None` if the result contains everything.
    pub outlook: Option<Text>,
    /// The target as text.
    pub target: Text,
    /// Advice on how to reach the objective.
    pub advice: Text,
}

/// The name of the next place to go to.
pub const NEXT_PLACE: &str = "next";

/// How long after the last report the reports become final, if all vehicles are on the ground.
const FINAL_AFTER: Duration = Duration::from_secs(20);

/// How long vehicles must be on the ground and disarmed before the flight counts as over.
pub(crate) const DOWN_FOR: Duration = Duration::from_secs(2);

impl ObjectiveTarget {
    /// The share of the points for a measure, 0 to 1.
    fn credit(self, measure: f64) -> f64 {
        partial_credit(measure, self.partial_from, self.met_at)
    }
}

impl CountTarget {
    /// The share of the points for a count, 0 to 1.
    fn credit(self, count: usize) -> f64 {
        partial_credit(count as f64, self.partial_from as f64, self.met_at as f64)
    }
}

impl FileTable<'_> {
    /// The radius within which a place counts as reached, by the key `radius`.
    fn need_radius(&mut self) -> Option<f64> {
        self.need(
            "radius",
            number(0.5, 1000.0, "m"),
            "maximum distance that counts",
        )
    }
}

/// `clamp((x - partial) / (target - partial), 0, 1)`; also works for targets below `partial`.
pub(crate) fn partial_credit(x: f64, partial: f64, target: f64) -> f64 {
    let span = target - partial;
    if span.abs() < 1e-12 {
        let reached = if span >= 0.0 {
            x >= target
        } else {
            x <= target
        };
        return f64::from(u8::from(reached));
    }
    ((x - partial) / span).clamp(0.0, 1.0)
}

/// All kinds, in the order in which they are listed.
pub(super) static KINDS: &[KindOf<Box<dyn ObjectiveKind>>] = &[
    sample_cells::KIND,
    map_error::KIND,
    recover::KIND,
    link::KIND,
    coverage::KIND,
    deliver::KIND,
    clear::KIND,
    detect::KIND,
    checked::KIND,
    standoff::KIND,
    arm_time::KIND,
    hover::KIND,
    stops::GATES,
    stops::VISIT,
    formation::KIND,
    land_on::KIND,
    locate::KIND,
    perimeter::KIND,
    protect::PROTECT,
    protect::CONTAIN,
    dose::KIND,
    plans::REHEARSED,
    plans::MENDED,
    plans::KEPT,
];

#[cfg(test)]
mod tests;
