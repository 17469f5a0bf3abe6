//! Why a program does not run.

use std::io;
use std::path::PathBuf;

use nix::errno::Errno;

use super::LaunchOrder;
use super::stub::StubStep;

/// Why a process could not be started.
#[derive(Debug, thiserror::Error)]
pub(in crate::hangar) enum LaunchError {
    /// The path does not exist.
    #[error("no program {0}: name the one to start, or build it")]
    NoProgram(PathBuf),
    /// The path is a folder.
    #[error("{0} is a folder: name the program in it")]
    Folder(PathBuf),
    /// The file is not a program, or was built for another architecture.
    #[error(
        "{0} is not a program that this machine can run: it may be built for another one, or damaged"
    )]
    NotAProgram(PathBuf),
    /// The interpreter of the program is missing.
    #[error("{0} exists, but its interpreter or its loader is missing")]
    NoInterpreter(PathBuf),
    /// The system does not allow this user to run the program.
    #[error(
        "this user may not run {0}: allow it with chmod +x, and check whether its disk is mounted noexec"
    )]
    NotAllowed(PathBuf),
    /// The file is being written.
    #[error("{0} is being written: try again when its build has finished")]
    Busy(PathBuf),
    /// The program exceeds the memory limit.
    #[error(
        "{program} does not fit into {memory_mib} MiB: raise the limit of an instance's memory"
    )]
    Memory { program: PathBuf, memory_mib: u64 },
    /// Its folder cannot be entered.
    #[error("its folder {folder} cannot be entered: {source}")]
    NoFolder { folder: PathBuf, source: io::Error },
    /// The system allows no further process.
    #[error(
        "the system allows no more processes or open files ({0}): stop some, or raise ulimit -u and ulimit -n"
    )]
    Exhausted(io::Error),
    /// The stub itself cannot be started.
    #[error(
        "{sortie}, which starts all programs, cannot be started: {source}; was it replaced while it was running?"
    )]
    Stub {
        /// The path of this program.
        sortie: PathBuf,
        source: io::Error,
    },
    #[error("{program} cannot be started: {what}: {source}")]
    Other {
        program: PathBuf,
        what: &'static str,
        source: io::Error,
    },
    /// The hangar is being closed.
    #[error("the hangar is closing")]
    Closed,
}

impl LaunchError {
    /// Whether a later attempt may succeed without intervention.
    pub fn may_pass(&self) -> bool {
        matches!(self, Self::Busy(_) | Self::Exhausted(_))
    }

    pub(super) fn of_spawn(sortie: PathBuf, source: io::Error) -> Self {
        let errno = source.raw_os_error().map(Errno::from_raw);
        match errno {
            Some(Errno::EAGAIN | Errno::ENOMEM | Errno::EMFILE | Errno::ENFILE) => {
                Self::Exhausted(source)
            }
            _ => Self::Stub { sortie, source },
        }
    }

    /// The error from the child's report, which names the failed step and the system's error
    /// number.
    pub(super) fn of_report(report: &str, order: &LaunchOrder, memory_mib: u64) -> Self {
        let (step, errno) = report.trim_end().split_once(' ').unwrap_or_default();
        let errno = errno.parse().unwrap_or_default();
        let source = io::Error::from_raw_os_error(errno);
        let program = order.program.clone();
        match step.parse().ok() {
            Some(StubStep::Enter) => Self::NoFolder {
                folder: order.folder.clone(),
                source,
            },
            Some(StubStep::Become) => match Errno::from_raw(errno) {
                Errno::ENOENT | Errno::ENOTDIR if !program.exists() => Self::NoProgram(program),
                Errno::ENOENT => Self::NoInterpreter(program),
                Errno::EACCES | Errno::EPERM if program.is_dir() => Self::Folder(program),
                Errno::EACCES | Errno::EPERM => Self::NotAllowed(program),
                Errno::ENOEXEC => Self::NotAProgram(program),
                Errno::ETXTBSY => Self::Busy(program),
                Errno::EAGAIN => Self::Exhausted(source),
                Errno::ENOMEM => Self::Memory {
                    program,
                    memory_mib,
                },
                _ => Self::Other {
                    program,
                    what: "run it",
                    source,
                },
            },
            step => Self::Other {
                program,
                what: step.map_or("read the report of its start", StubStep::attempt),
                source,
            },
        }
    }
}
