//! The command line: the line itself, the wrong word marked, what could follow.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget};
use tui_input::Input;

use crate::app::State;
use crate::app::action::{Action, LineAction};
use crate::app::keymap::Place;
use crate::app::state::Palette;
use crate::diagnostic::Diagnostic;
use crate::language::Completion;
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, clip, put, row_of, wrap};

/// Rows of the box: frame, line, mark, message, choices.
const HEIGHT: u16 = 13;
/// Rows of what is wrong with a word, and of how the verb is written.
const FAULT_ROWS: usize = 4;
const HINT_ROWS: usize = 3;
/// Columns of a wrong word in what is said about it.
const LONGEST_WORD: usize = 24;
/// Columns before the line.
const PROMPT: u16 = 2;

/// Draws the box above the footer and returns where the terminal's cursor belongs.
pub fn draw(state: &State, palette: &Palette, panel: Panel<'_>, buffer: &mut Buffer) -> Position {
    let place = Rect {
        y: panel.area.bottom().saturating_sub(HEIGHT + 1),
        height: HEIGHT,
        ..panel.area
    };
    let title = format!(
        "{} {}",
        panel.say("palette-title"),
        panel.text(palette.recipients())
    );
    let inner = panel
        .at(place)
        .boxed(title.trim_end(), Role::Accent, buffer);
    let fault = palette.fault();
    let (cursor, scroll) = draw_line(palette.input(), fault, panel.at(inner), buffer);
    let mut rest = below(inner, 1);
    if let Some(fault) = fault {
        draw_carets(
            palette.input().value(),
            fault,
            scroll,
            panel.at(rest),
            buffer,
        );
        rest = below(rest, 1);
    }
    let grammar = text!(
        "palette-grammar",
        complete = state
            .keymap()
            .key(Action::Line(LineAction::Complete), Place::Prompt),
        older = state
            .keymap()
            .key(Action::Line(LineAction::Older), Place::Prompt)
    );
    for line in explanation(
        palette,
        &grammar,
        usize::from(indented(rest).width),
        panel.look,
    ) {
        put(buffer, indented(rest), 0, &line);
        rest = below(rest, 1);
    }
    draw_choices(palette, panel.at(below(rest, 1)), buffer);
    cursor
}

/// What is wrong, how the verb is written, and what Enter would do.
fn explanation(palette: &Palette, grammar: &Text, width: usize, look: &Look) -> Vec<Line<'static>> {
    let fault = palette.fault().map(|fault| {
        let said = match &fault.help {
            Some(help) => format!("{} - {}", look.text(&fault.message), look.text(help)),
            None => look.text(&fault.message),
        };
        // A word of many lines would leave no room for what is wrong with it.
        let (_, wrong, _) = parts(palette.input().value(), Some(fault));
        match clip(wrong, LONGEST_WORD) {
            whole if whole == wrong => said,
            cut => said.replace(wrong, &cut),
        }
    });
    // A wrong line without a verb is not helped by the grammar.
    let hint = match palette.hint() {
        Some(hint) => Some(look.text(hint)),
        None => fault.is_none().then(|| look.text(grammar)),
    };
    let outcome = palette.outcome().map(|text| look.text(text));
    let parts = [
        (fault.as_deref(), FAULT_ROWS, Role::Danger),
        (hint.as_deref(), HINT_ROWS, Role::Muted),
        (outcome.as_deref(), 1, Role::Ok),
    ];
    let mut lines = Vec::new();
    for (text, rows, role) in parts {
        let wrapped = wrap(text.unwrap_or_default(), width).into_iter();
        let shown = wrapped.filter(|line| !line.is_empty()).take(rows);
        lines.extend(shown.map(|line| Line::styled(line, look.style(role))));
    }
    lines
}

/// Draws a prompt and its text, scrolled so that the cursor is seen; returns the cursor's place and the scroll.
pub fn draw_line(
    input: &Input,
    fault: Option<&Diagnostic>,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) -> (Position, usize) {
    let text = Rect {
        height: 1.min(panel.area.height),
        ..indented(panel.area)
    };
    let scroll = input.visual_scroll(usize::from(text.width).saturating_sub(1).max(1));
    put(
        buffer,
        panel.area,
        0,
        &Line::styled(": ", panel.style(Role::Key)),
    );
    let (before, wrong, after) = parts(input.value(), fault);
    let line = Line::from(vec![
        Span::raw(before),
        Span::styled(wrong, panel.style(Role::Error)),
        Span::raw(after),
    ]);
    Paragraph::new(line)
        .scroll((0, scroll as u16))
        .render(text, buffer);
    let column = input.visual_cursor().saturating_sub(scroll) as u16;
    let x = (text.x + column).min(text.right().saturating_sub(1));
    (Position::new(x, text.y), scroll)
}

/// The line before the wrong word, the word, and the line after it.
fn parts<'a>(line: &'a str, fault: Option<&Diagnostic>) -> (&'a str, &'a str, &'a str) {
    let whole = (line, "", "");
    let Some(span) = fault.map(|fault| &fault.span) else {
        return whole;
    };
    match (
        line.get(..span.start),
        line.get(span.clone()),
        line.get(span.end..),
    ) {
        (Some(before), Some(wrong), Some(after)) => (before, wrong, after),
        _ => whole,
    }
}

/// Carets under the wrong word, so that it is marked without colour too.
fn draw_carets(
    line: &str,
    fault: &Diagnostic,
    scroll: usize,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let (before, wrong, _) = parts(line, Some(fault));
    let start = Span::raw(before).width().saturating_sub(scroll);
    let carets = format!(
        "{}{}",
        " ".repeat(start),
        "^".repeat(Span::raw(wrong).width().max(1))
    );
    let line = Line::styled(carets, panel.style(Role::Danger));
    put(buffer, indented(panel.area), 0, &line);
}

fn draw_choices(palette: &Palette, panel: Panel<'_>, buffer: &mut Buffer) {
    let choices = palette.completions();
    let (rows, width) = (
        usize::from(panel.area.height),
        usize::from(panel.area.width),
    );
    // The chosen one is the last row once the list has to scroll.
    let first = palette
        .chosen()
        .map_or(0, |chosen| (chosen + 1).saturating_sub(rows));
    let widest = choices
        .iter()
        .skip(first)
        .take(rows)
        .map(|choice| choice.text.chars().count())
        .max();
    let name_width = widest.unwrap_or(0).clamp(12, 24);
    let mut blocks: Vec<Vec<Line<'_>>> = choices
        .iter()
        .enumerate()
        .skip(first)
        .take(rows)
        .map(|(at, choice)| {
            let is_chosen = palette.chosen() == Some(at);
            choice_lines(choice, is_chosen, name_width, width, panel.look)
        })
        .collect();
    // Each in full where there is room for all, else a line for each.
    if blocks.iter().map(Vec::len).sum::<usize>() > rows {
        for block in &mut blocks {
            block.truncate(1);
        }
    }
    let mut rest = panel.area;
    for (at, block) in blocks.into_iter().enumerate() {
        let is_chosen = palette.chosen() == Some(first + at);
        for line in block {
            put(buffer, rest, 0, &line);
            if is_chosen {
                panel.at(row_of(rest, 0)).mark_cursor(buffer);
            }
            rest = below(rest, 1);
        }
    }
}

/// A choice and what it means, in as many lines as that takes.
fn choice_lines<'a>(
    choice: &'a Completion,
    is_chosen: bool,
    name_width: usize,
    width: usize,
    look: &Look,
) -> Vec<Line<'a>> {
    let mut mark = if is_chosen { "> " } else { "  " };
    let mut name = clip(&choice.text, name_width);
    // A verb without arguments has its name for a usage: once is enough.
    let said = format!("{}: ", choice.text);
    let explained = look.text(&choice.hint);
    let hint = explained.strip_prefix(&said).unwrap_or(&explained);
    let room = width.saturating_sub(name_width + 4);
    let mut lines = Vec::new();
    for text in wrap(hint, room) {
        let name = std::mem::take(&mut name);
        lines.push(Line::from(vec![
            Span::raw(std::mem::replace(&mut mark, "  ")),
            Span::styled(format!("{name:name_width$}  "), look.style(Role::Key)),
            Span::styled(text, look.style(Role::Muted)),
        ]));
    }
    lines
}

fn indented(area: Rect) -> Rect {
    let by = PROMPT.min(area.width);
    Rect {
        x: area.x + by,
        width: area.width - by,
        ..area
    }
}
