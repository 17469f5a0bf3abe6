//! The modes, commands, messages, switches and parameters of the simulated vehicle, for documents and tests.

use std::collections::BTreeSet;
use std::fmt::{self, Display};

use mavlink::dialects::ardupilotmega::{COMMAND_LONG_DATA, MavMessage};
use mavlink::{MavlinkVersion, Message as _, MessageData as _};

use super::autopilot::{auxiliary, telemetry};
use super::kind::VehicleKind;
use super::parameters::Parameters;
use super::{commands, mode};

/// The contents of the simulator: names of modes, commands, messages, switches and parameters.
/// Displayed as the rows of a Markdown table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Inventory {
    /// Modes that can be entered.
    pub modes: Vec<String>,
    /// Modes that are always refused.
    pub refused_modes: Vec<String>,
    /// Commands that are carried out (`MAV_CMD` without the prefix).
    pub commands: Vec<String>,
    /// Commands to devices that the vehicle lacks, with a fixed answer.
    pub answered_commands: Vec<String>,
    /// Messages that are sent.
    pub messages: Vec<String>,
    /// Messages that can be requested, but are never sent.
    pub silent_messages: Vec<String>,
    /// Functions of the remote control's switches (`RCn_OPTION`) that act.
    pub switches: Vec<String>,
    /// Numbers of functions without an effect.
    pub idle_switches: Vec<String>,
    /// The name prefixes of the listed parameters, up to the first underscore.
    pub parameters: Vec<String>,
    /// Parameters (an `ENABLE` or a `TYPE`) that add others to the list.
    pub sub_trees: Vec<String>,
}

impl Inventory {
    /// What a copter has.
    pub fn read() -> Self {
        Self::of(VehicleKind::Copter)
    }

    /// What a kind of vehicle has.
    pub fn of(kind: VehicleKind) -> Self {
        let modes = |refused: bool| {
            let of_kind = mode::all(kind)
                .iter()
                .filter(|mode| mode.is_always_refused() == refused);
            of_kind.map(|mode| mode.name.to_owned()).collect()
        };
        let parameters = Parameters::new(kind, 1);
        let listed = (0..parameters.count()).filter_map(|index| parameters.at(index));
        let groups: BTreeSet<_> = listed
            .filter_map(|parameter| parameter.name.split('_').next())
            .map(without_digits)
            .collect();
        Self {
            modes: modes(false),
            refused_modes: modes(true),
            commands: commands::carried_out(kind)
                .into_iter()
                .map(command_name)
                .collect(),
            answered_commands: commands::answered().map(command_name).collect(),
            messages: telemetry::sent().map(message_name).collect(),
            silent_messages: telemetry::silent(kind).map(message_name).collect(),
            switches: auxiliary::acting().map(str::to_owned).collect(),
            idle_switches: auxiliary::idle().map(|number| number.to_string()).collect(),
            parameters: groups.into_iter().map(str::to_owned).collect(),
            sub_trees: parameters.switches().map(str::to_owned).collect(),
        }
    }
}

impl Inventory {
    /// The rows of modes and commands alone.
    pub fn conduct(&self) -> String {
        let rows = self.to_string();
        rows.split_inclusive('\n').take(3).collect()
    }
}

/// A name without the number of a sensor or a channel at its end.
fn without_digits(name: &str) -> &str {
    name.trim_end_matches(|c: char| c.is_ascii_digit())
}

/// The name of a `MAV_CMD` without its prefix, or its number if the dialect lacks it.
fn command_name(number: u16) -> String {
    let mut payload = [0; 33];
    payload[28..30].copy_from_slice(&number.to_le_bytes());
    let Ok(data) = COMMAND_LONG_DATA::deser(MavlinkVersion::V2, &payload) else {
        return number.to_string();
    };
    let name = format!("{:?}", data.command);
    name.strip_prefix("MAV_CMD_").unwrap_or(&name).to_owned()
}

fn message_name(id: u32) -> String {
    MavMessage::default_message_from_id(id).map_or_else(
        || id.to_string(),
        |message| message.message_name().to_owned(),
    )
}

impl Display for Inventory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (title, names) in [
            ("modes", &self.modes),
            ("modes that are refused", &self.refused_modes),
            ("commands", &self.commands),
            (
                "commands to devices that are absent, with the answer of a SITL without them",
                &self.answered_commands,
            ),
            ("messages", &self.messages),
            (
                "messages that can be requested, but are never sent",
                &self.silent_messages,
            ),
            ("switches (`RCn_OPTION`)", &self.switches),
            ("switches without an effect", &self.idle_switches),
            ("parameters that begin with", &self.parameters),
            (
                "parameters that list others while they are not 0",
                &self.sub_trees,
            ),
        ] {
            let names: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
            writeln!(f, "| {title} | {} |", names.join(", "))?;
        }
        Ok(())
    }
}
