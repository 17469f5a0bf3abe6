//! The after-action review of a flight: the pilot's own conclusions. It is stored next to the record, which it never
//! changes.
//!
//! A review has four questions: what was planned, what happened, why, and what next. The record answers the first two.
//! The pilot answers the other two before the program explains the score, because people learn more from their own
//! conclusions. The pilot can note up to three points to keep and three to improve, each tied to a moment of the
//! flight; the next brief of the mission repeats them.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::moment::{Moment, MomentKind};
use crate::record::Head;
use crate::text;
use crate::text::Text;

mod markdown;

pub use markdown::{ReviewedFlight, markdown};

const VERSION: u32 = 1;
/// The maximum number of points of one kind, because more would not be remembered.
pub const MOST_POINTS: usize = 3;
const MOST_BOOKMARKS: usize = 1000;

/// A review, as stored next to a record.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Review {
    #[serde(rename = "sortie_review")]
    version: u32,
    /// The mission that was flown, by id.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mission: Option<String>,
    /// The profile of the pilot, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<String>,
    /// The pilot's answer to why the flight went as it did.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub why: String,
    /// The pilot's answer to what to do next time.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub next: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    points: Vec<ReviewPoint>,
    /// The current bookmarks, earliest first; `None` while the record's own bookmarks apply.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    bookmarks: Option<Vec<Bookmark>>,
}

/// Something to keep or to improve, tied to a moment.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReviewPoint {
    pub kind: PointKind,
    /// The moment of the point: milliseconds from the beginning of the record.
    at_ms: u64,
    pub text: String,
}

/// The kind of a point: to keep or to improve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PointKind {
    /// Something that went well and should be repeated.
    Sustain,
    /// Something to do differently next time.
    Improve,
}

/// A bookmark that was set or changed after the flight.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bookmark {
    /// Milliseconds from the beginning of the record.
    at_ms: u64,
    text: String,
}

impl PointKind {
    pub const ALL: [Self; 2] = [Self::Sustain, Self::Improve];

    /// The name of the kind: to sustain, to improve.
    pub fn text(self) -> Text {
        match self {
            Self::Sustain => text!("review-sustain"),
            Self::Improve => text!("review-improve"),
        }
    }

    /// The heading of the kind in documents.
    pub fn heading(self) -> Text {
        match self {
            Self::Sustain => text!("review-sustain-heading"),
            Self::Improve => text!("review-improve-heading"),
        }
    }

    /// The sign of the kind in lists.
    pub fn sign(self) -> char {
        match self {
            Self::Sustain => '+',
            Self::Improve => '-',
        }
    }
}

impl ReviewPoint {
    /// Whether the point's moment is at this time.
    pub fn is_at(&self, at: Duration) -> bool {
        self.at_ms == milliseconds(at)
    }

    /// The moment of the point, from the beginning of the record.
    pub fn at(&self) -> Duration {
        Duration::from_millis(self.at_ms)
    }
}

impl Default for Review {
    fn default() -> Self {
        Self {
            version: VERSION,
            mission: None,
            profile: None,
            why: String::new(),
            next: String::new(),
            points: Vec::new(),
            bookmarks: None,
        }
    }
}

impl Review {
    /// An empty review for a flight with this journal.
    pub fn of(head: Option<&Head>) -> Self {
        Self {
            mission: head.and_then(|it| it.subject.mission()).map(str::to_owned),
            profile: head.and_then(|it| it.profile.clone()),
            ..Self::default()
        }
    }

    /// Reads a review from the text of its file.
    ///
    /// # Errors
    /// The text is not a review, or comes from another version.
    pub fn read(text: &str) -> Result<Self, Text> {
        let review: Self = serde_json::from_str(text)
            .map_err(|error| text!("review-unreadable", error = error.to_string()))?;
        if review.version != VERSION {
            let version = review.version;
            return Err(text!("record-version", version = version, known = VERSION));
        }
        Ok(review)
    }

    /// The review as a JSON document.
    pub fn to_json(&self) -> String {
        // Plain data can always be written.
        let json = serde_json::to_string_pretty(self).unwrap_or_default();
        json + "\n"
    }

    /// The points to keep and to improve, in the order of their input.
    pub fn points(&self) -> &[ReviewPoint] {
        &self.points
    }

    pub fn points_of(&self, kind: PointKind) -> impl Iterator<Item = &ReviewPoint> {
        self.points.iter().filter(move |it| it.kind == kind)
    }

    /// Whether the pilot has answered both questions: only then is the score explained.
    pub fn is_answered(&self) -> bool {
        !self.why.is_empty() && !self.next.is_empty()
    }

    /// Adds a point at a time of the recording.
    ///
    /// # Errors
    /// The review already has the maximum number of points of this kind.
    pub fn add(&mut self, kind: PointKind, at: Duration, text: String) -> Result<(), Text> {
        if self.points_of(kind).count() >= MOST_POINTS {
            return Err(text!("review-full", kind = kind.text(), most = MOST_POINTS));
        }
        let at_ms = milliseconds(at);
        self.points.push(ReviewPoint { kind, at_ms, text });
        Ok(())
    }

    /// Removes a point by its number, from 1.
    ///
    /// # Errors
    /// The review has no point with this number.
    pub fn remove(&mut self, number: usize) -> Result<(), Text> {
        let at = number
            .checked_sub(1)
            .filter(|&at| at < self.points.len())
            .ok_or_else(|| text!("review-no-point", number = number))?;
        self.points.remove(at);
        Ok(())
    }

    /// The current bookmarks: the record's own, unless they have been changed.
    pub fn bookmarks(&self, recorded: &[Moment]) -> Vec<Moment> {
        match &self.bookmarks {
            Some(own) => own.iter().map(Bookmark::moment).collect(),
            None => recorded.to_vec(),
        }
    }

    /// Sets a bookmark at a time, or changes the text of an existing one; `now` is the current list of bookmarks.
    ///
    /// # Errors
    /// The review already has the maximum number of bookmarks.
    pub fn set_bookmark(&mut self, now: &[Moment], at: Duration, text: String) -> Result<(), Text> {
        let mut all = stored(now);
        let at_ms = milliseconds(at);
        if let Some(known) = all.iter_mut().find(|it| it.at_ms == at_ms) {
            known.text = text;
        } else if all.len() < MOST_BOOKMARKS {
            all.push(Bookmark { at_ms, text });
        } else {
            return Err(text!("review-bookmarks-full", most = MOST_BOOKMARKS));
        }
        all.sort_by_key(|it| it.at_ms);
        self.bookmarks = Some(all);
        Ok(())
    }

    /// Removes the bookmark at a time; `now` is the current list of bookmarks.
    pub fn remove_bookmark(&mut self, now: &[Moment], at: Duration) {
        let mut all = stored(now);
        all.retain(|it| it.at_ms != milliseconds(at));
        self.bookmarks = Some(all);
    }
}

impl Bookmark {
    fn moment(&self) -> Moment {
        Moment {
            at: Duration::from_millis(self.at_ms),
            vehicles: Vec::new(),
            kind: MomentKind::Bookmark,
            by: None,
            text: Text::verbatim(self.text.clone()),
        }
    }
}

fn stored(bookmarks: &[Moment]) -> Vec<Bookmark> {
    let stored = |moment: &Moment| Bookmark {
        at_ms: milliseconds(moment.at),
        text: moment.text.to_string(),
    };
    bookmarks.iter().map(stored).collect()
}

fn milliseconds(at: Duration) -> u64 {
    u64::try_from(at.as_millis()).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests;
