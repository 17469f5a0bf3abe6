//! The stages of an instance, from a program to a vehicle that can be armed.

use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantNames};

/// The stage of an instance.
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
    /// Other instances are being started before this one.
    Queued,
    Process,
    /// The autopilot has sent a heartbeat.
    Heartbeat,
    /// All parameters have been received.
    Parameters,
    /// The navigation filter has a position.
    Position,
    /// The vehicle can be armed.
    Ready,
    /// The process is being ended.
    Stopping,
    /// The process has ended.
    Ended,
}

impl SitlStage {
    /// The stage's name in JSON.
    pub fn word(self) -> &'static str {
        self.into()
    }
}
