//! What the detectors find, as the trainee hears of it.

use super::Flight;
use crate::mission::contact::{Contact, Contacts, Seen, Sighting};
use crate::mission::sensor::Sensor;
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

impl Flight {
    /// Lets all detectors look.
    pub(super) fn watch(&mut self, notices: &mut Vec<Notice>) {
        let mut seen = Vec::new();
        for craft in &self.crafts {
            seen.extend(self.lookout.step(craft, &self.world, self.elapsed));
        }
        for sighting in seen {
            let news = self.contacts.see(&sighting, self.elapsed);
            let text = match news {
                Seen::New(index) => self.found(index, &sighting),
                Seen::Confirmed(index) => text!(
                    "contact-confirmed",
                    contact = Contacts::name(index),
                    kind = self.contacts.all()[index].kind_text(),
                    sensor = sensor(&sighting),
                ),
                Seen::Harmless(index) => {
                    text!("contact-harmless", contact = Contacts::name(index))
                }
                Seen::Again => continue,
            };
            notices.push(Notice {
                at: self.elapsed,
                vehicle: Some(sighting.by),
                severity: Severity::Notice,
                kind: None,
                text,
            });
        }
    }

    fn found(&self, index: usize, sighting: &Sighting) -> Text {
        let contact: &Contact = &self.contacts.all()[index];
        let [east, north] = contact.at;
        text!(
            "contact-found",
            contact = Contacts::name(index),
            kind = contact.kind_text(),
            north = format!("{north:.0}"),
            east = format!("{east:.0}"),
            sensor = sensor(sighting),
        )
    }
}

/// The name of the sensor of a sighting.
fn sensor(sighting: &Sighting) -> Text {
    Sensor::by_id(sighting.sensor)
        .map_or_else(Text::default, |sensor| Text::new(sensor.name, Vec::new()))
}
