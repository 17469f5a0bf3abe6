//! The operator's workload as time strips. It is shown, but not scored.

use std::time::Duration;

use super::layout::{clock, fit};
use super::{DebriefPage, WIDTH};
use crate::scoring::{Report, WorkloadReport};
use crate::text;
use crate::text::{Locale, Text};

/// Columns before a strip, and the width of its longest label.
const LEAD: usize = 2;
const LABEL: usize = 11;
const STRIP: usize = 60;
/// Utilisation is shown in whole tenths, at most 9.
const TENTHS: f64 = 10.0;
const MINUTE_S: f64 = 60.0;

/// The curves of the workload as lines of text, one above the other.
#[derive(Debug, Clone, Copy)]
pub struct WorkloadStrips<'a> {
    pub workload: &'a WorkloadReport,
    /// The columns available for a line.
    pub width: usize,
    /// The mission time marked by the cursor.
    pub cursor: Option<Duration>,
    pub locale: &'a Locale,
}

impl WorkloadStrips<'_> {
    /// One line per curve, one for the answers if there are any, and the times below.
    pub fn lines(&self) -> Vec<String> {
        let workload = self.workload;
        let tenths = |share: &f64| digit((share * TENTHS).min(9.0) as u32);
        let busy: Vec<char> = workload.utilisation.iter().map(tenths).collect();
        let counts = workload.waiting.iter();
        let waiting: Vec<char> = counts.map(|count| digit(u32::from(*count))).collect();
        let mut lines = vec![
            self.line("workload-busy", &self.spread(&busy)),
            self.line("workload-alone", &self.spread(&self.alone())),
            self.line("workload-waiting", &self.spread(&waiting)),
        ];
        if !workload.answers.is_empty() {
            lines.push(self.line("workload-answers", &self.answers()));
        }
        lines.push(self.scale());
        lines
    }

    /// Neglect: the average number of vehicles that worked without attention in the last minute.
    fn alone(&self) -> Vec<char> {
        let neglect_s = &self.workload.neglect_s;
        let points = (MINUTE_S / self.workload.every_s.max(1.0)) as usize;
        let mean = |(at, now_s): (usize, &f64)| {
            let from = at.saturating_sub(points);
            let passed_s = (at - from).max(1) as f64 * self.workload.every_s;
            digit(((now_s - neglect_s[from]) / passed_s.max(1.0)).round() as u32)
        };
        neglect_s.iter().enumerate().map(mean).collect()
    }

    fn cells(&self) -> usize {
        let around = LEAD + LABEL + 2;
        self.width.saturating_sub(around).clamp(1, STRIP)
    }

    fn line(&self, label: &str, strip: &str) -> String {
        let label = fit(&self.locale.say(label), LABEL);
        format!("{:LEAD$}{label}|{strip}|", "")
    }

    /// The points spread over the whole strip; a cell shows the highest of its points.
    fn spread(&self, points: &[char]) -> String {
        let (cells, count) = (self.cells(), points.len());
        let of = |cell: usize| {
            let from = cell * count / cells;
            let to = ((cell + 1) * count / cells).max(from + 1).min(count);
            let here = points.get(from..to).unwrap_or_default();
            here.iter().copied().max().unwrap_or(' ')
        };
        (0..cells).map(of).collect()
    }

    fn answers(&self) -> String {
        let mut strip = vec![' '; self.cells()];
        for answer in &self.workload.answers {
            let cell = self.cell(answer.at_s);
            strip[cell] = digit(u32::from(answer.level));
        }
        strip.into_iter().collect()
    }

    /// The times at the ends, or a mark at the cursor.
    fn scale(&self) -> String {
        let end_s = self.end_s();
        let cells = self.cells();
        let indent = LEAD + LABEL + 1;
        let Some(cursor) = self.cursor else {
            let room = cells.saturating_sub(5);
            return format!("{:indent$}00:00{:>room$}", "", clock(end_s));
        };
        let cell = self.cell(cursor.as_secs_f64());
        format!("{:indent$}{:cell$}^", "", "")
    }

    fn cell(&self, at_s: f64) -> usize {
        let share = (at_s / self.end_s()).clamp(0.0, 1.0);
        let cells = self.cells();
        ((share * cells as f64) as usize).min(cells - 1)
    }

    /// The time of the last point in seconds, never 0.
    fn end_s(&self) -> f64 {
        let points = self.workload.utilisation.len().max(2) - 1;
        (self.workload.every_s * points as f64).max(1.0)
    }
}

/// A figure in one column: a dot for zero, a tilde for more than nine.
fn digit(value: u32) -> char {
    match char::from_digit(value, 10) {
        Some('0') => '.',
        Some(digit) => digit,
        None => '~',
    }
}

/// The figures of the workload that its curves do not show, as sentences.
pub fn workload_words(report: &Report) -> Vec<Text> {
    let workload = &report.workload;
    let last = |times: &[f64]| format!("{:.0}", times.last().copied().unwrap_or(0.0));
    let mut words = vec![text!(
        "workload-figures",
        commands = workload.commands,
        interaction = last(&workload.interaction_s),
        neglect = last(&workload.neglect_s),
        wait = last(&workload.wait_s),
        who = report.commanders()
    )];
    if !workload.overloaded.is_empty() {
        let stretches: Vec<String> = workload
            .overloaded
            .iter()
            .map(|it| format!("{}-{}", clock(it.from_s), clock(it.to_s)))
            .collect();
        words.push(text!(
            "workload-overloaded",
            stretches = stretches.join(", ")
        ));
    }
    if !workload.answers.is_empty() {
        let questions = workload.questions().max(workload.answers.len());
        words.push(text!(
            "workload-answered",
            answers = workload.answers.len(),
            questions = questions
        ));
    }
    words
}

impl DebriefPage<'_> {
    /// Writes the workload, only for flights with a command or an answer.
    pub(super) fn workload(&mut self, report: &Report) {
        let workload = &report.workload;
        if workload.commands == 0 && workload.answers.is_empty() {
            return;
        }
        self.heading("debrief-workload");
        let strips = WorkloadStrips {
            workload,
            width: WIDTH,
            cursor: None,
            locale: self.locale,
        };
        for line in strips.lines() {
            self.line(&line);
        }
        self.wrapped("  ", &text!("workload-how"));
        for words in workload_words(report) {
            self.wrapped("  ", &words);
        }
        self.gap();
    }
}
