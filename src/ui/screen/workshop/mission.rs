//! What the mission needs, and what the design on the bench has of it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Line;

use super::{mission_title, put_wrapped};
use crate::app::State;
use crate::app::room::workshop::{Stand, bill, mission};
use crate::language::ranges;
use crate::text;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, columns, put, titled, width};

/// Draws the mission's budget and needs.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    if area.height < 2 {
        return;
    }
    let inner = titled(&mission_title(state, look), look, area, buffer);
    let inner = columns(inner, 1, inner.width.saturating_sub(1));
    let Some(mission) = mission(state) else {
        let text = (look.say("bench-choose-mission"), look.style(Role::Muted));
        put_wrapped(&[text], inner, buffer);
        return;
    };
    let cost = bill(state, mission);
    let (budget, role) = match mission.outlay.budget {
        Some(budget) if cost > budget => (
            text!("bench-budget", cost = cost, budget = budget),
            Role::Danger,
        ),
        Some(budget) => (
            text!("bench-budget", cost = cost, budget = budget),
            Role::Text,
        ),
        None => (text!("bench-no-budget", cost = cost), Role::Text),
    };
    let seats = text!("bench-seats", count = mission.vehicles);
    let texts: Vec<(String, Style)> = vec![
        (look.text(&seats), look.style(Role::Text)),
        (look.text(&budget), look.style(role)),
    ];
    let mut rest = put_wrapped(&texts, inner, buffer);
    let groups = state.rooms.workshop.fit.iter().flat_map(|fit| &fit.groups);
    for (seats, stands) in groups {
        let seats = text!("workshop-fit-seats", seats = ranges(seats.iter().copied()));
        let heading = (look.text(&seats), look.style(Role::Title));
        rest = put_wrapped(&[heading], rest, buffer);
        for stand in stands {
            rest = draw_stand(stand, look, rest, buffer);
        }
    }
}

/// What is needed with what there is: on one line, or the figures below where that is too long.
fn draw_stand(stand: &Stand, look: &Look, area: Rect, buffer: &mut Buffer) -> Rect {
    let line = &stand.line;
    let (mark, role) = match (line.met, line.is_block) {
        (true, _) => ('✓', Role::Ok),
        (false, true) => ('x', Role::Danger),
        (false, false) => ('!', Role::Warning),
    };
    let what = format!("{mark} {}", look.text(&line.what));
    let has = look.text(&line.has);
    let has = match &stand.before {
        Some(before) => format!("{} → {has}", look.text(before)),
        None => has,
    };
    let figures = format!("{has} / {}", look.text(&line.required));
    let columns = usize::from(area.width);
    let style = look.style(role);
    let room = columns.saturating_sub(width(&what));
    if width(&figures) < room {
        let figures = aligned(&figures, room, true);
        put(buffer, area, 0, &Line::styled(what + &figures, style));
        return below(area, 1);
    }
    let rest = put_wrapped(&[(what, style)], area, buffer);
    let figures = aligned(&figures, columns, true);
    put(buffer, rest, 0, &Line::styled(figures, style));
    below(rest, 1)
}
