//! The findings of the doctor: their causes, and how serious each is.
//!
//! They are apart from the examination because screens, the API and the texts of findings use them without it.

use crate::doctor::Way;
use crate::vehicle_id::VehicleId;
use crate::wire::{BoardId, ComponentId, SystemId};

/// A finding about a link.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkFinding {
    /// The index of the link in the list of charts.
    pub link: usize,
    /// Its kind of connection, on which the advice depends.
    pub way: Way,
    pub cause: Cause,
    /// The places at which a system id is heard, if there are several, and their boards; empty for other causes.
    pub boards: Vec<HeardBoard>,
}

/// One of several places at which a system id is heard.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HeardBoard {
    /// The id of its board, if known.
    pub board: Option<BoardId>,
    /// The index of its link in the list of charts.
    pub link: usize,
    /// Its address, if the link has several peers.
    pub address: Option<String>,
}

/// The weight of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    Fatal,
    /// A part of the link does not work as it should.
    Fault,
    Remark,
    /// Not a fault, or too early to tell.
    Fine,
}

/// Why a link does or does not work.
#[derive(Debug, Clone, PartialEq)]
pub enum Cause {
    /// The link is not open; its own error gives the reason.
    NotOpen,
    /// Nothing arrives at all.
    Nothing,
    Text,
    /// Bytes arrive, but they contain no frame.
    NoFrame,
    /// Bytes without frames or text on a serial port: its baud rate is probably wrong.
    WrongBaud,
    /// All frames are of messages that the dialect does not have.
    UnknownDialect,
    /// Some frames, this share in percent, are of messages that the dialect does not have.
    ForeignMessages(u8),
    /// Ground stations are heard, but no vehicle.
    OnlyGroundStations,
    /// All frames are heartbeats with the console's own ids.
    OwnEcho,
    /// Components such as cameras are heard, but no autopilot.
    NoAutopilot,
    /// A vehicle uses system id 0, which stands for all vehicles.
    SystemZero,
    /// Two vehicles have this system id.
    DuplicateSystem(SystemId),
    /// One vehicle is heard at two places.
    HeardTwice(SystemId),
    /// Expected vehicles were never heard.
    Missing {
        never: Vec<VehicleId>,
        /// The vehicles that are heard, although they are not expected.
        others: Vec<VehicleId>,
    },
    /// The vehicle signs with a key that the console does not have, and does not answer the console's unsigned frames.
    Signed(SystemId),
    /// The vehicle signs with a key that the console does not have, but accepts unsigned frames.
    SignedButAnswers(SystemId),
    /// Unsigned frames arrive in the name of a vehicle that should sign.
    Unsigned(SystemId),
    /// Frames that are not signed with a vehicle's key arrive in its name.
    WrongKey(SystemId),
    /// Frames of a vehicle have old timestamps, this many seconds behind: they may be replayed.
    OldStamps(SystemId, u64),
    /// The vehicle is heard but does not answer.
    OneWay(SystemId),
    /// This many vehicles are heard but do not answer.
    OneWayVehicles(usize),
    /// This share of the bytes belongs to no frame, in percent.
    Noise(u8),
    /// The vehicle supports only MAVLink 1.
    Version1(SystemId),
    /// Another ground station, with these ids, is heard in addition to a vehicle.
    OtherStation(SystemId, ComponentId),
    /// This share of the frames arrives damaged, in percent.
    Damaged(u8),
    /// This share of the frames does not arrive, in percent.
    Lossy(u8),
    /// A recording is played, so there are no answers.
    Recording,
    /// The observation is too short for a finding.
    Listening,
    /// This many vehicles are heard, and it is too early to expect an answer.
    Unanswered(usize),
    /// This many vehicles are heard and answer.
    Well(usize),
}

impl Cause {
    /// The weight of the cause.
    pub fn weight(&self) -> Weight {
        match self {
            Self::NotOpen
            | Self::Nothing
            | Self::Text
            | Self::NoFrame
            | Self::WrongBaud
            | Self::UnknownDialect
            | Self::OnlyGroundStations
            | Self::OwnEcho
            | Self::NoAutopilot => Weight::Fatal,
            Self::SystemZero
            | Self::DuplicateSystem(_)
            | Self::HeardTwice(_)
            | Self::Missing { .. }
            | Self::Signed(_)
            | Self::Unsigned(_)
            | Self::WrongKey(_)
            | Self::OldStamps(..)
            | Self::OneWay(_)
            | Self::OneWayVehicles(_)
            | Self::Noise(_)
            | Self::Damaged(_)
            | Self::Lossy(_) => Weight::Fault,
            Self::ForeignMessages(_)
            | Self::SignedButAnswers(_)
            | Self::Version1(_)
            | Self::OtherStation(..)
            | Self::Recording => Weight::Remark,
            Self::Listening | Self::Unanswered(_) | Self::Well(_) => Weight::Fine,
        }
    }
}
