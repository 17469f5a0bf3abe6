//! The board: a row per seat, in the order in which they need help.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::columns::BoardColumn;
use super::seat_view::SeatLineView;
use super::{age, exam, lesson, seconds};
use crate::app::State;
use crate::class::{Desk, FlightReport};
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, put, row_of, short_clock, width, wrap};

pub(super) fn draw(
    state: &State,
    desk: &Desk,
    board: &[usize],
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let [here, count] = desk.counted_seats();
    let consoles = desk.seats().iter().filter(|seat| seat.is_here()).count();
    let room = state.rooms().class();
    let title = text!(
        "class-title",
        class = class(desk),
        here = here,
        count = count,
        consoles = if consoles > here { consoles } else { 0 },
        marked = room.marked()
    );
    let inner = panel.focused(&panel.text(&title), true, buffer);
    let columns = BoardColumn::fitting(inner.width, &exam::columns(desk, state.wall()));
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

/// The name of the class, and where its desk listens for other machines.
fn class(desk: &Desk) -> Text {
    let class = desk.class().as_str();
    match desk.address() {
        Some(address) => text!("class-listens", class = class, address = address.as_str()),
        None => Text::verbatim(class),
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

fn dash() -> String {
    "-".to_owned()
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
