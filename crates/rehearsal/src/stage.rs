//! The world of a rehearsal, with all vehicles in lockstep.

use std::sync::Arc;

use sortie_geo::LatLon;
use sortie_plan::{ListKind, command};
use sortie_sim::{Airframe, BootPace, Met, STEP, World, WorldConfig, resting_voltage_v};

use crate::approach::Closest;
use crate::flight::{DISARM_DELAY, Flight};
use crate::late::late_s;
use crate::place::{Place, STEPS, TRACK_EVERY, Track, sample_s};
use crate::{Conditions, Heard, Outcome, Participant, RehearsalError};

/// The time in which the vehicles boot and find their position, in seconds.
const BOOT_S: f64 = 5.0;
pub(crate) struct Stage {
    world: World,
    flights: Vec<Flight>,
    /// Each vehicle's start relative to the origin of the rehearsal, in metres north and east.
    starts_m: Vec<[f64; 2]>,
    amsl_m: Vec<f64>,
    limit: u32,
    origin: LatLon,
}

impl Stage {
    /// The vehicles at their starts; points are measured from `origin`.
    ///
    /// # Errors
    /// A parameter is not known, or a vehicle refuses a list.
    pub(crate) fn new(
        participants: &[Participant],
        starts: &[Place],
        origin: LatLon,
        conditions: &Conditions,
    ) -> Result<Self, RehearsalError> {
        let mut world = World::new(&WorldConfig {
            starts: starts.iter().map(|place| place.start).collect(),
            airframes: participants.iter().map(airframe).collect(),
            kinds: Vec::new(),
            seed: conditions.seed,
            obstacles: Vec::new(),
            boot: BootPace::Quick,
        });
        let mut flights = Vec::new();
        for (vehicle, (participant, place)) in participants.iter().zip(starts).enumerate() {
            let mut flight = Flight::new(vehicle, participant, place, &mut world);
            carry_over(&mut flight, vehicle, participant, &mut world);
            prepare(&mut flight, vehicle, conditions, &mut world)?;
            if waits_armed(participant, conditions) {
                flight.keep_armed(&mut world);
            }
            flights.push(flight);
        }
        for _ in 0..(BOOT_S / STEP.as_secs_f64()) as u32 {
            world.step();
        }
        for (vehicle, (participant, place)) in participants.iter().zip(starts).enumerate() {
            for kind in ListKind::ALL {
                if !world.load(vehicle, kind, participant.document.list(kind)) {
                    return Err(RehearsalError::Refused(place.vehicle, kind));
                }
            }
            flights[vehicle].switch_fence(participant.fence_switch, &mut world);
        }
        let last = participants.iter().map(|it| it.delay_s);
        let metres = |place: &Place| origin.offset_to(place.start.at).into();
        Ok(Self {
            world,
            flights,
            starts_m: starts.iter().map(metres).collect(),
            amsl_m: starts
                .iter()
                .map(|place| place.start.altitude_amsl_m)
                .collect(),
            origin,
            limit: ((conditions.limit_s + last.fold(0.0, f64::max)) / sample_s()) as u32,
        })
    }

    pub(crate) fn run(self) -> Outcome {
        self.run_heard(None)
    }

    /// Flies the plans, and hands the telemetry to a listener if there is one.
    pub(crate) fn run_heard(mut self, mut listener: Option<&mut dyn FnMut(Heard<'_>)>) -> Outcome {
        if listener.is_some() {
            for flight in &mut self.flights {
                flight.listen(&mut self.world);
            }
        }
        let mut closest = Closest::new(&self.starts_m);
        let mut points = vec![None; self.flights.len()];
        let mut sample = 0;
        while sample < self.limit && !self.flights.iter().all(Flight::is_over) {
            for _ in 0..STEPS {
                self.world.step();
            }
            sample += 1;
            self.look(sample, &mut points);
            if let Some(listener) = &mut listener {
                self.hand_over(sample, listener);
            }
            closest.take(sample, &points);
            if sample.is_multiple_of(TRACK_EVERY) {
                for (flight, point) in self.flights.iter_mut().zip(&points) {
                    flight.track.points.push(*point);
                }
            }
        }
        let vehicles = self.flights.iter().map(Flight::flown).collect();
        let flights = self.flights.into_iter();
        let tracks: Vec<Track> = flights.map(|flight| flight.track).collect();
        let mut closest = closest.found(sample_s(), self.origin);
        for approach in &mut closest {
            approach.late_s = late_s(approach, &tracks, &self.starts_m);
        }
        Outcome {
            vehicles,
            closest,
            simulated_s: f64::from(sample) * sample_s(),
            tracks,
        }
    }

    fn hand_over(&mut self, sample: u32, listener: &mut dyn FnMut(Heard<'_>)) {
        let at_s = f64::from(sample) * sample_s();
        for (vehicle, flight) in self.flights.iter_mut().enumerate() {
            let bytes = flight.take_heard(&mut self.world);
            if !bytes.is_empty() {
                listener(Heard {
                    at_s,
                    vehicle,
                    bytes: &bytes,
                });
            }
        }
    }

    fn look(&mut self, sample: u32, points: &mut [Option<[f64; 3]>]) {
        // Before the flights are followed: a struck vehicle stops its motors, which is not a landing.
        for collision in self.world.collisions() {
            let other = match collision.with {
                Met::Vehicle(other) => Some(other),
                Met::Obstacle(_) => None,
            };
            for struck in [Some(collision.vehicle), other].into_iter().flatten() {
                if let Some(flight) = self.flights.get_mut(struck) {
                    flight.crash();
                }
            }
        }
        let starts = self.starts_m.iter().zip(&self.amsl_m);
        let flights = self.flights.iter_mut().zip(points).zip(starts);
        for (vehicle, ((flight, point), (start_m, amsl_m))) in flights.enumerate() {
            let is_in_air = flight.follow(sample, &mut self.world);
            let [north_m, east_m, down_m] = self.world.truth(vehicle).position_ned_m;
            *point =
                is_in_air.then_some([start_m[0] + north_m, start_m[1] + east_m, amsl_m - down_m]);
        }
    }
}

fn airframe(participant: &Participant) -> Arc<Airframe> {
    let own = participant.airframe.clone();
    own.unwrap_or_else(Airframe::shared_standard)
}

/// Sets the vehicle's own parameters, except those that the simulator lacks.
fn carry_over(flight: &mut Flight, vehicle: usize, participant: &Participant, world: &mut World) {
    for (name, value) in &participant.parameters {
        if world.find_parameter(vehicle, name).is_some() {
            flight.set_parameter(world, name, *value);
        }
    }
    if let Some(percent) = participant.charge_percent {
        let volts = resting_voltage_v(percent, &airframe(participant)) as f32;
        flight.set_parameter(world, "SIM_BATT_VOLTAGE", volts);
    }
}

/// Whether a plan begins with a wait on the ground, and no `DISARM_DELAY` is given.
fn waits_armed(participant: &Participant, conditions: &Conditions) -> bool {
    let items = participant.document.plan.iter();
    let mut before_takeoff = items.take_while(|item| !command::is_takeoff(item.command));
    let own = participant.parameters.iter().chain(&conditions.parameters);
    let mut names = own.map(|(name, _)| name.as_str());
    before_takeoff.any(|item| item.command == command::DELAY)
        && !names.any(|name| name == DISARM_DELAY)
}

/// Sets the parameters that are the same for all vehicles.
fn prepare(
    flight: &mut Flight,
    vehicle: usize,
    conditions: &Conditions,
    world: &mut World,
) -> Result<(), RehearsalError> {
    let wind = [
        ("SIM_WIND_SPD", conditions.wind_m_s),
        ("SIM_WIND_DIR", conditions.wind_from_deg),
        ("SIM_WIND_TURB", conditions.turbulence),
    ];
    let own = conditions
        .parameters
        .iter()
        .map(|(name, value)| (name.as_str(), *value));
    for (name, value) in wind.into_iter().chain(own) {
        flight.set_parameter(world, name, value);
        let set = world.find_parameter(vehicle, name);
        let is_set = |set: f64| (set - f64::from(value)).abs() <= f64::from(value.abs()) * 1e-5;
        if !set.is_some_and(is_set) {
            return Err(RehearsalError::NoParameter(name.to_owned()));
        }
    }
    Ok(())
}
