//! Keys of the help and of logs.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::replay;
use crate::app::State;
use crate::app::action::{Action, DebriefAction, ViewAction};
use crate::app::effect::Effects;
use crate::app::keymap::Place;
use crate::app::state::{HelpPage, Log, Overlay};

/// Handles a key in the help, which can be searched.
pub fn help(state: &mut State, mut page: HelpPage, key: KeyEvent) {
    if page.is_searching && write(&mut page, key) {
        state.overlay = Some(Overlay::Help(page));
        return;
    }
    match state.keymap.action(key, Place::Reader) {
        Some(Action::Escape) if page.is_searching && key.code == KeyCode::Enter => {
            page.is_searching = false;
        }
        // The search is cleared first; only then the help closes.
        Some(Action::Escape) if !page.search.is_empty() || page.is_searching => {
            page = HelpPage::default();
        }
        Some(Action::Escape) => return,
        Some(Action::View(ViewAction::Filter)) => page.is_searching = true,
        Some(Action::Move(step)) => {
            let count = page.lines(state.help_scene(), &state.locale).len();
            page.scroll = step.apply(page.scroll, count);
        }
        Some(Action::Debrief(DebriefAction::NextSection)) => {
            let titles = page.titles(state.help_scene(), &state.locale);
            let next = titles.iter().find(|&&line| line > page.scroll);
            page.scroll = next.copied().unwrap_or(0);
        }
        Some(Action::Debrief(DebriefAction::PreviousSection)) => {
            let titles = page.titles(state.help_scene(), &state.locale);
            let before = titles.iter().rfind(|&&line| line < page.scroll);
            page.scroll = before.or(titles.last()).copied().unwrap_or(0);
        }
        _ => {}
    }
    state.overlay = Some(Overlay::Help(page));
}

/// Adds a character to the search, or deletes the last one; returns false if the key means
/// something else.
fn write(page: &mut HelpPage, key: KeyEvent) -> bool {
    let plain = KeyModifiers::NONE | KeyModifiers::SHIFT;
    match key.code {
        KeyCode::Char(c) if plain.contains(key.modifiers) => page.search.push(c),
        KeyCode::Backspace => {
            page.search.pop();
        }
        _ => return false,
    }
    page.scroll = 0;
    true
}

/// Handles a key in a log; a cursor on the newest entry moves to new ones as they arrive.
pub fn log(state: &mut State, log: Log, cursor: Option<usize>, key: KeyEvent) -> Effects {
    let cursor = match state.keymap.action(key, Place::Reader) {
        Some(Action::Escape) if log == Log::Moments && key.code == KeyCode::Enter => {
            return replay::go_to(state, cursor);
        }
        Some(Action::Escape) => return Effects::none(),
        Some(Action::Move(step)) => {
            let count = state.log_length(log);
            let at = step.apply(cursor.unwrap_or(count.saturating_sub(1)), count);
            Some(at).filter(|at| at + 1 < count)
        }
        _ => cursor,
    };
    state.overlay = Some(Overlay::Log { log, cursor });
    Effects::none()
}
