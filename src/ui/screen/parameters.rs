//! The parameters of the vehicle under the cursor: the progress of the download, the list, and below it the value of
//! the parameter under the cursor on every target vehicle.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::State;
use crate::app::action::{Action, ParametersAction};
use crate::app::room::parameters::{Edit, Row, coming, cursor_row, outcome, rows};
use crate::ui::panel::Panel;

use crate::commands::is_written_so;
use crate::ledger::RowState;
use crate::text;
use crate::text::Text;
use crate::ui::theme::Role;
use crate::ui::widget::{below, put, row_of, upper};
use crate::vehicle::VehicleId;

mod detail;
mod document;
mod list;
mod status;

const STATUS_ROWS: u16 = 2;
/// The minimum number of rows of the list.
const LIST_LEAST: u16 = 8;

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(vehicle) = state.session().cursor() else {
        let line = Line::styled(panel.say("parameters-no-vehicle"), panel.style(Role::Muted));
        put(buffer, below(panel.area, 1), 0, &line);
        return;
    };
    let rows = rows(state);
    let (status, rest) = (
        upper(panel.area, STATUS_ROWS),
        below(panel.area, STATUS_ROWS),
    );
    status::draw(state, vehicle, &rows, panel.at(status), buffer);
    let at = cursor_row(state, &rows);
    let Some(row) = rows.get(at) else {
        return draw_nothing(state, vehicle, panel.at(rest), buffer);
    };
    let mut told = detail::lines(state, vehicle, row, panel);
    let most = rest.height.saturating_sub(LIST_LEAST);
    if let Some(document) = state.documents().get(row.name) {
        let free = usize::from(most).saturating_sub(told.len() + 1);
        told.extend(document::lines(document, row.now.as_ref(), free, panel));
    }
    let list_rows = rest.height - most.min(told.len() as u16 + 1);
    let list = upper(rest, list_rows);
    list::draw(
        state,
        &list::ShownRows {
            vehicle,
            rows: &rows,
            at,
        },
        panel.at(list),
        buffer,
    );
    detail::draw(row.name, &told, panel.at(below(rest, list_rows)), buffer);
}

/// Draws the reason why the list is empty.
fn draw_nothing(state: &State, vehicle: VehicleId, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().parameters();
    let known = room.lists().get(&vehicle);
    let text = if known.is_none_or(|known| known.list.is_empty()) {
        text!("parameters-none-yet")
    } else if !room.filter_text().is_empty() {
        text!("parameters-none-fit", key = state.key(Action::Escape))
    } else if let Some(comparison) = room.comparison() {
        match coming(state, vehicle, &comparison.with) {
            Some(_) => text!("parameters-none-differ-yet"),
            None => text!("parameters-none-differ", key = state.key(Action::Escape)),
        }
    } else if room.shows_other_than_default() {
        text!("parameters-all-default", key = state.key(Action::Escape))
    } else {
        text!(
            "parameters-none-changed",
            key = state.key(Action::Parameters(ParametersAction::ChangedParameters))
        )
    };
    let line = Line::styled(format!(" {}", panel.text(&text)), panel.style(Role::Muted));
    put(buffer, row_of(panel.area, 1), 0, &line);
}

/// The outcome of a new value, in a word with its role, and the reason for a failure or for a value rounded by the
/// vehicle. `now` is the vehicle's value.
fn edited(
    state: &State,
    edit: Edit,
    vehicle: VehicleId,
    now: Option<f64>,
) -> Option<(Text, Role, Option<Text>)> {
    let row = outcome(state, edit.entry, vehicle)?;
    let (word, role) = match row.state {
        RowState::Queued => (text!("parameters-state-waiting"), Role::Muted),
        RowState::Sent | RowState::SentOnly | RowState::InProgress(_) | RowState::Accepted => {
            (text!("parameters-state-sent"), Role::Accent)
        }
        RowState::Done | RowState::NoEffect => (text!("parameters-state-confirmed"), Role::Ok),
        RowState::Refused | RowState::Barred => (text!("parameters-state-refused"), Role::Danger),
        RowState::TimedOut => (text!("parameters-state-unanswered"), Role::Danger),
        RowState::Superseded | RowState::Overtaken => {
            (text!("parameters-state-replaced"), Role::Muted)
        }
    };
    let became_other = now.is_some_and(|now| !is_written_so(now, edit.value));
    let is_told = row.state.is_failure() || row.state == RowState::Done && became_other;
    Some((word, role, row.explanation.clone().filter(|_| is_told)))
}
