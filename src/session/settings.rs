//! Parameters that a mission keeps at a value, without anybody having ordered it: weather and faults of a simulator.
//!
//! They go beside the radio and beside the orders: a simulator is told by other means than its vehicle. Each is said
//! until the vehicle answers with the value, by the name that the vehicle has for it, and again after a reboot.

use std::collections::BTreeMap;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;

use super::RadioFault;
use crate::commands::{Command, ParameterCommand};
use crate::parameters::other_name;
use crate::vehicle::Vehicle;
use crate::wire::{Content, Frame, Outgoing};

/// How long an answer may take.
const FIRST_PATIENCE: Duration = Duration::from_millis(400);
/// A vehicle that does not answer is asked less and less often, up to this.
const LONGEST_PATIENCE: Duration = Duration::from_secs(5);
/// So many are under way at once; a link of 57600 baud has room for them.
const MOST_AT_ONCE: usize = 8;

/// What is done to a simulator or a link without a word about it. It holds until something else of the same kind is
/// wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Want {
    /// A parameter of the simulator has a value.
    Parameter {
        /// As `ArduCopter` 4.6 calls it.
        name: &'static str,
        value: f64,
    },
    /// The radio link is like this.
    Radio(RadioFault),
}

#[derive(Debug, Clone)]
struct Setting {
    value: f64,
    holds: bool,
    tries: u32,
    /// When it is said again.
    due: Duration,
}

/// All of one vehicle's.
#[derive(Debug, Clone, Default)]
pub(super) struct Settings {
    /// Whether anything was ever heard from it: before that, it would not listen.
    is_there: bool,
    wanted: BTreeMap<&'static str, Setting>,
    /// Whether the vehicle has the other firmware's name for one.
    renamed: BTreeMap<&'static str, bool>,
}

impl Settings {
    /// A parameter is to have a value from now on.
    pub fn want(&mut self, name: &'static str, value: f64) {
        let setting = Setting {
            value,
            holds: false,
            tries: 0,
            due: Duration::ZERO,
        };
        self.wanted.insert(name, setting);
    }

    /// The vehicle has rebooted: nothing is certain any more.
    pub fn forget(&mut self) {
        for setting in self.wanted.values_mut() {
            (setting.holds, setting.tries, setting.due) = (false, 0, Duration::ZERO);
        }
    }

    /// Whether all of them hold.
    pub fn are_settled(&self) -> bool {
        self.wanted.values().all(|setting| setting.holds)
    }

    /// Takes in an answer.
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
            // Whoever sets it to something else has it set back.
            setting.holds = (said - value).abs() <= near;
        }
    }

    /// What there is to say now.
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
                // A vehicle says nothing to a name that it lacks: each is tried in turn.
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

/// The value of a parameter under the name that the vehicle has for it.
fn converted(name: &str, value: f64, renamed: bool) -> f64 {
    match other_name(name).filter(|_| renamed) {
        Some((_, sense)) => f64::from(sense.convert(value as f32)),
        None => value,
    }
}
