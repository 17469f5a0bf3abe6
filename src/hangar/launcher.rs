//! Starts processes that cannot outlive this one.
//!
//! A process is told by the kernel when the *thread* that made it ends, so one thread lives as long as the hangar
//! and makes them all. What it makes is this program again, which asks for that signal, limits itself, and becomes
//! the program that is wanted: SITL's parent is then the hangar itself, which SITL wants alive as well.

use std::ffi::OsString;
use std::io;
use std::os::unix::process::CommandExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::sync::mpsc;

use nix::sys::resource::{Resource, setrlimit};
use nix::sys::signal::Signal;
use nix::unistd::{getppid, setsid};
use tokio::process::Child;
use tokio::sync::oneshot;

use super::Limits;

/// The hidden subcommand of this program that becomes another.
pub const LAUNCH: &str = "hangar-launch";
const BYTES_PER_MIB: u64 = 1024 * 1024;

/// What to start.
#[derive(Debug)]
pub(super) struct Order {
    pub program: PathBuf,
    pub arguments: Vec<String>,
    pub folder: PathBuf,
}

type Answer = oneshot::Sender<io::Result<Child>>;

/// The thread that starts processes.
pub(super) struct Launcher(mpsc::Sender<(Order, Answer)>);

impl Launcher {
    /// Starts the thread; it ends with the launcher.
    pub fn start(sortie: PathBuf, limits: Limits) -> io::Result<Self> {
        let (orders, inbox) = mpsc::channel::<(Order, Answer)>();
        let runtime = tokio::runtime::Handle::current();
        std::thread::Builder::new()
            .name("launcher".to_owned())
            .spawn(move || {
                let _inside = runtime.enter();
                while let Ok((order, answer)) = inbox.recv() {
                    drop(answer.send(launch(&sortie, limits, &order)));
                }
            })?;
        Ok(Self(orders))
    }

    /// Starts a process whose output is piped.
    pub async fn launch(&self, order: Order) -> io::Result<Child> {
        let (answer, child) = oneshot::channel();
        let gone = || io::Error::other("the thread that starts processes has ended");
        self.0.send((order, answer)).map_err(|_| gone())?;
        child.await.map_err(|_| gone())?
    }
}

fn launch(sortie: &Path, limits: Limits, order: &Order) -> io::Result<Child> {
    tokio::process::Command::new(sortie)
        .arg(LAUNCH)
        .arg(std::process::id().to_string())
        .arg((limits.memory_mib * BYTES_PER_MIB).to_string())
        .arg(&order.program)
        .args(&order.arguments)
        .current_dir(&order.folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .kill_on_drop(true)
        .spawn()
}

/// What the hidden subcommand does: `OWNER MEMORY PROGRAM ARGUMENT...`. Returns only if the program cannot be
/// started.
pub fn launch_stub(words: &[OsString]) -> ExitCode {
    let error = match words {
        [owner, memory, program, arguments @ ..] => {
            become_program(owner, memory, program, arguments)
        }
        _ => io::Error::new(
            io::ErrorKind::InvalidInput,
            "it is for the hangar's own use",
        ),
    };
    eprintln!("sortie: cannot start: {error}");
    ExitCode::from(127)
}

fn become_program(
    owner: &OsString,
    memory: &OsString,
    program: &OsString,
    arguments: &[OsString],
) -> io::Error {
    let number = |word: &OsString| word.to_str().and_then(|word| word.parse::<u64>().ok());
    let Some((owner, memory)) = number(owner).zip(number(memory)) else {
        return io::Error::new(
            io::ErrorKind::InvalidInput,
            "it is for the hangar's own use",
        );
    };
    #[cfg(target_os = "linux")]
    if let Err(error) = nix::sys::prctl::set_pdeathsig(Signal::SIGKILL) {
        return error.into();
    }
    // Whoever has ended before the line above sends no signal.
    if getppid().as_raw() as u64 != owner {
        return io::Error::other("its owner has ended");
    }
    // A terminal's Ctrl-C is for the owner. Failing to lead a session is no reason not to start.
    let _ = setsid();
    let limited = setrlimit(Resource::RLIMIT_AS, memory, memory)
        .and_then(|()| setrlimit(Resource::RLIMIT_CORE, 0, 0));
    if let Err(error) = limited {
        return error.into();
    }
    Command::new(program).args(arguments).exec()
}
