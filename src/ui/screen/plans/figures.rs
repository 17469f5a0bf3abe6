//! The figures of a rehearsal: for each draft, and for each pair of drafts.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::room::plans::{Drawing, FIGURES_WITH_END, FigureRow};
use crate::draft::{TrialFlight, TrialPilot};
use crate::operator::ending_words;
use crate::rehearsal::Approach;
use crate::text::{clock_s, figure, rounded};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::length;
use crate::ui::widget::{aligned, put, row_of, told_apart};

/// The widths of the parts of a line about a draft, in columns.
const TIME: usize = 7;
const LEFT: usize = 7;
const FAR: usize = 8;
const FENCE: usize = 7;
/// The width of a distance of a pair, in columns.
const METRES: usize = 7;
const AND: &str = " + ";

/// The widths of names, in columns.
#[derive(Debug, Clone, Copy)]
struct NameColumns {
    draft: usize,
    /// The width of each name of a pair.
    of_pair: usize,
}

impl NameColumns {
    /// The widths by the minimum number of columns of the panel.
    const WIDTHS: &'static [(usize, Self)] = &[
        (90, Self::new(24, 24)),
        (FIGURES_WITH_END, Self::new(8, 15)),
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

struct FigureLine {
    text: String,
    role: Role,
}

impl FigureLine {
    fn new(text: String, role: Role) -> Self {
        Self { text, role }
    }
}

/// Draws the headings, and the lines from the first visible one on.
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
    let drafts = told_apart(&names, columns.draft);
    let in_pairs = told_apart(&names, columns.of_pair);
    let in_pair = |at: usize| in_pairs.get(at).map_or("", String::as_str);
    let line = |row| match row {
        FigureRow::DraftHeading => FigureLine::new(draft_heading(columns, panel), Role::Muted),
        FigureRow::Draft(at) => {
            let name = aligned(&drafts[at], columns.draft, false);
            of_draft(&name, &flight.pilots[at], panel)
        }
        FigureRow::End(at) => {
            let pilot = &flight.pilots[at];
            FigureLine::new(format!("    {}", end(pilot, panel)), of_flight(pilot).1)
        }
        FigureRow::PairHeading => FigureLine::new(pair_heading(columns, panel), Role::Muted),
        FigureRow::Pair(at) => {
            let pair = &flight.closest[at];
            let names = format!("{}{AND}{}", in_pair(pair.a), in_pair(pair.b));
            of_pair(&aligned(&names, columns.pair(), false), pair)
        }
    };
    let rows = FigureRow::of(flight, panel.width()).into_iter();
    rows.map(line).collect()
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
    if panel.width() >= FIGURES_WITH_END {
        heading.push_str("  ");
        heading.push_str(&panel.say("plans-figures-end"));
    }
    heading
}

fn of_flight(pilot: &TrialPilot) -> (&'static str, Role) {
    if pilot.flown.is_as_planned() {
        (" ", Role::Text)
    } else {
        ("!", Role::Danger)
    }
}

fn end(pilot: &TrialPilot, panel: Panel<'_>) -> String {
    panel.text(&ending_words(pilot.flown.ending))
}

fn of_draft(name: &str, pilot: &TrialPilot, panel: Panel<'_>) -> FigureLine {
    let flown = &pilot.flown;
    let (mark, role) = of_flight(pilot);
    let fence = match flown.broke_fence_s {
        Some(at_s) => format!("!{}", clock_s(at_s)),
        None if flown.has_fence => panel.say("plans-figures-kept"),
        None => "-".to_owned(),
    };
    let mut line = format!(
        "{mark} {name}{}{}{}{}",
        aligned(&clock_s(flown.time_s), TIME, true),
        aligned(
            &format!("{} %", figure(100.0 - flown.energy_used_percent, 0)),
            LEFT,
            true
        ),
        aligned(&length(flown.farthest_m.round()), FAR, true),
        aligned(&fence, FENCE, true),
    );
    if panel.width() >= FIGURES_WITH_END {
        line.push_str("  ");
        line.push_str(&end(pilot, panel));
    }
    FigureLine::new(line, role)
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
        aligned(&clock_s(pair.at_s), TIME, true),
        metres(pair.horizontal_m),
        metres(pair.vertical_m),
    );
    FigureLine::new(text, role)
}
