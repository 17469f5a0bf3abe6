//! The positions of each vehicle.

use std::collections::BTreeMap;
use std::time::Duration;

use chrono::{DateTime, SecondsFormat, Utc};
use mavlink::dialects::ardupilotmega::MavMessage;

use super::records;
use crate::replay::Film;
use crate::text::Text;
use crate::wire::{Content, Decoder, SystemId};

/// The tracks of the vehicles.
pub(super) type Tracks = BTreeMap<SystemId, Vec<TrackPoint>>;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TrackPoint {
    /// Microseconds since 1970 (UTC).
    pub unix_us: u64,
    pub lat_deg: f64,
    pub lon_deg: f64,
    pub altitude_amsl_m: f64,
}

impl TrackPoint {
    /// The time as `2026-11-20T14:03:22.100Z`.
    pub fn time(&self) -> String {
        time(self.unix_us)
    }
}

/// A time of day as `2026-11-20T14:03:22.100Z`.
pub(super) fn time(unix_us: u64) -> String {
    let time: DateTime<Utc> = i64::try_from(unix_us)
        .ok()
        .and_then(DateTime::from_timestamp_micros)
        .unwrap_or_default();
    time.to_rfc3339_opts(SecondsFormat::Millis, true)
}

/// The tracks of all vehicles, from `GLOBAL_POSITION_INT`.
pub(super) fn tracks(film: &Film) -> Result<Tracks, Text> {
    let mut tracks = Tracks::new();
    for record in records(film)? {
        let mut decoder = Decoder::new();
        decoder.push(&record.bytes);
        let Some(frame) = decoder.next_frame() else {
            continue;
        };
        if let Content::Message(MavMessage::GLOBAL_POSITION_INT(position)) = &frame.content
            && (position.lat, position.lon) != (0, 0)
        {
            tracks.entry(frame.system).or_default().push(TrackPoint {
                unix_us: record.unix_us,
                lat_deg: f64::from(position.lat) / 1e7,
                lon_deg: f64::from(position.lon) / 1e7,
                altitude_amsl_m: f64::from(position.alt) / 1e3,
            });
        }
    }
    Ok(tracks)
}

/// A vehicle's position at a time of the recording, if known.
pub(super) fn place(film: &Film, track: &[TrackPoint], at: Duration) -> Option<TrackPoint> {
    let at_us = u64::try_from(at.as_micros()).unwrap_or(u64::MAX);
    let unix_us = film.began_unix_us().saturating_add(at_us);
    let passed = track.partition_point(|point| point.unix_us <= unix_us);
    let point = *track.get(passed.saturating_sub(1))?;
    Some(TrackPoint { unix_us, ..point })
}
