//! The list: a line per parameter.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::{Row, edited};
use crate::app::State;
use crate::app::room::parameters::Comparison;
use crate::parameters::{ListedParameter, ParameterFinding, is_same, is_the_vehicles_own, shown};
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, put, row_of};
use crate::vehicle::VehicleId;

/// The width of a name, in columns: the length of its field on the wire.
const NAME: usize = 16;
/// The width of a value, in columns.
const VALUE: usize = 13;
/// The width of an edit's outcome if more columns follow.
const STATE: usize = 24;
/// The width of a type, in columns.
const KIND: usize = 6;

/// The rows of one vehicle's list, with the cursor.
pub struct ShownRows<'a> {
    pub vehicle: VehicleId,
    pub rows: &'a [Row<'a>],
    pub at: usize,
}

/// Draws the heading and as many lines around the cursor as fit.
pub fn draw(state: &State, shown: &ShownRows<'_>, panel: Panel<'_>, buffer: &mut Buffer) {
    let ShownRows { vehicle, rows, at } = *shown;
    let others = others(state, vehicle, panel.area.width);
    let heading = heading(state, &others, panel.look);
    put(
        buffer,
        panel.area,
        0,
        &Line::styled(heading, panel.style(Role::Title)),
    );
    let list = panel.below(1).area;
    let visible = usize::from(list.height);
    let top = at
        .saturating_sub(visible / 2)
        .min(rows.len().saturating_sub(visible));
    for (line, (index, row)) in rows.iter().enumerate().skip(top).take(visible).enumerate() {
        let place = row_of(list, line as u16);
        let mut drawn = line_of(state, vehicle, row, index == at, panel.look);
        if !others.is_empty() {
            let is_compared = state.rooms().parameters().comparison().is_some();
            let gap = columns_used(is_compared).saturating_sub(drawn.width());
            drawn.push_span(Span::raw(" ".repeat(gap)));
        }
        for &id in &others {
            drawn.push_span(value_of(state, id, row, panel.look));
        }
        put(buffer, place, 0, &drawn);
        if index == at {
            panel.at(place).mark_cursor(buffer);
        }
    }
    panel.at(list).mark_list(top, rows.len(), true, buffer);
}

fn heading(state: &State, others: &[VehicleId], look: &Look) -> String {
    let (mark, second) = match state.rooms().parameters().comparison() {
        None => ("", "parameters-column-before"),
        Some(_) => ("    ", "parameters-column-other"),
    };
    let numbers: Vec<String> = others
        .iter()
        .map(|id| aligned(&format!("#{id}"), VALUE, true))
        .collect();
    format!(
        "  {mark}{} {} {} {} {} {}",
        aligned(&look.say("parameters-column-name"), NAME, false),
        aligned(&look.say("parameters-column-value"), VALUE, true),
        aligned(&look.say("parameters-column-type"), KIND, false),
        aligned(&look.say(second), VALUE, true),
        aligned(&look.say("parameters-column-state"), STATE, false),
        numbers.join(" "),
    )
}

fn line_of<'a>(
    state: &State,
    vehicle: VehicleId,
    row: &Row<'a>,
    is_under_cursor: bool,
    look: &Look,
) -> Line<'a> {
    let comparison = state.rooms().parameters().comparison();
    let mut spans = vec![Span::raw(if is_under_cursor { "> " } else { "  " })];
    if let Some(comparison) = comparison {
        spans.push(mark(comparison, row, look));
    }
    let changed = row.now.filter(ListedParameter::is_changed);
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
        Span::styled(aligned(row.name, NAME, false), look.style(Role::Text)),
        Span::styled(
            format!(" {} ", aligned(&value, VALUE, true)),
            look.style(value_role),
        ),
        Span::styled(aligned(kind, KIND, false), look.style(Role::Muted)),
        Span::styled(
            format!(" {} ", aligned(&second.unwrap_or_default(), VALUE, true)),
            look.style(Role::Text),
        ),
    ]);
    spans.extend(standing(state, vehicle, row, look));
    Line::from(spans)
}

/// The width of the columns before those of other vehicles.
fn columns_used(is_compared: bool) -> usize {
    let marks = if is_compared { 6 } else { 2 };
    marks + NAME + 1 + VALUE + 1 + KIND + 1 + VALUE + 1 + STATE
}

/// The other target vehicles, as many as there is room for.
fn others(state: &State, vehicle: VehicleId, width: u16) -> Vec<VehicleId> {
    let is_compared = state.rooms().parameters().comparison().is_some();
    let free = usize::from(width).saturating_sub(columns_used(is_compared));
    let selected = state.session().selection().iter().copied();
    selected
        .filter(|id| *id != vehicle)
        .take(free / (VALUE + 1))
        .collect()
}

/// The value on another vehicle, highlighted if it differs.
fn value_of(state: &State, id: VehicleId, row: &Row<'_>, look: &Look) -> Span<'static> {
    let value = state
        .rooms()
        .parameters()
        .get(id, row.name)
        .map(|it| it.value);
    let is_equal = match (value, row.now) {
        (Some(value), Some(now)) => is_same(value, now.value),
        (value, now) => value.is_none() && now.is_none(),
    };
    let role = if is_equal { Role::Muted } else { Role::Warning };
    let sign = if is_equal { ' ' } else { '*' };
    let text = value.map_or_else(|| "-".to_owned(), shown);
    Span::styled(
        format!("{}{sign}", aligned(&text, VALUE, true)),
        look.style(role),
    )
}

fn mark(comparison: &Comparison, row: &Row<'_>, look: &Look) -> Span<'static> {
    match row.finding {
        None | Some(ParameterFinding::Extra(_)) => Span::raw("    "),
        Some(finding) if comparison.is_marked(row.name, finding) => {
            Span::styled("[x] ", look.style(Role::Selected))
        }
        Some(_) => Span::styled("[ ] ", look.style(Role::Muted)),
    }
}

/// The fifth column: the outcome of a new value, otherwise the difference.
fn standing(
    state: &State,
    vehicle: VehicleId,
    row: &Row<'_>,
    look: &Look,
) -> Option<Span<'static>> {
    let edit = state.rooms().parameters().edit(vehicle, row.name);
    let now = row.now.map(|known| known.value);
    let asked = edit.and_then(|edit| Some((edit, edited(state, edit, vehicle, now)?)));
    let (text, role) = match (asked, row.finding) {
        (Some((edit, (word, role, _))), _) => {
            let value = shown(edit.value as f32);
            (text!("parameters-asked", value = value, state = word), role)
        }
        (None, Some(ParameterFinding::Changed(..))) if is_the_vehicles_own(row.name) => {
            (text!("parameters-own"), Role::Muted)
        }
        (None, Some(ParameterFinding::Changed(..))) => (text!("parameters-differs"), Role::Warning),
        (None, Some(ParameterFinding::Missing(_))) => (text!("parameters-missing"), Role::Muted),
        (None, Some(ParameterFinding::Extra(_))) => (text!("parameters-extra"), Role::Muted),
        (None, None) if row.now.is_some_and(|now| now.is_changed()) => {
            (text!("parameters-changed"), Role::Accent)
        }
        (None, None) => return None,
    };
    Some(Span::styled(look.text(&text), look.style(role)))
}
