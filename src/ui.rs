//! The screens: what a [`State`] looks like. Drawing reads the state and changes nothing.

use ratatui::Frame;

use crate::app::state::{Overlay, SMALLEST, Screen, State};

mod screen;
mod theme;
mod widget;

pub use theme::{ColourDepth, Role, Theme, ThemeError, ThemeFile, Themes};

/// Draws the whole console.
pub fn draw(state: &State, theme: &Theme, frame: &mut Frame<'_>) {
    let area = frame.area();
    frame.buffer_mut().set_style(area, theme.style(Role::Text));
    if area.width < SMALLEST.0 || area.height < SMALLEST.1 {
        screen::small::draw(theme, area, frame.buffer_mut());
        return;
    }
    let body = widget::header::draw(state, theme, area, frame.buffer_mut());
    let buffer = frame.buffer_mut();
    match &state.screen {
        Screen::Home { cursor } => screen::home::draw(state, *cursor, theme, body, buffer),
        Screen::Fly { .. } => screen::fly::draw(state, theme, body, buffer),
        Screen::Debrief { lines, scroll, .. } => {
            screen::debrief::draw(lines, *scroll, theme, body, buffer);
        }
    }
    widget::footer::draw(state, theme, area, buffer);
    let cursor = match &state.overlay {
        None => None,
        Some(Overlay::Palette(line)) => Some(widget::palette::draw(line, theme, area, buffer)),
        Some(Overlay::Connect(prompt)) => Some(widget::connect::draw(prompt, theme, area, buffer)),
        Some(other) => {
            widget::overlay::draw(state, other, theme, area, buffer);
            None
        }
    };
    if let Some(position) = cursor {
        frame.set_cursor_position(position);
    }
}
