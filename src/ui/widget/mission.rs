//! The mission pane: objectives, sensors, advice and the surveyed cells.

mod cells;
mod hint;

pub use hint::{hint_height, hint_lines, lesson};

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr as _;

use crate::app::State;
use crate::commands::Goal;
use crate::mission::{ObjectiveProgress, ObjectiveState, Progress, Trust};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, clip, clock, put, upper, wrap};

use cells::Grid;
use hint::draw_hint;

/// The blanks between the name of an objective and its state.
const BETWEEN: &str = "  ";
/// The number of columns between two readings.
const GAP: usize = 3;

/// The preferred height of the pane, in rows.
pub fn height(progress: &Progress, width: u16, look: &Look) -> u16 {
    let grid = Grid::of(&progress.cells).map_or(0, |grid| grid.rows());
    let hint = hint_lines(progress, usize::from(width), look).len();
    let readings = readings(progress, usize::from(width), look).len();
    let objectives =
        objective_lines(&progress.objectives, objectives_width(width), true, look).len();
    let counts = count_lines(progress, usize::from(width), look).len();
    (1 + objectives + readings + counts + grid + hint) as u16
}

/// The columns for the objectives; one is left, so that no state touches the pane beside it.
fn objectives_width(width: u16) -> usize {
    usize::from(width.saturating_sub(1))
}

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(progress) = state.session().mission() else {
        return;
    };
    let score = progress.score_so_far;
    let title = text!(
        "mission-pane",
        elapsed = clock(progress.elapsed),
        limit = clock(progress.limit),
        score = score.map_or("-".to_owned(), |score| score.to_string())
    );
    let mut rest = panel.titled(&panel.text(&title), buffer);
    let width = usize::from(rest.width);
    let is_roomy = panel.area.height >= height(progress, panel.area.width, panel.look);
    let objectives = objective_lines(
        &progress.objectives,
        objectives_width(rest.width),
        is_roomy,
        panel.look,
    )
    .into_iter();
    let readings = readings(progress, width, panel.look);
    let counts = count_lines(progress, width, panel.look);
    let hint = hint_lines(progress, width, panel.look);
    let lines: Vec<Line<'_>> = objectives.chain(readings).chain(counts).collect();
    // The hint comes first: it is shown only here, and the room of the mission shows the rest.
    let most = rest.height.saturating_sub(hint.len() as u16);
    let shown = upper(rest, most.min(lines.len() as u16));
    for (row, line) in (0..shown.height).zip(&lines) {
        put(buffer, shown, row, line);
    }
    panel.at(shown).mark_scroll(0, lines.len(), buffer);
    rest = below(rest, shown.height);
    if let Some(grid) = Grid::of(&progress.cells) {
        // The map also shows the cells.
        let rows = grid.rows() as u16;
        let free = upper(rest, rest.height.saturating_sub(hint.len() as u16));
        grid.draw(state, panel.at(upper(free, rows)), buffer);
        rest = below(rest, rows.min(free.height));
    }
    draw_hint(hint, panel.at(rest), buffer);
}

/// The next objective that is still open, and its result so far, on one line; `None` once the mission is over.
pub fn next_objective(state: &State) -> Option<Text> {
    let progress = state.session().mission()?;
    let mut objectives = progress.objectives.iter();
    let open = objectives.find(|it| it.state == ObjectiveState::Open)?;
    let (title, detail) = (&open.title, &open.detail);
    (!state.session().is_over()).then(|| text!("map-objective", title = title, detail = detail))
}

/// Contacts, reports, prediction and goal, wrapped.
fn count_lines(progress: &Progress, width: usize, look: &Look) -> Vec<Line<'static>> {
    let rows = counts(progress).into_iter();
    let rows = rows.flat_map(|text| wrap(&look.text(&text), width));
    rows.map(|row| Line::styled(row, look.style(Role::Muted)))
        .collect()
}

/// Contacts, reports, prediction and goal: a text for each that exists.
fn counts(progress: &Progress) -> Vec<Text> {
    let trusted = |trust| {
        let contacts = progress.contacts.iter();
        contacts.filter(|contact| contact.trust == trust).count()
    };
    let contacts = (!progress.contacts.is_empty()).then(|| {
        let (count, reported) = (progress.contacts.len(), trusted(Trust::Reported));
        if progress.can_confirm {
            text!(
                "mission-contacts-confirmed",
                count = count,
                confirmed = trusted(Trust::Confirmed),
                reported = reported
            )
        } else {
            text!("mission-contacts-count", count = count, reported = reported)
        }
    });
    let marks = (!progress.marks.is_empty())
        .then(|| text!("mission-marks-count", count = progress.marks.len()));
    let pledge = progress.pledge;
    let score = pledge.prediction;
    let words: Vec<Text> = score
        .map(|points| text!("mission-said-score", points = points))
        .into_iter()
        .chain(pledge.goal.map(Goal::title))
        .collect();
    let said = (!words.is_empty())
        .then(|| text!("mission-pledge-line", words = Text::joined(", ", words)));
    contacts.into_iter().chain(marks).chain(said).collect()
}

/// A line for each objective. If name and result do not fit on it, the result of a met objective is left out. Any other
/// result is placed below its name if there are rows; otherwise the name is cut.
fn objective_lines(
    objectives: &[ObjectiveProgress],
    width: usize,
    is_roomy: bool,
    look: &Look,
) -> Vec<Line<'static>> {
    let mut lines = Vec::new();
    for objective in objectives {
        let (mark, role) = match objective.state {
            ObjectiveState::Open => ("[ ]", Role::Text),
            ObjectiveState::Met => ("[x]", Role::Ok),
            ObjectiveState::Missed => ("[!]", Role::Danger),
        };
        let title = format!("{mark} {}", look.text(&objective.title));
        let detail = look.text(&objective.detail);
        let left = |room| Span::styled(aligned(&title, room, false), look.style(role));
        let right = |room| Span::styled(clip(&detail, room), look.style(Role::Muted));
        let room = width.saturating_sub(detail.width() + BETWEEN.len());
        if title.width() <= room {
            lines.push(Line::from(vec![left(room), BETWEEN.into(), right(width)]));
        } else if objective.state == ObjectiveState::Met {
            lines.push(Line::from(left(width)));
        } else if is_roomy {
            let below = " ".repeat(width.saturating_sub(detail.width()));
            lines.push(Line::from(left(width)));
            lines.push(Line::from(vec![below.into(), right(width)]));
        } else {
            // However long the state is, two fifths of the line are left for the name.
            let room = room.max(width * 2 / 5);
            let rest = width.saturating_sub(room + BETWEEN.len());
            lines.push(Line::from(vec![left(room), BETWEEN.into(), right(rest)]));
        }
    }
    lines
}

/// The sensors' readings and the loads left, as many per line as fit.
fn readings(progress: &Progress, width: usize, look: &Look) -> Vec<Line<'static>> {
    let shown = progress.readings.iter().map(|it| {
        let value = format!("{} {}", amount(it.value), it.unit);
        (it.vehicle, &it.sensor, value)
    });
    let left = progress.loads.iter().map(|it| {
        let value = format!("{} {}", it.left, it.unit);
        (it.vehicle, &it.load, value)
    });
    let mut lines: Vec<Line<'static>> = Vec::new();
    for (vehicle, name, value) in shown.chain(left) {
        let label = format!("{vehicle} {} ", look.text(name));
        let value = value.trim_end().to_owned();
        let wide = label.width() + value.width();
        match lines.last_mut() {
            Some(line) if line.width() + GAP + wide <= width => {
                line.push_span(" ".repeat(GAP));
            }
            _ => lines.push(Line::default()),
        }
        if let Some(line) = lines.last_mut() {
            line.push_span(Span::styled(label, look.style(Role::Muted)));
            line.push_span(value);
        }
    }
    lines
}

/// A value with a suitable number of decimals.
fn amount(value: f64) -> String {
    let decimals = match value.abs() {
        size if size >= 100.0 => 0,
        size if size >= 10.0 => 1,
        _ => 2,
    };
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::commands::{Deed, Spot, Subject};
    use crate::ledger::EntryId;
    use crate::mission::{Flight, Mission};
    use crate::text::{Language, Locale};

    #[test]
    fn a_long_state_leaves_room_for_the_name_of_its_objective() {
        let objective = ObjectiveProgress {
            title: Text::verbatim("distance to the wire kept"),
            state: ObjectiveState::Open,
            detail: Text::verbatim("12 % of 14 s, too close for 0 s"),
            fraction: 0.0,
        };
        let lines = objective_lines(&[objective], 40, false, &Look::default());
        let shown: Vec<String> = lines.iter().map(ToString::to_string).collect();
        assert_eq!(shown, ["[ ] distance to…  12 % of 14 s, too clo…"]);
    }

    /// The rows of the shipped missions' objectives, as the pane of *Fly* shows them on 80 columns, that are cut.
    fn cut_rows(language: Language) -> Vec<String> {
        let look = Look {
            locale: Arc::new(Locale::new(language)),
            ..Look::default()
        };
        let mut cut = Vec::new();
        for number in ["00", "01", "02", "03", "04", "05"] {
            let mission = mission(number);
            let mut flight = Flight::new(Arc::new(mission), 1);
            for reports in 0..2 {
                let lines = objective_lines(&flight.progress().objectives, 39, false, &look);
                let shown = lines.iter().map(ToString::to_string);
                let is_cut = |row: &String| row.contains('…');
                cut.extend(
                    shown
                        .filter(is_cut)
                        .map(|row| format!("{number}, {reports}: {row}")),
                );
                let subject = Subject::Spot(Spot::Offset {
                    north_m: 50.0,
                    east_m: 0.0,
                });
                let mark = Deed::Mark {
                    subject,
                    kind: None,
                };
                flight.act(EntryId(0), &mark, &[1]);
            }
        }
        cut
    }

    fn mission(number: &str) -> Mission {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/missions");
        let files = std::fs::read_dir(folder).expect("it is there");
        let mut paths = files.map(|file| file.expect("a file").path());
        let is_it = |path: &std::path::PathBuf| {
            let name = path.file_name().and_then(|name| name.to_str());
            name.is_some_and(|name| name.starts_with(&format!("{number}-")))
        };
        let path = paths.find(is_it).expect("it is shipped");
        let text = std::fs::read_to_string(path).expect("it can be read");
        Mission::parse(&text).expect("it is good")
    }

    #[test]
    fn the_objectives_of_the_first_missions_fit_their_rows() {
        let mut cut = cut_rows(Language::English);
        cut.extend(cut_rows(Language::Ukrainian));
        assert!(cut.is_empty(), "{cut:#?}");
    }
}
