//! The drafts of plans: the items of a list, a map with a cursor, the heights, and the faults.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use crate::app::State;
use crate::app::action::{Action, DrawAction, PlansAction};
use crate::app::room::plans::{Drawing, findings, layout, pace, room_hints};
use crate::draft::{Profile, profile};
use crate::plan::Document;
use crate::plan::check::Finding;
use crate::plan::effort::Pace;
use crate::text;
use crate::ui::look::Badge;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::draw_drafts;
use crate::ui::widget::{below, columns, footer, put, row_of, upper, wrap};

mod detail;
mod figures;
mod heights;
mod list;
mod reports;
mod tabs;

/// The data that the parts of the screen show.
struct Shown<'a> {
    room: &'a Drawing,
    /// The colour of the draft.
    role: Role,
    document: &'a Document,
    course: Profile,
    pace: Pace,
    findings: Vec<Finding>,
}

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().plans();
    let sizes = layout(state.display().grid());
    tabs::draw(state, panel.upper(1), buffer);
    let (above, keys) = split_last(panel.area);
    let line = footer::hints(state, room_hints(state).iter().copied(), panel.at(keys));
    put(buffer, keys, 0, &line);
    let body = below(above, 1);
    let middle = upper(body, sizes.canvas.rows);
    let map = columns(middle, sizes.list + 1, middle.width);
    draw_drafts(state, panel.at(map), buffer);
    draw_border(panel.at(columns(middle, sizes.list, 1)), buffer);
    let left = panel.at(columns(middle, 0, sizes.list));
    let details = panel.at(below(body, sizes.canvas.rows));
    let Some(draft) = room.drafts().current() else {
        draw_nothing(state, left, buffer);
        return detail::draw(state, None, details, buffer);
    };
    let pace = pace(state);
    let shown = Shown {
        room,
        role: Badge::of_draft(draft).role,
        document: draft.document(),
        course: profile(draft.document(), pace, room.ground()),
        pace,
        findings: findings(state, draft.document()),
    };
    if room.figures().is_some() {
        figures::draw(room, left, buffer);
    } else {
        list::draw(&shown, left.upper(sizes.rows), buffer);
        heights::draw(&shown, draft, left.below(sizes.rows), buffer);
    }
    detail::draw(state, Some(&shown), details, buffer);
}

/// An area without its last row, and that row.
fn split_last(area: Rect) -> (Rect, Rect) {
    let rest = area.height.saturating_sub(1);
    (upper(area, rest), row_of(area, rest))
}

/// Draws a line between the list and the map.
fn draw_border(panel: Panel<'_>, buffer: &mut Buffer) {
    for row in 0..panel.area.height {
        let line = Line::styled("│", panel.style(Role::Border));
        put(buffer, panel.area, row, &line);
    }
}

/// Shows how to begin a draft while none is open.
fn draw_nothing(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let key = |action| state.key(Action::Plans(action));
    let text = text!(
        "plans-nothing",
        new = key(PlansAction::NewDraft),
        open = key(PlansAction::OpenDraft),
        take = key(PlansAction::TakePlan),
        fence = key(PlansAction::FenceList),
        begin = state.key(Action::Draw(DrawAction::BeginPolygon)),
        add = state.key(Action::Draw(DrawAction::AddItem)),
        survey = key(PlansAction::SurveyDraft)
    );
    let lines = wrap(&panel.text(&text), panel.width().saturating_sub(2));
    for (row, line) in (1..).zip(lines) {
        let line = Line::styled(format!(" {line}"), panel.style(Role::Muted));
        put(buffer, row_of(panel.area, row), 0, &line);
    }
}
