//! Links and forwards as lines, on demand.

use crate::app::State;
use crate::app::state::{ForwardSummary, LinkSummary};
use crate::text::{Text, text};
use crate::vehicle::Vehicle;

/// The state of the links, each with its faults, and of the forwards.
pub(super) fn now(state: &State) -> Vec<Text> {
    let session = state.session();
    let links = session.links().iter().enumerate().flat_map(|(at, link)| {
        let findings = session.findings().iter().filter(move |it| it.link == at);
        let ailments = findings.flat_map(|finding| [finding.says(), finding.advice()]);
        link_texts(at, link).chain(ailments)
    });
    let forwards = session.forwards().iter().map(forward_text);
    let vehicles = session.vehicles().values();
    let radios = vehicles.filter_map(|vehicle| radio_text(vehicle));
    links.chain(radios).chain(forwards).collect()
}

/// The test of a vehicle's radio, if one is on.
fn radio_text(vehicle: &Vehicle) -> Option<Text> {
    let figures = vehicle.link.radio?.text(vehicle.link.round_trip);
    let label = text!("links-radio", vehicle = vehicle.id);
    Some(Text::joined(": ", vec![label, figures]))
}

/// A link, and the signatures on it if there are any.
fn link_texts(at: usize, link: &LinkSummary) -> impl Iterator<Item = Text> {
    let seals = link.counters.as_ref().and_then(|it| it.seals);
    let signatures = seals.map(|seals| {
        let parts = vec![text!("links-signing"), seals.text()];
        Text::joined(": ", parts)
    });
    std::iter::once(link_text(at, link)).chain(signatures)
}

fn link_text(at: usize, link: &LinkSummary) -> Text {
    let lost = link.counters.as_ref().map(|it| it.all_lost().to_string());
    text!(
        "plain-link",
        number = at + 1,
        name = &link.name,
        state = link.error.as_ref().unwrap_or(&link.state),
        received = format!("{:.0}", link.messages_in_per_s),
        sent = format!("{:.0}", link.messages_out_per_s),
        lost = lost.unwrap_or_else(|| "-".to_owned())
    )
}

fn forward_text(forward: &ForwardSummary) -> Text {
    let state = if forward.up {
        text!("links-up")
    } else {
        forward.error.clone().unwrap_or(text!("links-down"))
    };
    text!(
        "plain-forward",
        name = &forward.name,
        state = state,
        stations = forward.peers,
        received = forward.received_messages,
        bytes_in = forward.received_bytes,
        sent = forward.sent_messages,
        bytes_out = forward.sent_bytes,
        dropped = forward.dropped,
        filtered = forward.filtered,
        held = forward.held_back,
        repeated = forward.repeated,
    )
}
