//! Commands that arm and disarm the motors.

use mavlink::dialects::ardupilotmega::MavCmd;

use super::effect::{Effect, SOON, Watched};
use super::encode::LongFields;
use crate::ledger::Risk;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Mode, Vehicle, VehicleClass};

/// The reason for which `ArduPlane` refuses to be armed after a landing by a plan. A mode that does not navigate clears it
/// (`Mode::enter`).
const IN_LANDING_SEQUENCE: &str = "In landing sequence";

/// Arms and disarms the motors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArmingCommand {
    Arm,
    /// Disarm on the ground.
    Disarm,
    /// Stop the motors at once, even in flight (disarm with the magic number 21196).
    Kill,
}

impl ArmingCommand {
    pub(super) fn fields(self, vehicle: &Vehicle) -> Result<LongFields, Text> {
        let params: &[f32] = match self {
            Self::Arm if vehicle.airborne() && !vehicle.armed() => {
                return Err(text!("refused-arm-in-the-air"));
            }
            Self::Arm => &[1.0],
            Self::Disarm => &[0.0],
            Self::Kill => &[0.0, FORCE_DISARM],
        };
        let command = MavCmd::MAV_CMD_COMPONENT_ARM_DISARM;
        Ok(LongFields::new(command, params))
    }

    pub(super) fn effect(self) -> Effect {
        let armed = match self {
            Self::Arm => true,
            Self::Disarm | Self::Kill => false,
        };
        Effect::new(Watched::Armed(armed), SOON)
    }

    pub(super) fn risk(self) -> Risk {
        match self {
            Self::Arm | Self::Disarm => Risk::None,
            Self::Kill => Risk::Unsafe,
        }
    }

    pub(super) fn likely_reason(self, vehicle: &Vehicle) -> Option<Text> {
        match self {
            Self::Arm if !vehicle.prearm.is_empty() && vehicle.runs_px4() => {
                Some(vehicle.prearm.join("; ").into())
            }
            Self::Arm if !vehicle.prearm.is_empty() => {
                Some(format!("PreArm: {}", vehicle.prearm.join("; PreArm: ")).into())
            }
            Self::Arm => {
                let comes_down = |mode: &Mode| mode.is("LAND") || mode.is("RTL");
                let mode = vehicle.mode().filter(comes_down)?;
                let name = vehicle.name_of(mode);
                Some(if vehicle.runs_px4() {
                    text!("reason-px4-arm-mode", mode = name)
                } else {
                    text!("reason-arm-mode", mode = name)
                })
            }
            Self::Disarm if !vehicle.airborne() => None,
            Self::Disarm if vehicle.class() == VehicleClass::Plane => {
                Some(text!("reason-in-the-air-plane"))
            }
            Self::Disarm => Some(text!("reason-in-the-air")),
            Self::Kill => None,
        }
    }

    /// What to do about a refusal whose reason the vehicle gives without that.
    pub(super) fn way_out(self, vehicle: &Vehicle) -> Option<Text> {
        let lands = vehicle.prearm.iter().any(|it| it == IN_LANDING_SEQUENCE);
        (self == Self::Arm && lands).then(|| text!("reason-landing-sequence"))
    }
}

/// The magic number that makes ArduPilot disarm in flight.
const FORCE_DISARM: f32 = 21196.0;
/// The magic number that makes ArduPilot arm regardless of its checks; [`FORCE_DISARM`] has the same effect.
const FORCE_ARM: f32 = 2989.0;
/// The value of parameter 1 that arms rather than disarms.
const ARM: f32 = 1.0;

/// The risk of a command by number, if it arms or disarms.
pub(super) fn risk_of_number(command: u16, arm: f32, magic: f32) -> Risk {
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
