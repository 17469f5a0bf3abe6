//! The lines between seats and desk.
//!
//! Both sides send JSON objects with one field each, one per line, in UTF-8, at most [`LONGEST_LINE`] bytes long. The
//! first line of a seat is [`SeatMessage::Hello`]; the desk answers with [`DeskMessage::Welcome`] or
//! [`DeskMessage::Denied`]. Unknown fields are ignored, so that a version may add some.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{
    Insight, JournalBatch, Order, PicturePart, Piece, PieceRequest, RecordName, SeatReport,
    Submission, SubmissionEnd, TryHead, Words,
};

/// The version of the protocol; it increases with every change that is not an addition.
pub const VERSION: u32 = 1;
/// The maximum length of a line, in bytes.
pub const LONGEST_LINE: usize = 64 * 1024;

/// A line of a seat.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SeatMessage {
    /// The first line of a connection.
    Hello(Hello),
    /// The state of the seat.
    Report {
        /// The number of the newest entry of the journal.
        last: u64,
        /// The state; boxed, because it is much longer than the other messages.
        report: Box<SeatReport>,
    },
    /// Entries of the journal.
    Entries(JournalBatch),
    /// The screen, while the desk watches it.
    Screen(PicturePart),
    /// What is behind the screen, while the desk watches it; boxed like the report.
    Insight(Box<Insight>),
    /// The record of a flight, which the seat hands in. It is repeated until the desk answers.
    Submit(Submission),
    /// A piece of a record, as the desk has asked for it.
    Piece(Piece),
    /// How far the record of an exam's try has grown.
    Head(TryHead),
}

/// The first line of a seat, which asks to join.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hello {
    /// The version of the protocol.
    pub protocol: u32,
    /// A number that this run of the console has chosen: a journal belongs to one run.
    pub sitting: u64,
    /// The name that a desk of this class has given to the seat before.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<Words>,
}

/// A line of the desk.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DeskMessage {
    /// The seat belongs to the class now.
    Welcome {
        /// The version of the protocol.
        protocol: u32,
        /// The name of the class.
        class: Words,
        /// The name of the seat.
        #[serde(default, skip_serializing_if = "Words::is_empty")]
        name: Words,
        /// The user who has opened the desk. A tunnel of SSH hides that user from the carrier.
        #[serde(default, skip_serializing_if = "Words::is_empty")]
        instructor: Words,
    },
    /// The seat cannot join; the connection ends.
    Denied(Denial),
    /// Send the entries of the journal from this number on, and all later ones.
    Ask {
        /// The number of the first entry.
        from: u64,
    },
    /// Send the screen from now on, beginning with a whole picture, or do not send it any more.
    Watch {
        /// Whether it is to be sent.
        on: bool,
        /// Whether what is behind it is to be sent.
        #[serde(default)]
        insight: bool,
    },
    /// A picture of what the desk shows to the class, for seats that look on.
    Show(PicturePart),
    /// The desk no longer shows anything.
    Hide,
    /// Carry out an order, unless it was carried out before.
    Order(Order),
    /// Send the next piece of a record that was handed in.
    Fetch(PieceRequest),
    /// A record that was handed in is complete, or refused.
    Settled {
        /// The record that was handed in.
        record: RecordName,
        /// Whether the desk has it, or why it does not take it.
        end: SubmissionEnd,
    },
    /// The desk has noted how far the record of a try had grown.
    Witnessed {
        /// The record.
        record: RecordName,
        /// The number of its bytes.
        bytes: u64,
    },
    /// The desk is still there, though it has nothing else to say.
    Here,
}

/// Why a seat cannot join.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, Error)]
#[serde(rename_all = "snake_case")]
pub enum Denial {
    /// The desk speaks another version.
    #[error("the desk speaks version {desk} of the protocol")]
    Version {
        /// The version of the desk.
        desk: u32,
    },
    /// The class is full.
    #[error("the class has no free seat")]
    Full,
    /// The seat said something else before its hello, or said hello twice.
    #[error("a connection begins with one hello")]
    NoHello,
}

/// Why a line cannot be read.
#[derive(Debug, Error)]
pub enum LineFault {
    /// The line is longer than [`LONGEST_LINE`].
    #[error("the line is longer than {LONGEST_LINE} bytes")]
    TooLong,
    /// The line is not a message.
    #[error("not a message: {0}")]
    NoMessage(#[from] serde_json::Error),
}

/// Reads a line.
///
/// # Errors
/// The line is too long, or not a message of this kind.
pub fn read<M: DeserializeOwned>(line: &[u8]) -> Result<M, LineFault> {
    if line.len() > LONGEST_LINE {
        return Err(LineFault::TooLong);
    }
    Ok(serde_json::from_slice(line)?)
}

/// A message as a line, with its line end.
pub fn line(message: &impl Serialize) -> String {
    // Plain data with text keys can always be written.
    let mut line = serde_json::to_string(message).unwrap_or_default();
    line.push('\n');
    line
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Deed, OrderId};

    #[test]
    fn messages_are_lines_with_one_field() {
        let hello = SeatMessage::Hello(Hello {
            protocol: VERSION,
            sitting: 7,
            name: None,
        });
        assert_eq!(line(&hello), "{\"hello\":{\"protocol\":1,\"sitting\":7}}\n");
        let order = DeskMessage::Order(Order {
            id: OrderId { desk: 5, number: 1 },
            deed: Deed::Freeze,
        });
        let expected = "{\"order\":{\"id\":{\"desk\":5,\"number\":1},\"deed\":\"freeze\"}}\n";
        assert_eq!(line(&order), expected);
        let back: DeskMessage = read(expected.trim_end().as_bytes()).expect("a message");
        assert_eq!(back, order);
    }

    #[test]
    fn what_is_no_message_is_told_apart() {
        let long = vec![b' '; LONGEST_LINE + 1];
        assert!(matches!(
            read::<SeatMessage>(&long),
            Err(LineFault::TooLong)
        ));
        for wrong in [
            "",
            "{}",
            "nonsense",
            "{\"hello\":{}}",
            "{\"order\":1}",
            "[1]",
        ] {
            let read = read::<SeatMessage>(wrong.as_bytes());
            assert!(matches!(read, Err(LineFault::NoMessage(_))), "{wrong}");
        }
        assert!(matches!(
            read::<SeatMessage>(&[0xff, 0xfe]),
            Err(LineFault::NoMessage(_))
        ));
        let more = "{\"hello\":{\"protocol\":1,\"sitting\":7,\"colour\":\"red\"}}";
        assert!(read::<SeatMessage>(more.as_bytes()).is_ok());
    }
}
