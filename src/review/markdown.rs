//! A review as a Markdown document.

use std::fmt::Write as _;

use super::{PointKind, Review};
use crate::debrief::{self, explanation};
use crate::moment::{Moment, MomentKind};
use crate::notice::sanitised;
use crate::record::MissionClock;
use crate::scoring::Report;
use crate::text;
use crate::text::{Locale, Text, clock, reflow};
use crate::vehicle_id::ranges;

/// The flight that a review is about.
#[derive(Debug, Clone, Copy)]
pub struct ReviewedFlight<'a> {
    /// The title of the mission, or the name of a recording.
    pub title: &'a str,
    /// The time of day of its beginning, in UTC.
    pub began: &'a str,
    /// The mission's brief; `None` if no mission was flown.
    pub brief: Option<&'a Text>,
    /// The result, if a mission was flown.
    pub report: Option<&'a Report>,
    /// The moments of the flight, earliest first.
    pub moments: &'a [Moment],
    /// The mission's clock, by which the page shows times; empty without a mission.
    pub clock: &'a MissionClock,
}

/// A review in a language: the four questions, their answers, and the explanation of the score if the pilot has
/// answered.
pub fn markdown(review: &Review, flight: ReviewedFlight<'_>, locale: &Locale) -> String {
    let mut page = MarkdownPage {
        words: String::new(),
        locale,
    };
    let title = locale.text(&text!("review-title", flight = flight.title));
    page.heading(1, &title);
    page.paragraph(&format!("{} UTC", flight.began));
    if let Some(report) = flight.report {
        page.flown(report, review.profile.as_deref());
        page.planned(report, flight.brief);
    }
    page.happened(flight);
    if let Some(report) = flight.report {
        page.workload(report);
    }
    page.answer("review-why", &review.why);
    page.answer("review-next", &review.next);
    page.points(review, flight.clock);
    if let Some(report) = flight.report.filter(|_| review.is_answered()) {
        page.explained(report);
    }
    page.words
}

/// A moment in words: its kind and its vehicles, unless its text gives them.
fn told(moment: &Moment) -> Text {
    let vehicles = ranges(moment.vehicles.iter().copied());
    let parts = match moment.kind {
        MomentKind::Objective => return moment.text.clone(),
        // The text is the command with its targets; not all of them may have refused it.
        MomentKind::Refusal | MomentKind::Barred => {
            let refused = Text::from(format!("[{vehicles}]"));
            return Text::joined(" ", vec![moment.said(), refused]);
        }
        MomentKind::Bookmark
        | MomentKind::Alert
        | MomentKind::Mode
        | MomentKind::Arming
        | MomentKind::Rule
        | MomentKind::Event
        | MomentKind::Separation
        | MomentKind::Log => [moment.kind.text(), vehicles.into(), moment.said()],
    };
    let words = parts.into_iter().filter(|it| !it.is_empty()).collect();
    Text::joined(": ", words)
}

struct MarkdownPage<'a> {
    words: String,
    locale: &'a Locale,
}

impl MarkdownPage<'_> {
    fn heading(&mut self, level: usize, title: &str) {
        if !self.words.is_empty() {
            self.words.push('\n');
        }
        let _ = writeln!(self.words, "{} {}\n", "#".repeat(level), sanitised(title));
    }

    fn paragraph(&mut self, text: &str) {
        let _ = writeln!(self.words, "{}", sanitised(text));
    }

    fn item(&mut self, text: &str) {
        let _ = writeln!(self.words, "- {}", sanitised(text));
    }

    fn say(&self, id: &str) -> String {
        self.locale.say(id)
    }

    /// Writes the mission, its seed, the attempt and the trainee.
    fn flown(&mut self, report: &Report, trainee: Option<&str>) {
        let mission = text!(
            "review-mission",
            mission = report.mission.as_str(),
            revision = report.revision,
            seed = report.seed,
            attempt = report.attempt
        );
        self.words.push('\n');
        self.item(&self.locale.text(&mission));
        for act in report.instructor.acts() {
            self.item(&self.locale.text(&act.text()));
        }
        if let Some(trainee) = trainee {
            let trainee = text!("review-trainee", name = trainee);
            self.item(&self.locale.text(&trainee));
        }
    }

    fn workload(&mut self, report: &Report) {
        let workload = &report.workload;
        if workload.commands == 0 && workload.answers.is_empty() {
            return;
        }
        self.heading(3, &self.say("debrief-workload"));
        for words in debrief::workload_words(report) {
            self.item(&self.locale.text(&words));
        }
    }

    fn planned(&mut self, report: &Report, brief: Option<&Text>) {
        self.heading(2, &self.say("review-planned"));
        if let Some(brief) = brief {
            let brief = reflow(&self.locale.text(brief));
            for line in brief.lines().filter(|line| !line.trim().is_empty()) {
                self.paragraph(line);
                self.words.push('\n');
            }
        }
        for objective in &report.objectives {
            let line = text!(
                "review-objective",
                objective = &objective.title,
                target = &objective.target
            );
            self.item(&self.locale.text(&line));
        }
        if let Some(prediction) = report.prediction {
            let line = text!("review-predicted", score = prediction.predicted);
            self.item(&self.locale.text(&line));
        }
        if let Some(goal) = &report.goal {
            let line = text!("review-goal", goal = &goal.text);
            self.item(&self.locale.text(&line));
        }
    }

    fn happened(&mut self, flight: ReviewedFlight<'_>) {
        self.heading(2, &self.say("review-happened"));
        if let Some(report) = flight.report {
            let line = text!(
                "review-result",
                outcome = report.outcome.title(),
                score = report.score
            );
            self.paragraph(&self.locale.text(&line));
            self.words.push('\n');
        }
        for moment in flight.moments.iter().filter(|it| it.kind.is_reviewed()) {
            let what = self.locale.text(&told(moment));
            self.item(&format!(
                "{} {what}",
                clock(flight.clock.flight_time(moment.at))
            ));
        }
    }

    fn answer(&mut self, question: &str, answer: &str) {
        self.heading(2, &self.say(question));
        let answer = match answer {
            "" => self.say("review-unanswered"),
            given => given.to_owned(),
        };
        self.paragraph(&answer);
    }

    fn points(&mut self, review: &Review, times: &MissionClock) {
        for kind in PointKind::ALL {
            let points: Vec<String> = review
                .points_of(kind)
                .map(|it| format!("{} ({})", it.text, clock(times.flight_time(it.at()))))
                .collect();
            if points.is_empty() {
                continue;
            }
            self.heading(3, &self.locale.text(&kind.heading()));
            for point in points {
                self.item(&point);
            }
        }
    }

    fn explained(&mut self, report: &Report) {
        self.heading(2, &self.say("review-explained"));
        self.words.push_str("```text\n");
        for line in explanation(report, self.locale, debrief::WIDTH) {
            let _ = writeln!(self.words, "{}", line.text);
        }
        self.words.push_str("```\n");
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn a_moment_says_nothing_twice() {
        let moment = |kind, text: &str| Moment {
            at: Duration::ZERO,
            vehicles: vec![1],
            kind,
            by: None,
            text: Text::verbatim(text),
        };
        let words = |kind, text| told(&moment(kind, text)).to_string();
        let met = "objective met: landed";
        assert_eq!(words(MomentKind::Objective, met), met);
        let refused = "all takeoff 20: takeoff refused: no GPS";
        let expected = format!("{refused} [1]");
        assert_eq!(words(MomentKind::Refusal, refused), expected);
        let alert = words(MomentKind::Alert, "low battery");
        assert_eq!(alert, "alert: 1: low battery");
    }
}
