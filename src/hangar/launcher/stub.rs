//! The hidden subcommand: it becomes another program.

use std::ffi::{CString, OsString};
use std::fs::File;
use std::io::Write as _;
use std::os::fd::AsFd as _;
use std::os::unix::ffi::OsStrExt as _;
use std::process::ExitCode;

use nix::errno::Errno;
use nix::sys::resource::{Resource, setrlimit};
use nix::unistd::{chdir, dup2_stdin, execv, getppid, setsid};
use strum::{EnumString, IntoStaticStr};

/// The exit code of shells for a program that cannot be run.
const CANNOT_RUN: u8 = 127;

/// A step before the program runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub(super) enum StubStep {
    Understand,
    #[strum(serialize = "owner")]
    EndWithOwner,
    Enter,
    Limit,
    Become,
}

impl StubStep {
    /// The step's purpose, for messages.
    pub fn attempt(self) -> &'static str {
        match self {
            Self::Understand => "read its order",
            Self::EndWithOwner => "make it end with its owner",
            Self::Enter => "enter its folder",
            Self::Limit => "limit its resources",
            Self::Become => "run it",
        }
    }
}

/// The hidden subcommand: `OWNER MEMORY FOLDER PROGRAM ARGUMENT...`. Returns only if the program cannot be started.
pub fn launch_stub(words: &[OsString]) -> ExitCode {
    ExitCode::from(run(words))
}

pub(super) fn run(words: &[OsString]) -> u8 {
    // A copy of the socket that closes on exec.
    let report = std::io::stdin().as_fd().try_clone_to_owned();
    let (step, errno) = become_program(words);
    let written = report.and_then(|report| {
        let name: &str = step.into();
        File::from(report).write_all(format!("{name} {}\n", errno as i32).as_bytes())
    });
    if step == StubStep::Understand || written.is_err() {
        eprintln!(
            "sortie: cannot {}: {errno}; this command is for hangars only",
            step.attempt()
        );
    }
    CANNOT_RUN
}

fn become_program(words: &[OsString]) -> (StubStep, Errno) {
    let [owner, memory, folder, program @ ..] = words else {
        return (StubStep::Understand, Errno::EINVAL);
    };
    let number = |word: &OsString| word.to_str().and_then(|word| word.parse::<u64>().ok());
    let text = |word: &OsString| CString::new(word.as_bytes());
    let program: Result<Vec<CString>, _> = program.iter().map(text).collect();
    let (Some(owner), Some(memory), Ok([path, ..])) =
        (number(owner), number(memory), program.as_deref())
    else {
        return (StubStep::Understand, Errno::EINVAL);
    };
    let words = program.as_deref().unwrap_or_default();
    let prepared = end_with(owner)
        .map_err(|errno| (StubStep::EndWithOwner, errno))
        .and_then(|()| chdir(folder.as_os_str()).map_err(|errno| (StubStep::Enter, errno)))
        .and_then(|()| limit(memory).map_err(|errno| (StubStep::Limit, errno)));
    if let Err(fault) = prepared {
        return fault;
    }
    // A terminal's Ctrl-C is meant for the owner. The start also works without a session of its
    // own.
    let _ = setsid();
    let run = File::open("/dev/null")
        .map_err(|error| Errno::from_raw(error.raw_os_error().unwrap_or_default()))
        .and_then(dup2_stdin)
        // The standard library would run a file that is not a program with a shell, so `execv` is
        // called directly.
        .and_then(|()| execv(path, words));
    (StubStep::Become, run.err().unwrap_or(Errno::UnknownErrno))
}

/// Makes the kernel kill this process when the thread that created it ends.
fn end_with(owner: u64) -> nix::Result<()> {
    #[cfg(target_os = "linux")]
    nix::sys::prctl::set_pdeathsig(nix::sys::signal::Signal::SIGKILL)?;
    // An owner that ended before the line above sends no signal.
    if getppid().as_raw() as u64 == owner {
        Ok(())
    } else {
        Err(Errno::ESRCH)
    }
}

fn limit(memory: u64) -> nix::Result<()> {
    let limited = setrlimit(Resource::RLIMIT_AS, memory, memory);
    // Other systems may not have this limit.
    if cfg!(target_os = "linux") {
        limited?;
    }
    setrlimit(Resource::RLIMIT_CORE, 0, 0)
}
