//! The review of a recorded flight.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::mission::draw_line;
use crate::app::State;
use crate::app::action::{Action, ReplayAction};
use crate::app::keymap::Place;
use crate::app::room;
use crate::app::room::mission::visible;
use crate::app::room::review::{self, ReviewPage};
use crate::app::state::{ReplayView, Room};
use crate::moment::Moment;
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::draw as draw_map;
use crate::ui::widget::replay::{moment_line, moment_text};
use crate::ui::widget::{clock, footer, put, row_of, wrap};

mod curves;

/// The moments' share of the width beside the map: one column in this many, at most `WIDEST_LIST`.
const LIST_SHARE: u16 = 2;
const WIDEST_LIST: u16 = 80;
/// The number of rows below the moments for the details of the moment under the cursor.
const DETAIL_ROWS: u16 = 6;
/// The number of rows of the tabs and of the keys below.
const HEAD_ROWS: u16 = 2;

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(view) = state.replay() else {
        let review = Action::Replay(ReplayAction::ReviewNewest);
        let key = state.keymap().key(review, Place::In(Room::Debrief));
        let none = panel.text(&text!("review-none", key = key));
        let here = panel
            .below(1)
            .columns(1, panel.area.width.saturating_sub(2));
        for (row, line) in wrap(&none, here.width()).into_iter().enumerate() {
            let line = Line::styled(line, panel.style(Role::Muted));
            put(buffer, here.area, row as u16, &line);
        }
        return;
    };
    let shown = state.rooms().review().page();
    put(buffer, panel.area, 0, &pages(view, shown, panel));
    // The timeline takes the place of the keys on the last line.
    let keys = panel.at(row_of(panel.area, 1));
    put(
        buffer,
        keys.area,
        0,
        &footer::hints(state, room::hints(state), keys),
    );
    let body = panel.below(HEAD_ROWS);
    if shown == ReviewPage::Happened {
        draw_moments(state, view, body, buffer);
    } else {
        draw_page(state, body, buffer);
    }
}

/// The tabs of the pages, with the current one and the answered ones marked.
fn pages<'a>(view: &ReplayView, shown: ReviewPage, panel: Panel<'_>) -> Line<'a> {
    let review = &view.review;
    let mut spans = vec![Span::raw(" ")];
    for page in ReviewPage::ALL {
        let is_done = match page {
            ReviewPage::Why => !review.why.is_empty(),
            ReviewPage::Next => !review.next.is_empty(),
            ReviewPage::Planned
            | ReviewPage::Happened
            | ReviewPage::Explained
            | ReviewPage::Compared => false,
        };
        let role = if page == shown {
            Role::Selected
        } else if page == ReviewPage::Explained && !review.is_answered() {
            Role::Locked
        } else {
            Role::Text
        };
        let mark = if is_done { " ✓" } else { "" };
        let title = format!(" {}{mark} ", panel.say(page.title()));
        spans.push(Span::styled(title, panel.style(role)));
        spans.push(Span::raw(" "));
    }
    Line::from(spans)
}

/// Draws the moments, and the map at the moment under the cursor; below them the workload.
fn draw_moments(state: &State, view: &ReplayView, all: Panel<'_>, buffer: &mut Buffer) {
    let strips = state.workload_strips(&all.look.locale, all.width());
    let workload = strips.map_or_else(Vec::new, |strips| strips.lines());
    let rows = all.area.height.saturating_sub(workload.len() as u16);
    for (row, line) in (rows..).zip(&workload) {
        let line = Line::styled(line.as_str(), all.style(Role::Muted));
        put(buffer, all.area, row, &line);
    }
    let panel = all.upper(rows);
    let width = (panel.area.width / LIST_SHARE).min(WIDEST_LIST);
    let list = panel.columns(0, width.saturating_sub(1));
    let map = panel.columns(width, panel.area.width - width);
    draw_map(state, map, buffer);
    let moments = review::moments(state);
    let inner = list.at(list.focused(&list.say("review-moments"), true, buffer));
    if moments.is_empty() {
        let line = Line::styled(inner.say("review-no-moments"), inner.style(Role::Muted));
        put(buffer, inner.area, 0, &line);
        return;
    }
    let cursor = state.rooms().review().cursor().min(moments.len() - 1);
    let (inner, detail) = (
        inner.upper(inner.area.height.saturating_sub(DETAIL_ROWS)),
        inner.below(inner.area.height.saturating_sub(DETAIL_ROWS)),
    );
    draw_detail(state, moments[cursor], detail, buffer);
    let rows = usize::from(inner.area.height).max(1);
    let first = (cursor + 1).saturating_sub(rows);
    inner.mark_list(first, moments.len(), true, buffer);
    for (row, moment) in moments.iter().skip(first).take(rows).enumerate() {
        let here = inner.at(row_of(inner.area, row as u16));
        let time = clock(view.clock.flight_time(moment.at));
        let mark = if first + row == cursor { "> " } else { "  " };
        let columns = here.width().saturating_sub(mark.len());
        let mut line = moment_line(&time, moment, columns, here.look);
        line.spans.insert(0, mark.into());
        put(buffer, here.area, 0, &line);
        if first + row == cursor {
            here.mark_cursor(buffer);
        }
    }
}

/// Draws a moment in full, the points attached to it, and the keys that add a point.
fn draw_detail(state: &State, moment: &Moment, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.at(panel.titled(&panel.say("review-moment"), buffer));
    let how = text!(
        "review-add-how",
        sustain = review::key_of(state, "review sustain"),
        improve = review::key_of(state, "review improve")
    );
    let points = state.replay().map(|it| it.review.points());
    let at_moment = points
        .unwrap_or_default()
        .iter()
        .filter(|point| point.is_at(moment.at));
    let tied = at_moment.map(|point| {
        let line = format!("{} {}", point.kind.sign(), point.text);
        Line::styled(line, inner.style(Role::Accent))
    });
    let words = wrap(&moment_text(moment, inner.look), inner.width());
    let told = words.into_iter().map(Line::from);
    let how = Line::styled(inner.text(&how), inner.style(Role::Muted));
    let lines: Vec<Line<'_>> = told.chain(tied).chain([how]).collect();
    for (row, line) in lines.iter().enumerate() {
        put(buffer, inner.area, row as u16, line);
    }
}

fn draw_page(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let curves = review::curve_rows(state, panel.area.height);
    let rows = panel.area.height - curves;
    if let Some(ghost) = state.ghost()
        && let Some(own) = ghost.own.as_deref().filter(|_| curves > 0)
    {
        curves::draw(ghost, own, panel.below(rows), buffer);
    }
    let panel = panel.upper(rows);
    let lines = review::lines(state, &panel.look.locale, panel.area.width);
    let rows = visible(lines.len(), panel.area.height);
    let last = lines.len().saturating_sub(rows);
    let first = state.rooms().review().scroll().min(last);
    let column = panel.columns(1, panel.area.width.saturating_sub(2));
    column.mark_scroll(first, lines.len(), buffer);
    for (row, line) in lines.iter().skip(first).take(rows).enumerate() {
        draw_line(line, column.at(row_of(column.area, row as u16)), buffer);
    }
}
