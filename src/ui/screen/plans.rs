//! The drafts of plans: the items of a list, a map with a cursor, the heights, and the faults.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::{Action, PlansAction};
use crate::app::room::plans::{Drawing, findings, layout, pace};
use crate::draft::{Draft, Pace, Profile, profile};
use crate::plan::check::Finding;
use crate::plan::{Document, ListKind};
use crate::preflight::list_words;
use crate::text;
use crate::ui::look::Badge;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::draw_drafts;
use crate::ui::widget::{below, columns, put, row_of, upper, wrap};

mod detail;
mod heights;
mod list;

/// What the parts of the screen show.
struct Shown<'a> {
    room: &'a Drawing,
    document: &'a Document,
    course: Profile,
    pace: Pace,
    findings: Vec<Finding>,
}

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().plans();
    let sizes = layout(state.display().grid());
    draw_tabs(state, panel.upper(1), buffer);
    let body = below(panel.area, 1);
    let middle = upper(body, sizes.rows);
    let map = columns(middle, sizes.list + 1, middle.width);
    draw_drafts(state, panel.at(map), buffer);
    draw_border(panel.at(columns(middle, sizes.list, 1)), buffer);
    let list = panel.at(columns(middle, 0, sizes.list));
    let Some(draft) = room.drafts().current() else {
        return draw_nothing(state, list, buffer);
    };
    let pace = pace(state);
    let shown = Shown {
        room,
        document: draft.document(),
        course: profile(draft.document(), pace),
        pace,
        findings: findings(state, draft.document()),
    };
    list::draw(&shown, list, buffer);
    let rest = below(body, sizes.rows);
    let detail_rows = rest.height.saturating_sub(sizes.heights);
    detail::draw(state, &shown, panel.at(upper(rest, detail_rows)), buffer);
    heights::draw(state, &shown, panel.at(below(rest, detail_rows)), buffer);
}

/// A line between the list and the map.
fn draw_border(panel: Panel<'_>, buffer: &mut Buffer) {
    for row in 0..panel.area.height {
        let line = Line::styled("│", panel.style(Role::Border));
        put(buffer, panel.area, row, &line);
    }
}

/// The drafts with their signs, and the lists of the current one.
fn draw_tabs(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().plans();
    let lists = lists(room, panel);
    let room_left = panel.width().saturating_sub(lists.width() + 1);
    let mut spans = vec![Span::raw(" ")];
    for (index, draft) in room.drafts().all().iter().enumerate() {
        let badge = Badge::of_draft(index);
        let is_current = index == room.drafts().current_index();
        let role = if is_current { Role::Title } else { Role::Muted };
        spans.push(Span::styled(
            format!("{} ", badge.sign),
            panel.style(badge.role),
        ));
        spans.push(Span::styled(name(draft), panel.style(role)));
        spans.push(Span::raw("  "));
    }
    let left = columns(panel.area, 0, room_left as u16);
    put(buffer, left, 0, &Line::from(spans));
    let right = columns(panel.area, room_left as u16, panel.area.width);
    put(buffer, right, 0, &lists);
}

/// A draft's name; a star marks one whose content is nowhere else.
fn name(draft: &Draft) -> String {
    let star = if draft.is_kept() { "" } else { "*" };
    format!("{}{star}", draft.name())
}

fn lists(room: &Drawing, panel: Panel<'_>) -> Line<'static> {
    let Some(draft) = room.drafts().current() else {
        return Line::default();
    };
    let mut spans = Vec::new();
    for kind in ListKind::ALL {
        let is_shown = kind == room.list();
        let (open, close) = if is_shown { ("[", "]") } else { (" ", " ") };
        let role = if is_shown { Role::Title } else { Role::Muted };
        let words = panel.text(&list_words(kind));
        let count = draft.document().list(kind).len();
        spans.push(Span::styled(
            format!("{open}{words} {count}{close}"),
            panel.style(role),
        ));
    }
    Line::from(spans)
}

/// Shows how to begin a draft while none is open.
fn draw_nothing(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let key = |action| state.key(Action::Plans(action));
    let text = text!(
        "plans-nothing",
        new = key(PlansAction::NewDraft),
        open = key(PlansAction::OpenDraft),
        take = key(PlansAction::TakePlan)
    );
    let lines = wrap(&panel.text(&text), panel.width().saturating_sub(2));
    for (row, line) in (1..).zip(lines) {
        let line = Line::styled(format!(" {line}"), panel.style(Role::Muted));
        put(buffer, row_of(panel.area, row), 0, &line);
    }
}
