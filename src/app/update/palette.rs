//! The command line while it is open: its keys, completions and history, and running its line.

use crossterm::event::KeyEvent;
use tui_input::Input;

use super::console_line;
use super::latin::{in_latin, in_typed};
use super::order::Given;
use super::{offer, order, typing};
use crate::app::State;
use crate::app::action::{Action, LineAction};
use crate::app::effect::{Effect, Effects, FileEffect};
use crate::app::keymap::{Meaning, Place};
use crate::app::state::{Folder, Overlay, Palette};
use crate::diagnostic::Diagnostic;
use crate::language::{self, Completion, VehicleChoice, words};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;
use crate::vehicle_id::ranges;

/// The maximum number of lines that one macro may run in total; a macro that calls itself would otherwise never end.
const MACRO_LINES: usize = 100;

/// Opens the command line with a text.
pub fn open(state: &mut State, line: String) {
    let palette = Palette {
        input: Input::new(line),
        ..Palette::default()
    };
    // Files may have come and gone since the last line.
    state.typing.folder = None;
    edited(state, palette);
}

/// Opens the command line with the text of a key. A vehicle list being typed becomes the targets.
pub fn write(state: &mut State, words: &str) {
    let targets = std::mem::take(&mut state.typing.targets);
    let line = if targets.is_empty() {
        words.to_owned()
    } else {
        format!("{targets} {words}")
    };
    open(state, line);
    if let Some(Overlay::Palette(palette)) = &mut state.overlay {
        words.clone_into(&mut palette.written);
    }
}

/// Whether a key only repeats the one that has just written a whole word: pressed twice, the key of
/// `hint` must not give `hintw`.
fn repeats(state: &State, palette: &Palette, key: KeyEvent) -> bool {
    let written = &palette.written;
    let is_whole_word = written.ends_with(char::is_alphanumeric);
    let is_untouched = palette.input.value().ends_with(written.as_str());
    let meaning = state.keymap.resolve(key, Place::In(state.room));
    let is_same = matches!(meaning, Some(Meaning::Write(words)) if words == written);
    is_whole_word && is_untouched && is_same
}

/// Handles a key while the command line is open.
pub fn key(state: &mut State, mut palette: Palette, key: KeyEvent) -> Effects {
    match state.keymap.action(key, Place::Prompt) {
        Some(Action::Escape) => return Effects::none(),
        Some(Action::Submit) => return submit(state, palette),
        Some(Action::Line(LineAction::Complete)) => complete(state, palette, true),
        Some(Action::Line(LineAction::CompleteBack)) => complete(state, palette, false),
        Some(Action::Line(LineAction::Older)) => browse(state, palette, true),
        Some(Action::Line(LineAction::Newer)) => browse(state, palette, false),
        _ if repeats(state, &palette, key) => state.overlay = Some(Overlay::Palette(palette)),
        _ => {
            if typing::edit(&mut palette.input, key) {
                palette.history_at = None;
                palette.written.clear();
                edited(state, palette);
            } else {
                state.overlay = Some(Overlay::Palette(palette));
            }
        }
    }
    Effects::none()
}

/// Updates the completions after a change to the line.
pub fn edited(state: &mut State, mut palette: Palette) {
    let typed = palette.input.value().to_owned();
    let typed_cursor = byte_cursor(&palette.input);
    palette.chosen = None;
    judge(state, &mut palette);
    // A line in another layout is completed as it will be read, once it is being continued.
    let read = palette
        .reading
        .clone()
        .filter(|_| typed_cursor == typed.len());
    let cursor = read.as_ref().map_or(typed_cursor, String::len);
    let line = read.unwrap_or(typed);
    look_into_folder(state, &line, cursor);
    let mut found = state.with_context(|context| language::complete(&line, cursor, context));
    // Exact matches come first, then prefixes, then words that contain the letters; commands before modes.
    found.sort_by_key(|completion| {
        let typed = line.get(completion.replaces.clone()).unwrap_or_default();
        let command = language::row(&completion.text).is_some();
        let is_typed = completion.text.eq_ignore_ascii_case(typed);
        // A line may leave out the group or the seat, but not what follows.
        let may_be_left_out = completion.text.starts_with('@');
        let is_begun = completion.text.starts_with(typed);
        (!is_typed, !is_begun, !command, may_be_left_out)
    });
    // In the middle of a command, other commands are not useful.
    let has_verb = line.trim_start().contains(char::is_whitespace) && palette.hint.is_some();
    if !has_verb {
        found.retain(|it| state.may_write(&it.text));
    }
    if cursor == line.len() && !has_verb {
        let offered = offer::lines(state, &line);
        let is_new = |offered: &Completion| found.iter().all(|it| it.text != offered.text);
        let offered: Vec<Completion> = offered.into_iter().filter(is_new).collect();
        found.extend(offered);
    }
    palette.completions = found;
    palette.before_tab = line;
    state.overlay = Some(Overlay::Palette(palette));
}

/// Stores the folder of the file name at the cursor.
fn look_into_folder(state: &mut State, line: &str, cursor: usize) {
    let begun = state.with_context(|context| language::file_begun(line, cursor, context));
    let folder = begun.map(|begun| begun.rfind('/').map_or("", |at| &begun[..=at]));
    if folder
        != state
            .typing
            .folder
            .as_ref()
            .map(|known| known.path.as_str())
    {
        state.typing.folder = folder.map(|path| Folder {
            path: path.to_owned(),
            names: None,
            is_asked: false,
        });
    }
}

/// Requests the files of the folder that is being typed, if they were not requested before.
pub fn wanted(state: &mut State) -> Option<Effect> {
    let folder = state.typing.folder.as_mut().filter(|it| !it.is_asked)?;
    folder.is_asked = true;
    Some(Effect::File(FileEffect::List {
        folder: folder.path.clone(),
    }))
}

/// Handles the answer to [`wanted`]: the files of a folder.
pub fn listed(state: &mut State, path: &str, names: Vec<String>) {
    let Some(folder) = &mut state.typing.folder else {
        return;
    };
    if folder.path != path {
        return;
    }
    folder.names = Some(names);
    match state.overlay.take() {
        // A completion that Tab has inserted stays.
        Some(Overlay::Palette(palette)) if palette.chosen.is_none() => edited(state, palette),
        other => state.overlay = other,
    }
}

/// Evaluates the line so far: its targets, its usage, its faults, and what Enter would do.
fn judge(state: &State, palette: &mut Palette) {
    palette.reading = in_latin(state, palette.input.value());
    let typed = palette.input.value();
    let line = palette.reading.as_deref().unwrap_or(typed);
    palette.recipients = recipients(state, line);
    palette.hint = state
        .with_context(|context| language::hint(line, context))
        .or_else(|| language::usages_begun(line));
    palette.fault = None;
    palette.outcome = None;
    match order::read(state, line) {
        Ok(Given::Own(_)) => {}
        Ok(Given::Order(order)) => palette.outcome = Some(order::announced(state, &order)),
        Err(fault) => {
            let being_written = byte_cursor(&palette.input);
            let fault = in_typed(fault, line, typed);
            palette.fault = Some(fault).filter(|fault| is_finished(typed, fault, being_written));
        }
    }
}

/// Whether a fault is in finished words: the word at the cursor may still become valid, and missing words may follow.
fn is_finished(line: &str, fault: &Diagnostic, cursor: usize) -> bool {
    let span = &fault.span;
    let goes_on = line
        .get(span.end..)
        .is_some_and(|rest| rest.starts_with(char::is_whitespace));
    !span.is_empty() && goes_on && !(span.start..=span.end).contains(&cursor)
}

fn byte_cursor(input: &Input) -> usize {
    let at = input.value().char_indices().nth(input.cursor());
    at.map_or(input.value().len(), |(at, _)| at)
}

/// Inserts the next or the previous completion; a single one is followed by a space.
fn complete(state: &mut State, mut palette: Palette, forward: bool) {
    let count = palette.completions.len();
    if let Some(read) = palette.reading.take_if(|_| count == 0) {
        palette.input = Input::new(read);
        return edited(state, palette);
    }
    if count == 0 {
        state.overlay = Some(Overlay::Palette(palette));
        return;
    }
    let next = match palette.chosen {
        Some(at) if forward => (at + 1) % count,
        Some(at) => (at + count - 1) % count,
        None if forward => 0,
        None => count - 1,
    };
    let completion = &palette.completions[next];
    let line = &palette.before_tab;
    let head = line.get(..completion.replaces.start).unwrap_or(line);
    let tail = line.get(completion.replaces.end..).unwrap_or_default();
    // A file in it follows the name of a folder, a value the name of a field.
    let is_whole = !completion.text.ends_with(['/', '=']);
    let gap = if is_whole && !tail.starts_with(' ') {
        " "
    } else {
        ""
    };
    let start = format!("{head}{}{gap}", completion.text);
    let cursor = start.chars().count();
    palette.input = Input::new(format!("{start}{tail}")).with_cursor(cursor);
    if count == 1 {
        edited(state, palette);
    } else {
        judge(state, &mut palette);
        palette.chosen = Some(next);
        state.overlay = Some(Overlay::Palette(palette));
    }
}

fn browse(state: &mut State, mut palette: Palette, older: bool) {
    let count = state.typing.history.len();
    let at = match (palette.history_at, older) {
        (None, true) if count > 0 => Some(0),
        (Some(at), true) => Some((at + 1).min(count.saturating_sub(1))),
        (Some(at), false) => at.checked_sub(1),
        (None, _) => {
            state.overlay = Some(Overlay::Palette(palette));
            return;
        }
    };
    if palette.history_at.is_none() {
        palette.input.value().clone_into(&mut palette.draft);
    }
    palette.history_at = at;
    let shown = at.and_then(|at| state.typing.history.iter().rev().nth(at));
    palette.input = Input::new(shown.cloned().unwrap_or_else(|| palette.draft.clone()));
    edited(state, palette);
}

/// Runs a line; a faulty one stays on the command line with its fault.
pub fn give(state: &mut State, line: &str) -> Effects {
    state.hush();
    let palette = Palette {
        input: Input::new(line.to_owned()),
        ..Palette::default()
    };
    submit(state, palette)
}

/// Runs the line of a key. If it is refused although it can be read, there is nothing to correct: the last line says why,
/// and the next key is not taken for a letter.
pub fn give_by_key(state: &mut State, line: &str) -> Effects {
    let effects = give(state, line);
    let Some(Overlay::Palette(palette)) = &state.overlay else {
        return effects;
    };
    let refusal = palette.fault.as_ref().map(|fault| fault.message.clone());
    if let Some(refusal) = refusal.filter(|_| order::read(state, line).is_ok()) {
        state.overlay = None;
        state.say(Severity::Warning, refusal);
    }
    effects
}

fn submit(state: &mut State, mut palette: Palette) -> Effects {
    let typed = palette.input.value();
    if typed.trim().is_empty() {
        return Effects::none();
    }
    let line = in_latin(state, typed).unwrap_or_else(|| typed.to_owned());
    match carry_out(state, &line) {
        Ok(mut effects) => {
            state.typing.remember(line.trim());
            effects.extend(go_on(state));
            effects
        }
        Err(fault) => {
            state.typing.macro_lines.clear();
            // The line stays as it was read, with the faulty word marked.
            if line != palette.input.value() {
                palette.input = Input::new(line);
                palette.reading = None;
            }
            palette.fault = Some(fault);
            state.overlay = Some(Overlay::Palette(palette));
            Effects::none()
        }
    }
}

/// Runs the waiting lines of a macro, up to one that asks a question or has a fault.
pub fn go_on(state: &mut State) -> Effects {
    let mut effects = Effects::none();
    for _ in 0..MACRO_LINES {
        if state.overlay.is_some() {
            return effects;
        }
        let Some(line) = state.typing.macro_lines.pop_front() else {
            return effects;
        };
        match carry_out(state, &line) {
            Ok(more) => effects.extend(more),
            Err(fault) => {
                state.typing.macro_lines.clear();
                let input = Input::new(line);
                state.overlay = Some(Overlay::Palette(Palette {
                    input,
                    fault: Some(fault),
                    ..Palette::default()
                }));
            }
        }
    }
    if !state.typing.macro_lines.is_empty() {
        state.typing.macro_lines.clear();
        let text = text!("macro-endless", count = MACRO_LINES);
        state.say(Severity::Error, text);
    }
    effects
}

fn carry_out(state: &mut State, line: &str) -> Result<Effects, Diagnostic> {
    match order::read(state, line)? {
        Given::Own(own) => console_line::carry_out(state, line, own),
        Given::Order(order) => Ok(order::give(state, order)),
    }
}

/// Whether the line typed so far is addressed to the console itself.
pub fn is_to_console(state: &State, line: &str) -> bool {
    let said = state.with_context(|context| language::said(line, context));
    said.is_ok_and(|row| !row.scope.takes_targets())
}

/// Whether the line typed so far is addressed to the mission, not to a vehicle.
fn is_to_mission(state: &State, line: &str) -> bool {
    let said = state.with_context(|context| language::said(line, context));
    said.is_ok_and(|row| row.scope.takes_targets() && row.verb.counts_as.is_said_to_mission())
}

/// The targets of the line typed so far, shown to the user before Enter.
fn recipients(state: &State, line: &str) -> Text {
    let is_to_none = is_to_console(state, line) || is_to_mission(state, line);
    if is_to_none || state.session.vehicles.is_empty() {
        return Text::default();
    }
    if let Some(targets) = words(line).first().filter(|word| word.is_targets()) {
        let choice = VehicleChoice::read(targets);
        let chosen = choice.and_then(|choice| state.chosen(&choice));
        let ids = chosen.unwrap_or_default();
        return if ids.is_empty() {
            Text::default()
        } else {
            text!("palette-to", vehicles = ranges(ids))
        };
    }
    let vehicles = ranges(state.addressed());
    if state.session.choice.selection.is_empty() {
        text!("palette-to-cursor", vehicles = vehicles)
    } else {
        text!("palette-to-selected", vehicles = vehicles)
    }
}
