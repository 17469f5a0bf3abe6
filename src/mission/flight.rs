//! One attempt at a mission.
//!
//! A [`Flight`] consists of parts that own their state and receive the rest as arguments; [`Flight::step`] runs them
//! in order.
//!
//! # How the parts fit
//! - What happens: `threats` (events), `injects` (the instructor's), `loads` (drops, kits, spray),
//!   `mines` (under ground robots), `search` (contacts and reports),
//!   `tracks`.
//! - What the trainee says: `deeds` (reports, prediction, goal), `clues` (hints on request, and what they cost).
//! - When it ends, and why: `verdict`. Which objectives are met: `goals`.
//! - What the score is made of: `result` collects the facts, `orders` the commands and their quality, `swarm` the use
//!   of the vehicles and the workload, `pledge` the prediction and the goal.
//! - What others see: `view` (the mission panel, and what scripts wait for), `places` (names for the grammar),
//!   `journal` (notices, broken rules), `truth` (the debrief's map), `recording`.

use std::sync::Arc;
use std::time::Duration;

use super::craft::Craft;
use super::event::demand::Demand;
use super::event::scope::Sight;
use super::objective::{ObjectiveScene, ObjectiveStanding};
use super::planning::PlanLog;
use super::record::Recorder;
use super::survey::Surveys;
use super::world::World;
use super::{Hint, Mission, Stake, TICK, lesson};
use crate::alert::AlertKind;
use crate::commands::{Command, Setup};
use crate::ledger::Ledger;
use crate::notice::Notice;
use crate::scoring::{EventKind, FlightOutcome, FlownBy, Report, VehicleUse};
use crate::text;
use crate::text::{Text, lasting};
use crate::vehicle::{Severity, VehicleId, Vehicles, Wind};

mod clues;
mod deeds;
mod expectation;
mod goals;
mod injects;
mod journal;
mod loads;
mod mines;
mod orders;
mod places;
mod pledge;
mod recording;
mod result;
mod search;
mod swarm;
mod threats;
mod tracks;
mod truth;
mod verdict;
mod view;

use clues::CluesGiven;
pub use deeds::Pledge;
pub use expectation::Expected;
use goals::Goals;
pub use injects::{Inject, InjectFault, Injected, check_condition};
use journal::{FlightJournal, JournalEntry};
use loads::{Loads, LoadsScene};
use orders::OrderCount;
use search::Search;
use swarm::SwarmAccount;
use threats::Threats;
use tracks::Tracks;

/// A running mission: a pure function of the mission, the seed and its inputs.
#[derive(Debug, Clone)]
pub struct Flight {
    mission: Arc<Mission>,
    seed: u64,
    /// Mission time of the last step, up to the limit.
    elapsed: Duration,
    outcome: FlightOutcome,
    world: World,
    crafts: Vec<Craft>,
    loads: Loads,
    search: Search,
    surveys: Surveys,
    tracks: Tracks,
    goals: Goals,
    orders: OrderCount,
    swarm: SwarmAccount,
    threats: Threats,
    plans: PlanLog,
    /// The demands on the vehicles before the flight, until they are taken.
    board: Vec<Demand>,
    clues: CluesGiven,
    lesson_step: Option<usize>,
    /// For each automatic hint, whether its goal is reached.
    reached_hints: Vec<bool>,
    pledge: Pledge,
    journal: FlightJournal,
    recorder: Option<Box<Recorder>>,
    flown_by: Option<FlownBy>,
    stake: Stake,
}

impl Flight {
    /// An attempt at a mission; the seed determines all random values.
    pub fn new(mission: Arc<Mission>, seed: u64) -> Self {
        let world = World::new(&mission, seed);
        let plans = mission.objectives.iter();
        Self {
            seed,
            elapsed: Duration::ZERO,
            outcome: FlightOutcome::Flying,
            crafts: Vec::new(),
            loads: Loads::default(),
            search: Search::new(seed),
            surveys: Surveys::of(plans.filter_map(|objective| objective.kind.survey())),
            tracks: Tracks::default(),
            goals: Goals::new(&mission.objectives, &world),
            orders: OrderCount::default(),
            swarm: SwarmAccount::default(),
            threats: Threats::new(&mission, seed),
            plans: PlanLog::default(),
            board: Vec::new(),
            clues: CluesGiven::default(),
            lesson_step: None,
            reached_hints: Vec::new(),
            pledge: Pledge::default(),
            journal: FlightJournal::default(),
            recorder: None,
            flown_by: None,
            stake: Stake::Practice,
            world,
            mission,
        }
    }

    /// Mission time of the last step, up to the limit.
    pub fn elapsed(&self) -> Duration {
        self.elapsed
    }

    /// Sets the purpose of the flight; the default is practice.
    pub fn set_stake(&mut self, stake: Stake) {
        self.stake = stake;
    }

    /// Why the mission refuses a command to a vehicle; `None` if it does not. In a flight that
    /// counts, it refuses all changes to the setup of vehicles, except for the parameters that the
    /// mission opens.
    pub fn refusal(&self, command: &Command) -> Option<Text> {
        if self.stake == Stake::Practice {
            return None;
        }
        match command.setup()? {
            Setup::Parameter(name) => (!self.mission.lets_set(name))
                .then(|| text!("refused-protected-parameter", parameter = name)),
            Setup::Home => Some(text!("refused-protected-home")),
            Setup::Limits => Some(text!("refused-protected-limits")),
            Setup::PlanItem(item) => Some(item.refusal()),
            Setup::Files => Some(text!("refused-protected-files")),
            Setup::Sticks => Some(text!("refused-protected-sticks")),
            Setup::Anything => Some(text!("refused-protected-raw")),
        }
    }

    /// Sets the source of the commands.
    pub fn set_flown_by(&mut self, flown_by: Option<FlownBy>) {
        self.flown_by = flown_by;
    }

    /// Sets the number of the trainee's attempt, from 1. Call it before the flight begins: on the
    /// first attempt, most hints are free.
    pub fn set_attempt(&mut self, attempt: u32) {
        self.clues.set_attempt(attempt);
    }

    /// Advances by one [`TICK`]. `now` is mission time, 0 at the start. Returns the notices, in
    /// mission time. All entries of the ledger are evaluated. After the end, nothing changes.
    pub fn step(&mut self, now: Duration, vehicles: &Vehicles, ledger: &Ledger) -> Vec<Notice> {
        if self.is_over() {
            return Vec::new();
        }
        if let Some(recorder) = &mut self.recorder {
            recorder.step(now, vehicles, ledger);
        }
        let previous = std::mem::replace(&mut self.elapsed, now.min(self.mission.rules.time_limit));
        self.journal.begin(self.elapsed);
        self.enlist(vehicles);
        self.world.step(self.elapsed);
        self.step_crafts(vehicles);
        self.step_mines();
        self.step_loads();
        self.tracks.step(&self.crafts);
        self.search
            .step(&self.crafts, &self.world, &mut self.journal);
        self.orders.step(vehicles, ledger, &mut self.journal);
        self.plans.step(ledger, self.elapsed);
        self.swarm
            .step(&self.crafts, &self.surveys, ledger, self.elapsed);
        self.surveys.step(&self.crafts, |vehicle, text| {
            self.journal.tell(vehicle, Severity::Info, text);
        });
        let standings = self.step_goals();
        self.step_threats(vehicles, &standings);
        self.warn_of_time(previous);
        self.decide(now, &standings);
        let notices = self.journal.end_step();
        self.inject_due();
        notices
    }

    /// Marks a vehicle as lost through no fault of the trainee: its simulator has ended. Returns the notices.
    pub fn lose(&mut self, id: VehicleId, vehicles: &Vehicles) -> Vec<Notice> {
        if let Some(recorder) = &mut self.recorder {
            recorder.lose(id, vehicles);
        }
        self.enlist(vehicles);
        let craft = self.crafts.iter_mut().find(|craft| craft.id == id);
        if let Some(craft) = craft.filter(|craft| !craft.lost && !self.outcome.is_over()) {
            craft.lost = true;
            let text = text!("mission-vehicle-gone");
            self.journal.say(JournalEntry {
                vehicle: Some(id),
                alert: Some(AlertKind::Process),
                ..JournalEntry::new(EventKind::Alert, Severity::Critical, text)
            });
        }
        self.journal.take()
    }

    pub fn abandon(&mut self) {
        if !self.is_over() {
            if let Some(recorder) = &mut self.recorder {
                recorder.abandon();
            }
            self.end(FlightOutcome::Abandoned);
            // The trainee who gives up needs no notice.
            self.journal.take();
        }
    }

    /// Ends the flight for the instructor, as it stands: what has been reached counts.
    pub fn stop(&mut self) {
        if !self.is_over() {
            if let Some(recorder) = &mut self.recorder {
                recorder.stop();
            }
            self.end(self.verdict(FlightOutcome::Stopped));
            // The desk's order is a notice already.
            self.journal.take();
        }
    }

    /// Records a pause; `lasted` is its length by the wall clock, during which mission time did not
    /// advance. Returns the notice, in mission time; `None` once the flight is over.
    pub fn note_pause(&mut self, lasted: Duration) -> Option<Notice> {
        if self.is_over() {
            return None;
        }
        if let Some(recorder) = &mut self.recorder {
            recorder.pause(lasted);
        }
        let text = text!("mission-paused", time = lasting(lasted));
        self.journal
            .say(JournalEntry::new(EventKind::Pause, Severity::Notice, text));
        self.journal.take().pop()
    }

    /// Turns a copy of the flight into one that continues in its place: it is practice, and not recorded. Returns the
    /// notice, in mission time.
    pub fn continue_from_situation(&mut self) -> Option<Notice> {
        self.recorder = None;
        self.stake = Stake::Practice;
        let text = text!("mission-recalled");
        self.journal
            .say(JournalEntry::new(EventKind::Pause, Severity::Notice, text));
        self.journal.take().pop()
    }

    /// Notes in the record that the flight continues from an earlier situation, in another flight: this one is practice.
    pub fn record_recall(&mut self) {
        if let Some(recorder) = &mut self.recorder {
            recorder.recall();
        }
    }

    pub fn outcome(&self) -> FlightOutcome {
        self.outcome
    }

    pub fn is_over(&self) -> bool {
        self.outcome.is_over()
    }

    /// The seed of all random values in the mission.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The mean wind at the start, as the brief gives it.
    pub fn wind(&self) -> Wind {
        let wind = self.mission.site.weather.wind;
        Wind {
            from_deg: wind.from_deg as f32,
            speed_m_s: wind.speed_m_s as f32,
        }
    }

    /// The mission that is flown.
    pub fn mission(&self) -> &Arc<Mission> {
        &self.mission
    }

    /// The result with every point explained; for an unfinished flight, as if it ended now.
    pub fn report(&self, ledger: &Ledger) -> Report {
        result::report(self, ledger)
    }

    /// Takes the changes to vehicles, simulators and links that the mission has demanded since the
    /// last call.
    pub fn take_demands(&mut self) -> Vec<Demand> {
        let mut demands = std::mem::take(&mut self.board);
        demands.extend(self.threats.take_demands());
        demands
    }

    /// Enlists the vehicles that are heard, as many as the mission has seats, in the order of their system ids. A seat
    /// is kept to the end: a vehicle first heard after the start takes the last free seat, whatever its id.
    fn enlist(&mut self, vehicles: &Vehicles) {
        for &id in vehicles.keys() {
            if self.crafts.len() >= self.mission.seats.count {
                return;
            }
            if self.crafts.iter().all(|craft| craft.id != id) {
                let fit = &self.mission.seats.fits[self.crafts.len()];
                self.loads.add(fit);
                let mut craft = Craft::new(id, &fit.sensors, self.seed);
                craft.has_flail = fit.flail;
                self.crafts.push(craft);
                self.swarm.add(id);
                let seat = self.crafts.len() - 1;
                let wants = self.mission.board_wants(seat, self.seed).into_iter();
                self.board
                    .extend(wants.map(|want| Demand { vehicle: id, want }));
            }
        }
    }

    fn step_crafts(&mut self, vehicles: &Vehicles) {
        let engine = self.threats.engine();
        for craft in &mut self.crafts {
            let Some(vehicle) = vehicles.get(&craft.id) else {
                continue;
            };
            for (kind, text) in craft.step(vehicle, &self.mission, engine.active()) {
                self.journal.break_rule(kind, craft.id, &text);
            }
            for (index, probe) in craft.probes.iter_mut().enumerate() {
                let (quantity, height_m) = (probe.spec.quantity, craft.height_m);
                let amount = craft.at.map_or(0.0, |at| {
                    if probe.looks_down() {
                        self.world.column(quantity, at, height_m)
                    } else {
                        self.world.amount(quantity, at, height_m)
                    }
                });
                probe.step(amount, craft.speed_m_s, TICK.as_secs_f64());
                probe.shown = engine.shown(craft.id, index, probe.shown, self.elapsed);
            }
        }
    }

    fn step_loads(&mut self) {
        self.loads.step(&mut LoadsScene {
            crafts: &self.crafts,
            world: &mut self.world,
            journal: &mut self.journal,
        });
    }

    fn step_goals(&mut self) -> Vec<ObjectiveStanding> {
        let mut goals = std::mem::take(&mut self.goals);
        let standings = goals.step(&self.scene());
        self.goals = goals;
        self.tell_goals(&standings);
        standings
    }

    fn step_threats(&mut self, vehicles: &Vehicles, standings: &[ObjectiveStanding]) {
        let sight = Sight {
            now: self.elapsed,
            crafts: &self.crafts,
            vehicles,
            standings,
            contacts: self.search.contacts(),
            marks: self.search.marks(),
            last_command: self.orders.last_given(),
            refused: self.orders.tally().rejected,
        };
        let weather = &mut self.world.weather;
        self.threats
            .step(&self.mission, weather, &sight, &mut self.journal);
        let lesson = &self.mission.advice.lesson;
        self.lesson_step = lesson::step_now(lesson, self.threats.engine(), weather, &sight);
        let scope = self.threats.engine.scope(weather, &sight);
        self.threats.injects.look(&scope);
        if let Some(expectation) = &mut self.threats.expectation {
            expectation.look(&scope);
        }
        let is_reached = |hint: &Hint| hint.until.as_ref().is_some_and(|it| it.holds(&scope));
        self.reached_hints = self.mission.advice.hints.iter().map(is_reached).collect();
    }

    /// Reports which objectives have been met, or are open again.
    fn tell_goals(&mut self, standings: &[ObjectiveStanding]) {
        let mut goals = std::mem::take(&mut self.goals);
        let changes = goals.changes(&self.mission.objectives, standings, &self.scene());
        self.goals = goals;
        for entry in changes {
            self.journal.say(entry);
        }
    }

    fn scene(&self) -> ObjectiveScene<'_> {
        ObjectiveScene {
            now: self.elapsed,
            over: self.is_over() || self.elapsed >= self.mission.rules.time_limit,
            vehicles: &self.crafts,
            surveys: self.surveys.all(),
            world: &self.world,
            contacts: self.search.contacts(),
            marks: self.search.marks(),
            margins_db: self.threats.engine().margins_db(),
            releases: self.loads.releases(),
            plans: &self.plans,
        }
    }

    fn vehicle_uses(&self) -> Vec<VehicleUse> {
        self.swarm.uses(self.mission.seats.count)
    }

    fn standings(&self) -> Vec<ObjectiveStanding> {
        self.goals.standings(&self.scene())
    }

    /// The state of the objectives if the flight ended now; correct reports count only then.
    fn final_standings(&self) -> Vec<ObjectiveStanding> {
        self.goals.standings(&self.final_scene())
    }

    fn final_scene(&self) -> ObjectiveScene<'_> {
        ObjectiveScene {
            over: true,
            ..self.scene()
        }
    }
}

#[cfg(test)]
mod tests;
