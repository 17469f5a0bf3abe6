//! Objectives: what a trainee has to reach. One file per kind.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::time::Duration;

use super::Point;
use super::craft::Craft;
use super::format::{CountTarget, FileTable, KindOf, ObjectiveTarget, number};
use super::ground_truth::Release;
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
    /// Its share of the objectives' points.
    pub value: f64,
    /// Whether the mission fails without it.
    pub mandatory: bool,
    pub kind: Box<dyn ObjectiveKind>,
}

/// What is to be reported.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sought {
    /// The hazard's place in the file.
    pub hazard: usize,
    /// How near a report must be.
    pub within_m: f64,
}

/// What shows that a flight tried an objective; who never came to it has not failed at it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Trying {
    /// Every flight tries it.
    Always,
    /// Once the trainee has reported a find.
    Report,
    /// Some of it was reached.
    Progress,
}

/// A square of ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GroundPatch {
    pub at: Point,
    /// Length of its sides, in metres.
    pub side_m: f64,
}

/// What an objective asks for.
pub(crate) trait ObjectiveKind: Debug + Send + Sync {
    /// The skill that it shows in a mission with so many vehicles: one alone is no swarm.
    fn skill(&self, vehicles: usize) -> Option<Skill>;

    /// How a flight shows that it was tried.
    fn trying(&self) -> Trying {
        Trying::Progress
    }

    /// The survey that it needs, if it needs one.
    fn survey(&self) -> Option<&SurveyPlan> {
        None
    }

    /// What it wants to be reported, if anything.
    fn sought(&self) -> Option<Sought> {
        None
    }

    /// What it demands of the mission; nothing for kinds that any flight can meet.
    fn demands(&self) -> Demands<'_> {
        Demands::default()
    }

    /// What the places are called that its tracker will know.
    fn place_names(&self) -> Vec<String> {
        Vec::new()
    }

    /// Starts to watch a flight in a world.
    fn start(&self, world: &World) -> Box<dyn Tracker>;
}

/// Watches one objective during a flight.
pub(crate) trait Tracker: Debug + Send + Sync {
    /// Lets a [`TICK`](super::TICK) pass, for kinds that remember more than the scene shows.
    fn step(&mut self, _scene: &ObjectiveScene<'_>) {}

    /// How the objective stands.
    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding;

    /// Where a look was needed and never made.
    fn gaps(&self) -> Vec<GroundPatch> {
        Vec::new()
    }

    /// Where it asked for a look and there was one.
    fn swept(&self) -> Vec<GroundPatch> {
        Vec::new()
    }

    /// What the trainee's map of the ground shows, for kinds that keep one.
    fn mapped(&self, _world: &World) -> Vec<GroundPatch> {
        Vec::new()
    }

    /// Places that the seed decides, by name, and what is next of them.
    fn places(&self) -> Vec<(String, Point)> {
        Vec::new()
    }
}

/// What trackers see of a flight in one step.
pub(crate) struct ObjectiveScene<'a> {
    /// How much mission time has passed.
    pub now: Duration,
    /// Whether the flight is over, or its time is up.
    pub over: bool,
    pub vehicles: &'a [Craft],
    pub surveys: &'a [Survey],
    pub world: &'a World,
    pub marks: &'a [Mark],
    /// How well vehicles are heard, in dB; empty where radio does not matter.
    pub margins_db: &'a BTreeMap<VehicleId, f64>,
    /// What was let go of.
    pub releases: &'a [Release],
}

impl<'a> ObjectiveScene<'a> {
    /// What is visible before the first visit.
    pub fn empty(world: &'a World) -> Self {
        Self {
            now: Duration::ZERO,
            over: false,
            vehicles: &[],
            surveys: &[],
            world,
            marks: &[],
            margins_db: const { &BTreeMap::new() },
            releases: &[],
        }
    }

    /// The survey that an objective asked for.
    pub fn survey(&self, id: &str) -> Option<&Survey> {
        self.surveys.iter().find(|survey| survey.plan.id == id)
    }
}

/// How an objective stands.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ObjectiveStanding {
    /// How far it is reached, 0 to 1.
    pub fraction: f64,
    /// The measured quantity, for gates.
    pub measure: f64,
    pub met: bool,
    /// Whether the flight need not go on for its sake.
    pub settled: bool,
    /// Whether it is about coming home, the last thing of a flight.
    pub landing: bool,
    /// For kinds that make one.
    pub product: Option<Product>,
    /// The result in words.
    pub result: Text,
    /// What it still needs, while it is flown for; `None` where the result says all.
    pub outlook: Option<Text>,
    /// The target in words.
    pub target: Text,
    /// What would reach it, in words.
    pub advice: Text,
}

/// What the place to go to next is called.
pub const NEXT_PLACE: &str = "next";

/// How long vehicles must stand still on the ground before the flight counts as over.
pub(crate) const DOWN_FOR: Duration = Duration::from_secs(2);

impl ObjectiveTarget {
    /// How much of it a measure is worth, 0 to 1.
    fn credit(self, measure: f64) -> f64 {
        partial_credit(measure, self.partial_from, self.met_at)
    }
}

impl CountTarget {
    /// How much of it a count is worth, 0 to 1.
    fn credit(self, count: usize) -> f64 {
        partial_credit(count as f64, self.partial_from as f64, self.met_at as f64)
    }
}

impl FileTable<'_> {
    /// How near to a place counts, by the key `radius`.
    fn need_radius(&mut self) -> Option<f64> {
        self.need(
            "radius",
            number(0.5, 1000.0, "m"),
            "greatest distance that counts",
        )
    }
}

/// `clamp((x - partial) / (target - partial), 0, 1)`; works for targets below the partial mark too.
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
    detect::KIND,
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
];

#[cfg(test)]
mod tests;
