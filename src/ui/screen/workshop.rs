//! The workshop: the bench with its lists, figures and charts; all designs; a comparison; a fleet's seats.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Line;

use crate::app::State;
use crate::app::room::workshop::{Page, Pane, View, WIDE};
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, columns, put, row_of, upper, wrap};
use crate::workshop::Measure;

mod chart;
mod compare;
mod figures;
mod findings;
mod fleet;
mod mission;
mod parts;
mod shelf;
mod slots;

/// The minimum height for both lists, one below the other, in rows.
const TALL: u16 = 34;
/// The width from which the lists get their full share, in columns.
const ROOMY: u16 = 110;
/// The share of the lists of a screen, in percent: names of parts are longer than figures.
const LISTS_PERCENT: u16 = 56;
/// That share on narrow screens, where the names of figures and their changes need room too.
const NARROW_LISTS_PERCENT: u16 = 50;
/// The width of the figures on narrow screens beside the list of slots: without changes, they need less.
const NARROW_FIGURES: u16 = 32;
/// The minimum height of a chart below the problems, in rows.
const CHART_ROWS: u16 = 9;
/// The share of a wide screen for the list of slots, in percent, and the width of the figures, in
/// columns.
const SLOTS_PERCENT: u16 = 34;
const WIDE_FIGURES: u16 = 56;
/// The number of rows of the figures with their title.
const FIGURES_ROWS: u16 = Measure::MOST as u16 + 1;
/// The number of rows of the design's problems if something follows below them.
const FINDINGS_ROWS: u16 = 10;

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    match state.rooms().workshop().page() {
        Page::Bench if panel.area.width >= WIDE => draw_wide(state, panel, buffer),
        Page::Bench => draw_narrow(state, panel, buffer),
        Page::Designs => shelf::draw(state, panel, buffer),
        Page::Compare => compare::draw(state, panel, buffer),
        Page::Fleet => fleet::draw(state, panel, buffer),
    }
}

/// Draws everything at once, in three columns.
fn draw_wide(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let slots_width = panel.area.width * SLOTS_PERCENT / 100;
    let middle = panel.area.width - slots_width - WIDE_FIGURES - 2;
    let left = columns(panel.area, 0, slots_width);
    let wanted = state.rooms().workshop().bench().rows().len() as u16 + 2;
    let slots = wanted.min(panel.area.height.saturating_sub(FINDINGS_ROWS));
    slots::draw(state, panel.at(upper(left, slots)), buffer);
    findings::draw(state, panel.at(below(left, slots)), buffer);
    parts::draw(state, panel.columns(slots_width + 1, middle), buffer);
    let right = columns(panel.area, slots_width + middle + 2, WIDE_FIGURES);
    figures::draw(state, panel.at(upper(right, FIGURES_ROWS + 1)), buffer);
    let rest = below(right, FIGURES_ROWS + 1);
    let half = rest.height / 2;
    chart::draw(state, panel.at(upper(rest, half)), buffer);
    mission::draw(state, panel.at(below(rest, half)), buffer);
}

/// Draws the lists on the left, and the chosen view on the right.
fn draw_narrow(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().workshop();
    let width = match room.pane() {
        _ if panel.area.width >= ROOMY => panel.area.width * LISTS_PERCENT / 100,
        Pane::Slots => panel.area.width.saturating_sub(NARROW_FIGURES + 1),
        Pane::Parts => panel.area.width * NARROW_LISTS_PERCENT / 100,
    };
    let left = columns(panel.area, 0, width);
    let right = columns(panel.area, width + 1, panel.area.width - width - 1);
    if panel.area.height >= TALL {
        let wanted = room.bench().rows().len() as u16 + 2;
        let slots = wanted.min(panel.area.height / 2);
        slots::draw(state, panel.at(upper(left, slots)), buffer);
        parts::draw(state, panel.at(below(left, slots)), buffer);
    } else if room.pane() == Pane::Slots {
        slots::draw(state, panel.at(left), buffer);
    } else {
        parts::draw(state, panel.at(left), buffer);
    }
    let is_tall = panel.area.height >= TALL;
    let (figures, rest) = if is_tall || room.view() == View::Figures {
        (upper(right, FIGURES_ROWS), below(right, FIGURES_ROWS))
    } else {
        (upper(right, 0), right)
    };
    figures::draw(state, panel.at(figures), buffer);
    match room.view() {
        View::Figures if rest.height >= FINDINGS_ROWS + CHART_ROWS => {
            findings::draw(state, panel.at(upper(rest, FINDINGS_ROWS)), buffer);
            chart::draw(state, panel.at(below(rest, FINDINGS_ROWS)), buffer);
        }
        View::Figures => findings::draw(state, panel.at(rest), buffer),
        View::Polar | View::Payload => chart::draw(state, panel.at(rest), buffer),
        View::Mission => mission::draw(state, panel.at(rest), buffer),
    }
}

/// The index of the first visible line of a list; the line of the cursor is always visible.
fn first_shown(cursor: usize, count: usize, rows: u16) -> usize {
    let rows = usize::from(rows);
    cursor
        .saturating_sub(rows / 2)
        .min(count.saturating_sub(rows))
}

/// Marks and highlights the cursor's line; without the focus, it has only another colour, as in other lists.
fn show_cursor(look: &Look, has_keys: bool, place: Rect, buffer: &mut Buffer) {
    if has_keys {
        if let Some(cell) = buffer.cell_mut((place.x, place.y)) {
            cell.set_char('>');
        }
        Panel::new(look, row_of(place, 0)).mark_cursor(buffer);
    } else {
        buffer.set_style(row_of(place, 0), look.style(Role::Selected));
    }
}

/// Writes texts one below the other, wrapped; returns the area below them.
fn put_wrapped(texts: &[(String, Style)], area: Rect, buffer: &mut Buffer) -> Rect {
    let mut row = 0;
    for (text, style) in texts {
        for line in wrap(text, usize::from(area.width)) {
            put(buffer, area, row, &Line::styled(line, *style));
            row += 1;
        }
    }
    below(area, row)
}

/// A change with a sign for better or worse, readable without colour; `None` if it rounds to zero.
fn change(measure: Measure, before: f64, after: f64) -> Option<(String, Role)> {
    let difference = measure.difference(before, after)?;
    let (sign, role) = match measure.is_gain(before, after) {
        Some(true) => ('▲', Role::Ok),
        Some(false) => ('▼', Role::Warning),
        None => (' ', Role::Text),
    };
    Some((format!("{sign} {difference}"), role))
}

/// The title of the mission that the fleet is built for.
fn mission_title(state: &State, look: &Look) -> String {
    let mission = crate::app::room::workshop::mission(state);
    let title = mission.map_or_else(|| text!("bench-no-mission"), |it| it.title.clone());
    look.text(&title)
}
