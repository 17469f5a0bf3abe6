//! `sortie bench latency`: from a key to the bytes that show it, through a pseudo-terminal.

use std::io;
use std::path::PathBuf;
use std::process::{Command, ExitCode};
use std::time::{Duration, Instant};

use clap::Args;
use serde::Serialize;

use super::super::Failure;
use super::terminal::{Terminal, own_program};

/// Keys that move the cursor down and up again on the home screen.
const KEYS: [&[u8]; 2] = [b"j", b"k"];
/// After this long without output, a program has nothing more to show.
const QUIET: Duration = Duration::from_millis(120);
/// The longest wait for the console's first screen.
const STARTING: Duration = Duration::from_secs(10);
/// A key without any output for this long is a fault.
const PATIENCE: Duration = Duration::from_secs(2);

/// Options of `sortie bench latency`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie bench latency\n  \
    sortie bench latency --keys 200 --frame-rate 1")]
pub(in crate::cli) struct LatencyArguments {
    /// Press this many keys.
    #[arg(long, default_value_t = 60, value_parser = clap::value_parser!(u32).range(10..=2000))]
    keys: u32,
    /// Let the console draw this many frames per second.
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u8).range(1..=60))]
    frame_rate: u8,
    /// Print one JSON document instead of the table.
    #[arg(long)]
    json: bool,
}

/// The latency of the keys, in milliseconds.
#[derive(Debug, Serialize)]
struct LatencyCost {
    program: &'static str,
    keys: u32,
    median_ms: f64,
    p95_ms: f64,
}

pub(in crate::cli) fn latency(options: &LatencyArguments) -> Result<ExitCode, Failure> {
    let measured = [
        measure("echo", Command::new("cat"), options)?,
        measure("console", console(options)?, options)?,
    ];
    if options.json {
        say!("{}", serde_json::to_string(&measured)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    say!("from a key to bytes on the terminal, {} keys", options.keys)?;
    say!("program     median ms    p95 ms")?;
    for row in measured {
        say!(
            "{:<9} {:>11.2} {:>9.2}",
            row.program,
            row.median_ms,
            row.p95_ms
        )?;
    }
    Ok(ExitCode::SUCCESS)
}

/// This program on its home screen, with separate folders for its files.
fn console(options: &LatencyArguments) -> io::Result<Command> {
    let home = home();
    std::fs::create_dir_all(&home)?;
    let mut command = own_program(&home)?;
    command.args(["--fps", &options.frame_rate.to_string(), "--theme", "dark"]);
    Ok(command)
}

fn home() -> PathBuf {
    std::env::temp_dir().join(format!("sortie-latency-{}", std::process::id()))
}

fn measure(
    program: &'static str,
    command: Command,
    options: &LatencyArguments,
) -> Result<LatencyCost, Failure> {
    let mut terminal = Terminal::begin(command)?;
    let took = type_keys(&mut terminal, program, options.keys);
    drop(terminal);
    drop(std::fs::remove_dir_all(home()));
    let mut took = took?;
    took.sort_unstable();
    let at = |share: f64| {
        let place = (share * (took.len() - 1) as f64).round() as usize;
        took[place].as_secs_f64() * 1e3
    };
    Ok(LatencyCost {
        program,
        keys: options.keys,
        median_ms: at(0.5),
        p95_ms: at(0.95),
    })
}

/// Presses keys one after another, each while the program is quiet; returns the time until the effect of each was shown.
fn type_keys(terminal: &mut Terminal, program: &str, keys: u32) -> Result<Vec<Duration>, Failure> {
    terminal.press(b"j")?;
    terminal
        .next(STARTING)
        .ok_or_else(|| anyhow::anyhow!("{program} shows nothing"))?;
    let mut took = Vec::new();
    for at in 0..keys {
        while terminal.next(QUIET).is_some() {}
        // The delay varies, so that keys do not fall into step with the program.
        std::thread::sleep(Duration::from_micros(u64::from(at * 7919 % 50) * 1000));
        let pressed = Instant::now();
        terminal.press(KEYS[at as usize % KEYS.len()])?;
        let shown = terminal
            .next(PATIENCE)
            .ok_or_else(|| anyhow::anyhow!("{program} did not show key {at}"))?;
        took.push(shown.at.saturating_duration_since(pressed));
    }
    Ok(took)
}
