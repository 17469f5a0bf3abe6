//! The index of a recording: its moments, and snapshots at many times, from one pass through it.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::Film;
use super::moments::Lookout;
use super::observer::Observer;
use super::stage::{Cast, Stage};
use crate::app::FlightSnapshot;
use crate::app::event::Started;
use crate::app::state::ReplayPosition;
use crate::config::Config;
use crate::moment::Moment;
use crate::scoring::Report;
use crate::text::Text;

/// The initial time between key frames.
const KEY_EVERY: Duration = Duration::from_secs(10);
/// The maximum number of key frames kept; beyond that, every other one is dropped. Each takes a few
/// kilobytes per vehicle, and another twenty for its curves.
const MOST_KEYS: usize = 240;

/// A snapshot at one time.
#[derive(Debug)]
pub(super) struct KeyFrame {
    cast: Cast,
    flight: FlightSnapshot,
}

impl KeyFrame {
    pub fn at(&self) -> Duration {
        self.cast.at()
    }

    pub fn flight(&self) -> FlightSnapshot {
        self.flight.clone()
    }

    pub fn cast(&self) -> Cast {
        self.cast.clone()
    }
}

/// The index of a recording, for the part that has been read.
#[derive(Debug)]
pub(super) struct Index {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug, Default)]
struct Shared {
    found: Mutex<Found>,
    is_cancelled: AtomicBool,
}

#[derive(Debug, Default)]
struct Found {
    /// The key frames, earliest first, with one at the beginning.
    keys: Vec<Arc<KeyFrame>>,
    moments: Arc<Vec<Moment>>,
    report: Option<Arc<Report>>,
    gaps: Arc<Vec<Range<Duration>>>,
    reached: Duration,
    is_over: bool,
    damage: Vec<Text>,
}

impl Shared {
    fn found(&self) -> MutexGuard<'_, Found> {
        // The results from before a panic are still valid.
        self.found.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Index {
    /// Begins to index a recording.
    ///
    /// # Errors
    /// The file is gone, or no thread can be started.
    pub fn begin(film: &Arc<Film>, started: &Started, config: &Config) -> Result<Self, Text> {
        let stage = Stage::new(film)?;
        let view = film.view();
        let observer = Observer::new(view, started, config, stage.begun());
        let shared = Arc::new(Shared::default());
        let mut reader = IndexReader {
            shared: Arc::clone(&shared),
            lookout: Lookout::new(Arc::clone(film.clock()), film.separation_m()),
            stage,
            observer,
            key_every: KEY_EVERY,
        };
        // The first key frame is at the beginning, so that every time has one before it.
        reader.keep();
        let thread = std::thread::Builder::new()
            .name("index".to_owned())
            .spawn(move || reader.run())
            .map_err(|error| Text::verbatim(error.to_string()))?;
        Ok(Self {
            shared,
            thread: Some(thread),
        })
    }

    /// No index: a recording that is still being made is only followed.
    pub fn none() -> Self {
        Self {
            shared: Arc::default(),
            thread: None,
        }
    }

    /// How far the recording has been indexed.
    pub fn reached(&self) -> Duration {
        self.shared.found().reached
    }

    /// The length of the recording, once it has been indexed.
    pub fn length(&self) -> Option<Duration> {
        let found = self.shared.found();
        found.is_over.then_some(found.reached)
    }

    /// The moments found so far, earliest first, without bookmarks.
    pub fn moments(&self) -> Arc<Vec<Moment>> {
        Arc::clone(&self.shared.found().moments)
    }

    /// The gaps found so far, earliest first.
    pub fn gaps(&self) -> Arc<Vec<Range<Duration>>> {
        Arc::clone(&self.shared.found().gaps)
    }

    /// The result of the mission, once the index has reached the mission's end.
    pub fn report(&self) -> Option<Arc<Report>> {
        self.shared.found().report.clone()
    }

    /// The faults of the frames, once the recording has been indexed to its end.
    pub fn damage(&self) -> Vec<Text> {
        self.shared.found().damage.clone()
    }

    /// The last key frame that is not later than a time.
    pub fn key_frame(&self, at: Duration) -> Option<Arc<KeyFrame>> {
        let found = self.shared.found();
        let passed = found.keys.partition_point(|key| key.at() <= at);
        found.keys.get(passed.checked_sub(1)?).map(Arc::clone)
    }

    /// Waits until the recording has been indexed.
    pub fn finish(&mut self) {
        if let Some(thread) = self.thread.take() {
            drop(thread.join());
        }
    }
}

impl Drop for Index {
    fn drop(&mut self) {
        self.shared.is_cancelled.store(true, Ordering::Relaxed);
        self.finish();
    }
}

struct IndexReader {
    shared: Arc<Shared>,
    stage: Stage,
    observer: Observer,
    lookout: Lookout,
    key_every: Duration,
}

impl IndexReader {
    fn run(mut self) {
        let mut next_key = self.key_every;
        while !self.stage.is_over() && !self.shared.is_cancelled.load(Ordering::Relaxed) {
            let events = self.stage.step();
            let now = self.stage.now();
            let position = ReplayPosition {
                at: now,
                ..ReplayPosition::default()
            };
            self.observer.watch(position, &events);
            self.lookout
                .watch(now, &events, self.observer.app().state());
            self.note_gap();
            if now >= next_key {
                self.keep();
                next_key = now + self.key_every;
            }
        }
        self.lookout.end();
        self.publish();
        let mut found = self.shared.found();
        found.damage = self.stage.damage();
        found.is_over = true;
    }

    /// Adds the current gap, if it is a new one.
    fn note_gap(&mut self) {
        let Some(gap) = self.stage.gap_section() else {
            return;
        };
        let mut found = self.shared.found();
        if found.gaps.last().is_none_or(|last| last.start < gap.start) {
            Arc::make_mut(&mut found.gaps).push(gap);
        }
    }

    /// Adds a key frame.
    fn keep(&mut self) {
        let key = Arc::new(KeyFrame {
            cast: self.stage.cast(),
            flight: self.observer.snapshot(),
        });
        self.publish();
        let mut found = self.shared.found();
        found.keys.push(key);
        if found.keys.len() > MOST_KEYS {
            let mut at = 0;
            found.keys.retain(|_| {
                at += 1;
                at % 2 == 1
            });
            self.key_every *= 2;
        }
    }

    fn publish(&mut self) {
        let moments = self.lookout.found();
        let mut found = self.shared.found();
        found.reached = self.stage.now();
        if let Some(moments) = moments {
            found.moments = Arc::new(moments);
            found.report = self.lookout.report();
        }
    }
}
