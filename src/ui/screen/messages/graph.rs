//! The fields that are drawn as graphs.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::room::messages::{GRAPH_SPAN, Messages, Pin};
use crate::inspector::figure;
use crate::text;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::curve::{self, Curve};
use crate::ui::widget::{below, clip, put, titled, upper};

/// Rows of one graph with its title, where there is room for more than the least.
const COMFORTABLE: u16 = 6;
const LEAST: u16 = 4;

/// Rows that the graphs take of the pane.
pub(super) fn height(room: &Messages, available: u16) -> u16 {
    let count = room.pins.len() as u16;
    let wanted = count * COMFORTABLE;
    wanted
        .min((available / 2).max(LEAST * count.min(1)))
        .min(available)
}

/// Draws as many as fit, the newest ones first of all.
pub(super) fn draw(room: &Messages, look: &Look, area: Rect, buffer: &mut Buffer) {
    let fitting = (area.height / LEAST).max(1);
    let shown = room.pins.len().min(fitting.into());
    let mut area = area;
    for (at, pin) in room.pins.iter().skip(room.pins.len() - shown).enumerate() {
        let rows = area.height / (shown - at) as u16;
        draw_pin(pin, look, upper(area, rows), buffer);
        area = below(area, rows);
    }
}

fn draw_pin(pin: &Pin, look: &Look, area: Rect, buffer: &mut Buffer) {
    let source = pin.key.source;
    let title = format!(
        "{}/{} {} {}",
        source.system, source.component, pin.title, pin.unit
    );
    let inner = titled(title.trim_end(), look, area, buffer);
    let Some((low, high, now)) = pin.extent() else {
        put(
            buffer,
            inner,
            0,
            &Line::styled("-", look.style(Role::Muted)),
        );
        return;
    };
    let fits = |text: &String| Span::raw(text).width() <= usize::from(inner.width);
    let whole = figures(pin, (low, high, now), 5, look);
    let figures = if fits(&whole) {
        whole
    } else {
        figures(pin, (low, high, now), 3, look)
    };
    let figures = clip(&figures, inner.width.into());
    put(
        buffer,
        inner,
        0,
        &Line::styled(figures, look.style(Role::Muted)),
    );
    let area = below(inner, 1);
    let values = columns(pin, curve::steps(area.width, look.symbols));
    let style = look.style(Role::Accent);
    let curve = Curve {
        values: &values,
        low,
        high,
        style,
    };
    curve::draw(&curve, look.symbols, area, buffer);
}

/// The newest value, and the least and the greatest that are drawn, in so many digits.
fn figures(pin: &Pin, (low, high, now): (f64, f64, f64), digits: i32, look: &Look) -> String {
    let mut figures = look.text(&text!(
        "messages-extent",
        now = figure(now, digits),
        low = figure(low, digits),
        high = figure(high, digits),
        seconds = GRAPH_SPAN.as_secs()
    ));
    if pin.dropped > 0 {
        let dropped = text!("messages-not-drawn", count = pin.dropped);
        figures = format!("{figures}  {}", look.text(&dropped));
    }
    figures
}

/// The last value within each column's share of the time; the last known one where none came.
fn columns(pin: &Pin, count: usize) -> Vec<Option<f64>> {
    let mut columns = vec![None; count];
    for (at, value) in &pin.points {
        let ago = pin.now.saturating_sub(*at).as_secs_f64() / GRAPH_SPAN.as_secs_f64();
        let column = ((1.0 - ago) * (count.saturating_sub(1)) as f64).round();
        if let Some(cell) = columns.get_mut(column.max(0.0) as usize) {
            *cell = Some(*value);
        }
    }
    let mut last = None;
    for cell in &mut columns {
        last = cell.or(last);
        *cell = last;
    }
    columns
}
