//! What the desk of a class shows to its seats: the rooms of the replay, without anything that is only for the
//! instructor.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::{Hits, Look, Panel, Role, ascii, picture, screen, underline, widget};
use crate::app::State;
use crate::app::room::class::is_for_class;
use crate::class::Picture;
use crate::config::Symbols;
use crate::ui::widget::{put, row_of, upper};

/// Draws what is shown to the class, with the timeline in the last row; `None` while the desk has something else on its
/// screen. The header, the messages and the command line of the desk are not part of it.
pub fn shown_to_class(state: &State, look: &Look, (columns, rows): (u16, u16)) -> Option<Picture> {
    let view = state.replay().filter(|_| is_for_class(state))?;
    let look = Look {
        hits: Hits::default(),
        ..look.clone()
    };
    let area = Rect::new(0, 0, columns, rows);
    let mut buffer = Buffer::empty(area);
    buffer.set_style(area, look.style(Role::Text));
    let body = Panel::new(&look, upper(area, rows.saturating_sub(1)));
    screen::draw(state, body, &mut buffer);
    let last = row_of(area, rows.saturating_sub(1));
    let bar = widget::replay::bar(state, view, Panel::new(&look, last));
    put(&mut buffer, last, 0, &bar);
    underline::keep_below_words(&mut buffer);
    if look.symbols == Symbols::Ascii {
        ascii::map(&mut buffer);
    }
    Some(picture(&buffer))
}
