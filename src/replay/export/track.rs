//! The positions of each vehicle.

use std::collections::BTreeMap;
use std::time::Duration;

use chrono::{DateTime, SecondsFormat, Utc};
use mavlink::dialects::ardupilotmega::MavMessage;

use super::records;
use crate::geo::LatLon;
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

/// The tracks of one vehicle, by the message that contains its position.
#[derive(Debug, Default)]
struct Stated {
    /// From `GLOBAL_POSITION_INT`, which the vehicle sends once its position is known.
    global: Vec<TrackPoint>,
    /// From `LOCAL_POSITION_NED`, relative to the origin of the vehicle's estimator.
    local: Vec<TrackPoint>,
    origin: Option<Origin>,
}

#[derive(Debug, Clone, Copy)]
struct Origin {
    place: LatLon,
    altitude_amsl_m: f64,
}

impl Stated {
    fn hear(&mut self, message: &MavMessage, unix_us: u64) {
        match message {
            MavMessage::GLOBAL_POSITION_INT(position) if (position.lat, position.lon) != (0, 0) => {
                self.global.push(TrackPoint {
                    unix_us,
                    lat_deg: f64::from(position.lat) / 1e7,
                    lon_deg: f64::from(position.lon) / 1e7,
                    altitude_amsl_m: f64::from(position.alt) / 1e3,
                });
            }
            MavMessage::GPS_GLOBAL_ORIGIN(origin) => {
                self.origin = Some(Origin {
                    place: LatLon::from_e7(origin.latitude, origin.longitude),
                    altitude_amsl_m: f64::from(origin.altitude) / 1e3,
                });
            }
            MavMessage::LOCAL_POSITION_NED(local) => {
                let Some(origin) = self.origin else {
                    return;
                };
                let place = origin.place.moved(f64::from(local.x), f64::from(local.y));
                self.local.push(TrackPoint {
                    unix_us,
                    lat_deg: place.lat_deg,
                    lon_deg: place.lon_deg,
                    altitude_amsl_m: origin.altitude_amsl_m - f64::from(local.z),
                });
            }
            _ => {}
        }
    }

    /// The global positions, or the local ones if there are no others.
    fn track(self) -> Vec<TrackPoint> {
        if self.global.is_empty() {
            self.local
        } else {
            self.global
        }
    }
}

/// The tracks of all vehicles that report a position.
pub(super) fn tracks(film: &Film) -> Result<Tracks, Text> {
    let mut vehicles: BTreeMap<SystemId, Stated> = BTreeMap::new();
    for record in records(film)? {
        let mut decoder = Decoder::new();
        decoder.push(&record.bytes);
        let Some(frame) = decoder.next_frame() else {
            continue;
        };
        if let Content::Message(message) = &frame.content {
            let vehicle = vehicles.entry(frame.system).or_default();
            vehicle.hear(message, record.unix_us);
        }
    }
    let tracks = vehicles.into_iter().map(|(id, it)| (id, it.track()));
    Ok(tracks.filter(|(_, track)| !track.is_empty()).collect())
}

/// A vehicle's position at a time in the recording, if known.
pub(super) fn place(film: &Film, track: &[TrackPoint], at: Duration) -> Option<TrackPoint> {
    let unix_us = film.unix_us(at);
    let passed = track.partition_point(|point| point.unix_us <= unix_us);
    let point = *track.get(passed.saturating_sub(1))?;
    Some(TrackPoint { unix_us, ..point })
}

#[cfg(test)]
mod tests {
    use mavlink::dialects::ardupilotmega::{GPS_GLOBAL_ORIGIN_DATA, LOCAL_POSITION_NED_DATA};

    use super::*;

    fn origin() -> MavMessage {
        MavMessage::GPS_GLOBAL_ORIGIN(GPS_GLOBAL_ORIGIN_DATA {
            latitude: 504_500_000,
            longitude: 305_200_000,
            altitude: 120_000,
            ..GPS_GLOBAL_ORIGIN_DATA::default()
        })
    }

    fn local(north_m: f32) -> MavMessage {
        MavMessage::LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA {
            x: north_m,
            z: -20.0,
            ..LOCAL_POSITION_NED_DATA::default()
        })
    }

    #[test]
    fn a_vehicle_with_local_positions_only_has_a_track_from_its_origin() {
        let mut stated = Stated::default();
        // Before the origin is known, a local position cannot be placed.
        for (second, message) in [(1, local(5.0)), (2, origin()), (3, local(100.0))] {
            stated.hear(&message, second * 1_000_000);
        }
        let track = stated.track();
        let [point] = track[..] else {
            panic!("one point: {track:?}");
        };
        assert_eq!((point.unix_us, point.altitude_amsl_m), (3_000_000, 140.0));
        let from = LatLon::from_e7(504_500_000, 305_200_000);
        let north_m = from.distance_m(LatLon::new(point.lat_deg, point.lon_deg));
        assert!((north_m - 100.0).abs() < 0.1, "{north_m} m");
    }
}
