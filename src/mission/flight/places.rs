//! Places that come up during a flight, for the grammar.

use std::collections::BTreeMap;

use super::Flight;
use crate::geo::LatLon;
use crate::mission::Mission;
use crate::mission::contact::Contacts;
use crate::vehicle::VehicleId;

/// Contacts that a script may name before anybody has found them.
const NAMED_CONTACTS: usize = 200;
/// Where a sensor has shown the most.
const PEAK: &str = "peak";

impl Flight {
    /// Places that have come up so far: contacts (`c1`), `peak`, where a sensor has shown the most, `peak1`, where
    /// that of vehicle 1 has, and those that the seed decides: `gate1`, and `next` for the one to go to.
    pub fn places(&self) -> BTreeMap<String, LatLon> {
        let place = |point| self.mission.origin.place(point);
        let contacts = self.contacts.all().iter().enumerate();
        let contacts = contacts.map(|(index, contact)| (Contacts::name(index), place(contact.at)));
        let peaks = self.peaks.iter();
        let peaks = peaks.map(|(id, (_, at))| (peak_of(*id), place(*at)));
        let highest = self.peaks.values().max_by(|a, b| a.0.total_cmp(&b.0));
        let peak = highest.map(|(_, at)| (PEAK.to_owned(), place(*at)));
        let drawn = self.trackers.iter().flat_map(|tracker| tracker.places());
        let drawn = drawn.map(|(name, at)| (name, place(at)));
        contacts.chain(peaks).chain(peak).chain(drawn).collect()
    }

    /// Keeps where the first sensor of each vehicle has shown the most.
    pub(super) fn note_peaks(&mut self) {
        for craft in self.crafts.iter().filter(|craft| craft.airborne) {
            let (Some(at), Some(probe)) = (craft.at, craft.probes.first()) else {
                continue;
            };
            let known = self.peaks.get(&craft.id);
            if known.is_none_or(|(most, _)| probe.shown > *most) {
                self.peaks.insert(craft.id, (probe.shown, at));
            }
        }
    }
}

fn peak_of(vehicle: VehicleId) -> String {
    format!("{PEAK}{vehicle}")
}

impl Mission {
    /// All places that a script for it may name, also those that come up during the flight; where they are is of
    /// no account.
    pub fn places_to_name(&self) -> BTreeMap<String, LatLon> {
        let mut places = self.places();
        let own = (1..=self.vehicles as VehicleId).map(peak_of);
        let later = own.chain([PEAK.to_owned()]);
        for name in later.chain((0..NAMED_CONTACTS).map(Contacts::name)) {
            places.entry(name).or_insert(self.origin.at);
        }
        let drawn = self.objectives.iter();
        for name in drawn.flat_map(|objective| objective.kind.place_names()) {
            places.entry(name).or_insert(self.origin.at);
        }
        places
    }
}
