//! An order: what vehicles are asked to do, from the line that said it to those who carry it out.

use super::{Command, Deed, Manoeuvre};
use crate::ledger::{Given, Risk};
use crate::vehicle::VehicleId;
use crate::verb::Verb;

/// A line that asks vehicles for something.
#[derive(Debug, Clone, PartialEq)]
pub struct Order {
    /// The line in its plainest spelling, always with its targets.
    pub line: String,
    pub verb: &'static Verb,
    /// The vehicles; where it matters, the leader is the first.
    pub targets: Vec<VehicleId>,
    /// What they are to do.
    pub act: Act,
}

impl Order {
    /// As the ledger takes it down.
    pub fn given(&self) -> Given<'_> {
        Given {
            line: &self.line,
            verb: self.verb,
            risk: self.act.risk(),
        }
    }
}

/// What an order asks for, and so who carries it out.
#[derive(Debug, Clone, PartialEq)]
pub enum Act {
    /// The autopilot of each target.
    Command(Command),
    /// The mission, for each target.
    Deed(Deed),
    Manoeuvre(Manoeuvre),
}

impl Act {
    /// What it sets at risk.
    pub fn risk(&self) -> Risk {
        match self {
            Self::Command(command) => command.risk(),
            Self::Deed(_) | Self::Manoeuvre(_) => Risk::None,
        }
    }
}
