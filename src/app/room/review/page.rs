//! The pages of the review that are text, line by line.

use super::{ReviewPage, key_of};
use crate::app::State;
use crate::app::action::Action;
use crate::app::room::page::{PageLine, TextPage, Tone};
use crate::app::state::ReplayView;
use crate::debrief::{DebriefTone, explanation, workload_words};
use crate::moment::MomentKind;
use crate::review::{PointKind, Review};
use crate::scoring::Report;
use crate::text;
use crate::text::{Locale, clock, reflow};

pub(super) fn lines(state: &State, locale: &Locale, width: u16) -> Vec<PageLine> {
    let Some(view) = &state.replay else {
        return Vec::new();
    };
    let mut page = Page {
        state,
        view,
        text: TextPage::new(locale, usize::from(width)),
    };
    match state.rooms.review.page {
        ReviewPage::Planned => page.planned(),
        ReviewPage::Happened => {}
        ReviewPage::Why => page.why(),
        ReviewPage::Next => page.next(),
        ReviewPage::Explained => page.explained(),
        ReviewPage::Compared => page.compared(),
    }
    page.text.finish()
}

pub(super) struct Page<'a> {
    pub state: &'a State,
    view: &'a ReplayView,
    pub text: TextPage<'a>,
}

impl Page<'_> {
    fn planned(&mut self) {
        let Some(mission) = &self.state.session.task.listing else {
            return self.text.say(Tone::Muted, &text!("review-no-plan"));
        };
        self.text.title(&mission.title);
        let brief = reflow(&self.text.locale.text(&mission.brief));
        self.text.paragraph(Tone::Plain, &brief);
        self.text.title(&text!("mission-objectives"));
        for objective in &mission.objectives {
            let line = text!(
                "review-objective",
                objective = &objective.title,
                target = &objective.target
            );
            let words = self.text.locale.text(&line);
            self.text.item(Tone::Plain, "- ", &words);
        }
        self.text.title(&text!("review-said-before"));
        self.said_before();
    }

    /// The pilot's prediction and goal.
    fn said_before(&mut self) {
        let Some(report) = self.view.report.clone() else {
            return self.unread();
        };
        if let Some(prediction) = report.prediction {
            let line = text!("review-predicted", score = prediction.predicted);
            self.text.say(Tone::Plain, &line);
        }
        if let Some(goal) = &report.goal {
            self.text
                .say(Tone::Plain, &text!("review-goal", goal = &goal.text));
        }
        if report.prediction.is_none() && report.goal.is_none() {
            self.text.say(Tone::Muted, &text!("review-nothing-said"));
        }
    }

    /// Why the result is not known: the recording is still being read, or contains no result.
    fn unread(&mut self) {
        let position = &self.view.position;
        let is_read = position.indexed >= self.view.length;
        let text = if is_read || self.state.session.task.listing.is_none() {
            text!("review-no-result")
        } else {
            let reached = clock(position.indexed);
            text!(
                "review-reading",
                reached = reached,
                length = clock(self.view.length)
            )
        };
        self.text.say(Tone::Muted, &text);
    }

    fn why(&mut self) {
        self.text.title(&text!("review-outcome"));
        match self.view.report.clone() {
            Some(report) => self.outcome(&report),
            None => self.unread(),
        }
        self.counts();
        self.workload();
        self.text.title(&text!("review-why-question"));
        let why = self.view.review.why.clone();
        self.answer(&why);
    }

    /// The result of the flight, without reasons.
    fn outcome(&mut self, report: &Report) {
        let result = text!(
            "review-result",
            outcome = report.outcome.title(),
            score = report.score
        );
        self.text.say(Tone::Plain, &result);
        for act in report.instructor.acts() {
            self.text.say(Tone::Plain, &act.text());
        }
        for objective in &report.objectives {
            let (tone, lead) = if objective.met {
                (Tone::Met, "[x] ")
            } else {
                (Tone::Missed, "[!] ")
            };
            let line = text!(
                "review-objective-result",
                objective = &objective.title,
                result = &objective.result,
                target = &objective.target
            );
            let words = self.text.locale.text(&line);
            self.text.item(tone, lead, &words);
        }
    }

    fn counts(&mut self) {
        let counted = [
            (MomentKind::Refusal, "review-count-refusals"),
            (MomentKind::Alert, "review-count-alerts"),
            (MomentKind::Rule, "review-count-rules"),
            (MomentKind::Separation, "review-count-separations"),
        ];
        let counts: Vec<String> = counted
            .into_iter()
            .map(|(kind, name)| {
                let moments = self.view.moments.iter();
                let count = moments.filter(|it| it.kind == kind).count();
                format!("{}: {count}", self.text.locale.say(name))
            })
            .collect();
        self.text.add(Tone::Muted, counts.join(", "));
    }

    /// The pilot's workload in words; its curves are below the moments.
    fn workload(&mut self) {
        let Some(report) = self.view.report.clone() else {
            return;
        };
        if report.workload.is_empty() {
            return;
        }
        self.text.title(&text!("workload-title"));
        for words in workload_words(&report) {
            self.text.say(Tone::Muted, &words);
        }
    }

    fn next(&mut self) {
        self.text.title(&text!("review-next-question"));
        let review = self.view.review.clone();
        self.answer(&review.next);
        for kind in PointKind::ALL {
            self.text.title(&kind.text());
            self.points(&review, kind);
        }
        self.text.add(Tone::Plain, "");
        let how = text!(
            "review-points-how",
            sustain = key_of(self.state, "review sustain"),
            improve = key_of(self.state, "review improve"),
            remove = key_of(self.state, "review remove")
        );
        self.text.say(Tone::Muted, &how);
    }

    fn points(&mut self, review: &Review, kind: PointKind) {
        if review.points_of(kind).next().is_none() {
            return self.text.say(Tone::Muted, &text!("review-no-points"));
        }
        for (number, point) in (1..).zip(review.points()) {
            if point.kind == kind {
                let lead = format!(
                    "{number} {} ",
                    clock(self.view.clock.flight_time(point.at()))
                );
                self.text.item(Tone::Plain, &lead, &point.text);
            }
        }
    }

    fn answer(&mut self, answer: &str) {
        if answer.is_empty() {
            let key = self.state.key(Action::Submit);
            self.text
                .say(Tone::Hint, &text!("review-answer-how", key = key));
        } else {
            self.text.paragraph(Tone::Plain, answer);
        }
    }

    fn explained(&mut self) {
        if !self.view.review.is_answered() {
            self.text.say(Tone::Hint, &text!("review-locked"));
            return;
        }
        let Some(report) = self.view.report.clone() else {
            return self.unread();
        };
        for line in explanation(&report, self.text.locale, self.text.width) {
            let tone = match line.tone {
                // Headings stand over columns, so they are not titles with a rule.
                DebriefTone::Heading | DebriefTone::Head | DebriefTone::Gain => Tone::Hint,
                DebriefTone::Good => Tone::Met,
                DebriefTone::Bad => Tone::Missed,
                DebriefTone::Plain | DebriefTone::Event(_) => Tone::Plain,
            };
            self.text.add(tone, line.text.trim_end());
        }
    }
}
