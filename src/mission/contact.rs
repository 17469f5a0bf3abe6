//! Contacts: what detectors have found, as the trainee sees it. Truth and false alarms look alike.

use std::collections::BTreeSet;
use std::time::Duration;

use super::Point;
use super::report::distance_m;
use super::world::ObjectId;
use crate::vehicle::VehicleId;

/// Something that a detector believes to have found.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Contact {
    /// Where the detectors place it: the mean of their looks.
    pub at: Point,
    /// What it is taken for, in a word of [`Deed::KINDS`](crate::commands::Deed::KINDS).
    pub kind: &'static str,
    /// The sensors that have seen it, by id.
    pub sensors: BTreeSet<&'static str>,
    /// Who saw it first.
    pub by: VehicleId,
    /// Mission time of the first and of the last look.
    pub first: Duration,
    pub last: Duration,
    /// How many looks saw it.
    pub looks: u32,
    /// Whether it has been reported.
    pub reported: bool,
    /// What it really is; `None` for a false alarm. Never shown before the debrief.
    pub object: Option<ObjectId>,
}

/// One look at one thing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sighting {
    pub at: Point,
    pub kind: &'static str,
    pub sensor: &'static str,
    pub by: VehicleId,
    pub object: Option<ObjectId>,
    /// Sightings of one kind within this of a contact belong to it.
    pub merge_within_m: f64,
}

/// All contacts of a flight; `c1` is the first.
#[derive(Debug, Clone, Default)]
pub(crate) struct Contacts(Vec<Contact>);

impl Contacts {
    /// All of them, in the order of their numbers.
    pub fn all(&self) -> &[Contact] {
        &self.0
    }

    /// Those that nobody has reported, for reporting them.
    pub fn unreported(&mut self) -> impl Iterator<Item = &mut Contact> {
        self.0.iter_mut().filter(|contact| !contact.reported)
    }

    /// What a contact is called.
    pub fn name(index: usize) -> String {
        format!("c{}", index + 1)
    }

    /// Takes in a sighting; returns the index of a contact that is new by it.
    pub fn see(&mut self, sighting: &Sighting, now: Duration) -> Option<usize> {
        let near = |contact: &&mut Contact| {
            contact.kind == sighting.kind
                && distance_m(contact.at, sighting.at) <= sighting.merge_within_m
        };
        if let Some(contact) = self.0.iter_mut().find(near) {
            contact.looks += 1;
            let share = 1.0 / f64::from(contact.looks);
            for (axis, seen) in contact.at.iter_mut().zip(sighting.at) {
                *axis += (seen - *axis) * share;
            }
            contact.sensors.insert(sighting.sensor);
            contact.last = now;
            contact.object = contact.object.or(sighting.object);
            return None;
        }
        self.0.push(Contact {
            at: sighting.at,
            kind: sighting.kind,
            sensors: BTreeSet::from([sighting.sensor]),
            by: sighting.by,
            first: now,
            last: now,
            looks: 1,
            reported: false,
            object: sighting.object,
        });
        Some(self.0.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sighting(at: Point, sensor: &'static str) -> Sighting {
        Sighting {
            at,
            kind: "mine",
            sensor,
            by: 1,
            object: None,
            merge_within_m: 1.0,
        }
    }

    #[test]
    fn looks_at_one_thing_are_one_contact_and_others_are_not() {
        let mut contacts = Contacts::default();
        assert_eq!(
            contacts.see(&sighting([0.0, 0.0], "s_mag"), Duration::ZERO),
            Some(0)
        );
        assert_eq!(
            contacts.see(&sighting([0.8, 0.0], "s_gpr"), Duration::ZERO),
            None
        );
        assert_eq!(
            contacts.see(&sighting([2.0, 0.0], "s_gpr"), Duration::ZERO),
            Some(1)
        );
        let first = &contacts.all()[0];
        assert_eq!(first.at, [0.4, 0.0]);
        assert_eq!(first.sensors.len(), 2);
    }
}
