//! What a trainee is asked before launch, and what was answered.

use super::{Page, Tone};
use crate::app::action::Action;
use crate::mission::Pledge;
use crate::text;
use crate::text::Text;

impl Page<'_> {
    /// Whether a mission has been started and nothing has flown yet.
    pub(super) fn awaits_launch(&self) -> bool {
        let session = &self.state.session;
        let flown = |progress: &crate::mission::Progress| progress.score_so_far.is_some();
        session.activity.is_some() && !session.over && !session.mission.as_ref().is_some_and(flown)
    }

    /// Whether the clock stands still while the brief is read, or can be stopped.
    fn can_wait(&self) -> bool {
        let session = &self.state.session;
        if session.is_reading() {
            return true;
        }
        let allows = session.listing.as_ref().is_some_and(|it| it.pausable);
        self.awaits_launch() && allows && session.hangar.is_none()
    }

    /// Before launch, the questions and how to begin; afterwards what was answered, if anything was.
    pub(super) fn launch(&mut self) {
        if self.state.session.activity.is_none() {
            return;
        }
        let state = self.state;
        let words = |line| self.words_key(line);
        let pause = state.key(Action::PauseMission);
        let progress = state.session.mission.as_ref();
        let pledge = progress.map_or_else(Pledge::default, |progress| progress.pledge);
        let waits = self.awaits_launch();
        let open = |text: Text| waits.then_some(text);
        let prediction = match pledge.prediction {
            Some(points) => Some(text!("mission-prediction-is", points = points)),
            None => open(text!("mission-prediction-none", key = words("predict "))),
        };
        let goal = match pledge.goal {
            Some(goal) => Some(goal.title()),
            None => open(text!("mission-goal-none", key = words("goal "))),
        };
        let then = text!(
            "mission-then-is",
            drones = state.key(Action::Submit),
            back = state.key(Action::Escape),
            help = state.key(Action::Help)
        );
        let named = [
            (text!("mission-prediction"), prediction),
            (text!("mission-goal"), goal),
            (
                text!("mission-next-hint"),
                progress
                    .and_then(|it| it.clues.price(words("hint")))
                    .filter(|_| waits),
            ),
            (
                text!("mission-reading"),
                self.can_wait().then(|| {
                    if self.state.session.is_reading() {
                        text!("mission-reading-first")
                    } else if self.state.session.is_paused() {
                        text!("mission-reading-paused", key = pause)
                    } else {
                        text!("mission-reading-is", key = pause)
                    }
                }),
            ),
            (text!("mission-then"), open(then)),
        ];
        let told = named
            .into_iter()
            .filter_map(|(name, what)| Some((name, what?)));
        let rows: Vec<(Text, Text)> = told.collect();
        if rows.is_empty() {
            return;
        }
        self.title(&if waits {
            text!("mission-launch")
        } else {
            text!("mission-pledge")
        });
        self.rows(&rows);
        if waits && let Some(hint) = progress.and_then(|progress| progress.hint.as_ref()) {
            let hint = self.locale.text(hint);
            self.paragraph(Tone::Hint, &hint);
        }
    }
}
