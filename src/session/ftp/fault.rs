//! Faults of requests for a vehicle's files.

use crate::text;
use crate::text::Text;

/// Why a file server refuses a request. Source: <https://mavlink.io/en/services/ftp.html#error_codes>.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FtpNak {
    /// No reason given. `ArduPilot` also uses it for a second file while one is open, and for unsupported requests.
    Fail,
    /// An error number of the vehicle's operating system.
    System(u8),
    InvalidSize,
    /// The session is not open, or belongs to another client.
    InvalidSession,
    /// All sessions are in use.
    NoSession,
    /// The offset is beyond the end of the file or the list.
    EndOfFile,
    UnknownCommand,
    Exists,
    Protected,
    NotFound,
    /// A code that the protocol does not define.
    Other(u8),
}

impl FtpNak {
    /// Reads the data of a refusal.
    pub(super) fn read(data: &[u8]) -> Self {
        match data.first().copied().unwrap_or(0) {
            1 => Self::Fail,
            2 => Self::System(data.get(1).copied().unwrap_or(0)),
            3 => Self::InvalidSize,
            4 => Self::InvalidSession,
            5 => Self::NoSession,
            6 => Self::EndOfFile,
            7 => Self::UnknownCommand,
            8 => Self::Exists,
            9 => Self::Protected,
            10 => Self::NotFound,
            code => Self::Other(code),
        }
    }

    /// Whether the server may have forgotten the open file. `ArduPilot` then reports that there is no file.
    pub(super) fn is_of_lost_session(self) -> bool {
        match self {
            Self::InvalidSession | Self::NoSession | Self::NotFound => true,
            Self::Fail
            | Self::System(_)
            | Self::InvalidSize
            | Self::EndOfFile
            | Self::UnknownCommand
            | Self::Exists
            | Self::Protected
            | Self::Other(_) => false,
        }
    }

    /// Whether the server has no such file, or does not support the request.
    pub(in crate::session) fn is_of_missing_file(self) -> bool {
        match self {
            Self::NotFound | Self::UnknownCommand | Self::Protected | Self::System(_) => true,
            Self::Fail
            | Self::InvalidSize
            | Self::InvalidSession
            | Self::NoSession
            | Self::EndOfFile
            | Self::Exists
            | Self::Other(_) => false,
        }
    }

    /// Whether another session may prevent a file from being opened. `ArduPilot` refuses a second session without a
    /// reason.
    pub(super) fn is_of_busy_server(self) -> bool {
        match self {
            Self::Fail | Self::InvalidSession | Self::NoSession => true,
            Self::System(_)
            | Self::InvalidSize
            | Self::EndOfFile
            | Self::UnknownCommand
            | Self::Exists
            | Self::Protected
            | Self::NotFound
            | Self::Other(_) => false,
        }
    }
}

/// Why a task of the file transfer failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FtpFault {
    Refused(FtpNak),
    /// Nothing useful was received for a long time.
    Silent,
    /// The file has this size in bytes, not the expected one.
    OtherSize(u32),
    /// An answer is not valid.
    Malformed,
    /// A folder has more entries than the client reads.
    TooMany,
    /// A path is empty, or too long for a packet.
    BadPath,
}

impl From<FtpNak> for Text {
    fn from(nak: FtpNak) -> Self {
        match nak {
            FtpNak::Fail => text!("ftp-fail"),
            FtpNak::System(number) => text!("ftp-system", number = number),
            FtpNak::InvalidSize => text!("ftp-invalid-size"),
            FtpNak::InvalidSession => text!("ftp-invalid-session"),
            FtpNak::NoSession => text!("ftp-no-session"),
            FtpNak::EndOfFile => text!("ftp-end-of-file"),
            FtpNak::UnknownCommand => text!("ftp-unknown-command"),
            FtpNak::Exists => text!("ftp-exists"),
            FtpNak::Protected => text!("ftp-protected"),
            FtpNak::NotFound => text!("ftp-not-found"),
            FtpNak::Other(code) => text!("ftp-other", code = code),
        }
    }
}

impl From<FtpFault> for Text {
    fn from(fault: FtpFault) -> Self {
        match fault {
            FtpFault::Refused(nak) => nak.into(),
            FtpFault::Silent => text!("ftp-silent"),
            FtpFault::OtherSize(bytes) => text!("ftp-other-size", bytes = bytes),
            FtpFault::Malformed => text!("ftp-malformed"),
            FtpFault::TooMany => text!("ftp-too-many"),
            FtpFault::BadPath => text!("ftp-bad-path"),
        }
    }
}
