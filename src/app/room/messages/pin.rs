//! Fields that are drawn as graphs.

use std::collections::VecDeque;
use std::time::Duration;

use super::LinkTraffic;
use crate::inspector::{FieldReading, TallyKey, read};
use crate::wire::Anatomy;

/// The time span of a graph.
pub const GRAPH_SPAN: Duration = Duration::from_secs(60);
/// The maximum number of points of one graph: 60 seconds at 50 Hz.
const MOST_POINTS: usize = 3000;
/// A field that is drawn as a graph.
#[derive(Debug, Clone, PartialEq)]
pub struct Pin {
    /// The link, by its number.
    pub link: usize,
    pub key: TallyKey,
    /// The field's index in the message.
    pub field: usize,
    /// Message and field, as in `ATTITUDE.roll`.
    pub title: String,
    pub unit: &'static str,
    /// Times on the link's clock, and values; oldest first.
    pub points: VecDeque<(Duration, f64)>,
    /// The link's time at the last update.
    pub now: Duration,
    /// The number of frames that arrived too fast to be drawn.
    pub dropped: u64,
}

/// The minimum, the maximum and the newest value in the time span of a graph.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PinExtent {
    pub low: f64,
    pub high: f64,
    pub now: f64,
}

impl Pin {
    pub(super) fn take(&mut self, seen: &LinkTraffic) {
        self.now = seen.now;
        let mine = seen.watched.iter().find(|watched| watched.key == self.key);
        for (at, bytes) in mine.iter().flat_map(|watched| &watched.frames) {
            let reading = Anatomy::of(bytes).map(|frame| read(&frame));
            let value = reading.as_ref().and_then(|it| it.values.get(self.field));
            if let Some(number) = value
                .filter(|it| !it.is_unknown)
                .and_then(FieldReading::number)
            {
                self.points.push_back((*at, number));
            }
        }
        self.dropped += mine.map_or(0, |watched| watched.dropped);
        let oldest = self.now.saturating_sub(GRAPH_SPAN);
        while self.points.len() > MOST_POINTS || self.points.front().is_some_and(|it| it.0 < oldest)
        {
            self.points.pop_front();
        }
    }

    /// The range of the values; `None` if there are no values.
    pub fn extent(&self) -> Option<PinExtent> {
        let (_, now) = self.points.back()?;
        let values = || self.points.iter().map(|(_, value)| *value);
        Some(PinExtent {
            low: values().fold(f64::INFINITY, f64::min),
            high: values().fold(f64::NEG_INFINITY, f64::max),
            now: *now,
        })
    }
}
