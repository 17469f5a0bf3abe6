//! The fields that are drawn as graphs.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::room::messages::{GRAPH_SPAN, Messages, Pin, PinExtent};
use crate::inspector::figure;
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::curve::{self, Curve};
use crate::ui::widget::{below, clip, put};

/// The preferred and the minimum height of a graph with its title, in rows.
const COMFORTABLE: u16 = 6;
const LEAST: u16 = 4;

/// The height of the pane for the graphs, in rows.
pub(super) fn height(room: &Messages, available: u16) -> u16 {
    let count = room.pins().len() as u16;
    let wanted = count * COMFORTABLE;
    wanted
        .min((available / 2).max(LEAST * count.min(1)))
        .min(available)
}

/// Draws the newest graphs, as many as fit, the newest at the bottom.
pub(super) fn draw(room: &Messages, panel: Panel<'_>, buffer: &mut Buffer) {
    let fitting = (panel.area.height / LEAST).max(1);
    let shown = room.pins().len().min(fitting.into());
    let mut rest = panel;
    for (at, pin) in room
        .pins()
        .iter()
        .skip(room.pins().len() - shown)
        .enumerate()
    {
        let rows = rest.area.height / (shown - at) as u16;
        draw_pin(pin, rest.upper(rows), buffer);
        rest = rest.below(rows);
    }
}

fn draw_pin(pin: &Pin, panel: Panel<'_>, buffer: &mut Buffer) {
    let source = pin.key.source;
    let title = format!(
        "{}/{} {} {}",
        source.system, source.component, pin.title, pin.unit
    );
    let inner = panel.titled(title.trim_end(), buffer);
    let Some(extent) = pin.extent() else {
        put(
            buffer,
            inner,
            0,
            &Line::styled("-", panel.style(Role::Muted)),
        );
        return;
    };
    let fits = |text: &String| Span::raw(text).width() <= usize::from(inner.width);
    let whole = figures(pin, extent, 5, panel.look);
    let fitting = if fits(&whole) {
        whole
    } else {
        figures(pin, extent, 3, panel.look)
    };
    put(
        buffer,
        inner,
        0,
        &Line::styled(clip(&fitting, inner.width.into()), panel.style(Role::Muted)),
    );
    let plot = below(inner, 1);
    let values = columns(pin, curve::steps(plot.width, panel.look.symbols));
    let style = panel.style(Role::Accent);
    let curve = Curve {
        values: &values,
        low: extent.low,
        high: extent.high,
        style,
    };
    curve::draw(&curve, panel.look.symbols, plot, buffer);
}

/// The newest, the minimum and the maximum value drawn, with this many decimals.
fn figures(pin: &Pin, extent: PinExtent, digits: i32, look: &Look) -> String {
    let mut figures = look.text(&text!(
        "messages-extent",
        now = figure(extent.now, digits),
        low = figure(extent.low, digits),
        high = figure(extent.high, digits),
        seconds = GRAPH_SPAN.as_secs()
    ));
    if pin.dropped > 0 {
        let dropped = text!("messages-not-drawn", count = pin.dropped);
        figures = format!("{figures}  {}", look.text(&dropped));
    }
    figures
}

/// The last value in each column's time span; if there is none, the last value before it.
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
