//! The vehicle's name for a parameter: versions of the firmware differ, mostly for simulated faults (`SIM_*`).

use std::time::Duration;

use super::{VehicleCommand, fit};
use crate::commands::{Command, ParameterCommand};
use crate::diagnostic::nearest;
use crate::ledger::{EntryId, RowEnding, RowState};
use crate::parameters::{AliasSense, ParameterList, other_name};
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;
use crate::wire::Outgoing;

/// The name as typed, if the vehicle has another one.
#[derive(Debug, Clone, PartialEq)]
pub struct Renamed {
    from: String,
    sense: AliasSense,
}

impl Renamed {
    /// The outcome with the name as typed.
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

/// Replaces the parameter's name in an order with the vehicle's name for it. Returns `false` if the
/// vehicle must be asked first: vehicles ignore unknown names.
pub(super) fn settle(order: &mut VehicleCommand, list: &ParameterList) -> bool {
    let (name, value) = match &mut order.command {
        Command::Parameter(ParameterCommand::Get { name }) => (name, None),
        Command::Parameter(ParameterCommand::Set { name, value }) => (name, Some(value)),
        Command::Arming(_)
        | Command::Flight(_)
        | Command::PlanFlight(_)
        | Command::Motion(_)
        | Command::Device(_)
        | Command::Query(_)
        | Command::Log(_)
        | Command::File(_)
        | Command::Plan(_)
        | Command::Signing(_)
        | Command::Raw(_) => return true,
    };
    let Some((other, sense)) = other_name(name).filter(|_| list.get(name).is_none()) else {
        return true;
    };
    if list.get(other).is_none() {
        // Unlisted parameters cannot be set, but some can be read.
        return value.is_some() && fit::is_known(list);
    }
    if let (Some(value), AliasSense::Opposite) = (value, sense) {
        *value = f64::from(sense.convert(*value as f32));
    }
    let from = std::mem::replace(name, other.to_owned());
    order.renamed = Some(Renamed { from, sense });
    true
}

/// Asks a vehicle which of two names it has for the next order's parameter.
#[derive(Debug, Clone, Default)]
pub(super) struct Search {
    entry: Option<EntryId>,
    tries: u8,
    asked: Duration,
}

/// The result of a search.
pub(super) enum Searching {
    Ask(Vec<Outgoing>),
    Wait,
    /// The order's deadline passed before enough requests were sent.
    TooLate,
    /// All requests were sent, and the vehicle has answered under neither name.
    Over,
}

impl Search {
    /// Advances time while an order waits, up to `deadline`.
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
        // With a speed-up, a link's delay is longer in the vehicle's time.
        let delay = vehicle.link.round_trip.unwrap_or_default();
        let wait = order.verb.retry.every.max(2 * delay);
        let is_answer_due = self.tries > 0 && now < self.asked + wait;
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
        // A name that cannot be requested is not one of the vehicle's.
        let requests = [read(name), read(other)].into_iter().flatten();
        Searching::Ask(requests.flat_map(|request| request.messages).collect())
    }
}

/// The name in a command, and the other firmware's name for it.
fn names(command: &Command) -> (&str, &str) {
    match command {
        Command::Parameter(ParameterCommand::Get { name } | ParameterCommand::Set { name, .. }) => {
            let other = other_name(name).map_or(name.as_str(), |(other, _)| other);
            (name, other)
        }
        Command::Arming(_)
        | Command::Flight(_)
        | Command::PlanFlight(_)
        | Command::Motion(_)
        | Command::Device(_)
        | Command::Query(_)
        | Command::Log(_)
        | Command::File(_)
        | Command::Plan(_)
        | Command::Signing(_)
        | Command::Raw(_) => ("", ""),
    }
}

/// The end of an order whose parameter the vehicle does not have.
pub(super) fn not_found(command: &Command, list: &ParameterList, vehicle: &Vehicle) -> RowEnding {
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
    RowEnding::new(state, reason)
}
