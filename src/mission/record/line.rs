//! The lines of a record after its head.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::End;
use super::observed::ObservedVehicle;
use crate::commands::Deed;
use crate::record::{EntryLine, RowLine};
use crate::sim::STEP;
use crate::vehicle::VehicleId;

/// One line after the head.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum RecordLine {
    /// A step and the changes since the step before. Steps without changes have no line, except one
    /// step a second.
    Tick {
        /// Mission time in ms.
        t: u64,
        /// The simulator's step count at that time, if its clock is not the mission's.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        s: Option<u64>,
        #[serde(flatten)]
        change: RecordChange,
    },
    /// An action of a vehicle in the mission: [`Flight::act`](crate::mission::Flight::act).
    Act {
        deed: Deed,
        vehicles: Vec<VehicleId>,
    },
    /// A lost vehicle: [`Flight::lose`](crate::mission::Flight::lose).
    Lose {
        vehicle: VehicleId,
        #[serde(flatten)]
        change: RecordChange,
    },
    /// An inject of the instructor: [`Flight::inject`](crate::mission::Flight::inject).
    Inject { name: String },
    /// A pause of the mission: [`Flight::note_pause`](crate::mission::Flight::note_pause).
    Pause { seconds: u64 },
    /// The trainee gave up: [`Flight::abandon`](crate::mission::Flight::abandon).
    Abandon,
    /// The instructor recalled an earlier situation: what followed is not in the record, and the flight is practice.
    Recall,
    /// The instructor ended the flight: [`Flight::stop`](crate::mission::Flight::stop).
    Stop,
    /// Changes of commands after the last step, and the score.
    End {
        t: u64,
        #[serde(flatten)]
        change: RecordChange,
        end: End,
        /// The checksum of all lines before it, in hexadecimal; `None` in records older than this field.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        checksum: Option<String>,
    },
}

/// The vehicles' states that a line contains.
pub(super) struct ShownVehicles<'a> {
    pub(super) mission: Duration,
    /// The simulator's time, if it is not the mission's.
    pub(super) simulated: Option<Duration>,
    pub(super) vehicles: &'a [ObservedVehicle],
}

impl RecordLine {
    /// The vehicles' states, if the line is a step.
    pub(super) fn shown(&self) -> Option<ShownVehicles<'_>> {
        match self {
            Self::Tick { t, s, change } => Some(ShownVehicles {
                mission: Duration::from_millis(*t),
                simulated: s.map(|steps| STEP * u32::try_from(steps).unwrap_or(u32::MAX)),
                vehicles: &change.v,
            }),
            Self::Act { .. }
            | Self::Lose { .. }
            | Self::Inject { .. }
            | Self::Pause { .. }
            | Self::Abandon
            | Self::Recall
            | Self::Stop
            | Self::End { .. } => None,
        }
    }

    /// The line's mission time in ms, if it has one.
    pub(super) fn time(&self) -> Option<u64> {
        match self {
            Self::Tick { t, .. } | Self::End { t, .. } => Some(*t),
            Self::Act { .. }
            | Self::Lose { .. }
            | Self::Inject { .. }
            | Self::Pause { .. }
            | Self::Abandon
            | Self::Recall
            | Self::Stop => None,
        }
    }

    /// The checksum of all lines before it, if the line is the end and has one.
    pub(super) fn checksum(&self) -> Option<&str> {
        match self {
            Self::End { checksum, .. } => checksum.as_deref(),
            Self::Tick { .. }
            | Self::Act { .. }
            | Self::Lose { .. }
            | Self::Inject { .. }
            | Self::Pause { .. }
            | Self::Abandon
            | Self::Recall
            | Self::Stop => None,
        }
    }

    /// The score, if the line is the end.
    pub(super) fn end(&self) -> Option<&End> {
        match self {
            Self::End { end, .. } => Some(end),
            Self::Tick { .. }
            | Self::Act { .. }
            | Self::Lose { .. }
            | Self::Inject { .. }
            | Self::Pause { .. }
            | Self::Abandon
            | Self::Recall
            | Self::Stop => None,
        }
    }
}

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct RecordChange {
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) v: Vec<ObservedVehicle>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) e: Vec<EntryLine>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) r: Vec<RowLine>,
}
