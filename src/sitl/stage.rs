//! How far an instance has come on its way from a program to a vehicle that can be armed.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// How far an instance has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// Others are being started before it.
    Queued,
    /// Its process runs.
    Process,
    /// Its autopilot has been heard.
    Heartbeat,
    /// All its parameters have come.
    Parameters,
    /// Its navigation filter knows where it is.
    Position,
    /// It can be armed.
    Ready,
    /// It is being ended.
    Stopping,
    /// Its process is gone.
    Ended,
}

impl Stage {
    /// Its name, as JSON has it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Queued => "queued",
            Self::Process => "process",
            Self::Heartbeat => "heartbeat",
            Self::Parameters => "parameters",
            Self::Position => "position",
            Self::Ready => "ready",
            Self::Stopping => "stopping",
            Self::Ended => "ended",
        }
    }
}
