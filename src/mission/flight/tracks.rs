//! The vehicles' tracks, and the places of their sensors' highest readings.

use std::collections::BTreeMap;

use crate::mission::Point;
use crate::mission::craft::Craft;
use crate::mission::report::distance_m;
use crate::vehicle::VehicleId;

const TRACK_STEP_M: f64 = 5.0;
const TRACK_POINTS: usize = 2000;

/// The tracks of one flight.
#[derive(Debug, Clone, Default)]
pub(super) struct Tracks {
    /// Each vehicle's track, in the order of the vehicles.
    tracks: Vec<Vec<Point>>,
    /// The highest reading of each vehicle's first sensor, and its place; none until the sensor has measured something.
    peaks: BTreeMap<VehicleId, Peak>,
}

/// A sensor's highest reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Peak {
    pub shown: f64,
    pub at: Point,
}

impl Tracks {
    /// Adds the positions of the vehicles in the air.
    pub fn step(&mut self, crafts: &[Craft]) {
        self.tracks.resize(crafts.len(), Vec::new());
        for (craft, track) in crafts.iter().zip(&mut self.tracks) {
            let Some(at) = craft.at.filter(|_| craft.under_way) else {
                continue;
            };
            if let Some(probe) = craft.probes.first().filter(|probe| probe.has_signal()) {
                let known = self.peaks.get(&craft.id);
                if known.is_none_or(|known| probe.shown > known.shown) {
                    let shown = probe.shown;
                    self.peaks.insert(craft.id, Peak { shown, at });
                }
            }
            let last = track.last();
            let is_far = last.is_none_or(|&last| distance_m(last, at) >= TRACK_STEP_M);
            if !craft.lost && is_far && track.len() < TRACK_POINTS {
                track.push(at);
            }
        }
    }

    /// Each vehicle's track, in the order of the vehicles.
    pub fn all(&self) -> &[Vec<Point>] {
        &self.tracks
    }

    /// The highest reading of each vehicle that has one, with its place.
    pub fn peaks(&self) -> &BTreeMap<VehicleId, Peak> {
        &self.peaks
    }

    /// The highest reading of all vehicles; `None` before the first.
    pub fn highest(&self) -> Option<Peak> {
        let peaks = self.peaks.values();
        peaks.max_by(|a, b| a.shown.total_cmp(&b.shown)).copied()
    }
}
