//! Why a class cannot be opened or joined.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::join_line::JoinLineFault;
use super::socket::SocketFault;

/// Why a class cannot be opened or joined.
#[derive(Debug, PartialEq, Error)]
pub enum ClassFault {
    /// The path leads to something else.
    #[error("{}: {fault:?}", socket.display())]
    Socket { socket: PathBuf, fault: SocketFault },
    /// The folder belongs to another user, or others may change it.
    #[error("{}: not a folder of one's own", .0.display())]
    Folder(PathBuf),
    /// The desk does not belong to the instructor.
    #[error("{}: of {user} instead of {instructor}", socket.display())]
    Stranger {
        socket: PathBuf,
        /// To whom it belongs.
        user: String,
        /// To whom it must belong.
        instructor: String,
    },
    /// It is a class on several machines.
    #[error(transparent)]
    Network(#[from] NetworkFault),
}

/// Why a class on several machines cannot be made, opened or joined.
#[derive(Debug, PartialEq, Error)]
pub enum NetworkFault {
    /// This program was built without the carrier.
    #[error("this build has no carrier for several machines")]
    NotBuilt,
    /// A file cannot be read or written.
    #[error("{}: {error}", file.display())]
    File { file: PathBuf, error: SystemError },
    /// A file with a secret key can be read by other users.
    #[error("{}: other users can read it", .0.display())]
    Exposed(PathBuf),
    /// A file or an argument is not a join line.
    #[error("{}: {fault}", file.as_deref().unwrap_or("-".as_ref()).display())]
    JoinLine {
        /// `None` if it was an argument.
        file: Option<PathBuf>,
        fault: JoinLineFault,
    },
    /// A file is not the secret file of a desk, or was damaged.
    #[error("{}: not a desk: {reason}", file.display())]
    NoDesk { file: PathBuf, reason: String },
    /// There is no class in the folder.
    #[error("{}: no class", .0.display())]
    NoClass(PathBuf),
    /// The class has no seat of this name.
    #[error("{}: no {seat}", folder.display())]
    NoSeat { folder: PathBuf, seat: String },
    /// There is a class of this name already.
    #[error("{}: exists", .0.display())]
    Exists(PathBuf),
    /// The name of the class is no plain word.
    #[error("{0}: not a name")]
    Name(String),
    /// An address cannot be used.
    #[error("{0}: not HOST:PORT")]
    Address(String),
    /// An address is given for a class that is on this host.
    #[error("{}: a class on this host", .0.display())]
    OnHost(PathBuf),
    /// This machine has no address that others could use.
    #[error("no address of this machine is known")]
    NoAddress,
    /// The address cannot be listened at.
    #[error("{address}: {error}")]
    NotOpen { address: String, error: SystemError },
    /// Zenoh does not start.
    #[error("{address}: {fault:?}")]
    NotStarted { address: String, fault: StartFault },
    /// Something answers at the address, but not as the desk of the class.
    #[error("{0}: not the desk")]
    NotTheDesk(String),
    /// The desk was reached, but does not answer this seat.
    #[error("the desk does not know {seat}")]
    Unknown { class: String, seat: String },
    /// Something could not be signed or made: the system gives no random numbers.
    #[error("{0}")]
    Crypto(String),
}

/// Why Zenoh does not start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StartFault {
    /// The address is free, so what remains are the keys and the certificates.
    Certificates,
    /// It took too long.
    Timeout,
    /// It ended again at once.
    Ended,
}

/// An error of the system.
#[derive(Debug, Error)]
#[error(transparent)]
pub struct SystemError(#[from] pub io::Error);

/// Two errors are the same if they are of the same kind.
impl PartialEq for SystemError {
    fn eq(&self, other: &Self) -> bool {
        self.0.kind() == other.0.kind()
    }
}
