//! The alert line: the most serious unacknowledged alert.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::Action;
use crate::app::state::Pressing;
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, put, short_clock, width};
use crate::vehicle_id::ranges;

/// The height of the line in rows; 0 without an alert.
pub fn height(state: &State) -> u16 {
    u16::from(state.session().alerts().open().next().is_some())
}

/// Draws the line if there is an alert.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(pressing) = state.session().alerts().pressing() else {
        return;
    };
    let clock = short_clock(state.session().time(pressing.first.since));
    // In a replay, the flight with its alerts is over.
    let hint = if state.shows_past() {
        String::new()
    } else {
        let key = state.key(Action::Acknowledge);
        panel.text(&text!("alert-acknowledge-hint", key = key))
    };
    let room = usize::from(panel.area.width).saturating_sub(width(&hint) + 4);
    let text = clip(&words(&pressing, &clock, panel.look), room);
    let line = Line::from(vec![
        Span::styled(format!("! {text} "), panel.style(Role::Alert)),
        Span::styled(format!(" {hint}"), panel.style(Role::Muted)),
    ]);
    put(buffer, panel.area, 0, &line);
}

fn words(pressing: &Pressing<'_>, clock: &str, look: &Look) -> String {
    let alert = &pressing.first.alert;
    let title = alert.kind.title();
    let what = if pressing.alike { &alert.text } else { &title };
    let since = text!("alert-since", what = what, clock = clock);
    let vehicles = &pressing.vehicles;
    let text = match vehicles.as_slice() {
        [one] => text!("alert-of-one", vehicle = *one, what = since),
        many => {
            let named = text!("alert-of-many", count = many.len(), what = since);
            let ids = clip(&ranges(many.iter().copied()), 24);
            text!("alert-with-vehicles", what = named, vehicles = ids)
        }
    };
    look.text(&match pressing.others {
        0 => text,
        others => text!("alert-and-more", first = text, count = others),
    })
}
