//! Helpers shared by the tests of this module.

use std::time::Duration;

use mavlink::MavlinkVersion;
use mavlink::dialects::ardupilotmega::MavMessage;

use super::Inbox;
use crate::notice::Notice;
use crate::vehicle::Vehicle;
use crate::wire::{AUTOPILOT_COMPONENT, ComponentId, Content, Frame};

/// A vehicle with its inbox and all notices.
pub(super) struct Bench {
    pub(super) vehicle: Vehicle,
    pub(super) inbox: Inbox,
    pub(super) notices: Vec<Notice>,
    pub(super) now: Duration,
}

impl Bench {
    pub(super) fn new() -> Self {
        Self {
            vehicle: Vehicle::new(7, AUTOPILOT_COMPONENT),
            inbox: Inbox::new(),
            notices: Vec::new(),
            now: Duration::from_secs(100),
        }
    }

    /// Lets time pass, then applies a message of the autopilot.
    pub(super) fn hear_after(&mut self, wait_ms: u64, message: MavMessage) {
        self.now += Duration::from_millis(wait_ms);
        self.hear(message);
    }

    pub(super) fn hear(&mut self, message: MavMessage) {
        self.hear_from(AUTOPILOT_COMPONENT, Content::Message(message));
    }

    pub(super) fn hear_from(&mut self, component: ComponentId, content: Content) {
        let frame = Frame {
            system: 7,
            component,
            sequence: 0,
            version: MavlinkVersion::V2,
            seal: crate::wire::Seal::Unsigned,
            wire_len: 12,
            content,
        };
        self.inbox
            .apply(&mut self.vehicle, &frame, self.now, &mut self.notices);
    }

    pub(super) fn poll_after(&mut self, wait_ms: u64) {
        self.now += Duration::from_millis(wait_ms);
        self.inbox
            .poll(&mut self.vehicle, self.now, &mut self.notices);
    }

    /// The texts of the notices since the last call.
    pub(super) fn said(&mut self) -> Vec<String> {
        self.notices
            .drain(..)
            .map(|notice| notice.text.to_string())
            .collect()
    }
}
