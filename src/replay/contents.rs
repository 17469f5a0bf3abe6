//! The table of contents of a recording: its moments, and the user's review of them.

use std::sync::Arc;
use std::time::Duration;

use super::{FRAME, Film};
use crate::dataflash::JoinedLog;
use crate::moment::{Moment, MomentKind};
use crate::review::Review;
use crate::text;
use crate::text::Text;

/// The moments of a recording: the moments indexed so far, the bookmarks, and the moments of joined
/// logs.
#[derive(Debug)]
pub(super) struct Contents {
    film: Arc<Film>,
    review: Review,
    moments: Arc<Vec<Moment>>,
    /// The index's moments as last merged.
    merged: Option<Arc<Vec<Moment>>>,
}

impl Contents {
    /// The contents before anything is indexed.
    pub fn new(film: &Arc<Film>) -> Self {
        Self {
            film: Arc::clone(film),
            review: film.review().clone(),
            moments: Arc::default(),
            merged: None,
        }
    }

    /// All moments found so far, earliest first.
    pub fn moments(&self) -> &Arc<Vec<Moment>> {
        &self.moments
    }

    #[cfg(test)]
    pub fn replace(&mut self, moments: Vec<Moment>) {
        self.moments = Arc::new(moments);
    }

    pub fn review(&self) -> &Review {
        &self.review
    }

    /// Stores the user's review next to the recording. It applies to this replay even if it cannot be written.
    pub fn keep(&mut self, review: Review) -> Result<(), Text> {
        self.review = review;
        self.merged = None;
        // An unreadable review is not replaced: it may come from a later version.
        if let Some(fault) = self.film.review_fault() {
            return Err(text!("review-not-kept", fault = fault.clone()));
        }
        let written = self.film.files().write_review(&self.review);
        written.map_err(|error| Text::from(&error))
    }

    /// Merges the moments of the index, the bookmarks and the moments of the joined logs if the
    /// index or the bookmarks have changed; returns whether they have changed.
    pub fn merge(&mut self, found: Arc<Vec<Moment>>) -> bool {
        let before = self.merged.as_ref();
        if before.is_some_and(|it| Arc::ptr_eq(it, &found)) {
            return false;
        }
        let bookmarks = self.review.bookmarks(&self.film.bookmarks());
        // The file may have been changed by hand.
        let length = self.film.length();
        let logs = self.film.logs().iter();
        let logged = logs
            .flat_map(JoinedLog::moments)
            .filter(|it| it.at <= length);
        let indexed = found.iter().cloned();
        let mut all: Vec<Moment> = indexed.chain(bookmarks).chain(logged).collect();
        all.sort_by_key(|it| it.at);
        self.moments = Arc::new(all);
        self.merged = Some(found);
        true
    }

    /// The time of the frame that shows the next or the previous moment, of a kind or of any.
    pub fn near(&self, now: Duration, forward: bool, kind: Option<MomentKind>) -> Option<Duration> {
        let is_meant = |it: &&Moment| kind.is_none_or(|kind| it.kind == kind);
        let mut moments = self.moments.iter().filter(is_meant);
        // A moment that was just reached is skipped, so that pressing the key again goes further back.
        let found = if forward {
            moments.find(|it| it.at >= now + FRAME)
        } else {
            moments.rfind(|it| it.at + FRAME * 2 <= now)
        };
        found.map(|it| showing(it.at))
    }

    /// Whether there is a moment of a kind so far.
    pub fn has(&self, kind: MomentKind) -> bool {
        self.moments.iter().any(|it| it.kind == kind)
    }

    /// The times of the frames that show the previous moment of a kind and the next one.
    pub fn around(&self, now: Duration, kind: MomentKind) -> Option<(Duration, Duration)> {
        let times = self.moments.iter().filter(|it| it.kind == kind);
        let mut shown = times.map(|it| showing(it.at));
        let last = shown.clone().rfind(|at| *at <= now)?;
        Some((last, shown.find(|at| *at > now)?))
    }

    /// The time of the frame that shows the first moment of these kinds between two times, in
    /// either direction; `None` if there is none.
    pub fn between(&self, from: Duration, to: Duration, kinds: &[MomentKind]) -> Option<Duration> {
        let stops = |it: &&Moment| kinds.contains(&it.kind);
        let times = self.moments.iter().filter(stops).map(|it| it.at);
        let first = if from <= to {
            times.filter(|&at| at > from && at <= to).min()
        } else {
            // The replay has already stopped at the moment that is shown at `from`.
            times
                .filter(|&at| showing(at) < from && showing(at) >= to)
                .max()
        };
        first.map(showing)
    }
}

/// The time of the frame that shows an event at `at`; a frame contains the events before its end.
pub(super) fn showing(at: Duration) -> Duration {
    let frames = at.as_millis() / FRAME.as_millis() + 1;
    FRAME * u32::try_from(frames).unwrap_or(u32::MAX)
}
