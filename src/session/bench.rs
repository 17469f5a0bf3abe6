//! A radio under test: frames in both directions are lost, delayed and slowed down as the user asks.

use std::collections::VecDeque;
use std::time::Duration;

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use crate::vehicle::{RadioTest, RadioTraffic, TestedRadio, VehicleId};
use crate::wire::{Encoder, Frame, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM, Outgoing};

/// A slow radio drops what it could not send within this time.
const LONGEST_QUEUE: Duration = Duration::from_secs(5);

/// The radio under test.
#[derive(Debug, Clone)]
pub(super) struct Bench {
    test: Option<RadioTest>,
    since: Duration,
    random: ChaCha8Rng,
    inbound: Lane<Frame>,
    outbound: Lane<Outgoing>,
    /// Measures the length of messages.
    ruler: Encoder,
}

/// One direction of the radio.
#[derive(Debug, Clone)]
struct Lane<T> {
    /// The frames in transit, with the time of their arrival and their length.
    queue: VecDeque<(Duration, usize, T)>,
    /// The time at which the radio will have sent everything that it accepted.
    busy_until: Duration,
    traffic: RadioTraffic,
}

impl<T> Lane<T> {
    fn new() -> Self {
        Self {
            queue: VecDeque::new(),
            busy_until: Duration::ZERO,
            traffic: RadioTraffic::default(),
        }
    }

    fn begin_anew(&mut self) {
        self.busy_until = Duration::ZERO;
        self.traffic = RadioTraffic::default();
    }

    /// The next item that has arrived; without a test, all have.
    fn arrived(&mut self, now: Duration, is_on: bool) -> Option<T> {
        let (due, ..) = self.queue.front()?;
        if is_on && *due > now {
            return None;
        }
        let (_, len, item) = self.queue.pop_front()?;
        self.traffic.passed += 1;
        self.traffic.bytes += len as u64;
        Some(item)
    }

    /// The arrival time of a frame; `None` if it is lost. Both random numbers are always drawn, so
    /// that changing the jitter does not change which frames are lost.
    fn due(
        &mut self,
        test: RadioTest,
        len: usize,
        random: &mut ChaCha8Rng,
        now: Duration,
    ) -> Option<Duration> {
        let [luck, late]: [f64; 2] = [random.random(), random.random()];
        let begins = self.busy_until.max(now);
        let is_full = begins.saturating_sub(now) > LONGEST_QUEUE;
        if is_full || luck < test.loss {
            return None;
        }
        let lasts = test.rate.map_or(0.0, |rate| len as f64 / rate);
        self.busy_until = begins + Duration::from_secs_f64(lasts);
        Some(self.busy_until + test.delay + test.jitter.mul_f64(late))
    }

    /// Queues an item until `due`, but never before earlier items; `None` counts it as lost.
    fn push(&mut self, due: Option<Duration>, len: usize, item: T) {
        let Some(due) = due else {
            self.traffic.lost += 1;
            return;
        };
        let earliest = self.queue.back().map_or(Duration::ZERO, |(due, ..)| *due);
        self.queue.push_back((due.max(earliest), len, item));
    }
}

impl Bench {
    pub fn new() -> Self {
        Self {
            test: None,
            since: Duration::ZERO,
            random: ChaCha8Rng::seed_from_u64(0),
            inbound: Lane::new(),
            outbound: Lane::new(),
            ruler: Encoder::new(GROUND_STATION_SYSTEM, GROUND_STATION_COMPONENT),
        }
    }

    /// Begins a test, or ends it; `vehicle` distinguishes radios with the same seed.
    pub fn set(&mut self, test: Option<RadioTest>, vehicle: VehicleId, now: Duration) {
        self.random = ChaCha8Rng::seed_from_u64(test.map_or(0, |test| test.seed));
        self.random.set_stream(u64::from(vehicle));
        self.test = test;
        self.since = now;
        self.inbound.begin_anew();
        self.outbound.begin_anew();
    }

    /// Whether no test is on, and nothing is in transit.
    pub fn is_clear(&self) -> bool {
        self.test.is_none() && self.inbound.queue.is_empty() && self.outbound.queue.is_empty()
    }

    /// The test and its figures so far; `None` without one.
    pub fn tested(&self, now: Duration) -> Option<TestedRadio> {
        Some(TestedRadio {
            test: self.test?,
            lasts: now.saturating_sub(self.since),
            received: self.inbound.traffic,
            sent: self.outbound.traffic,
        })
    }

    /// Accepts a frame from the vehicle.
    pub fn hear(&mut self, frame: &Frame, now: Duration) {
        let len = usize::from(frame.wire_len);
        let test = self.test.unwrap_or_default();
        let due = self.inbound.due(test, len, &mut self.random, now);
        self.inbound.push(due, len, frame.clone());
    }

    /// The next frame that has arrived.
    pub fn arrived(&mut self, now: Duration) -> Option<Frame> {
        self.inbound.arrived(now, self.test.is_some())
    }

    /// Accepts messages to the vehicle; returns those that have arrived.
    pub fn say(&mut self, messages: Vec<Outgoing>, now: Duration) -> Vec<Outgoing> {
        let test = self.test.unwrap_or_default();
        for message in messages {
            let len = self.ruler.encode(&message, &mut Vec::new());
            let due = self.outbound.due(test, len, &mut self.random, now);
            self.outbound.push(due, len, message);
        }
        let is_on = self.test.is_some();
        std::iter::from_fn(|| self.outbound.arrived(now, is_on)).collect()
    }
}

#[cfg(test)]
mod tests;
