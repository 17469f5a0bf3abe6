//! The sticks while a vehicle is flown by keys.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::Action;
use crate::app::keymap::Place;
use crate::app::state::{StickAxis, StickMode};
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{put, wrap};

/// The width of the box, and its height with its frame.
const WIDTH: u16 = 76;
const HEIGHT: u16 = 5;

/// Draws the positions and the keys at the bottom, so that the vehicle stays visible.
pub fn draw(state: &State, mode: &StickMode, panel: Panel<'_>, buffer: &mut Buffer) {
    let area = panel.area;
    let width = WIDTH.min(area.width);
    let height = HEIGHT.min(area.height);
    let place = Rect {
        x: area.x + (area.width - width) / 2,
        y: area.bottom() - height,
        width,
        height,
    };
    let title = panel.text(&text!(
        "sticks-title",
        vehicle = mode.vehicle(),
        key = state.keymap().key(Action::Escape, Place::Prompt)
    ));
    // The footer would stick out on both sides.
    panel.below(area.height - height).clear(buffer);
    let inner = panel.at(place).boxed(&title, Role::Danger, buffer);
    let mut spans = Vec::new();
    for axis in StickAxis::ALL {
        let name = match axis {
            StickAxis::Roll => "sticks-roll",
            StickAxis::Pitch => "sticks-pitch",
            StickAxis::Throttle => "sticks-throttle",
            StickAxis::Yaw => "sticks-yaw",
        };
        let pulse_us = mode.pulse_us(axis);
        let role = if pulse_us == crate::commands::CENTRE_US {
            Role::Text
        } else {
            Role::Key
        };
        spans.push(Span::styled(
            format!("{} ", panel.say(name)),
            panel.style(Role::Muted),
        ));
        spans.push(Span::styled(format!("{pulse_us}   "), panel.style(role)));
    }
    put(buffer, inner, 0, &Line::from(spans));
    let keys = wrap(&panel.say("sticks-keys"), usize::from(inner.width));
    for (row, line) in (1..).zip(keys) {
        put(
            buffer,
            inner,
            row,
            &Line::styled(line, panel.style(Role::Muted)),
        );
    }
}
