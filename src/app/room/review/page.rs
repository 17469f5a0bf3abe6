//! The pages of the review that are text, line by line.

use super::{ReviewPage, key_of};
use crate::app::State;
use crate::app::action::Action;
use crate::app::room::mission::{PageLine, Tone};
use crate::app::state::ReplayView;
use crate::debrief::{DebriefTone, explanation};
use crate::moment::MomentKind;
use crate::review::{PointKind, Review};
use crate::scoring::Report;
use crate::text;
use crate::text::{Locale, Text, clock, reflow, wrap};

pub(super) fn lines(state: &State, locale: &Locale, width: u16) -> Vec<PageLine> {
    let Some(view) = &state.replay else {
        return Vec::new();
    };
    let mut page = Page {
        state,
        view,
        locale,
        width: usize::from(width),
        lines: Vec::new(),
    };
    match state.rooms.review.page {
        ReviewPage::Planned => page.planned(),
        ReviewPage::Happened => {}
        ReviewPage::Why => page.why(),
        ReviewPage::Next => page.next(),
        ReviewPage::Explained => page.explained(),
        ReviewPage::Compared => page.compared(),
    }
    page.lines
}

pub(super) struct Page<'a> {
    pub state: &'a State,
    view: &'a ReplayView,
    pub locale: &'a Locale,
    pub width: usize,
    lines: Vec<PageLine>,
}

impl Page<'_> {
    pub fn add(&mut self, tone: Tone, text: impl Into<String>) {
        let text = text.into();
        self.lines.push(PageLine { tone, text });
    }

    fn title(&mut self, text: &Text) {
        if !self.lines.is_empty() {
            self.add(Tone::Plain, "");
        }
        self.add(Tone::Title, self.locale.text(text));
    }

    fn paragraph(&mut self, tone: Tone, text: &str) {
        for line in wrap(text, self.width) {
            self.add(tone, line);
        }
    }

    pub fn say(&mut self, tone: Tone, text: &Text) {
        let words = self.locale.text(text);
        self.paragraph(tone, &words);
    }

    /// A list item; its later lines are indented.
    fn item(&mut self, tone: Tone, lead: &str, text: &str) {
        let indent = " ".repeat(lead.len());
        let lines = wrap(text, self.width.saturating_sub(lead.len()));
        for (at, line) in lines.iter().enumerate() {
            let lead = if at == 0 { lead } else { &indent };
            self.add(tone, format!("{lead}{line}"));
        }
    }

    fn planned(&mut self) {
        let Some(mission) = &self.state.session.listing else {
            return self.say(Tone::Muted, &text!("review-no-plan"));
        };
        self.title(&mission.title);
        let brief = reflow(&self.locale.text(&mission.brief));
        self.paragraph(Tone::Plain, &brief);
        self.title(&text!("mission-objectives"));
        for objective in &mission.objectives {
            let line = text!(
                "review-objective",
                objective = &objective.title,
                target = &objective.target
            );
            let line = self.locale.text(&line);
            self.item(Tone::Plain, "- ", &line);
        }
        self.title(&text!("review-said-before"));
        self.said_before();
    }

    /// The pilot's prediction and goal.
    fn said_before(&mut self) {
        let Some(report) = self.view.report.clone() else {
            return self.unread();
        };
        if let Some(prediction) = report.prediction {
            let line = text!("review-predicted", score = prediction.predicted);
            self.say(Tone::Plain, &line);
        }
        if let Some(goal) = &report.goal {
            self.say(Tone::Plain, &text!("review-goal", goal = &goal.text));
        }
        if report.prediction.is_none() && report.goal.is_none() {
            self.say(Tone::Muted, &text!("review-nothing-said"));
        }
    }

    /// Why the result is not known: the recording is still being read, or has none.
    fn unread(&mut self) {
        let position = &self.view.position;
        let is_read = position.indexed >= self.view.length;
        let text = if is_read || self.state.session.listing.is_none() {
            text!("review-no-result")
        } else {
            let reached = clock(position.indexed);
            text!(
                "review-reading",
                reached = reached,
                length = clock(self.view.length)
            )
        };
        self.say(Tone::Muted, &text);
    }

    fn why(&mut self) {
        self.title(&text!("review-outcome"));
        match self.view.report.clone() {
            Some(report) => self.outcome(&report),
            None => self.unread(),
        }
        self.counts();
        self.title(&text!("review-why-question"));
        let why = self.view.review.why.clone();
        self.answer(&why);
    }

    /// The result of the flight, without reasons.
    fn outcome(&mut self, report: &Report) {
        let result = text!(
            "review-result",
            outcome = &report.outcome,
            score = report.score
        );
        self.say(Tone::Plain, &result);
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
            let line = self.locale.text(&line);
            self.item(tone, lead, &line);
        }
    }

    /// The counts of each kind of moment.
    fn counts(&mut self) {
        let counted = [
            MomentKind::Refusal,
            MomentKind::Alert,
            MomentKind::Rule,
            MomentKind::Separation,
        ];
        let counts: Vec<String> = counted
            .into_iter()
            .map(|kind| {
                let moments = self.view.moments.iter();
                let count = moments.filter(|it| it.kind == kind).count();
                format!("{}: {count}", self.locale.text(&kind.text()))
            })
            .collect();
        self.add(Tone::Muted, counts.join("   "));
    }

    fn next(&mut self) {
        self.title(&text!("review-next-question"));
        let review = self.view.review.clone();
        self.answer(&review.next);
        for kind in PointKind::ALL {
            self.title(&kind.text());
            self.points(&review, kind);
        }
        self.add(Tone::Plain, "");
        let how = text!(
            "review-points-how",
            sustain = key_of(self.state, "review sustain"),
            improve = key_of(self.state, "review improve"),
            remove = key_of(self.state, "review remove")
        );
        self.say(Tone::Muted, &how);
    }

    fn points(&mut self, review: &Review, kind: PointKind) {
        if review.points_of(kind).next().is_none() {
            return self.say(Tone::Muted, &text!("review-no-points"));
        }
        for (number, point) in (1..).zip(review.points()) {
            if point.kind == kind {
                let lead = format!("{number} {} ", clock(point.at()));
                self.item(Tone::Plain, &lead, &point.text);
            }
        }
    }

    fn answer(&mut self, answer: &str) {
        if answer.is_empty() {
            let key = self.state.key(Action::Submit);
            self.say(Tone::Hint, &text!("review-answer-how", key = key));
        } else {
            self.paragraph(Tone::Plain, answer);
        }
    }

    fn explained(&mut self) {
        if !self.view.review.is_answered() {
            self.say(Tone::Hint, &text!("review-locked"));
            return;
        }
        let Some(report) = self.view.report.clone() else {
            return self.unread();
        };
        for line in explanation(&report, self.locale) {
            let tone = match line.tone {
                DebriefTone::Heading | DebriefTone::Head => Tone::Title,
                DebriefTone::Good => Tone::Met,
                DebriefTone::Bad => Tone::Missed,
                DebriefTone::Gain => Tone::Hint,
                DebriefTone::Plain | DebriefTone::Event(_) => Tone::Plain,
            };
            self.add(tone, line.text.trim_end());
        }
    }
}
