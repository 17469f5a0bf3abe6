//! The state of a flight for the mission panel.

use super::expectation::Expectation;
use super::{Craft, Flight, ObjectiveStanding, result};
use crate::language::Findings;
use crate::mission::event::alert::OpenAlert;
use crate::mission::event::mover::Mover;
use crate::mission::objective::{GroundPatch, Tracker};
use crate::mission::sensor::Probe;
use crate::mission::survey::Survey;
use crate::mission::{
    Area, Cell, Ground, LessonStep, MovingThing, NEXT_CELL, ObjectiveProgress, ObjectiveState,
    Phase, Progress, Reading, Stake,
};
use crate::scoring::{SafetyEvent, points_so_far, score};
use crate::text;
use crate::text::{Text, clock};
use crate::vehicle_id::{VehicleId, ranges};

impl Flight {
    /// The progress, for the mission panel.
    pub fn progress(&self) -> Progress {
        let standings = self.standings();
        Progress {
            title: self.mission.title.clone(),
            elapsed: self.elapsed,
            limit: self.mission.rules.time_limit,
            score_so_far: self.score_so_far(),
            objectives: self.objective_progress(&standings),
            readings: self.readings(),
            loads: self.loads.left(&self.crafts),
            findings: self.findings(),
            phase: self.phase(&standings),
            hint: self.hint(&standings),
            lesson: self.lesson(),
            feedback: self.journal.feedback().cloned(),
            clues: self.clue_progress(),
            pledge: self.pledge,
            ends_itself: !self.is_over() && self.ends_itself(&standings),
            can_pledge: self.before_launch().is_ok(),
            answered_question: self.swarm.answered_question(),
            swarm: self.swarm.figures(&self.crafts, self.elapsed),
            places: self.places(),
            can_confirm: self.mission.seats.can_confirm(),
            contacts: self.search.shown_contacts(&self.mission.site.origin),
            injects: self.injects(),
            injected: self.threats.injects.done().to_vec(),
            expected: self.threats.expectation.as_ref().map(Expectation::state),
            marks: self.search.shown_marks(&self.mission.site.origin),
            cells: self.cells(),
            mapped: self.mapped(),
            swept: self.swept(),
            areas: self.areas_now(),
            movers: self.moving_things(),
            alerts: self.open_alerts(),
            margins_db: self.threats.engine().margins_db().clone(),
        }
    }

    fn objective_progress(&self, standings: &[ObjectiveStanding]) -> Vec<ObjectiveProgress> {
        let scene = self.scene();
        let ends = self.goals.out_of_reach(&scene).into_iter();
        let details = self.goals.details(&scene).into_iter().zip(ends);
        let states = standings.iter().zip(details);
        let objectives = self.mission.objectives.iter().zip(states);
        objectives
            .map(
                |(objective, (standing, (details, is_out_of_reach)))| ObjectiveProgress {
                    title: objective.title.clone(),
                    state: if standing.met {
                        ObjectiveState::Met
                    } else if self.is_over() || is_out_of_reach {
                        ObjectiveState::Missed
                    } else {
                        ObjectiveState::Open
                    },
                    detail: match (details.outlook, self.is_over()) {
                        (Some(outlook), false) => outlook,
                        _ => details.result,
                    },
                    fraction: standing.fraction,
                },
            )
            .collect()
    }

    /// The sensors' findings so far, for waits in scripts.
    pub fn findings(&self) -> Findings {
        let reading = |craft: &Craft| Some((craft.id, craft.probes.first()?.shown));
        Findings {
            contacts: self.search.contacts().len(),
            readings: self.crafts.iter().filter_map(reading).collect(),
            alerts: self.threats.engine().alert_subjects().collect(),
        }
    }

    /// The points earned so far; `None` before the first takeoff, when points for unbroken rules would be confusing.
    fn score_so_far(&self) -> Option<u16> {
        let begun = self.is_over() || self.crafts.iter().any(|craft| craft.flown);
        let (rules, is_over) = (&self.mission.scoring, self.is_over());
        begun.then(|| match result::facts(self, &self.scene()) {
            facts if is_over => score(rules, &facts).points,
            facts => points_so_far(rules, &facts),
        })
    }

    fn readings(&self) -> Vec<Reading> {
        let of = |craft: &Craft| {
            let id = craft.id;
            let reading = move |probe: &Probe| Reading {
                vehicle: id,
                sensor: Text::new(probe.sensor.name, Vec::new()),
                value: probe.shown,
                unit: probe.spec.unit,
            };
            craft.probes.iter().map(reading).collect::<Vec<_>>()
        };
        self.crafts.iter().flat_map(of).collect()
    }

    fn lesson(&self) -> Option<LessonStep> {
        if self.grounding().is_some() || self.stake == Stake::Exam {
            return None;
        }
        let step = self.mission.advice.lesson.get(self.lesson_step?)?;
        (!self.is_over()).then(|| step.clone())
    }

    /// The advice for the moment: about the end of the flight if it is near, otherwise the first hint of the mission's
    /// file that applies; `None` in an exam.
    pub(super) fn hint(&self, standings: &[ObjectiveStanding]) -> Option<Text> {
        if self.is_over() || self.stake == Stake::Exam {
            return None;
        }
        let phase = self.phase(standings);
        let ending = self
            .on_the_ground(phase)
            .or_else(|| self.on_the_way_down(standings));
        ending.or_else(|| {
            let is_reached = |at: usize| self.reached_hints.get(at).copied().unwrap_or_default();
            let mut hints = self.mission.advice.hints.iter().enumerate();
            let (_, found) = hints.find(|(at, hint)| hint.phase == phase && !is_reached(*at))?;
            Some(self.filled(&found.text))
        })
    }

    /// The advice after a landing; `None` if the flight continues.
    fn on_the_ground(&self, phase: Phase) -> Option<Text> {
        let grounding = self.grounding().filter(|_| phase == Phase::Ground);
        if let Some(event) = grounding {
            let reason = event.text.clone();
            return Some(text!(
                "mission-grounded",
                vehicle = event.vehicle,
                reason = reason
            ));
        }
        if phase == Phase::Done && self.is_down_again() {
            let mut objectives = self.mission.objectives.iter();
            let takes_reports = objectives.any(|objective| objective.kind.sought().is_some());
            return Some(if takes_reports {
                text!("mission-landed")
            } else {
                text!("mission-landed-last")
            });
        }
        let waits = self.crafts.iter().find(|craft| craft.awaits_disarming());
        if let Some(craft) = waits {
            return Some(text!("mission-home-armed", vehicle = craft.id));
        }
        if self.has_touched_down() {
            return Some(text!("mission-touchdown"));
        }
        self.cannot_go_on().then(|| {
            let limit = clock(self.mission.rules.time_limit);
            text!("mission-landed-short", limit = limit)
        })
    }

    /// The advice while all vehicles in the air return or land; `None` otherwise.
    fn on_the_way_down(&self, standings: &[ObjectiveStanding]) -> Option<Text> {
        if !self.all_come_down() {
            return None;
        }
        let forced = self.crafts.iter().filter(|it| it.flies() && it.in_failsafe);
        let forced: Vec<VehicleId> = forced.map(|craft| craft.id).collect();
        let runs_short = |craft: &Craft| craft.flies() && craft.runs_short(&self.mission);
        let needs_nothing = self.settle_themselves(standings).iter().all(|it| *it);
        Some(if needs_nothing {
            text!("mission-returning")
        } else if !forced.is_empty() {
            text!(
                "mission-returning-failsafe",
                count = forced.len(),
                vehicles = ranges(forced)
            )
        } else if self.crafts.iter().any(runs_short) {
            text!("mission-returning-short")
        } else {
            text!("mission-returning-early")
        })
    }

    /// Whether all vehicles are down again, and no battery lasts for another flight.
    fn cannot_go_on(&self) -> bool {
        let mut left = self.crafts.iter().filter(|craft| !craft.lost);
        self.is_down_again() && left.all(|craft| craft.runs_short(&self.mission))
    }

    /// Whether a vehicle has flown and none is still in the air.
    pub(super) fn is_down_again(&self) -> bool {
        let is_down = |craft: &Craft| craft.lost || craft.is_down();
        self.crafts.iter().any(|craft| craft.flown) && self.crafts.iter().all(is_down)
    }

    /// Whether no vehicle is in the air any more, while the motors of a vehicle that has just
    /// landed on its own are still running.
    fn has_touched_down(&self) -> bool {
        let stops_soon = |craft: &Craft| craft.flown && craft.armed && craft.comes_down;
        self.crafts.iter().any(stops_soon) && !self.crafts.iter().any(|it| it.under_way)
    }

    /// Whether vehicles are in the air, and all of them are returning or landing on their own.
    fn all_come_down(&self) -> bool {
        let mut flying = self.crafts.iter().filter(|it| it.flies()).peekable();
        flying.peek().is_some() && flying.all(|craft| craft.comes_down)
    }

    /// The newest failsafe of a vehicle that is down, once no vehicle is armed or in the air.
    fn grounding(&self) -> Option<&SafetyEvent> {
        let is_active = |craft: &Craft| !craft.lost && (craft.armed || craft.under_way);
        if self.crafts.iter().any(is_active) {
            return None;
        }
        let mut events = self.journal.broken_rules().iter().rev();
        events.find(|event| {
            let mut crafts = self.crafts.iter();
            let is_down = crafts.any(|craft| craft.id == event.vehicle && craft.is_down());
            is_down && event.kind.is_failsafe()
        })
    }

    /// The phase of the flight, for hints.
    pub(super) fn phase(&self, standings: &[ObjectiveStanding]) -> Phase {
        let open = standings
            .iter()
            .any(|standing| !standing.landing && !standing.settled);
        // Landed with open reports, the trainee must wait until they are final.
        let waits = !self.search.marks().is_empty() && self.is_down_again();
        if !open || waits {
            Phase::Done
        } else if self.crafts.iter().any(|craft| craft.under_way) {
            Phase::Air
        } else if self.crafts.iter().any(|craft| craft.armed) {
            Phase::Armed
        } else {
            Phase::Ground
        }
    }

    /// A hint with the name of the first cell not yet sampled filled in, or `pad` once all are
    /// sampled.
    pub(super) fn filled(&self, text: &Text) -> Text {
        let next = |survey: &Survey| {
            let cells = survey.plan.cells.iter().enumerate();
            let mut open = cells.filter(|(index, _)| !survey.is_sampled(*index));
            open.next().map(|(_, cell)| cell.name.clone())
        };
        let next = self.surveys.all().iter().find_map(next);
        text.filled(NEXT_CELL, next.as_deref().unwrap_or("pad"))
    }

    fn mapped(&self) -> Vec<Ground> {
        let trackers = self.goals.trackers();
        let mapped = trackers.flat_map(|tracker| tracker.mapped(&self.world));
        mapped.map(|patch| self.ground(patch)).collect()
    }

    fn swept(&self) -> Vec<Ground> {
        let swept = self.goals.trackers().flat_map(Tracker::swept);
        swept.map(|patch| self.ground(patch)).collect()
    }

    fn ground(&self, patch: GroundPatch) -> Ground {
        Ground {
            centre: self.mission.site.origin.place(patch.at),
            side_m: patch.side_m,
        }
    }

    fn cells(&self) -> Vec<Cell> {
        let of = |survey: &Survey| {
            let cell = |index: usize| Cell {
                name: survey.plan.cells[index].name.clone(),
                centre: self
                    .mission
                    .site
                    .origin
                    .place(survey.plan.cells[index].centre),
                side_m: survey.plan.side_m,
                sampled: survey.is_sampled(index),
                value: survey.mean(index),
            };
            (0..survey.plan.cells.len()).map(cell).collect::<Vec<_>>()
        };
        self.surveys.all().iter().flat_map(of).collect()
    }

    fn areas_now(&self) -> Vec<Area> {
        let zones = self.threats.engine().zones_now();
        zones.map(|zone| self.mission.area(zone)).collect()
    }

    fn moving_things(&self) -> Vec<MovingThing> {
        let thing = |mover: &Mover| MovingThing {
            name: mover.id.clone(),
            kind: mover.kind,
            at: self.mission.site.origin.place(mover.at),
            height_m: mover.height_m,
            altitude_amsl_m: self.mission.site.origin.altitude_amsl_m + mover.height_m,
            velocity_m_s: mover.velocity_m_s,
            callsign: mover.callsign.clone(),
            keep_out_m: mover.keep_out_m,
        };
        self.threats.engine().movers().iter().map(thing).collect()
    }

    fn open_alerts(&self) -> Vec<OpenAlert> {
        if self.is_over() {
            return Vec::new();
        }
        self.threats.engine().waiting(self.elapsed)
    }
}
