//! `sortie bench sim`: the cost of simulated vehicles, from one to thousands.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Args;
use mavlink::dialects::ardupilotmega::{COMMAND_LONG_DATA, MavCmd, MavMessage};
use nix::time::{ClockId, clock_gettime};
use serde::Serialize;

use super::super::Failure;
use crate::geo::LatLon;
use crate::link::step_on_threads;
use crate::sim::{PortId, Start, World, WorldConfig};
use crate::wire::{Decoder, Encoder};

/// The time after which the vehicles are in flight.
const WARM_UP: Duration = Duration::from_secs(30);
/// The streamed messages: `GLOBAL_POSITION_INT` and `ATTITUDE`.
const STREAMED: [u32; 2] = [33, 30];
const RATE_HZ: u64 = 10;
/// The output of this many steps is collected before it is counted.
const STEPS_PER_COUNT: u64 = 100;

/// Options of `sortie bench sim`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie bench sim\n  \
    sortie bench sim --vehicles 500,5000 --seconds 10 --json")]
pub(in crate::cli) struct BenchSimArguments {
    /// Fly this many vehicles, with one measurement for each number.
    #[arg(long, value_delimiter = ',', default_value = "1,10,100,1000,2000",
        value_parser = clap::value_parser!(u16).range(1..=5000))]
    vehicles: Vec<u16>,
    /// Measure for this many simulated seconds, after 30 s in which the vehicles take off.
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=600))]
    seconds: u64,
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
    let mut swarm = SimSwarm::flying(vehicles, options.threads);
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

/// A world in which all vehicles fly, with a ground station for each.
struct SimSwarm {
    world: World,
    ports: Vec<PortId>,
    threads: usize,
}

impl SimSwarm {
    fn flying(vehicles: u16, threads: u8) -> Self {
        let first = Start {
            at: LatLon::new(50.4501, 30.5234),
            altitude_amsl_m: 180.0,
            heading_deg: 0.0,
        };
        let vehicles = usize::from(vehicles);
        let mut world = World::new(&WorldConfig::row(vehicles, first));
        let ports = (0..vehicles)
            .map(|vehicle| world.connect(vehicle))
            .collect();
        let mut swarm = Self {
            world,
            ports,
            threads: usize::from(threads),
        };
        swarm.take_off();
        swarm
    }

    fn take_off(&mut self) {
        let interval = |id: u32| {
            (
                MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL,
                [id as f32, 1e6 / RATE_HZ as f32, 0.0],
            )
        };
        let orders = [
            (3, MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0, 0.0]),
            (4, MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0, 0.0]),
            (5, MavCmd::MAV_CMD_NAV_TAKEOFF, [0.0, 0.0, 20.0]),
        ];
        let streams = STREAMED.map(interval).map(|(command, p)| (2, command, p));
        let mut orders: Vec<_> = streams.into_iter().chain(orders).collect();
        orders.reverse();
        let mut output = Vec::new();
        while self.world.now() < WARM_UP {
            while let Some((_, command, p)) =
                orders.pop_if(|(at_s, ..)| Duration::from_secs(*at_s) <= self.world.now())
            {
                self.order(command, p);
            }
            self.step(&mut output);
            output.clear();
        }
    }

    /// Gives every vehicle a command with its parameters 1, 2 and 7.
    fn order(&mut self, command: MavCmd, [param1, param2, param7]: [f32; 3]) {
        let message = MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            param1,
            param2,
            param7,
            command,
            target_component: 1,
            ..Default::default()
        });
        let mut bytes = Vec::new();
        Encoder::new(255, 190).encode_message(&message, &mut bytes);
        for &port in &self.ports {
            self.world.receive(port, &bytes);
        }
    }

    fn step(&mut self, output: &mut Vec<u8>) {
        step_on_threads(&mut self.world, self.threads);
        for &port in &self.ports {
            self.world.take_output(port, output);
        }
    }

    /// Checks that the measurement is valid: all vehicles are in the air, and no streamed message
    /// is missing.
    fn check(&self, heard: u64, seconds: u64) -> Result<(), Failure> {
        let vehicles = self.world.vehicles();
        let flying = (0..vehicles)
            .filter(|&vehicle| !self.world.truth(vehicle).on_ground)
            .count();
        let expected = vehicles as u64 * seconds * RATE_HZ * STREAMED.len() as u64;
        // At either end, a message may fall just outside the measurement.
        let tolerated = vehicles as u64 * STREAMED.len() as u64;
        if flying == vehicles && heard.abs_diff(expected) <= tolerated {
            return Ok(());
        }
        Err(Failure::Failed(anyhow::anyhow!(
            "the measurement is void: {flying} of {vehicles} vehicles fly, and {heard} of {expected} messages arrived"
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
