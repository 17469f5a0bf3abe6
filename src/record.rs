//! The recording of a flight: the frames of its links, and a journal of everything that the frames do not contain.
//!
//! A record is a set of files with one stem. `STEM.tlog` holds the frames of all links in both directions, as other
//! ground stations write and read them. `STEM.flight.jsonl` holds the [`Head`] and then a [`JournalLine`] for each
//! command, each change of its rows, each command of another ground station, each bookmark, and each other event that is
//! not in the frames. `STEM.run.jsonl` is the mission's own record, from which it is scored again
//! ([`mission::record`](crate::mission::record)).
//! `STEM.inputs.jsonl` holds the inputs of simulated vehicles, with which the flight can be repeated ([`InputsHead`],
//! [`InputLine`]). The console writes the journal with `shell::session::recorder`, and the run record with its
//! `logbook`; a pilot script's flight keeps both in a [`FlightLog`].
//!
//! Times count from the beginning of the record, without the pauses in which everything was stopped; the journal lists
//! the pauses, from which [`DayClock`] computes the time of day.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::geo::LatLon;
use crate::moment::{Moment, MomentKind};
use crate::pilot_in_command::Person;
use crate::text;
use crate::text::Text;

mod day_clock;
mod desk_line;
mod flight_log;
mod foreign_line;
mod inputs;
mod instructor;
mod journal_fit;
mod line;
mod mission_clock;

pub use day_clock::DayClock;
pub use desk_line::DeskRecord;
pub use flight_log::{FlightLog, push_frame};
pub use foreign_line::ForeignLine;
pub use inputs::{
    Entered, Frames, InputLine, InputLog, InputsHead, StoredInputs, fingerprint, has_fingerprint,
};
pub use instructor::{InstructorAct, InstructorPart};
pub use journal_fit::{JournalFit, JournalNeighbours};
use line::is_next;
pub use line::{EntryLine, Happening, JournalLine, LossLine, NoticeLine, PathLine, RowLine};
pub use mission_clock::MissionClock;

/// The version of the journal's format.
const VERSION: u32 = 1;

/// The mission, time and pilot of a flight: the first line of a journal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Head {
    /// The version of the format.
    pub sortie_flight: u32,
    /// The program that recorded the session.
    pub program: String,
    /// The time of day when it began: microseconds since 1970 (UTC). Timestamps of the tlog count
    /// from 1970 as well.
    pub began_unix_us: u64,
    pub subject: Subject,
    /// The name of the pilot's profile, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<String>,
    /// At the host of a crew: its user, as the members know them. Commands and vehicles without a name are theirs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub host: Option<Person>,
    /// The named places of the mission, for commands.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub places: BTreeMap<String, LatLon>,
    /// The speed-up over the wall clock at the start.
    #[serde(default = "real_time", skip_serializing_if = "is_real_time")]
    pub speedup: f64,
}

fn real_time() -> f64 {
    1.0
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "the serialiser passes references"
)]
fn is_real_time(speedup: &f64) -> bool {
    (*speedup - 1.0).abs() < f64::EPSILON
}

/// The subject of a recorded session.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Subject {
    /// A mission by its id; the details are in the mission's own record.
    Mission(String),
    /// Simulated vehicles without a task.
    Free,
    /// Running vehicles at these addresses.
    Connected(Vec<String>),
}

impl Subject {
    /// A word for file names: the id of the mission, `free` or `connect`.
    pub fn slug(&self) -> &str {
        match self {
            Self::Mission(id) => id,
            Self::Free => "free",
            Self::Connected(_) => "connect",
        }
    }

    /// The id of the mission, if one was flown.
    pub fn mission(&self) -> Option<&str> {
        match self {
            Self::Mission(id) => Some(id),
            Self::Free | Self::Connected(_) => None,
        }
    }

    pub fn text(&self) -> Text {
        match self {
            Self::Mission(id) => id.as_str().into(),
            Self::Free => text!("session-free"),
            Self::Connected(addresses) => addresses.join(" ").into(),
        }
    }
}

impl Head {
    /// The head of a session that begins at a time of day, in microseconds since 1970 (UTC).
    pub fn new(subject: Subject, began_unix_us: u64) -> Self {
        Self {
            sortie_flight: VERSION,
            program: env!("SORTIE_VERSION").to_owned(),
            began_unix_us,
            subject,
            profile: None,
            host: None,
            places: BTreeMap::new(),
            speedup: 1.0,
        }
    }

    /// The head as a line, with its line end.
    pub fn to_line(&self) -> String {
        line::written(self)
    }
}

/// A journal, as read from its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Journal {
    pub head: Head,
    /// The events, oldest first.
    pub lines: Vec<JournalLine>,
    /// The damage to the file after its readable part.
    pub damage: Option<Text>,
    /// The line numbers of lines of unknown kinds.
    pub unknown: Vec<usize>,
}

/// The time of any line of a journal, even of one from a later program.
#[derive(Deserialize)]
struct LineTime {
    us: u64,
}

impl Journal {
    /// Reads a journal. A damaged line, or one with an impossible time, ends it.
    ///
    /// # Errors
    /// The text is not a journal, or comes from another version.
    pub fn read(text: &str) -> Result<Self, Text> {
        let mut all = text.split_inclusive('\n');
        let first = all.next().unwrap_or_default();
        let version = serde_json::from_str::<serde_json::Value>(first)
            .ok()
            .and_then(|head| head.get("sortie_flight")?.as_u64())
            .ok_or_else(|| text!("journal-none"))?;
        if version != u64::from(VERSION) {
            return Err(text!("record-version", version = version, known = VERSION));
        }
        let head: Head = serde_json::from_str(first)
            .map_err(|error| text!("record-head", error = error.to_string()))?;
        let mut journal = Self {
            head,
            lines: Vec::new(),
            damage: None,
            unknown: Vec::new(),
        };
        for (index, line) in all.enumerate() {
            if let Err(damage) = journal.add(line, index + 2) {
                journal.damage = Some(damage);
                break;
            }
        }
        Ok(journal)
    }

    /// Adds whole lines that the file has got since; returns whether there were any. A damaged line ends it.
    pub fn grow(&mut self, lines: &str) -> bool {
        let before = self.lines.len();
        for line in lines.split_inclusive('\n') {
            if self.damage.is_some() {
                break;
            }
            // The number of a line in the file: the head is the first.
            let number = self.lines.len() + self.unknown.len() + 2;
            self.damage = self.add(line, number).err();
        }
        self.lines.len() > before
    }

    /// Adds a line of the file.
    ///
    /// # Errors
    /// Why the line ends the journal.
    fn add(&mut self, line: &str, number: usize) -> Result<(), Text> {
        let since = self.lines.last().map_or(Duration::ZERO, JournalLine::at);
        match serde_json::from_str::<JournalLine>(line) {
            Ok(line) if line.can_follow(since) => self.lines.push(line),
            Ok(_) => return Err(text!("journal-time", line = number)),
            Err(_) if !line.ends_with('\n') => return Err(text!("journal-cut", line = number)),
            Err(_) => match serde_json::from_str::<LineTime>(line) {
                // Lines written by a later version of the program are skipped.
                Ok(time) if is_next(Duration::from_micros(time.us), since) => {
                    self.unknown.push(number);
                }
                Err(fault) if !fault.is_data() => {
                    let column = fault.column();
                    return Err(text!("journal-damaged", line = number, column = column));
                }
                Ok(_) | Err(_) => return Err(text!("journal-time", line = number)),
            },
        }
        Ok(())
    }

    /// The faults of the lines: damage, and lines of unknown kinds.
    pub fn faults(&self) -> impl Iterator<Item = Text> {
        let first = self.unknown.first();
        let unknown = first.map(|&line| {
            let count = self.unknown.len();
            text!("journal-unknown", count = count, line = line)
        });
        self.damage.clone().into_iter().chain(unknown)
    }

    /// Whether the session was ended normally.
    pub fn is_whole(&self) -> bool {
        matches!(self.lines.last(), Some(line) if line.what == Happening::End)
    }

    /// The bookmarks in the journal, oldest first.
    pub fn bookmarks(&self) -> impl Iterator<Item = Moment> + '_ {
        self.lines.iter().filter_map(|line| match &line.what {
            Happening::Bookmark { text } => Some(Moment {
                at: line.at(),
                vehicles: Vec::new(),
                kind: MomentKind::Bookmark,
                by: None,
                text: Text::verbatim(text.clone()),
            }),
            Happening::Entry(_)
            | Happening::Row(_)
            | Happening::Foreign(_)
            | Happening::Notice(_)
            | Happening::Loss(_)
            | Happening::Paths(_)
            | Happening::Speedup { .. }
            | Happening::Paused { .. }
            | Happening::Mission { .. }
            | Happening::Desk(_)
            | Happening::Crew(_)
            | Happening::End => None,
        })
    }
}

#[cfg(test)]
mod tests;
