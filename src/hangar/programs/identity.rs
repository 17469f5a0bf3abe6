//! Asks a program what it is: SITL says so on serial 0 as soon as it runs.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{ExitStatus, Stdio};
use std::time::Duration;

use nix::sys::signal::{Signal, killpg};
use nix::unistd::Pid;
use serde::Serialize;
use tokio::io::{AsyncRead, AsyncReadExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio::process::{Child, Command};
use tokio::time::timeout;

use super::check;
use super::scratch::ScratchFolder;
use crate::hangar::sockets::{self, Socket};
use crate::sitl::Kind;

/// How long a program may take; an idle machine needs a tenth of a second.
pub const PATIENCE: Duration = Duration::from_secs(10);
/// SITL says about a hundred bytes before its name is complete.
const GREETING_LEN: usize = 4096;
/// SITL prints about a kilobyte until then.
const OUTPUT_MAX: usize = 1024 * 1024;
const TAIL_LEN: usize = 400;

/// What a program of SITL is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Identity {
    /// The vehicle.
    pub kind: Kind,
    /// The version, `4.6.0-dev`.
    pub version: String,
    /// The commit that it was built from, shortened.
    pub hash: String,
    /// The sockets that others could talk to although it was asked to open none, as far as the host tells.
    pub sockets: Vec<Socket>,
}

/// Why a program has not said what it is.
#[derive(Debug, thiserror::Error)]
pub enum Unknown {
    /// It cannot be a program.
    #[error("{}: {reason}", file.display())]
    NoProgram {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The host cannot start it, or has no scratch folder or port for it.
    #[error("cannot start {}: {source}", file.display())]
    Host {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// It has ended instead.
    #[error("{} is no SITL: it has ended ({status}){}", file.display(), said(.output))]
    Ended {
        /// The file.
        file: PathBuf,
        /// How.
        status: ExitStatus,
        /// What it printed last.
        output: String,
    },
    /// It prints without end.
    #[error("{} is no SITL: it prints without end{}", file.display(), said(.output))]
    Flood {
        /// The file.
        file: PathBuf,
        /// What it printed last.
        output: String,
    },
    /// It has not said anything that makes sense.
    #[error("{} has not said what it is within {patience:?}: it is no SITL, or it hangs{}", file.display(), said(.output))]
    Silent {
        /// The file.
        file: PathBuf,
        /// How long it had.
        patience: Duration,
        /// What it printed last.
        output: String,
    },
    /// It is a vehicle that the hangar does not start.
    #[error("{} is {vehicle}, and not one of copter, plane, rover and sub", file.display())]
    OtherVehicle {
        /// The file.
        file: PathBuf,
        /// What it calls itself.
        vehicle: String,
    },
}

fn said(output: &str) -> String {
    let line = output.lines().rev().find(|line| !line.trim().is_empty());
    line.map_or_else(String::new, |line| format!("; it printed: {}", line.trim()))
}

/// Starts a program in a scratch folder, hears what it is, and ends it.
///
/// # Errors
/// It does not say so in time.
pub async fn identify(program: &Path, patience: Duration) -> Result<Identity, Unknown> {
    let file = || program.to_owned();
    check(program).map_err(|reason| Unknown::NoProgram {
        file: file(),
        reason,
    })?;
    let host = |source| Unknown::Host {
        file: file(),
        source,
    };
    let absolute = std::path::absolute(program).map_err(host)?;
    let folder = ScratchFolder::new("sortie-identify").map_err(host)?;
    let listener = TcpListener::bind(("127.0.0.1", 0)).await.map_err(host)?;
    let port = listener.local_addr().map_err(host)?.port();
    let mut trial = Trial::start(&absolute, folder.path(), port).map_err(host)?;
    let heard = timeout(patience, trial.hear(&listener)).await;
    let identity = match heard {
        Ok(Heard::Greeting(greeting)) => {
            greeting
                .identity(trial.sockets())
                .ok_or_else(|| Unknown::OtherVehicle {
                    file: file(),
                    vehicle: greeting.vehicle,
                })
        }
        Ok(Heard::End(status)) => Err(Unknown::Ended {
            file: file(),
            status,
            output: trial.tail(),
        }),
        Ok(Heard::Flood) => Err(Unknown::Flood {
            file: file(),
            output: trial.tail(),
        }),
        Ok(Heard::Error(source)) => Err(host(source)),
        Err(_) => Err(Unknown::Silent {
            file: file(),
            patience,
            output: trial.tail(),
        }),
    };
    trial.end().await;
    identity
}

/// A program on trial. It leads a process group of its own, so that a script goes with all that it has started.
struct Trial {
    child: Child,
    group: Option<Pid>,
    output: Option<Box<dyn AsyncRead + Send + Unpin>>,
    errors: Option<Box<dyn AsyncRead + Send + Unpin>>,
    printed: usize,
    tail: Vec<u8>,
}

impl Drop for Trial {
    fn drop(&mut self) {
        if let Some(group) = self.group {
            // Failing means that it has ended.
            let _ = killpg(group, Signal::SIGKILL);
        }
    }
}

enum Heard {
    Greeting(Greeting),
    End(ExitStatus),
    Flood,
    Error(io::Error),
}

impl Trial {
    fn start(program: &Path, folder: &Path, port: u16) -> io::Result<Self> {
        let mut child = Command::new(program)
            .args(["--model", "quad", "--speedup", "1", "--slave", "0"])
            .args(["--serial0", &format!("tcpclient:127.0.0.1:{port}")])
            .args([
                "--serial1",
                "none:",
                "--serial2",
                "none:",
                "--rc-in-port",
                "0",
            ])
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .process_group(0)
            .kill_on_drop(true)
            .spawn()?;
        Ok(Self {
            group: child.id().map(|pid| Pid::from_raw(pid as i32)),
            output: child.stdout.take().map(|pipe| Box::new(pipe) as _),
            errors: child.stderr.take().map(|pipe| Box::new(pipe) as _),
            child,
            printed: 0,
            tail: Vec::new(),
        })
    }

    async fn hear(&mut self, listener: &TcpListener) -> Heard {
        let mut stream: Option<TcpStream> = None;
        let mut greeting = Vec::new();
        let (mut words, mut out, mut err) = ([0; 512], [0; 4096], [0; 4096]);
        loop {
            let read = tokio::select! {
                // What it has printed is told before that it has ended.
                biased;
                count = read(&mut self.output, &mut out) => Some(&out[..count]),
                count = read(&mut self.errors, &mut err) => Some(&err[..count]),
                accepted = listener.accept(), if stream.is_none() => match accepted {
                    Ok((accepted, _)) => {
                        stream = Some(accepted);
                        None
                    }
                    Err(error) => return Heard::Error(error),
                },
                count = read(&mut stream, &mut words), if stream.is_some() => {
                    greeting.extend_from_slice(&words[..count]);
                    if let Some(greeting) = Greeting::find(&greeting) {
                        return Heard::Greeting(greeting);
                    }
                    greeting.truncate(GREETING_LEN);
                    None
                }
                status = self.child.wait() => return match status {
                    Ok(status) => Heard::End(status),
                    Err(error) => Heard::Error(error),
                },
            };
            if let Some(bytes) = read {
                self.printed += bytes.len();
                self.tail.extend_from_slice(bytes);
                self.tail.drain(..self.tail.len().saturating_sub(TAIL_LEN));
            }
            if self.printed > OUTPUT_MAX {
                return Heard::Flood;
            }
        }
    }

    fn tail(&self) -> String {
        let text = String::from_utf8_lossy(&self.tail);
        // It goes to a terminal.
        let clean = |c: char| if c == '\n' || !c.is_control() { c } else { ' ' };
        text.chars().map(clean).collect()
    }

    fn sockets(&self) -> Vec<Socket> {
        let all = self.child.id().map(sockets::of_process).unwrap_or_default();
        all.into_iter()
            .filter(|socket| !socket.is_loopback())
            .collect()
    }

    async fn end(mut self) {
        if let Some(group) = self.group.take() {
            let _ = killpg(group, Signal::SIGKILL);
        }
        drop(self.child.kill().await);
    }
}

/// Reads; from a pipe that is closed, nothing ever comes.
async fn read(pipe: &mut Option<impl AsyncRead + Unpin>, bytes: &mut [u8]) -> usize {
    if let Some(open) = pipe {
        match open.read(bytes).await {
            Ok(count) if count > 0 => return count,
            _ => *pipe = None,
        }
    }
    std::future::pending().await
}

/// `Init ArduCopter V4.6.0-dev (fbb78585)`.
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

    fn identity(&self, sockets: Vec<Socket>) -> Option<Identity> {
        let kind = match self.vehicle.as_str() {
            "ArduCopter" => Kind::Copter,
            "ArduPlane" => Kind::Plane,
            "ArduRover" | "Rover" => Kind::Rover,
            "ArduSub" => Kind::Sub,
            _ => return None,
        };
        Some(Identity {
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
        assert_eq!(identity.kind, Kind::Copter);
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
