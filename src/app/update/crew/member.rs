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

/// How long a line stays unanswered before the screen says that it waits for the host.
const WAITS: Duration = Duration::from_millis(1500);

/// Takes in what the host has said.
pub(super) fn said(state: &mut State, message: HostMessage) -> Effects {
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
                (place.is_ended, place.denied) = (false, None);
            }
            tell(state, Severity::Notice, text);
        }
        HostMessage::Denied(denial) => return denied(state, denial),
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
            if let Some(host) = host(state) {
                let text = text!("crew-flight-ended", host = host.name());
                tell(state, Severity::Notice, text);
            }
        }
        HostMessage::Closing => closing(state),
        HostMessage::Clock { ms } => {
            if let Some(place) = state.crew.member_mut() {
                place.hear_clock(ms, wall);
            }
        }
        // The shell takes in the record.
        HostMessage::Record(_)
        | HostMessage::Piece { .. }
        | HostMessage::Now { .. }
        | HostMessage::Here => {}
    }
    Effects::none()
}

/// The host of the flight that this member sees.
fn host(state: &State) -> Option<Person> {
    let viewpoint = state.crew.member().and_then(MemberPlace::viewpoint);
    viewpoint.map(|it| it.host.clone())
}

/// The host has ended the crew: the end of the connection is no fault.
fn closing(state: &mut State) {
    let Some(host) = host(state) else {
        return;
    };
    if let Some(place) = state.crew.member_mut() {
        place.is_ended = true;
    }
    // Without a screen, the console ends once everything is printed.
    let text = if state.display.has_rooms {
        text!("crew-host-left", host = host.name())
    } else {
        text!("crew-host-left-end", host = host.name())
    };
    tell(state, Severity::Notice, text);
}

/// The host does not let this console in. One that has never been let in has nothing to show, and ends; otherwise it may
/// come back once there is room.
fn denied(state: &mut State, denial: CrewDenial) -> Effects {
    let text = denial_text(&denial);
    if host(state).is_none() {
        return give_up(text);
    }
    let place = state.crew.member_mut();
    let before = place.and_then(|place| place.denied.replace(denial.clone()));
    if before != Some(denial) {
        tell(state, Severity::Warning, text);
    }
    Effects::none()
}

/// There is a crew that this console must not join.
pub(super) fn refused(state: &mut State, why: Text) -> Effects {
    if host(state).is_none() {
        return give_up(why);
    }
    tell(state, Severity::Warning, why);
    Effects::none()
}

fn give_up(why: Text) -> Effects {
    Effects::from(Effect::Crew(CrewEffect::GiveUp(why)))
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
    let asked = place.and_then(|place| place.asked.remove(&id));
    if let (Some(asked), Some(fault)) = (asked, fault) {
        let text = text!("crew-refused", line = asked.line, reason = fault);
        tell(state, Severity::Warning, text);
    }
}

/// Tells the user which lines wait for the host.
pub(super) fn tick(state: &mut State) {
    let wall = state.wall;
    let Some(place) = state.crew.member_mut() else {
        return;
    };
    let all = place.asked.values_mut();
    let waiting = all.filter(|it| !it.is_told && wall.saturating_sub(it.at) >= WAITS);
    let waiting: Vec<String> = waiting
        .map(|it| {
            it.is_told = true;
            it.line.clone()
        })
        .collect();
    if !waiting.is_empty() {
        let text = text!("crew-line-waits", lines = waiting.join(", "));
        tell(state, Severity::Notice, text);
    }
}

/// The connection to the host has ended.
pub(super) fn lost(state: &mut State) {
    let Some(place) = state.crew.member_mut() else {
        return;
    };
    place.asked.clear();
    // The next host may count from another beginning.
    place.ahead_ms = None;
    if std::mem::replace(&mut place.is_connected, false) && !place.is_ended {
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
        CrewDeed::Accept(_) => "crew accept",
        CrewDeed::Decline(_) => "crew decline",
    };
    Ok(relay::ask(state, shown.to_owned(), |id| {
        MemberMessage::Act { id, deed }
    }))
}
