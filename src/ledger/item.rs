//! The items of the ledger: the operator's commands and those of other stations, in the order of
//! time.

use std::time::Duration;

use super::foreign::{ForeignCommand, ForeignId};
use super::{EntryId, LedgerEntry};

/// A command of the operator, or of another station.
#[derive(Debug, Clone, Copy)]
pub enum LedgerItem<'a> {
    Own(&'a LedgerEntry),
    Foreign(&'a ForeignCommand),
}

/// The key of an item, in the order of time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct LedgerKey {
    at: Duration,
    number: LedgerNumber,
}

/// The number of an item among those of its kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum LedgerNumber {
    Own(EntryId),
    Foreign(ForeignId),
}

impl LedgerKey {
    pub fn number(self) -> LedgerNumber {
        self.number
    }
}

impl LedgerItem<'_> {
    pub fn key(self) -> LedgerKey {
        match self {
            Self::Own(entry) => LedgerKey {
                at: entry.at,
                number: LedgerNumber::Own(entry.id),
            },
            Self::Foreign(command) => LedgerKey {
                at: command.at,
                number: LedgerNumber::Foreign(command.id),
            },
        }
    }
}
