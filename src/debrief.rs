//! The debrief: a report as plain text, at most 80 columns wide.
//!
//! Every loss of points is shown with its causes; improvements are ordered by their gain, as in `scoring`
//! (`scoring::advice`).
//!
//! # How the parts fit
//! - Why the points were lost: `points`. What happened: `timeline`. Where: `map`.
//! - How the trainee did: `tries` (own attempts), `workload` and `swarm` (shown, not scored).
//! - The page: `line` and `layout`.

use std::fmt::Write as _;

use unicode_width::UnicodeWidthStr as _;

use crate::notice::sanitised;
use crate::scoring::{FlightBackend, FlownBy, Medal, MissionFile, Report};
use crate::text;
use crate::text::{Locale, Text, wrap};

mod layout;
mod line;
mod map;
mod points;
mod swarm;
mod timeline;
mod tries;
mod workload;

pub use line::{DebriefLine, DebriefTone};
pub use timeline::{StripCell, TimelineMark, strip};
pub use workload::{WorkloadStrips, workload_words};

pub use layout::fit;
use layout::{clock, pieces};

/// The width of the page in columns.
pub const WIDTH: usize = 80;
/// The debrief of a report, in the language of the locale.
pub fn text(report: &Report, locale: &Locale) -> String {
    let page = lines_with(report, &DebriefCareer::default(), locale).into_iter();
    let lines: Vec<String> = page.map(|line| line.text).collect();
    lines.join("\n") + "\n"
}

/// The causes of the score and the improvements: the part of the page that explains the result, in
/// at most `width` columns, and never more than [`WIDTH`].
pub fn explanation(report: &Report, locale: &Locale, width: usize) -> Vec<DebriefLine> {
    let mut page = DebriefPage::new(locale);
    page.width = width.min(WIDTH);
    page.components(report);
    page.improvements(report);
    page.finished()
}

/// A career's part of the page.
#[derive(Debug, Clone, Default)]
pub struct DebriefCareer {
    /// The changes that the flight made to the career, most important first; shown before the
    /// explanation of the score.
    pub changes: Vec<Text>,
    /// The next flight in the career, suggested once nothing is left to improve; `None` without a
    /// career.
    pub next: Option<Text>,
}

/// The page line by line, for screens that show the tone of each line.
pub fn lines_with(report: &Report, career: &DebriefCareer, locale: &Locale) -> Vec<DebriefLine> {
    let mut page = DebriefPage::new(locale);
    page.head(report);
    page.instructor(report);
    page.objectives(report);
    page.career(&career.changes);
    page.components(report);
    page.timeline(report);
    page.improvements(report);
    page.swarm(report);
    page.workload(report);
    page.map(&report.truth);
    page.tries(report);
    page.next(report, career.next.as_ref());
    page.finished()
}

struct DebriefPage<'a> {
    words: String,
    tones: Vec<DebriefTone>,
    locale: &'a Locale,
    width: usize,
}

impl<'a> DebriefPage<'a> {
    fn new(locale: &'a Locale) -> Self {
        Self {
            words: String::new(),
            tones: Vec::new(),
            locale,
            width: WIDTH,
        }
    }

    /// Ends the page: its lines, each cut to the page's width.
    fn finished(self) -> Vec<DebriefLine> {
        // A stored report may contain any text; the page keeps its width.
        let cut = |line: &str| fit(line, self.width).trim_end().to_owned();
        let given = self.tones.iter().copied();
        let tones = given.chain(std::iter::repeat(DebriefTone::Plain));
        let lines = self.words.lines().zip(tones);
        lines
            .map(|(line, tone)| DebriefLine {
                text: cut(line),
                tone,
            })
            .collect()
    }
}

/// The source of the flight: the mission's file and revision, its seed, and the simulator of the vehicles.
pub fn source(report: &Report) -> Text {
    text!(
        "debrief-source",
        mission = &report.mission,
        revision = report.revision,
        seed = report.seed.to_string(),
        backend = backend_title(report)
    )
}

fn backend_title(report: &Report) -> Text {
    match report.backend {
        FlightBackend::Embedded => text!("debrief-embedded"),
        FlightBackend::ArduPilot => report.backend.name().into(),
    }
}

impl DebriefPage<'_> {
    fn line(&mut self, line: &str) {
        self.words.push_str(line);
        self.words.push('\n');
    }

    fn head(&mut self, report: &Report) {
        let rule = format!("+{}+", "=".repeat(WIDTH - 2));
        let medal = match report.medal {
            Some(medal) => self.locale.text(&medal.title()).to_uppercase(),
            None => self.locale.say("debrief-no-medal"),
        };
        let first = text!(
            "debrief-head",
            mission = &report.mission,
            revision = report.revision,
            title = &report.title,
            outcome = self.locale.text(&report.outcome.title()).to_uppercase()
        );
        let second = text!(
            "debrief-score",
            score = report.score,
            medal = medal,
            seed = report.seed.to_string(),
            backend = backend_title(report)
        );
        self.line(&rule);
        for line in [first, second] {
            // A long title gets a separate line, so that the outcome stays visible.
            let words = sanitised(&self.locale.text(&line));
            let lines = if words.width() > WIDTH - 4 {
                wrap(&words, WIDTH - 4)
            } else {
                vec![words]
            };
            for line in lines {
                self.line(&format!("| {} |", fit(&line, WIDTH - 4)));
            }
        }
        self.line(&rule);
        self.toned(DebriefTone::Head);
        self.spent(report);
    }

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
        let line = format!(" {}", self.locale.text(&spent));
        self.line(&line);
        self.origin(report);
        self.said_before(report);
        self.gap();
    }

    /// Writes the source of the commands (a person, a script or the bundled pilot), and whether the
    /// mission differs from that of the course.
    fn origin(&mut self, report: &Report) {
        let flown_by = report.flown_by.map(|flown_by| match flown_by {
            FlownBy::Hand => text!("debrief-by-hand"),
            FlownBy::Script => text!("debrief-by-script"),
            FlownBy::BundledPilot => text!("debrief-by-bundled-pilot"),
        });
        let mission_file = report.mission_file.and_then(|file| match file {
            MissionFile::Course => None,
            MissionFile::Own => Some(text!("debrief-own-mission", mission = &report.mission)),
            MissionFile::OtherRevision => Some(text!(
                "debrief-other-revision",
                mission = &report.mission,
                revision = report.revision
            )),
            MissionFile::Altered => Some(text!(
                "debrief-altered-mission",
                mission = &report.mission,
                revision = report.revision
            )),
        });
        let names = report.crew.join(", ");
        let has_own = report.ledger.iter().any(|entry| entry.by.is_none());
        let crew = (!report.crew.is_empty()).then(|| {
            if has_own {
                text!("debrief-crew-also", names = names)
            } else {
                text!("debrief-crew", names = names)
            }
        });
        for text in flown_by.into_iter().chain(crew).chain(mission_file) {
            self.wrapped(" ", &text);
        }
    }

    /// Writes what an instructor did in the flight.
    fn instructor(&mut self, report: &Report) {
        if report.instructor.is_empty() {
            return;
        }
        self.heading("debrief-instructor");
        for act in report.instructor.acts() {
            self.wrapped("  ", &act.text());
        }
        self.gap();
    }

    /// Writes the attempt, the cost of hints, and the trainee's prediction and goal from before the launch.
    fn said_before(&mut self, report: &Report) {
        let count = report.hints.len();
        if report.attempt > 1 || count > 0 {
            let factor = format!("{:.2}", report.hint_factor);
            let text = text!(
                "debrief-try",
                attempt = report.attempt,
                count = count,
                factor = factor
            );
            self.wrapped(" ", &text);
        }
        if let Some(prediction) = report.prediction {
            let (predicted, by) = (prediction.predicted, prediction.error.unsigned_abs());
            let text = match prediction.error {
                0 => text!("debrief-predicted-right", predicted = predicted),
                1.. => text!("debrief-predicted-less", predicted = predicted, by = by),
                _ => text!("debrief-predicted-more", predicted = predicted, by = by),
            };
            self.wrapped(" ", &text);
        }
        if let Some(goal) = &report.goal {
            let (what, result) = (&goal.text, &goal.result);
            let text = if goal.reached {
                text!("debrief-goal-reached", goal = what, result = result)
            } else {
                text!("debrief-goal-missed", goal = what, result = result)
            };
            self.wrapped(" ", &text);
        }
    }

    fn gap(&mut self) {
        self.words.push('\n');
    }

    fn career(&mut self, lines: &[Text]) {
        if lines.is_empty() {
            return;
        }
        self.heading("debrief-career");
        for line in lines {
            self.wrapped("  ", line);
        }
        self.gap();
    }

    /// Writes the most useful next step.
    fn next(&mut self, report: &Report, in_career: Option<&Text>) {
        self.heading("debrief-next");
        if let Some(onwards) = in_career.filter(|_| report.passed) {
            self.wrapped("  ", onwards);
        }
        let improvement = report.improvements.first().map(|first| &first.text);
        // After gold, no improvement is left in this mission.
        let first = improvement.filter(|_| report.medal != Some(Medal::Gold));
        let text = match (&report.drill, first) {
            (Some(drill), Some(what)) if !report.passed => {
                text!("debrief-next-drill", drill = drill, what = what)
            }
            (_, Some(what)) => text!("debrief-next-again", what = what),
            // A flight that never took off has no improvements.
            (_, None) if !report.passed => text!("debrief-next-same"),
            (_, None) => match points::gold_missing(report) {
                Some(gates) => text!("debrief-next-gold", gates = gates),
                None if in_career.is_some() => return,
                None => text!("debrief-next-on"),
            },
        };
        self.wrapped("  ", &text);
    }

    /// Writes text after a lead, wrapped at words to the page's width, with later lines indented to the end of the
    /// lead.
    fn wrapped(&mut self, lead: &str, text: &Text) {
        let indent = lead.width();
        let room = self.width.saturating_sub(indent).max(1);
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

#[cfg(test)]
mod tests;
