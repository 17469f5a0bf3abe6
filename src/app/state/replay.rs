//! What is shown of a recording that is replayed.

use std::sync::Arc;
use std::time::Duration;

use crate::moment::{Moment, MomentKind};
use crate::review::Review;
use crate::scoring::Report;

/// What is shown belongs to a moment that was so short a time before: two frames.
const SAME_MOMENT: Duration = Duration::from_millis(200);

/// A recording that is replayed, and how far it has come.
#[derive(Debug, Clone, PartialEq)]
pub struct ReplayView {
    /// The name of its file.
    pub name: String,
    /// The time of day when it began: microseconds since 1970 (UTC).
    pub began_unix_us: u64,
    /// How long it is.
    pub length: Duration,
    /// The place in the recording, and the pace.
    pub position: ReplayPosition,
    /// The moments that have been found so far, earliest first.
    pub moments: Arc<Vec<Moment>>,
    /// What the mission was scored, once that is known.
    pub report: Option<Arc<Report>>,
    /// What its user makes of it.
    pub review: Review,
    /// Whether it was opened to be reviewed.
    pub is_review: bool,
}

/// The position and the pace of a replay. Times count from the beginning of the recording.
#[derive(Debug, Clone, PartialEq)]
pub struct ReplayPosition {
    pub at: Duration,
    /// How far the recording has been read through: up to there, every moment is found at once.
    pub indexed: Duration,
    /// How many times as fast as it was recorded it is played.
    pub rate: f64,
    pub is_playing: bool,
    /// Whether it plays backwards.
    pub is_backwards: bool,
    /// The stretch that is played over and over.
    pub looped: Option<(Duration, Duration)>,
    /// The kinds of moments that it stops at.
    pub stops: Vec<MomentKind>,
    /// For how long nothing was recorded at this place, if it is a gap.
    pub gap: Option<Duration>,
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
        }
    }
}

impl ReplayView {
    /// A recording that is replayed from its beginning.
    pub fn new(name: String, began_unix_us: u64, length: Duration) -> Self {
        Self {
            name,
            began_unix_us,
            length,
            position: ReplayPosition::default(),
            moments: Arc::default(),
            report: None,
            review: Review::default(),
            is_review: false,
        }
    }

    /// The bookmarks, earliest first.
    pub fn bookmarks(&self) -> Vec<Moment> {
        let all = self.moments.iter();
        all.filter(|it| it.kind == MomentKind::Bookmark)
            .cloned()
            .collect()
    }

    /// Has the moments be those with the bookmarks of the review.
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

    /// When the bookmark was set that the frame now shown has, if it has one.
    pub fn bookmark_here(&self) -> Option<Duration> {
        let at = self.position.at;
        let mut latest = self.moments.iter().rev();
        let here = latest.find(|it| {
            it.kind == MomentKind::Bookmark && (it.at..=it.at + SAME_MOMENT).contains(&at)
        });
        here.map(|it| it.at)
    }

    /// The moment that the replay stands at or has passed last.
    pub fn current(&self) -> Option<&Moment> {
        let passed = self.moments.partition_point(|it| it.at <= self.position.at);
        self.moments.get(passed.checked_sub(1)?)
    }
}
