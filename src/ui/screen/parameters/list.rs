//! The list: a line per parameter.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::{Row, cell, edited};
use crate::app::room::parameters::Comparison;
use crate::app::state::State;
use crate::parameters::{Finding, shown};
use crate::text;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{below, put, row_of};
use crate::vehicle::VehicleId;

/// Columns of a name: as many as its field has on the wire.
const NAME: usize = 16;
/// Columns of a value.
const VALUE: usize = 13;
/// Columns of a type.
const KIND: usize = 6;

/// Draws the heading and as many lines around the cursor as fit.
pub fn draw(
    state: &State,
    vehicle: VehicleId,
    (rows, at): (&[Row<'_>], usize),
    look: &Look,
    area: Rect,
    buffer: &mut Buffer,
) {
    let comparison = state.rooms.parameters.comparison.as_ref();
    let second = match comparison {
        None => "parameters-column-before",
        Some(_) => "parameters-column-other",
    };
    let mark = if comparison.is_some() { "    " } else { "" };
    let heading = format!(
        "  {mark}{} {} {} {} {}",
        cell(&look.say("parameters-column-name"), NAME, false),
        cell(&look.say("parameters-column-value"), VALUE, true),
        cell(&look.say("parameters-column-type"), KIND, false),
        cell(&look.say(second), VALUE, true),
        look.say("parameters-column-state"),
    );
    put(
        buffer,
        area,
        0,
        &Line::styled(heading, look.style(Role::Title)),
    );
    let area = below(area, 1);
    let visible = usize::from(area.height);
    let top = at
        .saturating_sub(visible / 2)
        .min(rows.len().saturating_sub(visible));
    for (line, (index, row)) in rows.iter().enumerate().skip(top).take(visible).enumerate() {
        let place = row_of(area, line as u16);
        let drawn = line_of(state, vehicle, row, (index == at, look));
        put(buffer, place, 0, &drawn);
        if index == at {
            buffer.set_style(place, look.style(Role::Cursor));
        }
    }
}

fn line_of<'a>(
    state: &State,
    vehicle: VehicleId,
    row: &Row<'a>,
    (is_under_cursor, look): (bool, &Look),
) -> Line<'a> {
    let comparison = state.rooms.parameters.comparison.as_ref();
    let mut spans = vec![Span::raw(if is_under_cursor { "> " } else { "  " })];
    if let (Some(comparison), Some(finding)) = (comparison, row.finding) {
        spans.push(mark(comparison, row.name, finding, look));
    }
    let changed = row.now.filter(|now| now.is_changed());
    let value = row
        .now
        .map_or_else(|| "-".to_owned(), |now| shown(now.value));
    let kind = row.now.map_or("", |now| now.kind.name());
    let second = match comparison {
        Some(_) => row.other().map(shown),
        None => changed.map(|now| shown(now.original)),
    };
    let value_role = if changed.is_some() {
        Role::Accent
    } else {
        Role::Text
    };
    spans.extend([
        Span::styled(cell(row.name, NAME, false), look.style(Role::Text)),
        Span::styled(
            format!(" {} ", cell(&value, VALUE, true)),
            look.style(value_role),
        ),
        Span::styled(cell(kind, KIND, false), look.style(Role::Muted)),
        Span::styled(
            format!(" {} ", cell(&second.unwrap_or_default(), VALUE, true)),
            look.style(Role::Text),
        ),
    ]);
    spans.extend(standing(state, vehicle, row, look));
    Line::from(spans)
}

fn mark(comparison: &Comparison, name: &str, finding: Finding, look: &Look) -> Span<'static> {
    match finding {
        Finding::Extra(_) => Span::raw("    "),
        _ if comparison.is_marked(name, finding) => {
            Span::styled("[x] ", look.style(Role::Selected))
        }
        _ => Span::styled("[ ] ", look.style(Role::Muted)),
    }
}

/// The last column: what became of a value that was asked for, else how it differs.
fn standing(
    state: &State,
    vehicle: VehicleId,
    row: &Row<'_>,
    look: &Look,
) -> Option<Span<'static>> {
    let edit = state.rooms.parameters.edit(vehicle, row.name);
    let asked = edit.and_then(|edit| Some((edit, edited(state, edit, vehicle)?)));
    let (text, role) = match (asked, row.finding) {
        (Some((edit, (word, role, _))), _) => {
            let value = shown(edit.value);
            (text!("parameters-asked", value = value, state = word), role)
        }
        (None, Some(Finding::Changed(..))) => (text!("parameters-differs"), Role::Warning),
        (None, Some(Finding::Missing(_))) => (text!("parameters-missing"), Role::Muted),
        (None, Some(Finding::Extra(_))) => (text!("parameters-extra"), Role::Muted),
        (None, None) if row.now.is_some_and(|now| now.is_changed()) => {
            (text!("parameters-changed"), Role::Accent)
        }
        (None, None) => return None,
    };
    Some(Span::styled(look.text(&text), look.style(role)))
}
