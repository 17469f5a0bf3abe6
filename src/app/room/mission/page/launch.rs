//! The questions before takeoff, and the answers.

use super::MissionPage;
use crate::app::action::Action;
use crate::app::room::page::Tone;
use crate::mission::Pledge;
use crate::text;
use crate::text::{Text, clock};

impl MissionPage<'_> {
    /// Whether a session is under way and no vehicle has flown in it yet; false in a replay.
    pub(super) fn awaits_launch(&self) -> bool {
        let session = &self.state.session;
        let flown = |progress: &crate::mission::Progress| progress.score_so_far.is_some();
        self.state.replay.is_none()
            && session.activity.is_some()
            && !session.task.over
            && !session.task.progress.as_ref().is_some_and(flown)
    }

    /// Whether the clock is stopped for the brief, or can be.
    fn can_wait(&self) -> bool {
        let session = &self.state.session;
        if session.is_reading() {
            return true;
        }
        let allows = session.task.listing.as_ref().is_some_and(|it| it.pausable);
        self.awaits_launch() && allows && session.hangar.is_none()
    }

    /// Before takeoff, adds the questions and the ways to begin; afterwards, adds the answers, if
    /// any.
    pub(super) fn launch(&mut self) {
        if self.state.session.activity.is_none() {
            return;
        }
        let named = [
            (text!("mission-exam"), self.exam_try()),
            (text!("mission-prediction"), self.prediction()),
            (text!("mission-goal"), self.goal()),
            (text!("mission-next-hint"), self.next_hint()),
            (text!("mission-reading"), self.reading()),
            (text!("mission-then"), self.then()),
        ];
        let told = named
            .into_iter()
            .filter_map(|(name, what)| Some((name, what?)));
        let rows: Vec<(Text, Text)> = told.collect();
        if rows.is_empty() {
            return;
        }
        let waits = self.awaits_launch();
        self.text.title(&if waits {
            text!("mission-launch")
        } else {
            text!("mission-pledge")
        });
        self.text.rows(&rows);
        let progress = self.state.session.task.progress.as_ref();
        if waits && let Some(hint) = progress.and_then(|progress| progress.hint.as_ref()) {
            let hint = self.text.locale.text(hint);
            self.text.paragraph(Tone::Hint, &hint);
        }
    }

    fn pledge(&self) -> Pledge {
        let progress = self.state.session.task.progress.as_ref();
        progress.map_or_else(Pledge::default, |progress| progress.pledge)
    }

    fn prediction(&self) -> Option<Text> {
        match self.pledge().prediction {
            Some(points) => Some(text!("mission-prediction-is", points = points)),
            None => self
                .awaits_launch()
                .then(|| text!("mission-prediction-none", key = self.words_key("predict "))),
        }
    }

    fn goal(&self) -> Option<Text> {
        match self.pledge().goal {
            Some(goal) => Some(goal.title()),
            None => self
                .awaits_launch()
                .then(|| text!("mission-goal-none", key = self.words_key("goal "))),
        }
    }

    fn next_hint(&self) -> Option<Text> {
        let progress = self.state.session.task.progress.as_ref();
        let price = progress.and_then(|it| it.clues.price(self.words_key("hint")));
        price.filter(|_| self.awaits_launch())
    }

    fn reading(&self) -> Option<Text> {
        let pause = self.state.key(Action::PauseMission);
        self.can_wait().then(|| {
            if self.state.holds_brief().is_some() {
                text!("mission-reading-held")
            } else if self.state.session.is_reading() {
                text!("mission-reading-first")
            } else if self.state.session.is_paused() {
                text!("mission-reading-paused", key = pause)
            } else {
                text!("mission-reading-is", key = pause)
            }
        })
    }

    /// The try of an exam, and the time that is left for it.
    fn exam_try(&self) -> Option<Text> {
        let shown = self.state.shown_try()?;
        Some(text!(
            "mission-exam-is",
            exam = shown.title.clone(),
            number = shown.number,
            tries = shown.tries,
            time = clock(shown.left)
        ))
    }

    fn then(&self) -> Option<Text> {
        if let Some(held) = self.state.holds_brief() {
            return Some(held);
        }
        let key = |action| self.state.key(action);
        self.state.session.is_reading().then(|| {
            text!(
                "mission-then-is",
                drones = key(Action::Submit),
                back = key(Action::Escape),
                help = key(Action::Help)
            )
        })
    }
}
