//! What the mission needs, and what the design on the bench has of it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::{mission_title, put_wrapped};
use crate::app::room::workshop::{bill, mission};
use crate::app::state::State;
use crate::text;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{columns, titled};

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
    put_wrapped(&texts, inner, buffer);
}
