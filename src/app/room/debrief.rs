//! What the flight was worth.

use std::time::Duration;

use crate::app::action::Action;
use crate::app::effect::Effect;
use crate::app::keymap::{ESCAPE, Row, does, key};
use crate::app::state::State;
use crate::debrief;
use crate::notice::sanitised;
use crate::scoring::Report;
use crate::text::Locale;

/// Keys pressed so soon after the debrief has opened were meant for the flight.
const DEAF: Duration = Duration::from_secs(1);

/// A debrief.
#[derive(Debug, Clone)]
pub struct Debrief {
    /// The result.
    pub report: Box<Report>,
    /// The first line shown.
    pub scroll: usize,
    /// When it opened: keys that were meant for the flight must not close it.
    pub since: Duration,
}

impl Debrief {
    /// The result as text, line by line, in the words of a language.
    pub fn lines(&self, locale: &Locale) -> Vec<String> {
        let text = debrief::text(&self.report, locale);
        text.lines().map(sanitised).collect()
    }

    /// Whether it has opened so recently that keys were meant for the flight.
    pub fn is_deaf(&self, now: Duration) -> bool {
        now.saturating_sub(self.since) < DEAF
    }
}

/// Its keys.
pub const KEYS: &[Row] = &[
    does(key('r'), Action::Again),
    does(key('h'), Action::Leave),
    does(ESCAPE, Action::Leave),
];

/// What its actions do.
pub fn act(state: &mut State, action: Action) -> Option<Vec<Effect>> {
    let Action::Move(step) = action else {
        return None;
    };
    // Scrolling ends with the last page; the header and the footer take a row each.
    let rows = usize::from(state.size.1).saturating_sub(2);
    if let Some(debrief) = &mut state.rooms.debrief {
        let lines = debrief.lines(&state.locale).len();
        let positions = (lines + 1).saturating_sub(rows).max(1);
        debrief.scroll = step.apply(debrief.scroll.min(positions - 1), positions);
    }
    Some(Vec::new())
}
