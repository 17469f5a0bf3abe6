//! An order: a line for vehicles, from the command line to its execution.

use super::{Command, Deed, Manoeuvre, PlanCommand, PlanTask};
use crate::ledger::{Given, Risk};
use crate::pilot_in_command::Person;
use crate::text::Text;
use crate::vehicle::{VehicleId, Vehicles, Wind};
use crate::verb::Verb;

/// A command to vehicles or the mission.
#[derive(Debug, Clone, PartialEq)]
pub struct Order {
    /// The line in its canonical spelling, always with its targets.
    pub line: String,
    pub verb: &'static Verb,
    /// The vehicles; if their order matters, the leader is first.
    pub targets: Vec<VehicleId>,
    pub act: Act,
    /// Who gives it; `None` for the user of the console.
    pub by: Option<Person>,
}

impl Order {
    /// The order as a command to enter in the ledger.
    pub fn given(&self) -> Given<'_> {
        Given {
            line: &self.line,
            verb: self.verb,
            risk: self.act.risk(),
            by: self.by.as_ref(),
        }
    }
}

/// The action of an order, grouped by the part that carries it out.
#[derive(Debug, Clone, PartialEq)]
pub enum Act {
    /// Carried out by the autopilot of each target.
    Command(Command),
    /// Carried out by the mission, for each target.
    Deed(Deed),
    Manoeuvre(Manoeuvre),
    /// Each target gets a plan of its own.
    Plans(PlanTask),
    /// The plans on board are flown in simulation; no vehicle gets a command.
    Rehearse {
        /// The wind to fly in; `None` for the known one.
        wind: Option<Wind>,
    },
}

impl Order {
    /// Why the state of the order's vehicles requires a confirmation although its verb does not;
    /// `None` if it requires none.
    pub fn hazard(&self, vehicles: &Vehicles) -> Option<Text> {
        let mut targets = self.targets.iter().filter_map(|id| vehicles.get(id));
        match &self.act {
            Act::Command(command) => targets.find_map(|vehicle| command.hazard(vehicle)),
            Act::Plans(_) => targets.find_map(|vehicle| PlanCommand::replacing_hazard(vehicle)),
            Act::Deed(_) | Act::Manoeuvre(_) | Act::Rehearse { .. } => None,
        }
    }
}

impl Act {
    pub fn risk(&self) -> Risk {
        match self {
            Self::Command(command) => command.risk(),
            Self::Deed(_) | Self::Manoeuvre(_) | Self::Plans(_) | Self::Rehearse { .. } => {
                Risk::None
            }
        }
    }
}
