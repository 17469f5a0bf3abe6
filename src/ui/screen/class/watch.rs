//! The screen of a seat as its trainee sees it.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Size};
use ratatui::style::Modifier;
use ratatui::text::{Line, Span};

use super::age;
use super::detail::title;
use crate::app::State;
use crate::class::{Picture, STALE_AFTER, SeatRecord};
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::picture::draw_picture;
use crate::ui::theme::Role;
use crate::ui::widget::{below, clip, put};

pub fn draw(state: &State, seat: &SeatRecord, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = below(panel.area, 1);
    let stale = stale(state, seat);
    let mut remarks: Vec<(Text, Role)> = stale.iter().cloned().collect();
    match seat.picture() {
        None => remarks.push((text!("class-watch-none"), Role::Muted)),
        Some(picture) => {
            let view = state.rooms().class().view();
            let first = Position::new(
                first(view.0, picture.columns(), inner.width),
                first(view.1, picture.rows(), inner.height),
            );
            draw_picture(picture, first, inner, buffer);
            if stale.is_some() {
                let dim = panel.style(Role::Muted).add_modifier(Modifier::DIM);
                buffer.set_style(inner, dim);
            }
            remarks.extend(cut(picture, first, inner.as_size()));
        }
    }
    let name = text!("class-watch-title", seat = title(seat));
    let mut line = Line::from(Span::styled(panel.text(&name), panel.style(Role::Title)));
    for (text, role) in remarks {
        let room = panel.width().saturating_sub(line.width() + 2);
        line.push_span("  ");
        let text = clip(&panel.text(&text), room);
        line.push_span(Span::styled(text, panel.style(role)));
    }
    put(buffer, panel.area, 0, &line);
}

/// The first column or row that is shown, so that the view does not leave the picture.
fn first(wanted: u16, all: u16, shown: u16) -> u16 {
    wanted.min(all.saturating_sub(shown))
}

/// Which part of the picture is shown, if not all of it.
fn cut(picture: &Picture, first: Position, shown: Size) -> Option<(Text, Role)> {
    let (columns, rows) = (picture.columns(), picture.rows());
    if columns <= shown.width && rows <= shown.height {
        return None;
    }
    let last = |first: u16, shown: u16, all: u16| (first + shown).min(all);
    let text = text!(
        "class-watch-cut",
        left = first.x + 1,
        right = last(first.x, shown.width, columns),
        columns = columns,
        top = first.y + 1,
        bottom = last(first.y, shown.height, rows),
        rows = rows
    );
    Some((text, Role::Accent))
}

/// Why the picture may be old.
fn stale(state: &State, seat: &SeatRecord) -> Option<(Text, Role)> {
    if !seat.is_here() {
        return Some((text!("class-watch-gone"), Role::Warning));
    }
    let unseen = seat.unseen_for(state.wall())?;
    let time = age(unseen.as_secs_f64());
    (unseen >= STALE_AFTER).then(|| (text!("class-watch-stale", time = time), Role::Warning))
}
