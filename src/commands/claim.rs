//! A command's claim on a vehicle's state.

use super::modes::{AUTO_LOITER, OFFBOARD, holding_mode, mode_named};
use super::{ArmingCommand, Command, FlightCommand, MotionCommand};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Mode, Vehicle};

/// The state that a vehicle keeps while a command is in effect. If the state ends, something else
/// controls the vehicle: another ground station, a failsafe, a pilot's stick, or the autopilot,
/// which disarms on its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Claim {
    mode: Option<Mode>,
    /// A second mode that agrees with the claim: the one that follows by itself.
    follows: Option<Mode>,
    armed: Option<bool>,
    /// Whether the claim ends when the vehicle disarms: PX4 then changes its mode by itself.
    ends_disarmed: bool,
}

impl Claim {
    /// A claim to be in a mode, even on the ground.
    pub(super) fn mode(before: &Vehicle, name: &str) -> Self {
        Self {
            mode: mode_named(before, name),
            ..Self::default()
        }
    }

    /// A claim to be in a mode that ends on the ground.
    fn landing_mode(before: &Vehicle, name: &str) -> Self {
        Self {
            ends_disarmed: before.runs_px4(),
            ..Self::mode(before, name)
        }
    }

    /// A claim to be armed and in a mode of PX4, or in the one that follows by itself.
    fn px4_flight(before: &Vehicle, mode: &str, follows: Option<&str>) -> Self {
        Self {
            mode: mode_named(before, mode),
            follows: follows.and_then(|name| mode_named(before, name)),
            armed: Some(true),
            ends_disarmed: false,
        }
    }

    /// A claim to follow the setpoints of OFFBOARD.
    pub fn in_offboard(vehicle: &Vehicle) -> Self {
        Self::px4_flight(vehicle, OFFBOARD, None)
    }

    /// A claim to hold after the setpoints of OFFBOARD.
    pub fn after_offboard(vehicle: &Vehicle) -> Self {
        Self::px4_flight(vehicle, AUTO_LOITER, None)
    }

    /// Whether the command makes no claim.
    pub fn is_empty(&self) -> bool {
        self.mode.is_none() && self.armed.is_none()
    }

    /// A description of the claimed state.
    pub fn describe(&self, vehicle: &Vehicle) -> Text {
        match self.mode {
            Some(mode) => text!("effect-mode", mode = vehicle.name_of(mode)),
            None if self.armed == Some(false) => text!("effect-disarmed"),
            None => text!("effect-armed"),
        }
    }

    /// How the vehicle contradicts the claim, in a few words: `by RTL`. `None` while the claim
    /// holds.
    pub fn contradicted(&self, vehicle: &Vehicle) -> Option<Text> {
        let now = vehicle.heartbeat?;
        if self.ends_disarmed && !now.armed {
            return None;
        }
        if let Some(mode) = self.mode
            && mode != now.mode
            && self.follows != Some(now.mode)
        {
            return Some(text!("outcome-overtaken", mode = vehicle.name_of(now.mode)));
        }
        match (self.armed, now.armed) {
            (Some(true), false) => Some(match vehicle.idle_disarm {
                _ if vehicle.crash().is_some() => text!("outcome-crashed"),
                Some(cause) => text!("outcome-disarmed-idle", reason = cause.text()),
                None => text!("outcome-disarmed"),
            }),
            (Some(false), true) => Some(text!("outcome-armed")),
            (Some(true), true) | (Some(false), false) | (None, _) => None,
        }
    }
}

impl Command {
    /// The command's claim, given the vehicle when the command was sent.
    pub fn claim(&self, before: &Vehicle) -> Claim {
        match self {
            Self::Arming(command) => Claim {
                armed: Some(match command {
                    ArmingCommand::Arm => true,
                    ArmingCommand::Disarm | ArmingCommand::Kill => false,
                }),
                ..Claim::default()
            },
            Self::Flight(command) => command.claim(before),
            Self::PlanFlight(command) => command.claim(before),
            Self::Motion(command) => command.claim(before),
            Self::Device(_)
            | Self::Query(_)
            | Self::Parameter(_)
            | Self::Log(_)
            | Self::File(_)
            | Self::Plan(_)
            | Self::Signing(_)
            | Self::Raw(_) => Claim::default(),
        }
    }
}

fn flight_in_this_mode(before: &Vehicle) -> Claim {
    Claim {
        mode: before.mode(),
        armed: Some(true),
        ..Claim::default()
    }
}

impl FlightCommand {
    pub(super) fn claim(&self, before: &Vehicle) -> Claim {
        match self {
            Self::SetMode { name } => Claim::mode(before, name),
            Self::Land => Claim::landing_mode(before, "LAND"),
            Self::ReturnToLaunch => Claim::landing_mode(before, "RTL"),
            Self::Hold => match holding_mode(before) {
                Some(name) => Claim::mode(before, name),
                None => flight_in_this_mode(before),
            },
            Self::Takeoff { .. } if before.runs_px4() => {
                Claim::px4_flight(before, "AUTO.TAKEOFF", Some(AUTO_LOITER))
            }
            Self::Takeoff { .. } => flight_in_this_mode(before),
            Self::Resume => Claim::default(),
        }
    }
}

impl MotionCommand {
    fn claim(self, before: &Vehicle) -> Claim {
        match self {
            // PX4 flies to places in AUTO.LOITER.
            Self::Goto { .. } | Self::Altitude { .. } | Self::Yaw { .. } if before.runs_px4() => {
                Claim::px4_flight(before, AUTO_LOITER, None)
            }
            Self::Velocity { .. } if before.runs_px4() => Claim::in_offboard(before),
            Self::Orbit { .. } if before.runs_px4() => {
                Claim::px4_flight(before, "POSCTL.ORBIT", None)
            }
            Self::Goto { .. }
            | Self::Altitude { .. }
            | Self::Yaw { .. }
            | Self::Velocity { .. } => flight_in_this_mode(before),
            Self::Speed { .. }
            | Self::Orbit { .. }
            | Self::RegionOfInterest { .. }
            | Self::SetHome { .. } => Claim::default(),
        }
    }
}
