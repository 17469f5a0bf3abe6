//! The host of a crew.

use std::collections::BTreeMap;

use super::super::order::{self, LineFor, OrderFor, UnfitLine};
use super::super::relay::{not_open, uses_files};
use super::tell;
use crate::app::State;
use crate::app::effect::{CrewEffect, Effect, Effects};
use crate::class::ConnectionId;
use crate::commands::Order;
use crate::crew::protocol::{
    Confirmed, CrewDenial, CrewHello, HostMessage, MemberMessage, RosterLine, SaidLine, VERSION,
};
use crate::crew::{
    Crew, CrewChange, CrewDeed, CrewRecord, CrewScene, DeedOutcome, Departure, Flown, Joining,
    Member, Proposal,
};
use crate::pilot_in_command::Person;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::ranges;
use crate::verb::CrewDuty;

/// Takes in a line of a member, or of somebody who wants to join.
pub(super) fn heard(
    state: &mut State,
    connection: ConnectionId,
    user: &str,
    message: MemberMessage,
) -> Effects {
    let wall = state.wall;
    let Some(crew) = state.crew.host_mut() else {
        return Effects::none();
    };
    crew.hear(connection, wall);
    let member = crew.member(connection).cloned();
    match (message, member) {
        (MemberMessage::Hello(hello), _) => join(state, connection, user, hello),
        (_, None) => deny(connection, CrewDenial::NoHello),
        (MemberMessage::Here, Some(_)) => Effects::none(),
        (MemberMessage::Leave, Some(_)) => left(state, connection, Departure::Left),
        (
            MemberMessage::Say {
                id,
                line,
                confirmed,
                given_ms,
            },
            Some(member),
        ) => {
            let done = match Crew::waited_too_long(given_ms, wall) {
                Some(waited) => Err(text!("crew-late", seconds = waited.as_secs())),
                None => command(state, &member, &line, confirmed),
            };
            answer(connection, id, done)
        }
        (MemberMessage::Act { id, deed }, Some(member)) => {
            let done = act(state, &member.person, &deed);
            answer(connection, id, done)
        }
    }
}

fn deny(connection: ConnectionId, denial: CrewDenial) -> Effects {
    Effects::from(Effect::Crew(CrewEffect::Deny { connection, denial }))
}

fn tell_one(connection: ConnectionId, message: HostMessage) -> Effect {
    Effect::Crew(CrewEffect::Tell {
        connection,
        message,
    })
}

/// The answer to a member, after what follows from its line.
fn answer(connection: ConnectionId, id: u32, done: Result<Effects, Text>) -> Effects {
    let (mut effects, fault) = match done {
        Ok(effects) => (effects, None),
        Err(fault) => (Effects::none(), Some((&fault).into())),
    };
    effects.extend([tell_one(connection, HostMessage::Answer { id, fault })]);
    effects
}

fn join(state: &mut State, connection: ConnectionId, user: &str, hello: CrewHello) -> Effects {
    if hello.protocol != VERSION {
        return deny(connection, CrewDenial::Version { host: VERSION });
    }
    let wall = state.wall;
    let pilots = &mut state.session.pilots;
    let Some(crew) = state.crew.host_mut() else {
        return Effects::none();
    };
    let joining = Joining {
        connection,
        user,
        role: hello.role,
    };
    let change = match crew.join(joining, pilots, wall) {
        Ok(change) => change,
        Err(denial) => return deny(connection, denial),
    };
    let Some(member) = crew.member(connection) else {
        return Effects::none();
    };
    let welcome = HostMessage::Welcome {
        protocol: VERSION,
        crew: crew.name().into(),
        host: crew.host().name().into(),
        name: member.person.name().into(),
        role: member.role,
    };
    let mut effects = Effects::from(Effect::Crew(CrewEffect::Admit {
        connection,
        welcome,
        has: hello.has,
    }));
    effects.extend(changed(state, change));
    effects
}

/// A member is not there any more.
pub(super) fn left(state: &mut State, connection: ConnectionId, why: Departure) -> Effects {
    let wall = state.wall;
    let pilots = &mut state.session.pilots;
    let crew = state.crew.host_mut();
    let change = crew.and_then(|crew| crew.leave(connection, why, pilots, wall));
    change.map_or_else(Effects::none, |change| changed(state, change))
}

/// Tells everybody of a change, and notes it.
fn changed(state: &mut State, change: CrewChange) -> Effects {
    let has_lost_pilot =
        matches!(&change, CrewChange::Left { vehicles, .. } if !vehicles.is_empty());
    let severity = if has_lost_pilot {
        Severity::Warning
    } else {
        Severity::Notice
    };
    if let Some(text) = change.text(None) {
        tell(state, severity, text);
    }
    if state.crew.host().is_none() {
        return Effects::none();
    }
    let record = CrewRecord {
        change,
        flown: Flown::all(&state.session.pilots),
    };
    let mut effects = Effects::from(Effect::Crew(CrewEffect::Note(record)));
    effects.extend(tell_roster(state));
    effects
}

/// Tells everybody who is on the crew, and what is proposed.
fn tell_roster(state: &State) -> Effects {
    let roster = state
        .crew
        .host()
        .map(|crew| HostMessage::Roster(roster(crew)));
    let told = roster.map(|it| Effect::Crew(CrewEffect::TellAll(it)));
    told.into_iter().collect()
}

fn roster(crew: &Crew) -> Vec<RosterLine> {
    let line = |person: &Person, role| {
        let all = crew.proposals().iter();
        let made = all.filter(|it| it.proposer() == person);
        RosterLine {
            name: person.name().into(),
            role,
            proposals: made.map(|it| (&it.open()).into()).collect(),
        }
    };
    let members = crew.members();
    let members = members.map(|member| line(&member.person, Some(member.role)));
    let host = line(crew.host(), None);
    std::iter::once(host).chain(members).collect()
}

/// Why the crew can do nothing about the host's flight; `None` while it is flown.
fn closed(state: &State) -> Option<Text> {
    let session = &state.session;
    if session.activity.is_none() || state.replay.is_some() || session.task.over {
        return Some(text!("crew-not-flying"));
    }
    state.is_exam().then(|| text!("crew-exam"))
}

/// Carries out a member's command.
///
/// # Errors
/// Why it is not possible.
fn command(
    state: &mut State,
    member: &Member,
    line: &SaidLine,
    confirmed: Confirmed,
) -> Result<Effects, Text> {
    if let Some(why) = closed(state) {
        return Err(why);
    }
    let session = &state.session;
    if session.is_reading() {
        return Err(text!("crew-not-begun"));
    }
    let mut flown = session.pilots.flown_by(&member.person);
    if flown.is_empty() {
        // What is said to the mission needs a vehicle only for its row in the ledger.
        flown.extend(session.all().next());
    }
    let said = LineFor {
        by: &member.person,
        line: line.as_str(),
        selection: &flown,
        confirmed,
    };
    let is_open = |order: &Order| member.role.may_say(order.verb) && !uses_files(&order.act);
    match order::give_for(state, said, is_open) {
        Ok(OrderFor { sent, confirmed }) => {
            if let Some(danger) = confirmed {
                let (who, line) = (member.person.name(), line.as_str());
                let text = text!("crew-confirmed", who = who, line = line, danger = danger);
                tell(state, Severity::Warning, text);
            }
            let mut effects = told_pilots(state, member, &sent.effect);
            effects.extend([sent.effect]);
            Ok(effects)
        }
        Err(UnfitLine::NoCommand) => Err(not_open(member.role)),
        Err(UnfitLine::Because(why)) => Err(why),
    }
}

/// Tells the pilots of vehicles which order of a duty a member gives them: to make them safe, or to their payload.
fn told_pilots(state: &mut State, member: &Member, given: &Effect) -> Effects {
    let Effect::Order { order, .. } = given else {
        return Effects::none();
    };
    let (who, verb) = (&member.person, order.verb);
    let concerns_pilots = match verb.duty {
        CrewDuty::Safety => true,
        CrewDuty::Sensors => verb.counts_as.is_for_vehicles(),
        CrewDuty::Flying => false,
    };
    if !concerns_pilots {
        return Effects::none();
    }
    let Some(host) = state.crew.host().map(|crew| crew.host().clone()) else {
        return Effects::none();
    };
    let pilots = &state.session.pilots;
    let mut reached: BTreeMap<Person, Vec<VehicleId>> = BTreeMap::new();
    for &vehicle in &order.targets {
        let pilot = pilots.of(vehicle).unwrap_or(&host);
        if pilot != who && pilots.refusal(vehicle, Some(who), verb.duty).is_none() {
            reached.entry(pilot.clone()).or_default().push(vehicle);
        }
    }
    let tell_pilot = |(pilot, vehicles): (Person, Vec<VehicleId>)| {
        let vehicles = ranges(vehicles);
        let (who, verb) = (who.name(), verb.name);
        let text = text!(
            "crew-made-safe",
            who = who,
            verb = verb,
            vehicles = vehicles
        );
        tell_person(state, &pilot, text)
    };
    reached.into_iter().flat_map(tell_pilot).collect()
}

/// Carries out a deed of the host's own user.
///
/// # Errors
/// Why it is not possible.
pub(super) fn act_here(state: &mut State, deed: &CrewDeed) -> Result<Effects, Text> {
    let host = state.crew.host().map(|crew| crew.host().clone());
    let host = host.ok_or_else(|| text!("crew-none"))?;
    act(state, &host, deed)
}

fn act(state: &mut State, who: &Person, deed: &CrewDeed) -> Result<Effects, Text> {
    if let Some(why) = closed(state) {
        return Err(why);
    }
    let wall = state.wall;
    let vehicles: Vec<_> = state.session.all().collect();
    let pilots = &mut state.session.pilots;
    let Some(crew) = state.crew.host_mut() else {
        return Err(text!("crew-none"));
    };
    let mut scene = CrewScene {
        vehicles: &vehicles,
        pilots,
        now: wall,
    };
    let outcome = crew.act(who, deed, &mut scene);
    let outcome = outcome.map_err(|fault| fault.text())?;
    Ok(match outcome {
        DeedOutcome::Changed(change) => changed(state, change),
        DeedOutcome::Proposed(proposal) => {
            let waits = text!(
                "crew-waits",
                who = proposal.answerer().name(),
                vehicles = ranges(proposal.vehicles.iter().copied())
            );
            let mut effects = tell_roster(state);
            effects.extend(tell_person(state, proposal.answerer(), proposal.text()));
            effects.extend(tell_person(state, proposal.proposer(), waits));
            effects
        }
        DeedOutcome::Declined(proposal) => {
            let text = text!(
                "crew-declined",
                who = proposal.answerer().name(),
                vehicles = ranges(proposal.vehicles.iter().copied())
            );
            let mut effects = tell_person(state, proposal.proposer(), text.clone());
            effects.extend(tell_person(state, proposal.answerer(), text));
            effects.extend(tell_roster(state));
            effects
        }
    })
}

/// Tells somebody on the crew something.
fn tell_person(state: &mut State, person: &Person, text: Text) -> Effects {
    let Some(crew) = state.crew.host() else {
        return Effects::none();
    };
    if crew.host() == person {
        tell(state, Severity::Notice, text);
        return Effects::none();
    }
    let connection = crew.connection(person);
    let message = HostMessage::Notice((&text).into());
    connection.map_or_else(Effects::none, |it| tell_one(it, message).into())
}

/// Sends silent members away, and ends the proposals that nobody has answered.
pub(super) fn tick(state: &mut State) -> Effects {
    let wall = state.wall;
    let pilots = &state.session.pilots;
    let Some(crew) = state.crew.host_mut() else {
        return Effects::none();
    };
    crew.look(wall);
    let silent = crew.silent(wall);
    let ended = crew.settle(pilots, wall);
    let clock = crew.clock_to_tell(wall);
    let clock = clock.map(|ms| Effect::Crew(CrewEffect::TellAll(HostMessage::Clock { ms })));
    let mut effects: Effects = clock.into_iter().collect();
    for connection in silent {
        effects.extend([Effect::Crew(CrewEffect::Drop(connection))]);
        effects.extend(left(state, connection, Departure::Silent));
    }
    for proposal in &ended {
        effects.extend(unanswered(state, proposal));
    }
    if !ended.is_empty() {
        effects.extend(tell_roster(state));
    }
    effects
}

fn unanswered(state: &mut State, proposal: &Proposal) -> Effects {
    let text = text!(
        "crew-unanswered",
        who = proposal.answerer().name(),
        vehicles = ranges(proposal.vehicles.iter().copied())
    );
    let mut effects = tell_person(state, proposal.proposer(), text);
    let text = text!(
        "crew-lapsed",
        who = proposal.proposer().name(),
        vehicles = ranges(proposal.vehicles.iter().copied())
    );
    effects.extend(tell_person(state, proposal.answerer(), text));
    effects
}

/// A session has begun: the mission's posts go to members.
pub fn began(state: &mut State) -> Effects {
    let is_exam = state.is_exam();
    let mission = state.session.task.listing.as_ref();
    let posts = mission.filter(|_| !is_exam).map(|it| it.crew.clone());
    let wall = state.wall;
    let pilots = &mut state.session.pilots;
    let Some(crew) = state.crew.host_mut() else {
        return Effects::none();
    };
    crew.begin(posts.unwrap_or_default(), pilots, wall);
    let roles: Vec<Effect> = crew
        .connections()
        .map(|(connection, member)| tell_one(connection, HostMessage::Role(member.role)))
        .collect();
    let mut effects: Effects = roles.into_iter().collect();
    effects.extend(changed(state, CrewChange::Began));
    effects
}
