//! What a command sets at risk, whichever way it was said.

use mavlink::dialects::ardupilotmega::MavCmd;

use super::compose::FORCE_DISARM;
use super::{ArmingCommand, Command, ParameterCommand, RawCommand};
use crate::ledger::Risk;

/// The parameter that arms rather than disarms.
const ARM: f32 = 1.0;
/// Makes ArduPilot arm whatever its checks say; [`FORCE_DISARM`] does too.
const FORCE_ARM: f32 = 2989.0;
/// The parameter that chooses the checks before arming; 0 is none.
const ARMING_CHECK: &str = "ARMING_CHECK";

impl Command {
    /// What it sets at risk.
    pub fn risk(&self) -> Risk {
        match self {
            Self::Arming(ArmingCommand::Kill) => Risk::Unsafe,
            Self::Raw(
                RawCommand::Long {
                    command,
                    params: [first, second, ..],
                }
                | RawCommand::Int {
                    command,
                    params: [first, second, ..],
                    ..
                },
            ) => of_arming(*command, *first, *second),
            Self::Parameter(ParameterCommand::Set { name, value })
                if name == ARMING_CHECK && *value == 0.0 =>
            {
                Risk::SkipsChecks
            }
            Self::Arming(ArmingCommand::Arm | ArmingCommand::Disarm)
            | Self::Flight(_)
            | Self::Motion(_)
            | Self::Device(_)
            | Self::Query(_)
            | Self::Parameter(_) => Risk::None,
        }
    }
}

/// What arming or disarming by number sets at risk.
fn of_arming(command: u16, arm: f32, magic: f32) -> Risk {
    let disarms_by_force = magic == FORCE_DISARM;
    if command != MavCmd::MAV_CMD_COMPONENT_ARM_DISARM as u16 {
        Risk::None
    } else if arm == ARM && (disarms_by_force || magic == FORCE_ARM) {
        Risk::SkipsChecks
    } else if disarms_by_force {
        Risk::Unsafe
    } else {
        Risk::None
    }
}
