//! The reception of one vehicle: its telemetry is counted and requested, and the round trip of its link measured.
//!
//! It is apart because it fills only the link in the model of the vehicle, and starts again whenever the vehicle or its
//! link comes back, whatever else the session does.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;

use super::hearing::Hearing;
use super::output::Output;
use super::streams::{Stream, Streams, WANTED_STREAMS};
use super::timesync::Timesync;
use crate::notice::Notice;
use crate::vehicle::Vehicle;
use crate::wire::{Frame, Outgoing};

/// Counts the messages of one vehicle, and requests those that are missing.
#[derive(Debug, Clone)]
pub(super) struct Reception {
    hearing: Hearing,
    streams: Streams,
    timesync: Timesync,
}

impl Reception {
    /// A reception that begins now, and requests the console's usual telemetry.
    pub fn new(now: Duration) -> Self {
        Self {
            hearing: Hearing::default(),
            streams: Streams::new(WANTED_STREAMS, now),
            timesync: Timesync::default(),
        }
    }

    /// Requests these streams instead of the console's usual telemetry.
    pub fn want(&mut self, streams: &'static [Stream], now: Duration) {
        self.streams = Streams::new(streams, now);
    }

    /// Measures and requests the telemetry anew: a reconnection or a reboot may have reset its rates.
    pub fn begin_anew(&mut self, now: Duration) {
        self.streams.forget(now);
    }

    /// Counts a frame of the vehicle's autopilot; returns a notice if the vehicle was lost before.
    pub fn hear(&mut self, frame: &Frame, vehicle: &mut Vehicle, now: Duration) -> Option<Notice> {
        let back = self.hearing.hear(frame, vehicle, now);
        if frame.is_verified() {
            self.streams.note(frame.content.id());
        }
        if back.is_some() {
            self.begin_anew(now);
        }
        back
    }

    /// Handles a message of the autopilot about the time: notes the round trip, or returns the reply to its request.
    pub fn receive(
        &mut self,
        message: &MavMessage,
        vehicle: &mut Vehicle,
        now: Duration,
    ) -> Option<Outgoing> {
        let (reply, round_trip) = self.timesync.receive(message, vehicle.system, now);
        if round_trip.is_some() {
            vehicle.link.round_trip = round_trip;
        }
        reply
    }

    /// Sends the requests that are due; returns the `MAV_CMD` of each acknowledgement that may follow.
    pub fn poll(&mut self, vehicle: &Vehicle, now: Duration, output: &mut Output) -> Vec<u16> {
        let question = self.timesync.poll(vehicle.address(), now);
        let due = self.streams.poll(vehicle, now).into_iter();
        let (requests, commands): (Vec<Outgoing>, Vec<u16>) = due.unzip();
        output.messages.extend(question.into_iter().chain(requests));
        commands
    }
}
