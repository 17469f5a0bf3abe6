//! Replays recorded flights as the events that the console received during the flight, from any moment on.
//!
//! A stage lets the vehicles' sessions receive the recorded frames again and returns their events and those of the
//! journal, a tenth of a second at a time. An index reads the whole recording once, in its own thread, and keeps a key
//! frame of the state every few seconds. To go to a moment, the console restores the last key frame before it and
//! plays on from there. A moment therefore looks the same, however the user has reached it.
//!
//! Nothing is ever sent: the sessions' messages to their vehicles are dropped.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use crate::app::effect::ReplayEffect;
use crate::app::event::{Event, LinkEvent, ReplayEvent, SessionEvent, Started};
use crate::app::room::messages::{LinkTraffic, Wanted};
use crate::app::state::{ReplayPosition, ReplayView};
use crate::config::Config;
use crate::dataflash::JoinedLog;
use crate::doctor::{Cause, LinkFinding, Way};
use crate::language::{LoopTarget, SeekTarget};
use crate::moment::{Moment, MomentKind};
use crate::notice::Notice;
use crate::review::Review;
use crate::scoring::Report;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

mod export;
mod film;
mod index;
mod logs;
mod moments;
mod observer;
mod stage;
#[cfg(test)]
mod tests;

pub use export::{ExportFormat, export};
pub use film::{Film, TlogSpan};
use index::Index;
pub use logs::join_log;
use stage::{LINK, Stage};

/// The time between frames of a replay.
pub const FRAME: Duration = Duration::from_millis(100);
/// The time between key frames taken while playing forward.
const KEY_AHEAD: Duration = Duration::from_secs(3);
/// A time further ahead than this takes a while to reach, so the console shows it as the goal.
const FAR: Duration = Duration::from_secs(30);
/// The maximum number of frames of the replay that are played between two checks for keys.
const STEPS_AT_ONCE: usize = 1000;
/// The maximum number of MAVLink frames that are read between two checks for keys. At half a microsecond each, that
/// takes a tenth of a second.
const HEARD_AT_ONCE: u64 = 200_000;

/// A recording that is replayed.
#[derive(Debug)]
pub struct Replay {
    film: Arc<Film>,
    stage: Stage,
    index: Index,
    position: ReplayPosition,
    /// The time to go to, from the beginning of the recording; the stage may not have reached it yet.
    goal: Duration,
    /// The program's clock at the last tick.
    looked: Option<Duration>,
    review: Review,
    /// All moments: those indexed so far, and the bookmarks.
    moments: Arc<Vec<Moment>>,
    /// The index's moments that are part of them.
    merged: Option<Arc<Vec<Moment>>>,
    /// The length last reported to the console.
    known_length: Duration,
}

impl Replay {
    /// Opens a recording: a tlog, or a file of a record; `config` has the muted alerts. Returns the replay with its
    /// initial events.
    ///
    /// # Errors
    /// The recording cannot be read, or is empty.
    pub fn open(path: &Path, config: &Config) -> Result<(Self, Vec<Event>), Text> {
        Self::begin(path, config, false)
    }

    /// Opens a recording for review: it is paused, and the console starts in the review room.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn review(path: &Path, config: &Config) -> Result<(Self, Vec<Event>), Text> {
        let (mut replay, events) = Self::begin(path, config, true)?;
        replay.position.is_playing = false;
        Ok((replay, events))
    }

    fn begin(path: &Path, config: &Config, is_review: bool) -> Result<(Self, Vec<Event>), Text> {
        let film = Arc::new(Film::open(path)?);
        let stage = Stage::new(&film)?;
        let started = film.started();
        let index = Index::begin(&film, &started, config)?;
        let mut view = film.view();
        view.review = film.review().clone();
        view.is_review = is_review;
        let logs = film.logs().iter();
        let curves = logs.map(|log| (log.vehicle, log.curves.clone()));
        view.log_curves = Arc::new(curves.collect());
        view.moments = Arc::new(view.review.bookmarks(&film.bookmarks()));
        let mut events = begin(view, started);
        events.extend(film.damage().map(warning));
        let replay = Self {
            stage,
            index,
            position: ReplayPosition::default(),
            goal: Duration::ZERO,
            looked: None,
            review: film.review().clone(),
            moments: Arc::default(),
            merged: None,
            known_length: Duration::ZERO,
            film,
        };
        Ok((replay, events))
    }

    /// Opens a recording and indexes all of it, so that its moments and its result are known.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn read_through(path: &Path, config: &Config) -> Result<Self, Text> {
        let (mut replay, _) = Self::open(path, config)?;
        replay.wait_for_index();
        Ok(replay)
    }

    /// Advances it with the program's clock; returns its events.
    pub fn tick(&mut self, now: Duration) -> Vec<Event> {
        let passed = now.saturating_sub(self.looked.replace(now).unwrap_or(now));
        if self.position.is_playing && self.is_there() {
            self.play(passed.mul_f64(self.position.rate));
        }
        let mut events = self.approach();
        events.extend(self.news());
        events
    }

    /// Carries out the user's control.
    pub fn steer(&mut self, effect: ReplayEffect) -> Vec<Event> {
        let now = self.stage.now();
        match effect {
            ReplayEffect::Play(plays) => {
                self.position.is_playing = plays;
                self.position.is_backwards = false;
                if plays && self.is_at_end() {
                    self.goal = Duration::ZERO;
                }
            }
            ReplayEffect::Rewind => {
                self.position.is_playing = true;
                self.position.is_backwards = true;
                self.goal = now;
            }
            ReplayEffect::Rate(rate) => self.position.rate = rate,
            ReplayEffect::Seek(target) => match self.target(target) {
                Some(goal) => self.goal = goal.min(self.length()),
                None if self.index.length().is_some() => {
                    return vec![Event::Failed(text!("seek-none"))];
                }
                None => return vec![Event::Failed(text!("seek-none-yet"))],
            },
            ReplayEffect::Step { forward } => {
                self.position.is_playing = false;
                self.goal = if forward {
                    (now + FRAME).min(self.length())
                } else {
                    now.saturating_sub(FRAME)
                };
            }
            ReplayEffect::Moment { forward } => {
                self.goal = self.near_moment(forward, None).unwrap_or(self.goal);
            }
            ReplayEffect::Show(at) => self.goal = showing(at).min(self.length()),
            ReplayEffect::Loop(None) => self.position.looped = None,
            ReplayEffect::Loop(Some(target)) => match self.stretch(target) {
                Some((from, to)) => {
                    self.position.looped = Some((from, to));
                    self.goal = from;
                }
                None => return vec![Event::Failed(text!("loop-none"))],
            },
            ReplayEffect::StopAt(kinds) => self.position.stops = kinds,
            ReplayEffect::Keep(review) => {
                if let Err(fault) = self.keep(*review) {
                    return vec![Event::Failed(fault)];
                }
            }
        }
        self.approach()
    }

    /// The time of a target; `None` if no moment matches.
    fn target(&self, target: SeekTarget) -> Option<Duration> {
        let now = self.stage.now();
        match target {
            SeekTarget::At(at) => Some(at),
            SeekTarget::Later(by) => Some(now.saturating_add(by)),
            SeekTarget::Earlier(by) => Some(now.saturating_sub(by)),
            SeekTarget::Next(kind) => self.near_moment(true, Some(kind)),
            SeekTarget::Previous(kind) => self.near_moment(false, Some(kind)),
            SeekTarget::Mission(elapsed) => self.film.clock().record_time(elapsed),
            SeekTarget::End => Some(self.length()),
        }
    }

    /// The start and the end of a stretch; `None` if it has no moment at one of them.
    fn stretch(&self, target: LoopTarget) -> Option<(Duration, Duration)> {
        let length = self.length();
        let (from, to) = match target {
            LoopTarget::Times { from, to } => (from, to),
            LoopTarget::Moments(kind) => {
                let now = self.stage.now();
                let times = self.moments.iter().filter(|it| it.kind == kind);
                let mut shown = times.map(|it| showing(it.at));
                (
                    shown.clone().rfind(|at| *at <= now)?,
                    shown.find(|at| *at > now)?,
                )
            }
        };
        Some((from.min(length), to.min(length)))
    }

    /// The current traffic for the room of messages.
    pub fn inspect(&mut self, wanted: &Wanted) -> LinkTraffic {
        self.stage.inspect(wanted)
    }

    pub fn film(&self) -> &Film {
        &self.film
    }

    /// The current time in the recording.
    pub fn now(&self) -> Duration {
        self.stage.now()
    }

    /// Whether it has reached the goal.
    pub fn is_there(&self) -> bool {
        self.goal < self.stage.now() + FRAME
    }

    /// The length of the recording, if known; otherwise an estimate.
    pub fn length(&self) -> Duration {
        self.index.length().unwrap_or_else(|| self.film.length())
    }

    /// Waits until the whole recording has been indexed.
    pub fn wait_for_index(&mut self) {
        self.index.finish();
        self.merge();
    }

    /// The faults of the recording and of the files next to it.
    pub fn damage(&self) -> impl Iterator<Item = Text> {
        self.film.damage()
    }

    /// All moments found so far, earliest first.
    pub fn moments(&self) -> &[Moment] {
        &self.moments
    }

    pub fn reviewed(&self) -> &Review {
        &self.review
    }

    /// The report of the recorded mission, once indexed.
    pub fn report(&self) -> Option<Arc<Report>> {
        self.index.report()
    }

    /// Stores the user's review next to the recording. It applies to this replay even if it cannot be written.
    fn keep(&mut self, review: Review) -> Result<(), Text> {
        self.review = review;
        self.merged = None;
        // An unreadable review is not replaced: it may come from a later version.
        if let Some(fault) = self.film.review_fault() {
            return Err(text!("review-not-kept", fault = fault.clone()));
        }
        let written = self.film.files().write_review(&self.review);
        written.map_err(|error| Text::from(&error))
    }

    /// Merges moments and bookmarks if either has changed; returns whether anything has changed.
    fn merge(&mut self) -> bool {
        let found = self.index.moments();
        if self
            .merged
            .as_ref()
            .is_some_and(|it| Arc::ptr_eq(it, &found))
        {
            return false;
        }
        let bookmarks = self.review.bookmarks(&self.film.bookmarks());
        // The file may have been changed by hand.
        let length = self.film.length();
        let logged = self.film.logs().iter().flat_map(JoinedLog::moments);
        let logged = logged.filter(|it| it.at <= length);
        let mut all: Vec<Moment> = found
            .iter()
            .cloned()
            .chain(bookmarks)
            .chain(logged)
            .collect();
        all.sort_by_key(|it| it.at);
        self.moments = Arc::new(all);
        self.merged = Some(found);
        true
    }

    fn is_at_end(&self) -> bool {
        self.stage.now() + FRAME > self.length()
    }

    fn play(&mut self, passed: Duration) {
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
        if let Some(stop) = self.stop_between(before, self.goal) {
            self.goal = showing(stop);
            self.position.is_playing = false;
        }
        let is_at_edge = if is_backwards {
            self.goal.is_zero()
        } else {
            self.goal >= self.length()
        };
        if is_at_edge {
            self.goal = self.goal.min(self.length());
            self.position.is_playing = false;
        }
    }

    /// The first moment to stop at between two times, in either direction.
    fn stop_between(&self, from: Duration, to: Duration) -> Option<Duration> {
        let stops = |it: &&Moment| self.position.stops.contains(&it.kind);
        let times = self.moments.iter().filter(stops).map(|it| it.at);
        if from <= to {
            times.filter(|&at| at > from && at <= to).min()
        } else {
            // The replay has already stopped at a moment that is shown at the start.
            times
                .filter(|&at| showing(at) < from && showing(at) >= to)
                .max()
        }
    }

    /// The frame that shows the next or the previous moment, of a kind or of any.
    fn near_moment(&self, forward: bool, kind: Option<MomentKind>) -> Option<Duration> {
        let now = self.stage.now();
        let is_meant = |it: &&Moment| kind.is_none_or(|kind| it.kind == kind);
        let mut moments = self.moments.iter().filter(is_meant);
        // A moment that was just reached is skipped, so that pressing the key again goes further back.
        let found = if forward {
            moments.find(|it| it.at >= now + FRAME)
        } else {
            moments.rfind(|it| it.at + FRAME * 2 <= now)
        };
        found.map(|it| showing(it.at).min(self.length()))
    }

    /// Plays towards the goal, as far as one tick allows.
    fn approach(&mut self) -> Vec<Event> {
        let mut events = Vec::new();
        let now = self.stage.now();
        if let Some(key) = self.index.key_frame(self.goal)
            && (self.goal + FRAME <= now || key.at() > now + KEY_AHEAD)
        {
            self.stage.restore(key.cast());
            events.push(ReplayEvent::Restored(Box::new(key.flight())).into());
        }
        let until = self.stage.heard() + HEARD_AT_ONCE;
        for _ in 0..STEPS_AT_ONCE {
            if self.is_there() || self.stage.heard() >= until {
                break;
            }
            let told = self.stage.step();
            events.push(ReplayEvent::At(self.at()).into());
            events.extend(told);
        }
        events.push(ReplayEvent::At(self.at()).into());
        events
    }

    fn at(&self) -> ReplayPosition {
        ReplayPosition {
            at: self.stage.now(),
            gap: self.stage.gap(),
            goal: Some(self.goal).filter(|goal| *goal > self.stage.now() + FAR),
            ..self.position.clone()
        }
    }

    /// The index's news since the last call.
    fn news(&mut self) -> Option<Event> {
        self.position.indexed = self.index.reached();
        let length = self.length();
        let is_longer = std::mem::replace(&mut self.known_length, length) != length;
        if !self.merge() && !is_longer {
            return None;
        }
        let event = ReplayEvent::Known {
            length,
            moments: Arc::clone(&self.moments),
            report: self.report(),
        };
        Some(event.into())
    }
}

/// A warning about a recording, as a notice.
fn warning(text: Text) -> Event {
    Event::Notice(Notice::general(Duration::ZERO, Severity::Warning, text))
}

/// The frame that shows a time; a frame contains the events before its end.
fn showing(at: Duration) -> Duration {
    let frames = at.as_millis() / FRAME.as_millis() + 1;
    FRAME * u32::try_from(frames).unwrap_or(u32::MAX)
}

/// The events at the start of a replay.
fn begin(view: ReplayView, started: Started) -> Vec<Event> {
    vec![
        ReplayEvent::Opened(Box::new(view)).into(),
        SessionEvent::Started(Box::new(started)).into(),
        LinkEvent::Findings(vec![LinkFinding {
            link: LINK.into(),
            way: Way::File,
            cause: Cause::Recording,
        }])
        .into(),
    ]
}
