//! Two flights of a mission side by side: the positions of the other flight's vehicles, the
//! differences, and the points that they cost.
//!
//! Times are those of the mission's own clock, so that flights can be compared at any speed-up. The
//! data of a flight come from its record, or from a pilot script that has just flown it; both give
//! the same data.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::geo::LatLon;
use crate::mission::record::Stored;
use crate::mission::{Flight, Progress};
use crate::moment::{Alignment, Moment};
use crate::record::MissionClock;
use crate::scoring::{EventKind, Report};
use crate::text::Text;
use crate::vehicle::{VehicleId, Vehicles};

mod difference;

pub use difference::{Difference, differences};

/// The time between the points of a track.
pub const SAMPLE_EVERY: Duration = Duration::from_secs(1);

/// The data of a flight for a comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedFlight {
    /// The name of the flight: a profile, a pilot, or a record.
    pub name: Text,
    pub report: Report,
    /// The positions of each vehicle, one per second from the start.
    tracks: BTreeMap<VehicleId, Vec<Option<TrackPoint>>>,
    /// When each objective was first reached, in the mission's order.
    reached: Vec<Option<Duration>>,
    /// When the first vehicle was in the air.
    takeoff: Option<Duration>,
    /// The duration of the flight.
    pub length: Duration,
    /// The bookmarks by the mission's clock, earliest first; empty if unknown.
    pub bookmarks: Vec<FlightBookmark>,
}

/// A bookmark, with its mission time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FlightBookmark {
    pub at: Duration,
    pub text: String,
}

impl FlightBookmark {
    /// The bookmarks of a record, converted to the mission's clock.
    pub fn of_moments(moments: &[Moment], clock: &MissionClock) -> Vec<Self> {
        let bookmark = |moment: &Moment| Self {
            at: clock.mission_time(moment.at).unwrap_or_default(),
            text: moment.text.to_string(),
        };
        moments.iter().map(bookmark).collect()
    }
}

/// The times at which two flights are aligned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Anchors {
    pub own: Duration,
    pub other: Duration,
}

/// The state of a vehicle at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackPoint {
    pub place: LatLon,
    /// Height above home in metres.
    pub height_m: f64,
    /// The remaining charge of the battery in percent, if known.
    pub battery_percent: Option<f64>,
    pub is_airborne: bool,
}

impl ComparedFlight {
    /// The flight of a record, up to the end of the record.
    ///
    /// # Errors
    /// The record's mission cannot be read.
    pub fn of_record(stored: &Stored, name: Text) -> Result<Self, Text> {
        let mut flight = stored.reenact()?;
        let mut course = FlightCourse::default();
        let limit = flight.flight().mission().rules.time_limit;
        while !flight.is_over() && !flight.flight().is_over() && course.next() <= limit {
            drop(flight.advance(course.next()));
            course.note(flight.vehicles(), flight.flight());
        }
        drop(flight.advance(Duration::MAX));
        let progress = flight.flight().progress();
        Ok(course.finish(name, flight.report(), &progress))
    }

    /// The same flight with bookmarks, earliest first.
    #[must_use]
    pub fn with_bookmarks(mut self, bookmarks: Vec<FlightBookmark>) -> Self {
        self.bookmarks = bookmarks;
        self
    }

    /// The positions of the flight's vehicles at a mission time; empty before its start and after
    /// its end.
    pub fn at(&self, time: Duration) -> impl Iterator<Item = (VehicleId, TrackPoint)> {
        let second = sample_of(time);
        self.tracks.iter().filter_map(move |(&vehicle, track)| {
            let point = track.get(second).copied().flatten()?;
            Some((vehicle, point))
        })
    }

    /// The paths of the flight's vehicles in the air up to a mission time.
    pub fn ways(&self, until: Duration) -> impl Iterator<Item = Vec<LatLon>> {
        let count = sample_of(until).saturating_add(1);
        self.tracks.values().map(move |track| {
            let points = track.iter().take(count).flatten();
            let flown = points.filter(|it| it.is_airborne).map(|it| it.place);
            flown.collect()
        })
    }

    /// Whether each objective had been reached by a mission time, in the mission's order.
    pub fn reached_by(&self, time: Duration) -> impl Iterator<Item = bool> {
        self.reached
            .iter()
            .map(move |at| at.is_some_and(|at| at <= time))
    }

    /// The height of the highest vehicle at a mission time, in metres above home; `None` without
    /// data for that time.
    pub fn height_m(&self, time: Duration) -> Option<f64> {
        let heights = self.at(time).map(|(_, point)| point.height_m);
        heights.max_by(f64::total_cmp)
    }

    /// The lowest charge of the vehicles' batteries at a mission time, in percent; `None` if no
    /// charge is known.
    pub fn battery_percent(&self, time: Duration) -> Option<f64> {
        let left = self.at(time).filter_map(|(_, it)| it.battery_percent);
        left.min_by(f64::total_cmp)
    }

    /// The times at which both flights are aligned; `None` if one of them lacks the event. An
    /// alignment by bookmarks uses the first pair of bookmarks with the same text; without such a
    /// pair, the first bookmark of each flight.
    pub fn anchors(own: &Self, other: &Self, alignment: Alignment) -> Option<Anchors> {
        let same = || {
            own.bookmarks.iter().find_map(|mine| {
                let theirs = other.bookmarks.iter().find(|it| it.text == mine.text)?;
                Some(Anchors {
                    own: mine.at,
                    other: theirs.at,
                })
            })
        };
        let each = || {
            Some(Anchors {
                own: own.anchor(alignment)?,
                other: other.anchor(alignment)?,
            })
        };
        match alignment {
            Alignment::Bookmark => same().or_else(each),
            Alignment::Start
            | Alignment::Takeoff
            | Alignment::Objective
            | Alignment::Alert
            | Alignment::Refusal => each(),
        }
    }

    /// The time of the event by which the flight is aligned with another one; `None` if the flight
    /// lacks the event.
    pub fn anchor(&self, alignment: Alignment) -> Option<Duration> {
        match alignment {
            Alignment::Start => Some(Duration::ZERO),
            Alignment::Takeoff => self.takeoff,
            Alignment::Objective => self.reached.iter().flatten().min().copied(),
            Alignment::Alert => self.first(EventKind::Alert),
            Alignment::Refusal => self.first(EventKind::Rejected),
            Alignment::Bookmark => self.bookmarks.first().map(|it| it.at),
        }
    }

    fn first(&self, kind: EventKind) -> Option<Duration> {
        let mut events = self.report.events.iter();
        let first = events.find(|it| it.kind == kind)?;
        Duration::try_from_secs_f64(first.at_s).ok()
    }
}

fn sample_of(time: Duration) -> usize {
    let sample = time.as_millis() / SAMPLE_EVERY.as_millis();
    usize::try_from(sample).unwrap_or(usize::MAX)
}

/// The course of a flight, recorded during the flight.
#[derive(Debug, Default)]
pub struct FlightCourse {
    samples: u32,
    tracks: BTreeMap<VehicleId, Vec<Option<TrackPoint>>>,
    reached: Vec<Option<Duration>>,
    takeoff: Option<Duration>,
}

impl FlightCourse {
    /// The mission time of the next sample.
    pub fn next(&self) -> Duration {
        SAMPLE_EVERY * self.samples
    }

    /// Records the state of the flight at the time that [`next`](Self::next) returned.
    pub fn note(&mut self, vehicles: &Vehicles, flight: &Flight) {
        let now = self.next();
        for (&id, vehicle) in vehicles {
            let track = self.tracks.entry(id).or_default();
            track.resize(self.samples as usize, None);
            let is_airborne = vehicle.airborne();
            let battery = vehicle.battery().and_then(|it| it.remaining_percent);
            track.push(vehicle.global.map(|global| TrackPoint {
                place: global.at_point,
                height_m: global.altitude_m,
                battery_percent: battery.map(f64::from),
                is_airborne,
            }));
            if is_airborne {
                self.takeoff.get_or_insert(now);
            }
        }
        self.note_objectives(&flight.progress(), now);
        self.samples += 1;
    }

    fn note_objectives(&mut self, progress: &Progress, now: Duration) {
        self.reached.resize(progress.objectives.len(), None);
        for (objective, reached) in progress.objectives.iter().zip(&mut self.reached) {
            if objective.is_reached() {
                // The objective was reached after the previous sample.
                reached.get_or_insert(now.saturating_sub(SAMPLE_EVERY));
            }
        }
    }

    /// The flight with its result. `progress` is the mission at its end, which may decide objectives after the last
    /// sample.
    pub fn finish(mut self, name: Text, report: Report, progress: &Progress) -> ComparedFlight {
        let length = Duration::try_from_secs_f64(report.sim_time_s).unwrap_or_default();
        self.note_objectives(progress, length + SAMPLE_EVERY);
        ComparedFlight {
            name,
            length,
            report,
            tracks: self.tracks,
            reached: self.reached,
            takeoff: self.takeoff,
            bookmarks: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mission::fake::fly_the_cells;

    #[test]
    fn objectives_decided_at_the_end_were_reached_then() {
        let pilot = fly_the_cells(7);
        let (report, progress) = (pilot.report(), pilot.flight.progress());
        let flight = FlightCourse::default().finish("end".into(), report, &progress);
        let met = flight.report.objectives.iter().map(|it| it.met);
        let end: Vec<Option<Duration>> = met.map(|met| met.then_some(flight.length)).collect();
        assert!(end.iter().any(Option::is_some), "{end:?}");
        assert_eq!(flight.reached, end);
    }
}
