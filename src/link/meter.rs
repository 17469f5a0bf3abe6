//! The traffic and losses of a link, and their publication.

use std::collections::VecDeque;
use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use tokio::sync::watch;
use tokio::time::Instant;

use super::{LinkState, LinkStatus, Rates, SignedLink, Tap};
use crate::doctor::is_of_a_station;
use crate::text::Text;
use crate::wire::{Counters, Frame, SequenceStep};

/// The time over which rates are measured.
const RATE_WINDOW: Duration = Duration::from_secs(2);

/// Counts for one link and publishes its status.
#[derive(Debug)]
pub(super) struct LinkMeter {
    status: LinkStatus,
    pub(super) tap: Tap,
    published: watch::Sender<LinkStatus>,
    /// Messages that the handles dropped without involving the task.
    refused: Arc<AtomicU64>,
    dropped: u64,
    window: VecDeque<TrafficSample>,
    has_been_up: bool,
    frames_heard: u64,
}

#[derive(Debug, Clone, Copy)]
struct TrafficSample {
    at: Instant,
    bytes_in: u64,
    messages_in: u64,
    bytes_out: u64,
    messages_out: u64,
}

impl LinkMeter {
    pub(super) fn new(
        published: watch::Sender<LinkStatus>,
        refused: Arc<AtomicU64>,
        tap: Tap,
    ) -> Self {
        let status = published.borrow().clone();
        Self {
            status,
            tap,
            published,
            refused,
            dropped: 0,
            window: VecDeque::new(),
            has_been_up: false,
            frames_heard: 0,
        }
    }

    /// Publishes changes, with fresh rates.
    pub(super) fn publish(&mut self) {
        self.sample();
        self.status.uses_signing = self.tap.signing().is_some_and(SignedLink::is_used);
        self.status.dropped_out = self.dropped + self.refused.load(Ordering::Relaxed);
        self.published.send_if_modified(|seen| {
            let changed = *seen != self.status;
            if changed {
                seen.clone_from(&self.status);
            }
            changed
        });
    }

    /// Notes that the link is up; `local` is the socket's own address, if any.
    pub(super) fn up(&mut self, local: Option<SocketAddr>) {
        if self.has_been_up {
            self.status.reconnects += 1;
        }
        self.has_been_up = true;
        tracing::info!(link = %self.status.name, "up");
        self.status.local = local;
        self.status.last_error = None;
        self.state(LinkState::Up);
    }

    /// Notes that the link is down, with the reason, if any.
    pub(super) fn down(&mut self, state: LinkState, reason: Option<Text>) {
        let said = reason.as_ref().map(tracing::field::display);
        tracing::info!(link = %self.status.name, %state, reason = said, "down");
        if reason.is_some() {
            self.status.last_error = reason;
        }
        self.status.peers = 0;
        self.status.local = None;
        if state == LinkState::Ended {
            // Without further samples the last rates would stay forever.
            self.window.clear();
        }
        self.state(state);
    }

    fn state(&mut self, state: LinkState) {
        self.status.state = state;
        self.publish();
    }

    /// Notes a fault that does not bring the link down, or with `None` the end of such a fault.
    pub(super) fn complain(&mut self, reason: Option<Text>) {
        self.status.last_error = reason;
    }

    /// Whether any frame has arrived since the last call.
    pub(super) fn take_heard(&mut self) -> bool {
        let before = std::mem::replace(&mut self.frames_heard, self.status.decoder.frames);
        self.status.decoder.frames > before
    }

    pub(super) fn set_peers(&mut self, peers: usize) {
        self.status.peers = peers;
    }

    /// Adds a decoder's counts between two states.
    pub(super) fn decoded(&mut self, before: Counters, after: Counters) {
        let sum = &mut self.status.decoder;
        sum.bytes += after.bytes - before.bytes;
        sum.frames += after.frames - before.frames;
        sum.crc_errors += after.crc_errors - before.crc_errors;
        sum.skipped_bytes += after.skipped_bytes - before.skipped_bytes;
        sum.unknown_messages += after.unknown_messages - before.unknown_messages;
        sum.undecoded += after.undecoded - before.undecoded;
    }

    /// Counts bytes that were skipped before a decoder.
    pub(super) fn passed_over(&mut self, bytes: u64) {
        self.status.decoder.bytes += bytes;
        self.status.decoder.skipped_bytes += bytes;
    }

    /// Counts a frame by its sequence number. A frame of an unknown message may be noise and adds
    /// no sender.
    pub(super) fn numbered(&mut self, frame: &Frame, step: SequenceStep) {
        let sender = (frame.system, frame.component);
        if frame.is_verified() || self.status.numbered.contains_key(&sender) {
            let frames = self.status.numbered.entry(sender).or_default();
            frames.note(step);
            frames.seals.note(frame.seal);
            frames.is_station |= is_of_a_station(frame);
        }
    }

    pub(super) fn sent(&mut self, messages: u64, bytes: usize) {
        self.status.sent_messages += messages;
        self.status.sent_bytes += bytes as u64;
    }

    /// Counts messages that could not be sent.
    pub(super) fn dropped(&mut self, messages: u64) {
        self.dropped += messages;
    }

    fn sample(&mut self) {
        let now = TrafficSample {
            at: Instant::now(),
            bytes_in: self.status.decoder.bytes,
            messages_in: self.status.decoder.frames,
            bytes_out: self.status.sent_bytes,
            messages_out: self.status.sent_messages,
        };
        self.window.push_back(now);
        // The oldest sample kept is the newest one outside the window, so that a full window is measured.
        while self
            .window
            .get(1)
            .is_some_and(|s| now.at - s.at >= RATE_WINDOW)
        {
            self.window.pop_front();
        }
        let Some(first) = self.window.front() else {
            return;
        };
        // The minimum of one second keeps the rates of a new link from being far too high.
        let seconds = (now.at - first.at).as_secs_f64().max(1.0);
        let rate = |from: u64, to: u64| ((to - from) as f64 / seconds) as f32;
        self.status.rates = Rates {
            bytes_in_s: rate(first.bytes_in, now.bytes_in),
            messages_in_s: rate(first.messages_in, now.messages_in),
            bytes_out_s: rate(first.bytes_out, now.bytes_out),
            messages_out_s: rate(first.messages_out, now.messages_out),
        };
    }
}
