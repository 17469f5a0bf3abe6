//! The effects of a mission on a vehicle's surroundings: its radio link and its simulator.

use std::time::Duration;

use super::bench::Bench;
use super::radio::{self, Channel, RadioFault};
use super::settings::Settings;
use crate::vehicle::{RadioTest, TestedRadio, Vehicle, VehicleId};
use crate::wire::{Frame, Outgoing};

/// The radio between the vehicle and the console, and the parameters of its simulator.
#[derive(Debug, Clone)]
pub(super) struct Surroundings {
    channel: Channel,
    /// The radio as the user tests it, outside of missions.
    bench: Bench,
    settings: Settings,
    /// Messages that bypass the simulated radio.
    beside: Vec<Outgoing>,
}

impl Surroundings {
    pub fn new() -> Self {
        Self {
            channel: Channel::new(),
            bench: Bench::new(),
            settings: Settings::default(),
            beside: Vec::new(),
        }
    }

    /// Sets the value that a parameter of the simulator must have.
    pub fn set_parameter(&mut self, name: &'static str, value: f64) {
        self.settings.want(name, value);
    }

    /// Sets the state of the radio link; `vehicle` distinguishes the links of one flight.
    pub fn set_radio(&mut self, fault: RadioFault, vehicle: VehicleId) {
        self.channel.set(fault, u64::from(vehicle));
    }

    /// Begins or ends a test of the radio.
    pub fn test_radio(&mut self, test: Option<RadioTest>, vehicle: VehicleId, now: Duration) {
        self.bench.set(test, vehicle, now);
    }

    /// The test of the radio; `None` without one.
    pub fn tested(&self, now: Duration) -> Option<TestedRadio> {
        self.bench.tested(now)
    }

    /// Whether a radio under test needs attention at short intervals.
    pub fn is_under_test(&self) -> bool {
        !self.bench.is_clear()
    }

    /// Whether the radio link is cut, even for the console's heartbeats.
    pub fn is_cut(&self) -> bool {
        self.channel.is_cut()
    }

    /// Whether the radio link is perfect, nothing is in transit, and all parameters are set.
    pub fn are_settled(&self) -> bool {
        self.channel.is_clear() && self.settings.are_settled()
    }

    /// Accepts a frame of the vehicle's system. Returns whether it has arrived; otherwise it is in transit or lost, and
    /// a lost position is noted in the model.
    pub fn hear(&mut self, frame: &Frame, vehicle: &mut Vehicle, now: Duration) -> bool {
        if frame.component == vehicle.component && frame.is_verified() {
            self.settings.receive(frame);
        }
        if !self.bench.is_clear() {
            self.bench.hear(frame, now);
            return false;
        }
        if self.channel.is_clear() {
            return true;
        }
        if !self.channel.hear(frame, now)
            && let Some(unheard) = radio::position(frame)
        {
            vehicle.unheard = Some(unheard);
        }
        false
    }

    /// The next frame that has arrived after its transit.
    pub fn arrived(&mut self, now: Duration) -> Option<Frame> {
        self.bench
            .arrived(now)
            .or_else(|| self.channel.arrived(now))
    }

    /// Advances the setting of parameters.
    pub fn poll(&mut self, vehicle: &Vehicle, now: Duration) {
        self.beside.extend(self.settings.poll(vehicle, now));
    }

    /// Sets all parameters again, because the vehicle has rebooted.
    pub fn begin_anew(&mut self) {
        self.settings.forget();
    }

    /// Passes messages to the vehicle through the radio; returns those that leave now.
    pub fn pass(&mut self, messages: Vec<Outgoing>, now: Duration) -> Vec<Outgoing> {
        let messages = if self.bench.is_clear() {
            messages
        } else {
            self.bench.say(messages, now)
        };
        if self.channel.is_clear() && self.beside.is_empty() {
            return messages;
        }
        let mut there = self.channel.say(messages, now);
        there.append(&mut self.beside);
        there
    }
}
