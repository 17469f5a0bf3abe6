//! The commands of another ground station, read from its frames.

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavMissionType};

use crate::notice::sanitised;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Mode, Vehicle, VehicleClass};
use crate::wire::Content;

/// The id of `SET_MODE`.
const SET_MODE: u16 = 11;
/// The ids of `COMMAND_LONG` and `COMMAND_INT`, for commands that the dialect has no name for.
const COMMAND_LONG: u32 = 76;
const COMMAND_INT: u32 = 75;

/// An action on a vehicle. Questions (requests for messages, parameters, lists) are not actions.
#[derive(Debug, Clone, PartialEq)]
pub enum Deed {
    /// Sets another mode, by its number. For PX4, `number` is the main mode and `sub` its sub-mode
    /// (0 if it has none).
    Mode {
        number: u32,
        sub: u8,
    },
    Arm(bool),
    /// Sends any other command.
    Command(NamedCommand),
    /// Sets the parameter of this name to a value.
    Parameter(String, f32),
    /// Loads a list with this many items; 0 deletes it.
    Plan(MavMissionType, u16),
    /// Steers by a stream of setpoints or stick positions.
    Steering,
}

/// A MAVLink command, by its number and its name without `MAV_CMD_`; the name is the number if the dialect has none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedCommand {
    pub number: u16,
    pub name: String,
}

impl Deed {
    /// The action in the console's words, or by the name of its MAVLink command.
    pub fn words(&self, vehicle: &Vehicle) -> Text {
        match self {
            Self::Mode { number, sub } => {
                let class = vehicle
                    .mode()
                    .map_or(VehicleClass::Other, |mode| mode.class);
                let is_px4 = vehicle.runs_px4();
                let number = match u8::try_from(*number) {
                    Ok(main) if is_px4 => u32::from_le_bytes([0, 0, main, *sub]),
                    _ => *number,
                };
                let name = vehicle.name_of(Mode { class, number });
                Text::verbatim(format!("mode {name}"))
            }
            Self::Arm(true) => Text::verbatim("arm"),
            Self::Arm(false) => Text::verbatim("disarm"),
            Self::Command(command) => Text::verbatim(&command.name),
            Self::Parameter(name, value) => Text::verbatim(format!("param set {name} {value}")),
            Self::Plan(list, 0) => Text::verbatim(format!("{} clear", list_name(*list))),
            Self::Plan(list, count) => {
                text!("foreign-upload", list = list_name(*list), count = *count)
            }
            Self::Steering => text!("foreign-steering"),
        }
    }

    /// Whether a `COMMAND_ACK` with this number answers the action.
    pub fn is_answered_by(&self, number: u16) -> bool {
        match self {
            // ArduPilot acknowledges SET_MODE under that message's number.
            Self::Mode { .. } => [MavCmd::MAV_CMD_DO_SET_MODE as u16, SET_MODE].contains(&number),
            Self::Arm(_) => number == MavCmd::MAV_CMD_COMPONENT_ARM_DISARM as u16,
            Self::Command(command) => command.number == number,
            Self::Parameter(..) | Self::Plan(..) | Self::Steering => false,
        }
    }
}

/// The word for a list in the console's grammar.
fn list_name(list: MavMissionType) -> &'static str {
    match list {
        MavMissionType::MAV_MISSION_TYPE_FENCE => "fence",
        MavMissionType::MAV_MISSION_TYPE_RALLY => "rally",
        MavMissionType::MAV_MISSION_TYPE_MISSION | MavMissionType::MAV_MISSION_TYPE_ALL => "plan",
    }
}

/// The action that a ground station's frame requests, if any.
pub fn deed_of(content: &Content) -> Option<Deed> {
    match content {
        Content::Message(message) => deed_in(message),
        Content::Undecoded { id, payload } if [COMMAND_LONG, COMMAND_INT].contains(id) => {
            let number = u16::from_le_bytes([payload[28], payload[29]]);
            Some(Deed::Command(unnamed(number)))
        }
        Content::Undecoded { .. } | Content::Unknown { .. } => None,
    }
}

#[expect(deprecated, reason = "ground stations still send SET_MODE")]
fn deed_in(message: &MavMessage) -> Option<Deed> {
    match message {
        MavMessage::COMMAND_LONG(data) => {
            command(data.command, [data.param1, data.param2, data.param3])
        }
        MavMessage::COMMAND_INT(data) => {
            command(data.command, [data.param1, data.param2, data.param3])
        }
        MavMessage::SET_MODE(data) => Some(Deed::Mode {
            number: data.custom_mode,
            sub: 0,
        }),
        MavMessage::PARAM_SET(data) => {
            let name = data.param_id.to_str().unwrap_or_default();
            Some(Deed::Parameter(sanitised(name), data.param_value))
        }
        MavMessage::MISSION_COUNT(data) => Some(Deed::Plan(data.mission_type, data.count)),
        MavMessage::MISSION_CLEAR_ALL(data) => Some(Deed::Plan(data.mission_type, 0)),
        MavMessage::SET_POSITION_TARGET_GLOBAL_INT(_)
        | MavMessage::SET_POSITION_TARGET_LOCAL_NED(_)
        | MavMessage::SET_ATTITUDE_TARGET(_)
        | MavMessage::MANUAL_CONTROL(_)
        | MavMessage::RC_CHANNELS_OVERRIDE(_) => Some(Deed::Steering),
        _ => None,
    }
}

fn command(command: MavCmd, [first, second, third]: [f32; 3]) -> Option<Deed> {
    match command {
        MavCmd::MAV_CMD_DO_SET_MODE => Some(Deed::Mode {
            number: second as u32,
            sub: third as u8,
        }),
        MavCmd::MAV_CMD_COMPONENT_ARM_DISARM => Some(Deed::Arm(first > 0.5)),
        _ => named(command).map(Deed::Command),
    }
}

fn unnamed(number: u16) -> NamedCommand {
    let name = number.to_string();
    NamedCommand { number, name }
}

/// A command with its name; `None` for one that only requests messages.
#[expect(deprecated, reason = "ground stations still ask by the older commands")]
pub(super) fn named(command: MavCmd) -> Option<NamedCommand> {
    let is_question = matches!(
        command,
        MavCmd::MAV_CMD_REQUEST_MESSAGE
            | MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL
            | MavCmd::MAV_CMD_GET_MESSAGE_INTERVAL
            | MavCmd::MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES
            | MavCmd::MAV_CMD_REQUEST_PROTOCOL_VERSION
            | MavCmd::MAV_CMD_GET_HOME_POSITION
            | MavCmd::MAV_CMD_REQUEST_CAMERA_INFORMATION
    );
    let name = format!("{command:?}");
    (!is_question).then(|| NamedCommand {
        number: command as u16,
        name: name.trim_start_matches("MAV_CMD_").to_owned(),
    })
}
