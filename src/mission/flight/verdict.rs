//! The end of a flight, and its reasons.

use std::time::Duration;

use super::Flight;
use super::journal::JournalEntry;
use crate::mission::craft::Craft;
use crate::mission::objective::{DOWN_FOR, ObjectiveStanding};
use crate::scoring::{EventKind, FlightOutcome};
use crate::text;
use crate::vehicle::Severity;

const WARN_BEFORE_S: [u64; 2] = [60, 30];

impl Flight {
    pub(super) fn warn_of_time(&mut self, previous: Duration) {
        for seconds in WARN_BEFORE_S {
            let mark = self
                .mission
                .rules
                .time_limit
                .saturating_sub(Duration::from_secs(seconds));
            if previous < mark && mark <= self.elapsed {
                let text = text!("mission-time-left", seconds = seconds);
                self.journal
                    .say(JournalEntry::new(EventKind::Alert, Severity::Warning, text));
            }
        }
    }

    pub(super) fn decide(&mut self, now: Duration, standings: &[ObjectiveStanding]) {
        let settled = self.mandatory(standings).all(|it| it.settled);
        let down = |craft: &Craft| craft.lost || craft.down_for >= DOWN_FOR;
        let all_down = !self.crafts.is_empty() && self.crafts.iter().all(down);
        let all_lost = !self.crafts.is_empty() && self.crafts.iter().all(|craft| craft.lost);
        let mut broken = self.journal.broken_rules().iter();
        let harmed = broken.any(|event| event.kind.is_harm());
        if self.threats.have_failed_it() || harmed {
            self.end(FlightOutcome::Failed);
        } else if now >= self.mission.rules.time_limit {
            self.end(self.verdict(FlightOutcome::TimedOut));
        } else if all_lost || (settled && all_down) {
            self.end(self.verdict(FlightOutcome::Failed));
        }
    }

    /// Whether the flight ends without any further command: all vehicles are down, and every
    /// mandatory objective settles itself.
    pub(super) fn ends_itself(&self, standings: &[ObjectiveStanding]) -> bool {
        let settling = self.settle_themselves(standings).into_iter();
        let mut objectives = self.mission.objectives.iter().zip(settling);
        self.is_down_again()
            && objectives.all(|(objective, settles)| settles || !objective.mandatory)
    }

    /// For each objective, whether it needs no further command: it is settled, concerns the landing,
    /// or will be settled once the reports are final.
    pub(super) fn settle_themselves(&self, standings: &[ObjectiveStanding]) -> Vec<bool> {
        let in_the_end = self.final_standings();
        let has_reports = !self.search.marks().is_empty();
        let settles = |(now, later): (&ObjectiveStanding, &ObjectiveStanding)| {
            now.settled || now.landing || (has_reports && later.settled)
        };
        standings.iter().zip(&in_the_end).map(settles).collect()
    }

    fn mandatory<'a>(
        &'a self,
        standings: &'a [ObjectiveStanding],
    ) -> impl Iterator<Item = &'a ObjectiveStanding> {
        let all = standings.iter().zip(&self.mission.objectives);
        all.filter(|(_, objective)| objective.mandatory)
            .map(|(standing, _)| standing)
    }

    /// The outcome if the flight ends now: `otherwise` unless all mandatory objectives are met.
    pub(super) fn verdict(&self, otherwise: FlightOutcome) -> FlightOutcome {
        let standings = self.final_standings();
        if self.mandatory(&standings).all(|it| it.met) {
            FlightOutcome::Passed
        } else {
            otherwise
        }
    }

    pub(super) fn end(&mut self, outcome: FlightOutcome) {
        // The instructor who ends a flight leaves the trainee no time to land.
        let had_time = outcome != FlightOutcome::Stopped;
        for craft in self.crafts.iter().filter(|_| had_time) {
            for (kind, text) in craft.unlanded_breaches(&self.mission) {
                self.journal.break_rule(kind, craft.id, &text);
            }
        }
        self.outcome = outcome;
        self.tell_goals(&self.standings());
        let text = text!("mission-over", outcome = outcome.title());
        self.journal
            .say(JournalEntry::new(EventKind::Phase, Severity::Notice, text));
    }
}
