//! Contacts: the finds of detectors, as the trainee sees them. Real objects and false alarms look alike.

use std::collections::BTreeSet;
use std::time::Duration;

use super::Point;
use super::report::{SAME_WITHIN_M, distance_m};
use super::world::ObjectId;
use crate::commands::{CONTACT_STEMS, FindKind};
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A find that a detector reports.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Contact {
    /// Its name: `c1`, or `fire1` for a fire.
    pub name: String,
    /// Where the detectors place it: the mean of their looks.
    pub at: Point,
    /// The kind of object that the detectors report.
    pub kind: FindKind,
    /// The sensors that have seen the contact, by id.
    pub sensors: BTreeSet<&'static str>,
    /// The vehicle that saw the contact first.
    pub by: VehicleId,
    /// Mission time of the first look, and of the last.
    pub first: Duration,
    pub last: Duration,
    /// The number of looks that saw the contact.
    pub looks: u32,
    /// Whether it has been reported.
    pub reported: bool,
    /// Whether a closer look has shown that it needs no report.
    pub harmless: bool,
    /// The real object; `None` for a false alarm. Never shown before the debrief.
    pub object: Option<ObjectId>,
}

/// One look of a detector at an object.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sighting {
    pub at: Point,
    pub kind: FindKind,
    pub sensor: &'static str,
    pub by: VehicleId,
    pub object: Option<ObjectId>,
    /// Whether the look was close enough to show that it needs no report.
    pub harmless: bool,
    /// Sightings of the same kind within this distance of a contact belong to it.
    pub merge_within_m: f64,
}

/// The change that a sighting causes, with the index of the contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Seen {
    New(usize),
    /// A second kind of sensor has now seen the contact.
    Confirmed(usize),
    /// The contact turns out to need no report.
    Harmless(usize),
    Again,
}

/// The beginning of a contact's name. Fires are numbered separately: a fire has dozens of contacts,
/// which would hide the ones to report.
fn stem(kind: FindKind) -> &'static str {
    let [usual, fire] = CONTACT_STEMS;
    if kind == FindKind::Fire { fire } else { usual }
}

/// All contacts of a flight, in the order of their first sighting.
#[derive(Debug, Clone, Default)]
pub(crate) struct Contacts(Vec<Contact>);

impl Contacts {
    /// All contacts, in the order of their numbers.
    pub fn all(&self) -> &[Contact] {
        &self.0
    }

    /// The contacts that are neither reported nor known to be harmless.
    pub fn unreported(&mut self) -> impl Iterator<Item = &mut Contact> {
        let open = |contact: &&mut Contact| !contact.reported && !contact.harmless;
        self.0.iter_mut().filter(open)
    }

    /// Notes that the contact at a point was reported, or that its report was withdrawn.
    pub fn note_report(&mut self, at: Point, is_reported: bool) {
        let there = |contact: &&mut Contact| distance_m(contact.at, at) < SAME_WITHIN_M;
        for contact in self.0.iter_mut().filter(there) {
            contact.reported = is_reported;
        }
    }

    /// The names that contacts can have, up to `each` of every kind.
    pub fn names(each: usize) -> impl Iterator<Item = String> {
        let name = |number| CONTACT_STEMS.map(|stem| format!("{stem}{number}"));
        (1..=each).flat_map(name)
    }

    /// The contact that a sighting belongs to: the nearest one of its kind, if it is close enough.
    fn known(&self, sighting: &Sighting) -> Option<usize> {
        let distances = self.0.iter().enumerate().filter_map(|(index, contact)| {
            let distance = distance_m(contact.at, sighting.at);
            let same = contact.kind == sighting.kind && distance <= sighting.merge_within_m;
            same.then_some((index, distance))
        });
        let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.map(|(index, _)| index)
    }

    /// Adds a sighting to the contact that it belongs to, or to a new one.
    pub fn see(&mut self, sighting: &Sighting, now: Duration) -> Seen {
        if let Some(index) = self.known(sighting) {
            return self.0[index].look(sighting, now, index);
        }
        if sighting.harmless {
            return Seen::Again;
        }
        let stem = stem(sighting.kind);
        let known = self.0.iter();
        let number = known.filter(|known| self::stem(known.kind) == stem).count() + 1;
        self.0.push(Contact {
            name: format!("{stem}{number}"),
            at: sighting.at,
            kind: sighting.kind,
            sensors: BTreeSet::from([sighting.sensor]),
            by: sighting.by,
            first: now,
            last: now,
            looks: 1,
            reported: false,
            harmless: false,
            object: sighting.object,
        });
        Seen::New(self.0.len() - 1)
    }
}

impl Contact {
    fn look(&mut self, sighting: &Sighting, now: Duration, index: usize) -> Seen {
        self.last = now;
        self.object = self.object.or(sighting.object);
        if sighting.harmless {
            let news = !self.harmless;
            self.harmless = true;
            return if news {
                Seen::Harmless(index)
            } else {
                Seen::Again
            };
        }
        self.looks += 1;
        let share = 1.0 / f64::from(self.looks);
        for (axis, seen) in self.at.iter_mut().zip(sighting.at) {
            *axis += (seen - *axis) * share;
        }
        let news = self.sensors.insert(sighting.sensor) && !self.harmless;
        if news {
            Seen::Confirmed(index)
        } else {
            Seen::Again
        }
    }

    /// Whether two kinds of sensors have seen the contact.
    pub fn is_confirmed(&self) -> bool {
        self.sensors.len() > 1
    }

    /// The kind that detectors take the contact for, as text.
    pub fn kind_text(&self) -> Text {
        self.kind.title()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sighting(at: Point, sensor: &'static str) -> Sighting {
        Sighting {
            at,
            kind: FindKind::Mine,
            sensor,
            by: 1,
            object: None,
            harmless: false,
            merge_within_m: 1.0,
        }
    }

    #[test]
    fn looks_at_one_thing_are_one_contact_and_others_are_not() {
        let mut contacts = Contacts::default();
        assert_eq!(
            contacts.see(&sighting([0.0, 0.0], "s_mag"), Duration::ZERO),
            Seen::New(0)
        );
        assert_eq!(
            contacts.see(&sighting([0.8, 0.0], "s_gpr"), Duration::ZERO),
            Seen::Confirmed(0)
        );
        assert_eq!(
            contacts.see(&sighting([2.0, 0.0], "s_gpr"), Duration::ZERO),
            Seen::New(1)
        );
        let first = &contacts.all()[0];
        assert!((first.at[0] - 0.4).abs() < 1e-9 && first.at[1].abs() < 1e-9);
        assert_eq!(first.sensors.len(), 2);
    }

    #[test]
    fn a_report_of_its_place_is_a_report_of_the_contact_until_it_is_taken_back() {
        let mut contacts = Contacts::default();
        contacts.see(&sighting([0.0, 0.0], "s_th160"), Duration::ZERO);
        contacts.see(&sighting([50.0, 0.0], "s_th160"), Duration::ZERO);
        contacts.note_report([0.0, 0.0], true);
        assert_eq!(contacts.unreported().count(), 1);
        contacts.note_report([0.0, 0.0], false);
        assert_eq!(contacts.unreported().count(), 2);
    }

    #[test]
    fn fires_are_counted_by_themselves() {
        let mut contacts = Contacts::default();
        for (east, kind) in [
            (0.0, FindKind::Person),
            (50.0, FindKind::Fire),
            (90.0, FindKind::Fire),
            (99.0, FindKind::Person),
        ] {
            let found = Sighting {
                kind,
                ..sighting([east, 0.0], "s_th160")
            };
            contacts.see(&found, Duration::ZERO);
        }
        let names: Vec<&str> = contacts.all().iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, ["c1", "fire1", "fire2", "c2"]);
        let all: Vec<String> = Contacts::names(2).collect();
        assert!(names.iter().all(|name| all.iter().any(|it| it == name)));
    }

    #[test]
    fn what_turns_out_harmless_is_not_offered_for_reporting_any_more() {
        let mut contacts = Contacts::default();
        contacts.see(&sighting([0.0, 0.0], "s_th160"), Duration::ZERO);
        let harmless = Sighting {
            harmless: true,
            ..sighting([0.2, 0.0], "s_th160")
        };
        assert_eq!(contacts.see(&harmless, Duration::ZERO), Seen::Harmless(0));
        assert_eq!(contacts.unreported().count(), 0);
        let elsewhere = Sighting {
            at: [9.0, 0.0],
            ..harmless
        };
        assert_eq!(contacts.see(&elsewhere, Duration::ZERO), Seen::Again);
        assert_eq!(contacts.all().len(), 1);
    }
}
