//! All commands: the filter, and the open command.

use crate::app::State;
use crate::app::action::{Action, LedgerAction, Step, ViewAction};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, does, hint, key, latin_line};
use crate::app::room::{Answer, Room, RoomModel, RoomRequest, footer_keys};
use crate::app::state::Purpose;
use crate::ledger::{ForeignCommand, LedgerEntry, LedgerItem, LedgerKey, LedgerNumber, RowState};
use crate::text;
use crate::text::Text;
use crate::vehicle_id::{parse_ranges, ranges};

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Ledger {
    /// The filter as typed.
    pub(in crate::app) filter: String,
    /// The filter by outcome.
    pub(in crate::app) outcome: Outcome,
    /// The command under the cursor; `None` follows the newest.
    pub(in crate::app) cursor: Option<LedgerKey>,
    /// Whether the rows of the command under the cursor fill the screen.
    pub(in crate::app) opened: bool,
    /// The first row shown.
    pub(in crate::app) scroll: usize,
    shown: Vec<LedgerKey>,
    stale: bool,
}

/// Which commands are shown, by outcome.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Outcome {
    #[default]
    Any,
    /// Commands that failed for at least one vehicle.
    Failed,
    /// Commands still in progress for at least one vehicle.
    UnderWay,
    /// Commands that every vehicle has completed.
    Done,
}

impl Outcome {
    /// The outcome's heading; `None` if commands of all outcomes are shown.
    pub fn title(self) -> Option<Text> {
        match self {
            Self::Any => None,
            Self::Failed => Some(text!("commands-only-failed")),
            Self::UnderWay => Some(text!("commands-only-under-way")),
            Self::Done => Some(text!("commands-only-done")),
        }
    }

    fn next(self) -> Self {
        match self {
            Self::Any => Self::Failed,
            Self::Failed => Self::UnderWay,
            Self::UnderWay => Self::Done,
            Self::Done => Self::Any,
        }
    }

    fn fits_foreign(self, command: &ForeignCommand) -> bool {
        match self {
            Self::Any => true,
            Self::Failed => command.state.is_failure(),
            // The console does not follow the effects of foreign commands.
            Self::UnderWay => matches!(command.state, RowState::InProgress(_)),
            Self::Done => command.state == RowState::Accepted,
        }
    }

    fn fits(self, entry: &LedgerEntry) -> bool {
        let mut states = entry.rows.iter().map(|row| row.state);
        match self {
            Self::Any => true,
            Self::Failed => states.any(RowState::is_failure),
            Self::UnderWay => states.any(|state| !state.is_final()),
            Self::Done => states.all(|state| state == RowState::Done),
        }
    }
}

impl Ledger {
    /// The filter as typed.
    pub fn filter_text(&self) -> &str {
        &self.filter
    }

    /// The filter by outcome.
    pub fn outcome(&self) -> Outcome {
        self.outcome
    }

    /// The command under the cursor; `None` follows the newest.
    pub fn cursor(&self) -> Option<LedgerKey> {
        self.cursor
    }

    /// Whether the rows of the command under the cursor fill the screen.
    pub fn is_opened(&self) -> bool {
        self.opened
    }

    /// The first row shown.
    pub fn scroll(&self) -> usize {
        self.scroll
    }

    /// The shown commands, oldest first.
    pub fn shown(&self) -> &[LedgerKey] {
        &self.shown
    }

    /// The index of the cursor among the shown commands.
    pub fn place(&self) -> usize {
        let newest = self.shown.len().saturating_sub(1);
        let Some(cursor) = self.cursor else {
            return newest;
        };
        // If the command is gone or filtered out, the cursor is on the next one.
        let place = self.shown.partition_point(|&key| key < cursor);
        place.min(newest)
    }

    /// The command under the cursor.
    pub fn under_cursor(&self) -> Option<LedgerKey> {
        self.shown.get(self.place()).copied()
    }

    /// Marks the list as outdated.
    pub fn spoil(&mut self) {
        self.stale = true;
    }
}

const HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::MOVE,
    hint(&[Action::Submit], "hint-open"),
    hint(&[Action::View(ViewAction::Filter)], "hint-filter"),
    hint(&[Action::Ledger(LedgerAction::NextOutcome)], "hint-outcome"),
    hint(&[Action::Ledger(LedgerAction::OwnVehicles)], "hint-own"),
    footer_keys::BACK,
];

impl RoomModel for Ledger {
    const KEYS: &'static [KeyRow] = &[
        does(key('/'), Action::View(ViewAction::Filter)),
        does(key('o'), Action::Ledger(LedgerAction::NextOutcome)),
        does(key('v'), Action::Ledger(LedgerAction::OwnVehicles)),
        does(ENTER, Action::Submit),
        does(ESCAPE, Action::Escape),
    ];

    fn hints(_state: &State) -> &'static [KeyHint] {
        HINTS
    }

    fn step(state: &mut State, step: Step) -> Answer {
        let room = &mut state.rooms.ledger;
        if room.opened {
            let key = room.under_cursor();
            let item = key.and_then(|key| state.session.commands.ledger.item(key));
            let rows = match item {
                Some(LedgerItem::Own(entry)) => entry.rows.len(),
                Some(LedgerItem::Foreign(_)) | None => 0,
            };
            room.scroll = step.apply(room.scroll, rows);
        } else {
            let count = room.shown.len();
            let place = step.apply(room.place(), count);
            let moved = room.shown.get(place).filter(|_| place + 1 < count);
            room.cursor = moved.copied();
        }
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        let room = &mut state.rooms.ledger;
        // A foreign command is one row, which the list shows in full.
        let has_rows = room
            .under_cursor()
            .is_some_and(|key| matches!(key.number(), LedgerNumber::Own(_)));
        room.opened = !room.opened && has_rows;
        room.scroll = 0;
        Some(Vec::new())
    }

    fn escape(state: &mut State) -> Answer {
        escape(state);
        Some(Vec::new())
    }

    fn view(state: &mut State, action: ViewAction) -> Answer {
        match action {
            ViewAction::Filter => {
                let filter = state.rooms.ledger.filter.clone();
                state.prompt(Purpose::Filter(Room::Ledger), filter);
                Some(Vec::new())
            }
            ViewAction::Sort
            | ViewAction::SortReverse
            | ViewAction::NextVehicle
            | ViewAction::PreviousVehicle
            | ViewAction::NextPage
            | ViewAction::Window => None,
        }
    }

    fn entered(state: &mut State) {
        find(state);
    }

    fn filter(state: &mut State, text: &str) {
        filter(state, text);
    }
}

pub(super) fn act(state: &mut State, action: LedgerAction) -> Vec<RoomRequest> {
    match action {
        LedgerAction::NextOutcome => {
            let room = &mut state.rooms.ledger;
            room.outcome = room.outcome.next();
            find(state);
        }
        LedgerAction::OwnVehicles => {
            let mine = ranges(state.addressed());
            let is_on = state.rooms.ledger.filter == mine;
            filter(state, if is_on { "" } else { &mine });
        }
    }
    Vec::new()
}

pub fn filter(state: &mut State, text: &str) {
    text.trim().clone_into(&mut state.rooms.ledger.filter);
    find(state);
}

/// Updates the list if it is outdated and on the screen; returns whether it was updated.
pub fn tick(state: &mut State) -> bool {
    let is_due = state.rooms.ledger.stale && state.room == Room::Ledger;
    if is_due {
        find(state);
    }
    is_due
}

fn find(state: &mut State) {
    let room = &mut state.rooms.ledger;
    room.stale = false;
    let outcome = room.outcome;
    let found = |filter: &str| -> Vec<LedgerKey> {
        let terms = terms(filter);
        let items = state.session.commands.ledger.newest_first();
        let fitting = items.filter(|&item| fits(outcome, &terms, item));
        fitting.map(LedgerItem::key).collect()
    };
    room.shown = found(&room.filter);
    // Nothing is found as typed: the filter may be in another keyboard layout.
    if room.shown.is_empty()
        && let Some(read) = latin_line(&room.filter)
    {
        room.shown = found(&read);
    }
    room.shown.reverse();
}

fn fits(outcome: Outcome, terms: &[Term], item: LedgerItem<'_>) -> bool {
    match item {
        LedgerItem::Own(entry) => outcome.fits(entry) && terms.iter().all(|term| term.fits(entry)),
        LedgerItem::Foreign(command) => {
            outcome.fits_foreign(command) && terms.iter().all(|term| term.fits_foreign(command))
        }
    }
}

/// Closes the open rows; otherwise clears the filters; otherwise leaves the room.
fn escape(state: &mut State) {
    state.hush();
    let room = &mut state.rooms.ledger;
    if room.opened {
        room.opened = false;
    } else if !room.filter.is_empty() || room.outcome != Outcome::Any {
        room.outcome = Outcome::Any;
        filter(state, "");
    } else if state.session.activity.is_some() {
        state.room = Room::Fly;
    }
}

/// A word of the filter; all must match.
enum Term {
    /// The command addresses one of these vehicles.
    Vehicles(Vec<u16>),
    /// The command's line or its outcome contains this text.
    Word(String),
}

fn terms(filter: &str) -> Vec<Term> {
    let words = filter.split_whitespace();
    let term = |word: &str| match parse_ranges(word.trim_end_matches(['-', ','])) {
        Ok(ids) => Term::Vehicles(ids),
        Err(_) => Term::Word(word.to_lowercase()),
    };
    words.map(term).collect()
}

impl Term {
    fn fits_foreign(&self, command: &ForeignCommand) -> bool {
        match self {
            Self::Vehicles(ids) => ids.binary_search(&command.vehicle).is_ok(),
            Self::Word(word) => {
                let line = command.line().to_string().to_lowercase();
                line.contains(word) || became(command.state).contains(word)
            }
        }
    }

    fn fits(&self, entry: &LedgerEntry) -> bool {
        match self {
            Self::Vehicles(ids) => {
                let mut rows = entry.rows.iter();
                rows.any(|row| ids.binary_search(&row.vehicle).is_ok())
            }
            Self::Word(word) => {
                let in_line = entry.line.to_lowercase().contains(word);
                in_line
                    || entry
                        .rows
                        .iter()
                        .any(|row| became(row.state).contains(word))
            }
        }
    }
}

/// The filter word for an outcome.
fn became(state: RowState) -> &'static str {
    match state {
        RowState::Queued => "queued",
        RowState::Sent | RowState::SentOnly => "sent",
        RowState::InProgress(_) => "in-progress",
        RowState::Accepted => "accepted",
        RowState::Done => "done effect-seen",
        RowState::NoEffect => "no-effect failed",
        RowState::Refused => "refused failed",
        RowState::TimedOut => "timed-out failed",
        RowState::Superseded => "superseded",
        RowState::Overtaken => "superseded overtaken failed",
        RowState::Barred => "refused barred failed",
    }
}
