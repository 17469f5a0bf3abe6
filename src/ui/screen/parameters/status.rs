//! Above the list: its vehicle, the download, and the filters.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::{Action, ParametersAction};
use crate::app::room::parameters::{Other, Row, extra};
use crate::parameters::{Fetching, ParameterSnapshot};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, put};
use crate::vehicle::VehicleId;
use crate::vehicle_id::ranges;

/// The width of the progress bar, in columns.
const BAR: usize = 20;

/// Draws a rule with the vehicle's number and a line with the progress.
pub fn draw(
    state: &State,
    vehicle: VehicleId,
    rows: &[Row<'_>],
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let title = match state.rooms().parameters().comparison() {
        None => text!("parameters-title", vehicle = vehicle),
        Some(comparison) => text!(
            "parameters-title-compared",
            vehicle = vehicle,
            other = named(&comparison.with)
        ),
    };
    let inner = panel.focused(&panel.text(&title), true, buffer);
    let is_lost = state
        .session()
        .vehicles()
        .get(&vehicle)
        .is_some_and(|it| it.link.lost);
    let known = state.rooms().parameters().lists().get(&vehicle);
    let mut spans = progress(state, known, is_lost, panel.look);
    for (text, role) in remarks(state, rows) {
        spans.push(Span::styled("   ", panel.style(Role::Text)));
        spans.push(Span::styled(panel.text(&text), panel.style(role)));
    }
    put(buffer, inner, 0, &Line::from(spans));
}

/// The name of the other side of a comparison.
pub fn named(other: &Other) -> Text {
    match other {
        Other::File { path, .. } => Text::verbatim(path.as_str()),
        Other::Vehicle(id) => text!("parameters-of-vehicle", vehicle = *id),
    }
}

fn progress(
    state: &State,
    known: Option<&ParameterSnapshot>,
    is_lost: bool,
    look: &Look,
) -> Vec<Span<'static>> {
    let (received, count) = known.map_or((0, 0), |known| {
        (known.list.received(), known.list.count().unwrap_or(0))
    });
    let fetching = known.map(|known| known.fetching).unwrap_or_default();
    let (text, role) = match fetching {
        Fetching::Complete => (text!("parameters-complete", count = count), Role::Ok),
        Fetching::Stalled | Fetching::NotAsked | Fetching::UnderWay { .. }
            if state.replay().is_some() =>
        {
            // Values that were not requested have no index.
            let received = known.map_or(0, |known| known.list.len());
            let text = text!("parameters-recorded", received = received, count = count);
            (text, Role::Muted)
        }
        Fetching::Stalled => {
            let text = text!(
                "parameters-stalled",
                received = received,
                count = count,
                key = state.key(Action::Parameters(ParametersAction::FetchParameters))
            );
            (text, Role::Warning)
        }
        Fetching::UnderWay { .. } if is_lost => {
            let text = text!("parameters-link-lost", received = received, count = count);
            (text, Role::Danger)
        }
        Fetching::UnderWay { fruitless } if fruitless > 2 => (
            text!(
                "parameters-repeating",
                received = received,
                count = count,
                tries = fruitless
            ),
            Role::Warning,
        ),
        Fetching::UnderWay { .. } if count > 0 => (
            text!("parameters-coming", received = received, count = count),
            Role::Accent,
        ),
        Fetching::NotAsked | Fetching::UnderWay { .. } => (text!("parameters-asking"), Role::Muted),
    };
    let mut spans = vec![Span::raw(" ")];
    if fetching.is_under_way() && count > 0 {
        spans.extend(bar(usize::from(received), usize::from(count), look));
    }
    spans.push(Span::styled(look.text(&text), look.style(role)));
    spans
}

fn bar(received: usize, count: usize, look: &Look) -> [Span<'static>; 3] {
    let done = BAR * received.min(count) / count.max(1);
    [
        Span::styled("█".repeat(done), look.style(Role::Accent)),
        Span::styled("░".repeat(BAR - done), look.style(Role::Muted)),
        Span::raw(" "),
    ]
}

/// The filters of the list, and the activities under way.
fn remarks(state: &State, rows: &[Row<'_>]) -> Vec<(Text, Role)> {
    let room = state.rooms().parameters();
    let mut remarks = Vec::new();
    if let Some(batch) = room.batch() {
        let left = batch.left();
        remarks.push((text!("parameters-setting", count = left), Role::Warning));
    }
    if let Some(comparison) = room.comparison() {
        let findings = || rows.iter().filter_map(|row| Some((row.name, row.finding?)));
        let is_marked = |(name, finding): &(&str, _)| comparison.is_marked(name, *finding);
        let (count, marked) = (findings().count(), findings().filter(is_marked).count());
        let text = text!("parameters-marked", count = count, marked = marked);
        remarks.push((text, Role::Accent));
        let hidden = extra(state, comparison);
        if !comparison.lists_extra && hidden > 0 {
            remarks.push((text!("parameters-hidden", count = hidden), Role::Muted));
        }
    }
    if !room.filter_text().is_empty() {
        let filter = clip(room.filter_text(), 16);
        let text = text!("parameters-filter", filter = filter, count = rows.len());
        remarks.push((text, Role::Accent));
    }
    if room.shows_changed_only() && room.comparison().is_none() {
        remarks.push((text!("parameters-only-changed"), Role::Accent));
    }
    if room.shows_other_than_default() && room.comparison().is_none() {
        remarks.push((text!("parameters-other-than-default"), Role::Accent));
    }
    if state.session().selection().len() > 1 {
        let vehicles = ranges(state.addressed());
        remarks.push((
            text!("parameters-sets-on", vehicles = vehicles),
            Role::Selected,
        ));
    }
    remarks
}
