//! One try at a mission.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::contact::Contacts;
use super::craft::Craft;
use super::event::engine::Engine;
use super::feedback::Feedback;
use super::ground_truth::Release;
use super::lookout::Lookout;
use super::objective::{Scene, Standing, Tracker};
use super::record::Recorder;
use super::report::Marks;
use super::survey::Survey;
use super::usage::Usage;
use super::world::World;
use super::{Mission, Point, TICK};
use crate::ledger::{EntryId, Ledger};
use crate::notice::Notice;
use crate::scoring::{
    CommandEvent, CommandLog, EventKind, EventReport, Report, SafetyKind, SafetyLog, SwarmTimes,
    rounded,
};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;
use crate::vehicle::{VehicleId, Vehicles};

mod clues;
mod deeds;
mod loads;
mod pause;
mod places;
mod pledge;
mod recording;
mod result;
mod swarm;
mod threats;
mod truth;
mod verdict;
mod view;
mod watch;

pub use deeds::Pledge;
pub use threats::Inject;
pub use verdict::Outcome;

/// A running mission: a pure function of the mission, the seed and what it was shown.
#[derive(Debug)]
pub struct Flight {
    mission: Arc<Mission>,
    seed: u64,
    world: World,
    trackers: Vec<Box<dyn Tracker>>,
    surveys: Vec<Survey>,
    crafts: Vec<Craft>,
    lookout: Lookout,
    /// What each craft has on board.
    holds: Vec<loads::Hold>,
    /// Everything that was let go of.
    releases: Vec<Release>,
    contacts: Contacts,
    marks: Marks,
    pledge: Pledge,
    /// The most that each vehicle's first sensor has shown, and where.
    peaks: BTreeMap<VehicleId, (f64, Point)>,
    commands: CommandLog,
    /// The state of the ledger that the commands are counted from.
    counted: Option<u64>,
    pub(super) safety: SafetyLog,
    met: Vec<bool>,
    events: Vec<EventReport>,
    elapsed: Duration,
    ended: Option<Outcome>,
    pub(super) engine: Engine,
    /// Whether an event has ended the mission as failed.
    failed: bool,
    tally: crate::scoring::CommandTally,
    /// Which try of this trainee's it is, from 1.
    attempt: u32,
    /// The clues that were asked for, and when.
    clues_given: Vec<(Duration, usize)>,
    /// What each craft did with its time, in the order of the crafts.
    usage: Vec<Usage>,
    recorder: Option<Box<Recorder>>,
    feedback: Feedback,
    /// Where each craft has been, in the order of the crafts.
    tracks: Vec<Vec<Point>>,
    swarm: SwarmTimes,
    /// The newest command to vehicles and for whom it was.
    ordered: Option<(EntryId, Vec<VehicleId>)>,
}

impl Flight {
    /// A try at a mission; the seed decides what the mission leaves to chance.
    pub fn new(mission: Arc<Mission>, seed: u64) -> Self {
        let world = World::new(&mission, seed);
        let surveys = mission
            .objectives
            .iter()
            .filter_map(|o| o.kind.survey())
            .map(Survey::new);
        Self {
            seed,
            trackers: mission
                .objectives
                .iter()
                .map(|o| o.kind.start(&world))
                .collect(),
            surveys: surveys.collect(),
            crafts: Vec::new(),
            lookout: Lookout::new(seed),
            holds: Vec::new(),
            releases: Vec::new(),
            contacts: Contacts::default(),
            marks: Marks::default(),
            pledge: Pledge::default(),
            peaks: BTreeMap::new(),
            commands: CommandLog::default(),
            counted: None,
            safety: SafetyLog::default(),
            met: vec![false; mission.objectives.len()],
            events: Vec::new(),
            elapsed: Duration::ZERO,
            ended: None,
            engine: Engine::new(&mission, seed),
            failed: false,
            tally: crate::scoring::CommandTally::default(),
            attempt: 1,
            clues_given: Vec::new(),
            usage: Vec::new(),
            recorder: None,
            feedback: Feedback::default(),
            tracks: Vec::new(),
            swarm: SwarmTimes::default(),
            ordered: None,
            world,
            mission,
        }
    }

    /// Says which try of the trainee's it is, from 1, before it begins: on the first one, hints are free.
    pub fn set_attempt(&mut self, attempt: u32) {
        self.attempt = attempt.max(1);
    }

    /// One [`TICK`]. `now` is mission time, 0 at the start. Returns what a human should hear, on mission time.
    /// Every entry of the ledger counts. After the end nothing changes any more.
    pub fn step(&mut self, now: Duration, vehicles: &Vehicles, ledger: &Ledger) -> Vec<Notice> {
        if self.ended.is_some() {
            return Vec::new();
        }
        if let Some(recorder) = &mut self.recorder {
            recorder.step(now, vehicles, ledger);
        }
        let previous = std::mem::replace(&mut self.elapsed, now.min(self.mission.time_limit));
        let mut notices = Vec::new();
        self.enlist(vehicles);
        self.world.step(self.elapsed);
        self.step_crafts(vehicles, &mut notices);
        self.step_loads(&mut notices);
        self.note_peaks();
        self.watch(&mut notices);
        self.step_commands(vehicles, ledger, &mut notices);
        self.step_usage(ledger);
        self.note_tracks();
        self.step_surveys(&mut notices);
        let standings = self.step_objectives(&mut notices);
        self.step_threats(vehicles, &standings, &mut notices);
        self.warn_of_time(previous, &mut notices);
        self.decide(now, &standings, &mut notices);
        self.feedback.hear(&notices, self.elapsed);
        notices
    }

    /// A vehicle is no more, by no fault of the trainee's: its simulator has ended. Returns what a human should hear.
    pub fn lose(&mut self, id: VehicleId, vehicles: &Vehicles) -> Vec<Notice> {
        if let Some(recorder) = &mut self.recorder {
            recorder.lose(id, vehicles);
        }
        let mut notices = Vec::new();
        self.enlist(vehicles);
        let craft = self.crafts.iter_mut().find(|craft| craft.id == id);
        if let Some(craft) = craft.filter(|craft| !craft.lost && self.ended.is_none()) {
            craft.lost = true;
            let text = text!("mission-vehicle-gone");
            self.say(
                EventKind::Alert,
                Some(id),
                Severity::Critical,
                text,
                &mut notices,
            );
        }
        notices
    }

    /// Gives up.
    pub fn abandon(&mut self) {
        if self.ended.is_none() {
            if let Some(recorder) = &mut self.recorder {
                recorder.abandon();
            }
            self.end(Outcome::Abandoned, &mut Vec::new());
        }
    }

    /// How it ended; `None` while it goes on.
    pub fn outcome(&self) -> Option<Outcome> {
        self.ended
    }

    /// The mission that is flown.
    pub fn mission(&self) -> &Arc<Mission> {
        &self.mission
    }

    /// The result with every point explained; of an unfinished flight, as if it ended now.
    pub fn report(&self, ledger: &Ledger) -> Report {
        result::report(self, ledger)
    }

    /// The vehicles that are heard take part, as many as the mission wants, in the order of their system ids. A seat
    /// is for ever: whoever steps the mission waits until all are heard, or a late one with a low id sits last.
    fn enlist(&mut self, vehicles: &Vehicles) {
        for &id in vehicles.keys() {
            if self.crafts.len() >= self.mission.vehicles {
                return;
            }
            if self.crafts.iter().all(|craft| craft.id != id) {
                let fit = &self.mission.fits[self.crafts.len()];
                self.holds.push(loads::Hold::new(fit));
                self.crafts.push(Craft::new(id, &fit.sensors, self.seed));
                self.usage.push(Usage::new(id));
            }
        }
    }

    fn step_crafts(&mut self, vehicles: &Vehicles, notices: &mut Vec<Notice>) {
        let mission = Arc::clone(&self.mission);
        let mut breaches = Vec::new();
        for craft in &mut self.crafts {
            let Some(vehicle) = vehicles.get(&craft.id) else {
                continue;
            };
            breaches.extend(
                craft
                    .step(vehicle, &mission, self.engine.active())
                    .into_iter()
                    .map(|breach| (craft.id, breach)),
            );
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
                let shown = probe.shown;
                probe.shown = self.engine.shown(craft.id, index, shown, self.elapsed);
            }
        }
        for (id, (kind, text)) in breaches {
            self.break_rule(kind, id, &text, notices);
        }
    }

    fn break_rule(
        &mut self,
        kind: SafetyKind,
        id: VehicleId,
        text: &Text,
        notices: &mut Vec<Notice>,
    ) {
        if self.safety.note(kind, id, self.elapsed, text) {
            let severity = if kind.is_loss() {
                Severity::Critical
            } else {
                Severity::Warning
            };
            self.say(EventKind::Rule, Some(id), severity, text.clone(), notices);
        }
    }

    fn step_commands(&mut self, vehicles: &Vehicles, ledger: &Ledger, notices: &mut Vec<Notice>) {
        // Rows change seldom, and there are thousands of them late in a swarm's mission.
        if self.counted.replace(ledger.revision()) == Some(ledger.revision()) {
            return;
        }
        for event in self.commands.step(self.elapsed, vehicles, ledger) {
            match event {
                // The fleet tells the operator about refusals; here they only go on record.
                CommandEvent::Rejected { vehicle, text } => {
                    self.record(EventKind::Rejected, Some(vehicle), text);
                }
                CommandEvent::Forced { vehicle } => {
                    self.break_rule(
                        SafetyKind::ForcedArm,
                        vehicle,
                        &text!("mission-checks-bypassed"),
                        notices,
                    );
                }
            }
        }
        self.tally = self.commands.tally(ledger);
    }

    fn step_surveys(&mut self, notices: &mut Vec<Notice>) {
        let mut sampled = Vec::new();
        for survey in &mut self.surveys {
            for craft in self
                .crafts
                .iter()
                .filter(|craft| craft.heard && craft.airborne && !craft.lost)
            {
                let probe = craft
                    .probes
                    .iter()
                    .find(|probe| *probe.sensor == *survey.plan.sensor);
                let (Some(at), Some(probe)) = (craft.at, probe) else {
                    continue;
                };
                if let Some(cell) = survey.step(at, craft.height_m, craft.speed_m_s, probe.shown) {
                    let (name, count) = (&survey.plan.cells[cell].name, survey.sampled());
                    let all = survey.plan.cells.len();
                    let text = text!(
                        "mission-cell-sampled",
                        cell = name,
                        count = count,
                        all = all
                    );
                    sampled.push((craft.id, text));
                }
            }
        }
        for (id, text) in sampled {
            notices.push(Notice {
                at: self.elapsed,
                vehicle: Some(id),
                severity: Severity::Info,
                kind: None,
                text,
            });
        }
    }

    fn step_objectives(&mut self, notices: &mut Vec<Notice>) -> Vec<Standing> {
        let mission = Arc::clone(&self.mission);
        let mut trackers = std::mem::take(&mut self.trackers);
        for tracker in &mut trackers {
            tracker.step(&self.scene());
        }
        self.trackers = trackers;
        let standings = self.standings();
        for (index, (objective, standing)) in mission.objectives.iter().zip(&standings).enumerate()
        {
            if standing.met != self.met[index] {
                self.met[index] = standing.met;
                let (title, result) = (&objective.title, &standing.result);
                let text = if standing.met {
                    text!("mission-objective-met", objective = title, result = result)
                } else {
                    text!("mission-objective-open", objective = title, result = result)
                };
                self.say(EventKind::Objective, None, Severity::Notice, text, notices);
            }
        }
        standings
    }

    fn say(
        &mut self,
        kind: EventKind,
        vehicle: Option<VehicleId>,
        severity: Severity,
        text: Text,
        notices: &mut Vec<Notice>,
    ) {
        notices.push(Notice {
            at: self.elapsed,
            vehicle,
            severity,
            kind: None,
            text: text.clone(),
        });
        self.record(kind, vehicle, text);
    }

    fn record(&mut self, kind: EventKind, vehicle: Option<VehicleId>, text: Text) {
        self.events.push(EventReport {
            at_s: rounded(self.elapsed.as_secs_f64(), 1),
            kind,
            vehicle,
            text,
        });
    }

    fn scene(&self) -> Scene<'_> {
        Scene {
            now: self.elapsed,
            over: self.ended.is_some() || self.elapsed >= self.mission.time_limit,
            vehicles: &self.crafts,
            surveys: &self.surveys,
            world: &self.world,
            marks: self.marks.all(),
            margins_db: self.engine.margins_db(),
            releases: &self.releases,
        }
    }

    fn standings(&self) -> Vec<Standing> {
        let scene = self.scene();
        self.trackers
            .iter()
            .map(|tracker| tracker.standing(&scene))
            .collect()
    }
}

#[cfg(test)]
mod tests;
