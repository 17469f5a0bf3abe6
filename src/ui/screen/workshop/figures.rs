//! The design's figures, and how the part under the cursor would change them.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::change;
use crate::app::State;
use crate::app::room::workshop::Pane;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, put};
use crate::workshop::{Measure, Sheet};

/// The widths of the values and of a change, in columns.
const VALUES: usize = 15;
const CHANGE: usize = 8;

/// Draws a line for each measure.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    if panel.area.height == 0 {
        return;
    }
    let room = state.rooms().workshop();
    let candidate = room
        .bench()
        .candidate()
        .filter(|_| room.pane() == Pane::Parts)
        .map(|candidate| &candidate.sheet);
    let title = match candidate {
        Some(_) => "bench-figures-change",
        None => "workshop-figures",
    };
    let inner = panel.titled(&panel.say(title), buffer);
    let fits = room
        .bench()
        .candidate()
        .is_none_or(|it| it.misfit.is_none());
    for (row, measure) in Measure::ALL.into_iter().enumerate() {
        let mut line = line(measure, room.bench().sheet(), candidate, panel.at(inner));
        // A gain is not shown for a part that cannot be used.
        if let Some(change) = line
            .spans
            .last_mut()
            .filter(|_| !fits && candidate.is_some())
        {
            change.style = panel.style(Role::Muted);
        }
        put(buffer, inner, row as u16, &line);
    }
}

/// A line with name, value, and the change to another sheet.
fn line(measure: Measure, now: &Sheet, then: Option<&Sheet>, panel: Panel<'_>) -> Line<'static> {
    let before = measure.of(now);
    let after = then.map(|sheet| measure.of(sheet));
    let changed = before
        .zip(after.flatten())
        .and_then(|(before, after)| change(measure, before, after));
    let value = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |it| measure.figure(it));
    let figures = match after {
        Some(after) if changed.is_some() || before.is_some() != after.is_some() => {
            format!("{} → {}", value(before), value(after))
        }
        _ => value(before),
    };
    let values = if before.or(after.flatten()).is_some() {
        format!("{figures} {}", measure.unit())
    } else {
        figures
    };
    let (change, role) = changed.unwrap_or_else(|| (String::new(), Role::Text));
    let beside = if then.is_some() { CHANGE + 1 } else { 0 };
    let name = aligned(
        &panel.text(&measure.name()),
        panel.width().saturating_sub(VALUES + beside + 1),
        false,
    );
    Line::from(vec![
        Span::styled(format!(" {name}"), panel.style(Role::Muted)),
        Span::raw(aligned(values.trim_end(), VALUES, true)),
        Span::styled(
            format!(" {}", aligned(&change, CHANGE, true)),
            panel.style(role),
        ),
    ])
}
