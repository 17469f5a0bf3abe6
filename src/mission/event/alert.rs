//! Alerts that must be answered by an action; no key acknowledges them.

use std::collections::BTreeSet;
use std::time::Duration;

use super::expression::Expression;
use crate::scoring::{AlertFact, AlertLevel};
use crate::text::Text;
use crate::vehicle::VehicleId;

/// All alerts of a flight.
#[derive(Debug, Clone, Default)]
pub(crate) struct Alerts {
    facts: Vec<AlertFact>,
    open: Vec<AlertQuestion>,
}

/// An alert without an answer.
#[derive(Debug, Clone)]
struct AlertQuestion {
    /// Its index among the facts.
    place: usize,
    /// The condition that answers the alert.
    ok: Expression,
    vehicle: Option<VehicleId>,
}

/// An alert that waits for its answer.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenAlert {
    pub text: Text,
    pub level: AlertLevel,
    /// How long an answer still earns full points; zero once it is late.
    pub remaining: Duration,
}

impl Alerts {
    /// Records an alert that must be answered; returns its index among the facts.
    pub fn raise(&mut self, fact: AlertFact, ok: Expression, vehicle: Option<VehicleId>) -> usize {
        let place = self.facts.len();
        self.open.push(AlertQuestion { place, ok, vehicle });
        self.facts.push(fact);
        place
    }

    /// The conditions that answer the open alerts, in the order of [`Self::answer`].
    pub fn conditions(&self) -> impl Iterator<Item = &Expression> {
        self.open.iter().map(|question| &question.ok)
    }

    /// Closes the alerts whose condition holds; returns their indices among the facts.
    pub fn answer(&mut self, holds: &[bool], now: Duration) -> Vec<usize> {
        let mut answered = Vec::new();
        let mut holds = holds.iter();
        self.open.retain(|AlertQuestion { place, .. }| {
            let is_answered = holds.next() == Some(&true);
            if is_answered {
                let fact = &mut self.facts[*place];
                fact.answered_after = Some(now.saturating_sub(fact.at));
                answered.push(*place);
            }
            !is_answered
        });
        answered
    }

    /// All alerts, oldest first.
    pub fn facts(&self) -> &[AlertFact] {
        &self.facts
    }

    /// The levels of the unanswered alerts.
    pub fn levels(&self) -> BTreeSet<AlertLevel> {
        let open = self.open.iter();
        open.map(|question| self.facts[question.place].level)
            .collect()
    }

    /// The vehicle of each unanswered alert, if it is about one.
    pub fn subjects(&self) -> impl Iterator<Item = Option<VehicleId>> {
        self.open.iter().map(|question| question.vehicle)
    }

    /// The unanswered alerts, the most urgent first.
    pub fn waiting(&self, now: Duration) -> Vec<OpenAlert> {
        let of = |question: &AlertQuestion| {
            let fact = &self.facts[question.place];
            OpenAlert {
                text: fact.text.clone(),
                level: fact.level,
                remaining: (fact.at + fact.limit).saturating_sub(now),
            }
        };
        let mut open: Vec<OpenAlert> = self.open.iter().map(of).collect();
        open.sort_by_key(|alert| (std::cmp::Reverse(alert.level), alert.remaining));
        open
    }
}
