//! Contacts and reports on the map. A sign before the name shows how well a contact is confirmed,
//! so colours are not needed.

use std::collections::BTreeSet;

use unicode_width::UnicodeWidthStr as _;

use super::fire;
use super::labels::{Label, LabelKind, MapCell};
use crate::app::State;
use crate::geo::{LatLon, Viewport};
use crate::mission::{Progress, ShownContact, Trust};
use crate::ui::look::Look;
use crate::ui::theme::Role;

/// The sign of each level of confirmation of a contact, in the order of the legend.
pub const SIGNS: [(Trust, char, Role, &str); 4] = [
    (Trust::Harmless, '-', Role::Muted, "map-legend-harmless"),
    (Trust::Seen, '?', Role::Contact, "map-legend-seen"),
    (Trust::Confirmed, '!', Role::Accent, "map-legend-confirmed"),
    (Trust::Reported, '#', Role::Ok, "map-legend-reported"),
];

/// With more contacts than this in view, not all of them may have names.
const MOST_NAMED: usize = 12;

/// The labels of contacts and reports. A report of a contact has the contact's name.
pub fn labels(state: &State, look: &Look, view: &Viewport) -> Vec<Label> {
    let Some(progress) = state.session().mission() else {
        return Vec::new();
    };
    let mut labels = Vec::new();
    for mark in &progress.marks {
        let kind = mark.kind.map(|kind| look.text(&kind.title()));
        let text = format!("#{}", kind.unwrap_or_default());
        let cell = view.cell(mark.at);
        labels.extend(cell.map(|cell| Label {
            cell,
            kind: LabelKind::Signed,
            text,
            role: Role::Ok,
        }));
    }
    let nearest = nearest(state, progress, view);
    let is_near = |contact: &ShownContact| nearest.contains(&Some(contact.name.as_str()));
    // Later ones take precedence if there is no room for all.
    let mut contacts: Vec<&ShownContact> = progress.contacts.iter().collect();
    contacts.sort_by_key(|contact| (is_near(contact), contact.trust));
    let roomy = Roomy::new(&contacts, view);
    for contact in contacts {
        let has_name = is_near(contact) || is_named(contact) || roomy.lets_name(contact, view);
        let sign = SIGNS.iter().find(|(trust, ..)| *trust == contact.trust);
        let (Some(cell), Some((_, sign, role, _))) = (view.cell(contact.at), sign) else {
            continue;
        };
        if fire::is_fire(contact) && !has_name {
            continue;
        }
        labels.retain(|label| label.cell != cell);
        let name = if has_name { contact.name.as_str() } else { "" };
        labels.push(Label {
            cell,
            kind: LabelKind::Signed,
            text: format!("{sign}{name}"),
            role: *role,
        });
    }
    labels
}

/// The cells of the contacts in view, to find those with room for a name.
struct Roomy {
    taken: BTreeSet<MapCell>,
}

impl Roomy {
    fn new(contacts: &[&ShownContact], view: &Viewport) -> Self {
        let seen = contacts.iter().filter_map(|contact| view.cell(contact.at));
        Self {
            taken: seen.collect(),
        }
    }

    /// Whether the name of a contact would cover no other contact. Among more than `MOST_NAMED`
    /// contacts, names would hide the ground. Fires have no names.
    fn lets_name(&self, contact: &ShownContact, view: &Viewport) -> bool {
        let Some((column, row)) = view.cell(contact.at) else {
            return false;
        };
        let end = column + 1 + contact.name.width() as u16;
        let is_free = (column + 1..=end).all(|column| !self.taken.contains(&(column, row)));
        is_free && self.taken.len() <= MOST_NAMED && !fire::is_fire(contact)
    }
}

/// Whether a contact keeps its name on the map even if it is not among the nearest: a contact seen by several sensors
/// does. Fires have no names.
fn is_named(contact: &ShownContact) -> bool {
    contact.trust > Trust::Seen && !fire::is_fire(contact)
}

/// The contacts nearest to the map's cursor and to the vehicle under the cursor.
fn nearest<'a>(state: &State, progress: &'a Progress, view: &Viewport) -> [Option<&'a str>; 2] {
    let to = |place: LatLon| {
        let away = |contact: &&ShownContact| contact.at.distance_m(place);
        let contacts = progress.contacts.iter();
        let nearest = contacts.min_by(|a, b| away(a).total_cmp(&away(b)));
        nearest.map(|contact| contact.name.as_str())
    };
    let pointed = state
        .rooms()
        .map()
        .cursor()
        .filter(|it| view.cell(*it).is_some());
    let vehicle = state.session().under_cursor().and_then(|it| it.global);
    [
        pointed.and_then(to),
        vehicle.and_then(|global| to(global.at_point)),
    ]
}

/// Whether any contact or report has this level of confirmation.
pub fn has(state: &State, trust: Trust) -> bool {
    let progress = state.session().mission();
    progress.is_some_and(|progress| {
        let mut contacts = progress.contacts.iter();
        contacts.any(|contact| contact.trust == trust && !fire::is_fire(contact))
            || (trust == Trust::Reported && !progress.marks.is_empty())
    })
}
