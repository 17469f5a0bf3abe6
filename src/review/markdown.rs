//! A review as a Markdown document.

use std::fmt::Write as _;

use super::{PointKind, Review};
use crate::debrief::{self, explanation};
use crate::moment::Moment;
use crate::notice::sanitised;
use crate::record::MissionClock;
use crate::scoring::Report;
use crate::text;
use crate::text::{Locale, Text, clock};
use crate::vehicle_id::ranges;

/// The flight that a review is about.
#[derive(Debug, Clone, Copy)]
pub struct ReviewedFlight<'a> {
    /// The title of the mission, or the name of a recording.
    pub title: &'a str,
    /// The time of day of its beginning, in UTC.
    pub began: &'a str,
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
        page.planned(report);
    }
    page.happened(flight);
    page.answer("review-why", &review.why);
    page.answer("review-next", &review.next);
    page.points(review, flight.clock);
    if let Some(report) = flight.report.filter(|_| review.is_answered()) {
        page.explained(report);
    }
    page.words
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

    fn planned(&mut self, report: &Report) {
        self.heading(2, &self.say("review-planned"));
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
            let vehicles = ranges(moment.vehicles.iter().copied());
            let parts = [moment.kind.text(), vehicles.into(), moment.text.clone()];
            let words = parts.into_iter().filter(|it| !it.is_empty()).collect();
            let what = self.locale.text(&Text::joined(": ", words));
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
            self.heading(3, &self.locale.text(&kind.text()));
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
