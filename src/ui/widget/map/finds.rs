//! Contacts and reports on the map. A sign before the name tells how far a contact is trusted, so that it shows
//! without colours too.

use super::fire;
use super::labels::Label;
use crate::app::State;
use crate::geo::{LatLon, Viewport};
use crate::mission::{Progress, ShownContact, Trust};
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
        let kind = mark.kind.map(|kind| look.text(&kind.title()));
        let text = format!("#{}", kind.unwrap_or_default());
        let cell = view.cell(mark.at);
        labels.extend(cell.map(|cell| Label {
            cell,
            text,
            role: Role::Ok,
        }));
    }
    let nearest = nearest(state, progress, view);
    let is_near = |contact: &ShownContact| nearest.contains(&Some(contact.name.as_str()));
    // The later ones are worth more where there is no room for all.
    let mut contacts: Vec<&ShownContact> = progress.contacts.iter().collect();
    contacts.sort_by_key(|contact| (is_near(contact), contact.trust));
    for contact in contacts {
        let has_name = is_near(contact) || is_named(contact);
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
            text: format!("{sign}{name}"),
            role: *role,
        });
    }
    labels
}

/// Whether a contact has its name on the map also where it is none of the nearest: one that more than one sensor has
/// seen. A field of fire has no names.
fn is_named(contact: &ShownContact) -> bool {
    contact.trust > Trust::Seen && !fire::is_fire(contact)
}

/// The contacts that are nearest to the map's cursor and to the vehicle under the cursor: those that one is about to
/// look at.
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

/// Whether any contact or report is trusted so far.
pub fn has(state: &State, trust: Trust) -> bool {
    let progress = state.session().mission();
    progress.is_some_and(|progress| {
        let mut contacts = progress.contacts.iter();
        contacts.any(|contact| contact.trust == trust && !fire::is_fire(contact))
            || (trust == Trust::Reported && !progress.marks.is_empty())
    })
}
