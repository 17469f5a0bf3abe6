//! What happened, in its order: commands, events, mistakes, and how alerts were answered.

use super::Page;
use super::layout::clock;
use crate::scoring::{AlertReport, EventReport, LedgerReport, Report};
use crate::text;
use crate::text::Text;

/// Columns of the strip of time.
const STRIP: usize = 60;
/// Rows of the timeline; when there are more, the commands that went well are left out.
const ROWS: usize = 40;

/// When, the mark, and the words.
type Row = (f64, char, Text);

impl Page<'_> {
    pub(super) fn timeline(&mut self, report: &Report) {
        self.heading("debrief-timeline");
        let events = report.events.iter();
        let events = events.filter(|event| !report.alerts.iter().any(|alert| is_of(event, alert)));
        let mut rows: Vec<Row> = events.map(event_row).collect();
        rows.extend(report.alerts.iter().map(alert_row));
        if rows.len() + report.ledger.len() <= ROWS {
            rows.extend(report.ledger.iter().filter_map(command_row));
        }
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        let rows = together(&rows);
        let end = clock(report.sim_time_s);
        let strip = strip(&rows, report.sim_time_s);
        self.line(&format!("  00:00 |{strip}| {end}"));
        for (at_s, mark, words) in &rows {
            self.wrapped(&format!("   {} {mark} ", clock(*at_s)), words);
        }
        self.gap();
    }
}

/// A command to many is refused to each of them: one row that says to how many.
fn together(rows: &[Row]) -> Vec<Row> {
    let same = rows.chunk_by(|a, b| a == b);
    let row = |same: &[Row]| {
        let (at_s, mark, words) = same.first()?.clone();
        let words = match same.len() {
            many @ 2.. if mark == 'r' => text!("debrief-to-many", what = words, count = many),
            _ => words,
        };
        Some((at_s, mark, words))
    };
    same.filter_map(row).collect()
}

/// Whether an event only says that the alert came, or that it was answered: its row tells both.
fn is_of(event: &EventReport, alert: &AlertReport) -> bool {
    event.kind == "answer"
        || event.kind == "alert"
            && event.text == alert.text
            && (event.at_s - alert.at_s).abs() < 0.05
}

/// What came and what was done about it, and only then whether that was soon enough.
fn alert_row(alert: &AlertReport) -> Row {
    let limit = format!("{:.0}", alert.limit_s);
    let words = match alert.answered_after_s {
        None => text!("debrief-alert-none", alert = &alert.text, limit = limit),
        Some(after) => {
            let after = format!("{after:.0}");
            if alert.in_time {
                text!("debrief-alert-good", alert = &alert.text, after = after)
            } else {
                text!(
                    "debrief-alert-late",
                    alert = &alert.text,
                    after = after,
                    limit = limit
                )
            }
        }
    };
    (alert.at_s, '!', words)
}

/// The marks of what happened, along the time of the flight.
fn strip(rows: &[Row], length_s: f64) -> String {
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

fn event_row(event: &EventReport) -> Row {
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
fn command_row(entry: &LedgerReport) -> Option<Row> {
    let row = entry
        .rows
        .iter()
        .find(|row| row.state != "refused" && row.state != "timed out")?;
    let words = vec![entry.line.as_str().into(), row.state.clone()];
    Some((entry.at_s, '>', Text::joined(": ", words)))
}
