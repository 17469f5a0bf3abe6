//! A crew: what its host and its members do.
//!
//! # How the parts fit
//! - At the host: `host` takes members in, carries out their commands, and hands vehicles over.
//! - At a member: `member` shows what the host says; `relay`, beside this module, asks it.

use super::super::event::CrewEvent;
use crate::app::State;
use crate::app::effect::Effects;
use crate::app::state::CrewPart;
use crate::crew::protocol::SentText;
use crate::crew::{CrewDeed, Departure, Proposal, ProposalChoice, Role};
use crate::language::{CrewLine, ProposalLine, VehicleChoice};
use crate::notice::Notice;
use crate::pilot_in_command::Person;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::ranges;

mod host;
mod member;

pub use host::began;

/// Handles an event of a crew.
pub fn happened(state: &mut State, event: CrewEvent) -> Effects {
    state.touch();
    match event {
        CrewEvent::Heard {
            connection,
            user,
            message,
        } => return host::heard(state, connection, &user, message),
        CrewEvent::Left(connection) => {
            return host::left(state, connection, Departure::Lost);
        }
        CrewEvent::Said(message) => return member::said(state, message),
        CrewEvent::Lost => member::lost(state),
        CrewEvent::Refused(text) => return member::refused(state, text),
    }
    Effects::none()
}

/// Ends at the host what has timed out: the membership of silent members, and proposals without an answer. At a member,
/// tells the user what waits for the host.
pub fn tick(state: &mut State) -> Effects {
    match &state.crew {
        CrewPart::None => Effects::none(),
        CrewPart::Member(_) => {
            member::tick(state);
            Effects::none()
        }
        CrewPart::Host(_) => host::tick(state),
    }
}

/// Carries out a line about the crew.
///
/// # Errors
/// Why it is not possible.
pub fn carry_out(state: &mut State, line: CrewLine) -> Result<Effects, Text> {
    let deed = match line {
        CrewLine::List => {
            let text = listed(state)?;
            state.say(Severity::Notice, text);
            return Ok(Effects::none());
        }
        CrewLine::Offer { vehicles, to } => CrewDeed::Offer {
            vehicles: chosen(state, &vehicles)?,
            to,
        },
        CrewLine::Ask { vehicles } => CrewDeed::Ask {
            vehicles: chosen(state, &vehicles)?,
        },
        CrewLine::Accept(line) => CrewDeed::Accept(meant(state, line)?),
        CrewLine::Decline(line) => CrewDeed::Decline(meant(state, line)?),
    };
    match &state.crew {
        CrewPart::None => Err(text!("crew-none")),
        CrewPart::Host(_) => host::act_here(state, &deed),
        CrewPart::Member(_) => member::act(state, deed),
    }
}

/// The proposal that a line answers.
fn meant(state: &State, line: ProposalLine) -> Result<ProposalChoice, Text> {
    let vehicles = line.vehicles.map(|vehicles| chosen(state, &vehicles));
    Ok(ProposalChoice {
        vehicles: vehicles.transpose()?.unwrap_or_default(),
        from: line.from,
    })
}

fn chosen(state: &State, vehicles: &VehicleChoice) -> Result<Vec<VehicleId>, Text> {
    let mut ids = state.chosen(vehicles)?;
    ids.sort_unstable();
    Ok(ids)
}

/// Everybody on the crew, with role and vehicles, and what is proposed.
fn listed(state: &State) -> Result<Text, Text> {
    let pilots = &state.session.pilots;
    let everybody: Vec<(String, Option<Role>)> = match &state.crew {
        CrewPart::None => return Err(text!("crew-none")),
        CrewPart::Host(crew) => {
            let members = crew.members();
            let members = members.map(|it| (it.person.name().to_owned(), Some(it.role)));
            let host = (crew.host().name().to_owned(), None);
            std::iter::once(host).chain(members).collect()
        }
        CrewPart::Member(place) => {
            let roster = place.roster.iter();
            roster.map(|it| (it.name.to_string(), it.role)).collect()
        }
    };
    // On each console, the vehicles of its user have no name.
    let own = match &state.crew {
        CrewPart::Member(place) => place.viewpoint.as_ref().map(|it| it.own.name()),
        CrewPart::Host(crew) => Some(crew.host().name()),
        CrewPart::None => None,
    };
    let flown_by = |name: &str| {
        let all = state.session.all();
        let theirs = all.filter(|&id| pilots.of(id).map(Person::name).or(own) == Some(name));
        ranges(theirs)
    };
    let parts = everybody.iter().map(|(name, role)| {
        let role = role.map_or_else(|| text!("crew-role-host"), Role::text);
        let vehicles = flown_by(name);
        if vehicles.is_empty() {
            text!("crew-list-role", name = name, role = role)
        } else {
            text!(
                "crew-list-vehicles",
                name = name,
                role = role,
                vehicles = vehicles
            )
        }
    });
    Ok(Text::joined("; ", parts.chain(proposed(state)).collect()))
}

/// The proposals that wait for an answer.
fn proposed(state: &State) -> Vec<Text> {
    match &state.crew {
        CrewPart::None => Vec::new(),
        CrewPart::Host(crew) => crew.proposals().iter().map(Proposal::open).collect(),
        CrewPart::Member(place) => {
            let all = place.roster.iter().flat_map(|it| &it.proposals);
            all.map(SentText::text).collect()
        }
    }
}

/// Shows a text on the last line, and keeps it among the notices.
fn tell(state: &mut State, severity: Severity, text: Text) {
    state
        .notices
        .push(Notice::general(state.now, severity, text.clone()));
    state.say(severity, text);
}
