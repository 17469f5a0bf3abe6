//! The mission's brief, objectives and rules.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::State;
use crate::app::action::Action;
use crate::app::keymap::Place;
use crate::app::room::mission::{self, visible};
use crate::app::room::page::{PageLine, Tone};
use crate::app::state::Room;
use crate::notice::sanitised;
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::screen::site::{self, SITE_ROWS};
use crate::ui::theme::Role;
use crate::ui::widget::{below, clip, columns, put, row_of, upper, urgent};

/// Draws the page from its first visible line; scrolling ends when the last line is at the bottom.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(question) = urgent::workload_question(state) else {
        return draw_pages(state, panel, buffer);
    };
    let words = clip(&panel.text(&question), panel.width());
    let line = Line::styled(words, panel.style(Role::Accent));
    put(buffer, panel.area, 0, &line);
    draw_pages(state, panel.below(1), buffer);
}

fn draw_pages(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let pages = mission::columns(state, &panel.look.locale, panel.area.width);
    if pages.is_empty() {
        let line = Line::styled(
            format!(" {}", panel.say("mission-none")),
            panel.style(Role::Muted),
        );
        put(buffer, below(panel.area, 1), 0, &line);
        return;
    }
    let longest = pages.iter().map(Vec::len).max().unwrap_or(0);
    let rows = visible(longest, panel.area.height);
    let last = longest.saturating_sub(rows);
    let first = state.rooms().mission().scroll().min(last);
    let width = panel.area.width / pages.len() as u16;
    for (at, page) in pages.iter().enumerate() {
        let left = at as u16 * width + 1;
        let here = columns(
            upper(panel.area, rows as u16),
            left,
            width.saturating_sub(2),
        );
        panel.at(here).mark_scroll(first, page.len(), buffer);
        for (row, line) in page.iter().skip(first).take(rows).enumerate() {
            draw_line(line, panel.at(row_of(here, row as u16)), buffer);
        }
    }
    let above = longest as u16 + 1;
    if let Some(mission) = mission::unflown(state)
        && panel.area.height >= above + 1 + SITE_ROWS
    {
        let place = panel.below(above);
        site::draw(
            state,
            mission,
            place.columns(1, place.area.width.saturating_sub(2)),
            buffer,
        );
    }
    if longest > rows {
        let shown = text!(
            "mission-lines",
            first = first + 1,
            last = (first + rows).min(longest),
            count = longest,
            key = state
                .keymap()
                .keys(Action::UP_AND_DOWN, Place::In(Room::Mission))
        );
        let line = Line::styled(format!(" {}", panel.text(&shown)), panel.style(Role::Muted));
        put(buffer, panel.area, rows as u16, &line);
    }
}

/// Draws a line of a page.
pub fn draw_line(line: &PageLine, panel: Panel<'_>, buffer: &mut Buffer) {
    let text = sanitised(&line.text);
    if line.tone == Tone::Title {
        panel.titled(&text, buffer);
        return;
    }
    let style = panel.style(tone_role(line.tone));
    put(buffer, panel.area, 0, &Line::styled(text, style));
}

/// The theme role that draws a tone.
pub fn tone_role(tone: Tone) -> Role {
    match tone {
        Tone::Title => Role::Title,
        Tone::Plain => Role::Text,
        Tone::Muted => Role::Muted,
        Tone::Met => Role::Ok,
        Tone::Missed => Role::Danger,
        Tone::Warning => Role::Warning,
        Tone::Hint | Tone::AskedHint => Role::Accent,
    }
}
