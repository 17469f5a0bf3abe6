//! The command line: completions, faults, and the line itself with the faulty word marked.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget};
use tui_input::Input;

use crate::app::State;
use crate::app::action::{Action, LineAction};
use crate::app::keymap::Place;
use crate::app::state::{Palette, Room};
use crate::diagnostic::Diagnostic;
use crate::language::Completion;
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, clip, clip_rows, mission, put, row_of, wrap};

/// The maximum number of rows of the box: frame, completions, message, line.
const HEIGHT: u16 = 13;
/// The height and the width of the box's frame, with the margins inside it.
const FRAME_ROWS: usize = 2;
const FRAME: usize = 4;
/// The height of the screen below which the box covers the mission pane, and the number of rows of
/// the lesson's step in the box.
const LOW: u16 = 36;
const LESSON_ROWS: usize = 4;
/// The numbers of rows of a fault, and of a verb's usage.
const FAULT_ROWS: usize = 4;
const HINT_ROWS: usize = 3;
/// The maximum width of a faulty word in its fault, in columns.
const LONGEST_WORD: usize = 24;
/// The number of columns before the line.
const PROMPT: u16 = 2;

/// The content of the box above the line, from the top.
struct Above<'a> {
    lesson: Vec<Line<'static>>,
    choices: Vec<ChoiceRow<'a>>,
    said: Vec<Line<'static>>,
}

/// Draws the box above the footer, with the height of its content, and returns the position of the
/// terminal's cursor. The line is the box's last row, so it stays in place.
pub fn draw(state: &State, palette: &Palette, panel: Panel<'_>, buffer: &mut Buffer) -> Position {
    let above = Above::of(state, palette, panel);
    let place = at_the_bottom(panel.area, (FRAME_ROWS + 1 + above.rows()) as u16);
    let title = format!(
        "{} {}",
        panel.say("palette-title"),
        panel.text(palette.recipients())
    );
    let inner = panel
        .at(place)
        .boxed(title.trim_end(), Role::Accent, buffer);
    let rest = above.draw(panel.at(inner), buffer);
    let fault = palette.fault();
    let (cursor, scroll) = draw_line(palette.input(), fault, panel.at(rest), buffer);
    if let Some(fault) = fault {
        // The carets are on the frame, because a row that comes and goes would move the line.
        let frame = Rect {
            y: place.bottom().saturating_sub(1),
            height: 1,
            ..inner
        };
        let line = palette.input().value();
        draw_carets(line, fault, scroll, panel.at(frame), buffer);
    }
    cursor
}

impl<'a> Above<'a> {
    fn of(state: &State, palette: &'a Palette, panel: Panel<'_>) -> Self {
        let key = |action| state.keymap().key(Action::Line(action), Place::Prompt);
        let grammar = text!(
            "palette-grammar",
            complete = key(LineAction::Complete),
            older = key(LineAction::Older)
        );
        let width = panel.width().saturating_sub(FRAME);
        let room = width.saturating_sub(PROMPT.into());
        let said = explanation(palette, &grammar, room, panel.look);
        let lesson = lesson(state, panel.area.height, width, panel.look);
        let used = FRAME_ROWS + 1 + said.len() + lesson.len();
        let left = usize::from(HEIGHT).saturating_sub(used);
        Self {
            choices: choices(palette, left, width, panel.look),
            lesson,
            said,
        }
    }

    fn rows(&self) -> usize {
        self.lesson.len() + self.choices.len() + self.said.len()
    }

    /// Draws the content and returns the area below it.
    fn draw(&self, panel: Panel<'_>, buffer: &mut Buffer) -> Rect {
        let mut rest = panel.area;
        for line in &self.lesson {
            put(buffer, rest, 0, line);
            rest = below(rest, 1);
        }
        for choice in &self.choices {
            put(buffer, rest, 0, &choice.line);
            if choice.is_chosen {
                panel.at(row_of(rest, 0)).mark_cursor(buffer);
            }
            rest = below(rest, 1);
        }
        for line in &self.said {
            put(buffer, indented(rest), 0, line);
            rest = below(rest, 1);
        }
        rest
    }
}

/// A box above the footer.
fn at_the_bottom(area: Rect, rows: u16) -> Rect {
    let height = rows.min(area.height.saturating_sub(1));
    Rect {
        y: area.bottom().saturating_sub(height + 1),
        height,
        ..area
    }
}

/// The lesson's step, on a screen so low that the box covers its pane.
fn lesson(state: &State, height: u16, width: usize, look: &Look) -> Vec<Line<'static>> {
    let progress = state.session().mission();
    let Some(progress) = progress.filter(|_| state.room() == Room::Fly && height < LOW) else {
        return Vec::new();
    };
    let lines = mission::hint_lines(progress, width, look);
    let shown = clip_rows(lines, LESSON_ROWS, width);
    let shown = shown.into_iter();
    shown
        .map(|line| Line::styled(line, look.style(Role::Accent)))
        .collect()
}

/// The line as it is read, the fault, the verb's usage, and the effect of Enter.
fn explanation(palette: &Palette, grammar: &Text, width: usize, look: &Look) -> Vec<Line<'static>> {
    let fault = palette.fault().map(|fault| {
        let said = match &fault.help {
            Some(help) => format!("{} - {}", look.text(&fault.message), look.text(help)),
            None => look.text(&fault.message),
        };
        // A word that takes many lines would leave no room for its fault.
        let (_, wrong, _) = parts(palette.input().value(), Some(fault));
        match clip(wrong, LONGEST_WORD) {
            whole if whole == wrong => said,
            cut => said.replace(wrong, &cut),
        }
    });
    // The grammar does not help with a faulty line without a verb.
    let hint = match palette.hint() {
        Some(hint) => Some(look.text(hint)),
        None => fault.is_none().then(|| look.text(grammar)),
    };
    let outcome = palette.outcome().map(|text| look.text(text));
    let reading = palette
        .reading()
        .map(|line| look.text(&text!("palette-reads-as", line = line)));
    let parts = [
        (reading.as_deref(), 1, Role::Accent),
        (fault.as_deref(), FAULT_ROWS, Role::Danger),
        (hint.as_deref(), HINT_ROWS, Role::Muted),
        (outcome.as_deref(), 1, Role::Ok),
    ];
    let mut lines = Vec::new();
    for (text, rows, role) in parts {
        let mut wrapped = wrap(text.unwrap_or_default(), width);
        wrapped.retain(|line| !line.is_empty());
        let shown = clip_rows(wrapped, rows, width).into_iter();
        lines.extend(shown.map(|line| Line::styled(line, look.style(role))));
    }
    lines
}

/// Draws a prompt and its text, scrolled so that the cursor is visible; returns the cursor's position and the scroll.
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

/// The line before the faulty word, the word, and the text after it.
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

/// Draws carets under the faulty word, which are visible without colour.
fn draw_carets(
    line: &str,
    fault: &Diagnostic,
    scroll: usize,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let (before, wrong, _) = parts(line, Some(fault));
    let start = Span::raw(before).width().saturating_sub(scroll) as u16;
    let carets = "^".repeat(Span::raw(wrong).width().max(1));
    let line = Line::styled(carets, panel.style(Role::Danger));
    // The part of the frame before the carets stays.
    let inner = panel.at(indented(panel.area));
    let here = inner.columns(start, inner.area.width.saturating_sub(start));
    put(buffer, here.area, 0, &line);
}

struct ChoiceRow<'a> {
    line: Line<'a>,
    is_chosen: bool,
}

/// The completions, in at most this many rows.
fn choices<'a>(palette: &'a Palette, rows: usize, width: usize, look: &Look) -> Vec<ChoiceRow<'a>> {
    let choices = palette.completions();
    // Once the list scrolls, the chosen one is in the last row.
    let first = palette
        .chosen()
        .map_or(0, |chosen| (chosen + 1).saturating_sub(rows));
    let seen = || choices.iter().enumerate().skip(first).take(rows);
    let widest = seen().map(|(_, choice)| choice.text.chars().count()).max();
    let name_width = widest.unwrap_or(0).clamp(12, 24);
    let shown = |most_rows: usize| -> Vec<ChoiceRow<'a>> {
        let rows = seen().flat_map(|(at, choice)| {
            let is_chosen = palette.chosen() == Some(at);
            let size = ChoiceSize {
                name_width,
                width,
                most_rows,
            };
            let lines = choice_lines(choice, is_chosen, size, look).into_iter();
            lines.map(move |line| ChoiceRow { line, is_chosen })
        });
        rows.collect()
    };
    // Each completion is shown in full if there is room for all, otherwise on one line.
    let whole = shown(usize::MAX);
    if whole.len() > rows { shown(1) } else { whole }
}

#[derive(Clone, Copy)]
struct ChoiceSize {
    /// The widths of the name, and of the whole row, in columns.
    name_width: usize,
    width: usize,
    most_rows: usize,
}

/// A completion with its description, wrapped.
fn choice_lines<'a>(
    choice: &'a Completion,
    is_chosen: bool,
    size: ChoiceSize,
    look: &Look,
) -> Vec<Line<'a>> {
    let mut mark = if is_chosen { "> " } else { "  " };
    let name_width = size.name_width;
    let mut name = clip(&choice.text, name_width);
    let hint = look.text(&choice.hint);
    let room = size.width.saturating_sub(name_width + 4);
    let mut lines = Vec::new();
    for text in clip_rows(wrap(&hint, room), size.most_rows, room) {
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
