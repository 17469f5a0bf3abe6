//! The reasons for refused commands, as text: first what the vehicle said about this command, then what it said
//! before (`Vehicle::prearm`, kept by `messages::status_text`).

use mavlink::dialects::ardupilotmega::MavResult;

use super::{Command, MotionCommand};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleClass};

/// `MAV_RESULT`: the result in a `COMMAND_ACK`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AckResult {
    Accepted,
    /// Not possible now, but perhaps later.
    TemporarilyRejected,
    /// Not possible with the given parameters.
    Denied,
    /// The autopilot does not support the command.
    Unsupported,
    /// The command was possible, but failed.
    Failed,
    /// In progress; another answer follows.
    InProgress,
    Cancelled,
    /// The command is only accepted as a `COMMAND_LONG`.
    LongOnly,
    /// The command is only accepted as a `COMMAND_INT`.
    IntOnly,
    /// Not possible with the given frame.
    UnsupportedFrame,
    /// Another ground station is in control of the vehicle.
    NotInControl,
    /// A number unknown to this program.
    Other(u8),
}

const NAMED: [(MavResult, AckResult); 11] = [
    (MavResult::MAV_RESULT_ACCEPTED, AckResult::Accepted),
    (
        MavResult::MAV_RESULT_TEMPORARILY_REJECTED,
        AckResult::TemporarilyRejected,
    ),
    (MavResult::MAV_RESULT_DENIED, AckResult::Denied),
    (MavResult::MAV_RESULT_UNSUPPORTED, AckResult::Unsupported),
    (MavResult::MAV_RESULT_FAILED, AckResult::Failed),
    (MavResult::MAV_RESULT_IN_PROGRESS, AckResult::InProgress),
    (MavResult::MAV_RESULT_CANCELLED, AckResult::Cancelled),
    (MavResult::MAV_RESULT_COMMAND_LONG_ONLY, AckResult::LongOnly),
    (MavResult::MAV_RESULT_COMMAND_INT_ONLY, AckResult::IntOnly),
    (
        MavResult::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME,
        AckResult::UnsupportedFrame,
    ),
    (
        MavResult::MAV_RESULT_NOT_IN_CONTROL,
        AckResult::NotInControl,
    ),
];

/// The modes of each class that take a speed.
const SPEED_MODES: [&str; 5] = ["GUIDED", "AUTO", "RTL", "SMART_RTL", "GUIDED_NOGPS"];
const PLANE_SPEED_MODES: [&str; 2] = ["GUIDED", "AUTO"];
const ROVER_SPEED_MODES: [&str; 6] = ["GUIDED", "AUTO", "RTL", "SMART_RTL", "CIRCLE", "FOLLOW"];

impl AckResult {
    /// The result with a number.
    pub fn from_wire(number: u8) -> Self {
        let named = NAMED.iter().find(|(wire, _)| *wire as u8 == number);
        named.map_or(Self::Other(number), |(_, result)| *result)
    }

    /// The reason for a refusal, as far as the result alone gives it; empty if the result is no
    /// refusal.
    pub fn reason(self) -> Text {
        match self {
            Self::TemporarilyRejected => text!("reason-not-now"),
            Self::Denied => text!("reason-denied"),
            Self::Unsupported => text!("reason-unsupported"),
            Self::Failed => text!("reason-failed"),
            Self::Cancelled => text!("reason-cancelled"),
            Self::LongOnly => text!("reason-long-only"),
            Self::IntOnly => text!("reason-int-only"),
            Self::UnsupportedFrame => text!("reason-frame"),
            Self::NotInControl => text!("reason-other-station"),
            Self::Accepted | Self::InProgress => Text::default(),
            Self::Other(number) => text!("reason-other", number = number),
        }
    }
}

/// The result of a command with the status texts that came with it: "arm refused: `PreArm`: Need Position Estimate".
/// ArduPilot refuses many commands without a text; then the reason is derived from the vehicle's state.
pub fn explain(
    verb: &'static str,
    result: AckResult,
    texts: &[Text],
    vehicle: &Vehicle,
    command: &Command,
) -> Text {
    let reason = || {
        let mut parts = texts.to_vec();
        if parts.is_empty() {
            let likely = likely_reason(result, vehicle, command);
            parts.push(likely.unwrap_or_else(|| result.reason()));
        }
        if let Command::Arming(command) = command {
            parts.extend(command.way_out(vehicle));
        }
        Text::joined("; ", parts)
    };
    match result {
        AckResult::Accepted => text!("outcome-verb-accepted", verb = verb),
        AckResult::InProgress => text!("outcome-verb-in-progress", verb = verb),
        AckResult::Cancelled => text!("outcome-verb-cancelled", verb = verb, reason = reason()),
        AckResult::TemporarilyRejected
        | AckResult::Denied
        | AckResult::Unsupported
        | AckResult::Failed
        | AckResult::LongOnly
        | AckResult::IntOnly
        | AckResult::UnsupportedFrame
        | AckResult::NotInControl
        | AckResult::Other(_) => text!("outcome-verb-refused", verb = verb, reason = reason()),
    }
}

/// The likely reason for a refusal without a text, from the vehicle's state.
fn likely_reason(result: AckResult, vehicle: &Vehicle, command: &Command) -> Option<Text> {
    let is_unknown = result == AckResult::Unsupported;
    if result == AckResult::NotInControl {
        return vehicle.not_in_control();
    }
    match command {
        Command::Motion(MotionCommand::Orbit { .. }) if is_unknown => {
            Some(text!("reason-no-orbit"))
        }
        _ if is_unknown => None,
        Command::Arming(command) => command.likely_reason(vehicle),
        Command::Flight(command) => command.likely_reason(vehicle),
        Command::PlanFlight(command) => command.likely_reason(),
        Command::Device(command) => command.likely_reason(vehicle),
        Command::Motion(MotionCommand::Speed { .. }) if result == AckResult::Failed => {
            speed_reason(vehicle)
        }
        Command::Motion(_)
        | Command::Query(_)
        | Command::Parameter(_)
        | Command::Log(_)
        | Command::File(_)
        | Command::Plan(_)
        | Command::Signing(_)
        | Command::Raw(_) => None,
    }
}

/// Why a speed was refused: vehicles take one only in modes that fly to places, and report a failure in others. `None` if
/// that is not the reason.
fn speed_reason(vehicle: &Vehicle) -> Option<Text> {
    let mode = vehicle.mode()?;
    let modes: &[&str] = match mode.class {
        VehicleClass::Copter => &SPEED_MODES,
        VehicleClass::Plane => &PLANE_SPEED_MODES,
        VehicleClass::Rover => &ROVER_SPEED_MODES,
        VehicleClass::Sub | VehicleClass::Px4 | VehicleClass::Other => return None,
    };
    if !modes.iter().any(|name| mode.is(name)) {
        return Some(text!("reason-speed-mode", mode = vehicle.name_of(mode)));
    }
    match mode.class {
        VehicleClass::Plane => Some(text!("reason-speed-plane")),
        VehicleClass::Rover if mode.is("GUIDED") => Some(text!("reason-speed-rover")),
        VehicleClass::Copter
        | VehicleClass::Rover
        | VehicleClass::Sub
        | VehicleClass::Px4
        | VehicleClass::Other => None,
    }
}
