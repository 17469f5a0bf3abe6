//! Events of a mission while it is flown: by time, on a condition, by chance, or by an instructor.
//!
//! [`Event`]s are read from the file once. The [`Engine`](engine::Engine) of a flight watches them, changes the
//! weather and the zones, brings people and aircraft, breaks things on board, and asks for answers to alerts.

use std::time::Duration;

use crate::scoring::AlertLevel;
use crate::text::Text;

pub(super) mod airspace;
pub(super) mod alert;
pub(super) mod demand;
pub(super) mod engine;
pub(super) mod expression;
pub(super) mod fault;
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

/// Something that can happen.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Event {
    pub id: String,
    /// What an instructor calls it.
    pub title: Text,
    pub trigger: Trigger,
    /// Whether it happens once at most.
    pub once: bool,
    /// By how much at most the seed moves its time, either way.
    pub jitter: Duration,
    /// How likely it happens when its time has come.
    pub chance: f64,
    pub actions: Vec<Action>,
}

/// When an event happens.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Trigger {
    /// At this mission time.
    At(Duration),
    /// When this begins to hold.
    When(Expression),
    /// So long after another event, by its place in the file.
    After(usize, Duration),
    /// When an instructor says so.
    Instructor,
}

/// What an event does.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Action {
    Say(Text),
    Alert {
        level: AlertLevel,
        text: Text,
        /// What has to become true; `None` for an alert that only tells.
        ok: Option<Expression>,
        within: Duration,
    },
    Weather(Change),
    /// Switches the zone of this place in the file.
    Zone(usize, bool),
    Spawn(Spawn),
    Fault(Fault),
    /// The mission has failed.
    Fail(Text),
    /// Another event happens, by its place in the file.
    Event(usize),
}
