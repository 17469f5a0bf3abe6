//! Events of a mission while it is flown: at a time, on a condition, by chance, or triggered by an instructor.
//!
//! [`Event`]s are read from the file once. The [`Engine`](engine::Engine) of a flight watches them, changes the
//! weather and the zones, brings people and aircraft, causes faults on board, and waits for answers to alerts.
//!
//! # How the parts fit
//! - When an event occurs: `expression` evaluates conditions, on the facts of `scope`; `engine` runs the events of a
//!   file, `standard` has those of every mission with an instructor.
//! - What it does: `weather`, `mover` (people, aircraft, other drones), `fault` (on board), and `demand`, which turns
//!   these into parameters of the simulator and states of the link.
//! - What must be answered, and by what: `alert`. When a vehicle breaks a rule of the air or collides: `airspace`.

use std::time::Duration;

use crate::scoring::AlertLevel;
use crate::text::Text;

pub(super) mod airspace;
pub(super) mod alert;
pub(super) mod demand;
pub(super) mod engine;
pub(super) mod expression;
pub(super) mod fault;
mod gusts;
pub(super) mod mover;
pub(super) mod scope;
pub(super) mod standard;
#[cfg(test)]
mod tests;
pub(super) mod weather;

use expression::Expression;
use fault::Fault;
use mover::Spawn;
use weather::Change;

/// An event that can happen during a mission.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Event {
    pub id: String,
    /// Its title in the instructor's list.
    pub title: Text,
    pub trigger: Trigger,
    /// Whether it happens at most once.
    pub once: bool,
    /// The maximum by which the seed moves its time, either way.
    pub jitter: Duration,
    /// The probability that it happens when it is due.
    pub chance: f64,
    pub actions: Vec<Action>,
}

/// When an event happens.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Trigger {
    /// At a mission time.
    At(Duration),
    /// When a condition becomes true.
    When(Expression),
    /// This long after another event, given by its index in the file.
    After(usize, Duration),
    /// When an instructor triggers it.
    Instructor,
}

/// An action of an event.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Action {
    Say(Text),
    Alert {
        level: AlertLevel,
        text: Text,
        /// The condition that answers the alert; `None` for an alert that needs no answer.
        ok: Option<Expression>,
        within: Duration,
        /// The index of the vehicle that the alert is about, from 0.
        about: Option<usize>,
    },
    Weather(Change),
    /// Switches a zone, by its index in the file, on or off.
    Zone(usize, bool),
    Spawn(Spawn),
    Fault(Fault),
    Fail(Text),
    /// Triggers another event, by its index in the file.
    Event(usize),
}
