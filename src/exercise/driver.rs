//! Decides when a mission begins, and which clock counts its time.

use std::time::Duration;

use crate::mission::{Clock, Flight, TICK};
use crate::vehicle::VehicleId;

/// The longest wait for a mission's vehicles to be heard.
const HEARD_WITHIN: Duration = Duration::from_secs(10);

/// The clock of mission time once the mission has begun.
#[derive(Debug, Clone)]
pub enum FlightPace {
    /// The driver's time, which is the simulator's.
    Simulated,
    /// The vehicles' own clocks: a slow computer slows the mission down with them.
    VehicleClocks(Clock),
}

/// Begins a flight and divides its time into ticks. Its owner steps the flight by each tick.
#[derive(Debug, Clone)]
pub struct FlightDriver {
    flight: Flight,
    pace: FlightPace,
    /// The time from which the vehicles are expected to be heard.
    awaited: Option<Duration>,
    begun: Option<Duration>,
    time: Duration,
    /// Mission time of the last tick.
    ticked: Duration,
}

impl FlightDriver {
    /// A flight that has not begun.
    pub fn new(flight: Flight, pace: FlightPace) -> Self {
        Self {
            flight,
            pace,
            awaited: None,
            begun: None,
            time: Duration::ZERO,
            ticked: Duration::ZERO,
        }
    }

    /// The flight, read only.
    pub fn flight(&self) -> &Flight {
        &self.flight
    }

    pub fn flight_mut(&mut self) -> &mut Flight {
        &mut self.flight
    }

    /// Whether the mission has begun.
    pub fn has_begun(&self) -> bool {
        self.begun.is_some()
    }

    /// Whether the mission has ended.
    pub fn is_over(&self) -> bool {
        self.flight.is_over()
    }

    /// Mission time; 0 until the mission begins.
    pub fn time(&self) -> Duration {
        self.time
    }

    /// Begins the mission once all its vehicles are heard, since a vehicle's payload depends on its
    /// place among them. A silent vehicle delays the mission by at most 10 s. Must be called
    /// repeatedly from the time when the vehicles start; returns true when the mission begins.
    pub fn begin_when_heard(&mut self, now: Duration, are_all_heard: bool) -> bool {
        if self.has_begun() {
            return false;
        }
        let awaited = *self.awaited.get_or_insert(now);
        if are_all_heard || now.saturating_sub(awaited) >= HEARD_WITHIN {
            self.begun = Some(now);
        }
        self.has_begun()
    }

    /// Advances mission time, and returns it. `clocks` are the vehicles' clocks
    /// ([`Vehicle::clock_ms`](crate::vehicle::Vehicle::clock_ms)), which are used only with
    /// [`FlightPace::VehicleClocks`].
    pub fn advance(
        &mut self,
        now: Duration,
        clocks: impl IntoIterator<Item = (VehicleId, Option<u32>)>,
    ) -> Duration {
        if let Some(begun) = self.begun {
            self.time = match &mut self.pace {
                FlightPace::Simulated => now.saturating_sub(begun),
                FlightPace::VehicleClocks(clock) => clock.step(now, clocks),
            };
        }
        self.time
    }

    /// The next tick of the flight that is due at a mission time; `None` after its end.
    pub fn tick(&mut self, until: Duration) -> Option<Duration> {
        if self.is_over() || self.ticked + TICK > until {
            return None;
        }
        self.ticked += TICK;
        Some(self.ticked)
    }
}
