//! Parameters that a mission sets and maintains without an order: weather and faults of a simulator.
//!
//! They bypass the simulated radio and the orders. Each is sent under the vehicle's own name until the vehicle
//! confirms the value, and again after a reboot.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;

use super::RadioFault;
use crate::commands::{Command, ParameterCommand};
use crate::parameters::other_name;
use crate::plan::Document;
use crate::vehicle::{RadioTest, Vehicle};
use crate::wire::{Content, Frame, Outgoing};

/// The initial time-out for an answer.
const FIRST_PATIENCE: Duration = Duration::from_millis(400);
/// The longest time-out; it grows while the vehicle does not answer.
const LONGEST_PATIENCE: Duration = Duration::from_secs(5);
/// The maximum number of settings in progress; a link of 57600 baud can carry them.
const MOST_AT_ONCE: usize = 8;

/// A change to a vehicle, its simulator or its link, made without a notice. It lasts until another of its kind replaces
/// it.
#[derive(Debug, Clone, PartialEq)]
pub enum Want {
    /// Sets a parameter of the simulator.
    Parameter {
        /// Its name in `ArduCopter` 4.6.
        name: &'static str,
        value: f64,
    },
    /// Sets the state of the radio link.
    Radio(RadioFault),
    /// Begins or ends a test of the radio link, as the user asks.
    RadioTest(Option<RadioTest>),
    /// Puts the lists of a document on board; a list that is empty in the document stays as it is.
    Lists(Arc<Document>),
}

#[derive(Debug, Clone)]
struct AskedSetting {
    value: f64,
    holds: bool,
    tries: u32,
    due: Duration,
}

/// All settings of one vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct Settings {
    /// Whether the vehicle was ever heard: before that, sending is pointless.
    is_there: bool,
    wanted: BTreeMap<&'static str, AskedSetting>,
    /// For each parameter, whether the vehicle uses the other firmware's name.
    renamed: BTreeMap<&'static str, bool>,
}

impl Settings {
    /// Sets the value that a parameter must have.
    pub fn want(&mut self, name: &'static str, value: f64) {
        let setting = AskedSetting {
            value,
            holds: false,
            tries: 0,
            due: Duration::ZERO,
        };
        self.wanted.insert(name, setting);
    }

    /// Handles a reboot: all settings are uncertain.
    pub fn forget(&mut self) {
        for setting in self.wanted.values_mut() {
            (setting.holds, setting.tries, setting.due) = (false, 0, Duration::ZERO);
        }
    }

    /// Whether all settings are confirmed.
    pub fn are_settled(&self) -> bool {
        self.wanted.values().all(|setting| setting.holds)
    }

    pub fn receive(&mut self, frame: &Frame) {
        self.is_there = true;
        let Content::Message(MavMessage::PARAM_VALUE(data)) = &frame.content else {
            return;
        };
        let Ok(heard) = data.param_id.to_str() else {
            return;
        };
        for (&name, setting) in &mut self.wanted {
            let other = other_name(name).filter(|(other, _)| *other == heard);
            if name != heard && other.is_none() {
                continue;
            }
            self.renamed.insert(name, name != heard);
            let value = converted(name, setting.value, name != heard);
            let said = f64::from(data.param_value);
            let near = 1e-7 + value.abs() * 1e-5;
            // A value changed by another program is set back.
            setting.holds = (said - value).abs() <= near;
        }
    }

    /// The messages that are due.
    pub fn poll(&mut self, vehicle: &Vehicle, now: Duration) -> Vec<Outgoing> {
        let mut messages = Vec::new();
        if !self.is_there {
            return messages;
        }
        let open = self.wanted.iter_mut().filter(|(_, setting)| !setting.holds);
        for (&name, setting) in open.take(MOST_AT_ONCE) {
            if setting.due > now {
                continue;
            }
            let renamed = match self.renamed.get(name) {
                Some(renamed) => *renamed,
                // A vehicle ignores unknown names: each is tried in turn.
                None => other_name(name).is_some() && setting.tries % 2 == 1,
            };
            let patience = FIRST_PATIENCE * 2u32.saturating_pow(setting.tries / 2).min(64);
            setting.tries += 1;
            setting.due = now + patience.min(LONGEST_PATIENCE);
            let command = Command::Parameter(ParameterCommand::Set {
                name: other_name(name)
                    .filter(|_| renamed)
                    .map_or(name, |(other, _)| other)
                    .to_owned(),
                value: converted(name, setting.value, renamed),
            });
            let request = command.request(vehicle, 0).ok();
            messages.extend(request.into_iter().flat_map(|request| request.messages));
        }
        messages
    }
}

/// The value of a parameter under the vehicle's name.
fn converted(name: &str, value: f64, renamed: bool) -> f64 {
    match other_name(name).filter(|_| renamed) {
        Some((_, sense)) => f64::from(sense.convert(value as f32)),
        None => value,
    }
}
