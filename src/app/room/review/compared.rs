//! The page that compares two flights in a table.

use super::key_of;
use super::page::Page;
use crate::app::room::page::Tone;
use crate::comparison::{ComparedFlight, Difference, differences};
use crate::debrief::fit;
use crate::text;
use crate::text::{Text, clock, wrap};

/// Columns of the time.
const TIME: usize = 6;
/// Columns of the points; the other cells share the remaining width.
const POINTS: usize = 8;
/// The share of the remaining width for the difference, in units of `1 / SHARES`.
const WHAT: usize = 2;
const SHARES: usize = 5;

impl Page<'_> {
    pub(super) fn compared(&mut self) {
        let Some(ghost) = &self.state.ghost else {
            let key = key_of(self.state, "ghost");
            return self.text.say(Tone::Hint, &text!("compare-how", key = key));
        };
        let Some(own) = ghost.own.clone() else {
            return self.text.say(Tone::Muted, &text!("compare-in-flight"));
        };
        let other = &ghost.other;
        let alignment = text!("compare-aligned", moment = ghost.alignment().text());
        self.text.say(Tone::Muted, &alignment);
        self.heads(&own, other);
        let differences = differences(&own, other);
        if differences.is_empty() {
            self.text.say(Tone::Muted, &text!("compare-same"));
        }
        for difference in differences {
            self.difference(&difference);
        }
    }

    /// Adds the pilots of the flights and their results.
    fn heads(&mut self, own: &ComparedFlight, other: &ComparedFlight) {
        let [mine, theirs] = [own, other].map(|it| self.text.locale.text(&it.name));
        let [time, points] = ["compare-time", "compare-points"].map(|id| self.text.locale.say(id));
        self.row(Tone::Hint, [&time, "", &mine, &theirs, &points]);
        let (score, their_score) = (own.report.score, other.report.score);
        let gain = i32::from(score) - i32::from(their_score);
        let cells = [
            "",
            &self.text.locale.say("compare-score"),
            &score.to_string(),
            &their_score.to_string(),
            &format!("{gain:+}"),
        ];
        self.row(Tone::Hint, cells);
    }

    fn difference(&mut self, difference: &Difference) {
        let say = |text: &Text| self.text.locale.text(text);
        let time = difference.at.map_or_else(String::new, clock);
        let points = match difference.points {
            Some(points) => format!("{points:+.1}"),
            None => String::new(),
        };
        let tone = match difference.points {
            Some(points) if points < 0.0 => Tone::Missed,
            Some(points) if points > 0.0 => Tone::Met,
            Some(_) | None => Tone::Plain,
        };
        let (what, own, other) = (
            say(&difference.what),
            say(&difference.own),
            say(&difference.other),
        );
        self.row(tone, [&time, &what, &own, &other, &points]);
    }

    /// Adds a row of the table: time, difference, this flight, the other flight, points. Long cells
    /// take several lines.
    fn row(&mut self, tone: Tone, cells: [&str; 5]) {
        let rest = self.text.width.saturating_sub(TIME + POINTS + 4);
        let what = rest * WHAT / SHARES;
        let side = (rest - what) / 2;
        let [time, about, own, other, points] = cells;
        let columns = [(about, what), (own, side), (other, side)]
            .map(|(cell, width)| (wrap(cell, width), width));
        let count = columns.iter().map(|(lines, _)| lines.len()).max();
        for at in 0..count.unwrap_or_default() {
            let [about, own, other] = columns
                .each_ref()
                .map(|(lines, width)| fit(lines.get(at).map_or("", String::as_str), *width));
            let (time, points) = if at == 0 { (time, points) } else { ("", "") };
            let line = format!(
                "{} {about} {own} {other} {points:>POINTS$}",
                fit(time, TIME)
            );
            self.text.add(tone, line.trim_end());
        }
    }
}
