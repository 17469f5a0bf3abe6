//! A simulated imperfect radio link: messages in both directions can be lost or delayed.

use std::collections::VecDeque;
use std::time::Duration;

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use mavlink::dialects::ardupilotmega::MavMessage;

use crate::geo::LatLon;
use crate::vehicle::Unheard;
use crate::wire::{Content, Frame, Outgoing};

/// The state of an imperfect radio link.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RadioFault {
    /// The share of frames lost in either direction, 0 to 1; at [`RadioFault::SILENT`] or more, no frame arrives.
    pub loss: f64,
    /// The delay in each direction.
    pub delay: Duration,
    /// The seed of the losses.
    pub seed: u64,
}

impl RadioFault {
    /// A link that loses this share or more is cut.
    pub const SILENT: f64 = 0.97;

    /// Whether the radio loses every frame.
    pub fn is_cut(self) -> bool {
        self.loss >= Self::SILENT
    }

    /// Whether the difference from another state is noticeable.
    pub fn differs(self, other: Self) -> bool {
        let delays = self.delay.abs_diff(other.delay);
        (self.loss - other.loss).abs() > 0.01
            || self.is_cut() != other.is_cut()
            || (self.loss == 0.0) != (other.loss == 0.0)
            || delays > Duration::from_millis(5)
    }
}

/// Both directions of a link.
#[derive(Debug, Clone)]
pub(super) struct Channel {
    fault: RadioFault,
    random: ChaCha8Rng,
    inbound: VecDeque<(Duration, Frame)>,
    outbound: VecDeque<(Duration, Outgoing)>,
}

impl Channel {
    pub fn new() -> Self {
        Self {
            fault: RadioFault::default(),
            random: ChaCha8Rng::seed_from_u64(0),
            inbound: VecDeque::new(),
            outbound: VecDeque::new(),
        }
    }

    /// Sets the state of the link; `vehicle` distinguishes the links of one flight.
    pub fn set(&mut self, fault: RadioFault, vehicle: u64) {
        if fault.seed != self.fault.seed {
            self.random = ChaCha8Rng::seed_from_u64(fault.seed);
            self.random.set_stream(vehicle);
        }
        self.fault = fault;
    }

    /// Whether the link is perfect and has nothing in transit.
    pub fn is_clear(&self) -> bool {
        self.fault.loss <= 0.0
            && self.fault.delay.is_zero()
            && self.inbound.is_empty()
            && self.outbound.is_empty()
    }

    /// Whether the radio loses every frame.
    pub fn is_cut(&self) -> bool {
        self.fault.is_cut()
    }

    fn loses(&mut self) -> bool {
        self.fault.is_cut()
            || self.fault.loss > 0.0 && self.random.random::<f64>() < self.fault.loss
    }

    /// Accepts a frame from the vehicle; returns `false` if it is lost.
    pub fn hear(&mut self, frame: &Frame, now: Duration) -> bool {
        let passes = !self.loses();
        if passes {
            self.inbound
                .push_back((now + self.fault.delay, frame.clone()));
        }
        passes
    }

    /// The next frame that has arrived.
    pub fn arrived(&mut self, now: Duration) -> Option<Frame> {
        let (due, _) = self.inbound.front()?;
        if *due > now {
            return None;
        }
        self.inbound.pop_front().map(|(_, frame)| frame)
    }

    /// Accepts messages to the vehicle; returns those that have arrived.
    pub fn say(&mut self, messages: Vec<Outgoing>, now: Duration) -> Vec<Outgoing> {
        for message in messages {
            if !self.loses() {
                self.outbound.push_back((now + self.fault.delay, message));
            }
        }
        let there = self.outbound.iter().take_while(|(due, _)| *due <= now);
        let count = there.count();
        let there = self.outbound.drain(..count);
        there.map(|(_, message)| message).collect()
    }
}

/// The vehicle's position, if the frame contains one.
pub(super) fn position(frame: &Frame) -> Option<Unheard> {
    let Content::Message(MavMessage::GLOBAL_POSITION_INT(data)) = &frame.content else {
        return None;
    };
    let at = LatLon::new(f64::from(data.lat) * 1e-7, f64::from(data.lon) * 1e-7);
    (data.lat != 0 || data.lon != 0).then_some(Unheard {
        at,
        altitude_m: f64::from(data.relative_alt) * 1e-3,
        boot_ms: data.time_boot_ms,
    })
}

#[cfg(test)]
mod tests;
