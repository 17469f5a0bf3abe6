//! Starts processes that cannot outlive this one.
//!
//! The kernel signals a process when the *thread* that created it ends, so one thread lives as long
//! as the hangar and creates all processes. It starts this program again. That copy requests the
//! signal, limits itself, and becomes the requested program. SITL's parent is then the hangar
//! itself, which SITL also needs to stay alive.
//!
//! The hangar and the copy communicate over a socket, which is the copy's standard input until the
//! copy becomes the program. The socket then closes; if there was a failure, it first carries the
//! reason. A socket that closes without a reason therefore shows that the program runs.

use std::ffi::{OsStr, OsString};
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream as Socket;
use std::path::PathBuf;
use std::process::Stdio;
use std::sync::mpsc;
use std::time::Duration;

use tokio::io::AsyncReadExt as _;
use tokio::net::UnixStream;
use tokio::process::Command;
use tokio::sync::{Mutex, MutexGuard, oneshot};
use tokio::time::{Instant, sleep_until};

use super::HangarLimits;

mod fault;
mod running;
mod stub;
#[cfg(all(test, target_os = "linux"))]
pub(in crate::hangar) mod tests;

pub(super) use fault::LaunchError;
pub(super) use running::RunningProcess;
pub use stub::launch_stub;

/// The hidden subcommand of this program that becomes another program.
pub const LAUNCH: &str = "hangar-launch";
const BYTES_PER_MIB: u64 = 1024 * 1024;
/// The maximum length of the reason that a child sends, in bytes.
const REPORT_LEN: u64 = 64;

/// The environment variables passed on. Others are withheld: a simulator, which runs third-party
/// scripts, does not need keys and tokens.
const PASSED_ON: [&str; 9] = [
    "PATH",
    "HOME",
    "USER",
    "LOGNAME",
    "LANG",
    "TZ",
    "TMPDIR",
    "LD_LIBRARY_PATH",
    "DYLD_LIBRARY_PATH",
];
const PASSED_ON_PREFIX: &str = "LC_";

#[derive(Debug, Clone)]
pub(super) struct LaunchOrder {
    /// The path of the program; a relative path is resolved from this program's working folder.
    pub program: PathBuf,
    pub arguments: Vec<String>,
    pub folder: PathBuf,
}

type Begun = (RunningProcess, UnixStream);
type LaunchAnswer = oneshot::Sender<Result<Begun, LaunchError>>;

/// The thread that starts processes, in the order of the requests.
pub(super) struct Launcher {
    orders: mpsc::Sender<(LaunchOrder, LaunchAnswer)>,
    pace: LaunchPace,
    memory_mib: u64,
}

impl Launcher {
    /// Starts the thread; it ends with the launcher. Must be called inside a tokio runtime.
    ///
    /// # Errors
    /// The system allows no more threads.
    pub fn start(sortie: PathBuf, limits: HangarLimits) -> io::Result<Self> {
        Self::with_stub(vec![sortie.into(), LAUNCH.into()], limits)
    }

    /// A launcher with a different command line for the stub.
    fn with_stub(stub: Vec<OsString>, limits: HangarLimits) -> io::Result<Self> {
        let (orders, inbox) = mpsc::channel::<(LaunchOrder, LaunchAnswer)>();
        let runtime = tokio::runtime::Handle::current();
        std::thread::Builder::new()
            .name("launcher".to_owned())
            .spawn(move || {
                let _inside = runtime.enter();
                while let Ok((order, answer)) = inbox.recv() {
                    // If the requester has stopped waiting, no process is needed.
                    if !answer.is_closed() {
                        drop(answer.send(begin(&stub, limits, &order)));
                    }
                }
            })?;
        Ok(Self {
            orders,
            pace: LaunchPace::new(limits.starts_per_s),
            memory_mib: limits.memory_mib,
        })
    }

    /// Starts a process with piped output, after the processes requested earlier. The process runs
    /// the program when the function returns. Dropping the future ends the process.
    ///
    /// # Errors
    /// The program does not run.
    pub async fn launch(&self, order: LaunchOrder) -> Result<RunningProcess, LaunchError> {
        let (answer, begun) = oneshot::channel();
        let turn = self.pace.turn().await;
        self.orders
            .send((order.clone(), answer))
            .map_err(|_| LaunchError::Closed)?;
        drop(turn);
        let (mut running, report) = begun.await.map_err(|_| LaunchError::Closed)??;
        let mut words = Vec::new();
        // A broken socket counts as closed.
        drop(report.take(REPORT_LEN).read_to_end(&mut words).await);
        if words.is_empty() {
            return Ok(running);
        }
        drop(running.end().await);
        let report = String::from_utf8_lossy(&words);
        Err(LaunchError::of_report(&report, &order, self.memory_mib))
    }
}

fn begin(
    stub: &[OsString],
    limits: HangarLimits,
    order: &LaunchOrder,
) -> Result<Begun, LaunchError> {
    let [sortie, first @ ..] = stub else {
        return Err(LaunchError::Closed);
    };
    let failed = |source| LaunchError::of_spawn(sortie.into(), source);
    let program = std::path::absolute(&order.program).map_err(failed)?;
    let (ours, theirs) = Socket::pair().map_err(failed)?;
    ours.set_nonblocking(true).map_err(failed)?;
    let report = UnixStream::from_std(ours).map_err(failed)?;
    let child = Command::new(sortie)
        .args(first)
        .arg(std::process::id().to_string())
        .arg((limits.memory_mib * BYTES_PER_MIB).to_string())
        .arg(&order.folder)
        .arg(program)
        .args(&order.arguments)
        .env_clear()
        .envs(std::env::vars_os().filter(|(name, _)| is_passed_on(name)))
        .stdin(Stdio::from(OwnedFd::from(theirs)))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .kill_on_drop(true)
        .spawn()
        .map_err(failed)?;
    let running = RunningProcess::new(child).ok_or(LaunchError::Closed)?;
    Ok((running, report))
}

fn is_passed_on(name: &OsStr) -> bool {
    name.to_str()
        .is_some_and(|name| PASSED_ON.contains(&name) || name.starts_with(PASSED_ON_PREFIX))
}

struct LaunchPace {
    every: Duration,
    /// The time of the next start. The lock serves waiting tasks in order.
    next: Mutex<Option<Instant>>,
}

impl LaunchPace {
    /// A pace of at least one start per second, because with zero nothing would ever start.
    fn new(per_s: u16) -> Self {
        Self {
            every: Duration::from_secs(1) / u32::from(per_s.max(1)),
            next: Mutex::default(),
        }
    }

    /// Waits for a turn. The next one begins when the guard is dropped and the time has come; dropping the wait does
    /// not delay the others.
    async fn turn(&self) -> MutexGuard<'_, Option<Instant>> {
        let mut next = self.next.lock().await;
        if let Some(at) = *next {
            sleep_until(at).await;
        }
        *next = Some(Instant::now() + self.every);
        next
    }
}
