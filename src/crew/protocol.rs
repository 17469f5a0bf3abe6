//! The lines between the host of a crew and its members.
//!
//! Both sides send JSON objects with one field each, one per line, as in a class. A member begins with
//! [`MemberMessage::Hello`]; the host answers with [`HostMessage::Welcome`] or [`HostMessage::Denied`]. Then the host
//! sends its record, from the beginning or from where the member has got to: the member cannot ask for any other file.

use serde::{Deserialize, Serialize};

use super::{CrewDeed, Role};
use crate::class::{PieceBytes, RecordName, RecordPart, Words};
use crate::text::{StoredText, Text};

/// The version of the protocol; it increases with every change that is not an addition.
pub const VERSION: u32 = 2;
/// The maximum length of a member's line, in characters.
const LONGEST_SAID: usize = 1000;

/// A line of a member.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MemberMessage {
    /// The first line of a connection.
    Hello(CrewHello),
    /// A command for the host to carry out.
    Say {
        /// The number of the line, which the answer repeats.
        id: u32,
        line: SaidLine,
        confirmed: Confirmed,
        /// When it was given, by the host's wall clock in ms, as far as the member knows it ([`HostMessage::Clock`]).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        given_ms: Option<u64>,
    },
    /// A deed about the pilots of vehicles.
    Act {
        /// The number of the deed, which the answer repeats.
        id: u32,
        deed: CrewDeed,
    },
    /// The member is still there.
    Here,
    /// The member's user leaves the crew; the connection ends.
    Leave,
}

/// The first line of a member.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrewHello {
    /// The version of the protocol.
    pub protocol: u32,
    /// The role that the member wants; `None` for that of a free post.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub role: Option<Role>,
    /// What the member has of a record from before the connection broke.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub has: Option<HeldRecord>,
}

/// How much of a record a member has.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct HeldRecord {
    pub record: RecordName,
    /// The bytes of each of its files.
    pub bytes: Vec<(RecordPart, u64)>,
}

/// What the member has confirmed about a command.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Confirmed {
    /// Nothing: the member was not asked.
    #[default]
    Nothing,
    /// That the verb is dangerous.
    Danger,
    /// A particular hazard that the member's console has found.
    Hazard,
}

/// A command of a member: one line without control characters.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct SaidLine(String);

impl TryFrom<String> for SaidLine {
    type Error = &'static str;

    fn try_from(line: String) -> Result<Self, Self::Error> {
        let is_short = line.chars().take(LONGEST_SAID + 1).count() <= LONGEST_SAID;
        let is_plain = !line.chars().any(char::is_control);
        (is_short && is_plain)
            .then_some(Self(line))
            .ok_or("not a command")
    }
}

impl From<SaidLine> for String {
    fn from(line: SaidLine) -> Self {
        line.0
    }
}

impl SaidLine {
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

/// A line of the host.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HostMessage {
    /// The member belongs to the crew now.
    Welcome {
        /// The version of the protocol.
        protocol: u32,
        /// The name of the crew.
        crew: Words,
        /// The name of the host's user.
        host: Words,
        /// The name under which the member commands.
        name: Words,
        role: Role,
    },
    /// The user cannot join; the connection ends.
    Denied(CrewDenial),
    /// The member's role has changed, because another mission has begun.
    Role(Role),
    /// The record of a flight follows, in pieces.
    Record(RecordName),
    /// The next bytes of a file of the record.
    Piece { part: RecordPart, data: PieceBytes },
    /// Everything up to this time of the record, in microseconds, has been sent.
    Now { us: u64 },
    /// The record has ended, and all of it has been sent.
    Ended,
    /// Who is on the crew.
    Roster(Vec<RosterLine>),
    /// Something for the member to read: a proposal, or what came of one.
    Notice(SentText),
    /// The answer to a line or a deed.
    Answer {
        id: u32,
        /// Why it was not done; `None` if it was.
        fault: Option<SentText>,
    },
    /// The host is still there.
    Here,
    /// The host's wall clock in ms, once a second. Its beginning is the host's own.
    Clock { ms: u64 },
    /// The host ends the crew, and the connection.
    Closing,
}

/// Somebody on the crew, as everybody sees it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RosterLine {
    pub name: Words,
    /// `None` for the host.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub role: Option<Role>,
    /// The proposals that this person has made and that wait for an answer.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub proposals: Vec<SentText>,
}

/// Why a user cannot join.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CrewDenial {
    /// The host speaks another version.
    Version { host: u32 },
    /// The crew is full.
    Full,
    /// The user has as many places as one may have.
    FullForUser,
    /// Something else was said before the hello, or a second hello.
    NoHello,
}

/// A text in English, and as a message for other languages.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SentText {
    english: Words,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    message: Option<StoredText>,
}

impl From<&Text> for SentText {
    fn from(text: &Text) -> Self {
        Self {
            english: text.to_string().into(),
            message: text.stored(),
        }
    }
}

impl SentText {
    /// The text, in the words of this console's language if it knows them.
    pub fn text(&self) -> Text {
        let english = self.english.as_str();
        let known = self.message.as_ref().map(|it| it.text(english));
        known.unwrap_or_else(|| Text::verbatim(english))
    }
}
