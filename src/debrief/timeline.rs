//! The events in order: commands, mistakes, and answers to alerts.

use super::layout::clock;
use super::{DebriefPage, DebriefTone};
use crate::ledger::RowState;
use crate::pilot_in_command::Person;
use crate::scoring::{
    AlertReport, EventKind, EventReport, EventSubject, LedgerReport, Report, RowReport,
};
use crate::text;
use crate::text::Text;
use std::collections::BTreeMap;

/// The width of the time strip, in columns.
const STRIP: usize = 60;
/// With more rows than this, commands in succession share a row of the timeline.
const ROWS: usize = 40;
/// The highest number of commands that a cell of the time strip counts.
const COUNTED: usize = 9;

/// The subject of a row. Later marks are drawn over earlier ones in the time strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TimelineMark {
    /// A fact that explains the flight, neither good nor bad.
    Remark,
    /// A command that was accepted.
    Command,
    Objective,
    Alert,
    /// A command that was refused.
    Rejected,
    /// A safety rule was broken.
    Rule,
}

impl TimelineMark {
    const ALL: [Self; 6] = [
        Self::Remark,
        Self::Command,
        Self::Objective,
        Self::Alert,
        Self::Rejected,
        Self::Rule,
    ];

    fn of(kind: EventKind) -> Self {
        match kind {
            EventKind::Objective => Self::Objective,
            EventKind::Alert => Self::Alert,
            EventKind::Rule => Self::Rule,
            EventKind::Rejected => Self::Rejected,
            EventKind::Answer
            | EventKind::Hint
            | EventKind::Phase
            | EventKind::Sample
            | EventKind::Load
            | EventKind::Pause
            | EventKind::MissionEvent
            | EventKind::Inject => Self::Remark,
        }
    }

    /// The letter for this mark.
    fn letter(self) -> char {
        match self {
            Self::Remark => '.',
            Self::Command => '>',
            Self::Objective => 'o',
            Self::Alert => '!',
            Self::Rejected => 'r',
            Self::Rule => 'x',
        }
    }
}

/// A cell of the time strip: the most serious mark in its part of the flight.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StripCell {
    pub mark: TimelineMark,
    /// The number of rows with this mark.
    count: usize,
}

impl StripCell {
    /// The letter for the mark, or the number of several commands.
    pub fn letter(self) -> char {
        let number = char::from_digit(self.count.min(COUNTED) as u32, 10);
        match self.mark {
            TimelineMark::Command if self.count > 1 => number.unwrap_or_default(),
            mark => mark.letter(),
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
struct TimelineRow {
    at_s: f64,
    mark: TimelineMark,
    /// The index of the refused command in the report.
    refused: Option<usize>,
    /// The person who gave the command; `None` for the owner of the record.
    giver: Option<Person>,
    text: Text,
}

impl TimelineRow {
    /// The text, after the name of the giver.
    fn said(self) -> Text {
        Person::said(self.giver.as_ref(), self.text)
    }
}

impl DebriefPage<'_> {
    pub(super) fn timeline(&mut self, report: &Report) {
        self.heading("debrief-timeline");
        let rows = rows(report);
        let end = clock(report.sim_time_s);
        let strip: String = cells_along(&rows, report.sim_time_s, STRIP)
            .into_iter()
            .map(|cell| cell.map_or('-', StripCell::letter))
            .collect();
        self.line(&format!("  00:00 |{strip}| {end}"));
        self.toned(DebriefTone::Plain);
        for row in shortened(rows) {
            let mark = row.mark;
            let lead = format!("   {} {} ", clock(row.at_s), mark.letter());
            self.wrapped(&lead, &row.said());
            self.toned(DebriefTone::Event(mark));
        }
        self.gap();
    }
}

fn rows(report: &Report) -> Vec<TimelineRow> {
    // An alert has its own row, with its time and its answer.
    let is_own = |event: &&EventReport| !matches!(event.about, Some(EventSubject::Alert(_)));
    let events = report.events.iter().filter(is_own);
    let mut rows: Vec<TimelineRow> = events.map(|event| event_row(event, report)).collect();
    rows.extend(report.alerts.iter().map(alert_row));
    rows.extend(report.ledger.iter().filter_map(command_row));
    rows.sort_by(|a, b| a.at_s.total_cmp(&b.at_s));
    together(&rows)
}

/// Merges refusals of one command with the same reason: one row per reason, with the number of vehicles.
fn together(rows: &[TimelineRow]) -> Vec<TimelineRow> {
    let refusals = rows.chunk_by(|a, b| a.refused.is_some() && a == b);
    let row = |same: &[TimelineRow]| {
        let first = same.first()?.clone();
        Some(if same.len() > 1 {
            TimelineRow {
                text: text!("debrief-to-many", what = first.text, count = same.len()),
                ..first
            }
        } else {
            first
        })
    };
    refusals.filter_map(row).collect()
}

/// The rows, with commands in succession as one row if there are too many.
fn shortened(rows: Vec<TimelineRow>) -> Vec<TimelineRow> {
    if rows.len() <= ROWS {
        return rows;
    }
    let is_command = |row: &TimelineRow| row.mark == TimelineMark::Command;
    let runs = rows.chunk_by(|a, b| is_command(a) && is_command(b));
    let row = |run: &[TimelineRow]| {
        let (first, last) = (run.first()?.clone(), run.last()?);
        Some(if run.len() > 1 {
            let until = clock(last.at_s);
            let commands = text!("debrief-commands", count = run.len(), until = until);
            TimelineRow {
                text: match shares(run) {
                    Some(shares) => text!("debrief-shares", commands = commands, shares = shares),
                    None => commands,
                },
                giver: None,
                ..first
            }
        } else {
            first
        })
    };
    runs.filter_map(row).collect()
}

/// How many of the commands each person other than the owner of the record gave, by name; `None`
/// if the owner gave all of them.
fn shares(run: &[TimelineRow]) -> Option<Text> {
    let mut counts: BTreeMap<&Person, usize> = BTreeMap::new();
    for person in run.iter().filter_map(|row| row.giver.as_ref()) {
        *counts.entry(person).or_default() += 1;
    }
    let share = |(person, count): (&Person, usize)| {
        text!("debrief-share", count = count, person = person.name())
    };
    let shares: Vec<Text> = counts.into_iter().map(share).collect();
    (!shares.is_empty()).then(|| Text::joined(", ", shares))
}

fn alert_row(alert: &AlertReport) -> TimelineRow {
    let limit = format!("{:.0}", alert.limit_s);
    let text = match alert.answered_after_s {
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
    TimelineRow {
        at_s: alert.at_s,
        mark: TimelineMark::Alert,
        refused: None,
        giver: None,
        text,
    }
}

/// The most serious mark in each of `parts` equal parts of the flight.
pub fn strip(report: &Report, parts: usize) -> Vec<Option<StripCell>> {
    cells_along(&rows(report), report.sim_time_s, parts)
}

fn cells_along(rows: &[TimelineRow], length_s: f64, parts: usize) -> Vec<Option<StripCell>> {
    let mut strip: Vec<Option<StripCell>> = vec![None; parts];
    let Some(last) = parts.checked_sub(1) else {
        return strip;
    };
    let length_s = length_s.max(0.1);
    for mark in TimelineMark::ALL {
        for row in rows.iter().filter(|row| row.mark == mark) {
            let at = (row.at_s / length_s * last as f64).round() as usize;
            let cell = &mut strip[at.min(last)];
            let before = cell.filter(|cell| cell.mark == mark);
            let count = before.map_or(0, |cell| cell.count) + 1;
            *cell = Some(StripCell { mark, count });
        }
    }
    strip
}

fn event_row(event: &EventReport, report: &Report) -> TimelineRow {
    let mark = TimelineMark::of(event.kind);
    let refused = match event.about {
        Some(EventSubject::Command(command)) => Some(command),
        Some(EventSubject::Alert(_)) | None => None,
    };
    let entry = refused.and_then(|command| report.ledger.get(command));
    let text = match event.vehicle.filter(|_| mark != TimelineMark::Rejected) {
        Some(vehicle) => text!("debrief-drone", vehicle = vehicle, what = &event.text),
        None => event.text.clone(),
    };
    TimelineRow {
        at_s: event.at_s,
        mark,
        refused,
        giver: entry.and_then(|entry| entry.by.clone()),
        text,
    }
}

/// The row of a command that at least one vehicle neither refused nor left unanswered; `None`
/// otherwise, since a refusal has its own row.
fn command_row(entry: &LedgerReport) -> Option<TimelineRow> {
    let not_taken = |state| {
        matches!(
            state,
            RowState::Refused | RowState::Barred | RowState::TimedOut
        )
    };
    let is_taken = |row: &&RowReport| !not_taken(row.state);
    let taken = entry.rows.iter().find(is_taken)?;
    let outcome = if entry.rows.iter().all(|row| is_taken(&row)) {
        taken.state.text()
    } else {
        counted(&entry.rows)
    };
    let words = vec![entry.line.as_str().into(), outcome];
    Some(TimelineRow {
        at_s: entry.at_s,
        mark: TimelineMark::Command,
        refused: None,
        giver: entry.by.clone(),
        text: Text::joined(": ", words),
    })
}

/// The number of vehicles in each state, in the order of the vehicles.
fn counted(rows: &[RowReport]) -> Text {
    let mut counts: Vec<(Text, usize)> = Vec::new();
    for row in rows {
        let state = row.state.name();
        match counts.iter_mut().find(|(known, _)| *known == state) {
            Some((_, count)) => *count += 1,
            None => counts.push((state, 1)),
        }
    }
    let counts = counts.into_iter();
    let parts = counts.map(|(state, count)| text!("state-count", count = count, state = state));
    Text::joined(", ", parts.collect())
}

/// The times and letters of the marks, for tests.
#[cfg(test)]
pub(super) fn marks(report: &Report) -> Vec<(String, char)> {
    let rows = rows(report).into_iter();
    rows.map(|row| (clock(row.at_s), row.mark.letter()))
        .collect()
}
