//! The debrief: a report as plain text for people, 80 columns wide at most.
//!
//! Every loss of points names what moved it; improvements stand by the size of their gain.

use std::fmt::Write as _;

use crate::notice::sanitised;
use crate::scoring::{EventReport, LedgerReport, Report};

/// Columns of the page.
const WIDTH: usize = 80;
/// Columns of the strip of time.
const STRIP: usize = 60;
/// Rows of the timeline; when there are more, the commands that went well are left out.
const ROWS: usize = 40;

/// The debrief of a report.
pub fn text(report: &Report) -> String {
    let mut page = String::new();
    head(&mut page, report);
    objectives(&mut page, report);
    components(&mut page, report);
    timeline(&mut page, report);
    improvements(&mut page, report);
    // A stored report may hold anything; the page stays as wide as it is.
    let cut = |line: &str| fit(line, WIDTH).trim_end().to_owned();
    let lines: Vec<String> = page.lines().map(cut).collect();
    lines.join("\n") + "\n"
}

fn head(page: &mut String, report: &Report) {
    let rule = format!("+{}+\n", "=".repeat(WIDTH - 2));
    let medal = report
        .medal
        .map_or("no medal".to_owned(), |medal| medal.name().to_uppercase());
    let outcome = report.outcome.to_uppercase();
    let first = format!(
        "DEBRIEF  {} r{}   {}   {outcome}",
        report.mission, report.revision, report.title
    );
    let second = format!(
        "Score {} / 1000   grade {}   {medal}   seed {}   {}",
        report.score, report.grade, report.seed, report.backend
    );
    page.push_str(&rule);
    for line in [first, second] {
        let _ = writeln!(page, "| {} |", fit(&line, WIDTH - 4));
    }
    page.push_str(&rule);
    let energy = report.energy_wh.map_or("not reported".to_owned(), |wh| {
        format!("{wh:.1} Wh (par {:.1})", report.par_energy_wh)
    });
    let _ = writeln!(
        page,
        " Time {} (par {}, limit {})   Energy {energy}   Drones {}\n",
        clock(report.sim_time_s),
        clock(report.par_time_s),
        clock(report.time_limit_s),
        report.vehicles
    );
}

fn objectives(page: &mut String, report: &Report) {
    let _ = writeln!(
        page,
        " OBJECTIVES {:26} result        target      points",
        ""
    );
    for objective in &report.objectives {
        let _ = writeln!(
            page,
            "  [{}] {} {} {} {} {:.1}/{:.0}",
            if objective.met { 'x' } else { ' ' },
            fit(&objective.id, 8),
            fit(&objective.title, 22),
            fit(&objective.result, 13),
            fit(&objective.target, 11),
            objective.points,
            objective.points_max,
        );
    }
    page.push('\n');
}

fn components(page: &mut String, report: &Report) {
    let _ = writeln!(
        page,
        " COMPONENTS    weight  value   points   what moved it"
    );
    for component in &report.components {
        let lead = format!(
            "  {:<12} {:>6.3} {:>6.3} {:>8.1}   ",
            component.name, component.weight, component.value, component.points
        );
        wrapped(page, &lead, &component.moved_by);
    }
    let subtotal: f64 = report
        .components
        .iter()
        .map(|component| component.points)
        .sum();
    let gold = if report.gold_missing.is_empty() {
        String::new()
    } else {
        format!("gold needs {}", report.gold_missing.join(", "))
    };
    let _ = writeln!(page, "{:28} --------", "");
    wrapped(
        page,
        &format!("  score {:>4}{:17}{subtotal:>8.1}   ", report.score, ""),
        &gold,
    );
    page.push('\n');
}

fn timeline(page: &mut String, report: &Report) {
    page.push_str(" TIMELINE   (> command  o objective  ! alert  x rule broken  r rejected)\n");
    let mut rows: Vec<(f64, char, String)> = report.events.iter().map(event_row).collect();
    if rows.len() + report.ledger.len() <= ROWS {
        rows.extend(report.ledger.iter().filter_map(command_row));
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut strip = vec!['-'; STRIP];
    let length_s = report.sim_time_s.max(0.1);
    // Plain commands first: what matters more is drawn over them.
    for mark in ['>', '.', 'o', '!', 'r', 'x'] {
        for (at_s, _, _) in rows.iter().filter(|(_, shown, _)| *shown == mark) {
            let at = (at_s / length_s * (STRIP - 1) as f64).round() as usize;
            strip[at.min(STRIP - 1)] = mark;
        }
    }
    let strip: String = strip.into_iter().collect();
    let _ = writeln!(page, "  00:00 |{strip}| {}", clock(report.sim_time_s));
    for (at_s, mark, words) in &rows {
        wrapped(page, &format!("   {} {mark} ", clock(*at_s)), words);
    }
    page.push('\n');
}

fn event_row(event: &EventReport) -> (f64, char, String) {
    let mark = match event.kind.as_str() {
        "objective" => 'o',
        "alert" => '!',
        "rule" => 'x',
        "rejected" => 'r',
        _ => '.',
    };
    let words = match event.vehicle.filter(|_| mark != 'r') {
        Some(vehicle) => format!("drone {vehicle}: {}", event.text),
        None => event.text.clone(),
    };
    (event.at_s, mark, words)
}

/// A command that at least one vehicle took; a rejection has a row of its own.
fn command_row(entry: &LedgerReport) -> Option<(f64, char, String)> {
    let row = entry
        .rows
        .iter()
        .find(|row| row.state != "refused" && row.state != "timed out")?;
    Some((entry.at_s, '>', format!("{}: {}", entry.line, row.state)))
}

fn improvements(page: &mut String, report: &Report) {
    page.push_str(" WHAT TO IMPROVE   (biggest gain first)\n");
    if report.improvements.is_empty() {
        page.push_str("  Nothing that would bring another point.\n");
    }
    for improvement in &report.improvements {
        wrapped(
            page,
            &format!("  {:>4}  ", format!("+{}", improvement.points)),
            &improvement.text,
        );
    }
    let good = report
        .components
        .iter()
        .filter(|component| component.value >= 0.95)
        .max_by(|a, b| a.points.total_cmp(&b.points));
    if let Some(good) = good {
        wrapped(
            page,
            "  good  ",
            &format!("{}: {}", good.name, good.moved_by),
        );
    }
}

/// Minutes and seconds; tenths are cut off.
fn clock(seconds: f64) -> String {
    let whole = seconds.max(0.0) as u64;
    format!("{:02}:{:02}", whole / 60, whole % 60)
}

/// Text of exactly `width` columns: padded, or cut with a mark.
fn fit(text: &str, width: usize) -> String {
    let text = sanitised(text);
    if text.chars().count() <= width {
        return format!("{text:<width$}");
    }
    let cut: String = text.chars().take(width - 1).collect();
    cut + "~"
}

/// Writes text behind a lead, broken between words to the page's width, later lines indented to the lead's end.
fn wrapped(page: &mut String, lead: &str, text: &str) {
    let indent = lead.chars().count();
    let room = WIDTH.saturating_sub(indent).max(1);
    page.push_str(lead);
    let mut column = 0;
    for word in sanitised(text).split_whitespace() {
        // A word longer than a line is broken anywhere.
        for piece in pieces(word, room) {
            let width = piece.chars().count();
            if column > 0 && column + 1 + width > room {
                let _ = write!(page, "\n{:indent$}", "");
                column = 0;
            }
            if column > 0 {
                page.push(' ');
                column += 1;
            }
            page.push_str(&piece);
            column += width;
        }
    }
    page.push('\n');
}

fn pieces(word: &str, room: usize) -> Vec<String> {
    let letters: Vec<char> = word.chars().collect();
    letters
        .chunks(room)
        .map(|piece| piece.iter().collect())
        .collect()
}

#[cfg(test)]
mod tests;
