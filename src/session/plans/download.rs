//! The download of one list: its length, then item by item. Requests without an answer are
//! repeated.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavMessage, MavMissionResult};

use super::wire::{self, Answer, Form};
use crate::plan::{Item, ListKind};
use crate::vehicle::Transfer;
use crate::wire::MavAddress;

/// How long an answer may take on a link without delay (the protocol proposes 0.25 to 1.5 s; vehicles answer within
/// 30 ms, but stall for up to a second while they boot).
const ANSWER_WITHIN: Duration = Duration::from_secs(1);
/// The longest wait for an answer, even on a slow link.
const LONGEST_WAIT: Duration = Duration::from_secs(5);
/// How many times a request is sent before the download is abandoned (MAVLink's protocol: 5 retries).
const TRIES: u8 = 6;
/// After this many requests for an item in one form, the other form is used.
const TRIES_PER_FORM: u8 = 3;
/// The longest list; `ArduPilot` stores some hundreds.
const MOST_ITEMS: u16 = 5000;

/// A download in progress.
#[derive(Debug, Clone)]
pub(in crate::session) struct Download {
    pub kind: ListKind,
    address: MavAddress,
    form: Form,
    /// Whether the vehicle is known to support integer items. Then lost messages alone must not lead to the use of
    /// floats, which have a precision of 2 m at best.
    is_int_certain: bool,
    total: Option<u16>,
    items: Vec<Item>,
    /// How many times the current request was sent, and when last.
    tries: u8,
    asked_at: Duration,
}

/// The state of a download.
#[derive(Debug, PartialEq)]
pub(in crate::session) enum Step {
    Going,
    /// All items have arrived.
    Done(Vec<Item>),
    /// The vehicle has no such list.
    Unsupported,
    Failed,
}

impl Download {
    /// A new download. `knows_int` is whether the vehicle supports integer items, if known.
    pub fn new(kind: ListKind, address: MavAddress, knows_int: Option<bool>) -> Self {
        let is_float = knows_int == Some(false);
        Self {
            kind,
            address,
            form: if is_float { Form::Float } else { Form::Int },
            is_int_certain: knows_int == Some(true),
            total: None,
            items: Vec::new(),
            tries: 0,
            asked_at: Duration::ZERO,
        }
    }

    /// The progress of the download, for display.
    pub fn transfer(&self) -> Transfer {
        Transfer::Coming {
            received: u16::try_from(self.items.len()).unwrap_or(u16::MAX),
            total: self.total,
        }
    }

    /// Sends and repeats requests. `round_trip` is the round-trip time of the link.
    pub fn poll(&mut self, round_trip: Duration, now: Duration, out: &mut Vec<MavMessage>) -> Step {
        let wait = (ANSWER_WITHIN + 2 * round_trip).min(LONGEST_WAIT);
        if self.tries > 0 && now < self.asked_at + wait {
            return Step::Going;
        }
        if self.tries == TRIES {
            return Step::Failed;
        }
        // Only the first item shows which form the vehicle supports.
        let is_first_item = self.total.is_some() && self.items.is_empty();
        if self.tries == TRIES_PER_FORM && is_first_item && !self.is_int_certain {
            self.form = match self.form {
                Form::Int => Form::Float,
                Form::Float => Form::Int,
            };
        }
        self.ask(now, out);
        Step::Going
    }

    /// Handles an answer about this list.
    pub fn receive(&mut self, answer: Answer, now: Duration, out: &mut Vec<MavMessage>) -> Step {
        match answer {
            Answer::Count(count) => self.count(count, now, out),
            Answer::Item(seq, item) => self.item(seq, item, now, out),
            Answer::Refused(result) => self.refused(result, now, out),
        }
    }

    /// Sends the end of the transfer to the vehicle.
    pub fn cancel(&self, out: &mut Vec<MavMessage>) {
        let cancelled = MavMissionResult::MAV_MISSION_OPERATION_CANCELLED;
        out.push(wire::acknowledge(self.address, self.kind, cancelled));
    }

    fn count(&mut self, count: u16, now: Duration, out: &mut Vec<MavMessage>) -> Step {
        if self.total == Some(count) {
            // Our request was sent twice, so there are two answers.
            return Step::Going;
        }
        if count > MOST_ITEMS {
            self.cancel(out);
            return Step::Failed;
        }
        // A different count: the list has been replaced.
        self.total = Some(count);
        self.items.clear();
        self.go_on(now, out)
    }

    fn item(&mut self, seq: u16, item: Item, now: Duration, out: &mut Vec<MavMessage>) -> Step {
        let is_next = usize::from(seq) == self.items.len();
        if self.total.is_none() || !is_next {
            return Step::Going;
        }
        self.items.push(item);
        self.go_on(now, out)
    }

    /// Handles a refusal; switches to floats for a vehicle that does not support integer items.
    fn refused(
        &mut self,
        result: MavMissionResult,
        now: Duration,
        out: &mut Vec<MavMessage>,
    ) -> Step {
        match result {
            // The end of another program's upload, not an answer to us.
            MavMissionResult::MAV_MISSION_ACCEPTED => Step::Going,
            MavMissionResult::MAV_MISSION_UNSUPPORTED if self.total.is_none() => Step::Unsupported,
            MavMissionResult::MAV_MISSION_UNSUPPORTED
                if self.form == Form::Int && self.items.is_empty() =>
            {
                self.form = Form::Float;
                self.tries = 0;
                self.ask(now, out);
                Step::Going
            }
            _ => Step::Failed,
        }
    }

    fn go_on(&mut self, now: Duration, out: &mut Vec<MavMessage>) -> Step {
        if self.total.map(usize::from) == Some(self.items.len()) {
            let accepted = MavMissionResult::MAV_MISSION_ACCEPTED;
            out.push(wire::acknowledge(self.address, self.kind, accepted));
            return Step::Done(std::mem::take(&mut self.items));
        }
        self.tries = 0;
        self.ask(now, out);
        Step::Going
    }

    fn ask(&mut self, now: Duration, out: &mut Vec<MavMessage>) {
        self.tries += 1;
        self.asked_at = now;
        out.push(if self.total.is_none() {
            wire::request_list(self.address, self.kind)
        } else {
            // Lengths are bounded by MOST_ITEMS.
            let seq = self.items.len() as u16;
            wire::request_item(self.address, self.kind, seq, self.form)
        });
    }
}
