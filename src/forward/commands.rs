//! The commands of another ground station, read from its frames and from the answers to it.

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage};

use crate::notice::sanitised;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Mode, VehicleClass, VehicleId};
use crate::wire::{Content, GROUND_STATION_SYSTEM, MavAddress};

/// The ids of `COMMAND_LONG` and `COMMAND_INT`, for commands that the dialect has no name for.
const COMMAND_LONG: u32 = 76;
const COMMAND_INT: u32 = 75;

/// A ground station other than this console.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct StationId(pub MavAddress);

impl StationId {
    /// The station's name: `GCS 254`; with its component if it uses the usual system id of ground
    /// stations.
    pub fn name(self) -> String {
        let MavAddress { system, component } = self.0;
        if system == GROUND_STATION_SYSTEM {
            format!("GCS {system}/{component}")
        } else {
            format!("GCS {system}")
        }
    }
}

/// An action on a vehicle. Questions (requests for messages, parameters, lists) are not actions.
#[derive(Debug, Clone, PartialEq)]
pub enum Deed {
    /// Sets another mode, by its number.
    Mode(u32),
    Arm(bool),
    /// Sends another command, by its name or number.
    Command(String),
    /// Sets the parameter of this name to a value.
    Parameter(String, f32),
    /// Loads a plan, a fence or rally points with this many items; 0 deletes them.
    Plan(u16),
    /// Steers by a stream of setpoints or stick positions.
    Steering,
}

impl Deed {
    /// The text of the notice about the action.
    pub fn text(&self, station: StationId, vehicle: VehicleId, class: VehicleClass) -> Text {
        let station = station.name();
        match self {
            Self::Mode(number) => {
                let number = *number;
                let mode = Mode { class, number }.to_string();
                text!(
                    "foreign-mode",
                    station = station,
                    vehicle = vehicle,
                    mode = mode
                )
            }
            Self::Arm(true) => text!("foreign-arm", station = station, vehicle = vehicle),
            Self::Arm(false) => text!("foreign-disarm", station = station, vehicle = vehicle),
            Self::Command(name) => text!(
                "foreign-command",
                station = station,
                vehicle = vehicle,
                command = name
            ),
            Self::Parameter(name, value) => text!(
                "foreign-parameter",
                station = station,
                vehicle = vehicle,
                name = name,
                value = value.to_string()
            ),
            Self::Plan(0) => text!("foreign-no-plan", station = station, vehicle = vehicle),
            Self::Plan(count) => text!(
                "foreign-plan",
                station = station,
                vehicle = vehicle,
                count = *count
            ),
            Self::Steering => text!("foreign-steering", station = station, vehicle = vehicle),
        }
    }
}

/// The action that a ground station's frame requests, if any.
pub fn deed_of(content: &Content) -> Option<Deed> {
    match content {
        Content::Message(message) => deed_in(message),
        Content::Undecoded { id, payload } if [COMMAND_LONG, COMMAND_INT].contains(id) => {
            let number = u16::from_le_bytes([payload[28], payload[29]]);
            Some(Deed::Command(number.to_string()))
        }
        Content::Undecoded { .. } | Content::Unknown { .. } => None,
    }
}

#[expect(deprecated, reason = "ground stations still send SET_MODE")]
fn deed_in(message: &MavMessage) -> Option<Deed> {
    match message {
        MavMessage::COMMAND_LONG(data) => command(data.command, data.param1, data.param2),
        MavMessage::COMMAND_INT(data) => command(data.command, data.param1, data.param2),
        MavMessage::SET_MODE(data) => Some(Deed::Mode(data.custom_mode)),
        MavMessage::PARAM_SET(data) => {
            let name = data.param_id.to_str().unwrap_or_default();
            Some(Deed::Parameter(sanitised(name), data.param_value))
        }
        MavMessage::MISSION_COUNT(data) => Some(Deed::Plan(data.count)),
        MavMessage::MISSION_CLEAR_ALL(_) => Some(Deed::Plan(0)),
        MavMessage::SET_POSITION_TARGET_GLOBAL_INT(_)
        | MavMessage::SET_POSITION_TARGET_LOCAL_NED(_)
        | MavMessage::SET_ATTITUDE_TARGET(_)
        | MavMessage::MANUAL_CONTROL(_)
        | MavMessage::RC_CHANNELS_OVERRIDE(_) => Some(Deed::Steering),
        _ => None,
    }
}

fn command(command: MavCmd, param1: f32, param2: f32) -> Option<Deed> {
    match command {
        MavCmd::MAV_CMD_DO_SET_MODE => Some(Deed::Mode(param2 as u32)),
        MavCmd::MAV_CMD_COMPONENT_ARM_DISARM => Some(Deed::Arm(param1 > 0.5)),
        _ => named(command).map(Deed::Command),
    }
}

/// The name of a command; `None` for one that only requests messages.
#[expect(deprecated, reason = "ground stations still ask by the older commands")]
pub(super) fn named(command: MavCmd) -> Option<String> {
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
    (!is_question).then(|| name.trim_start_matches("MAV_CMD_").to_owned())
}

/// The station that a vehicle answers with a `COMMAND_ACK`, and the command; `None` if the answer is to the console
/// itself (`own`), to no station in particular, or to a question.
pub fn station_of_ack(content: &Content, own: MavAddress) -> Option<(StationId, String)> {
    let Content::Message(MavMessage::COMMAND_ACK(ack)) = content else {
        return None;
    };
    let station = MavAddress {
        system: ack.target_system,
        component: ack.target_component,
    };
    // Autopilots that leave the component out answer the whole system.
    let is_own = station == own || (station.system == own.system && station.component == 0);
    if station.system == 0 || is_own {
        return None;
    }
    Some((StationId(station), named(ack.command)?))
}
