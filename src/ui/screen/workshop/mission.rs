//! The mission's needs, and whether the design on the bench meets them.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Line;

use super::{mission_title, put_wrapped};
use crate::app::State;
use crate::app::room::workshop::{Stand, bill, mission};
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, columns, put, width};
use crate::vehicle_id::ranges;
use crate::workshop::DesignKind;

/// Draws the mission's budget and needs.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    if panel.area.height < 2 {
        return;
    }
    let pane = panel.titled(&mission_title(state, panel.look), buffer);
    let inner = columns(pane, 1, pane.width.saturating_sub(1));
    let Some(mission) = mission(state) else {
        let text = (panel.say("bench-choose-mission"), panel.style(Role::Muted));
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
    let are_drones = mission.seats.iter().all(|kind| *kind == DesignKind::Drone);
    let seats = if are_drones {
        text!("bench-seats", count = mission.vehicles)
    } else {
        text!("bench-seats-mixed", count = mission.vehicles)
    };
    let texts: Vec<(String, Style)> = vec![
        (panel.text(&seats), panel.style(Role::Text)),
        (panel.text(&budget), panel.style(role)),
    ];
    let mut rest = put_wrapped(&texts, inner, buffer);
    let groups = state
        .rooms()
        .workshop()
        .fit()
        .into_iter()
        .flat_map(|fit| &fit.groups);
    for (seats, stands) in groups {
        let seats = text!("workshop-fit-seats", seats = ranges(seats.iter().copied()));
        let heading = (panel.text(&seats), panel.style(Role::Title));
        rest = put_wrapped(&[heading], rest, buffer);
        for stand in stands {
            rest = draw_stand(stand, panel.at(rest), buffer);
        }
    }
}

/// Draws a need with the design's value: on one line, or with the values below if that is too long.
fn draw_stand(stand: &Stand, panel: Panel<'_>, buffer: &mut Buffer) -> Rect {
    let line = &stand.line;
    let (mark, role) = match (line.met, line.is_block) {
        (true, _) => ('✓', Role::Ok),
        (false, true) => ('×', Role::Danger),
        (false, false) => ('!', Role::Warning),
    };
    let what = format!("{mark} {}", panel.text(&line.what));
    let mut has = panel.text(&line.has);
    if let Some(before) = &stand.before {
        has = format!("{} {} {has}", panel.text(before), panel.look.arrow());
    }
    let figures = format!("{has} / {}", panel.text(&line.required));
    let columns = usize::from(panel.area.width);
    let style = panel.style(role);
    let room = columns.saturating_sub(width(&what));
    if width(&figures) < room {
        let figures = aligned(&figures, room, true);
        put(buffer, panel.area, 0, &Line::styled(what + &figures, style));
        return below(panel.area, 1);
    }
    let rest = put_wrapped(&[(what, style)], panel.area, buffer);
    let figures = aligned(&figures, columns, true);
    put(buffer, rest, 0, &Line::styled(figures, style));
    below(rest, 1)
}
