//! The prompt for addresses.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};

use super::palette::draw_line;
use crate::app::state::Connect;
use crate::ui::theme::{Role, Theme};
use crate::ui::widget::{boxed, centred, put, wrap};

const EXAMPLES: &[(&str, &str)] = &[
    ("tcp:127.0.0.1:5760", "ArduPilot SITL, one vehicle per port"),
    ("udpin:0.0.0.0:14550", "listen; vehicles send here"),
    ("udp:192.168.1.20:14550", "send to a vehicle or a router"),
    (
        "serial:/dev/ttyACM0:115200",
        "an autopilot or a radio on a cable",
    ),
    ("file:FLIGHT.tlog", "a recording"),
];
const HEIGHT: u16 = 14;
const WIDTH: u16 = 72;

/// Draws the prompt and returns where the terminal's cursor belongs.
pub fn draw(prompt: &Connect, theme: &Theme, area: Rect, buffer: &mut Buffer) -> Position {
    let place = centred(WIDTH, HEIGHT, area);
    let inner = boxed("connect to", Role::Accent, theme, place, buffer);
    let (cursor, _) = draw_line(&prompt.input, None, theme, inner, buffer);
    let mut row = 1;
    let fault = prompt.fault.as_deref().unwrap_or_default();
    for line in wrap(fault, usize::from(inner.width)).into_iter().take(3) {
        put(
            buffer,
            inner,
            row,
            &Line::styled(line, theme.style(Role::Danger)),
        );
        row += 1;
    }
    row += 1;
    for (address, meaning) in EXAMPLES {
        let line = Line::from(vec![
            Span::raw(format!("{address:28}")),
            Span::styled(*meaning, theme.style(Role::Muted)),
        ]);
        put(buffer, inner, row, &line);
        row += 1;
    }
    let text = "several addresses: blanks between them.  Enter connects, Esc closes";
    put(
        buffer,
        inner,
        row + 1,
        &Line::styled(text, theme.style(Role::Muted)),
    );
    cursor
}
