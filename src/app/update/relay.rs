//! What a member of a crew asks its host for.

use crate::app::State;
use crate::app::effect::{CrewEffect, Effect, Effects};
use crate::app::state::AskedLine;
use crate::commands::{Act, Command, Order, PlanCommand, PlanDeed, PlanSource};
use crate::crew::Role;
use crate::crew::protocol::{Confirmed, MemberMessage, SaidLine};
use crate::language::{Meaning, Statement};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// The maximum number of lines that wait for an answer.
const MOST_ASKED: usize = 64;

/// Why a line of this console's user cannot be given: at a member, for the role.
pub fn obstacle(state: &State, statement: &Statement) -> Option<Text> {
    let place = state.crew.member()?;
    let Meaning::Act(act) = &statement.meaning else {
        return None;
    };
    if !place.is_connected {
        return Some(text!("crew-not-connected"));
    }
    if uses_files(act) {
        return Some(text!("crew-own-files"));
    }
    let may_say = place.role.may_say(statement.verb);
    (!may_say).then(|| not_open(place.role))
}

/// Why something that uses the files of this machine is not possible; `None` if it is.
pub fn own_files(state: &State) -> Option<Text> {
    let is_member = state.crew.member().is_some();
    is_member.then(|| text!("crew-own-files"))
}

/// Whether an order reads or writes files, or the keys, of the machine that carries it out.
pub fn uses_files(act: &Act) -> bool {
    match act {
        Act::Command(Command::Plan(PlanCommand { deed, .. })) => match deed {
            PlanDeed::Download { .. } => true,
            PlanDeed::Upload { source } => matches!(source, PlanSource::File(_)),
            PlanDeed::Clear | PlanDeed::Show => false,
        },
        Act::Command(Command::Log(_) | Command::File(_) | Command::Signing(_)) => true,
        Act::Command(_)
        | Act::Deed(_)
        | Act::Manoeuvre(_)
        | Act::Plans(_)
        | Act::Rehearse { .. } => false,
    }
}

/// Why the members with a role cannot give a command.
pub fn not_open(role: Role) -> Text {
    match role {
        Role::Observer => text!("crew-observer"),
        Role::Pilot | Role::Sensors | Role::Safety => text!("crew-not-open", role = role.text()),
    }
}

/// Asks the host to carry out an order.
pub fn say(state: &mut State, order: &Order, confirmed: Confirmed) -> Effects {
    let Ok(line) = SaidLine::try_from(order.line.clone()) else {
        state.say(Severity::Warning, text!("crew-line-long"));
        return Effects::none();
    };
    let shown = order.line.clone();
    let wall = state.wall;
    let given_ms = state.crew.member().and_then(|place| place.host_ms(wall));
    let message = |id| MemberMessage::Say {
        id,
        line,
        confirmed,
        given_ms,
    };
    ask(state, shown, message)
}

/// Asks the host; `shown` is what its answer is shown with.
pub fn ask(
    state: &mut State,
    shown: String,
    message: impl FnOnce(u32) -> MemberMessage,
) -> Effects {
    let wall = state.wall;
    let Some(place) = state.crew.member_mut() else {
        return Effects::none();
    };
    let id = place.next;
    place.next = id.wrapping_add(1);
    if place.asked.len() >= MOST_ASKED {
        place.asked.pop_first();
    }
    let asked = AskedLine {
        line: shown,
        at: wall,
        is_told: false,
    };
    place.asked.insert(id, asked);
    Effects::from(Effect::Crew(CrewEffect::Say(message(id))))
}
