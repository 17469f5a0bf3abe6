//! The condition that the desk of a class wants to know of.

use super::Flight;
use super::injects::InjectFault;
use crate::class::OrderId;
use crate::mission::event::expression::Expression;
use crate::mission::event::scope::Scope;

/// A condition, and whether it has held since the desk asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Expected {
    /// The order with which the desk asked.
    pub asked_by: OrderId,
    /// Whether it holds, or has held.
    pub has_held: bool,
}

/// A condition that is watched in one flight. It changes nothing in the flight, so it is not in the record.
#[derive(Debug, Clone)]
pub(super) struct Expectation {
    condition: Expression,
    state: Expected,
}

impl Expectation {
    /// Looks whether the condition holds. Its last chance is the step with which the flight ends.
    pub fn look(&mut self, scope: &Scope<'_>) {
        self.state.has_held = self.state.has_held || self.condition.holds(scope);
    }

    pub fn state(&self) -> Expected {
        self.state
    }
}

impl Flight {
    /// Watches the condition of an order instead of the one before.
    ///
    /// # Errors
    /// The condition cannot be read, or the flight is over.
    pub fn expect(&mut self, asked_by: OrderId, when: &str) -> Result<(), InjectFault> {
        if self.is_over() {
            return Err(InjectFault::Over);
        }
        let condition = self.mission.condition(when);
        let condition = condition.map_err(InjectFault::Condition)?;
        let state = Expected {
            asked_by,
            has_held: false,
        };
        self.threats.expectation = Some(Expectation { condition, state });
        Ok(())
    }
}
