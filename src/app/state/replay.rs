//! The console's view of a replay.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use crate::dataflash::LogCurves;
use crate::moment::{Moment, MomentKind};
use crate::record::{DayClock, MissionClock};
use crate::review::Review;
use crate::scoring::Report;
use crate::vehicle::VehicleId;

/// How long a moment counts as shown after its time: two frames.
const SAME_MOMENT: Duration = Duration::from_millis(200);

/// A replayed recording and the position in it.
#[derive(Debug, Clone, PartialEq)]
pub struct ReplayView {
    /// The name of the recording's file.
    pub name: String,
    /// The start of the recording, in microseconds since 1970 (UTC).
    pub began_unix_us: u64,
    pub length: Duration,
    /// The recording's clock for the time of day, with the pauses.
    pub day: Arc<DayClock>,
    /// The mission's clock; empty without a mission.
    pub clock: Arc<MissionClock>,
    /// The position in the recording, and the rate.
    pub position: ReplayPosition,
    /// The moments found so far, earliest first.
    pub moments: Arc<Vec<Moment>>,
    /// The gaps of the recording found so far, earliest first.
    pub gaps: Arc<Vec<Range<Duration>>>,
    /// The curves from vehicle logs joined to the recording. Their seconds count from the start of
    /// the recording.
    pub log_curves: Arc<BTreeMap<VehicleId, LogCurves>>,
    /// The mission's report, once it is known.
    pub report: Option<Arc<Report>>,
    pub review: Review,
    /// Whether the recording was opened for its review.
    pub is_review: bool,
    /// Whether the flight is still being flown by the host of a crew: this console follows its record.
    pub is_live: bool,
}

/// The position and the rate of a replay. Times count from the start of the recording.
#[derive(Debug, Clone, PartialEq)]
pub struct ReplayPosition {
    pub at: Duration,
    /// How far the recording has been indexed; jumps within this part are immediate.
    pub indexed: Duration,
    /// The rate as a multiple of the recorded speed.
    pub rate: f64,
    pub is_playing: bool,
    /// Whether the replay runs backwards.
    pub is_backwards: bool,
    pub looped: Option<(Duration, Duration)>,
    /// The kinds of moments at which to stop.
    pub stops: Vec<MomentKind>,
    /// The length of the gap in the recording at this position, if there is one.
    pub gap: Option<Duration>,
    /// The time to which the jump under way leads; `None` without a jump.
    pub goal: Option<Duration>,
}

impl Default for ReplayPosition {
    fn default() -> Self {
        Self {
            at: Duration::ZERO,
            indexed: Duration::ZERO,
            rate: 1.0,
            is_playing: true,
            is_backwards: false,
            looped: None,
            stops: Vec::new(),
            gap: None,
            goal: None,
        }
    }
}

impl ReplayView {
    /// A replay at the start of a recording.
    pub fn new(name: String, began_unix_us: u64, length: Duration) -> Self {
        Self {
            name,
            began_unix_us,
            length,
            day: Arc::default(),
            clock: Arc::default(),
            position: ReplayPosition::default(),
            moments: Arc::default(),
            gaps: Arc::default(),
            log_curves: Arc::default(),
            report: None,
            review: Review::default(),
            is_review: false,
            is_live: false,
        }
    }

    /// The bookmarks, earliest first.
    pub fn bookmarks(&self) -> Vec<Moment> {
        let all = self.moments.iter();
        all.filter(|it| it.kind == MomentKind::Bookmark)
            .cloned()
            .collect()
    }

    /// Merges the review's bookmarks into the moments.
    pub fn take_bookmarks(&mut self) {
        let bookmarks = self.review.bookmarks(&self.bookmarks());
        let others = self
            .moments
            .iter()
            .filter(|it| it.kind != MomentKind::Bookmark);
        let mut all: Vec<Moment> = others.cloned().chain(bookmarks).collect();
        all.sort_by_key(|it| it.at);
        self.moments = Arc::new(all);
    }

    /// The time of the bookmark on the current frame, if it has one.
    pub fn bookmark_here(&self) -> Option<Duration> {
        let at = self.position.at;
        let mut latest = self.moments.iter().rev();
        let here = latest.find(|it| {
            it.kind == MomentKind::Bookmark && (it.at..=it.at + SAME_MOMENT).contains(&at)
        });
        here.map(|it| it.at)
    }

    /// The index of the moment at the current position, or of the last one before it; the first one
    /// if none has passed. `None` without moments.
    pub fn current_index(&self) -> Option<usize> {
        let passed = self.moments.partition_point(|it| it.at <= self.position.at);
        (!self.moments.is_empty()).then(|| passed.saturating_sub(1))
    }

    /// The moment at the current position, or the last one before it; `None` before the first
    /// moment.
    pub fn current(&self) -> Option<&Moment> {
        let shown = self.moments.get(self.current_index()?)?;
        (shown.at <= self.position.at).then_some(shown)
    }
}
