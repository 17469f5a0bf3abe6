//! The list of profiles.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::State;
use crate::app::action::Action;
use crate::app::keymap::Place;
use crate::app::state::Trainee;
use crate::notice::sanitised;
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{centred, clip, put, row_of, upper};

/// The width of the list, in columns.
const WIDTH: u16 = 60;
/// The number of rows of the frame and of the advice below the list.
const FRAME: u16 = 4;

/// Draws the list with its cursor.
pub fn draw(state: &State, cursor: usize, panel: Panel<'_>, buffer: &mut Buffer) {
    let trainees = state.training().trainees();
    let height = (trainees.len() as u16).saturating_add(FRAME);
    let place = centred(
        WIDTH,
        height.min(panel.area.height.saturating_sub(2)),
        panel.area,
    );
    let inner = panel
        .at(place)
        .boxed(&panel.say("profiles-title"), Role::Accent, buffer);
    let rows = usize::from(inner.height.saturating_sub(2));
    let first = cursor.saturating_sub(rows.saturating_sub(1));
    for (row, at) in (first..trainees.len()).take(rows).enumerate() {
        let row = row as u16;
        let (trainee, under_cursor) = (&trainees[at], at == cursor);
        let mark = if under_cursor { '>' } else { ' ' };
        let now = if state.training().is_current(trainee) {
            panel.say("profiles-now")
        } else {
            String::new()
        };
        let line = format!("{mark} {}  {now}", name(trainee, panel.look));
        let text = clip(&line, usize::from(inner.width));
        put(buffer, inner, row, &Line::raw(text));
        if under_cursor {
            panel.at(row_of(inner, row)).mark_cursor(buffer);
        }
    }
    let list = upper(inner, rows as u16);
    panel.at(list).mark_scroll(first, trainees.len(), buffer);
    let keys = text!(
        "profiles-keys",
        scroll = state.keymap().keys(Action::UP_AND_DOWN, Place::List),
        submit = state.keymap().key(Action::Submit, Place::List),
        escape = state.keymap().key(Action::Escape, Place::List)
    );
    let line = Line::styled(panel.text(&keys), panel.style(Role::Muted));
    put(buffer, inner, inner.height.saturating_sub(1), &line);
}

fn name(trainee: &Trainee, look: &Look) -> String {
    match trainee {
        Trainee::Known(name) => sanitised(name),
        Trainee::New => look.say("profiles-new"),
        Trainee::Guest => look.say("profiles-guest"),
    }
}
