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
/// The least and the greatest width of a value's meaning, which replaces the type.
const MEANING: (usize, usize) = (18, 44);
/// The width of the screen, in columns, at which the meaning is as narrow as possible.
const NARROW: usize = 80;

/// The width of the third column: the type, or the meaning of the value if parameters are documented.
fn third(state: &State, width: usize) -> usize {
    if state.documents().is_empty() {
        return KIND;
    }
    let (least, most) = MEANING;
    (least + width.saturating_sub(NARROW) / 2).min(most)
}

/// The rows of one vehicle's list, with the cursor.
pub struct ShownRows<'a> {
    pub vehicle: VehicleId,
    pub rows: &'a [Row<'a>],
    pub at: usize,
}

/// Draws the heading and as many lines around the cursor as fit.
pub fn draw(state: &State, shown: &ShownRows<'_>, panel: Panel<'_>, buffer: &mut Buffer) {
    let ShownRows { vehicle, rows, at } = *shown;
    let third = third(state, panel.width());
    let others = others(state, vehicle, panel.width(), third);
    let heading = heading(state, &others, third, panel.look);
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
        let mut drawn = line_of(state, vehicle, row, third, panel.look);
        drawn
            .spans
            .insert(0, Span::raw(if index == at { "> " } else { "  " }));
        if !others.is_empty() {
            let gap = columns_used(state, third).saturating_sub(drawn.width());
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

fn heading(state: &State, others: &[VehicleId], third: usize, look: &Look) -> String {
    let meaning = if state.documents().is_empty() {
        "parameters-column-type"
    } else {
        "parameters-column-meaning"
    };
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
        aligned(&look.say(meaning), third, false),
        aligned(&look.say(second), VALUE, true),
        aligned(&look.say("parameters-column-state"), STATE, false),
        numbers.join(" "),
    )
}

fn line_of<'a>(
    state: &State,
    vehicle: VehicleId,
    row: &Row<'a>,
    third: usize,
    look: &Look,
) -> Line<'a> {
    let comparison = state.rooms().parameters().comparison();
    let mut spans = Vec::new();
    if let Some(comparison) = comparison {
        spans.push(mark(comparison, row, look));
    }
    let changed = row.now.filter(ListedParameter::is_changed);
    let value = row
        .now
        .map_or_else(|| "-".to_owned(), |now| shown(now.value));
    let kind = third_of(state, row);
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
        Span::styled(aligned(&kind, third, false), look.style(Role::Muted)),
        Span::styled(
            format!(" {} ", aligned(&second.unwrap_or_default(), VALUE, true)),
            look.style(Role::Text),
        ),
    ]);
    spans.extend(standing(state, vehicle, row, look));
    Line::from(spans)
}

/// The third column: the type, or the meaning of the value if parameters are documented.
fn third_of(state: &State, row: &Row<'_>) -> String {
    let Some(now) = row.now else {
        return String::new();
    };
    if state.documents().is_empty() {
        return now.kind.name().to_owned();
    }
    let document = state.documents().get(row.name);
    document.map_or_else(String::new, |it| it.remark(now.value))
}

/// The width of the columns before those of other vehicles.
fn columns_used(state: &State, third: usize) -> usize {
    let is_compared = state.rooms().parameters().comparison().is_some();
    let marks = if is_compared { 6 } else { 2 };
    marks + NAME + 1 + VALUE + 1 + third + 1 + VALUE + 1 + STATE
}

/// The other target vehicles, as many as there is room for.
fn others(state: &State, vehicle: VehicleId, width: usize, third: usize) -> Vec<VehicleId> {
    let free = width.saturating_sub(columns_used(state, third));
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
            let value = shown(edit.value);
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
        (None, None) => {
            let default = state
                .rooms()
                .parameters()
                .other_default(vehicle, row.name)?;
            (
                text!("parameters-default", value = shown(default)),
                Role::Muted,
            )
        }
    };
    Some(Span::styled(look.text(&text), look.style(role)))
}
