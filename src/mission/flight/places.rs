//! Places that come up during a flight, for the grammar.

use std::collections::BTreeMap;

use super::Flight;
use crate::geo::LatLon;
use crate::mission::Mission;
use crate::mission::contact::Contacts;

/// Contacts that a script may name before anybody has found them.
const NAMED_CONTACTS: usize = 200;
/// Names for what is only known during a flight.
const LATER: [&str; 1] = ["peak"];

impl Flight {
    /// Places that have come up so far: contacts (`c1`), `peak`, where a sensor has shown the most, and
    /// those that the seed decides: `gate1`, and `next` for the one to go to.
    pub fn places(&self) -> BTreeMap<String, LatLon> {
        let place = |point| self.mission.origin.place(point);
        let contacts = self.contacts.all().iter().enumerate();
        let contacts = contacts.map(|(index, contact)| (Contacts::name(index), place(contact.at)));
        let peak = self.peak.map(|(_, at)| ("peak".to_owned(), place(at)));
        let drawn = self.trackers.iter().flat_map(|tracker| tracker.places());
        let drawn = drawn.map(|(name, at)| (name, place(at)));
        contacts.chain(peak).chain(drawn).collect()
    }

    /// Keeps where the first sensor of a vehicle has shown the most.
    pub(super) fn note_peak(&mut self) {
        for craft in self.crafts.iter().filter(|craft| craft.airborne) {
            let (Some(at), Some(probe)) = (craft.at, craft.probes.first()) else {
                continue;
            };
            if self.peak.is_none_or(|(most, _)| probe.shown > most) {
                self.peak = Some((probe.shown, at));
            }
        }
    }
}

impl Mission {
    /// All places that a script for it may name, also those that come up during the flight; where they are is of
    /// no account.
    pub fn places_to_name(&self) -> BTreeMap<String, LatLon> {
        let mut places = self.places();
        let later = LATER.iter().map(ToString::to_string);
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
