//! The first line: where we are, how late it is, how many, over which links.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::state::{Room, State};
use crate::text;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, clock, put};

/// Draws the header and returns the area between it and the footer.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) -> Rect {
    let header = Rect { height: 1, ..area };
    buffer.set_style(header, look.style(Role::Header));
    let right = right_part(state, look, area.width);
    let left_width = usize::from(area.width).saturating_sub(right.width() + 4);
    let title = state
        .session
        .activity
        .as_ref()
        .map(|it| look.text(&it.title()));
    let name = format!(" {} ", look.text(&state.room.title()).to_uppercase());
    let title = clip(
        &title.unwrap_or_default(),
        left_width.saturating_sub(name.chars().count() + 1),
    );
    let bold = look
        .style(Role::Header)
        .add_modifier(ratatui::style::Modifier::BOLD);
    let left = Line::from(vec![
        Span::styled(name, bold),
        Span::raw(format!(" {title}")),
    ]);
    put(buffer, header, 0, &left);
    let start = area.width.saturating_sub(right.width() as u16 + 1);
    put(
        buffer,
        Rect {
            x: area.x + start,
            width: area.width - start,
            ..header
        },
        0,
        &right,
    );
    Rect {
        y: area.y + 1,
        height: area.height.saturating_sub(2),
        ..area
    }
}

fn right_part(state: &State, look: &Look, width: u16) -> Line<'static> {
    let mut parts = Vec::new();
    let dropped = state.notices.dropped;
    if dropped > 0 {
        let what = if width < 100 { "" } else { "notices " };
        parts.push(format!("{dropped} {what}dropped"));
    }
    if state.room != Room::Home {
        let count = look.text(&text!(
            "count-vehicles",
            count = state.session.vehicles.len()
        ));
        parts.push(format!("{count}, {} armed", state.session.armed()));
        parts.push(links(state));
    }
    parts.push(clock(state.session.time(state.now)));
    Line::raw(parts.join("   "))
}

fn links(state: &State) -> String {
    let links = &state.session.links;
    match links.as_slice() {
        [] => "no link".to_owned(),
        // A long address is cut rather than the word that matters.
        [link] => format!(
            "{} {}",
            clip(&link.name, 24),
            if link.up { "up" } else { "down" }
        ),
        links => {
            let up = links.iter().filter(|link| link.up).count();
            format!("{up}/{} links up", links.len())
        }
    }
}
