//! `sortie bench decode`: the cost of one telemetry packet.

use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Args;
use mavlink::MavlinkReader;
use mavlink::dialects::ardupilotmega::MavMessage;
use serde::Serialize;

use super::super::Failure;
use crate::commands::Act;
use crate::geo::LatLon;
use crate::language::{self, Context, Meaning};
use crate::ledger::EntryId;
use crate::link::TlogReader;
use crate::messages::Inbox;
use crate::session::{Session, VehicleCommand};
use crate::sim::{Start, World, WorldConfig};
use crate::vehicle::Vehicle;
use crate::wire::{
    AUTOPILOT_COMPONENT, Decoder, Encoder, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM,
};

/// Time per message in Table 2 of the paper that this program follows.
const PAPER_NS_PER_MESSAGE: f64 = 24_500.0;
/// The number of measurements of each variant, in rotation; the fastest one counts, since it was
/// disturbed the least.
const ROUNDS: usize = 7;

/// Options of `sortie bench decode`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie bench decode\n  \
    sortie bench decode flight.tlog --json")]
pub(in crate::cli) struct DecodeArguments {
    /// A recording (tlog); without one, a flight of the embedded simulator is recorded first.
    file: Option<PathBuf>,
    /// Print one JSON document instead of the table.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct DecodeCost {
    messages: u64,
    ns_per_message: f64,
    floor_ns_per_message: f64,
}

pub(in crate::cli) fn decode(options: &DecodeArguments) -> Result<ExitCode, Failure> {
    let bytes = match &options.file {
        Some(path) => frames_of(path)?,
        None => embedded_flight(),
    };
    let mut floor = Duration::MAX;
    let mut whole = Duration::MAX;
    let mut messages = 0;
    for _ in 0..ROUNDS {
        floor = floor.min(time(|| messages = find_frames(&bytes)));
        whole = whole.min(time(|| messages = update_models(&bytes)));
    }
    if messages == 0 {
        return Err(Failure::Failed(anyhow::anyhow!(
            "the recording has no MAVLink frame"
        )));
    }
    let per_message = |time: Duration| time.as_nanos() as f64 / messages as f64;
    let result = DecodeCost {
        messages,
        ns_per_message: per_message(whole),
        floor_ns_per_message: per_message(floor),
    };
    if options.json {
        say!("{}", serde_json::to_string(&result)?)?;
    } else {
        say!("messages                      {messages:>10}")?;
        say!(
            "decode and model update       {:>10.0} ns per message",
            result.ns_per_message
        )?;
        say!(
            "floor: find and check frames  {:>10.0} ns per message",
            result.floor_ns_per_message
        )?;
        say!(
            "paper, Table 2                {PAPER_NS_PER_MESSAGE:>10.0} ns per message ({:.0} times as much)",
            PAPER_NS_PER_MESSAGE / result.ns_per_message
        )?;
    }
    Ok(ExitCode::SUCCESS)
}

fn time(work: impl FnOnce()) -> Duration {
    let started = Instant::now();
    work();
    started.elapsed()
}

fn frames_of(path: &PathBuf) -> Result<Vec<u8>, Failure> {
    let file = File::open(path).map_err(|error| {
        Failure::Invalid(format!("sortie: cannot read {}: {error}", path.display()))
    })?;
    let mut bytes = Vec::new();
    for record in TlogReader::new(BufReader::new(file)) {
        bytes.extend_from_slice(&record?.bytes);
    }
    Ok(bytes)
}

/// Two minutes of one simulated vehicle that flies a leg, with the streams that the console requests.
fn embedded_flight() -> Vec<u8> {
    let start = Start {
        at: LatLon::new(50.4501, 30.5234),
        altitude_amsl_m: 180.0,
        heading_deg: 0.0,
    };
    let mut world = World::new(&WorldConfig::row(1, start));
    let port = world.connect(0);
    let mut session = Session::new(1, AUTOPILOT_COMPONENT, Duration::ZERO);
    let mut encoder = Encoder::new(GROUND_STATION_SYSTEM, GROUND_STATION_COMPONENT);
    let mut decoder = Decoder::new();
    let mut recorded = Vec::new();
    let mut lines = FLIGHT.iter().peekable();
    while world.now() < FLIGHT_LASTS {
        world.step();
        let now = world.now();
        let mut heard = Vec::new();
        world.take_output(port, &mut heard);
        decoder.push(&heard);
        recorded.append(&mut heard);
        while let Some(frame) = decoder.next_frame() {
            session.receive(&frame, now);
        }
        while let Some((_, line)) = lines.next_if(|(at_s, _)| Duration::from_secs(*at_s) <= now) {
            give(&mut session, line, now);
        }
        session.poll(now);
        let mut said = Vec::new();
        for message in session.take_outgoing() {
            encoder.encode(&message, &mut said);
        }
        world.receive(port, &said);
    }
    recorded
}

/// Lines of the embedded flight, and the seconds after which they are entered.
const FLIGHT: [(u64, &str); 4] = [
    (3, "guided"),
    (4, "arm"),
    (6, "takeoff 20"),
    (20, "goto n 500 e 0 up 30"),
];
const FLIGHT_LASTS: Duration = Duration::from_secs(120);

fn give(session: &mut Session, line: &str, now: Duration) {
    if let Ok(statement) = language::parse(line, &Context::default())
        && let Meaning::Act(Act::Command(command)) = statement.meaning
    {
        session.order(
            VehicleCommand::new(EntryId(0), statement.verb, command),
            now,
        );
    }
}

/// The baseline: the mavlink crate's reader finds frames and checks their checksums, without
/// decoding.
fn find_frames(bytes: &[u8]) -> u64 {
    let mut reader = MavlinkReader::new(bytes);
    let mut frames = 0;
    while let Ok(frame) = reader.read_any_raw_message::<MavMessage>() {
        frames += 1;
        std::hint::black_box(&frame);
    }
    frames
}

fn update_models(bytes: &[u8]) -> u64 {
    let mut decoder = Decoder::new();
    let mut inbox = Inbox::new();
    let mut vehicle = Vehicle::new(1, 1);
    let mut notices = Vec::new();
    let mut frames = 0;
    for chunk in bytes.chunks(1400) {
        decoder.push(chunk);
        while let Some(frame) = decoder.next_frame() {
            frames += 1;
            let now = Duration::from_millis(frames);
            inbox.apply(&mut vehicle, &frame, now, &mut notices);
        }
        notices.clear();
    }
    std::hint::black_box(&vehicle);
    frames
}
