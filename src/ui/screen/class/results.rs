//! The results of the class: what the whole class does not know, how scores and skills are spread, and what each
//! trainee has reached.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::room::class::{ResultsPage, ResultsView};
use crate::campaign::Skill;
use crate::class::Desk;
use crate::class_results::{
    ClassResults, ObjectiveSpread, Spread, TraineeResults, number_of_mission,
};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::gauge::Gauge;
use crate::ui::widget::{aligned, below, put, wrap};

/// The width of the first column, and of the columns with figures.
const NAME: usize = 16;
const FIGURE: usize = 9;
/// The least width of a bar.
const LEAST_BAR: usize = 10;
/// The share of trainees below which an objective counts as little known, and from which as known.
const LITTLE: f64 = 0.5;
const WELL: f64 = 0.8;

pub fn draw(state: &State, desk: &Desk, view: ResultsView, panel: Panel<'_>, buffer: &mut Buffer) {
    let (room, page) = (state.rooms().class(), view.page());
    let title = text!(
        "class-results-title",
        class = desk.class().as_str(),
        page = page.title(),
        number = page.number(),
        count = ResultsPage::ALL.len()
    );
    let inner = panel.focused(&panel.text(&title), true, buffer);
    let results = room.results().filter(|it| !it.trainees.is_empty());
    let Some(results) = results else {
        return draw_none(room.results().is_some(), panel.at(inner), buffer);
    };
    let drawing = ResultsDrawing {
        results,
        look: panel.look,
        width: usize::from(inner.width).saturating_sub(1),
    };
    if drawing.lacks(page) {
        return say(page.why_empty(), panel.at(inner), buffer);
    }
    let (heading, lines) = drawing.page(page);
    put(
        buffer,
        inner,
        0,
        &Line::styled(heading, panel.style(Role::Muted)),
    );
    let inner = below(inner, 1);
    let height = usize::from(inner.height);
    let first = view.row().min(lines.len().saturating_sub(height));
    let count = lines.len();
    let shown = lines.into_iter().skip(first).take(height);
    for (row, line) in (0..).zip(shown) {
        put(buffer, inner, row, &line);
    }
    panel.at(inner).mark_list(first, count, true, buffer);
}

/// Says that there is nothing to show.
fn draw_none(is_read: bool, panel: Panel<'_>, buffer: &mut Buffer) {
    let id = if is_read {
        "class-results-none"
    } else {
        "class-results-reading"
    };
    say(id, panel, buffer);
}

/// Says why there is nothing on the page, and what to do.
fn say(id: &str, panel: Panel<'_>, buffer: &mut Buffer) {
    let text = panel.say(id);
    for (row, line) in (0..).zip(wrap(&text, panel.width())) {
        let line = Line::styled(line, panel.style(Role::Muted));
        put(buffer, panel.area, row, &line);
    }
}

/// The rows of a page of this width.
struct ResultsDrawing<'a> {
    results: &'a ClassResults,
    look: &'a Look,
    width: usize,
}

impl ResultsDrawing<'_> {
    /// Whether the class has no results for a page.
    fn lacks(&self, page: ResultsPage) -> bool {
        match page {
            ResultsPage::Objectives => self.results.objectives.is_empty(),
            ResultsPage::Missions | ResultsPage::ByMission => self.results.missions.is_empty(),
            ResultsPage::Skills | ResultsPage::BySkill => self.results.skills.is_empty(),
        }
    }

    fn page(&self, page: ResultsPage) -> (String, Vec<Line<'static>>) {
        match page {
            ResultsPage::Objectives => self.objectives(),
            ResultsPage::Missions => self.missions(),
            ResultsPage::Skills => self.skills(),
            ResultsPage::ByMission => self.by_mission(),
            ResultsPage::BySkill => self.by_skill(),
        }
    }

    fn say(&self, text: &Text) -> String {
        self.look.text(text)
    }

    fn plain(&self, text: String, role: Role) -> Span<'static> {
        Span::styled(text, self.look.style(role))
    }

    /// The columns that are left for bars and titles.
    fn room(&self, used: usize) -> usize {
        self.width.saturating_sub(used).max(LEAST_BAR)
    }

    /// The objectives, the least known first: who met them of those who tried, as a bar.
    fn objectives(&self) -> (String, Vec<Line<'static>>) {
        let bar = self.room(NAME + 1 + FIGURE + 1 + FIGURE + 1) / 2;
        let title = self.room(NAME + 1 + bar + 1 + FIGURE + 1 + FIGURE + 1);
        let heading = [
            aligned(&self.look.say("progress-mission"), NAME, false),
            aligned(&self.look.say("class-report-objective"), title, false),
            aligned(&self.look.say("class-results-met"), bar, false),
            aligned(&self.look.say("class-report-met"), FIGURE, true),
            aligned(&self.look.say("class-report-share"), FIGURE, true),
        ];
        let line = |it: &ObjectiveSpread| {
            let share = it.met as f64 / it.trainees.max(1) as f64;
            let mut line = Line::from(self.plain(
                format!(
                    "{} {} ",
                    aligned(&it.mission, NAME, false),
                    aligned(&self.say(&it.title), title, false)
                ),
                Role::Text,
            ));
            self.push_gauge(&mut line, share, bar);
            let met = format!("{}/{}", it.met, it.trainees);
            let points = format!("{:.0} %", it.mean_percent);
            let figures = format!(
                " {} {}",
                aligned(&met, FIGURE, true),
                aligned(&points, FIGURE, true)
            );
            line.push_span(self.plain(figures, Role::Text));
            line
        };
        let lines = self.results.objectives.iter().map(line).collect();
        (heading.join(" "), lines)
    }

    fn push_gauge(&self, line: &mut Line<'static>, share: f64, cells: usize) {
        let role = if share < LITTLE {
            Role::Danger
        } else if share < WELL {
            Role::Warning
        } else {
            Role::Ok
        };
        let gauge = Gauge {
            share,
            mark: None,
            role,
        };
        for span in gauge.spans(cells, self.look) {
            line.push_span(span);
        }
    }

    /// The best scores of the trainees in each mission.
    fn missions(&self) -> (String, Vec<Line<'static>>) {
        let rows = self.results.missions.iter().map(|it| SpreadRow {
            name: it.mission.clone(),
            reached: format!("{}/{}", it.passed, it.trainees),
            spread: it.scores,
            unit: "",
        });
        let heading = self.spread_heading("progress-mission", "progress-passed");
        (heading, self.spreads(rows, 1000.0))
    }

    /// How well each skill is mastered, the least known first.
    fn skills(&self) -> (String, Vec<Line<'static>>) {
        let rows = self.results.skills.iter().map(|it| SpreadRow {
            name: format!("{} {}", it.skill.code(), self.say(&it.title)),
            reached: format!("{}/{}", it.mastered, it.trainees),
            spread: it.percent,
            unit: " %",
        });
        let heading = self.spread_heading("progress-skill", "class-report-mastered");
        (heading, self.spreads(rows, 100.0))
    }

    fn spreads(&self, rows: impl Iterator<Item = SpreadRow>, most: f64) -> Vec<Line<'static>> {
        rows.map(|row| self.spread(&row, most)).collect()
    }

    fn spread_columns(&self) -> (usize, usize) {
        let name = NAME * 2;
        let bar = self.room(name + 1 + FIGURE + 2 + FIGURE + 1);
        (name, bar)
    }

    fn spread_heading(&self, name: &str, reached: &str) -> String {
        let (columns, bar) = self.spread_columns();
        [
            aligned(&self.look.say(name), columns, false),
            aligned(&self.look.say(reached), FIGURE, true),
            aligned(&self.look.say("class-results-spread"), bar + 1, false),
            aligned(&self.look.say("class-report-median"), FIGURE, true),
        ]
        .join(" ")
    }

    fn spread(&self, row: &SpreadRow, most: f64) -> Line<'static> {
        let (columns, bar) = self.spread_columns();
        let mut line = Line::from(self.plain(
            format!(
                "{} {}  ",
                aligned(&row.name, columns, false),
                aligned(&row.reached, FIGURE, true)
            ),
            Role::Text,
        ));
        for (text, role) in box_cells(row.spread, most, bar) {
            line.push_span(Span::styled(text, self.look.fill(role)));
        }
        let median = format!("{:.0}{}", row.spread.median, row.unit);
        line.push_span(self.plain(format!(" {}", aligned(&median, FIGURE, true)), Role::Text));
        line
    }

    /// A row for each trainee with the best score in each mission.
    fn by_mission(&self) -> (String, Vec<Line<'static>>) {
        let missions = self.results.missions.iter();
        let ids: Vec<String> = missions.map(|it| it.mission.clone()).collect();
        let heads: Vec<String> = ids
            .iter()
            .map(|id| number_of_mission(id).to_owned())
            .collect();
        self.matrix(&heads, |trainee, column| {
            result_cell(trainee, ids.get(column)?)
        })
    }

    /// A row for each trainee with the probability that each skill is mastered.
    fn by_skill(&self) -> (String, Vec<Line<'static>>) {
        let is_shown = |skill: &&Skill| self.results.skills.iter().any(|it| it.skill == **skill);
        let skills: Vec<Skill> = Skill::ALL.iter().filter(is_shown).copied().collect();
        let heads: Vec<String> = skills.iter().map(|it| it.code().to_owned()).collect();
        self.matrix(&heads, |trainee, column| {
            let skill = trainee.skill(*skills.get(column)?)?;
            let role = if skill.percent < 50 {
                Role::Warning
            } else {
                Role::Text
            };
            Some((format!("{} %", skill.percent), role))
        })
    }

    /// A row for each trainee; columns that do not fit are left out.
    fn matrix(
        &self,
        heads: &[String],
        cell: impl Fn(&TraineeResults, usize) -> Option<(String, Role)>,
    ) -> (String, Vec<Line<'static>>) {
        let fitting = self.width.saturating_sub(NAME) / (FIGURE + 1);
        let shown = heads.len().min(fitting);
        let name = self.look.say("progress-trainee");
        let heading = heads
            .iter()
            .take(shown)
            .fold(aligned(&name, NAME, false), |line, head| {
                line + " " + &aligned(head, FIGURE, true)
            });
        let row = |trainee: &TraineeResults| {
            let name = aligned(&trainee.user, NAME, false);
            let mut line = Line::from(self.plain(name, Role::Text));
            for column in 0..shown {
                let dash = || ("-".to_owned(), Role::Muted);
                let (text, role) = cell(trainee, column).unwrap_or_else(dash);
                let text = format!(" {}", aligned(&text, FIGURE, true));
                line.push_span(self.plain(text, role));
            }
            line
        };
        let mut lines: Vec<Line<'static>> = self.results.trainees.iter().map(row).collect();
        let left_out = heads.len() - shown;
        if left_out > 0 {
            let text = text!("class-results-left-out", count = left_out);
            lines.push(Line::from(self.plain(self.say(&text), Role::Muted)));
        }
        (heading, lines)
    }
}

/// The best score and the number of tries, if there are some.
fn result_cell(trainee: &TraineeResults, id: &str) -> Option<(String, Role)> {
    let mission = trainee.mission(id)?;
    let role = if mission.is_passed() {
        Role::Ok
    } else {
        Role::Warning
    };
    Some((format!("{}/{}", trainee.best(id)?, mission.tries), role))
}

/// A row with figures of several trainees.
struct SpreadRow {
    name: String,
    /// How many of the trainees have passed or mastered it.
    reached: String,
    spread: Spread,
    unit: &'static str,
}

/// A bar from the lowest to the highest figure: the middle half is filled, and the median is marked.
fn box_cells(spread: Spread, most: f64, cells: usize) -> Vec<(String, Role)> {
    let last = cells.saturating_sub(1);
    let at = |figure: f64| ((figure / most).clamp(0.0, 1.0) * last as f64).round() as usize;
    let (least, highest) = (at(spread.least), at(spread.most));
    let (lower, upper) = (at(spread.lower_quartile), at(spread.upper_quartile));
    let median = at(spread.median);
    let cell = |index: usize| {
        if index == median {
            ("┃", Role::Text)
        } else if (lower..=upper).contains(&index) {
            ("█", Role::Accent)
        } else if (least..=highest).contains(&index) {
            ("─", Role::Accent)
        } else {
            ("·", Role::Muted)
        }
    };
    (0..cells)
        .map(cell)
        .map(|(sign, role)| (sign.to_owned(), role))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(figures: &[f64]) -> String {
        let spread = Spread::of(figures.to_vec()).expect("figures");
        let cells = box_cells(spread, 100.0, 11).into_iter();
        cells.map(|(sign, _)| sign).collect()
    }

    #[test]
    fn a_bar_shows_the_quartiles_of_a_class() {
        assert_eq!(drawn(&[0.0, 20.0, 50.0, 60.0, 100.0]), "──███┃█────");
        assert_eq!(drawn(&[100.0]), "··········┃");
        assert_eq!(drawn(&[0.0]), "┃··········");
    }
}
