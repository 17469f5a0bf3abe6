//! The class: a row per seat, and what happened lately at the seat under the cursor.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::state::SeatPlace;
use crate::class::{Danger, DangerKind, Desk, FlightReport, Need, Presence, SeatRecord, Stage};
use crate::class_text::seat_text;
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, put, row_of, short_clock, width, wrap};

mod detail;
mod exam;
mod grading;
mod lesson;
mod results;
mod watch;

/// The columns before the first column of the board: the cursor, the mark and a blank.
const MARKS: usize = 3;
/// The least height of the part about one seat.
const DETAIL: u16 = 6;
/// The width from which all columns fit.
const WIDE: u16 = 110;
/// The width from which all columns fit beside that of the lessons.
const WIDEST: u16 = 140;
/// How long a connected seat may be silent before the board says so.
const SILENT: Duration = Duration::from_secs(3);

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    match state.class_role().desk() {
        Some(desk) => draw_desk(state, desk, panel, buffer),
        None => draw_seat(state, panel, buffer),
    }
}

/// Draws the trainee's place, or that there is no class.
fn draw_seat(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.titled(&panel.say("room-class"), buffer);
    let seat = state.class_role().seat().map(SeatPlace::seat);
    let text = panel.text(&seat_text(seat));
    for (row, line) in (0..).zip(wrap(&text, usize::from(inner.width))) {
        put(
            buffer,
            inner,
            row,
            &Line::styled(line, panel.style(Role::Text)),
        );
    }
}

fn draw_desk(state: &State, desk: &Desk, panel: Panel<'_>, buffer: &mut Buffer) {
    let watched = desk.watched().and_then(|seat| desk.seats().get(seat));
    if let Some(seat) = watched {
        watch::draw(state, seat, panel, buffer);
        return;
    }
    if let Some(page) = state.rooms().class().grading() {
        grading::draw(page, panel, buffer);
        return;
    }
    if let Some(page) = state.rooms().class().page() {
        results::draw(state, desk, page, panel, buffer);
        return;
    }
    let board = desk.board();
    let most = panel.area.height.saturating_sub(DETAIL);
    let rows = (board.len().max(1) as u16 + 2).min(most);
    draw_board(state, desk, &board, panel.upper(rows), buffer);
    let cursor = state.rooms().class().cursor();
    if let Some(seat) = cursor.and_then(|seat| desk.seats().get(seat)) {
        let below = panel.below(rows);
        if state.rooms().class().lessons().is_shown() {
            lesson::draw(state, seat, below, buffer);
        } else if state.rooms().class().shows_injects() {
            detail::draw_injects(seat, below, buffer);
        } else {
            detail::draw(seat, below, buffer);
        }
    }
}

fn draw_board(state: &State, desk: &Desk, board: &[usize], panel: Panel<'_>, buffer: &mut Buffer) {
    let here = desk.seats().iter().filter(|seat| seat.is_here()).count();
    let room = state.rooms().class();
    let title = text!(
        "class-title",
        class = desk.class().as_str(),
        here = here,
        count = board.len(),
        marked = room.marked()
    );
    let inner = panel.focused(&panel.text(&title), true, buffer);
    let columns = BoardColumn::fitting(inner.width, exam::column(desk));
    put(buffer, inner, 0, &heading(&columns, panel));
    let inner = below(inner, 1);
    if board.is_empty() {
        let text = panel.text(&text!("class-empty", class = desk.class().as_str()));
        for (row, line) in (0..).zip(wrap(&text, usize::from(inner.width))) {
            put(
                buffer,
                inner,
                row,
                &Line::styled(line, panel.style(Role::Muted)),
            );
        }
        return;
    }
    let height = usize::from(inner.height);
    let cursor = board.iter().position(|&seat| Some(seat) == room.cursor());
    let first = cursor
        .unwrap_or_default()
        .saturating_sub(height / 2)
        .min(board.len().saturating_sub(height));
    let shown = board.iter().enumerate().skip(first).take(height);
    for (row, (at, &seat)) in (0..).zip(shown) {
        let place = row_of(inner, row);
        let view = SeatLineView {
            desk,
            seat: &desk.seats()[seat],
            now: state.wall(),
            look: panel.look,
        };
        let marks = [
            if Some(at) == cursor { ">" } else { " " },
            if room.is_marked(seat) { "*" } else { " " },
        ];
        put(buffer, place, 0, &view.line(&columns, marks));
        if Some(at) == cursor {
            panel.at(place).mark_cursor(buffer);
        }
    }
    panel.at(inner).mark_list(first, board.len(), true, buffer);
}

/// A column of the board.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum BoardColumn {
    Seat,
    State,
    Mission,
    Clock,
    Score,
    Objectives,
    Air,
    Alerts,
    Separation,
    Failures,
    Workload,
    Lesson,
    Exam,
    Command,
}

impl BoardColumn {
    const NARROW: &[(Self, usize)] = &[
        (Self::Seat, 10),
        (Self::State, 16),
        (Self::Mission, 11),
        (Self::Clock, 5),
        (Self::Score, 5),
        (Self::Objectives, 4),
        (Self::Air, 4),
        (Self::Command, 13),
    ];
    const WIDE: &[(Self, usize)] = &[
        (Self::Seat, 14),
        (Self::State, 17),
        (Self::Mission, 13),
        (Self::Clock, 5),
        (Self::Score, 5),
        (Self::Objectives, 4),
        (Self::Air, 5),
        (Self::Alerts, 8),
        (Self::Separation, 5),
        (Self::Failures, 5),
        (Self::Workload, 5),
        (Self::Command, 18),
    ];

    /// The column of lessons.
    const LESSON: (Self, usize) = (Self::Lesson, 16);

    /// The column of an exam.
    const EXAM: (Self, usize) = (Self::Exam, 16);

    /// The columns with their widths; the last one takes the rest of the row. While there are lessons or an exam,
    /// others give way to their column, unless all fit.
    fn fitting(columns: u16, of_course: Option<(Self, usize)>) -> Vec<(Self, usize)> {
        let known = if columns >= WIDE {
            Self::WIDE
        } else {
            Self::NARROW
        };
        let mut fitting = known.to_vec();
        if let Some(of_course) = of_course {
            fitting.retain(|(column, _)| columns >= WIDEST || !column.gives_way(columns));
            let last = fitting.len();
            let at = last - usize::from(columns >= WIDE);
            fitting.insert(at, of_course);
        }
        let used: usize = fitting.iter().map(|(_, width)| width + 1).sum();
        if let Some((_, last)) = fitting.last_mut() {
            *last += usize::from(columns).saturating_sub(used + MARKS);
        }
        fitting
    }

    /// Whether the column gives way to that of the lessons.
    fn gives_way(self, columns: u16) -> bool {
        match self {
            Self::Separation | Self::Failures | Self::Workload => columns >= WIDE,
            Self::Command => columns < WIDE,
            _ => false,
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Seat => "class-column-seat",
            Self::State => "class-column-state",
            Self::Mission => "class-column-mission",
            Self::Clock => "class-column-clock",
            Self::Score => "class-column-score",
            Self::Objectives => "class-column-objectives",
            Self::Air => "class-column-air",
            Self::Alerts => "class-column-alerts",
            Self::Separation => "class-column-separation",
            Self::Failures => "class-column-failures",
            Self::Workload => "class-column-workload",
            Self::Lesson => "class-column-lesson",
            Self::Exam => "class-column-exam",
            Self::Command => "class-column-command",
        }
    }

    /// Whether the column has figures.
    fn is_right(self) -> bool {
        !matches!(
            self,
            Self::Seat | Self::State | Self::Mission | Self::Lesson | Self::Exam | Self::Command
        )
    }
}

fn heading(columns: &[(BoardColumn, usize)], panel: Panel<'_>) -> Line<'static> {
    let titles = columns.iter().map(|&(column, width)| {
        let title = panel.say(column.title());
        aligned(&title, width, column.is_right()) + " "
    });
    let text = format!("   {}", titles.collect::<String>());
    Line::styled(text, panel.style(Role::Muted))
}

/// A seat as it is drawn.
struct SeatLineView<'a> {
    desk: &'a Desk,
    seat: &'a SeatRecord,
    now: Duration,
    look: &'a Look,
}

impl SeatLineView<'_> {
    fn line(&self, columns: &[(BoardColumn, usize)], [cursor, mark]: [&str; 2]) -> Line<'static> {
        let base = if self.seat.is_here() {
            Role::Text
        } else {
            Role::Muted
        };
        let mut line = Line::from(vec![
            Span::raw(cursor.to_owned()),
            Span::styled(format!("{mark} "), self.look.style(Role::Selected)),
        ]);
        for &(column, columns) in columns {
            let (text, role) = match column {
                BoardColumn::State => self.state(),
                BoardColumn::Lesson => lesson::cell(self.seat, base),
                BoardColumn::Exam => exam::cell(self, base),
                _ => (self.cell(column, columns), base),
            };
            let text = aligned(&text, columns, column.is_right());
            line.push_span(Span::styled(text, self.look.style(role)));
            line.push_span(" ");
        }
        line
    }

    fn flight(&self) -> Option<&FlightReport> {
        self.seat.report.as_ref()?.flight.as_ref()
    }

    fn say(&self, text: &Text) -> String {
        self.look.text(text)
    }

    /// Why the seat needs the instructor, otherwise what it does.
    fn state(&self) -> (String, Role) {
        if let Presence::Gone(since) = self.seat.presence {
            let time = age(self.now.saturating_sub(since).as_secs_f64());
            return (self.say(&text!("class-gone", time = time)), Role::Muted);
        }
        let silent = self.now.saturating_sub(self.seat.heard_at);
        if silent >= SILENT {
            let time = age(silent.as_secs_f64());
            return (self.say(&text!("class-silent", time = time)), Role::Warning);
        }
        let Some(flight) = self.flight() else {
            return (self.look.say("class-home"), Role::Muted);
        };
        let need = self.seat.attention.need();
        match (need, need_text(need, flight)) {
            (Need::Danger, Some(text)) => (self.say(&text), Role::Alert),
            (Need::Alert, Some(text)) => (self.say(&text), Role::Danger),
            (Need::Stuck, Some(text)) => (self.say(&text), Role::Warning),
            _ => self.stage(flight),
        }
    }

    fn stage(&self, flight: &FlightReport) -> (String, Role) {
        let (id, role) = match flight.stage {
            Stage::Reading => ("class-reading", Role::Muted),
            Stage::Flying if flight.exam => ("class-exam", Role::Ok),
            Stage::Flying => ("class-flying", Role::Ok),
            Stage::Paused => ("class-paused", Role::Muted),
            Stage::Frozen => ("class-frozen-short", Role::Accent),
            Stage::Over => ("class-over", Role::Muted),
        };
        (self.look.say(id), role)
    }

    fn cell(&self, column: BoardColumn, columns: usize) -> String {
        if column == BoardColumn::Seat {
            return self.name(columns);
        }
        let Some(flight) = self.flight() else {
            return String::new();
        };
        let whole = |value: Option<f64>| value.map_or_else(dash, |it| format!("{it:.0}"));
        match column {
            BoardColumn::Seat | BoardColumn::State | BoardColumn::Lesson | BoardColumn::Exam => {
                String::new()
            }
            BoardColumn::Mission => match &flight.mission {
                Some(mission) => short_mission(mission.as_str(), columns),
                None => self.look.say("class-free"),
            },
            BoardColumn::Clock => short_clock(seconds(flight.clock_s)),
            BoardColumn::Score => whole(flight.score.map(f64::from)),
            BoardColumn::Objectives => format!("{}/{}", flight.objectives_done, flight.objectives),
            BoardColumn::Air => format!("{}/{}", flight.airborne, flight.vehicles),
            BoardColumn::Alerts => match flight.oldest_alert_s {
                Some(oldest_s) => format!("{} {}", flight.alerts, age(oldest_s)),
                None => dash(),
            },
            BoardColumn::Separation => match flight.least_separation_m {
                Some(metres) if metres < 100.0 => format!("{metres:.1}"),
                Some(metres) => format!("{metres:.0}"),
                None => dash(),
            },
            BoardColumn::Failures => flight.failures.to_string(),
            BoardColumn::Workload => whole(flight.workload_percent.map(f64::from)),
            BoardColumn::Command => last_command(flight, columns),
        }
    }

    /// The name of the seat, and that of the trainee if there is room.
    fn name(&self, columns: usize) -> String {
        let trainee = self.seat.report.as_ref().map(|it| it.trainee.as_str());
        let trainee = trainee.filter(|it| !it.is_empty() && *it != self.seat.name);
        let both = trainee.map(|trainee| format!("{} {trainee}", self.seat.name));
        let name = self.seat.name.clone();
        both.filter(|both| width(both) <= columns).unwrap_or(name)
    }
}

/// As many of a mission's words as fit, such as `14-combined` of `14-combined-final`: its number comes first.
fn short_mission(mission: &str, columns: usize) -> String {
    let ends = mission.rmatch_indices('-').map(|(at, _)| at);
    let words = [mission.len()].into_iter().chain(ends);
    let mut words = words.map(|end| &mission[..end]);
    let fitting = words.find(|words| !words.is_empty() && width(words) <= columns);
    fitting.unwrap_or(mission).to_owned()
}

/// The newest command with its age; the command is cut, and the age is not.
fn last_command(flight: &FlightReport, columns: usize) -> String {
    let Some(command) = &flight.last_command else {
        return dash();
    };
    let age = age(command.age_s);
    let room = columns.saturating_sub(width(&age) + 1);
    format!("{} {age}", aligned(command.line.as_str(), room, false))
}

fn need_text(need: Need, flight: &FlightReport) -> Option<Text> {
    let idle_s = flight
        .last_command
        .as_ref()
        .map_or(flight.clock_s, |it| it.age_s);
    Some(match need {
        Need::Danger => {
            let Danger { kind, in_s } = flight.danger?;
            let time = age(in_s);
            match kind {
                DangerKind::Collision => text!("class-need-collision", time = time),
                DangerKind::Fence => text!("class-need-fence", time = time),
            }
        }
        Need::Alert => text!("class-need-alert", time = age(flight.oldest_alert_s?)),
        Need::Stuck => text!("class-need-stuck", time = age(idle_s)),
        Need::Nothing => return None,
    })
}

fn dash() -> String {
    "-".to_owned()
}

fn seconds(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds).unwrap_or_default()
}

/// An age: `34 s`, or `2:05` from two minutes on.
fn age(age_s: f64) -> String {
    let seconds = seconds(age_s).as_secs();
    if seconds < 120 {
        format!("{seconds} s")
    } else {
        format!("{}:{:02}", seconds / 60, seconds % 60)
    }
}

#[cfg(test)]
mod tests {
    use super::short_mission;

    #[test]
    fn a_mission_is_cut_between_its_words() {
        for (mission, columns, shown) in [
            ("14-combined-final", 20, "14-combined-final"),
            ("14-combined-final", 13, "14-combined"),
            ("08-fire-watch", 8, "08-fire"),
            ("10-radiation-source", 8, "10"),
            ("training", 4, "training"),
        ] {
            assert_eq!(short_mission(mission, columns), shown);
        }
    }
}
