//! The stages of an instance, from a program to a vehicle that can be armed.

use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantNames};

/// How far an instance has come.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Serialize,
    Deserialize,
    IntoStaticStr,
    VariantNames,
)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum SitlStage {
    /// Others are being started before it.
    Queued,
    Process,
    /// Its autopilot has been heard.
    Heartbeat,
    /// All its parameters have come.
    Parameters,
    /// Its navigation filter has a position.
    Position,
    /// It can be armed.
    Ready,
    /// It is being ended.
    Stopping,
    /// Its process is gone.
    Ended,
}

impl SitlStage {
    /// Its name, as JSON has it.
    pub fn word(self) -> &'static str {
        self.into()
    }
}
