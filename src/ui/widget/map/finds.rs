//! Contacts and reports on the map. A sign before the name tells how far a contact is trusted, so that it shows
//! without colours too.

use super::ground::Label;
use crate::app::State;
use crate::commands::Deed;
use crate::geo::Viewport;
use crate::mission::Trust;
use crate::ui::look::Look;
use crate::ui::theme::Role;

/// How much a contact is trusted, by sign, in the order of the legend.
pub const SIGNS: [(Trust, char, Role, &str); 3] = [
    (Trust::Seen, '?', Role::Contact, "map-legend-seen"),
    (Trust::Confirmed, '!', Role::Accent, "map-legend-confirmed"),
    (Trust::Reported, '#', Role::Ok, "map-legend-reported"),
];

/// The words for what has been found and reported. A report that is a contact's has that one's name.
pub fn labels(state: &State, look: &Look, view: &Viewport) -> Vec<Label> {
    let Some(progress) = state.session().mission() else {
        return Vec::new();
    };
    let mut labels = Vec::new();
    for mark in &progress.marks {
        let kind = mark.kind.map(|kind| look.text(&Deed::kind_title(kind)));
        let text = format!("#{}", kind.unwrap_or_default());
        let cell = view.cell(mark.at);
        labels.extend(cell.map(|cell| Label {
            cell,
            text,
            role: Role::Ok,
        }));
    }
    for contact in &progress.contacts {
        let sign = SIGNS.iter().find(|(trust, ..)| *trust == contact.trust);
        let (Some(cell), Some((_, sign, role, _))) = (view.cell(contact.at), sign) else {
            continue;
        };
        labels.retain(|label| label.cell != cell);
        labels.push(Label {
            cell,
            text: format!("{sign}{}", contact.name),
            role: *role,
        });
    }
    labels
}

/// Whether any contact or report is trusted so far.
pub fn has(state: &State, trust: Trust) -> bool {
    let progress = state.session().mission();
    progress.is_some_and(|progress| {
        let mut contacts = progress.contacts.iter();
        contacts.any(|contact| contact.trust == trust)
            || (trust == Trust::Reported && !progress.marks.is_empty())
    })
}
