//! Identifies a program: SITL announces itself on serial 0 as soon as it runs.

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitStatus;
use std::time::Duration;

use serde::Serialize;
use tokio::io::{AsyncRead, AsyncReadExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio::process::{ChildStderr, ChildStdout};
use tokio::time::timeout;

use super::check;
use super::scratch::ScratchFolder;
use crate::hangar::HangarLimits;
use crate::hangar::launcher::{LaunchOrder, Launcher, RunningProcess};
use crate::hangar::sockets::{self, ListeningSocket};
use crate::sitl::SitlKind;

/// How long to wait for a program; an idle machine needs a tenth of a second.
pub const PATIENCE: Duration = Duration::from_secs(10);
/// The maximum number of bytes read from serial 0; SITL sends about a hundred before its name is complete.
const GREETING_LEN: usize = 4096;
/// The maximum number of bytes of output read; SITL prints about a kilobyte before it announces
/// itself.
const OUTPUT_MAX: usize = 1024 * 1024;
const TAIL_LEN: usize = 400;

/// The identity of a SITL program.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ProgramIdentity {
    pub kind: SitlKind,
    /// The version, such as `4.6.0-dev`.
    pub version: String,
    /// The commit that the program was built from, shortened.
    pub hash: String,
    /// The sockets that others could reach although the program was started without any, if the
    /// host lists them.
    pub sockets: Vec<ListeningSocket>,
}

/// Why a program could not be identified.
#[derive(Debug, thiserror::Error)]
pub enum Unknown {
    /// The file is not a program.
    #[error("{}: {reason}", file.display())]
    NoProgram { file: PathBuf, reason: String },
    /// The host has no scratch folder or port for the program.
    #[error("cannot try {}: {error}", file.display())]
    Host { file: PathBuf, error: io::Error },
    /// The host cannot run the program.
    #[error("{0}")]
    Start(String),
    #[error("{} is not a SITL program: it has ended ({status}){}", file.display(), said(.output))]
    Ended {
        file: PathBuf,
        status: ExitStatus,
        output: String,
    },
    /// The program never stops printing.
    #[error("{} is not a SITL program: it never stops printing{}", file.display(), said(.output))]
    Flood { file: PathBuf, output: String },
    /// The program sent no valid announcement.
    #[error("{} has not identified itself within {patience:?}: it is not a SITL program, or it hangs{}", file.display(), said(.output))]
    Silent {
        file: PathBuf,
        /// The time that the program had to answer.
        patience: Duration,
        output: String,
    },
    /// The program simulates a vehicle that the hangar does not start.
    #[error("{} is {vehicle}, not a copter, plane, rover or sub", file.display())]
    OtherVehicle {
        file: PathBuf,
        /// The name of the vehicle, as the program states it.
        vehicle: String,
    },
}

fn said(output: &str) -> String {
    let line = output.lines().rev().find(|line| !line.trim().is_empty());
    line.map_or_else(String::new, |line| format!("; it printed: {}", line.trim()))
}

/// Starts a program in a scratch folder, as a hangar does, reads its announcement, and ends it.
///
/// # Errors
/// It does not identify itself in time.
pub async fn identify(program: &Path, patience: Duration) -> Result<ProgramIdentity, Unknown> {
    let launcher = std::env::current_exe()
        .and_then(|sortie| Launcher::start(sortie, HangarLimits::default()))
        .map_err(|error| Unknown::Host {
            file: program.to_owned(),
            error,
        })?;
    identify_by(&launcher, program, patience).await
}

pub(super) async fn identify_by(
    launcher: &Launcher,
    program: &Path,
    patience: Duration,
) -> Result<ProgramIdentity, Unknown> {
    let file = || program.to_owned();
    check(program).map_err(|reason| Unknown::NoProgram {
        file: file(),
        reason,
    })?;
    let host = |error| Unknown::Host {
        file: file(),
        error,
    };
    let folder = ScratchFolder::new("sortie-identify").map_err(host)?;
    let listener = TcpListener::bind(("127.0.0.1", 0)).await.map_err(host)?;
    let port = listener.local_addr().map_err(host)?.port();
    let order = order(program, folder.path(), port);
    let started = launcher.launch(order).await;
    let mut trial = IdentityTrial::new(started.map_err(|error| Unknown::Start(error.to_string()))?);
    let heard = timeout(patience, trial.hear(&listener)).await;
    let identity = judge(program, patience, heard.ok(), &trial);
    // An error means that the program has ended.
    drop(trial.process.end().await);
    identity
}

/// A hangar's order without files: the program only needs to announce itself.
fn order(program: &Path, folder: &Path, port: u16) -> LaunchOrder {
    let door = format!("tcpclient:127.0.0.1:{port}");
    let words = ["--model", "quad", "--speedup", "1", "--slave", "0"];
    let ports = [
        "--serial1",
        "none:",
        "--serial2",
        "none:",
        "--rc-in-port",
        "0",
    ];
    let all = words.into_iter().chain(["--serial0", &door]).chain(ports);
    LaunchOrder {
        program: program.to_owned(),
        arguments: all.map(str::to_owned).collect(),
        folder: folder.to_owned(),
    }
}

/// The result that follows from the received bytes.
fn judge(
    program: &Path,
    patience: Duration,
    heard: Option<HeardIdentity>,
    trial: &IdentityTrial,
) -> Result<ProgramIdentity, Unknown> {
    let file = program.to_owned();
    let output = trial.tail();
    match heard {
        Some(HeardIdentity::Greeting(greeting)) => {
            let identity = greeting.identity(trial.sockets());
            let vehicle = greeting.vehicle;
            identity.ok_or(Unknown::OtherVehicle { file, vehicle })
        }
        Some(HeardIdentity::End(status)) => Err(Unknown::Ended {
            file,
            status,
            output,
        }),
        Some(HeardIdentity::Flood) => Err(Unknown::Flood { file, output }),
        Some(HeardIdentity::Error(error)) => Err(Unknown::Host { file, error }),
        None => Err(Unknown::Silent {
            file,
            patience,
            output,
        }),
    }
}

struct IdentityTrial {
    process: RunningProcess,
    output: Option<ChildStdout>,
    errors: Option<ChildStderr>,
    printed: usize,
    tail: Vec<u8>,
}

enum HeardIdentity {
    Greeting(Greeting),
    End(ExitStatus),
    Flood,
    Error(io::Error),
}

impl IdentityTrial {
    fn new(mut process: RunningProcess) -> Self {
        let (output, errors) = process.take_output();
        Self {
            process,
            output,
            errors,
            printed: 0,
            tail: Vec::new(),
        }
    }

    async fn hear(&mut self, listener: &TcpListener) -> HeardIdentity {
        let mut stream: Option<TcpStream> = None;
        let mut greeting = Vec::new();
        let (mut words, mut out, mut err) = ([0; 512], [0; 4096], [0; 4096]);
        loop {
            let read = tokio::select! {
                // The output is handled before the end of the process.
                biased;
                count = read(&mut self.output, &mut out) => Some(&out[..count]),
                count = read(&mut self.errors, &mut err) => Some(&err[..count]),
                accepted = listener.accept(), if stream.is_none() => match accepted {
                    Ok((accepted, _)) => {
                        stream = Some(accepted);
                        None
                    }
                    Err(error) => return HeardIdentity::Error(error),
                },
                count = read(&mut stream, &mut words), if stream.is_some() => {
                    greeting.extend_from_slice(&words[..count]);
                    if let Some(greeting) = Greeting::find(&greeting) {
                        return HeardIdentity::Greeting(greeting);
                    }
                    greeting.truncate(GREETING_LEN);
                    None
                }
                status = self.process.wait() => return match status {
                    Ok(status) => HeardIdentity::End(status),
                    Err(error) => HeardIdentity::Error(error),
                },
            };
            if let Some(bytes) = read {
                self.printed += bytes.len();
                self.tail.extend_from_slice(bytes);
                self.tail.drain(..self.tail.len().saturating_sub(TAIL_LEN));
            }
            if self.printed > OUTPUT_MAX {
                return HeardIdentity::Flood;
            }
        }
    }

    fn tail(&self) -> String {
        let text = String::from_utf8_lossy(&self.tail);
        // The text is shown on a terminal.
        let clean = |c: char| if c == '\n' || !c.is_control() { c } else { ' ' };
        text.chars().map(clean).collect()
    }

    fn sockets(&self) -> Vec<ListeningSocket> {
        let all = sockets::of_process(self.process.pid());
        all.into_iter()
            .filter(|socket| !socket.is_loopback())
            .collect()
    }
}

/// Reads from a pipe; on a closed one, stays pending forever.
async fn read(pipe: &mut Option<impl AsyncRead + Unpin>, bytes: &mut [u8]) -> usize {
    if let Some(open) = pipe {
        match open.read(bytes).await {
            Ok(count) if count > 0 => return count,
            _ => *pipe = None,
        }
    }
    std::future::pending().await
}

/// The announcement, such as `Init ArduCopter V4.6.0-dev (fbb78585)`.
#[derive(Debug, PartialEq, Eq)]
struct Greeting {
    vehicle: String,
    version: String,
    hash: String,
}

impl Greeting {
    fn find(bytes: &[u8]) -> Option<Self> {
        let text = String::from_utf8_lossy(bytes);
        let (_, rest) = text.split_once("Init ")?;
        let (line, _) = rest.split_once('\n')?;
        let (vehicle, rest) = line.split_once(" V")?;
        let (version, rest) = rest.split_once(" (")?;
        let (hash, _) = rest.split_once(')')?;
        let clean = |part: &str| part.chars().filter(|c| !c.is_control()).collect();
        Some(Self {
            vehicle: clean(vehicle),
            version: clean(version),
            hash: clean(hash),
        })
    }

    fn identity(&self, sockets: Vec<ListeningSocket>) -> Option<ProgramIdentity> {
        let kind = match self.vehicle.as_str() {
            "ArduCopter" => SitlKind::Copter,
            "ArduPlane" => SitlKind::Plane,
            "ArduRover" | "Rover" => SitlKind::Rover,
            "ArduSub" => SitlKind::Sub,
            _ => return None,
        };
        Some(ProgramIdentity {
            kind,
            version: self.version.clone(),
            hash: self.hash.clone(),
            sockets,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_greeting_is_found_once_it_is_whole() {
        let said = b"\n\nInit ArduCopter V4.6.0-dev (fbb78585)\n\nFree RAM: 131072\n";
        let identity = Greeting::find(said).and_then(|it| it.identity(Vec::new()));
        let identity = identity.expect("it is a copter");
        assert_eq!(identity.kind, SitlKind::Copter);
        assert_eq!(
            (identity.version.as_str(), identity.hash.as_str()),
            ("4.6.0-dev", "fbb78585")
        );
        for len in 0..39 {
            assert_eq!(Greeting::find(&said[..len]), None, "{len}");
        }
        let tracker =
            Greeting::find(b"Init AntennaTracker V4.6.0 (0)\n").expect("it is a greeting");
        assert_eq!(tracker.identity(Vec::new()), None);
    }
}
