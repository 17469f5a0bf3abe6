//! The playback of a recording: its goal, its rate, the section that is repeated, and its stops.

use std::time::Duration;

use super::FRAME;
use super::contents::Contents;
use crate::app::state::ReplayPosition;
use crate::moment::MomentKind;

/// A time further ahead than this takes a while to reach, so the console shows it as the goal.
const FAR: Duration = Duration::from_secs(30);

/// The controls of a replay. The stage follows its goal.
#[derive(Debug, Default)]
pub(super) struct Player {
    position: ReplayPosition,
    /// The time to go to, from the beginning of the recording; the stage may not have reached it yet.
    goal: Duration,
    /// The program's clock at the last tick.
    looked: Option<Duration>,
}

impl Player {
    /// The time to go to.
    pub fn goal(&self) -> Duration {
        self.goal
    }

    pub fn go_to(&mut self, goal: Duration) {
        self.goal = goal;
    }

    /// Plays forward from the current goal, or pauses.
    pub fn play(&mut self, plays: bool) {
        self.position.is_playing = plays;
        self.position.is_backwards = false;
    }

    /// Pauses, in whichever direction it plays.
    pub fn pause(&mut self) {
        self.position.is_playing = false;
    }

    /// Whether it plays, in either direction.
    #[cfg(test)]
    pub fn is_playing(&self) -> bool {
        self.position.is_playing
    }

    /// The section that is repeated.
    pub fn repeated(&self) -> Option<(Duration, Duration)> {
        self.position.looped
    }

    /// Plays backwards from a time.
    pub fn rewind(&mut self, from: Duration) {
        self.position.is_playing = true;
        self.position.is_backwards = true;
        self.goal = from;
    }

    /// Sets the speed; 1 is real time.
    pub fn set_rate(&mut self, rate: f64) {
        self.position.rate = rate;
    }

    /// Repeats a section, beginning at its start; `None` ends the repetition.
    pub fn repeat(&mut self, stretch: Option<(Duration, Duration)>) {
        self.position.looped = stretch;
        if let Some((from, _)) = stretch {
            self.goal = from;
        }
    }

    /// Sets the kinds of moments at which playback stops.
    pub fn stop_at(&mut self, kinds: Vec<MomentKind>) {
        self.position.stops = kinds;
    }

    /// Notes how far the recording has been indexed.
    pub fn note_indexed(&mut self, reached: Duration) {
        self.position.indexed = reached;
    }

    /// Follows the program's clock: while playing, moves the goal on, unless the stage has yet to
    /// reach it.
    pub fn tick(&mut self, now: Duration, stage: Duration, contents: &Contents, length: Duration) {
        let passed = now.saturating_sub(self.looked.replace(now).unwrap_or(now));
        if self.position.is_playing && self.is_reached(stage) {
            self.advance(passed.mul_f64(self.position.rate), contents, length);
        }
    }

    /// Whether the stage, at this time, has reached the goal.
    pub fn is_reached(&self, stage: Duration) -> bool {
        self.goal < stage + FRAME
    }

    /// The position for the console: the time that the stage shows, and the gap of the recording there, if any.
    pub fn shown(&self, stage: Duration, gap: Option<Duration>) -> ReplayPosition {
        ReplayPosition {
            at: stage,
            gap,
            goal: Some(self.goal).filter(|goal| *goal > stage + FAR),
            ..self.position.clone()
        }
    }

    fn advance(&mut self, passed: Duration, contents: &Contents, length: Duration) {
        let before = self.goal;
        let is_backwards = self.position.is_backwards;
        self.goal = if is_backwards {
            before.saturating_sub(passed)
        } else {
            before + passed
        };
        if let Some((from, to)) = self.position.looped {
            if is_backwards && self.goal <= from {
                self.goal = to;
                return;
            }
            if !is_backwards && self.goal >= to {
                self.goal = from;
                return;
            }
        }
        if let Some(stop) = contents.between(before, self.goal, &self.position.stops) {
            self.goal = stop;
            self.position.is_playing = false;
        }
        let is_at_edge = if is_backwards {
            self.goal.is_zero()
        } else {
            self.goal >= length
        };
        if is_at_edge {
            self.goal = self.goal.min(length);
            self.position.is_playing = false;
        }
    }
}
