//! The mission's brief, objectives and rules: of the one that is flown, else of the one that the home screen
//! has under its cursor.

use crate::app::action::Action;
use crate::app::effect::Effect;
use crate::app::keymap::{ENTER, ESCAPE, Row, does, key, writes};
use crate::app::room::Room;
use crate::app::room::home;
use crate::app::state::State;
use crate::app::update::act::show;
use crate::mission::{Listing, Progress};
use crate::text::Text;

mod page;

pub use page::{PageLine, Tone, columns};

/// What the room remembers.
#[derive(Debug, Clone, Default)]
pub struct Mission {
    /// The first line shown.
    pub scroll: usize,
    /// The hints that the mission has given so far, oldest first.
    pub hints: Vec<Text>,
}

impl Mission {
    /// Keeps the hint of a mission's progress, if it is a new one.
    pub fn hear(&mut self, progress: &Progress) {
        if let Some(hint) = &progress.hint
            && !self.hints.contains(hint)
        {
            self.hints.push(hint.clone());
        }
    }
}

/// Its keys.
pub const KEYS: &[Row] = &[
    does(ENTER, Action::Submit),
    does(ESCAPE, Action::Escape),
    writes('s', "predict "),
    writes('g', "goal "),
    writes('w', "hint"),
    writes('e', "inject "),
    does(key('r'), Action::Again),
    does(key('a'), Action::Abandon),
];

/// The mission that is shown.
pub fn shown(state: &State) -> Option<&Listing> {
    if state.session.activity.is_some() {
        return state.flown_mission();
    }
    home::under_cursor(state)
}

/// What its actions do.
pub fn act(state: &mut State, action: Action) -> Option<Vec<Effect>> {
    match action {
        Action::Move(step) => {
            let (width, height) = state.size;
            let pages = columns(state, &state.locale, width);
            let lines = pages.iter().map(Vec::len).max().unwrap_or(0);
            let positions = positions(lines, height.saturating_sub(2));
            let scroll = &mut state.rooms.mission.scroll;
            *scroll = step.apply((*scroll).min(positions - 1), positions);
            Some(Vec::new())
        }
        Action::Submit if state.session.activity.is_none() => {
            shown(state)?;
            home::act(state, action)
        }
        Action::Escape | Action::Submit => {
            let flying = state.session.activity.is_some();
            show(state, if flying { Room::Fly } else { Room::Home });
            Some(Vec::new())
        }
        _ => None,
    }
}

/// Rows for lines on a screen of `rows`: where not all fit, the last row says which are shown.
pub fn visible(lines: usize, rows: u16) -> usize {
    let rows = usize::from(rows);
    if lines > rows {
        rows.saturating_sub(1)
    } else {
        rows
    }
}

/// How many lines can be the first one shown; at least one.
pub fn positions(lines: usize, rows: u16) -> usize {
    (lines + 1).saturating_sub(visible(lines, rows)).max(1)
}
