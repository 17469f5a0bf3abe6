//! The upload of a list item by item: its length, then each item that the vehicle requests.
//!
//! A refusal does not end an upload: `ArduPilot` refuses an item that arrives twice, and continues. It requests an
//! item each second, and ends the upload after 8 s without one.

#![expect(
    deprecated,
    reason = "older vehicles request items with what the dialect calls superseded"
)]

use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    MISSION_COUNT_DATA, MISSION_ITEM_INT_DATA, MavMessage, MavMissionResult,
};

use super::packed;
use crate::plan::{Item, ListKind};
use crate::session::plans::wire::mission_type;
use crate::vehicle::Vehicle;
use crate::wire::{Content, Frame, Outgoing};

/// How long the first request may take before the length is sent again, and how many times it is sent.
const FIRST_REQUEST_WITHIN: Duration = Duration::from_secs(1);
const COUNTS: u8 = 8;
/// How long after the last requested item an upload counts as ended: a vehicle ends it after 8 s
/// without an item.
const GIVEN_UP_AFTER: Duration = Duration::from_millis(8500);
/// A refusal counts if no request follows within this time, in which four would normally arrive.
const REFUSED_AFTER: Duration = Duration::from_secs(4);

/// An upload in progress.
#[derive(Debug, Clone)]
pub(super) struct Sending {
    kind: ListKind,
    items: Vec<Item>,
    counts: u8,
    counted_at: Duration,
    /// When an item was last requested, and how many were requested.
    asked_at: Option<Duration>,
    reached: usize,
    refusal: Option<(Duration, MavMissionResult)>,
    is_accepted: bool,
}

/// The result of an upload.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sent {
    Accepted,
    /// The vehicle has refused the list at the item with this number.
    Refused(MavMissionResult, usize),
    /// The vehicle has fallen silent; the list that it holds is unknown.
    Silent,
}

impl Sending {
    pub fn new(kind: ListKind, items: Vec<Item>) -> Self {
        Self {
            kind,
            items,
            counts: 0,
            counted_at: Duration::ZERO,
            asked_at: None,
            reached: 0,
            refusal: None,
            is_accepted: false,
        }
    }

    /// How much has been sent, from 0 to 1.
    pub fn share(&self) -> f32 {
        self.reached as f32 / self.items.len().max(1) as f32
    }

    /// Answers a request, and notes the vehicle's verdict.
    pub fn receive(
        &mut self,
        frame: &Frame,
        vehicle: &Vehicle,
        now: Duration,
        out: &mut Vec<Outgoing>,
    ) {
        let Content::Message(message) = &frame.content else {
            return;
        };
        let (to, list) = match message {
            MavMessage::MISSION_REQUEST(data) => (data.target_system, data.mission_type),
            MavMessage::MISSION_REQUEST_INT(data) => (data.target_system, data.mission_type),
            MavMessage::MISSION_ACK(data) => (data.target_system, data.mission_type),
            _ => return,
        };
        if ![0, vehicle.station].contains(&to) || list as u8 != self.kind.number() {
            return;
        }
        match message {
            MavMessage::MISSION_REQUEST(data) => self.requested(data.seq, vehicle, now, out),
            MavMessage::MISSION_REQUEST_INT(data) => self.requested(data.seq, vehicle, now, out),
            MavMessage::MISSION_ACK(data) => self.judged(data.mavtype, now),
            _ => {}
        }
    }

    fn requested(&mut self, seq: u16, vehicle: &Vehicle, now: Duration, out: &mut Vec<Outgoing>) {
        let Some(item) = self.items.get(usize::from(seq)).filter(|_| self.counts > 0) else {
            return;
        };
        self.asked_at = Some(now);
        self.reached = self.reached.max(usize::from(seq) + 1);
        out.push(Outgoing::Raw {
            id: MISSION_ITEM_INT_DATA::ID,
            payload: packed::laid_out(item, seq, vehicle.address(), self.kind),
        });
    }

    fn judged(&mut self, result: MavMissionResult, now: Duration) {
        let is_complete = self.counts > 0 && self.reached == self.items.len();
        match result {
            MavMissionResult::MAV_MISSION_ACCEPTED => self.is_accepted |= is_complete,
            // The answer to an item that arrived twice.
            MavMissionResult::MAV_MISSION_INVALID_SEQUENCE => {}
            _ => self.refusal = Some((now, result)),
        }
    }

    /// Sends the length until the vehicle requests an item; returns the result of the upload at the end.
    pub fn poll(
        &mut self,
        vehicle: &Vehicle,
        now: Duration,
        out: &mut Vec<Outgoing>,
    ) -> Option<Sent> {
        if self.is_accepted {
            return Some(Sent::Accepted);
        }
        let delay = 2 * vehicle.link.round_trip.unwrap_or_default();
        if let Some((refused_at, result)) = self.refusal {
            let heard_at = self.asked_at.map_or(refused_at, |at| at.max(refused_at));
            if now >= heard_at + REFUSED_AFTER + delay {
                return Some(if names_a_fault(result) {
                    Sent::Refused(result, self.reached.saturating_sub(1))
                } else {
                    Sent::Silent
                });
            }
            return None;
        }
        if let Some(asked_at) = self.asked_at {
            return (now >= asked_at + GIVEN_UP_AFTER + delay).then_some(Sent::Silent);
        }
        if self.counts > 0 && now < self.counted_at + FIRST_REQUEST_WITHIN + delay {
            return None;
        }
        if self.counts == COUNTS {
            return Some(Sent::Silent);
        }
        self.counts += 1;
        self.counted_at = now;
        let count = MavMessage::MISSION_COUNT(MISSION_COUNT_DATA {
            // Longer lists do not fit on any vehicle; the vehicle refuses them.
            count: u16::try_from(self.items.len()).unwrap_or(u16::MAX),
            target_system: vehicle.system,
            target_component: vehicle.component,
            mission_type: mission_type(self.kind),
            opaque_id: 0,
        });
        out.push(count.into());
        None
    }
}

/// Whether an answer is a verdict on the list. Other answers are about the transfer only, such as one from a vehicle
/// that has waited too long for an item: it may accept the same list the next time.
fn names_a_fault(result: MavMissionResult) -> bool {
    !matches!(
        result,
        MavMissionResult::MAV_MISSION_ERROR | MavMissionResult::MAV_MISSION_OPERATION_CANCELLED
    )
}
