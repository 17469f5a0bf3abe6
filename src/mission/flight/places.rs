//! Places that become known during a flight, for the grammar.

use std::collections::BTreeMap;

use super::Flight;
use crate::commands::PEAK_PLACE;
use crate::geo::LatLon;
use crate::mission::Mission;
use crate::mission::contact::Contacts;
use crate::mission::objective::Tracker;
use crate::vehicle::VehicleId;

/// The number of contacts that a script may name before they are found.
const NAMED_CONTACTS: usize = 200;

impl Flight {
    /// The places known so far: contacts (`c1`, `fire1`), the highest reading of all vehicles
    /// (`peak`) and of each vehicle (such as `peak1`), and those that the seed decides (`gate1`,
    /// and `next` for the next gate or cell).
    pub fn places(&self) -> BTreeMap<String, LatLon> {
        let place = |point| self.mission.site.origin.place(point);
        let contacts = self
            .search
            .contacts()
            .iter()
            .map(|contact| (contact.name.clone(), place(contact.at)));
        let peaks = self.tracks.peaks().iter();
        let own_peaks = peaks.map(|(id, peak)| (peak_of(*id), place(peak.at)));
        let highest = self.tracks.highest();
        let peak = highest.map(|peak| (PEAK_PLACE.to_owned(), place(peak.at)));
        let drawn = self
            .goals
            .trackers()
            .flat_map(Tracker::places)
            .map(|(name, at)| (name, place(at)));
        contacts.chain(own_peaks).chain(peak).chain(drawn).collect()
    }
}

fn peak_of(vehicle: VehicleId) -> String {
    format!("{PEAK_PLACE}{vehicle}")
}

impl Mission {
    /// All places that a script may name, including those that become known during the flight; their positions do not
    /// matter.
    pub fn places_to_name(&self) -> BTreeMap<String, LatLon> {
        let mut places = self.places();
        let own = (1..=self.seats.count as VehicleId).map(peak_of);
        let later = own.chain([PEAK_PLACE.to_owned()]);
        for name in later.chain(Contacts::names(NAMED_CONTACTS)) {
            places.entry(name).or_insert(self.site.origin.at);
        }
        let drawn = self.objectives.iter();
        for name in drawn.flat_map(|objective| objective.kind.place_names()) {
            places.entry(name).or_insert(self.site.origin.at);
        }
        places
    }
}
