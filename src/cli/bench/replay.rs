//! `sortie bench replay`: the cost of recording and replaying a flight.

use std::fs::{self, File};
use std::io::{self, BufWriter, Read as _, Write as _};
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Args;
use mavlink::dialects::ardupilotmega::{COMMAND_LONG_DATA, MavCmd, MavMessage};
use serde::Serialize;

use super::super::Failure;
use crate::app::effect::ReplayEffect;
use crate::config::Config;
use crate::geo::LatLon;
use crate::language::SeekTarget;
use crate::link::{FrameSink, TlogReader, TlogWriter};
use crate::replay::{FRAME, Replay};
use crate::sim::{PortId, Start, World, WorldConfig};
use crate::wire::{Decoder, Encoder, Outgoing, ground_station_heartbeat};

/// The number of jumps to moments.
const SEEKS: u32 = 200;
const START: Start = Start {
    at: LatLon::new(50.4501, 30.5234),
    altitude_amsl_m: 180.0,
    heading_deg: 0.0,
};
/// Messages that come ten times a second, as many as a ground station requests: `SYS_STATUS`, `GPS_RAW_INT`,
/// `RAW_IMU`, `ATTITUDE`, `LOCAL_POSITION_NED`, `GLOBAL_POSITION_INT`, `SERVO_OUTPUT_RAW`, `RC_CHANNELS`, `VFR_HUD`,
/// `POSITION_TARGET_GLOBAL_INT`, `BATTERY_STATUS`, `EKF_STATUS_REPORT`, `VIBRATION`.
const STREAMS: [f32; 13] = [
    1.0, 24.0, 27.0, 30.0, 32.0, 33.0, 36.0, 65.0, 74.0, 87.0, 147.0, 193.0, 241.0,
];
const STREAM_EVERY_US: f32 = 100_000.0;

/// Options of `sortie bench replay`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie bench replay\n  \
    sortie bench replay --vehicles 32 --minutes 60 --json")]
pub(in crate::cli) struct BenchReplayArguments {
    /// Record this many flying vehicles.
    #[arg(long, default_value_t = 32, value_parser = clap::value_parser!(u8).range(1..=250))]
    vehicles: u8,
    /// Record this many minutes.
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=600))]
    minutes: u32,
    /// Print one JSON document instead of the table.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct ReplayCost {
    vehicles: u8,
    record_s: f64,
    bytes: u64,
    frames: u64,
    /// Milliseconds until the console shows the beginning and accepts keys.
    open_ms: f64,
    index_s: f64,
    seek_ms_p50: f64,
    seek_ms_p99: f64,
    rss_mb: f64,
    recording_core_percent: f64,
    /// The time to record and write a frame, in nanoseconds; an unrecorded session does not need
    /// it.
    recording_frame_ns: f64,
}

/// Records flying vehicles, replays the recording, and prints the cost of both.
pub(in crate::cli) fn replay(options: &BenchReplayArguments) -> Result<ExitCode, Failure> {
    let folder = tempfile_in(&std::env::temp_dir())?;
    let path = folder.0.join("bench.tlog");
    let seconds = u64::from(options.minutes) * 60;
    record(options.vehicles, seconds, &path)?;
    let cost = measure(options.vehicles, seconds, &path)?;
    if options.json {
        say!("{}", serde_json::to_string(&cost)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    say!(
        "{} vehicles, {} min, {} MB",
        cost.vehicles,
        options.minutes,
        cost.bytes / 1_000_000
    )?;
    say!("open                 {:>9.1} ms", cost.open_ms)?;
    say!("indexed              {:>9.1} s", cost.index_s)?;
    say!("seek, median         {:>9.1} ms", cost.seek_ms_p50)?;
    say!("seek, 99 %           {:>9.1} ms", cost.seek_ms_p99)?;
    say!("memory               {:>9.0} MB", cost.rss_mb)?;
    say!(
        "recording            {:>9.2} % of a core",
        cost.recording_core_percent
    )?;
    say!("recording, a frame   {:>9.0} ns", cost.recording_frame_ns)?;
    Ok(ExitCode::SUCCESS)
}

/// A folder that is removed when dropped.
struct TemporaryFolder(std::path::PathBuf);

impl Drop for TemporaryFolder {
    fn drop(&mut self) {
        // A folder that cannot be removed stays among the temporary files.
        drop(fs::remove_dir_all(&self.0));
    }
}

fn tempfile_in(folder: &Path) -> io::Result<TemporaryFolder> {
    let path = folder.join(format!("sortie-bench-{}", std::process::id()));
    fs::create_dir(&path)?;
    Ok(TemporaryFolder(path))
}

/// Writes a recording of vehicles that take off and hover.
fn record(vehicles: u8, seconds: u64, path: &Path) -> io::Result<()> {
    let mut world = World::new(&WorldConfig::row(usize::from(vehicles), START));
    let ports: Vec<PortId> = (0..usize::from(vehicles))
        .map(|vehicle| world.connect(vehicle))
        .collect();
    let mut tlog = TlogWriter::new(BufWriter::new(File::create(path)?));
    let mut encoder = Encoder::new(255, 190);
    let mut decoder = Decoder::new();
    let mut output = Vec::new();
    for tick in 0..seconds * 10 {
        let unix_us = 1_700_000_000_000_000 + tick * 100_000;
        for message in said(tick, vehicles) {
            let mut bytes = Vec::new();
            encoder.encode(&message, &mut bytes);
            for &port in &ports {
                world.receive(port, &bytes);
            }
            tlog.write(unix_us, &bytes)?;
        }
        while world.now() < FRAME * (tick as u32 + 1) {
            world.step();
        }
        for &port in &ports {
            output.clear();
            world.take_output(port, &mut output);
            decoder.push(&output);
            while let Some(frame) = decoder.next_frame() {
                tlog.write(unix_us, decoder.bytes_of(&frame))?;
            }
        }
    }
    tlog.flush()
}

/// The ground station's messages in one tick of a tenth of a second.
fn said(tick: u64, vehicles: u8) -> Vec<Outgoing> {
    let mut said = Vec::new();
    if tick.is_multiple_of(10) {
        said.push(ground_station_heartbeat());
    }
    let asked = tick.checked_sub(20).and_then(|at| STREAMS.get(at as usize));
    let order = match (asked, tick) {
        (Some(&message), _) => (
            MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL,
            [message, STREAM_EVERY_US, 0.0],
        ),
        (None, 200) => (MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0, 0.0]),
        (None, 210) => (MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0, 0.0]),
        (None, 220) => (MavCmd::MAV_CMD_NAV_TAKEOFF, [0.0, 0.0, 20.0]),
        (None, _) => return said,
    };
    said.extend((1..=vehicles).map(|system| command(system, order.0, order.1)));
    said
}

/// A command with its first two parameters and its last.
fn command(system: u8, command: MavCmd, parameters: [f32; 3]) -> Outgoing {
    let [param1, param2, param7] = parameters;
    MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        command,
        target_system: system,
        target_component: 1,
        param1,
        param2,
        param7,
        ..COMMAND_LONG_DATA::default()
    })
    .into()
}

fn measure(vehicles: u8, seconds: u64, path: &Path) -> Result<ReplayCost, Failure> {
    let fault = |fault: crate::text::Text| Failure::Failed(anyhow::anyhow!("{fault}"));
    let began = Instant::now();
    let (mut replay, _) = Replay::open(path, &Config::default()).map_err(fault)?;
    drop(replay.tick(Duration::ZERO));
    let open = began.elapsed();
    replay.wait_for_index();
    let index = began.elapsed();
    let length = Duration::from_secs(seconds);
    let mut took: Vec<Duration> = (0..SEEKS)
        .map(|number| {
            // Scattered, but the same in each run.
            let share = f64::from(number) * 0.618_033_988_75 % 1.0;
            let target = SeekTarget::At(length.mul_f64(share));
            let began = Instant::now();
            drop(replay.steer(ReplayEffect::Seek(target)));
            while !replay.is_there() {
                drop(replay.tick(Duration::ZERO));
            }
            began.elapsed()
        })
        .collect();
    took.sort();
    let (recording, frames) = recording_time(path)?;
    Ok(ReplayCost {
        vehicles,
        record_s: length.as_secs_f64(),
        bytes: fs::metadata(path)?.len(),
        frames,
        open_ms: open.as_secs_f64() * 1e3,
        index_s: index.as_secs_f64(),
        seek_ms_p50: took[took.len() / 2].as_secs_f64() * 1e3,
        seek_ms_p99: took[took.len() * 99 / 100].as_secs_f64() * 1e3,
        rss_mb: resident_bytes()? as f64 / 1e6,
        recording_core_percent: recording.as_secs_f64() / length.as_secs_f64() * 100.0,
        recording_frame_ns: recording.as_secs_f64() / frames.max(1) as f64 * 1e9,
    })
}

/// The time to record and write all frames of a recording, a quarter of a second at a time; and the number of frames.
fn recording_time(path: &Path) -> Result<(Duration, u64), Failure> {
    let sink = FrameSink::new(|| 1_700_000_000_000_000);
    let mut copy = File::create(path.with_extension("copy"))?;
    let (mut spent, mut frames, mut written_us) = (Duration::ZERO, 0, 0);
    for record in TlogReader::new(io::BufReader::new(File::open(path)?)) {
        let record = record?;
        frames += 1;
        let began = Instant::now();
        sink.note(&record.bytes);
        if record.unix_us >= written_us + 250_000 {
            written_us = record.unix_us;
            copy.write_all(&sink.take().bytes)?;
        }
        spent += began.elapsed();
    }
    Ok((spent, frames))
}

/// Resident memory of this process in bytes (Linux: `VmRSS`).
fn resident_bytes() -> io::Result<u64> {
    let mut status = String::new();
    File::open("/proc/self/status")?.read_to_string(&mut status)?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    Ok(kilobytes.unwrap_or(0) * 1024)
}
