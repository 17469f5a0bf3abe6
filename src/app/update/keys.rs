//! Key presses: handled by the overlay if one is open, otherwise through the keymap.

use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

use super::{act, consequence, palette, profiles, prompt, reader, selection, sticks, typing};
use crate::app::State;
use crate::app::action::Action;
use crate::app::effect::{Effect, Effects};
use crate::app::keymap::{Meaning, Place, latin_key};
use crate::app::room::{Room, plans};
use crate::app::state::{Confirm, Overlay, YES};
use crate::language::{Word, words};
use crate::notice::sanitised;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// An Enter within this time after an answer counts as part of that answer.
const ANSWER_ENDS_WITHIN: Duration = Duration::from_secs(1);

pub fn press(state: &mut State, key: KeyEvent) -> Effects {
    if key.kind == KeyEventKind::Release {
        return Effects::none();
    }
    if state.display().is_too_small() {
        return unseen(state, key);
    }
    if ends_an_answer(state, key) {
        return Effects::none();
    }
    match state.overlay.take() {
        Some(Overlay::Palette(line)) => palette::key(state, line, key),
        Some(Overlay::Confirm(question)) => confirm(state, question, key),
        Some(Overlay::Prompt(prompt)) => prompt::key(state, prompt, key),
        Some(Overlay::Profiles { cursor }) => profiles::key(state, cursor, key),
        Some(Overlay::Sticks(mode)) => sticks::key(state, mode, key),
        Some(Overlay::Help(page)) => {
            reader::help(state, page, key);
            Effects::none()
        }
        Some(Overlay::Log { .. }) if opens_command_line(state, key) => {
            palette::open(state, String::new());
            Effects::none()
        }
        Some(Overlay::Log { log, cursor }) => reader::log(state, log, cursor, key),
        None => on_screen(state, key),
    }
}

fn opens_command_line(state: &State, key: KeyEvent) -> bool {
    state.keymap.action(key, Place::Anywhere) == Some(Action::CommandLine)
}

/// Whether a key is an Enter after an answer that was already complete without it: it is not meant
/// for the next screen.
fn ends_an_answer(state: &mut State, key: KeyEvent) -> bool {
    let answered_at = state.typing.answered_at.take();
    let is_fresh = answered_at.is_some_and(|at| state.wall.saturating_sub(at) < ANSWER_ENDS_WITHIN);
    is_fresh && key.code == KeyCode::Enter
}

/// Handles a clicked cell. Overlays take no clicks.
pub fn click(state: &mut State, column: u16, row: u16) {
    if state.overlay.is_some() || state.display.is_too_small() {
        return;
    }
    let size = state.display.grid();
    if state.room == Room::Map {
        state.rooms.map.click(size, column, row);
    } else if state.room == Room::Plans {
        plans::click(state, column, row);
    }
}

/// Handles a new size of the terminal. A question that is no longer visible is answered with no.
pub fn resize(state: &mut State, columns: u16, rows: u16) {
    state.display.size = (columns, rows);
    if state.display().is_too_small()
        && let Some(Overlay::Confirm(question)) = &state.overlay
    {
        let text = cancelled(question);
        state.overlay = None;
        state.say(Severity::Notice, text);
    }
}

/// Handles a key while the terminal is too small: only quitting works, without a question.
fn unseen(state: &State, key: KeyEvent) -> Effects {
    match state.keymap.action(key, Place::Anywhere) {
        Some(Action::Quit) => Effects::from(Effect::Quit),
        _ => Effects::none(),
    }
}

/// Handles a click on an element drawn for an action. Overlays take keys only.
pub fn choose(state: &mut State, action: Action) -> Effects {
    if state.display().is_too_small() || state.is_deaf() || state.overlay.is_some() {
        return Effects::none();
    }
    act::act(state, action)
}

pub fn paste(state: &mut State, text: &str) {
    if state.display().is_too_small() {
        return;
    }
    // Terminals end pasted lines with the character of the Enter key.
    let mut lines = text
        .split(['\n', '\r'])
        .filter(|line| !line.trim().is_empty());
    let first_line = lines.next().unwrap_or_default();
    let more = lines.count();
    if more > 0 {
        // Joined or truncated, the lines would be a different command from the copied one.
        let text = text!("footer-paste-lines", count = more + 1);
        return state.say(Severity::Warning, text);
    }
    let text = sanitised(first_line);
    match state.overlay.take() {
        Some(Overlay::Palette(mut line)) => {
            typing::insert(&mut line.input, &text);
            palette::edited(state, line);
        }
        Some(Overlay::Prompt(mut prompt)) => {
            typing::insert(&mut prompt.input, &text);
            state.overlay = Some(Overlay::Prompt(prompt));
        }
        other @ (None
        | Some(
            Overlay::Confirm(_)
            | Overlay::Sticks(_)
            | Overlay::Profiles { .. }
            | Overlay::Help(_)
            | Overlay::Log { .. },
        )) => {
            state.overlay = other;
            let key = state.keymap.key(Action::CommandLine, Place::Anywhere);
            state.say(Severity::Notice, text!("footer-paste-dropped", key = key));
        }
    }
}

/// The line that leaves a session.
const LEAVE: &str = "leave";

fn on_screen(state: &mut State, key: KeyEvent) -> Effects {
    if state.is_deaf() {
        return Effects::none();
    }
    let resolved = || state.keymap.resolve(key, Place::Replay);
    let in_replay = state.shows_past().then(resolved).flatten();
    let meaning = in_replay.or_else(|| in_room(state, key));
    let meaning = meaning.cloned();
    if leaves_crew(state, key, meaning.as_ref()) {
        return act::act(state, Action::Leave);
    }
    match meaning {
        Some(Meaning::Do(action)) => act::act(state, action),
        Some(Meaning::Write(words)) => {
            palette::write(state, &words);
            Effects::none()
        }
        Some(Meaning::Give(line)) => {
            let line = addressed(state, &line);
            palette::give_by_key(state, &line)
        }
        Some(Meaning::Type) => {
            if let KeyCode::Char(c) = key.code {
                selection::type_ids(state, c);
            }
            Effects::none()
        }
        None => Effects::none(),
    }
}

/// Whether a key leaves the crew, at a member: the one that writes `leave` in a flight does it without the line there,
/// also in rooms that do not use it. What is lost is asked about anyway.
fn leaves_crew(state: &State, key: KeyEvent, meaning: Option<&Meaning>) -> bool {
    let is_leave = |meaning: &Meaning| matches!(meaning, Meaning::Write(line) if line == LEAVE);
    let in_flight = || state.keymap.resolve(key, Place::In(Room::Fly));
    state.crew.member().is_some() && meaning.or_else(in_flight).is_some_and(is_leave)
}

/// The meaning of a key in the room. A comma continues a vehicle list; without one, it counts by its position: `?`.
fn in_room(state: &State, key: KeyEvent) -> Option<&Meaning> {
    let place = Place::In(state.room);
    let is_stray = key.code == KeyCode::Char(',') && state.typing.targets.is_empty();
    match state.keymap.resolve(key, place) {
        Some(Meaning::Type) if is_stray => state.keymap.by_position(key, place),
        found => found,
    }
}

/// A key's command line with the typed vehicle list as targets, unless the line names its own.
fn addressed(state: &mut State, line: &str) -> String {
    let typed = std::mem::take(&mut state.typing.targets);
    let names_targets = words(line).first().is_some_and(Word::is_targets);
    if typed.is_empty() || names_targets || palette::is_to_console(state, line) {
        line.to_owned()
    } else {
        format!("{typed} {line}")
    }
}

/// Handles a key while a question is open. Only the exact answer confirms, or the key of `y` in the
/// Ukrainian layout; any other key means no. Enter, Esc, their replacements in a keymap file, and
/// `n` close the question at once; the command line's key opens the command line, as everywhere.
/// After any other character, the question stays on the screen as cancelled and ignores further
/// keys; otherwise a line typed blindly would act on the screen below.
fn confirm(state: &mut State, mut question: Confirm, key: KeyEvent) -> Effects {
    let control = key.modifiers.contains(KeyModifiers::CONTROL);
    let ends = matches!(
        state.keymap.action(key, Place::Prompt),
        Some(Action::Submit | Action::Escape)
    );
    match key.code {
        _ if opens_command_line(state, key) => {
            refuse(state, &question);
            palette::open(state, String::new());
        }
        _ if ends => refuse(state, &question),
        // Whatever a keymap file binds them to, they never confirm and always close the question.
        KeyCode::Enter | KeyCode::Esc => refuse(state, &question),
        KeyCode::Char(_) if control => refuse(state, &question),
        KeyCode::Char('n' | 'т') if question.answer == YES => refuse(state, &question),
        KeyCode::Char(c) if !question.cancelled => {
            let answer = answered(&question, c);
            question.typed.push(answer);
            if question.typed == question.answer {
                state.typing.answered_at = Some(state.wall);
                let mut effects = consequence::carry_out(state, question.then);
                effects.extend(palette::go_on(state));
                return effects;
            }
            question.cancelled = !question.answer.starts_with(&question.typed);
            state.overlay = Some(Overlay::Confirm(question));
        }
        _ => {
            question.cancelled = true;
            state.overlay = Some(Overlay::Confirm(question));
        }
    }
    Effects::none()
}

/// The character of an answer: `н` and `Н` lie on the key of `y`.
fn answered(question: &Confirm, typed: char) -> char {
    match latin_key(typed) {
        Some('y' | 'Y') if question.answer == YES => 'y',
        _ => typed,
    }
}

fn refuse(state: &mut State, question: &Confirm) {
    state.typing.macro_lines.clear();
    state.say(Severity::Notice, cancelled(question));
}

fn cancelled(question: &Confirm) -> Text {
    text!("ask-cancelled", question = &question.question)
}
