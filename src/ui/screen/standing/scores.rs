//! The missions flown, and the scores of the mission under the cursor, attempt by attempt.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use super::{StandingSubject, days};
use crate::app::room::standing::{Pane, flown};
use crate::campaign::{Offer, Stake, Try};
use crate::mission::Listing;
use crate::scoring::{Medal, Medals};
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::bars::{Bar, Bars, draw as draw_bars};
use crate::ui::widget::{aligned, below, put, row_of, stars, upper, width};

/// The minimum height of the chart, with its title and its axis, in rows.
const CHART: u16 = 12;
/// The width of the cursor before a line, in columns.
const MARK: usize = 2;
/// The gap between two columns of the list.
const GAP: &str = "  ";
const PERFECT: f64 = 1000.0;

/// Draws the list, and below it the chart.
pub(super) fn draw(subject: &StandingSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let look = subject.look;
    let flown = flown(subject.career);
    let list = upper(area, area.height.saturating_sub(CHART).max(4));
    let inner = subject.pane(Pane::Scores, &look.say("standing-scores"), list, buffer);
    let Some(last) = flown.len().checked_sub(1) else {
        let text = look.say("standing-scores-nothing");
        let line = Line::styled(text, look.style(Role::Muted));
        put(buffer, inner, 0, &line);
        return;
    };
    let cursor = subject.state.rooms().standing().mission().min(last);
    let [heads, lines @ ..] = &table(subject, &flown, usize::from(inner.width) - MARK)[..] else {
        return;
    };
    let heads = Line::styled(format!("  {heads}"), look.style(Role::Muted));
    put(buffer, inner, 0, &heads);
    let inner = below(inner, 1);
    let rows = usize::from(inner.height).min(flown.len());
    let first = cursor.saturating_sub(rows / 2).min(flown.len() - rows);
    for (row, at) in (first..flown.len()).take(rows).enumerate() {
        let row = row as u16;
        let mark = if at == cursor { '>' } else { ' ' };
        let line = format!("{mark} {}", lines[at]);
        put(buffer, inner, row, &Line::raw(line));
        if at == cursor && subject.has_cursor(Pane::Scores) {
            Panel::new(look, row_of(inner, row)).mark_cursor(buffer);
        }
    }
    let list_panel = Panel::new(look, upper(inner, rows as u16));
    list_panel.mark_list(first, flown.len(), subject.has_cursor(Pane::Scores), buffer);
    let used = 3 + rows as u16;
    draw_chart(subject, flown[cursor], below(area, used), buffer);
}

/// The column heads and a line for each mission: its flights, its best and its last score. Only the names are cut if
/// there is not enough room.
fn table(subject: &StandingSubject<'_>, flown: &[&Offer], room: usize) -> Vec<String> {
    let heads = HEADS.map(|id| subject.look.say(id));
    let rows = flown.iter().map(|offer| cells(subject, offer));
    let rows: Vec<ScoreCells> = std::iter::once(heads).chain(rows).collect();
    let mut widths = [0; HEADS.len()];
    for row in &rows {
        for (widest, cell) in widths.iter_mut().zip(row) {
            *widest = width(cell).max(*widest);
        }
    }
    let [_, figures @ ..] = widths;
    let figures: usize = figures.iter().map(|columns| columns + GAP.len()).sum();
    widths[0] = widths[0].min(room.saturating_sub(figures));
    let line = |row: ScoreCells| {
        let columns = row.iter().zip(widths).zip(IS_NUMBER);
        let shown: Vec<String> = columns
            .map(|((cell, columns), is_number)| aligned(cell, columns, is_number))
            .collect();
        shown.join(GAP).trim_end().to_owned()
    };
    rows.into_iter().map(line).collect()
}

/// The heads of the columns, and whether their values are numbers, which are aligned at the right.
const HEADS: [&str; 6] = [
    "standing-column-mission",
    "standing-column-flights",
    "standing-column-best",
    "standing-column-medal",
    "standing-column-last",
    "standing-column-when",
];
const IS_NUMBER: [bool; HEADS.len()] = [false, true, true, false, true, false];

/// A mission's values in the columns of the list.
type ScoreCells = [String; HEADS.len()];

fn cells(subject: &StandingSubject<'_>, offer: &Offer) -> ScoreCells {
    let look = subject.look;
    let tries = subject.career.growth.tries(&offer.id);
    let best = subject.career.standing.best(&offer.id);
    let points = best.and_then(|best| best.score);
    let last = tries.last();
    let when = last.map(|last| look.text(&days(last.day - subject.career.day)));
    [
        look.text(&offer.title),
        tries.len().to_string(),
        points.map_or_else(|| "-".to_owned(), |points| points.to_string()),
        stars(best.and_then(|best| best.medal)).to_owned(),
        last.map_or_else(|| "-".to_owned(), |last| last.score.to_string()),
        when.unwrap_or_default(),
    ]
}

fn draw_chart(subject: &StandingSubject<'_>, offer: &Offer, area: Rect, buffer: &mut Buffer) {
    let look = subject.look;
    let title = text!("standing-chart", mission = offer.title.clone());
    let inner = Panel::new(look, area).titled(&look.text(&title), buffer);
    let mut missions = subject.state.training().missions().iter();
    let listing = missions.find(|listing| listing.id == offer.id);
    let tries = subject.career.growth.tries(&offer.id);
    let bars: Vec<Bar> = tries
        .iter()
        .map(|one| bar(one, look.fill(role(one))))
        .collect();
    let lines: Vec<(f64, String)> = listing
        .map(|Listing { medals, .. }| medal_lines(*medals))
        .unwrap_or_default()
        .into_iter()
        .map(|(points, medal)| (points, format!("{} {points:.0}", look.text(&medal.title()))))
        .collect();
    let chart = Bars {
        values: &bars,
        lines: &lines,
        most: PERFECT,
    };
    draw_bars(&chart, Panel::new(look, inner), buffer);
}

/// The points that medals require.
fn medal_lines(medals: Medals) -> Vec<(f64, Medal)> {
    vec![
        (f64::from(medals.gold), Medal::Gold),
        (f64::from(medals.silver), Medal::Silver),
        (f64::from(medals.bronze), Medal::Bronze),
    ]
}

/// The bar of a flight with its score below, and a sign if it was not passed or did not count.
fn bar(one: &Try, style: ratatui::style::Style) -> Bar {
    let sign = match (one.passed, one.stake) {
        (false, _) => "x",
        (true, Stake::Practice) => "p",
        (true, _) => "",
    };
    Bar {
        value: f64::from(one.score),
        label: format!("{}{sign}", one.score),
        style,
    }
}

fn role(one: &Try) -> Role {
    match (one.passed, one.stake) {
        (false, _) => Role::Danger,
        (true, Stake::Practice) => Role::Muted,
        (true, _) => Role::Ok,
    }
}
