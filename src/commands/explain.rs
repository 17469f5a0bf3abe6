//! Why a command was refused, in plain words.

use super::Command;
use crate::vehicle::Vehicle;

/// `MAV_RESULT`: what a `COMMAND_ACK` says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AckResult {
    /// Done, or begun.
    Accepted,
    /// Not now; it may work later.
    TemporarilyRejected,
    /// Never with these parameters.
    Denied,
    /// The autopilot does not know the command.
    Unsupported,
    /// It should have worked but did not.
    Failed,
    /// At work; another answer follows.
    InProgress,
    /// Broken off.
    Cancelled,
    /// Only as `COMMAND_LONG`.
    LongOnly,
    /// Only as `COMMAND_INT`.
    IntOnly,
    /// Not with this frame.
    UnsupportedFrame,
    /// A number newer than this program.
    Other(u8),
}

impl AckResult {
    /// From the wire number.
    pub fn from_wire(number: u8) -> Self {
        match number {
            0 => Self::Accepted,
            1 => Self::TemporarilyRejected,
            2 => Self::Denied,
            3 => Self::Unsupported,
            4 => Self::Failed,
            5 => Self::InProgress,
            6 => Self::Cancelled,
            7 => Self::LongOnly,
            8 => Self::IntOnly,
            9 => Self::UnsupportedFrame,
            other => Self::Other(other),
        }
    }
}

/// "arm refused: `PreArm`: Need Position Estimate": the result of a command with the status texts that came with
/// it. ArduPilot says nothing at all with many refusals; then the reason is read off the vehicle's state.
pub fn explain(
    verb: &str,
    result: AckResult,
    texts: &[String],
    vehicle: &Vehicle,
    command: &Command,
) -> String {
    let outcome = match result {
        AckResult::Accepted => return format!("{verb} accepted"),
        AckResult::InProgress => return format!("{verb} in progress"),
        AckResult::Cancelled => "cancelled",
        _ => "refused",
    };
    let reason = if !texts.is_empty() {
        texts.join("; ")
    } else if let Some(reason) = likely_reason(result, vehicle, command) {
        reason
    } else {
        general_reason(result)
    };
    format!("{verb} {outcome}: {reason}")
}

/// What the vehicle's state says about a refusal without words.
fn likely_reason(result: AckResult, vehicle: &Vehicle, command: &Command) -> Option<String> {
    let mode = vehicle.mode();
    match command {
        Command::Orbit { .. } if result == AckResult::Unsupported => {
            Some("this autopilot cannot orbit; mode CIRCLE can".to_owned())
        }
        _ if result == AckResult::Unsupported => None,
        Command::Takeoff { .. } if !vehicle.armed() => Some("it is not armed".to_owned()),
        Command::Takeoff { .. } if vehicle.airborne() => Some("it is flying already".to_owned()),
        Command::Takeoff { .. } => mode
            .filter(|mode| !mode.is("GUIDED"))
            .map(|mode| format!("it is in {mode}, takeoff needs GUIDED")),
        Command::Disarm if vehicle.airborne() => {
            Some("it is in the air; land it, or say kill to stop the motors".to_owned())
        }
        Command::Arm if !vehicle.prearm.is_empty() => {
            Some(format!("PreArm: {}", vehicle.prearm.join("; PreArm: ")))
        }
        Command::Arm => mode
            .filter(|mode| mode.is("LAND") || mode.is("RTL"))
            .map(|mode| format!("{mode} is not armable; change to GUIDED first")),
        Command::Reboot if vehicle.armed() => Some("it is armed".to_owned()),
        Command::SetMode { name } => Some(format!("it cannot enter {name} now")),
        _ => None,
    }
}

fn general_reason(result: AckResult) -> String {
    match result {
        AckResult::TemporarilyRejected => "not possible just now, try again".to_owned(),
        AckResult::Denied => "the vehicle does not take these values".to_owned(),
        AckResult::Unsupported => "this autopilot does not know the command".to_owned(),
        AckResult::Failed => "the vehicle gave no reason".to_owned(),
        AckResult::Cancelled => "another command took its place".to_owned(),
        AckResult::LongOnly => "the vehicle wants it as COMMAND_LONG".to_owned(),
        AckResult::IntOnly => "the vehicle wants it as COMMAND_INT".to_owned(),
        AckResult::UnsupportedFrame => "the vehicle does not know the coordinate frame".to_owned(),
        AckResult::Accepted | AckResult::InProgress => String::new(),
        AckResult::Other(number) => format!("result {number}"),
    }
}
