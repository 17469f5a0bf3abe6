//! The orders to a session, and its reports.

use std::time::Duration;

use super::ftp::FtpEntry;
use super::naming::Renamed;
use crate::commands::{Command, Setpoint};
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::notice::Notice;
use crate::parameters::{ParameterType, written};
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::verb::Verb;

/// A command to one vehicle, as part of an order.
#[derive(Debug, Clone, PartialEq)]
pub struct VehicleCommand {
    /// The ledger's entry that receives the reports.
    pub entry: EntryId,
    /// The verb of the order, which determines retries and precedence.
    pub verb: &'static Verb,
    pub command: Command,
    /// The parameter's name as typed, if the vehicle has another one.
    pub renamed: Option<Renamed>,
    /// The type of the parameter that it sets, if the vehicle takes the bytes of that type.
    pub stored_as: Option<ParameterType>,
}

/// One vehicle's part in a joint manoeuvre, at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steering {
    /// The manoeuvre's verb, for explanations.
    pub verb: &'static Verb,
    pub setpoint: Setpoint,
}

#[derive(Debug, Clone, PartialEq)]
pub enum Report {
    /// A command made progress.
    Row(RowUpdate),
    /// A notice for the user.
    Notice(Notice),
    /// A folder of the vehicle has been listed.
    Folder(ListedFolder),
}

/// The entries of a vehicle's folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ListedFolder {
    pub vehicle: VehicleId,
    /// The path of the folder, as it was requested.
    pub folder: String,
    /// The entries: folders first, then files, in the order of their names.
    pub entries: Vec<FtpEntry>,
}

impl VehicleCommand {
    /// A command for an order.
    pub fn new(entry: EntryId, verb: &'static Verb, command: Command) -> Self {
        Self {
            entry,
            verb,
            command,
            renamed: None,
            stored_as: None,
        }
    }

    /// Whether it changes the plan on board.
    pub fn changes_plan(&self) -> bool {
        matches!(&self.command, Command::Plan(command) if command.changes_plan())
    }

    /// The outcome from a `PARAM_VALUE`, with the name as typed if the vehicle has another.
    pub(super) fn parameter_outcome(&self, value: f64) -> Result<Text, Text> {
        let Command::Parameter(command) = &self.command else {
            return Ok(written(value).into());
        };
        let outcome = command.outcome(value);
        match &self.renamed {
            Some(renamed) => outcome.map(|text| renamed.remark(&text)),
            None => outcome,
        }
    }

    /// The final row of a command that was never sent.
    pub fn unsent(
        &self,
        vehicle: VehicleId,
        state: RowState,
        reason: impl Into<Text>,
        now: Duration,
    ) -> RowUpdate {
        RowUpdate {
            entry: self.entry,
            vehicle,
            state,
            tries: 0,
            at: now,
            explanation: Some(reason.into()),
        }
    }
}
