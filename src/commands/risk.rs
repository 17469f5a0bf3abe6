//! What a command sets at risk, whichever way it was said.

use super::Command;
use super::request::{FORCE_DISARM, cmd};
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
            Self::Kill => Risk::Unsafe,
            Self::Long {
                command,
                params: [first, second, ..],
            }
            | Self::Int {
                command,
                params: [first, second, ..],
                ..
            } => of_arming(*command, *first, *second),
            Self::SetParameter { name, value } if name == ARMING_CHECK && *value == 0.0 => {
                Risk::SkipsChecks
            }
            _ => Risk::None,
        }
    }
}

/// What arming or disarming by number sets at risk.
fn of_arming(command: u16, arm: f32, magic: f32) -> Risk {
    let disarms_by_force = magic == FORCE_DISARM;
    if command != cmd::COMPONENT_ARM_DISARM {
        Risk::None
    } else if arm == ARM && (disarms_by_force || magic == FORCE_ARM) {
        Risk::SkipsChecks
    } else if disarms_by_force {
        Risk::Unsafe
    } else {
        Risk::None
    }
}
