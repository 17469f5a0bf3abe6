//! The room of that name.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::app::state::State;
use crate::ui::look::Look;

/// Draws it.
pub fn draw(_state: &State, _look: &Look, _area: Rect, _buffer: &mut Buffer) {}
