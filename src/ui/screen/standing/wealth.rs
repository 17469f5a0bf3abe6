//! Credits and experience, entry by entry.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use super::StandingSubject;
use crate::app::room::standing::Pane;
use crate::campaign::Wealth;
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::curve::{self, Curve};
use crate::ui::widget::{below, columns, put, upper};

/// The width of the figures beside a curve, in columns.
const FIGURES: u16 = 10;
/// The minimum width for curves side by side.
const WIDE: u16 = 120;

/// Draws both curves, one below the other or side by side.
pub(super) fn draw(subject: &StandingSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let look = subject.look;
    let wealth = subject.career.growth.wealth();
    let credits: Vec<f64> = wealth.iter().map(|it| f64::from(it.credits)).collect();
    let experience: Vec<f64> = wealth.iter().map(experience).collect();
    let inner = subject.pane(Pane::Wealth, &look.say("standing-wealth"), area, buffer);
    if wealth.is_empty() {
        let text = look.say("standing-wealth-nothing");
        put(
            buffer,
            inner,
            0,
            &Line::styled(text, look.style(Role::Muted)),
        );
        return;
    }
    let (first, second) = if inner.width >= WIDE {
        let half = inner.width / 2;
        (
            columns(inner, 0, half.saturating_sub(1)),
            columns(inner, half + 1, inner.width),
        )
    } else {
        let half = inner.height / 2;
        (upper(inner, half), below(inner, half))
    };
    draw_curve(subject, "standing-curve-credits", &credits, first, buffer);
    draw_curve(
        subject,
        "standing-curve-experience",
        &experience,
        second,
        buffer,
    );
}

fn experience(wealth: &Wealth) -> f64 {
    wealth.experience as f64
}

fn draw_curve(
    subject: &StandingSubject<'_>,
    title: &'static str,
    values: &[f64],
    area: Rect,
    buffer: &mut Buffer,
) {
    let look = subject.look;
    let now = values.last().copied().unwrap_or_default();
    let title = text!(
        "standing-curve",
        what = look.say(title),
        now = format!("{now:.0}")
    );
    let inner = Panel::new(look, area).titled(&look.text(&title), buffer);
    let high = values.iter().copied().fold(1.0, f64::max);
    let plot = columns(inner, FIGURES, inner.width);
    let steps = curve::steps(plot.width, look.symbols);
    // Each entry gets an equal share of the columns; with more entries than columns, the last one of a column counts.
    let spread: Vec<Option<f64>> = (0..steps)
        .map(|step| {
            let at = ((step + 1) * values.len()).div_ceil(steps.max(1));
            values.get(at.saturating_sub(1)).copied()
        })
        .collect();
    let curve = Curve {
        values: &spread,
        low: 0.0,
        high,
        style: look.style(Role::Accent),
    };
    curve::draw(&curve, look.symbols, plot, buffer);
    for (row, figure) in [(0, high), (inner.height.saturating_sub(1), 0.0)] {
        let figure = format!("{figure:>8.0} ");
        put(
            buffer,
            inner,
            row,
            &Line::styled(figure, look.style(Role::Muted)),
        );
    }
}
