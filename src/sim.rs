//! The embedded simulator: `ArduCopters` that speak `MAVLink`, stepped by hand.
//!
//! A [`World`] holds vehicles. Ground stations [`connect`](World::connect) to one of them, push bytes in and take
//! bytes out; nothing else goes in or out, so a program cannot tell the simulator from a SITL behind a socket. The
//! world is a function of its configuration, the bytes it received and the steps between them.
//!
//! How the parts fit: `port` frames and paces, `inbound` understands, `commands` and `targets` act on the
//! `autopilot`, whose current `task` steers the path of `control` that the `body` follows; `telemetry` reports.
//! Behaviour and figures follow an `ArduCopter` 4.6 SITL. Missions, fences, rally points, logs and signing are not
//! simulated, and the vehicle does not claim them.

mod arming;
mod autopilot;
mod battery;
mod body;
mod commands;
mod control;
mod failsafe;
mod inbound;
mod leg;
mod mission;
mod mode;
mod parameters;
#[expect(dead_code, reason = "the lists are filled and flown next")]
mod plan;
mod port;
mod schedule;
mod switching;
mod targets;
mod task;
mod telemetry;
mod texts;
mod wind;
mod yaw;

#[cfg(test)]
mod tests;

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;

use self::autopilot::Autopilot;
use self::port::Port;
use self::wind::Wind;
use crate::geo::{LatLon, wrap_360};

/// The fixed time step of [`World::step`].
pub const STEP: Duration = Duration::from_millis(10);
/// How far apart the vehicles of a row stand.
const ROW_SPACING_M: f64 = 5.0;
/// Vehicles have the system ids 1 to 254 (255 is the ground station's); further vehicles begin again at 1 and can
/// only be told apart by their ports.
const SYSTEMS: usize = 254;

/// What a world consists of.
#[derive(Debug, Clone, PartialEq)]
pub struct WorldConfig {
    /// One start per vehicle; the first has system id 1.
    pub starts: Vec<Start>,
    /// Seed of everything random (gusts).
    pub seed: u64,
}

impl WorldConfig {
    /// Vehicles side by side to the east, 5 m apart, seed 0.
    pub fn row(vehicles: usize, first: Start) -> Self {
        let starts = (0..vehicles)
            .map(|place| Start {
                at: first.at.moved(0.0, ROW_SPACING_M * place as f64),
                ..first
            })
            .collect();
        Self { starts, seed: 0 }
    }
}

/// Where a vehicle stands when it is switched on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Start {
    /// The place.
    pub at: LatLon,
    /// Height of the ground there, metres above mean sea level.
    pub altitude_amsl_m: f64,
    /// Where the nose points, degrees clockwise from north.
    pub heading_deg: f64,
}

/// A connection of a ground station to a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PortId {
    vehicle: usize,
    serial: u64,
}

/// What really is the case, whatever the telemetry says: for tests and benches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Truth {
    /// Where the vehicle is.
    pub at: LatLon,
    /// Metres above mean sea level.
    pub altitude_amsl_m: f64,
    /// Metres north, east and down from the start.
    pub position_ned_m: [f64; 3],
    /// Metres per second north, east and down.
    pub velocity_ned_m_s: [f64; 3],
    /// Degrees; positive to the right.
    pub roll_deg: f64,
    /// Degrees; positive nose up.
    pub pitch_deg: f64,
    /// Degrees clockwise from north, 0 to 360.
    pub heading_deg: f64,
    /// Whether the motors are armed.
    pub armed: bool,
    /// Whether the vehicle touches the ground.
    pub on_ground: bool,
    /// `ArduCopter`'s `custom_mode`.
    pub mode: u8,
    /// Volts.
    pub battery_voltage_v: f64,
    /// Amperes.
    pub battery_current_a: f64,
    /// Milliampere hours drawn since boot.
    pub battery_consumed_mah: f64,
    /// Throttle, 0 to 1.
    pub throttle: f64,
}

#[derive(Debug)]
struct Slot {
    autopilot: Autopilot,
    ports: Vec<(u64, Port)>,
}

/// Vehicles and the ground stations on them.
#[derive(Debug)]
pub struct World {
    slots: Vec<Slot>,
    next_serial: u64,
    steps: u64,
}

impl World {
    /// Switches the vehicles on. Beyond 254 vehicles the system ids begin again at 1.
    pub fn new(config: &WorldConfig) -> Self {
        let slots = config
            .starts
            .iter()
            .enumerate()
            .map(|(vehicle, start)| Slot {
                autopilot: Autopilot::new(
                    (vehicle % SYSTEMS) as u8 + 1,
                    *start,
                    Wind::new(config.seed, vehicle as u64),
                ),
                ports: Vec::new(),
            })
            .collect();
        Self {
            slots,
            next_serial: 0,
            steps: 0,
        }
    }

    /// How many vehicles there are.
    pub fn vehicles(&self) -> usize {
        self.slots.len()
    }

    /// Simulated time since the world began.
    pub fn now(&self) -> Duration {
        STEP * u32::try_from(self.steps).unwrap_or(u32::MAX)
    }

    /// Attaches a ground station to a vehicle, counted from 0. A port to a vehicle that does not exist is closed
    /// from the start.
    pub fn connect(&mut self, vehicle: usize) -> PortId {
        let serial = self.next_serial;
        self.next_serial += 1;
        if let Some(slot) = self.slots.get_mut(vehicle) {
            let port = Port::new(slot.autopilot.system, slot.autopilot.uptime());
            slot.ports.push((serial, port));
        }
        PortId { vehicle, serial }
    }

    /// Detaches a ground station. The vehicle flies on.
    pub fn disconnect(&mut self, port: PortId) {
        if let Some(slot) = self.slots.get_mut(port.vehicle) {
            slot.ports.retain(|(serial, _)| *serial != port.serial);
        }
    }

    /// Whether the connection stands; a vehicle that reboots drops its connections.
    pub fn is_open(&self, port: PortId) -> bool {
        self.slots
            .get(port.vehicle)
            .and_then(|slot| slot.ports.iter().find(|(serial, _)| *serial == port.serial))
            .is_some_and(|(_, port)| port.open)
    }

    /// Hands bytes to the vehicle. It handles them at once: the answers are ready for
    /// [`take_output`](Self::take_output).
    pub fn receive(&mut self, port: PortId, bytes: &[u8]) {
        if let Some(slot) = self.slots.get_mut(port.vehicle) {
            let place = slot
                .ports
                .iter()
                .position(|(serial, _)| *serial == port.serial);
            if let Some(place) = place {
                slot.with_port(place, |own, autopilot| own.receive(autopilot, bytes));
            }
        }
    }

    /// Advances every vehicle by [`STEP`] and sends what is due.
    pub fn step(&mut self) {
        self.steps += 1;
        for slot in &mut self.slots {
            slot.step();
        }
    }

    /// Moves the bytes that wait for a ground station to the end of `into`. At most 256 KiB wait; beyond that whole
    /// frames are lost, telemetry first.
    pub fn take_output(&mut self, port: PortId, into: &mut Vec<u8>) {
        if let Some(slot) = self.slots.get_mut(port.vehicle) {
            for (serial, own) in &mut slot.ports {
                if *serial == port.serial {
                    own.take_output(into);
                }
            }
        }
    }

    /// The truth about a vehicle, counted from 0.
    ///
    /// # Panics
    /// If there is no such vehicle ([`vehicles`](Self::vehicles) tells how many there are).
    pub fn truth(&self, vehicle: usize) -> Truth {
        truth_of(&self.slots[vehicle].autopilot)
    }
}

impl Slot {
    /// Works with one open port; what the vehicle then says to everybody reaches the others too.
    fn with_port(
        &mut self,
        place: usize,
        work: impl FnOnce(&mut Port, &mut Autopilot) -> Vec<MavMessage>,
    ) {
        let Some((_, own)) = self.ports.get_mut(place).filter(|(_, port)| port.open) else {
            return;
        };
        let said = work(own, &mut self.autopilot);
        if said.is_empty() {
            return;
        }
        for (other, (_, port)) in self.ports.iter_mut().enumerate() {
            if other != place && port.open {
                port.broadcast(&said);
            }
        }
    }

    fn step(&mut self) {
        for place in 0..self.ports.len() {
            self.with_port(place, Port::end_of_burst);
        }
        let autopilot = &mut self.autopilot;
        autopilot.step();
        let said = std::mem::take(&mut autopilot.outbox);
        for (_, port) in &mut self.ports {
            if port.open {
                port.broadcast(&said);
                port.step(autopilot);
            }
        }
        if autopilot.take_reboot() {
            for (_, port) in &mut self.ports {
                port.open = false;
            }
        }
    }
}

fn truth_of(autopilot: &Autopilot) -> Truth {
    let body = &autopilot.body;
    let here = autopilot.here();
    let (roll, pitch) = body.roll_pitch_rad();
    Truth {
        at: here.at,
        altitude_amsl_m: here.altitude_amsl_m,
        position_ned_m: body.position_m.to_array(),
        velocity_ned_m_s: body.velocity_m_s.to_array(),
        roll_deg: roll.to_degrees(),
        pitch_deg: pitch.to_degrees(),
        heading_deg: wrap_360(body.yaw_deg),
        armed: autopilot.safety.armed,
        on_ground: body.on_ground,
        mode: autopilot.reported_mode(),
        battery_voltage_v: autopilot.tuning.battery_voltage_v,
        battery_current_a: autopilot.battery.current_a,
        battery_consumed_mah: autopilot.battery.consumed_mah,
        throttle: body.throttle,
    }
}
