//! The text overlays: help, and the question before a dangerous action.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::{Action, DebriefAction, ViewAction};
use crate::app::keymap::Place;
use crate::app::state::{Confirm, HelpLine, HelpPage, Overlay, SHORT_USAGE};
use crate::notice::sanitised;
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{centred, put, wrap};

const HELP_COLUMN: u16 = 74;

/// The widths of a question with its frame, and of the frame, in columns.
const CONFIRM_WIDTH: u16 = 64;
const CONFIRM_FRAME: u16 = 4;

/// Draws an overlay; those with a text cursor are in separate files.
pub fn draw(state: &State, overlay: &Overlay, panel: Panel<'_>, buffer: &mut Buffer) {
    match overlay {
        Overlay::Confirm(question) => draw_confirm(state, question, panel, buffer),
        Overlay::Profiles { cursor } => {
            super::profiles::draw(state, *cursor, panel, buffer);
        }
        Overlay::Sticks(mode) => super::sticks::draw(state, mode, panel, buffer),
        Overlay::Help(page) => draw_help(state, page, panel, buffer),
        Overlay::Log { log, cursor } => {
            super::log::draw(state, *log, *cursor, panel, buffer);
        }
        Overlay::Palette(_) | Overlay::Prompt(_) => {}
    }
}

/// Draws a question in full with its reason; no word is cut.
fn draw_confirm(state: &State, question: &Confirm, panel: Panel<'_>, buffer: &mut Buffer) {
    let width = usize::from(CONFIRM_WIDTH - CONFIRM_FRAME);
    let answer = question.wanted();
    let request = if question.wants_one_key() {
        text!("ask-press", answer = answer)
    } else {
        text!("ask-type", answer = answer)
    };
    let text = format!(
        "{} - {}",
        panel.text(question.question()),
        panel.text(&request)
    );
    let danger = panel.style(Role::Danger);
    let asked = wrap(&text, width).into_iter();
    let reason = wrap(&panel.text(question.reason()), width);
    let mut lines: Vec<Line<'_>> = asked.map(|line| Line::styled(line, danger)).collect();
    lines.extend(reason.into_iter().map(Line::raw));
    lines.push(Line::default());
    lines.push(typed_line(state, question, panel));
    let place = centred(CONFIRM_WIDTH, lines.len() as u16 + 2, panel.area);
    let inner = panel
        .at(place)
        .boxed(&panel.say("ask-sure"), Role::Danger, buffer);
    for (row, line) in (0..).zip(&lines) {
        put(buffer, inner, row, line);
    }
}

/// The typed part of the answer, and the effect of other keys.
fn typed_line(state: &State, question: &Confirm, panel: Panel<'_>) -> Line<'static> {
    if question.is_cancelled() {
        let text = panel.text(&text!(
            "ask-taken-back",
            submit = state.keymap().key(Action::Submit, Place::Prompt),
            escape = state.keymap().key(Action::Escape, Place::Prompt)
        ));
        return Line::styled(text, panel.style(Role::Warning));
    }
    Line::from(vec![
        Span::styled(typed_so_far(question), panel.style(Role::Key)),
        Span::styled(panel.say("ask-else"), panel.style(Role::Muted)),
    ])
}

/// The typed part of an answer; an answer of a single key has no text field, because it takes effect at once.
fn typed_so_far(question: &Confirm) -> String {
    if question.wants_one_key() {
        String::new()
    } else {
        format!(": {}_   ", question.typed())
    }
}

/// The title of the help: the search text, and the keys.
fn help_title(state: &State, page: &HelpPage, look: &Look) -> String {
    let help = text!(
        "help-title",
        scroll = state.keymap().keys(Action::UP_AND_DOWN, Place::Reader),
        section = state
            .keymap()
            .key(Action::Debrief(DebriefAction::NextSection), Place::Reader),
        search = state
            .keymap()
            .key(Action::View(ViewAction::Filter), Place::Reader),
        key = state.keymap().key(Action::Escape, Place::Reader)
    );
    let keys = look.text(&help);
    let cursor = if page.is_searching() { "_" } else { "" };
    if page.search().is_empty() && cursor.is_empty() {
        return keys;
    }
    format!("/{}{cursor}   {keys}", sanitised(page.search()))
}

fn draw_help(state: &State, page: &HelpPage, panel: Panel<'_>, buffer: &mut Buffer) {
    let scroll = page.scroll();
    let lines = page.lines(state.help_scene(), &panel.look.locale);
    let place = centred(
        (panel.area.width / HELP_COLUMN).max(1) * HELP_COLUMN + 6,
        panel.area.height - 2,
        panel.area,
    );
    let inner = panel
        .at(place)
        .boxed(&help_title(state, page, panel.look), Role::Accent, buffer);
    if lines.is_empty() {
        let nothing = Line::styled(panel.say("help-none"), panel.style(Role::Muted));
        put(buffer, inner, 0, &nothing);
    }
    let columns = usize::from((inner.width / HELP_COLUMN).max(1));
    let rows = usize::from(inner.height);
    let first = scroll.min(lines.len().saturating_sub(rows * columns));
    let count = lines.len().div_ceil(columns);
    panel
        .at(inner)
        .mark_scroll(first.div_ceil(columns), count, buffer);
    for (at, line) in lines
        .into_iter()
        .skip(first)
        .take(rows * columns)
        .enumerate()
    {
        let column = (at / rows) as u16;
        let x = inner.x + column * HELP_COLUMN;
        let here = Rect {
            x,
            width: HELP_COLUMN.min(inner.right() - x),
            ..inner
        };
        put(
            buffer,
            here,
            (at % rows) as u16,
            &help_line(line, panel.look),
        );
    }
}

fn help_line(line: HelpLine, look: &Look) -> Line<'static> {
    match line {
        HelpLine::Title(text) => Line::styled(text, look.style(Role::Title)),
        HelpLine::Note(text) => Line::styled(format!("      {text}"), look.style(Role::Muted)),
        HelpLine::Usage(text) => Line::styled(format!("      {text}"), look.style(Role::Key)),
        HelpLine::Blank => Line::default(),
        HelpLine::Entry(what, meaning) => Line::from(vec![
            Span::styled(format!("  {what:SHORT_USAGE$} "), look.style(Role::Key)),
            Span::raw(meaning),
        ]),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    /// The characters of a box.
    const LINES: [char; 6] = ['│', '─', '┌', '┐', '└', '┘'];

    use crate::app::effect::Effect;
    use crate::app::state::Consequence;
    use crate::app::{App, Setup};
    use crate::text::{Language, Locale, Text, messages};

    use super::*;

    /// The content of the question's box, on one line.
    fn shown(question: &Text, reason: &Text, language: Language) -> String {
        let look = Look {
            locale: Arc::new(Locale::new(language)),
            ..Look::default()
        };
        let app = App::new(Setup::default());
        let confirm = Confirm::new(
            question.clone(),
            reason.clone(),
            Consequence::Effect(Effect::Quit),
        );
        let area = Rect::new(0, 0, 80, 24);
        let mut buffer = Buffer::empty(area);
        draw_confirm(app.state(), &confirm, Panel::new(&look, area), &mut buffer);
        let symbols: String = buffer
            .content
            .iter()
            .map(ratatui::buffer::Cell::symbol)
            .collect();
        let words = symbols.replace(LINES, " ");
        words.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// Tests every question with every reason, because any message can be either.
    #[test]
    fn no_question_is_cut_on_a_small_screen() {
        for language in Language::ALL {
            let locale = Locale::new(language);
            let plain = |text: &Text| -> String {
                let words = locale.text(text).replace(LINES, " ");
                words.split_whitespace().collect::<Vec<_>>().join(" ")
            };
            let lost = text!("ask-exam-ends");
            let lines = messages(language).iter().flat_map(|(_, it)| it.lines());
            let ids = lines.filter_map(|line| line.split_once(" = "));
            let ids = ids.filter(|(id, _)| id.starts_with(|c: char| c.is_ascii_lowercase()));
            for (id, _) in ids {
                let reason = Text::joined("; ", vec![lost.clone(), Text::new(id, Vec::new())]);
                let question = Text::new(id, Vec::new());
                let shown = shown(&question, &reason, language);
                assert!(shown.contains(&plain(&question)), "{id}: {shown}");
                assert!(shown.contains(&plain(&reason)), "{id}: {shown}");
                assert!(shown.ends_with(&plain(&text!("ask-else"))), "{id}: {shown}");
            }
        }
    }
}
