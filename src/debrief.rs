//! The debrief: a report as plain text for people, 80 columns wide at most.
//!
//! Every loss of points names what moved it; improvements stand by the size of their gain.

use std::fmt::Write as _;

use unicode_width::{UnicodeWidthChar as _, UnicodeWidthStr as _};

use crate::notice::sanitised;
use crate::scoring::{EventReport, LedgerReport, Report};
use crate::text;
use crate::text::{Locale, Text};

/// Columns of the page.
const WIDTH: usize = 80;
/// Columns of the strip of time.
const STRIP: usize = 60;
/// Rows of the timeline; when there are more, the commands that went well are left out.
const ROWS: usize = 40;

/// The debrief of a report, in the words of a language.
pub fn text(report: &Report, locale: &Locale) -> String {
    let mut page = Page {
        words: String::new(),
        locale,
    };
    page.head(report);
    page.objectives(report);
    page.components(report);
    page.timeline(report);
    page.improvements(report);
    // A stored report may hold anything; the page stays as wide as it is.
    let cut = |line: &str| fit(line, WIDTH).trim_end().to_owned();
    let lines: Vec<String> = page.words.lines().map(cut).collect();
    lines.join("\n") + "\n"
}

/// A page while it is written.
struct Page<'a> {
    words: String,
    locale: &'a Locale,
}

impl Page<'_> {
    fn line(&mut self, line: &str) {
        self.words.push_str(line);
        self.words.push('\n');
    }

    fn heading(&mut self, id: &str) {
        let heading = format!(" {}", self.locale.say(id));
        self.line(&heading);
    }

    fn head(&mut self, report: &Report) {
        let rule = format!("+{}+", "=".repeat(WIDTH - 2));
        let medal = match report.medal {
            Some(medal) => self.locale.text(&medal.title()).to_uppercase(),
            None => self.locale.say("debrief-no-medal"),
        };
        let backend = match report.backend.as_str() {
            "embedded" => text!("debrief-embedded"),
            name => name.into(),
        };
        let first = text!(
            "debrief-head",
            mission = &report.mission,
            revision = report.revision,
            title = &report.title,
            outcome = self.locale.text(&report.outcome).to_uppercase()
        );
        let second = text!(
            "debrief-score",
            score = report.score,
            grade = &report.grade,
            medal = medal,
            seed = report.seed.to_string(),
            backend = backend
        );
        self.line(&rule);
        for line in [first, second] {
            let line = fit(&self.locale.text(&line), WIDTH - 4);
            self.line(&format!("| {line} |"));
        }
        self.line(&rule);
        self.spent(report);
    }

    /// Time and energy.
    fn spent(&mut self, report: &Report) {
        let energy = match report.energy_wh {
            Some(used) => text!(
                "debrief-energy",
                used = format!("{used:.1}"),
                par = format!("{:.1}", report.par_energy_wh)
            ),
            None => text!("debrief-energy-unknown"),
        };
        let spent = text!(
            "debrief-time",
            used = clock(report.sim_time_s),
            par = clock(report.par_time_s),
            limit = clock(report.time_limit_s),
            energy = energy,
            count = report.vehicles
        );
        let spent = format!(" {}\n", self.locale.text(&spent));
        self.line(&spent);
    }

    fn objectives(&mut self, report: &Report) {
        let locale = self.locale;
        let heading = format!(
            "{}{}{}{}",
            fit(&format!(" {}", locale.say("debrief-objectives")), 39),
            fit(&locale.say("debrief-result"), 14),
            fit(&locale.say("debrief-target"), 12),
            locale.say("debrief-points")
        );
        self.line(&heading);
        for objective in &report.objectives {
            let line = format!(
                "  [{}] {} {} {} {} {:.1}/{:.0}",
                if objective.met { 'x' } else { ' ' },
                fit(&objective.id, 8),
                fit(&locale.text(&objective.title), 22),
                fit(&locale.text(&objective.result), 13),
                fit(&locale.text(&objective.target), 11),
                objective.points,
                objective.points_max,
            );
            self.line(&line);
        }
        self.words.push('\n');
    }

    fn components(&mut self, report: &Report) {
        let locale = self.locale;
        let heading = format!(
            "{} {} {} {}   {}",
            fit(&format!(" {}", locale.say("debrief-components")), 14),
            right(&locale.say("debrief-weight"), 6),
            right(&locale.say("debrief-value"), 6),
            right(&locale.say("debrief-points"), 8),
            locale.say("debrief-moved")
        );
        self.line(&heading);
        for component in &report.components {
            let lead = format!(
                "  {} {:>6.3} {:>6.3} {:>8.1}   ",
                fit(&locale.text(&component.name), 12),
                component.weight,
                component.value,
                component.points
            );
            self.wrapped(&lead, &component.moved_by);
        }
        let points = report.components.iter().map(|component| component.points);
        let subtotal: f64 = points.sum();
        let gold = if report.gold_missing.is_empty() {
            Text::default()
        } else {
            let gates = Text::joined(", ", report.gold_missing.clone());
            text!("debrief-gold-needs", gates = gates)
        };
        self.line(&format!("{:28} --------", ""));
        let sum = format!("  {} {:>4}", locale.say("debrief-sum"), report.score);
        self.wrapped(&format!("{}{subtotal:>8.1}   ", fit(&sum, 29)), &gold);
        self.words.push('\n');
    }

    fn timeline(&mut self, report: &Report) {
        self.heading("debrief-timeline");
        let mut rows: Vec<(f64, char, Text)> = report.events.iter().map(event_row).collect();
        if rows.len() + report.ledger.len() <= ROWS {
            rows.extend(report.ledger.iter().filter_map(command_row));
        }
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        let end = clock(report.sim_time_s);
        let strip = strip(&rows, report.sim_time_s);
        self.line(&format!("  00:00 |{strip}| {end}"));
        for (at_s, mark, words) in &rows {
            self.wrapped(&format!("   {} {mark} ", clock(*at_s)), words);
        }
        self.words.push('\n');
    }

    fn improvements(&mut self, report: &Report) {
        self.heading("debrief-improve");
        if report.improvements.is_empty() {
            let nothing = format!("  {}", self.locale.say("debrief-nothing"));
            self.line(&nothing);
        }
        for improvement in &report.improvements {
            let gain = format!("+{}", improvement.points);
            self.wrapped(&format!("  {gain:>4}  "), &improvement.text);
        }
        let good = report
            .components
            .iter()
            .filter(|component| component.value >= 0.95)
            .max_by(|a, b| a.points.total_cmp(&b.points));
        if let Some(good) = good {
            let lead = fit(&format!("  {}", self.locale.say("debrief-good")), 8);
            let words = vec![good.name.clone(), good.moved_by.clone()];
            self.wrapped(&lead, &Text::joined(": ", words));
        }
    }

    /// Writes text behind a lead, broken between words to the page's width, later lines indented to the lead's end.
    fn wrapped(&mut self, lead: &str, text: &Text) {
        let indent = lead.width();
        let room = WIDTH.saturating_sub(indent).max(1);
        self.words.push_str(lead);
        let mut column = 0;
        for word in sanitised(&self.locale.text(text)).split_whitespace() {
            // A word longer than a line is broken anywhere.
            for piece in pieces(word, room) {
                let width = piece.width();
                if column > 0 && column + 1 + width > room {
                    let _ = write!(self.words, "\n{:indent$}", "");
                    column = 0;
                }
                if column > 0 {
                    self.words.push(' ');
                    column += 1;
                }
                self.words.push_str(&piece);
                column += width;
            }
        }
        self.words.push('\n');
    }
}

/// The marks of what happened, along the time of the flight.
fn strip(rows: &[(f64, char, Text)], length_s: f64) -> String {
    let mut strip = vec!['-'; STRIP];
    let length_s = length_s.max(0.1);
    // Plain commands first: what matters more is drawn over them.
    for mark in ['>', '.', 'o', '!', 'r', 'x'] {
        for (at_s, ..) in rows.iter().filter(|(_, shown, _)| *shown == mark) {
            let at = (at_s / length_s * (STRIP - 1) as f64).round() as usize;
            strip[at.min(STRIP - 1)] = mark;
        }
    }
    strip.into_iter().collect()
}

fn event_row(event: &EventReport) -> (f64, char, Text) {
    let mark = match event.kind.as_str() {
        "objective" => 'o',
        "alert" => '!',
        "rule" => 'x',
        "rejected" => 'r',
        _ => '.',
    };
    let words = match event.vehicle.filter(|_| mark != 'r') {
        Some(vehicle) => text!("debrief-drone", vehicle = vehicle, what = &event.text),
        None => event.text.clone(),
    };
    (event.at_s, mark, words)
}

/// A command that at least one vehicle took; a rejection has a row of its own.
fn command_row(entry: &LedgerReport) -> Option<(f64, char, Text)> {
    let row = entry
        .rows
        .iter()
        .find(|row| row.state != "refused" && row.state != "timed out")?;
    let words = vec![entry.line.as_str().into(), row.state.clone()];
    Some((entry.at_s, '>', Text::joined(": ", words)))
}

/// Minutes and seconds; tenths are cut off.
fn clock(seconds: f64) -> String {
    let whole = seconds.max(0.0) as u64;
    format!("{:02}:{:02}", whole / 60, whole % 60)
}

/// Text of exactly `width` columns: padded, or cut with a mark.
fn fit(text: &str, width: usize) -> String {
    let text = sanitised(text);
    let used = text.width();
    if used <= width {
        return text + &" ".repeat(width - used);
    }
    let mut cut = pieces(&text, width - 1).swap_remove(0);
    cut.push('~');
    let used = cut.width();
    cut + &" ".repeat(width.saturating_sub(used))
}

/// The same, padded at its left.
fn right(text: &str, width: usize) -> String {
    let text = fit(text, width);
    let words = text.trim_end();
    " ".repeat(width.saturating_sub(words.width())) + words
}

/// A word in pieces of at most `room` columns; marks stay with the letter they belong to.
fn pieces(word: &str, room: usize) -> Vec<String> {
    let mut pieces = vec![String::new()];
    let mut used = 0;
    for c in word.chars() {
        let width = c.width().unwrap_or(0);
        if used > 0 && used + width > room {
            pieces.push(String::new());
            used = 0;
        }
        used += width;
        if let Some(piece) = pieces.last_mut() {
            piece.push(c);
        }
    }
    pieces
}

#[cfg(test)]
mod tests;
