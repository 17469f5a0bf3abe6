//! Contacts and reports, as the trainee sees them.

use crate::mission::contact::{Contact, Contacts};
use crate::mission::flight::Flight;
use crate::mission::progress::{ShownContact, ShownMark, Trust};

impl Flight {
    pub(super) fn shown_contacts(&self) -> Vec<ShownContact> {
        let trust = |contact: &Contact| match contact.sensors.len() {
            _ if contact.reported => Trust::Reported,
            0 | 1 => Trust::Seen,
            _ => Trust::Confirmed,
        };
        let contacts = self.contacts.all().iter().enumerate();
        let shown = contacts.map(|(index, contact)| ShownContact {
            name: Contacts::name(index),
            kind: contact.kind,
            at: self.mission.origin.place(contact.at),
            trust: trust(contact),
        });
        shown.collect()
    }

    pub(super) fn shown_marks(&self) -> Vec<ShownMark> {
        let marks = self.marks.all().iter();
        let shown = marks.map(|mark| ShownMark {
            kind: mark.kind,
            at: self.mission.origin.place(mark.at),
        });
        shown.collect()
    }
}
