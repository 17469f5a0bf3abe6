//! A flight that is being graded: the elements with their marks, and what is known about the one under the cursor.

use ratatui::buffer::Buffer;
use ratatui::style::Style;
use ratatui::text::Line;

use crate::app::room::class::GradingPage;
use crate::grading::{Grade, GradedFlight, Mark, RubricCategory, RubricElement};
use crate::text;
use crate::text::{Text, figure};
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, columns, put, put_or_count, row_of, short_clock};

/// The share of the width for the list of elements, in percent, and its largest width.
const LIST_PERCENT: u16 = 42;
const WIDEST_LIST: u16 = 48;
/// The columns of a mark with the blanks around it.
const MARK: usize = 4;

/// A row of the list.
enum ListRow<'a> {
    Category(&'a RubricCategory),
    /// An element with its number among all.
    Element(usize, &'a RubricElement),
}

pub(super) fn draw(page: &GradingPage, panel: Panel<'_>, buffer: &mut Buffer) {
    let flight = page.flight();
    let title = text!(
        "grading-title",
        user = trainee(flight),
        mission = flight.title.clone(),
        score = flight.score,
        when = started(&flight.when),
        number = flight.number,
        flights = flight.flights
    );
    let inner = panel.focused(&panel.text(&title), true, buffer);
    let open = flight.sheet.open(&flight.rubric).count();
    let texts = [
        text!(
            "grading-rubric",
            rubric = flight.rubric.title.clone(),
            grader = flight.sheet.grader.as_str()
        ),
        text!("grading-open", count = open),
    ];
    let heading = texts.map(|text| panel.text(&text)).join(" · ");
    put(
        buffer,
        inner,
        0,
        &Line::styled(heading, panel.style(Role::Muted)),
    );
    let body = below(inner, 1);
    let list = (body.width * LIST_PERCENT / 100).min(WIDEST_LIST);
    draw_list(page, panel.at(columns(body, 0, list)), buffer);
    let detail = columns(body, list + 1, body.width.saturating_sub(list + 1));
    draw_detail(page, panel.at(detail), buffer);
}

/// The name of the user, and that of the profile.
fn trainee(flight: &GradedFlight) -> String {
    match flight.profile.as_deref().filter(|it| *it != flight.user) {
        Some(profile) => format!("{} ({profile})", flight.user),
        None => flight.user.clone(),
    }
}

/// The date and the time of a start, to the minute.
fn started(when: &str) -> String {
    when.get(..16).unwrap_or(when).replace('T', " ")
}

fn draw_list(page: &GradingPage, panel: Panel<'_>, buffer: &mut Buffer) {
    let mut number = 0;
    let mut rows = Vec::new();
    for category in &page.flight().rubric.categories {
        rows.push(ListRow::Category(category));
        for element in &category.elements {
            rows.push(ListRow::Element(number, element));
            number += 1;
        }
    }
    let is_cursor =
        |row: &ListRow<'_>| matches!(row, ListRow::Element(it, _) if *it == page.cursor());
    let height = usize::from(panel.area.height);
    let at = rows.iter().position(is_cursor).unwrap_or_default();
    let first = at
        .saturating_sub(height / 2)
        .min(rows.len().saturating_sub(height));
    for (row, shown) in (0..).zip(rows.iter().skip(first).take(height)) {
        let place = row_of(panel.area, row);
        let (line, role) = list_line(page, shown, panel.look, usize::from(place.width));
        put(buffer, place, 0, &Line::styled(line, panel.style(role)));
        if is_cursor(shown) {
            panel.at(place).mark_cursor(buffer);
        }
    }
}

/// A category with its mean, or an element with its mark.
fn list_line(page: &GradingPage, row: &ListRow<'_>, look: &Look, width: usize) -> (String, Role) {
    let sheet = &page.flight().sheet;
    let (title, mark, role) = match row {
        ListRow::Category(category) => {
            let mean = sheet.mean(&category.elements);
            let mean = mean.map_or_else(String::new, |it| figure(it, 1));
            (look.text(&category.title), mean, Role::Title)
        }
        ListRow::Element(number, element) => {
            let cursor = if *number == page.cursor() { ">" } else { " " };
            let grade = sheet.grades.get(&element.id);
            let (mark, role) = match grade {
                None => (String::new(), Role::Text),
                Some(grade) if grade.lacks_reason() => (mark(grade.mark) + " !", Role::Warning),
                Some(grade) => (mark(grade.mark), Role::Text),
            };
            (
                format!("{cursor} {}", look.text(&element.title)),
                mark,
                role,
            )
        }
    };
    let room = width.saturating_sub(MARK);
    (
        aligned(&title, room, false) + &aligned(&mark, MARK, true),
        role,
    )
}

/// A mark as the list shows it; what was not observed has a dash.
fn mark(mark: Option<Mark>) -> String {
    mark.map_or_else(|| "-".to_owned(), |it| it.number().to_string())
}

/// What is to be observed, what the record says, and the grade's reasons.
fn draw_detail(page: &GradingPage, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(element) = page.element() else {
        return;
    };
    let inner = panel.titled(&panel.text(&element.title), buffer);
    let lines = detail_lines(page, element).into_iter();
    let lines = lines.map(|(text, role)| (panel.text(&text), panel.style(role)));
    let lines: Vec<(String, Style)> = lines.collect();
    put_or_count(&lines, panel.at(inner), buffer);
}

fn detail_lines(page: &GradingPage, element: &RubricElement) -> Vec<(Text, Role)> {
    let flight = page.flight();
    let evidence = flight.evidence.get(page.cursor()).into_iter().flatten();
    let mut lines: Vec<(Text, Role)> = evidence
        .map(|it| {
            (
                text!("grading-evidence", evidence = it.clone()),
                Role::Accent,
            )
        })
        .collect();
    if let Some(grade) = flight.sheet.grades.get(&element.id) {
        lines.extend(reasons(page, grade));
    }
    lines.extend((1..).zip(&flight.bookmarks).map(|(number, bookmark)| {
        let line = text!(
            "grading-bookmark",
            number = number,
            time = short_clock(bookmark.at),
            text = bookmark.text.as_str()
        );
        (line, Role::Text)
    }));
    let good = element.good.iter();
    lines.extend(good.map(|it| (text!("grading-good", marker = it.clone()), Role::Ok)));
    let poor = element.poor.iter();
    lines.extend(poor.map(|it| (text!("grading-poor", marker = it.clone()), Role::Warning)));
    lines.push((text!("grading-scale"), Role::Muted));
    lines
}

/// The reasons of a grade, or that one is missing.
fn reasons(page: &GradingPage, grade: &Grade) -> Vec<(Text, Role)> {
    let mut lines = Vec::new();
    if !grade.text.is_empty() {
        let remark = text!("grading-remark", text = grade.text.as_str());
        lines.push((remark, Role::Text));
    }
    let numbers = (1..)
        .zip(&page.flight().bookmarks)
        .filter(|(_, bookmark)| grade.cites(bookmark.recorded));
    let numbers: Vec<String> = numbers.map(|(number, _)| format!("◆{number}")).collect();
    if !numbers.is_empty() {
        let cited = text!("grading-cited", numbers = numbers.join(" "));
        lines.push((cited, Role::Text));
    }
    if grade.lacks_reason() {
        lines.push((text!("grading-needs-reason"), Role::Warning));
    }
    lines
}
