//! `sortie bench latency`: from a key to the bytes that show it, through a pseudo-terminal.

use std::fs::File;
use std::io::{self, Read as _, Write as _};
use std::os::fd::OwnedFd;
use std::path::PathBuf;
use std::process::{Child, Command, ExitCode, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};

use clap::Args;
use nix::pty::{Winsize, openpty};
use nix::sys::termios::{SetArg, cfmakeraw, tcgetattr, tcsetattr};
use serde::Serialize;

use super::super::Failure;

/// Keys that move the cursor down and up again on the home screen.
const KEYS: [&[u8]; 2] = [b"j", b"k"];
/// After this long without output, a program has nothing more to show.
const QUIET: Duration = Duration::from_millis(120);
/// The longest wait for the console's first screen.
const STARTING: Duration = Duration::from_secs(10);
/// A key without any output for this long is a fault.
const PATIENCE: Duration = Duration::from_secs(2);
/// The console's query to a terminal.
const QUESTION: &[u8] = b"\x1b[5n";
/// A terminal's answer to the query: it is ready.
const ANSWER: &[u8] = b"\x1b[0n";

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
    let mut command = Command::new(std::env::current_exe()?);
    command.args(["--fps", &options.frame_rate.to_string(), "--theme", "dark"]);
    let home = home();
    std::fs::create_dir_all(&home)?;
    command.env_clear();
    command.envs(std::env::var_os("PATH").map(|path| ("PATH", path)));
    command.env("HOME", home).env("TERM", "xterm-256color");
    command.env("LC_ALL", "C.UTF-8");
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
    let mut typist = Typist::begin(command)?;
    let took = typist.type_keys(program, options.keys);
    drop(typist);
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

/// Types into the terminal of a program and reads its output.
struct Typist {
    child: Child,
    terminal: File,
    pieces: Receiver<(Instant, Vec<u8>)>,
}

impl Typist {
    fn begin(mut command: Command) -> io::Result<Self> {
        let size = Winsize {
            ws_row: 40,
            ws_col: 120,
            ws_xpixel: 0,
            ws_ypixel: 0,
        };
        let pty = openpty(&size, None)?;
        // The terminal is raw from the beginning: otherwise the kernel's own echo would be
        // measured.
        let mut mode = tcgetattr(&pty.slave)?;
        cfmakeraw(&mut mode);
        tcsetattr(&pty.slave, SetArg::TCSANOW, &mode)?;
        let slave = || -> io::Result<Stdio> { Ok(OwnedFd::try_clone(&pty.slave)?.into()) };
        let child = command
            .stdin(slave()?)
            .stdout(slave()?)
            .stderr(slave()?)
            .spawn()?;
        let terminal = File::from(pty.master);
        let mut read = terminal.try_clone()?;
        let (sender, pieces) = mpsc::channel();
        std::thread::spawn(move || {
            let mut buffer = vec![0; 65536];
            while let Ok(count @ 1..) = read.read(&mut buffer) {
                if sender
                    .send((Instant::now(), buffer[..count].to_vec()))
                    .is_err()
                {
                    break;
                }
            }
        });
        Ok(Self {
            child,
            terminal,
            pieces,
        })
    }

    /// Presses keys one after another, each while the program is quiet; returns the time until the
    /// effect of each was shown.
    fn type_keys(&mut self, program: &str, keys: u32) -> Result<Vec<Duration>, Failure> {
        self.press(b"j")?;
        self.wait(STARTING)
            .ok_or_else(|| anyhow::anyhow!("{program} shows nothing"))?;
        let mut took = Vec::new();
        for at in 0..keys {
            self.settle();
            // The delay varies, so that keys do not fall into step with the program.
            std::thread::sleep(Duration::from_micros(u64::from(at * 7919 % 50) * 1000));
            let pressed = Instant::now();
            self.press(KEYS[at as usize % KEYS.len()])?;
            let seen = self
                .wait(PATIENCE)
                .ok_or_else(|| anyhow::anyhow!("{program} did not show key {at}"))?;
            took.push(seen.saturating_duration_since(pressed));
        }
        Ok(took)
    }

    fn press(&mut self, key: &[u8]) -> io::Result<()> {
        self.terminal.write_all(key)
    }

    /// The time of the next output, if any arrives in time.
    fn wait(&mut self, patience: Duration) -> Option<Instant> {
        let (at, piece) = self.pieces.recv_timeout(patience).ok()?;
        self.answer(&piece);
        Some(at)
    }

    /// Reads output until no more arrives.
    fn settle(&mut self) {
        while self.wait(QUIET).is_some() {}
    }

    /// Answers the program's queries to its terminal. Without answers the console draws with delays.
    fn answer(&mut self, piece: &[u8]) {
        if piece.windows(QUESTION.len()).any(|part| part == QUESTION) {
            drop(self.press(ANSWER));
        }
    }
}

impl Drop for Typist {
    fn drop(&mut self) {
        drop(self.child.kill());
        drop(self.child.wait());
    }
}
