//! The commands of other ground stations. They are in the ledger, but not among the operator's own: nothing that
//! counts, rates or repeats commands reads them.

use std::collections::VecDeque;
use std::fmt;
use std::time::Duration;

use super::RowState;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::wire::MavAddress;

/// The maximum number of rows; the oldest are dropped.
pub const FOREIGN_KEPT: usize = 1000;

/// A ground station other than this console, shown by its address: `254/230`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StationId(pub MavAddress);

impl fmt::Display for StationId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.0.system, self.0.component)
    }
}

/// The number of a foreign command, in the order of first appearance.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ForeignId(pub u32);

/// A command of another ground station to one vehicle, as far as it is known. Repetitions are one row with a count.
#[derive(Debug, Clone, PartialEq)]
pub struct ForeignCommand {
    pub id: ForeignId,
    pub station: StationId,
    pub vehicle: VehicleId,
    /// When it was noticed first.
    pub at: Duration,
    /// When it was noticed last.
    pub last_at: Duration,
    /// The command in the console's words, or the name of its MAVLink command.
    pub what: Text,
    /// How many times it was noticed.
    pub count: u32,
    /// The vehicle's answer; [`RowState::Sent`] while there is none.
    pub state: RowState,
    /// The reason for a refusal.
    pub explanation: Option<Text>,
}

impl ForeignCommand {
    /// Its line, which names the station first: `GCS 254/230: 3 mode RTL`.
    pub fn line(&self) -> Text {
        text!(
            "foreign-line",
            station = self.station.to_string(),
            vehicle = self.vehicle,
            what = self.what.clone()
        )
    }

    /// The answer, and how often the command was repeated.
    pub fn outcome(&self) -> Text {
        let state = match self.state {
            RowState::Sent => text!("foreign-unanswered"),
            state => state.text(),
        };
        let answer = std::iter::once(state).chain(self.explanation.clone());
        let answer = Text::joined(": ", answer.collect());
        if self.count > 1 {
            text!("foreign-repeated", outcome = answer, count = self.count)
        } else {
            answer
        }
    }
}

/// The foreign commands of a session, oldest first.
#[derive(Debug, Clone, Default)]
pub(super) struct ForeignLog(VecDeque<ForeignCommand>);

impl ForeignLog {
    /// Adds a command, or replaces its state but keeps the time of its first appearance. A change
    /// to a command that was dropped is ignored.
    pub fn note(&mut self, command: ForeignCommand) {
        let newest = self.0.back().map(|it| it.id);
        match self.0.iter_mut().rev().find(|it| it.id == command.id) {
            Some(known) => {
                *known = ForeignCommand {
                    at: known.at,
                    ..command
                }
            }
            None if newest.is_some_and(|newest| command.id < newest) => {}
            None => self.0.push_back(command),
        }
        if self.0.len() > FOREIGN_KEPT {
            self.0.pop_front();
        }
    }

    pub fn get(&self, id: ForeignId) -> Option<&ForeignCommand> {
        self.0.iter().rev().find(|it| it.id == id)
    }

    pub fn all(&self) -> impl DoubleEndedIterator<Item = &ForeignCommand> + ExactSizeIterator {
        self.0.iter()
    }
}
