//! Below the list: the parameter under the cursor on each target vehicle.

use std::collections::BTreeMap;

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::{Row, edited};
use crate::app::State;
use crate::parameters::shown;
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{put, wrap};
use crate::vehicle::VehicleId;
use crate::vehicle_id::ranges;

/// The maximum number of lines; vehicles with the same value and outcome share one.
const MOST_LINES: usize = 12;

/// The lines: vehicles, their value, the outcome of the newest value commanded, and the reason.
pub fn lines(
    state: &State,
    vehicle: VehicleId,
    row: &Row<'_>,
    panel: Panel<'_>,
) -> Vec<Line<'static>> {
    let mut vehicles = state.addressed();
    if !vehicles.contains(&vehicle) {
        vehicles.insert(0, vehicle);
    }
    let mut groups: Vec<(ParameterState, Vec<VehicleId>)> = Vec::new();
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    for id in vehicles {
        let standing = ParameterState::of(state, id, row.name);
        let key = standing.key();
        let at = *places.entry(key).or_insert(groups.len());
        match groups.get_mut(at) {
            Some((_, ids)) => ids.push(id),
            None => groups.push((standing, vec![id])),
        }
    }
    let lines = groups
        .into_iter()
        .flat_map(|(standing, ids)| standing.lines(&ids, panel));
    lines.take(MOST_LINES).collect()
}

/// Draws the lines below a rule with the parameter's name.
pub fn draw(name: &str, lines: &[Line<'static>], panel: Panel<'_>, buffer: &mut Buffer) {
    if panel.area.height == 0 {
        return;
    }
    let inner = panel.titled(name, buffer);
    for (row, line) in lines.iter().enumerate() {
        put(buffer, inner, row as u16, line);
    }
}

struct ParameterState {
    value: Option<String>,
    before: Option<String>,
    /// The default, if the value differs from it.
    default: Option<String>,
    asked: Option<(Text, Role, Option<Text>)>,
}

impl ParameterState {
    fn of(state: &State, vehicle: VehicleId, name: &str) -> Self {
        let room = state.rooms().parameters();
        let known = room.get(vehicle, name);
        let changed = known.filter(|known| known.is_changed());
        let asked = room.edit(vehicle, name).and_then(|edit| {
            let (word, role, reason) =
                edited(state, edit, vehicle, known.map(|known| known.value))?;
            let value = shown(edit.value);
            let text = text!("parameters-asked", value = value, state = word);
            Some((text, role, reason))
        });
        Self {
            value: known.map(|known| shown(known.value)),
            before: changed.map(|known| shown(known.original)),
            default: room.other_default(vehicle, name).map(shown),
            asked,
        }
    }

    fn key(&self) -> String {
        format!(
            "{:?} {:?} {:?} {:?}",
            self.value, self.before, self.default, self.asked
        )
    }

    fn lines(self, ids: &[VehicleId], panel: Panel<'_>) -> Vec<Line<'static>> {
        let value = self.value.unwrap_or_else(|| "-".to_owned());
        let whose = text!(
            "parameters-on",
            count = ids.len(),
            vehicles = ranges(ids.iter().copied())
        );
        let mut spans = vec![
            Span::styled(
                format!(" {}: ", panel.text(&whose)),
                panel.style(Role::Selected),
            ),
            Span::styled(value, panel.style(Role::Text)),
        ];
        if let Some(before) = self.before {
            let text = panel.text(&text!("parameters-before", value = before));
            spans.push(Span::styled(format!("  {text}"), panel.style(Role::Muted)));
        }
        if let Some(default) = self.default {
            let text = panel.text(&text!("parameters-default", value = default));
            spans.push(Span::styled(format!("  {text}"), panel.style(Role::Muted)));
        }
        let mut reason = None;
        if let Some((text, role, why)) = self.asked {
            let text = format!("   {}", panel.text(&text));
            spans.push(Span::styled(text, panel.style(role)));
            reason = why;
        }
        let mut lines = vec![Line::from(spans)];
        if let Some(reason) = reason {
            let wrapped = wrap(&panel.text(&reason), panel.width().saturating_sub(6));
            let style = panel.style(Role::Muted);
            let told = wrapped.into_iter().take(2);
            lines.extend(told.map(|line| Line::styled(format!("     {line}"), style)));
        }
        lines
    }
}
