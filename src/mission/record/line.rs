//! The lines of a record after its head.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::End;
use super::observed::ObservedVehicle;
use crate::commands::Deed;
use crate::language;
use crate::ledger::{EntryId, LedgerRow, Risk, RowState};
use crate::vehicle::VehicleId;
use crate::verb::Verb;

/// One line after the head.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum RecordLine {
    /// A step, and what had changed since the one before. Steps in which nothing did have no line.
    Tick {
        /// Mission time in ms.
        t: u64,
        #[serde(flatten)]
        change: RecordChange,
    },
    /// A deed of vehicles: [`Flight::act`](crate::mission::Flight::act).
    Act {
        deed: Deed,
        vehicles: Vec<VehicleId>,
    },
    /// A vehicle that was given up: [`Flight::lose`](crate::mission::Flight::lose).
    Lose {
        vehicle: VehicleId,
        #[serde(flatten)]
        change: RecordChange,
    },
    /// An event of the instructor: [`Flight::inject`](crate::mission::Flight::inject).
    Inject { name: String },
    /// A pause: [`Flight::note_pause`](crate::mission::Flight::note_pause).
    Pause { seconds: u64 },
    /// The trainee gave up: [`Flight::abandon`](crate::mission::Flight::abandon).
    Abandon,
    /// What became of commands after the last step, and the score.
    End {
        t: u64,
        #[serde(flatten)]
        change: RecordChange,
        end: End,
    },
}

impl RecordLine {
    /// Its mission time in ms, where it has one.
    pub(super) fn time(&self) -> Option<u64> {
        match self {
            Self::Tick { t, .. } | Self::End { t, .. } => Some(*t),
            Self::Act { .. }
            | Self::Lose { .. }
            | Self::Inject { .. }
            | Self::Pause { .. }
            | Self::Abandon => None,
        }
    }

    /// What the flight was scored, where the line is its end.
    pub(super) fn end(&self) -> Option<&End> {
        match self {
            Self::End { end, .. } => Some(end),
            Self::Tick { .. }
            | Self::Act { .. }
            | Self::Lose { .. }
            | Self::Inject { .. }
            | Self::Pause { .. }
            | Self::Abandon => None,
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

/// A command that was given.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct EntryLine {
    pub(super) id: u32,
    pub(super) line: String,
    #[serde(serialize_with = "verb_name", deserialize_with = "known_verb")]
    pub(super) verb: &'static Verb,
    #[serde(default, skip_serializing_if = "is_none")]
    pub(super) risk: Risk,
    pub(super) vehicles: Vec<VehicleId>,
}

/// What became of it with one vehicle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct RowLine {
    pub(super) id: u32,
    pub(super) vehicle: VehicleId,
    pub(super) state: RowState,
    pub(super) tries: u8,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) why: Option<String>,
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "the serialiser passes references"
)]
fn is_none(risk: &Risk) -> bool {
    *risk == Risk::None
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde passes fields by reference"
)]
fn verb_name<S: Serializer>(verb: &&'static Verb, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(verb.name)
}

fn known_verb<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static Verb, D::Error> {
    let name = String::deserialize(deserializer)?;
    language::verb(&name).ok_or_else(|| D::Error::custom("no verb"))
}

impl RowLine {
    /// The line of a row as it stands now.
    pub(super) fn of(id: EntryId, row: &LedgerRow) -> Self {
        Self {
            id: id.0,
            vehicle: row.vehicle,
            state: row.state,
            tries: row.tries,
            why: row.explanation.as_ref().map(ToString::to_string),
        }
    }
}
