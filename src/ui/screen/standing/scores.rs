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
/// The maximum width of a mission's name, and the minimum width of the rest of its line, in
/// columns.
const NAME: usize = 30;
const FIGURES: usize = 36;
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
    let rows = usize::from(inner.height).min(flown.len());
    let first = cursor.saturating_sub(rows / 2).min(flown.len() - rows);
    for (row, at) in (first..flown.len()).take(rows).enumerate() {
        let row = row as u16;
        let mark = if at == cursor { '>' } else { ' ' };
        let line = line(subject, flown[at], usize::from(inner.width));
        put(buffer, inner, row, &Line::raw(format!("{mark} {line}")));
        if at == cursor && subject.has_cursor(Pane::Scores) {
            Panel::new(look, row_of(inner, row)).mark_cursor(buffer);
        }
    }
    let list_panel = Panel::new(look, upper(inner, rows as u16));
    list_panel.mark_list(first, flown.len(), subject.has_cursor(Pane::Scores), buffer);
    let used = 2 + rows as u16;
    draw_chart(subject, flown[cursor], below(area, used), buffer);
}

/// A mission with its attempts, its best and its last score.
fn line(subject: &StandingSubject<'_>, offer: &Offer, room: usize) -> String {
    let look = subject.look;
    let tries = subject.career.growth.tries(&offer.id);
    let best = subject.career.standing.best(&offer.id);
    let points = best.and_then(|best| best.score);
    let score = points.map_or_else(|| "-".to_owned(), |points| points.to_string());
    let score_and_medal = format!("{score} {}", stars(best.and_then(|best| best.medal)));
    let last = tries.last();
    let figures = text!(
        "standing-mission",
        count = tries.len(),
        best = score_and_medal.trim_end(),
        last = last.map_or(0, |last| last.score),
        when = last.map_or_else(Default::default, |last| days(last.day - subject.career.day))
    );
    let shown = look.text(&figures);
    let name = room
        .saturating_sub(width(&shown).max(FIGURES) + 3)
        .min(NAME);
    let title = aligned(&look.text(&offer.title), name, false);
    format!("{title} {shown}")
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
