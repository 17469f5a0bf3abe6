//! Flying a vehicle by keys: the positions of the sticks.

use std::time::Duration;

use crate::commands::CENTRE_US;
use crate::vehicle::{HeldChannels, VehicleId};

/// How far a key deflects a stick, in microseconds.
const DEFLECTION_US: u16 = 200;
/// A stick returns to the centre this long after the first press of its key; keyboards begin to repeat within this time.
const PRESSED_FOR: Duration = Duration::from_millis(600);
/// A stick returns to the centre this long after the last repetition.
const REPEATED_FOR: Duration = Duration::from_millis(250);

/// A stick's axis, in the order of the transmitter's channels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StickAxis {
    Roll,
    Pitch,
    Throttle,
    Yaw,
}

impl StickAxis {
    /// All axes, in the order of their channels.
    pub const ALL: [Self; 4] = [Self::Roll, Self::Pitch, Self::Throttle, Self::Yaw];
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Deflection {
    /// Whether its pulses are longer than those of the centre.
    up: bool,
    until: Duration,
}

/// The sticks of a vehicle that is flown by keys.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StickMode {
    vehicle: VehicleId,
    axes: [Option<Deflection>; 4],
    /// When the positions are sent again.
    due: Duration,
}

impl StickMode {
    /// All sticks centred; their positions are sent at once.
    pub(in crate::app) fn new(vehicle: VehicleId) -> Self {
        Self {
            vehicle,
            axes: [None; 4],
            due: Duration::ZERO,
        }
    }

    pub fn vehicle(&self) -> VehicleId {
        self.vehicle
    }

    /// The pulse width of a stick, in microseconds.
    pub fn pulse_us(&self, axis: StickAxis) -> u16 {
        match self.axes[axis as usize] {
            None => CENTRE_US,
            Some(stick) if stick.up => CENTRE_US + DEFLECTION_US,
            Some(_) => CENTRE_US - DEFLECTION_US,
        }
    }

    /// All sticks as held channels.
    pub fn held(&self) -> HeldChannels {
        let mut held = HeldChannels::default();
        for axis in StickAxis::ALL {
            held.hold(axis as usize, self.pulse_us(axis));
        }
        held
    }

    /// Deflects a stick, until its key is no longer repeated.
    pub(in crate::app) fn press(&mut self, axis: StickAxis, up: bool, now: Duration) {
        let slot = &mut self.axes[axis as usize];
        let is_repeated = slot.is_some_and(|stick| stick.up == up && now < stick.until);
        let lasting = if is_repeated {
            REPEATED_FOR
        } else {
            PRESSED_FOR
        };
        let until = now + lasting;
        *slot = Some(Deflection { up, until });
        self.due = now;
    }

    /// Centres all sticks at once.
    pub(in crate::app) fn centre(&mut self, now: Duration) {
        self.axes = [None; 4];
        self.due = now;
    }

    /// Centres sticks whose keys are released; returns whether the positions are to be sent, at least every `every`.
    pub(in crate::app) fn tick(&mut self, now: Duration, every: Duration) -> bool {
        for slot in &mut self.axes {
            if slot.is_some_and(|stick| now >= stick.until) {
                *slot = None;
                self.due = now;
            }
        }
        let is_due = now >= self.due;
        if is_due {
            self.due = now + every;
        }
        is_due
    }
}
