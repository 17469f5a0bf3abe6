//! The ledger: every command, with one row per vehicle for its outcome; and beside them, the commands of other ground
//! stations.

use std::collections::VecDeque;
use std::fmt;
use std::time::Duration;

use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

use crate::pilot_in_command::Person;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::verb::{CountsAs, Verb};

mod foreign;
mod item;

use foreign::ForeignLog;
pub use foreign::{FOREIGN_KEPT, ForeignCommand, ForeignId, StationId};
pub use item::{LedgerItem, LedgerKey, LedgerNumber};

/// The maximum number of entries; the oldest are dropped, so a console left open for days uses
/// little memory.
pub const ENTRIES_KEPT: usize = 10_000;

/// The number of an entry of the ledger.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EntryId(pub u32);

/// The state of a command for one vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
pub enum RowState {
    /// Waiting behind an earlier command to the same vehicle.
    Queued,
    /// Sent, no answer yet.
    Sent,
    /// The vehicle reports progress, 0 to 100 percent.
    InProgress(u8),
    /// Accepted (or sent, where no acknowledgement exists); its effect has not shown yet.
    Accepted,
    /// Sent, and nothing more is awaited: neither an answer nor an effect is known.
    SentOnly,
    /// Telemetry shows the effect; or the command has no visible effect and was accepted.
    Done,
    /// Accepted, but the effect did not show in time.
    NoEffect,
    /// The vehicle refused the command, or it was not sent because it did not suit this vehicle.
    Refused,
    /// No answer before the deadline.
    TimedOut,
    /// A later command took its place.
    Superseded,
    /// Another source has control: another ground station, a failsafe, a pilot's stick. The vehicle's mode and arming
    /// show it ([`Claim`](crate::commands::Claim)); a takeover that changes neither is not detected.
    Overtaken,
    /// It was not sent, because another person flies the vehicle
    /// ([`PilotsInCommand`](crate::pilot_in_command::PilotsInCommand)). No mistake that would cost points.
    Barred,
}

impl RowState {
    /// Whether the row will not change any more.
    pub fn is_final(self) -> bool {
        !matches!(
            self,
            Self::Queued | Self::Sent | Self::InProgress(_) | Self::Accepted
        )
    }

    /// Whether the command ended as intended, as far as the console can determine.
    pub fn is_success(self) -> bool {
        matches!(self, Self::Done | Self::SentOnly)
    }

    /// Whether the command ended otherwise than intended.
    pub fn is_failure(self) -> bool {
        matches!(
            self,
            Self::NoEffect | Self::Refused | Self::TimedOut | Self::Overtaken | Self::Barred
        )
    }
}

impl RowState {
    /// The state in a few words.
    pub fn text(self) -> Text {
        match self {
            Self::InProgress(percent) => text!("state-percent", percent = percent),
            other => other.name(),
        }
    }

    /// The name of the state, without figures.
    pub fn name(self) -> Text {
        match self {
            Self::Queued => text!("state-queued"),
            Self::Sent | Self::SentOnly => text!("state-sent"),
            Self::InProgress(_) => text!("state-in-progress"),
            Self::Accepted => text!("state-accepted"),
            Self::Done => text!("state-done"),
            Self::NoEffect => text!("state-no-effect"),
            Self::Refused | Self::Barred => text!("state-refused"),
            Self::TimedOut => text!("state-timed-out"),
            Self::Superseded => text!("state-superseded"),
            Self::Overtaken => text!("state-overtaken"),
        }
    }
}

/// How a row ends, with the text that explains it.
#[derive(Debug, Clone, PartialEq)]
pub struct RowEnding {
    pub state: RowState,
    pub text: Text,
}

impl RowEnding {
    pub fn new(state: RowState, text: Text) -> Self {
        Self { state, text }
    }
}

impl fmt::Display for RowState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.text().fmt(f)
    }
}

/// A change to one row.
#[derive(Debug, Clone, PartialEq)]
pub struct RowUpdate {
    pub entry: EntryId,
    pub vehicle: VehicleId,
    pub state: RowState,
    /// How many times the command has been sent.
    pub tries: u8,
    pub at: Duration,
    /// The explanation, if there is one.
    pub explanation: Option<Text>,
}

/// One vehicle's part in a command.
#[derive(Debug, Clone, PartialEq)]
pub struct LedgerRow {
    pub vehicle: VehicleId,
    pub state: RowState,
    /// How many times the command has been sent.
    pub tries: u8,
    /// The time from the command to the vehicle's first answer.
    pub answered_after: Option<Duration>,
    /// When the state changed last.
    pub changed_at: Duration,
    /// The reason for a refusal, or a remark.
    pub explanation: Option<Text>,
    /// The reason why the effect of a completed command ended.
    pub ended_by: Option<Text>,
}

impl LedgerRow {
    /// Whether the command was done, but its effect has ended since.
    pub fn is_over(&self) -> bool {
        self.state == RowState::Done && self.ended_by.is_some()
    }

    /// Whether the vehicle has taken the command.
    fn has_been_taken(&self) -> bool {
        match self.state {
            RowState::Queued
            | RowState::Sent
            | RowState::Refused
            | RowState::TimedOut
            | RowState::Barred => false,
            RowState::Superseded => self.answered_after.is_some(),
            RowState::InProgress(_)
            | RowState::Accepted
            | RowState::SentOnly
            | RowState::Done
            | RowState::NoEffect
            | RowState::Overtaken => true,
        }
    }

    /// The state in a few words.
    pub fn text(&self) -> Text {
        match self.state {
            RowState::Done if self.is_over() => text!("state-over"),
            RowState::Sent if self.tries > 1 => text!("state-sent-again", tries = self.tries),
            state => state.text(),
        }
    }

    /// A remark in addition to the state: the explanation, and the reason why the effect ended;
    /// `None` without either.
    pub fn remark(&self) -> Option<Text> {
        let by = self.ended_by.as_ref();
        let ended = by.map(|by| text!("outcome-ended", by = by.clone()));
        let remarks: Vec<Text> = self.explanation.iter().cloned().chain(ended).collect();
        (!remarks.is_empty()).then(|| Text::joined(", ", remarks))
    }
}

/// The risk of a command, whether or not it is accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Risk {
    /// The command carries no special risk.
    #[default]
    None,
    /// It stops motors of a vehicle that may be in the air.
    Unsafe,
    /// It arms by force, or switches the pre-arm checks off.
    SkipsChecks,
}

/// A command to enter in the ledger.
#[derive(Debug, Clone, Copy)]
pub struct Given<'a> {
    /// The whole line in the console's grammar, with its targets.
    pub line: &'a str,
    pub verb: &'static Verb,
    pub risk: Risk,
    /// Who gave it; `None` for the user of the console.
    pub by: Option<&'a Person>,
}

/// A command with its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct LedgerEntry {
    pub id: EntryId,
    /// The time of the command.
    pub at: Duration,
    /// The whole line in the console's grammar, with its targets.
    pub line: String,
    pub verb: &'static Verb,
    pub risk: Risk,
    /// Who gave it; `None` for the user of the console.
    pub by: Option<Person>,
    /// A row per target, in the order of the targets.
    pub rows: Vec<LedgerRow>,
}

impl LedgerEntry {
    /// Whether it counts in a score: commands of an instructor do not.
    pub fn is_judged(&self) -> bool {
        !self.by.as_ref().is_some_and(Person::is_instructor)
    }

    /// Whether the user of the console sees it: what vehicles do not take from an instructor, only the desk learns.
    pub fn is_shown(&self) -> bool {
        self.rows.iter().any(|row| self.shows(row))
    }

    /// Whether the user of the console sees one of the entry's rows.
    pub fn shows(&self, row: &LedgerRow) -> bool {
        self.is_judged() || row.has_been_taken()
    }

    /// The line; that of another person begins with the name, as those of other stations do.
    pub fn said(&self) -> Text {
        Person::said(self.by.as_ref(), self.line.as_str().into())
    }

    /// The state of one of the entry's rows in a few words. A rehearsal without an effect counts as
    /// failed; a raw command is only known to be accepted, because no effect of it is watched.
    pub fn state_of(&self, row: &LedgerRow) -> Text {
        match (self.verb.counts_as, row.state) {
            (CountsAs::Rehearsal, RowState::NoEffect) => text!("state-rehearsal-failed"),
            (_, RowState::Done) if !self.watches_effects() => text!("state-accepted"),
            _ => row.text(),
        }
    }

    /// Whether an effect of the command can be observed, apart from its acceptance; `MAV_CMD`s sent as typed are not
    /// interpreted.
    pub fn watches_effects(&self) -> bool {
        !matches!(self.verb.name, "long" | "int")
    }

    /// Whether every row has ended.
    pub fn is_final(&self) -> bool {
        self.rows.iter().all(|row| row.state.is_final())
    }
}

/// All commands so far, oldest first.
#[derive(Debug, Clone, Default)]
pub struct Ledger {
    entries: VecDeque<LedgerEntry>,
    foreign: ForeignLog,
    next: u32,
    revision: u64,
}

impl Ledger {
    pub fn new() -> Self {
        Self::default()
    }

    /// Opens an entry with a queued row per target.
    pub fn open(&mut self, at: Duration, given: Given<'_>, targets: &[VehicleId]) -> EntryId {
        let id = EntryId(self.next);
        self.next += 1;
        self.revision += 1;
        let rows = targets
            .iter()
            .map(|&vehicle| LedgerRow {
                vehicle,
                state: RowState::Queued,
                tries: 0,
                answered_after: None,
                changed_at: at,
                explanation: None,
                ended_by: None,
            })
            .collect();
        self.entries.push_back(LedgerEntry {
            id,
            at,
            line: given.line.to_owned(),
            verb: given.verb,
            risk: given.risk,
            by: given.by.cloned(),
            rows,
        });
        if self.entries.len() > ENTRIES_KEPT {
            self.entries.pop_front();
        }
        id
    }

    /// Applies an update; one for a dropped entry or an ended row is ignored. A completed row keeps
    /// its state, and notes the reason for a takeover.
    pub fn apply(&mut self, update: &RowUpdate) {
        let Some(entry) = self.position(update.entry).map(|at| &mut self.entries[at]) else {
            return;
        };
        self.revision += 1;
        let given_at = entry.at;
        let mut rows = entry.rows.iter_mut();
        let Some(row) = rows.find(|row| row.vehicle == update.vehicle) else {
            return;
        };
        if row.state == RowState::Done && update.state == RowState::Overtaken {
            row.ended_by.clone_from(&update.explanation);
        }
        if row.state.is_final() {
            return;
        }
        let answered = !matches!(
            update.state,
            RowState::Queued
                | RowState::Sent
                | RowState::SentOnly
                | RowState::TimedOut
                | RowState::Superseded
        );
        if answered && row.answered_after.is_none() {
            row.answered_after = Some(update.at.saturating_sub(given_at));
        }
        row.state = update.state;
        row.tries = update.tries;
        row.changed_at = update.at;
        if update.explanation.is_some() {
            row.explanation.clone_from(&update.explanation);
        }
    }

    /// Notes a command of another station, or its new state.
    pub fn note_foreign(&mut self, command: ForeignCommand) {
        self.revision += 1;
        self.foreign.note(command);
    }

    /// Increases with every change, so readers can skip unchanged states.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// The number that the next entry gets.
    pub fn next(&self) -> EntryId {
        EntryId(self.next)
    }

    pub fn entry(&self, id: EntryId) -> Option<&LedgerEntry> {
        self.position(id).map(|at| &self.entries[at])
    }

    /// The commands of other stations, oldest first.
    pub fn foreign(&self) -> impl DoubleEndedIterator<Item = &ForeignCommand> + ExactSizeIterator {
        self.foreign.all()
    }

    /// The operator's commands and those of other stations, newest first, as far as the user of the console sees them.
    pub fn newest_first(&self) -> impl Iterator<Item = LedgerItem<'_>> {
        let shown = self.entries.iter().rev().filter(|entry| entry.is_shown());
        let mut own = shown.peekable();
        let mut foreign = self.foreign.all().rev().peekable();
        std::iter::from_fn(move || {
            let is_foreign = match (own.peek(), foreign.peek()) {
                (Some(own), Some(foreign)) => foreign.at >= own.at,
                (None, next) => next.is_some(),
                (Some(_), None) => false,
            };
            if is_foreign {
                foreign.next().map(LedgerItem::Foreign)
            } else {
                own.next().map(LedgerItem::Own)
            }
        })
    }

    /// The item of this key.
    pub fn item(&self, key: LedgerKey) -> Option<LedgerItem<'_>> {
        match key.number() {
            LedgerNumber::Own(id) => self.entry(id).map(LedgerItem::Own),
            LedgerNumber::Foreign(id) => self.foreign.get(id).map(LedgerItem::Foreign),
        }
    }

    /// The commands that are judged, oldest first.
    pub fn judged_entries(&self) -> impl DoubleEndedIterator<Item = &LedgerEntry> {
        self.entries.iter().filter(|entry| entry.is_judged())
    }

    /// The commands that were given at this console, oldest first.
    pub fn entries(&self) -> impl DoubleEndedIterator<Item = &LedgerEntry> + ExactSizeIterator {
        self.entries.iter()
    }

    fn position(&self, id: EntryId) -> Option<usize> {
        let first = self.entries.front()?.id.0;
        let at = usize::try_from(id.0.checked_sub(first)?).ok()?;
        (at < self.entries.len()).then_some(at)
    }
}

#[cfg(test)]
mod tests;
