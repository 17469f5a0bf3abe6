//! `sortie bench`: the measurements that docs/measurements.md quotes.
//!
//! # How the parts fit
//! - What the console costs: `decode` (a packet), `frame` (a drawing), `latency` (a key until it shows), `replay` (a
//!   record).
//! - What simulated flight costs: `sim`, `missions`, `load`, and `scale` for growing swarms.
//! - What a class costs: `class`, a desk with many seats.
//! - Whether the simulation is right: `fidelity`, beside recordings of the real vehicle; `campaign`, the whole
//!   course.
//! - What they share: `cost` reads processor time and memory, `terminal` runs a program in a pseudo-terminal.

use std::process::ExitCode;

use clap::Subcommand;

use super::Failure;
use super::settings::CliSettings;

mod campaign;
mod class;
mod cost;
mod decode;
mod fidelity;
mod frame;
mod latency;
mod load;
mod missions;
mod replay;
mod scale;
mod sim;
mod terminal;

/// The measurement to make.
#[derive(Debug, Subcommand)]
pub(super) enum BenchCommand {
    /// Flies the whole course with the reference pilots: scores, credits, level, licence and skills after each flight.
    Campaign(campaign::CampaignArguments),
    /// Measures the instructor's desk while trainees fly: its processor time and memory, the time from an order to its
    /// effect, and the age of the board.
    Class(class::BenchClassArguments),
    /// Measures decoding and model update per message, compared with a loop that only finds frames.
    Decode(decode::DecodeArguments),
    /// Compares the embedded simulator with recordings of the real vehicle, manoeuvre by manoeuvre.
    Fidelity(fidelity::FidelityArguments),
    /// Measures time and bytes per frame of the console, while a tenth of the vehicles changes.
    Frame(frame::FrameArguments),
    /// Measures the time from a key press to the bytes that show its effect, compared with a program that only echoes.
    Latency(latency::LatencyArguments),
    /// Measures the share of a core that the whole process uses while embedded vehicles fly.
    Load(load::LoadArguments),
    /// Measures how much faster than real time the reference pilots fly the shipped missions.
    Missions(missions::MissionsArguments),
    /// Measures a recording of flying vehicles: the time to open it, the time to show any moment of it, and the cost
    /// of recording.
    Replay(replay::BenchReplayArguments),
    /// Measures the cost of a growing number of vehicles for the simulator and the console, with the method of the
    /// paper.
    Scale(scale::ScaleArguments),
    /// Measures the cost of simulated vehicles that fly and stream position and attitude, from one to thousands.
    Sim(sim::BenchSimArguments),
}

pub(super) fn bench(bench: &BenchCommand, settings: &CliSettings) -> Result<ExitCode, Failure> {
    match bench {
        BenchCommand::Campaign(options) => campaign::campaign(options),
        BenchCommand::Class(options) => class::class(options),
        BenchCommand::Decode(options) => decode::decode(options),
        BenchCommand::Fidelity(options) => fidelity::fidelity(options),
        BenchCommand::Frame(options) => frame::frame(options),
        BenchCommand::Latency(options) => latency::latency(options),
        BenchCommand::Load(options) => load::load(options),
        BenchCommand::Missions(options) => missions::missions(options),
        BenchCommand::Replay(options) => replay::replay(options),
        BenchCommand::Scale(options) => scale::scale(options, settings),
        BenchCommand::Sim(options) => sim::sim(options),
    }
}
