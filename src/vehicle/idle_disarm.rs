//! Why an autopilot has disarmed a vehicle by itself.

use crate::text;
use crate::text::Text;

/// A vehicle that was disarmed because it stayed on the ground with its motors armed (`DISARM_DELAY`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IdleDisarm {
    /// Whether the vehicle had been in the air before.
    pub has_flown: bool,
    /// The time allowed on the ground, in seconds.
    pub delay_s: u32,
}

impl IdleDisarm {
    /// The reason in a few words: `no takeoff within 10 s`.
    pub fn text(self) -> Text {
        if self.has_flown {
            text!("idle-on-ground", seconds = self.delay_s)
        } else {
            text!("idle-no-takeoff", seconds = self.delay_s)
        }
    }
}
