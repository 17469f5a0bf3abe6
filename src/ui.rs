//! The screens, which draw a [`State`] and do not change it. The smallest terminal that they fit is `SMALLEST` in
//! `app::state`; a smaller one shows both sizes instead.
//!
//! # How the parts fit
//! - What a room shows: one file per room in `screen`. What several rooms show (header, footer, map, swarm table,
//!   overlays): `widget`.
//! - Which colour: a widget names a role, and `theme` gives the role its style, from `themes/*.toml` or the user's
//!   theme files; `look` brings theme, texts and symbols to every widget, and gives drones and teams their own
//!   colours and signs.
//! - How it reaches cells: `panel` divides an area and writes into it, `hits` records what a click means, `ascii`
//!   replaces characters that the terminal lacks, `picture` makes of a screen what an instructor sees elsewhere,
//!   `shown` draws what a desk shows to its class, `window` sets the title of the terminal's window.

use ratatui::Frame;

use crate::app::State;
use crate::app::state::{Overlay, is_too_small};
use crate::config::Symbols;
use crate::ui::panel::Panel;

pub mod ascii;
mod hits;
mod look;
mod panel;
mod picture;
mod screen;
mod shown;
mod theme;
mod underline;
mod widget;
mod window;

pub use hits::Hits;
pub use look::{Badge, Look};
pub use picture::picture;
pub use shown::shown_to_class;
pub use theme::{ColourDepth, Role, Theme, ThemeError, ThemeFile, Themes};
pub use window::window_title;

/// Draws the whole console, with only the characters that the terminal supports.
pub fn draw(state: &State, look: &Look, frame: &mut Frame<'_>) {
    draw_all(state, look, frame);
    underline::keep_below_words(frame.buffer_mut());
    if look.symbols == Symbols::Ascii {
        ascii::map(frame.buffer_mut());
    }
}

fn draw_all(state: &State, look: &Look, frame: &mut Frame<'_>) {
    look.hits.clear();
    let area = frame.area();
    // All cells at once: `Buffer::set_style` looks each of them up by its place.
    let style = look.style(Role::Text);
    for cell in &mut frame.buffer_mut().content {
        cell.set_style(style);
    }
    if is_too_small(area.width, area.height) {
        screen::small::draw(state, Panel::new(look, area), frame.buffer_mut());
        return;
    }
    let mut body = widget::header::draw(state, Panel::new(look, area), frame.buffer_mut());
    let keys_above = u16::from(state.has_keys_above_replay());
    body.height = body.height.saturating_sub(keys_above);
    let buffer = frame.buffer_mut();
    screen::draw(state, Panel::new(look, body), buffer);
    widget::footer::draw(state, Panel::new(look, area), buffer);
    let cursor = match state.overlay() {
        None => None,
        Some(Overlay::Palette(line)) => Some(widget::palette::draw(
            state,
            line,
            Panel::new(look, area),
            buffer,
        )),
        Some(Overlay::Prompt(prompt)) => Some(widget::prompt::draw(
            state,
            prompt,
            Panel::new(look, area),
            buffer,
        )),
        Some(other) => {
            widget::overlay::draw(state, other, Panel::new(look, area), buffer);
            None
        }
    };
    if let Some(position) = cursor {
        frame.set_cursor_position(position);
    }
}
