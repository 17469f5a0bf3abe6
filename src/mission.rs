//! Missions: training tasks with a hazard world, virtual sensors and objectives.
//!
//! A mission is a TOML file; [`Mission::parse`] reads it and reports every fault in it. A [`Flight`] is one attempt at
//! it: it watches telemetry and the ledger in steps of [`TICK`], decides when the attempt is over, and writes the
//! [`Report`]. Everything is a function of the file, the seed, and the inputs of the flight.
//!
//! # The file
//! - `format` contains how a table is read and described: one function per table does both. The JSON schema
//!   ([`schema`]) and the reference in `docs/missions.md` ([`reference()`]) are generated from that description.
//! - `file` reads the sections separately, so that one fault does not hide the others. A section may refer to those
//!   that were read before it.
//! - Hazards and objectives have kinds. A kind is a separate file with a `read` function, and a line in the list
//!   `KINDS`.
//! - Points are `[east, north]` metres from the origin, as on a map; the grammar's `goto n .. e ..` names its axes.
//! - Cells are named like chess squares: `A1` is the south-west one, letters go east, numbers go north.
//!
//! # How the parts fit
//! - The file: `file` and `format` read it into `parts`; `check` finds missions that cannot be flown as intended,
//!   `needs` designs that do not suit, `fleet` and `fit` give drones their equipment, `board` their plans. `listing`,
//!   `campaign` and `skill` are what the home screen and the career read.
//! - The world, which trainees see only through sensors: `world`, `hazard`, `ground_truth`. What they see of it:
//!   `sensor`, `lookout` (when a detector finds an object), `contact`, `survey`. What they know: `weather`, `zone`,
//!   `area`, `pad`.
//! - The rules: `objective` (when each is met), `event` (what happens during the flight, closed areas, collisions,
//!   vehicles too close to each other: `event/airspace`), `radio` (how well a link carries), `together` (the least
//!   separation, and the sensor strip for manoeuvres), `stake` (what an exam forbids).
//! - A flight: `flight` runs it; `clock` is its time, `craft` a vehicle as it sees it, `saying` its texts; `usage`
//!   decides whether it has a task or needs attention; `planning` watches the commands about plans; `record` is what
//!   it takes to score the flight again.
//! - The trainee: `lesson`, `hint`, `feedback`, `report` (reported contacts), `progress` (the mission panel).

use std::collections::BTreeMap;
use std::time::Duration;

use crate::diagnostic::Diagnostic;
use crate::geo::LatLon;
use crate::scoring;
use crate::sim::{BootPace, Start, WorldConfig};
use crate::text::Text;

mod area;
mod board;
mod campaign;
mod check;
mod clock;
mod contact;
mod craft;
mod event;
mod feedback;
#[expect(
    clippy::unnecessary_wraps,
    reason = "readers of tables share one signature"
)]
mod file;
mod fit;
mod fleet;
mod flight;
mod format;
mod ground_truth;
mod hazard;
mod hint;
mod lesson;
mod listing;
mod lookout;
mod needs;
mod objective;
mod pad;
mod parts;
mod planning;
mod price;
mod progress;
mod radio;
pub mod record;
mod report;
mod saying;
mod sensor;
mod skill;
mod stake;
mod survey;
mod together;
mod usage;
mod weather;
mod world;
mod zone;

pub use crate::scoring::Report;
pub use area::{Area, AreaKind, KnownWire};
pub use campaign::{Outlay, Requires, Rewards, Unlock};
pub use clock::Clock;
pub use craft::SWING_M;
pub use event::alert::OpenAlert;
pub use event::demand::{Demand, WIND_FULL_FROM_M};
pub use event::mover::MoverKind;
pub use event::standard::threat_title;
pub use file::{reference, schema};
pub use fleet::dealt;
pub use flight::{Expected, Flight, Inject, InjectFault, Injected, Pledge, check_condition};
pub use hint::{Clue, Hint, Phase};
pub use lesson::{LessonStep, STEP_KEY};
pub use listing::{FitListing, Listing, ObjectiveListing};
pub use needs::{FitLine, Need};
pub use objective::NEXT_PLACE;
pub(crate) use objective::Trying;
pub use pad::is_pad;
pub use parts::{
    CareerTerms, FlightRules, MissionAdvice, MissionSeats, MissionSite, MissionSource,
    MissionSummary,
};
pub use progress::{
    Cell, ClueProgress, Ground, LoadLeft, MovingThing, ObjectiveProgress, ObjectiveState, Progress,
    Reading, ShownContact, ShownMark, Trust,
};
pub use skill::Skill;
pub use stake::Stake;

/// The step of missions and scoring.
pub const TICK: Duration = Duration::from_millis(100);

/// Whether an action with the interval `every` is due at `now`; both are multiples of the step.
pub(crate) fn is_due(now: Duration, every: Duration) -> bool {
    now.as_millis().is_multiple_of(every.as_millis())
}

/// The distance between the pads of an enlarged mission.
const ROW_SPACING_M: f64 = 6.0;

/// The placeholder in a hint for the name of the next cell to sample.
pub(crate) const NEXT_CELL: &str = "{next_cell}";

/// A mission that was read and checked.
#[derive(Debug)]
pub struct Mission {
    /// The id that files and results use.
    pub id: String,
    /// Its revision; results are comparable only within one revision.
    pub rev: u32,
    /// The title that is shown.
    pub title: Text,
    pub file: MissionSource,
    pub summary: MissionSummary,
    pub career: CareerTerms,
    pub rules: FlightRules,
    pub advice: MissionAdvice,
    /// Weights, medals and limits of the score.
    pub scoring: scoring::ScoreRules,
    pub site: MissionSite,
    pub seats: MissionSeats,
    /// The plans and the fence on board at the start.
    pub(crate) board: board::BoardSetup,
    pub(crate) objectives: Vec<objective::Objective>,
    pub(crate) events: Vec<event::Event>,
    /// Threats that an instructor may trigger, besides the mission's own.
    pub(crate) may_inject: Vec<event::standard::Standard>,
}

/// Metres east and north of the origin.
pub(crate) type Point = [f64; 2];

/// The position of the point `[0, 0]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Origin {
    pub at: LatLon,
    pub altitude_amsl_m: f64,
    pub heading_deg: f64,
}

impl Origin {
    /// The position of a point.
    pub fn place(&self, [east_m, north_m]: Point) -> LatLon {
        self.at.moved(north_m, east_m)
    }

    /// The point at a position.
    pub fn point(&self, place: LatLon) -> Point {
        let (north_m, east_m) = self.at.offset_to(place);
        [east_m, north_m]
    }
}

impl Mission {
    /// The ids of the objectives, each with the skill that it shows, if any, in file order.
    pub fn objective_skills(&self) -> impl Iterator<Item = (&str, Option<Skill>)> {
        let objectives = self.objectives.iter();
        objectives.map(|objective| {
            (
                objective.id.as_str(),
                objective.kind.skill(self.seats.count),
            )
        })
    }

    /// The condition for an attempt at an objective; `None` for an unknown id.
    pub(crate) fn trying(&self, objective: &str) -> Option<Trying> {
        let mut objectives = self.objectives.iter();
        let found = objectives.find(|it| it.id == objective);
        found.map(|it| it.kind.trying())
    }

    /// Whether an event of the mission can raise an alert that needs an answer.
    pub fn has_alerts(&self) -> bool {
        let is_question =
            |action: &event::Action| matches!(action, event::Action::Alert { ok: Some(_), .. });
        self.events
            .iter()
            .any(|event| event.actions.iter().any(is_question))
    }

    /// Reads a mission file.
    ///
    /// # Errors
    /// Every fault that was found, each with its position; at least one.
    pub fn parse(source: &str) -> Result<Self, Vec<Diagnostic>> {
        file::read(source)
    }

    /// The point from which places are counted in metres.
    pub fn origin(&self) -> LatLon {
        self.site.origin.at
    }

    /// The start positions, in the order of the vehicles' system ids.
    pub fn starts(&self) -> Vec<Start> {
        let pad = |&point: &Point| Start {
            at: self.site.origin.place(point),
            altitude_amsl_m: self.site.origin.altitude_amsl_m,
            heading_deg: self.site.origin.heading_deg,
        };
        self.seats.pads.iter().map(pad).collect()
    }

    /// The same mission with more vehicles than the file has, for measurements. The added pads are in a row south of
    /// the last one, and their vehicles carry the equipment of the last one.
    #[must_use]
    pub fn enlarged(mut self, vehicles: usize) -> Self {
        if let Some(&[east_m, north_m]) = self.seats.pads.last() {
            let more = vehicles.saturating_sub(self.seats.pads.len());
            let pad = |place| [east_m, north_m - ROW_SPACING_M * place as f64];
            self.seats.pads.extend((1..=more).map(pad));
            self.seats.count = self.seats.pads.len();
            for fits in [&mut self.seats.fits, &mut self.seats.asked] {
                let fit = fits.last().cloned().unwrap_or_default();
                fits.resize(self.seats.count, fit);
            }
            let kind = self.seats.kinds.last().copied().unwrap_or_default();
            self.seats.kinds.resize(self.seats.count, kind);
            self.seats.designs = self.designs().into_iter().flatten().cloned().collect();
        }
        self
    }

    /// Whether a parameter may be set in a flight that counts.
    pub fn lets_set(&self, parameter: &str) -> bool {
        let is_same = |open: &String| open.eq_ignore_ascii_case(parameter);
        self.rules.open_parameters.iter().any(is_same)
    }

    /// The simulator's world for the mission: its vehicles on their pads.
    pub fn world(&self, seed: u64) -> WorldConfig {
        WorldConfig {
            starts: self.starts(),
            airframes: self.airframes(),
            kinds: self.vehicle_kinds(),
            seed,
            obstacles: Vec::new(),
            // As with real ones, time begins when the vehicles are ready.
            boot: BootPace::Over,
        }
    }

    /// The places that a line may name: those of the file, the cells (`A1`), `pad` for the first
    /// pad, and `pad1`, `pad2` and so on for each.
    pub fn places(&self) -> BTreeMap<String, LatLon> {
        let named = self.site.places.iter();
        let mut places: BTreeMap<String, LatLon> = named
            .map(|(name, at)| (name.clone(), self.site.origin.place(*at)))
            .collect();
        for (index, &at) in self.seats.pads.iter().enumerate() {
            let place = self.site.origin.place(at);
            places.entry(pad::STEM.to_owned()).or_insert(place);
            places.insert(pad::pad_name(index + 1), place);
        }
        for survey in self
            .objectives
            .iter()
            .filter_map(|objective| objective.kind.survey())
        {
            for cell in &survey.cells {
                places
                    .entry(cell.name.clone())
                    .or_insert(self.site.origin.place(cell.centre));
            }
        }
        places
    }
}

#[cfg(test)]
pub(crate) mod fake;
#[cfg(test)]
mod tests;
