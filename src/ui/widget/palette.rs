//! The command line: the line itself, the wrong word marked, what could follow.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget};
use tui_input::Input;

use crate::app::state::Palette;
use crate::diagnostic::Diagnostic;
use crate::language::Completion;
use crate::ui::theme::{Role, Theme};
use crate::ui::widget::{below, boxed, clip, put, row_of, wrap};

/// Rows of the box: frame, line, mark, message, choices.
const HEIGHT: u16 = 13;
/// Rows of the hint, or of the mark under a wrong word and what is wrong with it.
const HINT_ROWS: usize = 2;
/// What is told while there is no verb yet.
const GRAMMAR: &str = "[targets] verb [arguments]: Tab completes, Up brings back older lines";
/// Columns before the line.
const PROMPT: u16 = 2;

/// Draws the box above the footer and returns where the terminal's cursor belongs.
pub fn draw(palette: &Palette, theme: &Theme, area: Rect, buffer: &mut Buffer) -> Position {
    let place = Rect {
        y: area.bottom().saturating_sub(HEIGHT + 1),
        height: HEIGHT,
        ..area
    };
    let title = format!("command {}", palette.recipients);
    let inner = boxed(title.trim_end(), Role::Accent, theme, place, buffer);
    let fault = palette.fault.as_ref();
    let (cursor, scroll) = draw_line(&palette.input, fault, theme, inner, buffer);
    if let Some(fault) = fault {
        draw_fault(palette.input.value(), fault, scroll, (theme, inner), buffer);
    } else {
        let hint = palette.hint.as_deref().unwrap_or(GRAMMAR);
        let place = below(indented(inner), 1);
        let lines = wrap(hint, usize::from(place.width));
        for (row, line) in lines.into_iter().take(HINT_ROWS).enumerate() {
            put(
                buffer,
                place,
                row as u16,
                &Line::styled(line, theme.style(Role::Muted)),
            );
        }
    }
    draw_choices(palette, theme, below(inner, 3), buffer);
    cursor
}

/// Draws a prompt and its text, scrolled so that the cursor is seen; returns the cursor's place and the scroll.
pub fn draw_line(
    input: &Input,
    fault: Option<&Diagnostic>,
    theme: &Theme,
    area: Rect,
    buffer: &mut Buffer,
) -> (Position, usize) {
    let text = Rect {
        height: 1.min(area.height),
        ..indented(area)
    };
    let scroll = input.visual_scroll(usize::from(text.width).saturating_sub(1).max(1));
    put(buffer, area, 0, &Line::styled(": ", theme.style(Role::Key)));
    let (before, wrong, after) = parts(input.value(), fault);
    let line = Line::from(vec![
        Span::raw(before),
        Span::styled(wrong, theme.style(Role::Error)),
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

/// Carets under the wrong word, so that it is marked without colour too, and what is wrong.
fn draw_fault(
    line: &str,
    fault: &Diagnostic,
    scroll: usize,
    (theme, area): (&Theme, Rect),
    buffer: &mut Buffer,
) {
    let (before, wrong, _) = parts(line, Some(fault));
    let start = Span::raw(before).width().saturating_sub(scroll);
    let carets = "^".repeat(Span::raw(wrong).width().max(1));
    let style = theme.style(Role::Danger);
    let text = Rect {
        height: area.height,
        ..indented(area)
    };
    put(
        buffer,
        text,
        1,
        &Line::styled(format!("{}{carets}", " ".repeat(start)), style),
    );
    let help = fault
        .help
        .as_ref()
        .map_or(String::new(), |help| format!(" - {help}"));
    let message = clip(&format!("{}{help}", fault.message), usize::from(text.width));
    put(buffer, text, 2, &Line::styled(message, style));
}

fn draw_choices(palette: &Palette, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let choices = &palette.completions;
    let rows = usize::from(area.height);
    // The chosen one is the last row once the list has to scroll.
    let first = palette
        .chosen
        .map_or(0, |chosen| (chosen + 1).saturating_sub(rows));
    let widest = choices
        .iter()
        .map(|choice| choice.text.chars().count())
        .max();
    let name_width = widest.unwrap_or(0).clamp(12, 24);
    for (row, choice) in choices.iter().skip(first).take(rows).enumerate() {
        let is_chosen = palette.chosen == Some(first + row);
        let line = choice_line(choice, is_chosen, name_width, theme);
        put(buffer, area, row as u16, &line);
        if is_chosen {
            buffer.set_style(row_of(area, row as u16), theme.style(Role::Cursor));
        }
    }
}

fn choice_line<'a>(
    choice: &'a Completion,
    is_chosen: bool,
    name_width: usize,
    theme: &Theme,
) -> Line<'a> {
    let mark = if is_chosen { "> " } else { "  " };
    let name = clip(&choice.text, name_width);
    // A verb without arguments has its name for a usage: once is enough.
    let said = format!("{}: ", choice.text);
    let hint = choice.hint.strip_prefix(&said).unwrap_or(&choice.hint);
    Line::from(vec![
        Span::raw(mark),
        Span::styled(format!("{name:name_width$}  "), theme.style(Role::Key)),
        Span::styled(hint, theme.style(Role::Muted)),
    ])
}

fn indented(area: Rect) -> Rect {
    let by = PROMPT.min(area.width);
    Rect {
        x: area.x + by,
        width: area.width - by,
        ..area
    }
}
