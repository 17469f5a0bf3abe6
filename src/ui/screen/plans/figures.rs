//! The figures of a rehearsal: each draft, and each pair of them.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::room::plans::Drawing;
use crate::draft::{TrialFlight, TrialPilot};
use crate::operator::ending_words;
use crate::rehearsal::{Approach, FlightEnding};
use crate::text::{clock, figure, rounded};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::length;
use crate::ui::widget::{aligned, put, row_of, told_apart};

/// Columns of the parts of a line about a draft.
const TIME: usize = 7;
const LEFT: usize = 7;
const FAR: usize = 8;
const FENCE: usize = 7;
/// Columns of a distance of a pair.
const METRES: usize = 7;
/// The minimum columns of a line that also shows the end of the flight.
const WITH_END: usize = 58;
/// The text between the names of a pair.
const AND: &str = " + ";

/// The columns of names.
#[derive(Debug, Clone, Copy)]
struct NameColumns {
    draft: usize,
    /// Each name of a pair.
    of_pair: usize,
}

impl NameColumns {
    /// By the minimum columns of the panel.
    const WIDTHS: &'static [(usize, Self)] = &[
        (90, Self::new(24, 24)),
        (WITH_END, Self::new(8, 15)),
        (0, Self::new(8, 6)),
    ];

    const fn new(draft: usize, of_pair: usize) -> Self {
        Self { draft, of_pair }
    }

    fn within(columns: usize) -> Self {
        let mut widths = Self::WIDTHS.iter();
        let fitting = widths.find(|(least, _)| columns >= *least);
        fitting.map_or(Self::new(0, 0), |(_, columns)| *columns)
    }

    fn pair(self) -> usize {
        2 * self.of_pair + AND.len()
    }
}

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
    let columns = NameColumns::within(panel.width());
    let names = room.pilots();
    let mut lines = vec![FigureLine::new(draft_heading(columns, panel), Role::Muted)];
    let shown = told_apart(&names, columns.draft);
    for (name, pilot) in shown.iter().zip(&flight.pilots) {
        let name = aligned(name, columns.draft, false);
        lines.extend(of_draft(&name, pilot, panel));
    }
    if flight.closest.is_empty() {
        return lines;
    }
    lines.push(FigureLine::new(pair_heading(columns, panel), Role::Muted));
    let shown = told_apart(&names, columns.of_pair);
    let pairs = flight.closest.iter().map(|pair| {
        let name = |at: usize| shown.get(at).map_or("", String::as_str);
        let names = format!("{}{AND}{}", name(pair.a), name(pair.b));
        of_pair(&aligned(&names, columns.pair(), false), pair)
    });
    lines.extend(pairs);
    lines
}

fn draft_heading(columns: NameColumns, panel: Panel<'_>) -> String {
    let word = |id, columns, right| aligned(&panel.say(id), columns, right);
    let mut heading = format!(
        "  {}{}{}{}{}",
        word("plans-figures-draft", columns.draft, false),
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
        "{mark} {name}{}{}{}{}",
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

fn pair_heading(columns: NameColumns, panel: Panel<'_>) -> String {
    let word = |id, columns, right| aligned(&panel.say(id), columns, right);
    format!(
        "  {}{}{}{}",
        word("plans-figures-pair", columns.pair(), false),
        word("plans-figures-at", TIME, true),
        word("plans-figures-apart", METRES, true),
        word("plans-figures-height", METRES, true),
    )
}

fn of_pair(names: &str, pair: &Approach) -> FigureLine {
    let (mark, role) = if pair.is_conflict() {
        ("!", Role::Danger)
    } else {
        (" ", Role::Text)
    };
    let metres = |metres: f64| aligned(&length(rounded(metres, 1)), METRES, true);
    let text = format!(
        "{mark} {names}{}{}{}",
        aligned(&time(pair.at_s), TIME, true),
        metres(pair.horizontal_m),
        metres(pair.vertical_m),
    );
    FigureLine::new(text, role)
}

fn time(seconds: f64) -> String {
    clock(Duration::from_secs_f64(seconds.max(0.0)))
}
