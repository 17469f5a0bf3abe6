//! The upload of one list to the vehicle.

use std::ops::RangeInclusive;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMissionResult::{
    self, MAV_MISSION_DENIED, MAV_MISSION_INVALID_SEQUENCE,
};

use super::Peer;
use crate::plan::Item;

const ASK_AGAIN_AFTER: Duration = Duration::from_secs(1);
/// An upload ends when no item has arrived for this long.
const GIVE_UP_AFTER: Duration = Duration::from_secs(8);

#[derive(Debug, Clone)]
pub(super) struct Upload {
    pub peer: Peer,
    /// The requested item, and the last one of the upload.
    next: u16,
    last: u16,
    heard_at: Duration,
    asked_at: Duration,
    /// The items of a fence so far: the fence takes effect as a whole.
    pub staged: Vec<Item>,
}

/// The next action for an upload.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum UploadDue {
    Nothing,
    /// Request the item again, since it has not arrived.
    AskAgain,
    /// End the upload, and report that to its sender.
    GiveUp,
    /// End the upload without a report: its link may be gone.
    Forget,
}

impl Upload {
    pub fn new(peer: Peer, items: &RangeInclusive<u16>, now: Duration, staged: Vec<Item>) -> Self {
        Self {
            peer,
            next: *items.start(),
            last: *items.end(),
            heard_at: now,
            asked_at: now,
            staged,
        }
    }

    /// Notes that an item is requested; returns its number.
    pub fn ask(&mut self, now: Duration) -> u16 {
        self.asked_at = now;
        self.next
    }

    /// The reason to refuse an item, if it is not the requested one.
    pub fn refusal(&self, seq: u16, from: Peer) -> Option<MavMissionResult> {
        if self.next != seq {
            Some(MAV_MISSION_INVALID_SEQUENCE)
        } else if !self.peer.is_same_sender(from) {
            Some(MAV_MISSION_DENIED)
        } else {
            None
        }
    }

    /// Notes that the item has arrived; returns whether another one follows.
    pub fn advance(&mut self, now: Duration) -> bool {
        self.heard_at = now;
        self.next += 1;
        self.next <= self.last
    }

    /// The minimum number of items that the list will have.
    pub fn length(&self) -> usize {
        usize::from(self.last) + 1
    }

    /// The next action for the upload; `is_own_link` means that the link being served is the
    /// upload's own.
    pub fn due(&self, now: Duration, is_own_link: bool) -> UploadDue {
        let silent = now.saturating_sub(self.heard_at);
        if !is_own_link {
            if silent > GIVE_UP_AFTER + ASK_AGAIN_AFTER {
                UploadDue::Forget
            } else {
                UploadDue::Nothing
            }
        } else if silent > GIVE_UP_AFTER {
            UploadDue::GiveUp
        } else if now.saturating_sub(self.asked_at) > ASK_AGAIN_AFTER {
            UploadDue::AskAgain
        } else {
            UploadDue::Nothing
        }
    }
}
