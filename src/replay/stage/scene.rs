//! The vehicles and the traffic of a recording at one moment.

use std::collections::BTreeMap;
use std::time::Duration;

use super::actor::Actor;
use super::traffic::Traffic;
use crate::app::event::Event;
use crate::app::room::messages::{LinkTraffic, TrafficRequest};
use crate::app::state::LinkSummary;
use crate::inspector::{Census, FrameWay};
use crate::record::LossLine;
use crate::replay::Film;
use crate::session::{Want, autopilot_of};
use crate::wire::{Decoder, GROUND_STATION_SYSTEM, SystemId};

/// The peer of all frames: a recording does not contain addresses.
const PEER: u32 = 0;

/// The vehicles that have been heard so far, and the traffic of the link.
#[derive(Debug, Clone, Default)]
pub(super) struct Scene {
    vehicles: BTreeMap<SystemId, Actor>,
    census: Census,
    traffic: Traffic,
}

impl Scene {
    /// Passes a frame to its vehicle and to the census.
    pub fn take_in(&mut self, bytes: &[u8], at: Duration) {
        let mut decoder = Decoder::new();
        decoder.push(bytes);
        let Some(frame) = decoder.next_frame() else {
            return;
        };
        let way = if frame.system == GROUND_STATION_SYSTEM {
            self.traffic.send(bytes);
            FrameWay::sent(PEER)
        } else {
            self.traffic.receive(bytes);
            FrameWay::received(PEER)
        };
        self.census.note(way, bytes, frame.is_verified(), at);
        let system = frame.system;
        if !self.vehicles.contains_key(&system)
            && let Some(component) = autopilot_of(&frame)
        {
            self.vehicles
                .insert(system, Actor::new(system, component, at));
        }
        if let Some(actor) = self.vehicles.get_mut(&system) {
            actor.session.receive(&frame, at);
        }
    }

    /// Handles a gap in the recording, in which no vehicle counts as silent.
    pub fn rest(&mut self, lasted: Duration) {
        for actor in self.vehicles.values_mut() {
            actor.session.rest(lasted);
        }
    }

    /// Sets the radio of a vehicle, through which its frames pass from then on.
    pub fn change_radio(&mut self, loss: &LossLine) {
        let system = SystemId::try_from(loss.vehicle).ok();
        if let Some(actor) = system.and_then(|it| self.vehicles.get_mut(&it)) {
            actor.session.carry_out(Want::Radio(loss.fault()));
        }
    }

    /// The vehicles' events since the last call; in a gap of the recording, no vehicle counts as
    /// silent.
    pub fn tell(&mut self, now: Duration, is_gap: bool) -> Vec<Event> {
        let actors = self.vehicles.values_mut();
        actors
            .flat_map(|actor| {
                if !is_gap {
                    actor.session.poll(now);
                }
                actor.tell()
            })
            .collect()
    }

    /// The state of the recording's link, once a second.
    pub fn summary(&mut self, film: &Film, now: Duration) -> Option<LinkSummary> {
        self.traffic.summary(film, now)
    }

    /// The current traffic, for the *Messages* room.
    pub fn inspect(
        &mut self,
        request: &TrafficRequest,
        name: String,
        now: Duration,
    ) -> LinkTraffic {
        let keys = request.watched.iter().map(|(_, key)| *key).collect();
        self.census.watch(&keys);
        self.census.reset_statistics(request.resets, now);
        LinkTraffic {
            name: name.into(),
            now,
            census: request.census.then(|| self.census.snapshot()),
            watched: self.census.take_watched(),
        }
    }
}
