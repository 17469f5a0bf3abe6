//! `sortie bench`: the measurements that docs/measurements.md quotes.

use std::process::ExitCode;

use clap::Subcommand;

use super::Failure;
use super::settings::CliSettings;

mod campaign;
mod decode;
mod fidelity;
mod frame;
mod latency;
mod load;
mod missions;
mod replay;
mod scale;
mod sim;

/// The measurement to make.
#[derive(Debug, Subcommand)]
pub(super) enum BenchCommand {
    /// The course played through by the reference pilots: scores, credits, level, licence and skills after each
    /// flight.
    Campaign(campaign::CampaignArguments),
    /// Decoding and model update per message, compared with a loop that only finds frames.
    Decode(decode::DecodeArguments),
    /// The embedded simulator compared with recordings of the real vehicle, manoeuvre by manoeuvre.
    Fidelity(fidelity::FidelityArguments),
    /// Time and bytes per frame of the console, with a tenth of the vehicles changing.
    Frame(frame::FrameArguments),
    /// The time from a key to the bytes that show it, compared with a program that only echoes.
    Latency(latency::LatencyArguments),
    /// The share of a core that the whole process needs while embedded vehicles fly.
    Load(load::LoadArguments),
    /// How much faster than real time the reference pilots fly the shipped missions.
    Missions(missions::MissionsArguments),
    /// A recording of flying vehicles: the time to open it, the time to show any moment of it, and the cost of
    /// recording.
    Replay(replay::BenchReplayArguments),
    /// The cost of a growing number of vehicles for the simulator and the console, as the paper measured it.
    Scale(scale::ScaleArguments),
    /// Cost of simulated vehicles that fly and stream their position and attitude, from one to thousands.
    Sim(sim::BenchSimArguments),
}

pub(super) fn bench(bench: &BenchCommand, settings: &CliSettings) -> Result<ExitCode, Failure> {
    match bench {
        BenchCommand::Campaign(options) => campaign::campaign(options),
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
