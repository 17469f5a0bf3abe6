//! What a seat says of itself to the desk.

use std::time::Duration;

use super::{Activity, ClassRole, SeatPlace, State};
use crate::class::{
    ArmedInject, CapturedSituation, FlightReport, FlownTry, LastCommand, OfferedInject, SeatReport,
    Stage,
};
use crate::ledger::LedgerEntry;
use crate::mission::{ObjectiveState, Progress, Stake};
use crate::scoring::utilisation;
use crate::text::Locale;

impl<R> State<R> {
    /// The state of this seat, for the desk of its class.
    pub fn seat_report(&self, by_script: bool) -> SeatReport {
        let career = self.training.career.as_ref();
        let trainee = career.map(|career| career.name.as_str());
        let session = &self.session;
        let is_flown = session.activity.is_some() && self.replay.is_none();
        SeatReport {
            trainee: trainee.unwrap_or_default().into(),
            looks_on: self.class.seat().is_some_and(|it| it.seat.looks_on()),
            screen: Some(self.display.size().into()),
            flight: is_flown.then(|| FlightReport {
                by_script,
                ..self.flight_report()
            }),
        }
    }

    fn flight_report(&self) -> FlightReport {
        let session = &self.session;
        let progress = session.task.progress.as_ref();
        let objectives = progress.map_or(&[][..], |it| it.objectives.as_slice());
        let count = |state| objectives.iter().filter(|it| it.state == state).count() as u16;
        let is_exam = matches!(
            session.activity,
            Some(Activity::Mission {
                stake: Stake::Exam,
                ..
            })
        );
        let vehicles = session
            .vehicles
            .values()
            .filter(|it| session.expects(it.id));
        let airborne = vehicles.clone().filter(|it| it.airborne()).count() as u16;
        let oldest = session
            .alerts
            .open()
            .map(|(_, standing)| standing.since)
            .min();
        let place = self.class.seat();
        let own_commands = || session.ledger().judged_entries().rev();
        FlightReport {
            mission: session
                .task
                .listing
                .as_ref()
                .map(|it| it.id.as_str().into()),
            exam: is_exam,
            exam_try: place.and_then(SeatPlace::flown_try).map(|name| FlownTry {
                name: name.clone(),
                is_passed: place.is_some_and(|place| place.has_passed),
            }),
            stage: self.stage(),
            clock_s: seconds(session.time(self.now)),
            score: progress.and_then(|it| it.score_so_far),
            objectives_done: count(ObjectiveState::Met),
            objectives: objectives.len() as u16,
            objectives_open: count(ObjectiveState::Open),
            vehicles: vehicles.count() as u16,
            airborne,
            alerts: session.alerts.open().count() as u16,
            oldest_alert_s: oldest.map(|since| seconds(self.now.saturating_sub(since))),
            danger: place.and_then(|place| place.danger),
            failures: place.map_or(0, |place| place.failures),
            least_separation_m: place.and_then(|place| place.least_separation_m),
            workload_percent: Some(workload_percent(own_commands(), self.now)),
            last_command: own_commands().next().map(|entry| LastCommand {
                line: entry.line.as_str().into(),
                age_s: seconds(self.now.saturating_sub(entry.at)),
            }),
            by_script: false,
            injects: progress.map_or_else(Vec::new, |it| offered(it, self.locale())),
            armed: place.map_or_else(Vec::new, armed),
            situations: place.map_or_else(Vec::new, |place| {
                let captured = place.situations.iter().map(|it| CapturedSituation {
                    name: it.name.clone(),
                    is_named: it.is_named,
                    clock_s: seconds(it.at),
                });
                captured.collect()
            }),
            taken: place
                .and_then(SeatPlace::instructor)
                .map_or_else(Vec::new, |pilot| session.pilots.flown_by(&pilot)),
        }
    }

    fn stage(&self) -> Stage {
        let session = &self.session;
        if session.task.over {
            Stage::Over
        } else if self.holds_brief().is_some() {
            Stage::Held
        } else if session.is_starting() || session.is_reading() {
            Stage::Reading
        } else if session.is_paused() && self.class.is_frozen() {
            Stage::Frozen
        } else if session.is_paused() {
            Stage::Paused
        } else {
            Stage::Flying
        }
    }

    /// The console's part in a class.
    pub fn class_role(&self) -> &ClassRole {
        &self.class
    }
}

fn offered(progress: &Progress, locale: &Locale) -> Vec<OfferedInject> {
    let injects = progress.injects.iter().map(|inject| OfferedInject {
        name: inject.name.as_str().into(),
        title: locale.text(&inject.title).into(),
    });
    injects.collect()
}

fn armed(place: &SeatPlace) -> Vec<ArmedInject> {
    let armed = place.armed.iter().map(|order| ArmedInject {
        name: order.name.clone(),
        when: order.when.clone(),
    });
    armed.collect()
}

/// The share of the last minute in which the trainee was busy with commands, as the debrief counts it.
fn workload_percent<'a>(recent: impl Iterator<Item = &'a LedgerEntry>, now: Duration) -> u8 {
    let mut commands: Vec<Duration> = recent.take(200).map(|entry| entry.at).collect();
    commands.reverse();
    (utilisation(&commands, now) * 100.0).round() as u8
}

fn seconds(time: Duration) -> f64 {
    crate::text::rounded(time.as_secs_f64(), 1)
}
