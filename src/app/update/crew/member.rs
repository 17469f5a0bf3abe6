//! A member of a crew.

use std::time::Duration;

use super::super::relay;
use super::tell;
use crate::app::State;
use crate::app::effect::{CrewEffect, Effect, Effects};
use crate::app::state::MemberPlace;
use crate::crew::protocol::{CrewDenial, HostMessage, MemberMessage};
use crate::crew::{CrewDeed, CrewViewpoint};
use crate::pilot_in_command::Person;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// The time between two lines of a member that has nothing else to say.
const HERE_EVERY: Duration = Duration::from_secs(2);

/// Takes in what the host has said.
pub(super) fn said(state: &mut State, message: HostMessage) {
    let wall = state.wall;
    if let Some(place) = state.crew.member_mut() {
        place.heard_at = wall;
    }
    match message {
        HostMessage::Welcome {
            crew,
            host,
            name,
            role,
            ..
        } => {
            let text = text!(
                "crew-welcome",
                crew = crew.as_str(),
                host = host.as_str(),
                name = name.as_str(),
                role = role.text()
            );
            if let Some(place) = state.crew.member_mut() {
                let [own, host] = [name, host].map(|it| Person::named(it.to_string()));
                place.viewpoint = Some(CrewViewpoint { own, host });
                place.role = role;
                place.is_connected = true;
            }
            tell(state, Severity::Notice, text);
        }
        HostMessage::Denied(denial) => tell(state, Severity::Warning, denial_text(&denial)),
        HostMessage::Role(role) => {
            if let Some(place) = state.crew.member_mut() {
                place.role = role;
            }
        }
        HostMessage::Roster(roster) => {
            if let Some(place) = state.crew.member_mut() {
                place.roster = roster;
            }
        }
        HostMessage::Notice(text) => tell(state, Severity::Notice, text.text()),
        HostMessage::Answer { id, fault } => answered(state, id, fault.map(|it| it.text())),
        HostMessage::Ended => {
            let host = state.crew.member().and_then(MemberPlace::viewpoint);
            if let Some(host) = host.map(|it| it.host.clone()) {
                let text = text!("crew-flight-ended", host = host.name());
                tell(state, Severity::Notice, text);
            }
        }
        // The shell takes in the record.
        HostMessage::Record(_)
        | HostMessage::Piece { .. }
        | HostMessage::Now { .. }
        | HostMessage::Here => {}
    }
}

fn denial_text(denial: &CrewDenial) -> Text {
    match denial {
        CrewDenial::Version { host } => text!("crew-denied-version", host = *host),
        CrewDenial::Full => text!("crew-full"),
        CrewDenial::FullForUser => text!("crew-full-user"),
        CrewDenial::NoHello => text!("crew-denied-hello"),
    }
}

fn answered(state: &mut State, id: u32, fault: Option<Text>) {
    let place = state.crew.member_mut();
    let line = place.and_then(|place| place.asked.remove(&id));
    if let (Some(line), Some(fault)) = (line, fault) {
        let text = text!("crew-refused", line = line, reason = fault);
        tell(state, Severity::Warning, text);
    }
}

/// The connection to the host has ended.
pub(super) fn lost(state: &mut State) {
    let Some(place) = state.crew.member_mut() else {
        return;
    };
    place.asked.clear();
    if std::mem::replace(&mut place.is_connected, false) {
        tell(state, Severity::Warning, text!("crew-lost"));
    }
}

/// Asks the host for a deed.
///
/// # Errors
/// There is no connection.
pub(super) fn act(state: &mut State, deed: CrewDeed) -> Result<Effects, Text> {
    let place = state.crew.member();
    if place.is_none_or(|place| !place.is_connected) {
        return Err(text!("crew-not-connected"));
    }
    let shown = match &deed {
        CrewDeed::Offer { .. } => "crew offer",
        CrewDeed::Ask { .. } => "crew ask",
        CrewDeed::Accept => "crew accept",
        CrewDeed::Decline => "crew decline",
    };
    Ok(relay::ask(state, shown.to_owned(), |id| {
        MemberMessage::Act { id, deed }
    }))
}

/// Tells the host that this console is still there.
pub(super) fn tick(state: &mut State) -> Effects {
    let wall = state.wall;
    let place = state.crew.member_mut();
    let due = place.filter(|it| it.is_connected && wall >= it.said_at + HERE_EVERY);
    let Some(place) = due else {
        return Effects::none();
    };
    place.said_at = wall;
    Effects::from(Effect::Crew(CrewEffect::Say(MemberMessage::Here)))
}
