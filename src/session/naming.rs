//! The vehicle's name of a parameter: versions of the firmware differ, most of all in how faults are made (`SIM_*`).

use std::time::Duration;

use super::{VehicleCommand, fit};
use crate::commands::{Command, ParameterCommand};
use crate::diagnostic::nearest;
use crate::ledger::{EntryId, RowState};
use crate::parameters::{AliasSense, ParameterList, other_name};
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;
use crate::wire::Outgoing;

/// The name that was written, where the vehicle has another one for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Renamed {
    /// As it was written.
    from: String,
    sense: AliasSense,
}

impl Renamed {
    /// What a parameter's value is, with the name that was written.
    pub(super) fn remark(&self, outcome: &Text) -> Text {
        match self.sense {
            AliasSense::Same => text!("outcome-other-name", outcome = outcome, name = &self.from),
            AliasSense::Opposite => {
                text!(
                    "outcome-opposite-name",
                    outcome = outcome,
                    name = &self.from
                )
            }
        }
    }
}

/// Gives the parameter of an order the name that the vehicle has for it. False if that has to be asked first:
/// vehicles say nothing to a name that they lack.
pub(super) fn settle(order: &mut VehicleCommand, list: &ParameterList) -> bool {
    let (name, value) = match &mut order.command {
        Command::Parameter(ParameterCommand::Get { name }) => (name, None),
        Command::Parameter(ParameterCommand::Set { name, value }) => (name, Some(value)),
        Command::Arming(_)
        | Command::Flight(_)
        | Command::Motion(_)
        | Command::Device(_)
        | Command::Query(_)
        | Command::Raw(_) => return true,
    };
    let Some((other, sense)) = other_name(name).filter(|_| list.get(name).is_none()) else {
        return true;
    };
    if list.get(other).is_none() {
        // What is not listed cannot be set, but some of it can be read.
        return value.is_some() && fit::is_known(list);
    }
    if let (Some(value), AliasSense::Opposite) = (value, sense) {
        *value = f64::from(sense.convert(*value as f32));
    }
    let from = std::mem::replace(name, other.to_owned());
    order.renamed = Some(Renamed { from, sense });
    true
}

/// Asks a vehicle by which of two names it knows the parameter of the order that is next.
#[derive(Debug, Clone, Default)]
pub(super) struct Search {
    /// The order that it is for.
    entry: Option<EntryId>,
    tries: u8,
    asked: Duration,
}

/// What comes of a search.
pub(super) enum Searching {
    /// These are to be sent.
    Ask(Vec<Outgoing>),
    Wait,
    /// The order's time was over before it could be asked as often as it should.
    TooLate,
    /// The vehicle has neither.
    Over,
}

impl Search {
    /// Lets time pass while an order waits that is to be sent until `deadline`.
    pub fn poll(
        &mut self,
        order: &VehicleCommand,
        deadline: Duration,
        vehicle: &Vehicle,
        now: Duration,
    ) -> Searching {
        if self.entry != Some(order.entry) {
            *self = Self {
                entry: Some(order.entry),
                ..Self::default()
            };
        }
        let is_answer_due = self.tries > 0 && now < self.asked + order.verb.retry.every;
        if is_answer_due && now < deadline {
            return Searching::Wait;
        }
        if self.tries >= order.verb.retry.tries {
            return Searching::Over;
        }
        if now >= deadline {
            return Searching::TooLate;
        }
        (self.tries, self.asked) = (self.tries + 1, now);
        let read = |name: &str| {
            let name = name.to_owned();
            Command::Parameter(ParameterCommand::Get { name }).request(vehicle, 0)
        };
        let (name, other) = names(&order.command);
        // A name that cannot be asked for is no name of the vehicle's.
        let requests = [read(name), read(other)].into_iter().flatten();
        Searching::Ask(requests.flat_map(|request| request.messages).collect())
    }
}

/// The name in a command, and the other firmware's.
fn names(command: &Command) -> (&str, &str) {
    match command {
        Command::Parameter(ParameterCommand::Get { name } | ParameterCommand::Set { name, .. }) => {
            let other = other_name(name).map_or(name.as_str(), |(other, _)| other);
            (name, other)
        }
        Command::Arming(_)
        | Command::Flight(_)
        | Command::Motion(_)
        | Command::Device(_)
        | Command::Query(_)
        | Command::Raw(_) => ("", ""),
    }
}

/// How an order ends whose parameter the vehicle has under neither name.
pub(super) fn not_found(
    command: &Command,
    list: &ParameterList,
    vehicle: &Vehicle,
) -> (RowState, Text) {
    let (name, other) = names(command);
    let known = list.iter().map(|(name, _)| name);
    let reason = match nearest(name, known) {
        Some(nearest) => text!(
            "refused-neither-parameter-but",
            name = name,
            other = other,
            nearest = nearest
        ),
        None => text!("refused-neither-parameter", name = name, other = other),
    };
    let state = if vehicle.link.lost {
        RowState::TimedOut
    } else {
        RowState::Refused
    };
    (state, reason)
}
