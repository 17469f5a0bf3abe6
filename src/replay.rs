//! Replays recorded flights, from any time on, as the events that the console received during the
//! flight.
//!
//! A stage lets the vehicles' sessions receive the recorded frames again and returns their events
//! and those of the journal, a tenth of a second at a time. An index reads the whole recording
//! once, in its own thread, and keeps a key frame of the state every ten seconds, or less often in
//! a long recording. To go to a time, the console restores the last key frame before it and plays
//! on from there. The state at that time is therefore the same, however the user has reached it.
//!
//! Nothing is ever sent: the sessions' messages to their vehicles are dropped.
//!
//! # How the parts fit
//! - What is in the recording: `film` (its files), `logs` (a vehicle's own log beside it),
//!   `contents` and `moments` (what happened when).
//! - How it is shown: `player` (where it is, how fast), `stage` (the vehicles repeat what they
//!   sent), `index` and `observer` (key frames for jumps).
//! - `follow` plays a recording that is still being made, for a member of a crew; `growth` reads what is added to it.
//! - `export` writes it for other programs.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use crate::app::effect::ReplayEffect;
use crate::app::event::{Event, LinkEvent, ReplayEvent, Started};
use crate::app::room::messages::{LinkTraffic, TrafficRequest};
use crate::app::state::ReplayView;
use crate::config::Config;
use crate::doctor::{Cause, LinkFinding, Way};
use crate::language::{LoopTarget, SeekTarget};
use crate::moment::Moment;
use crate::notice::Notice;
use crate::review::Review;
use crate::scoring::Report;
use crate::text;
use crate::text::{Text, clock};
use crate::vehicle::Severity;

mod contents;
mod export;
mod film;
mod follow;
mod growth;
mod index;
mod logs;
mod moments;
mod observer;
mod player;
mod stage;
#[cfg(test)]
mod tests;

use contents::{Contents, showing};
pub use export::{ExportFormat, export};
pub use film::{Film, TlogSpan};
use index::Index;
pub use logs::join_log;
use player::Player;
use stage::{LINK, Stage};

/// The time between frames of a replay.
pub const FRAME: Duration = Duration::from_millis(100);
/// The time between key frames taken while playing forward.
const KEY_AHEAD: Duration = Duration::from_secs(3);
/// The maximum number of frames of the replay that are played between two checks of the keyboard.
const STEPS_AT_ONCE: usize = 1000;
/// The maximum number of MAVLink frames that are read between two checks of the keyboard. At half a
/// microsecond each, that takes a tenth of a second.
const HEARD_AT_ONCE: u64 = 200_000;

/// A recording that is replayed.
#[derive(Debug)]
pub struct Replay {
    film: Arc<Film>,
    stage: Stage,
    index: Index,
    player: Player,
    contents: Contents,
    /// The length last reported to the console, and the number of gaps.
    known_length: Duration,
    known_gaps: usize,
    /// Whether the damage to the frames has been reported.
    has_told_damage: bool,
    /// Whether it goes to the end, which may turn out to be later than estimated.
    goes_to_end: bool,
    /// Up to which time a recording that is still being made is complete; `None` for others.
    complete_to: Option<Duration>,
}

impl Replay {
    /// Opens a recording: a tlog, or a file of a record; `config` contains the muted alerts.
    /// Returns the replay with its initial events.
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
        replay.player.pause();
        Ok((replay, events))
    }

    fn begin(path: &Path, config: &Config, is_review: bool) -> Result<(Self, Vec<Event>), Text> {
        let film = Arc::new(Film::open(path)?);
        let index = Index::begin(&film, &film.started(), config)?;
        let stage = Stage::new(&film)?;
        Ok(Self::of(film, stage, index, is_review))
    }

    fn of(film: Arc<Film>, stage: Stage, index: Index, is_review: bool) -> (Self, Vec<Event>) {
        let started = film.started();
        let mut view = film.view();
        view.review = film.review().clone();
        view.is_review = is_review;
        let logs = film.logs().iter();
        let curves = logs.map(|log| (log.vehicle, log.curves.clone()));
        view.log_curves = Arc::new(curves.collect());
        view.moments = Arc::new(view.review.bookmarks(&film.bookmarks()));
        let mut events = begin(view, started);
        events.extend(stage.begun());
        events.extend(film.damage().map(warning));
        let replay = Self {
            stage,
            index,
            player: Player::default(),
            contents: Contents::new(&film),
            known_length: Duration::ZERO,
            has_told_damage: false,
            goes_to_end: false,
            known_gaps: 0,
            complete_to: film.grows().then_some(Duration::ZERO),
            film,
        };
        (replay, events)
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
        if let Some(to) = self.complete_to {
            return self.follow_to(to);
        }
        let length = self.length();
        if self.goes_to_end {
            self.player.go_to(length);
            self.goes_to_end = self.index.length().is_none();
        }
        self.player
            .tick(now, self.stage.now(), &self.contents, length);
        let mut events = self.approach();
        events.extend(self.news());
        if self.index.length().is_some() && !std::mem::replace(&mut self.has_told_damage, true) {
            events.extend(self.index.damage().into_iter().map(warning));
        }
        events.extend(self.new_gaps());
        events
    }

    /// Applies a control of the replay, such as play or seek; returns its events.
    pub fn steer(&mut self, effect: ReplayEffect) -> Vec<Event> {
        match self.control(effect) {
            Ok(said) => {
                let mut events = self.approach();
                events.extend(said.map(Event::Answer));
                events
            }
            Err(fault) => vec![Event::Failed(fault)],
        }
    }

    /// Applies a control; returns a remark about an effect that the user may not expect.
    fn control(&mut self, effect: ReplayEffect) -> Result<Option<Text>, Text> {
        if self.complete_to.is_some() && !matches!(effect, ReplayEffect::Keep(_)) {
            return Err(text!("crew-live"));
        }
        let now = self.stage.now();
        self.goes_to_end = effect == ReplayEffect::Seek(SeekTarget::End);
        match effect {
            ReplayEffect::Play(plays) => {
                self.player.play(plays);
                if plays && self.is_at_end() {
                    self.player.go_to(Duration::ZERO);
                }
            }
            ReplayEffect::Rewind => self.player.rewind(now),
            ReplayEffect::Rate(rate) => self.player.set_rate(rate),
            ReplayEffect::Seek(target) => {
                let goal = self.target(target);
                return Ok(self.jump(goal.ok_or_else(|| self.no_target(target))?));
            }
            ReplayEffect::Step { forward } => {
                self.player.pause();
                return Ok(self.jump(if forward {
                    (now + FRAME).min(self.length())
                } else {
                    now.saturating_sub(FRAME)
                }));
            }
            ReplayEffect::Moment { forward } => {
                let goal = self.contents.near(now, forward, None);
                return Ok(self.jump(goal.ok_or_else(|| self.no_moment(forward))?));
            }
            ReplayEffect::Show(at) => return Ok(self.jump(showing(at).min(self.length()))),
            ReplayEffect::Loop(None) => self.player.repeat(None),
            ReplayEffect::Loop(Some(target)) => {
                let stretch = self
                    .stretch(target)
                    .ok_or_else(|| self.no_stretch(target))?;
                self.player.repeat(Some(stretch));
            }
            ReplayEffect::StopAt(kinds) => self.player.stop_at(kinds),
            ReplayEffect::Keep(review) => self.contents.keep(*review)?,
        }
        Ok(None)
    }

    /// Goes to a time, at most the end, and stops repeating a section if the time lies outside. Returns a remark if the
    /// time was beyond the end or the repetition has stopped.
    fn jump(&mut self, goal: Duration) -> Option<Text> {
        let length = self.length();
        let looped = self.player.repeated();
        self.player.go_to(goal.min(length));
        if looped.is_some_and(|(from, to)| !(from..=to).contains(&goal.min(length))) {
            self.player.repeat(None);
            return Some(text!("loop-left"));
        }
        (goal > length).then(|| text!("seek-beyond", length = clock(length)))
    }

    /// The time of a target; `None` if no moment matches, or for mission time without a mission.
    fn target(&self, target: SeekTarget) -> Option<Duration> {
        let now = self.stage.now();
        match target {
            SeekTarget::At(at) => Some(at),
            SeekTarget::Later(by) => Some(now.saturating_add(by)),
            SeekTarget::Earlier(by) => Some(now.saturating_sub(by)),
            SeekTarget::Next(kind) => self.contents.near(now, true, Some(kind)),
            SeekTarget::Previous(kind) => self.contents.near(now, false, Some(kind)),
            SeekTarget::Mission(elapsed) => self.film.clock().record_time(elapsed).map(showing),
            SeekTarget::End => Some(self.length()),
        }
    }

    fn no_target(&self, target: SeekTarget) -> Text {
        let is_read = self.index.length().is_some();
        match target {
            SeekTarget::Next(_) | SeekTarget::Previous(_) if !is_read => text!("seek-none-yet"),
            SeekTarget::Next(kind) if self.contents.has(kind) => {
                text!("seek-none-later", kind = kind.text())
            }
            SeekTarget::Previous(kind) if self.contents.has(kind) => {
                text!("seek-none-earlier", kind = kind.text())
            }
            SeekTarget::At(_)
            | SeekTarget::Later(_)
            | SeekTarget::Earlier(_)
            | SeekTarget::Next(_)
            | SeekTarget::Previous(_)
            | SeekTarget::Mission(_)
            | SeekTarget::End => text!("seek-none"),
        }
    }

    fn no_moment(&self, forward: bool) -> Text {
        match (forward, self.index.length()) {
            (true, Some(_)) => text!("seek-last"),
            (true, None) => text!("seek-none-yet"),
            (false, _) => text!("seek-first"),
        }
    }

    fn no_stretch(&self, target: LoopTarget) -> Text {
        match target {
            LoopTarget::Times { .. } => text!("loop-beyond", length = clock(self.length())),
            LoopTarget::Moments(_) => text!("loop-none"),
        }
    }

    /// The start and the end of a section to repeat; `None` if there are no moments of the kind on
    /// both sides, or if the section would begin after the end of the recording.
    fn stretch(&self, target: LoopTarget) -> Option<(Duration, Duration)> {
        let length = self.length();
        let (from, to) = match target {
            LoopTarget::Times { from, .. } if from >= length => return None,
            LoopTarget::Times { from, to } => (from, to),
            LoopTarget::Moments(kind) => self.contents.around(self.stage.now(), kind)?,
        };
        Some((from.min(length), to.min(length)))
    }

    /// The current traffic, for the *Messages* room.
    pub fn inspect(&mut self, request: &TrafficRequest) -> LinkTraffic {
        self.stage.inspect(request)
    }

    pub fn film(&self) -> &Film {
        &self.film
    }

    /// The current time in the recording.
    pub fn now(&self) -> Duration {
        self.stage.now()
    }

    /// Whether the replay has reached the time to go to.
    pub fn is_there(&self) -> bool {
        self.player.is_reached(self.stage.now())
    }

    /// The length of the recording, if known; otherwise an estimate.
    pub fn length(&self) -> Duration {
        let estimated = || self.complete_to.unwrap_or_else(|| self.film.length());
        self.index.length().unwrap_or_else(estimated)
    }

    /// Waits until the whole recording has been indexed.
    pub fn wait_for_index(&mut self) {
        self.index.finish();
        self.contents.merge(self.index.moments());
    }

    /// The faults of the files next to the recording, and of its frames once all are read.
    pub fn damage(&self) -> impl Iterator<Item = Text> {
        self.film.damage().chain(self.index.damage())
    }

    /// All moments found so far, earliest first.
    pub fn moments(&self) -> &[Moment] {
        self.contents.moments()
    }

    pub fn reviewed(&self) -> &Review {
        self.contents.review()
    }

    /// The report of the recorded mission, once indexed.
    pub fn report(&self) -> Option<Arc<Report>> {
        self.index.report()
    }

    /// Whether everything has been played; of a recording that is still being made, everything that is complete.
    pub fn is_at_end(&self) -> bool {
        self.stage.now() + FRAME > self.length()
    }

    /// Plays towards the time to go to, as far as one tick allows.
    fn approach(&mut self) -> Vec<Event> {
        let mut events = Vec::new();
        let (now, goal) = (self.stage.now(), self.player.goal());
        if let Some(key) = self.index.key_frame(goal)
            && (goal + FRAME <= now || key.at() > now + KEY_AHEAD)
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
            events.push(self.at());
            events.extend(told);
        }
        events.push(self.at());
        events
    }

    fn at(&self) -> Event {
        let position = self.player.shown(self.stage.now(), self.stage.gap());
        ReplayEvent::At(position).into()
    }

    /// All gaps found so far, if there are new ones since the last call.
    fn new_gaps(&mut self) -> Option<Event> {
        let gaps = self.index.gaps();
        let known = std::mem::replace(&mut self.known_gaps, gaps.len());
        (gaps.len() > known).then(|| ReplayEvent::Gaps(gaps).into())
    }

    /// The event `Known`, if the moments or the length have changed since the last call.
    fn news(&mut self) -> Option<Event> {
        self.player.note_indexed(self.index.reached());
        let length = self.length();
        let is_longer = std::mem::replace(&mut self.known_length, length) != length;
        let has_changed = self.contents.merge(self.index.moments());
        let event = ReplayEvent::Known {
            length,
            moments: Arc::clone(self.contents.moments()),
            report: self.report(),
        };
        (has_changed || is_longer).then(|| event.into())
    }
}

fn warning(text: Text) -> Event {
    Event::Notice(Notice::general(Duration::ZERO, Severity::Warning, text))
}

fn begin(view: ReplayView, started: Started) -> Vec<Event> {
    vec![
        ReplayEvent::Opened {
            view: Box::new(view),
            started: Box::new(started),
        }
        .into(),
        LinkEvent::Findings(vec![LinkFinding {
            link: LINK.into(),
            way: Way::File,
            cause: Cause::Recording,
            boards: Vec::new(),
        }])
        .into(),
    ]
}
