//! The receiver's list of the surrounding aircraft, and its reports to ground stations: one
//! aircraft at a time, the whole list at most once a second.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::ADSB_VEHICLE_DATA;
use sortie_geo::LatLon;

use crate::Serial;
use crate::parameters::Parameters;
use crate::place::Place;

/// An aircraft that has not been heard for longer than this is dropped.
const KEPT_FOR: Duration = Duration::from_secs(5);
/// The minimum time between two starts of the list on a serial port.
const LIST_EVERY: Duration = Duration::from_secs(1);

/// The aircraft that the receiver has heard.
#[derive(Debug, Clone, Default)]
pub(super) struct Receiver {
    heard: Vec<HeardAircraft>,
    cursors: [ListCursor; Serial::ALL.len()],
}

#[derive(Debug, Clone)]
struct HeardAircraft {
    report: ADSB_VEHICLE_DATA,
    at: Duration,
}

#[derive(Debug, Clone, Copy, Default)]
struct ListCursor {
    next: usize,
    begun: Option<Duration>,
}

impl Receiver {
    /// Drops aircraft that have not been heard for longer than `KEPT_FOR`.
    pub(super) fn expire(&mut self, now: Duration) {
        self.heard
            .retain(|one| now.saturating_sub(one.at) <= KEPT_FOR);
    }

    /// Processes a report; `own` is the vehicle's position, if known.
    pub(super) fn hear(
        &mut self,
        report: ADSB_VEHICLE_DATA,
        own: Option<Place>,
        parameters: &Parameters,
        now: Duration,
    ) {
        let icao = report.ICAO_address;
        let known = self
            .heard
            .iter()
            .position(|it| it.report.ICAO_address == icao);
        if own.is_some_and(|own| is_ignored(&report, own, parameters)) {
            if let Some(at) = known {
                self.heard.swap_remove(at);
            }
            return;
        }
        let most = (parameters.value("ADSB_LIST_MAX") as usize).clamp(1, 1000);
        let heard = HeardAircraft { report, at: now };
        match known {
            Some(at) => self.heard[at] = heard,
            None if self.heard.len() < most => self.heard.push(heard),
            None => self.replace_farthest(heard, own),
        }
    }

    /// Replaces the farthest aircraft of a full list, if the new one is nearer.
    fn replace_farthest(&mut self, new: HeardAircraft, own: Option<Place>) {
        let Some(own) = own else { return };
        let away_m = |one: &HeardAircraft| distance_m(&one.report, own);
        let all = self.heard.iter().enumerate();
        let farthest = all.max_by(|a, b| away_m(a.1).total_cmp(&away_m(b.1)));
        if let Some((at, one)) = farthest
            && away_m(&new) < away_m(one)
        {
            self.heard[at] = new;
        }
    }

    /// The next aircraft for a serial port; `None` at the end of the list until one second after
    /// the list was begun.
    pub(super) fn next(&mut self, serial: Serial, now: Duration) -> Option<ADSB_VEHICLE_DATA> {
        let cursor = &mut self.cursors[serial.index()];
        if cursor.next >= self.heard.len() {
            let is_early = cursor
                .begun
                .is_some_and(|begun| now.saturating_sub(begun) < LIST_EVERY);
            if self.heard.is_empty() || is_early {
                return None;
            }
            *cursor = ListCursor {
                next: 0,
                begun: Some(now),
            };
        }
        let one = self.heard.get(cursor.next)?;
        cursor.next += 1;
        Some(one.report.clone())
    }
}

/// Whether a report is outside `ADSB_LIST_RADIUS` or `ADSB_LIST_ALT`, where 0 means no limit.
fn is_ignored(report: &ADSB_VEHICLE_DATA, own: Place, parameters: &Parameters) -> bool {
    let special = parameters.value("ADSB_ICAO_SPECL") as u32;
    if special != 0 && special == report.ICAO_address {
        return false;
    }
    let radius_m = parameters.value("ADSB_LIST_RADIUS");
    let height_m = parameters.value("ADSB_LIST_ALT");
    let above_m = f64::from(report.altitude) / 1000.0 - own.altitude_amsl_m;
    (radius_m > 0.0 && distance_m(report, own) > radius_m)
        || (height_m > 0.0 && above_m.abs() > height_m)
}

fn distance_m(report: &ADSB_VEHICLE_DATA, own: Place) -> f64 {
    let at = LatLon::new(f64::from(report.lat) / 1e7, f64::from(report.lon) / 1e7);
    own.at.distance_m(at)
}
