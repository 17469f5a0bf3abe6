//! Other aircraft as lines: where they are, and how close they come.

use std::time::Duration;

use ratatui::text::Line;

use crate::app::state::TrackedAircraft;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::wrap;
use crate::vehicle::TrafficThreat;

/// The indent of the approaches to vehicles.
const INDENT: &str = "    ";

/// An aircraft with its approaches to the vehicles in the air.
pub fn lines<'a>(
    tracked: &TrackedAircraft,
    now: Duration,
    width: usize,
    look: &Look,
) -> Vec<Line<'a>> {
    let head = wrap(&look.text(&tracked.text(now)), width);
    let head_style = look.style(threat_role(tracked.threat()));
    let mut lines: Vec<Line<'a>> = head
        .into_iter()
        .map(|line| Line::styled(line, head_style))
        .collect();
    for one in &tracked.approaches {
        let style = look.style(threat_role(one.approach.threat));
        let said = wrap(&look.text(&one.text()), width.saturating_sub(INDENT.len()));
        let said = said.into_iter().map(|line| format!("{INDENT}{line}"));
        lines.extend(said.map(|line| Line::styled(line, style)));
    }
    lines
}

/// The theme role for a threat.
pub fn threat_role(threat: TrafficThreat) -> Role {
    match threat {
        TrafficThreat::Critical => Role::Danger,
        TrafficThreat::Warning => Role::Warning,
        TrafficThreat::None => Role::Info,
    }
}
