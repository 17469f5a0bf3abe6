//! The texts of findings: cause and advice.

use super::{Cause, HeardBoard, LinkFinding, SealCounts, Way};
use crate::text;
use crate::text::Text;
use crate::vehicle_id::{VehicleId, ranges};

impl Cause {
    /// The name of the cause, without its figures.
    pub fn name(&self) -> &'static str {
        match self {
            Self::NotOpen => "not-open",
            Self::Nothing => "nothing",
            Self::Text => "text",
            Self::NoFrame => "no-frame",
            Self::WrongBaud => "wrong-baud",
            Self::UnknownDialect => "unknown-dialect",
            Self::ForeignMessages(_) => "foreign-messages",
            Self::OnlyGroundStations => "only-ground-stations",
            Self::OwnEcho => "own-echo",
            Self::NoAutopilot => "no-autopilot",
            Self::SystemZero => "system-zero",
            Self::DuplicateSystem(_) => "duplicate-system",
            Self::HeardTwice(_) => "heard-twice",
            Self::Missing { .. } => "missing",
            Self::Signed(_) => "signed",
            Self::SignedButAnswers(_) => "signed-but-answers",
            Self::Unsigned(_) => "unsigned",
            Self::WrongKey(_) => "wrong-key",
            Self::OldStamps(..) => "old-stamps",
            Self::OneWay(_) => "one-way",
            Self::OneWayVehicles(_) => "one-way-vehicles",
            Self::Noise(_) => "noise",
            Self::Version1(_) => "version-1",
            Self::OtherStation(..) => "other-station",
            Self::Damaged(_) => "damaged",
            Self::Lossy(_) => "lossy",
            Self::Recording => "recording",
            Self::Listening => "listening",
            Self::Unanswered(_) => "unanswered",
            Self::Well(_) => "well",
        }
    }

    pub fn says(&self) -> Text {
        match *self {
            Self::NotOpen => text!("doctor-not-open"),
            Self::Nothing => text!("doctor-nothing"),
            Self::Text => text!("doctor-text"),
            Self::NoFrame => text!("doctor-no-frame"),
            Self::WrongBaud => text!("doctor-wrong-baud"),
            Self::UnknownDialect => text!("doctor-unknown-dialect"),
            Self::ForeignMessages(percent) => text!("doctor-foreign-messages", percent = percent),
            Self::OnlyGroundStations => text!("doctor-only-ground-stations"),
            Self::OwnEcho => text!("doctor-own-echo"),
            Self::NoAutopilot => text!("doctor-no-autopilot"),
            Self::SystemZero => text!("doctor-system-zero"),
            Self::DuplicateSystem(system) => text!("doctor-duplicate-system", system = system),
            Self::HeardTwice(system) => text!("doctor-heard-twice", system = system),
            Self::Missing {
                ref never,
                ref others,
            } => missing(never, others),
            Self::Signed(system) => text!("doctor-signed", system = system),
            Self::SignedButAnswers(system) => text!("doctor-signed-but-answers", system = system),
            Self::Unsigned(system) => text!("doctor-unsigned", system = system),
            Self::WrongKey(system) => text!("doctor-wrong-key", system = system),
            Self::OldStamps(system, seconds) => {
                text!("doctor-old-stamps", system = system, seconds = seconds)
            }
            Self::OneWay(system) => text!("doctor-one-way", system = system),
            Self::OneWayVehicles(count) => text!("doctor-one-way-vehicles", count = count),
            Self::Noise(percent) => text!("doctor-noise", percent = percent),
            Self::Version1(system) => text!("doctor-version-1", system = system),
            Self::OtherStation(system, component) => {
                text!(
                    "doctor-other-station",
                    system = system,
                    component = component
                )
            }
            Self::Damaged(percent) => text!("doctor-damaged", percent = percent),
            Self::Lossy(percent) => text!("doctor-lossy", percent = percent),
            Self::Recording => text!("doctor-recording"),
            Self::Listening => text!("doctor-listening"),
            Self::Unanswered(count) => text!("doctor-unanswered", count = count),
            Self::Well(count) => text!("doctor-well", count = count),
        }
    }
}

fn missing(never: &[VehicleId], others: &[VehicleId]) -> Text {
    let never = ranges(never.iter().copied());
    if others.is_empty() {
        return text!("doctor-missing", never = never);
    }
    let others = ranges(others.iter().copied());
    text!("doctor-missing-but", never = never, others = others)
}

impl HeardBoard {
    /// The vehicle's place and the id of its board.
    fn says(&self) -> Text {
        let place = match &self.address {
            Some(address) => Text::verbatim(address),
            None => text!("doctor-board-link", link = self.link + 1),
        };
        match self.board {
            Some(board) => text!("heard-board", place = place, board = board.to_string()),
            None => place,
        }
    }
}

impl LinkFinding {
    /// The finding, with the vehicles that it is about.
    pub fn says(&self) -> Text {
        let says = self.cause.says();
        if self.boards.is_empty() {
            return says;
        }
        let boards = self.boards.iter().map(HeardBoard::says).collect();
        Text::joined(": ", vec![says, Text::joined(", ", boards)])
    }

    /// The advice; empty without a fault.
    pub fn advice(&self) -> Text {
        match self.cause {
            Cause::NotOpen => match self.way {
                Way::Tcp => text!("doctor-try-not-open-tcp"),
                Way::Serial => text!("doctor-try-not-open-serial"),
                Way::TcpIn | Way::Udp | Way::UdpIn | Way::File | Way::Pipe => {
                    text!("doctor-try-not-open")
                }
            },
            Cause::Nothing => silence(self.way),
            Cause::Text => text!("doctor-try-text"),
            Cause::NoFrame => text!("doctor-try-no-frame"),
            Cause::WrongBaud => text!("doctor-try-wrong-baud"),
            Cause::UnknownDialect | Cause::ForeignMessages(_) => text!("doctor-try-dialect"),
            Cause::OnlyGroundStations => text!("doctor-try-ground-stations"),
            Cause::OwnEcho => text!("doctor-try-echo"),
            Cause::NoAutopilot => text!("doctor-try-autopilot"),
            Cause::SystemZero => text!("doctor-try-system-zero"),
            Cause::DuplicateSystem(_) => text!("doctor-try-duplicate"),
            Cause::HeardTwice(_) => text!("doctor-try-heard-twice"),
            Cause::Missing { .. } => text!("doctor-try-missing"),
            Cause::Signed(_) => text!("doctor-try-signed"),
            Cause::Unsigned(_) => text!("doctor-try-unsigned"),
            Cause::WrongKey(_) => text!("doctor-try-wrong-key"),
            Cause::OldStamps(..) => text!("doctor-try-old-stamps"),
            Cause::OneWay(_) | Cause::OneWayVehicles(_) if self.way == Way::Serial => {
                text!("doctor-try-one-way-serial")
            }
            Cause::OneWay(_) => text!("doctor-try-one-way"),
            Cause::OneWayVehicles(_) => text!("doctor-try-one-way-vehicles"),
            Cause::Noise(_) => text!("doctor-try-noise"),
            Cause::Version1(_) => text!("doctor-try-version-1"),
            Cause::OtherStation(..) => text!("doctor-try-other-station"),
            Cause::Damaged(_) | Cause::Lossy(_) if self.way == Way::Serial => {
                text!("doctor-try-damaged-serial")
            }
            Cause::Damaged(_) | Cause::Lossy(_) => text!("doctor-try-damaged"),
            Cause::SignedButAnswers(_)
            | Cause::Recording
            | Cause::Listening
            | Cause::Unanswered(_)
            | Cause::Well(_) => Text::default(),
        }
    }
}

/// The advice for a link on which nothing arrives.
fn silence(way: Way) -> Text {
    match way {
        Way::Tcp => text!("doctor-try-silence-tcp"),
        Way::TcpIn => text!("doctor-try-silence-tcpin"),
        Way::Udp => text!("doctor-try-silence-udp"),
        Way::UdpIn => text!("doctor-try-silence-udpin"),
        Way::Serial => text!("doctor-try-silence-serial"),
        Way::File | Way::Pipe => text!("doctor-try-silence"),
    }
}

impl SealCounts {
    /// The counts in words.
    pub fn text(self) -> Text {
        text!(
            "links-signing-figures",
            right = self.right,
            unsigned = self.unsigned,
            foreign = self.foreign,
            old = self.old
        )
    }
}
