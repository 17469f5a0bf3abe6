//! Commands about outputs, and about the autopilot as a device.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavCmd;

use super::control::ControlChange;
use super::effect::{Effect, SOON, Watched};
use super::encode::LongFields;
use super::sticks::StickChange;
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;

/// Sets outputs, switches the fence, reboots the autopilot, changes the station in control, or takes the sticks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DeviceCommand {
    /// Set a servo output.
    Servo {
        /// Output number, 1 first.
        output: u8,
        /// Pulse width in microseconds.
        pulse_us: u16,
    },
    Relay {
        /// Relay number, 0 first.
        relay: u8,
        on: bool,
    },
    /// Switch the fence on or off.
    Fence { on: bool },
    /// Reboot the autopilot (refused while armed).
    Reboot,
    /// Change the ground station in control.
    Control(ControlChange),
    /// Hold or release channels of the transmitter.
    Sticks(StickChange),
}

impl DeviceCommand {
    pub(super) fn fields(self, vehicle: &Vehicle) -> Result<LongFields, Text> {
        Ok(match self {
            Self::Servo { output, pulse_us } => LongFields::new(
                MavCmd::MAV_CMD_DO_SET_SERVO,
                &[f32::from(output), f32::from(pulse_us)],
            ),
            Self::Relay { relay, on } => LongFields::new(
                MavCmd::MAV_CMD_DO_SET_RELAY,
                &[f32::from(relay), f32::from(u8::from(on))],
            ),
            Self::Fence { on } => {
                LongFields::new(MavCmd::MAV_CMD_DO_FENCE_ENABLE, &[f32::from(u8::from(on))])
            }
            Self::Reboot if vehicle.armed() => return Err(text!("refused-reboot-armed")),
            Self::Reboot => LongFields::new(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, &[1.0]),
            Self::Control(change) => change.fields(vehicle)?,
            // A session repeats channels; it does not send them as commands.
            Self::Sticks(_) => return Err(text!("refused-sticks-here")),
        })
    }

    pub(super) fn effect(self, before: &Vehicle) -> Effect {
        match self {
            // Outputs that are not in the telemetry stay at 0, so they show no effect.
            Self::Servo { output, pulse_us } if before.servos_us.iter().any(|&us| us != 0) => {
                Effect::new(Watched::Servo { output, pulse_us }, SOON)
            }
            Self::Reboot => {
                let reboots = before.link.reboots;
                Effect::new(Watched::Rebooted { reboots }, Duration::from_secs(30))
            }
            Self::Control(change) => change.effect(before),
            Self::Servo { .. } | Self::Relay { .. } | Self::Fence { .. } | Self::Sticks(_) => {
                Effect::nothing()
            }
        }
    }

    /// Why the command needs a confirmation: with its fence off, nothing stops an armed vehicle at
    /// its limits. `None` if it needs none.
    pub(super) fn hazard(self, vehicle: &Vehicle) -> Option<Text> {
        let switches_off = self == Self::Fence { on: false };
        (switches_off && vehicle.armed()).then(|| text!("hazard-fence-off"))
    }

    pub(super) fn likely_reason(self, vehicle: &Vehicle) -> Option<Text> {
        match self {
            Self::Reboot => vehicle.armed().then(|| text!("reason-armed")),
            Self::Control(change) => change.likely_reason(vehicle),
            Self::Servo { .. } | Self::Relay { .. } | Self::Fence { .. } | Self::Sticks(_) => None,
        }
    }
}
