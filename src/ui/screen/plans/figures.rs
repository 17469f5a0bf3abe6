//! The figures of a rehearsal: each draft, and each pair of them.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::room::plans::Drawing;
use crate::draft::{TrialFlight, TrialPilot};
use crate::operator::ending_words;
use crate::rehearsal::{Approach, FlightEnding};
use crate::text::{clock, figure};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::length;
use crate::ui::widget::{aligned, put, row_of};

/// Columns of the parts of a line about a draft.
const NAME: usize = 10;
const TIME: usize = 7;
const LEFT: usize = 7;
const FAR: usize = 8;
const FENCE: usize = 7;
/// Columns of the parts of a line about a pair.
const PAIR: usize = 16;
const METRES: usize = 8;
/// The minimum columns of a line that also shows the end of the flight.
const WITH_END: usize = 58;

/// A line of the table.
struct FigureLine {
    text: String,
    role: Role,
}

impl FigureLine {
    fn new(text: String, role: Role) -> Self {
        Self { text, role }
    }
}

/// Draws the headings and the lines from the first one to show.
pub(super) fn draw(room: &Drawing, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some((flight, top)) = room.figures() else {
        return;
    };
    let lines = lines(room, flight, panel);
    let visible = usize::from(panel.area.height);
    let top = top.min(lines.len().saturating_sub(visible));
    for (row, line) in (0..).zip(lines.iter().skip(top).take(visible)) {
        let style = panel.style(line.role);
        let shown = Line::styled(aligned(&line.text, panel.width(), false), style);
        put(buffer, row_of(panel.area, row), 0, &shown);
    }
    panel.mark_list(top, lines.len(), false, buffer);
}

fn lines(room: &Drawing, flight: &TrialFlight, panel: Panel<'_>) -> Vec<FigureLine> {
    let mut lines = vec![FigureLine::new(draft_heading(panel), Role::Muted)];
    for (index, pilot) in flight.pilots.iter().enumerate() {
        lines.extend(of_draft(&room.pilot(index), pilot, panel));
    }
    if flight.closest.is_empty() {
        return lines;
    }
    lines.push(FigureLine::new(pair_heading(panel), Role::Muted));
    lines.extend(flight.closest.iter().map(|pair| of_pair(room, pair)));
    lines
}

fn draft_heading(panel: Panel<'_>) -> String {
    let word = |id, columns, right| aligned(&panel.say(id), columns, right);
    let mut heading = format!(
        "  {}{}{}{}{}",
        word("plans-figures-draft", NAME - 2, false),
        word("plans-figures-time", TIME, true),
        word("plans-figures-left", LEFT, true),
        word("plans-figures-far", FAR, true),
        word("plans-figures-fence", FENCE, true),
    );
    if panel.width() >= WITH_END {
        heading.push_str("  ");
        heading.push_str(&panel.say("plans-figures-end"));
    }
    heading
}

/// The line of a draft; on narrow screens, an end other than a landing has a line of its own.
fn of_draft(name: &str, pilot: &TrialPilot, panel: Panel<'_>) -> Vec<FigureLine> {
    let flown = &pilot.flown;
    let (mark, role) = if flown.is_as_planned() {
        (" ", Role::Text)
    } else {
        ("!", Role::Danger)
    };
    let fence = match flown.broke_fence_s {
        Some(at_s) => format!("!{}", time(at_s)),
        None if flown.has_fence => panel.say("plans-figures-kept"),
        None => "-".to_owned(),
    };
    let line = format!(
        "{mark} {}{}{}{}{}",
        aligned(name, NAME - 2, false),
        aligned(&time(flown.time_s), TIME, true),
        aligned(
            &format!("{} %", figure(100.0 - flown.energy_used_percent, 0)),
            LEFT,
            true
        ),
        aligned(&length(flown.farthest_m.round()), FAR, true),
        aligned(&fence, FENCE, true),
    );
    let end = panel.text(&ending_words(flown.ending));
    if panel.width() >= WITH_END {
        return vec![FigureLine::new(format!("{line}  {end}"), role)];
    }
    let own = (flown.ending != FlightEnding::Landed).then(|| format!("    {end}"));
    std::iter::once(line)
        .chain(own)
        .map(|text| FigureLine::new(text, role))
        .collect()
}

fn pair_heading(panel: Panel<'_>) -> String {
    let word = |id, columns, right| aligned(&panel.say(id), columns, right);
    format!(
        "  {}{}{}{}",
        word("plans-figures-pair", PAIR - 2, false),
        word("plans-figures-at", TIME, true),
        word("plans-figures-apart", METRES, true),
        word("plans-figures-height", METRES, true),
    )
}

fn of_pair(room: &Drawing, pair: &Approach) -> FigureLine {
    let (mark, role) = if pair.is_conflict() {
        ("!", Role::Danger)
    } else {
        (" ", Role::Text)
    };
    let names = format!("{} + {}", room.pilot(pair.a), room.pilot(pair.b));
    let metres = |metres| aligned(&format!("{} m", figure(metres, 1)), METRES, true);
    let text = format!(
        "{mark} {}{}{}{}",
        aligned(&names, PAIR - 2, false),
        aligned(&time(pair.at_s), TIME, true),
        metres(pair.horizontal_m),
        metres(pair.vertical_m),
    );
    FigureLine::new(text, role)
}

fn time(seconds: f64) -> String {
    clock(Duration::from_secs_f64(seconds.max(0.0)))
}
