//! Contacts of the detectors, and the trainee's reports.

use super::deeds::Done;
use super::journal::FlightJournal;
use crate::mission::contact::{Contact, Contacts, Seen, Sighting};
use crate::mission::craft::Craft;
use crate::mission::lookout::Lookout;
use crate::mission::progress::{ShownContact, ShownMark, Trust};
use crate::mission::report::{Mark, Marks};
use crate::mission::sensor::Sensor;
use crate::mission::world::World;
use crate::mission::{Origin, Point};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// The search of one flight.
#[derive(Debug, Clone)]
pub(super) struct Search {
    lookout: Lookout,
    contacts: Contacts,
    marks: Marks,
}

impl Search {
    pub fn new(seed: u64) -> Self {
        Self {
            lookout: Lookout::new(seed),
            contacts: Contacts::default(),
            marks: Marks::default(),
        }
    }

    /// Advances all detectors by a step.
    pub fn step(&mut self, crafts: &[Craft], world: &World, journal: &mut FlightJournal) {
        let mut seen = Vec::new();
        for craft in crafts {
            let contacts = self.contacts.all();
            seen.extend(self.lookout.step(craft, world, contacts, journal.now()));
        }
        for sighting in seen {
            let text = match self.contacts.see(&sighting, journal.now()) {
                Seen::New(index) => self.found(index, &sighting),
                Seen::Confirmed(index) => text!(
                    "contact-confirmed",
                    contact = self.contacts()[index].name.as_str(),
                    kind = self.contacts()[index].kind_text(),
                    sensor = sensor_name(&sighting),
                ),
                Seen::Harmless(index) => {
                    text!(
                        "contact-harmless",
                        contact = self.contacts()[index].name.as_str()
                    )
                }
                Seen::Again => continue,
            };
            journal.tell(sighting.by, Severity::Notice, text);
        }
    }

    fn found(&self, index: usize, sighting: &Sighting) -> Text {
        let contact = &self.contacts()[index];
        let [east, north] = contact.at;
        text!(
            "contact-found",
            contact = contact.name.as_str(),
            kind = contact.kind_text(),
            north = format!("{north:.0}"),
            east = format!("{east:.0}"),
            sensor = sensor_name(sighting),
        )
    }

    /// All contacts, by number.
    pub fn contacts(&self) -> &[Contact] {
        self.contacts.all()
    }

    /// All reports that have not been withdrawn.
    pub fn marks(&self) -> &[Mark] {
        self.marks.all()
    }

    pub fn mark(&mut self, mark: Mark) -> Done {
        let at = mark.at;
        if self.marks.add(mark) {
            self.contacts.note_report(at, true);
            Ok(None)
        } else {
            Err(text!("deed-marked-before"))
        }
    }

    /// Withdraws the report nearest to a point.
    pub fn unmark(&mut self, at: Point) -> Done {
        let mark = self.marks.remove(at).ok_or_else(|| text!("deed-no-mark"))?;
        self.contacts.note_report(mark.at, false);
        Ok(None)
    }

    /// Reports all open contacts that `wants` selects.
    pub fn mark_contacts(
        &mut self,
        by: VehicleId,
        journal: &FlightJournal,
        wants: impl Fn(&Contact) -> bool,
    ) -> Done {
        let mut found = Vec::new();
        for contact in self.contacts.unreported() {
            if wants(contact) {
                contact.reported = true;
                found.push((contact.at, contact.kind));
            }
        }
        if found.is_empty() {
            return Err(if self.contacts.all().is_empty() {
                text!("deed-no-contacts-yet")
            } else {
                text!("deed-no-contacts")
            });
        }
        for &(at, kind) in &found {
            self.marks.add(Mark {
                at,
                kind: Some(kind),
                by,
                when: journal.now(),
            });
        }
        Ok(None)
    }

    /// The contacts as the trainee sees them.
    pub fn shown_contacts(&self, origin: &Origin) -> Vec<ShownContact> {
        let trust = |contact: &Contact| match contact.sensors.len() {
            _ if contact.reported => Trust::Reported,
            _ if contact.harmless => Trust::Harmless,
            0 | 1 => Trust::Seen,
            _ => Trust::Confirmed,
        };
        let shown = self.contacts().iter().map(|contact| ShownContact {
            name: contact.name.clone(),
            kind: contact.kind,
            at: origin.place(contact.at),
            trust: trust(contact),
        });
        shown.collect()
    }

    /// The reports as the trainee sees them.
    pub fn shown_marks(&self, origin: &Origin) -> Vec<ShownMark> {
        let shown = self.marks().iter().map(|mark| ShownMark {
            kind: mark.kind,
            at: origin.place(mark.at),
        });
        shown.collect()
    }
}

/// The name of the sensor of a sighting; empty if the sensor is unknown.
fn sensor_name(sighting: &Sighting) -> Text {
    Sensor::by_id(sighting.sensor)
        .map_or_else(Text::default, |sensor| Text::new(sensor.name, Vec::new()))
}
