//! `sortie bench sim`: the cost of simulated vehicles, from one to thousands.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Args;
use mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, CopterMode, MavCmd, MavFrame, MavMessage, PositionTargetTypemask, RoverMode,
    SET_POSITION_TARGET_LOCAL_NED_DATA,
};
use nix::time::{ClockId, clock_gettime};
use serde::Serialize;

use super::super::Failure;
use super::super::sim::parse_kind;
use crate::geo::LatLon;
use crate::link::step_on_threads;
use crate::sim::{PortId, Start, VehicleKind, World, WorldConfig};
use crate::wire::{Decoder, Encoder};

/// The time after which the vehicles are in flight.
const WARM_UP: Duration = Duration::from_secs(30);
/// The streamed messages: `GLOBAL_POSITION_INT` and `ATTITUDE`.
const STREAMED: [u32; 2] = [33, 30];
const RATE_HZ: u64 = 10;
/// The output of this many steps is collected before it is counted.
const STEPS_PER_COUNT: u64 = 100;
/// How far rovers drive, in metres, and the speed of one that drives, in m/s.
const FAR_M: f32 = 10_000.0;
const DRIVING_M_S: f64 = 0.5;

/// Options of `sortie bench sim`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie bench sim\n  \
    sortie bench sim --kind copter --kind rover --vehicles 2000\n  \
    sortie bench sim --vehicles 500,5000 --seconds 10 --json")]
pub(in crate::cli) struct BenchSimArguments {
    /// Fly this many vehicles, with one measurement for each number.
    #[arg(long, value_delimiter = ',', default_value = "1,10,100,1000,2000",
        value_parser = clap::value_parser!(u16).range(1..=5000))]
    vehicles: Vec<u16>,
    /// Measure for this many simulated seconds, after 30 s in which the vehicles take off.
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=600))]
    seconds: u64,
    /// Move this kind of vehicle: copter, rover, rover-skid or motorboat. Repeat the option for several kinds, which take
    /// turns.
    #[arg(long = "kind", value_name = "KIND", value_parser = parse_kind)]
    kinds: Vec<VehicleKind>,
    /// Step the vehicles in this many threads.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=64))]
    threads: u8,
    /// Print one JSON document instead of the table.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct SimCost {
    vehicles: u16,
    us_per_vehicle_step: f64,
    core_percent: f64,
    core_percent_per_vehicle: f64,
    realtime_factor: f64,
}

pub(in crate::cli) fn sim(options: &BenchSimArguments) -> Result<ExitCode, Failure> {
    let measured = options
        .vehicles
        .iter()
        .map(|&vehicles| measure(vehicles, options))
        .collect::<Result<Vec<_>, _>>()?;
    if options.json {
        say!("{}", serde_json::to_string(&measured)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    say!("vehicles  us/vehicle-step  % of a core  % per vehicle  x real time")?;
    for row in measured {
        say!(
            "{:>8}  {:>15.3}  {:>11.3}  {:>13.5}  {:>11.1}",
            row.vehicles,
            row.us_per_vehicle_step,
            row.core_percent,
            row.core_percent_per_vehicle,
            row.realtime_factor
        )?;
    }
    Ok(ExitCode::SUCCESS)
}

fn measure(vehicles: u16, options: &BenchSimArguments) -> Result<SimCost, Failure> {
    let mut swarm = SimSwarm::moving(vehicles, options);
    let steps = options.seconds * 100;
    let (mut cpu, mut wall) = (Duration::ZERO, Duration::ZERO);
    let mut output = Vec::new();
    let mut heard = 0;
    for _ in 0..steps / STEPS_PER_COUNT {
        let (cpu_before, wall_before) = (processor_time()?, Instant::now());
        for _ in 0..STEPS_PER_COUNT {
            swarm.step(&mut output);
        }
        wall += wall_before.elapsed();
        cpu += processor_time()?.saturating_sub(cpu_before);
        heard += count_streamed(&mut output);
    }
    swarm.check(heard, options.seconds)?;
    let vehicle_steps = f64::from(vehicles) * steps as f64;
    let simulated_s = options.seconds as f64;
    let core_percent = cpu.as_secs_f64() / simulated_s * 100.0;
    Ok(SimCost {
        vehicles,
        us_per_vehicle_step: cpu.as_secs_f64() * 1e6 / vehicle_steps,
        core_percent,
        core_percent_per_vehicle: core_percent / f64::from(vehicles),
        realtime_factor: simulated_s / wall.as_secs_f64(),
    })
}

/// An order to all vehicles.
#[derive(Debug, Clone, Copy)]
enum Order {
    /// Stream a message, by its id.
    Stream(u32),
    Guided,
    Arm,
    /// Take off, or drive to a far place.
    SetOff,
}

impl Order {
    fn message(self, kind: VehicleKind) -> MavMessage {
        match self {
            Self::Stream(id) => {
                let interval_us = 1e6 / RATE_HZ as f32;
                long(
                    MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL,
                    [id as f32, interval_us, 0.0],
                )
            }
            Self::Guided => {
                let mode = match kind {
                    VehicleKind::Copter => CopterMode::COPTER_MODE_GUIDED as u8,
                    VehicleKind::Rover(_) => RoverMode::ROVER_MODE_GUIDED as u8,
                };
                long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, f32::from(mode), 0.0])
            }
            Self::Arm => long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0, 0.0]),
            Self::SetOff => match kind {
                VehicleKind::Copter => long(MavCmd::MAV_CMD_NAV_TAKEOFF, [0.0, 0.0, 20.0]),
                VehicleKind::Rover(_) => far_north(),
            },
        }
    }
}

/// A command with its parameters 1, 2 and 7.
fn long(command: MavCmd, [param1, param2, param7]: [f32; 3]) -> MavMessage {
    MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        param1,
        param2,
        param7,
        command,
        target_component: 1,
        ..Default::default()
    })
}

/// A place that no rover reaches during the measurement.
fn far_north() -> MavMessage {
    let place_only = PositionTargetTypemask::all()
        - PositionTargetTypemask::POSITION_TARGET_TYPEMASK_X_IGNORE
        - PositionTargetTypemask::POSITION_TARGET_TYPEMASK_Y_IGNORE
        - PositionTargetTypemask::POSITION_TARGET_TYPEMASK_Z_IGNORE
        - PositionTargetTypemask::POSITION_TARGET_TYPEMASK_FORCE_SET;
    MavMessage::SET_POSITION_TARGET_LOCAL_NED(SET_POSITION_TARGET_LOCAL_NED_DATA {
        x: FAR_M,
        type_mask: place_only,
        coordinate_frame: MavFrame::MAV_FRAME_LOCAL_NED,
        target_component: 1,
        ..Default::default()
    })
}

/// A world in which all vehicles move, with a ground station for each.
struct SimSwarm {
    world: World,
    ports: Vec<PortId>,
    kinds: Vec<VehicleKind>,
    threads: usize,
}

impl SimSwarm {
    /// Vehicles of the chosen kinds in turn.
    fn moving(vehicles: u16, options: &BenchSimArguments) -> Self {
        let kinds: &[_] = match options.kinds.as_slice() {
            [] => &[VehicleKind::Copter],
            chosen => chosen,
        };
        let first = Start {
            at: LatLon::new(50.4501, 30.5234),
            altitude_amsl_m: 180.0,
            heading_deg: 0.0,
        };
        let vehicles = usize::from(vehicles);
        let kinds: Vec<_> = kinds.iter().copied().cycle().take(vehicles).collect();
        let mut world = World::new(&WorldConfig {
            kinds: kinds.clone(),
            ..WorldConfig::row(vehicles, first)
        });
        let ports = (0..vehicles)
            .map(|vehicle| world.connect(vehicle))
            .collect();
        let mut swarm = Self {
            world,
            ports,
            kinds,
            threads: usize::from(options.threads),
        };
        swarm.set_off();
        swarm
    }

    fn set_off(&mut self) {
        let streams = STREAMED.map(|id| (2, Order::Stream(id)));
        let orders = [(3, Order::Guided), (4, Order::Arm), (5, Order::SetOff)];
        let mut orders: Vec<_> = streams.into_iter().chain(orders).collect();
        orders.reverse();
        let mut output = Vec::new();
        while self.world.now() < WARM_UP {
            while let Some((_, order)) =
                orders.pop_if(|(at_s, _)| Duration::from_secs(*at_s) <= self.world.now())
            {
                self.give(order);
            }
            self.step(&mut output);
            output.clear();
        }
    }

    fn give(&mut self, order: Order) {
        for (&port, &kind) in self.ports.iter().zip(&self.kinds) {
            let mut bytes = Vec::new();
            Encoder::new(255, 190).encode_message(&order.message(kind), &mut bytes);
            self.world.receive(port, &bytes);
        }
    }

    fn step(&mut self, output: &mut Vec<u8>) {
        step_on_threads(&mut self.world, self.threads);
        for &port in &self.ports {
            self.world.take_output(port, output);
        }
    }

    /// Whether a copter flies, or a rover drives.
    fn moves(&self, vehicle: usize) -> bool {
        let truth = self.world.truth(vehicle);
        match self.kinds[vehicle] {
            VehicleKind::Copter => !truth.on_ground,
            VehicleKind::Rover(_) => truth.velocity_ned_m_s[0] > DRIVING_M_S,
        }
    }

    /// Checks that the measurement is valid: all vehicles move, and no streamed message is missing.
    fn check(&self, heard: u64, seconds: u64) -> Result<(), Failure> {
        let vehicles = self.world.vehicles();
        let moving = (0..vehicles).filter(|&vehicle| self.moves(vehicle)).count();
        let expected = vehicles as u64 * seconds * RATE_HZ * STREAMED.len() as u64;
        // At either end, a message may fall just outside the measurement.
        let tolerated = vehicles as u64 * STREAMED.len() as u64;
        if moving == vehicles && heard.abs_diff(expected) <= tolerated {
            return Ok(());
        }
        Err(Failure::Failed(anyhow::anyhow!(
            "the measurement is void: {moving} of {vehicles} vehicles fly or drive, and {heard} of {expected} messages arrived"
        )))
    }
}

/// Counts the requested messages, and empties the buffer.
fn count_streamed(output: &mut Vec<u8>) -> u64 {
    let mut decoder = Decoder::new();
    let mut count = 0;
    for piece in output.chunks(1 << 16) {
        decoder.push(piece);
        while let Some(frame) = decoder.next_frame() {
            count += u64::from(STREAMED.contains(&frame.content.id()));
        }
    }
    output.clear();
    count
}

/// Processor time of all threads of this process, including ended ones.
fn processor_time() -> Result<Duration, Failure> {
    let time = clock_gettime(ClockId::CLOCK_PROCESS_CPUTIME_ID).map_err(anyhow::Error::from)?;
    Ok(Duration::from(time))
}
