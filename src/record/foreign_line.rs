//! The journal's line for a command of another ground station.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::ledger::{ForeignCommand, ForeignId, RowState, StationId};
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::wire::MavAddress;

/// A command of another ground station to one vehicle in its present state. A later line with the same number replaces
/// it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ForeignLine {
    /// The number of the command among the commands of other stations.
    pub id: u32,
    /// The station's system and component.
    pub station: [u8; 2],
    pub vehicle: VehicleId,
    /// The command, in English.
    pub what: String,
    /// How many times it was noticed.
    pub count: u32,
    pub state: RowState,
    /// The reason for a refusal, in English.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

impl ForeignLine {
    /// The line of a command.
    pub fn of(command: &ForeignCommand) -> Self {
        let MavAddress { system, component } = command.station.0;
        Self {
            id: command.id.0,
            station: [system, component],
            vehicle: command.vehicle,
            what: command.what.to_string(),
            count: command.count,
            state: command.state,
            why: command.explanation.as_ref().map(ToString::to_string),
        }
    }

    /// The command of a line, at a time.
    pub fn command(&self, at: Duration) -> ForeignCommand {
        let [system, component] = self.station;
        ForeignCommand {
            id: ForeignId(self.id),
            station: StationId(MavAddress { system, component }),
            vehicle: self.vehicle,
            at,
            last_at: at,
            what: Text::verbatim(self.what.clone()),
            count: self.count,
            state: self.state,
            explanation: self.why.clone().map(Text::verbatim),
        }
    }
}
