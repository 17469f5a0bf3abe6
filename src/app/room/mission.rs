//! The brief, objectives and rules of the mission in flight; without one, of the mission under the
//! home screen's cursor.

use crate::app::State;
use crate::app::action::{Action, Step};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, does, hint, key, writes};
use crate::app::room::home;
use crate::app::room::page::{PageLine, Tone};
use crate::app::room::{Answer, Room, RoomModel, RoomRequest, footer_keys};
use crate::mission::{Listing, Progress};
use crate::text::Text;
use crate::vehicle::Severity;

mod page;

pub use page::{columns, tasks};

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Mission {
    /// The first line shown.
    pub(in crate::app) scroll: usize,
    /// The hints that the mission has given so far, oldest first.
    pub(in crate::app) hints: Vec<Text>,
}

impl Mission {
    /// The first line shown.
    pub fn scroll(&self) -> usize {
        self.scroll
    }

    /// The hints that the mission has given so far, oldest first.
    pub fn hints(&self) -> &[Text] {
        &self.hints
    }

    /// Stores the hint in a mission's progress if it is new.
    pub fn hear(&mut self, progress: &Progress) {
        if let Some(hint) = &progress.hint
            && !self.hints.contains(hint)
        {
            self.hints.push(hint.clone());
        }
    }
}

/// The mission in the room while its flight has not begun; until then, a sketch of its area
/// replaces the map.
pub fn unflown(state: &State) -> Option<&Listing> {
    let has_begun = state.session.activity.is_some() && !state.session.is_reading();
    shown(state).filter(|_| !has_begun)
}

/// The mission in the room: the one in flight, otherwise the one chosen on the home screen.
pub fn shown(state: &State) -> Option<&Listing> {
    if state.session.activity.is_some() {
        return state.flown_mission();
    }
    home::under_cursor(state)
}

const BRIEF_HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::SCROLL,
    hint(&[Action::Submit], "hint-fly"),
    hint(&[Action::Show(Room::Workshop)], "room-workshop"),
    footer_keys::BACK,
];

/// The key hints while the mission's clock is stopped for reading.
const READING_HINTS: &[KeyHint] = &[
    hint(&[Action::Submit], "hint-start"),
    footer_keys::BACK,
    footer_keys::SCROLL,
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::PREDICT,
    footer_keys::GOAL,
    footer_keys::MISSION_HINT,
];

/// The key hints while the desk of a class holds the brief.
const HELD_HINTS: &[KeyHint] = &[
    footer_keys::BACK,
    footer_keys::SCROLL,
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::PREDICT,
    footer_keys::GOAL,
];

const FLIGHT_HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::SCROLL,
    footer_keys::PREDICT,
    footer_keys::GOAL,
    footer_keys::MISSION_HINT,
    footer_keys::PAUSE,
    hint(&[Action::Again], "hint-again"),
    hint(&[Action::Abandon], "hint-abandon"),
    hint(&[Action::Show(Room::Fly)], "room-fly"),
    hint(&[Action::Show(Room::Map)], "room-map"),
];

impl RoomModel for Mission {
    const KEYS: &'static [KeyRow] = &[
        does(ENTER, Action::Submit),
        does(ESCAPE, Action::Escape),
        writes('s', "predict "),
        writes('g', "goal "),
        writes('w', "hint"),
        writes('o', "workload "),
        writes('e', "inject "),
        does(key('r'), Action::Again),
        does(key('a'), Action::Abandon),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        match state.session.activity {
            Some(_) if state.holds_brief().is_some() => HELD_HINTS,
            Some(_) if state.session.is_reading() => READING_HINTS,
            Some(_) => FLIGHT_HINTS,
            None => BRIEF_HINTS,
        }
    }

    fn step(state: &mut State, step: Step) -> Answer {
        let (width, height) = state.display.size;
        let pages = columns(state, &state.locale, width);
        let lines = pages.iter().map(Vec::len).max().unwrap_or(0);
        let positions = positions(lines, height.saturating_sub(2));
        let scroll = &mut state.rooms.mission.scroll;
        *scroll = step.apply((*scroll).min(positions - 1), positions);
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        if let Some(reason) = state.holds_brief() {
            state.say(Severity::Notice, reason);
            return Some(Vec::new());
        }
        if state.session.activity.is_some() {
            return Some(vec![RoomRequest::Show(Room::Fly)]);
        }
        shown(state)?;
        home::Home::submit(state)
    }

    fn escape(state: &mut State) -> Answer {
        // With its clock stopped, the mission is only being read.
        if state.session.is_reading() {
            return Some(vec![RoomRequest::Leave]);
        }
        let flying = state.session.activity.is_some();
        let room = if flying { Room::Fly } else { Room::Home };
        Some(vec![RoomRequest::Show(room)])
    }
}

/// Scrolls to the newest requested hint, unless it is visible.
pub fn show_asked_hint(state: &mut State) {
    let (width, height) = state.display.size;
    let rows = height.saturating_sub(2);
    let pages = columns(state, &state.locale, width);
    let lines = pages.iter().map(Vec::len).max().unwrap_or(0);
    let is_asked = |line: &PageLine| line.tone == Tone::AskedHint;
    let bounds = pages.iter().find_map(|page| {
        let first = page.iter().position(is_asked)?;
        Some((first, page.iter().rposition(is_asked)?))
    });
    let Some((first, last)) = bounds else {
        return;
    };
    let shown = visible(lines, rows);
    let scroll = &mut state.rooms.mission.scroll;
    if !(*scroll..*scroll + shown).contains(&last) || first < *scroll {
        let to = (last + 1)
            .saturating_sub(shown)
            .max(first.saturating_sub(shown / 2));
        *scroll = to.min(first).min(positions(lines, rows) - 1);
    }
}

/// The rows available for lines on a screen of `rows`: if not all lines fit, the last row shows
/// which ones are visible.
pub fn visible(lines: usize, rows: u16) -> usize {
    let rows = usize::from(rows);
    if lines > rows {
        rows.saturating_sub(1)
    } else {
        rows
    }
}

/// The number of scroll positions; at least one.
pub fn positions(lines: usize, rows: u16) -> usize {
    (lines + 1).saturating_sub(visible(lines, rows)).max(1)
}
