//! Commands that begin, end and interrupt a flight.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavCmd;

use super::effect::{Effect, Watched, landing_effect, mode_effect, takeoff_effect};
use super::encode::LongFields;
use super::modes::{holding_mode, mode_number};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Mode, Vehicle, VehicleClass};

/// Begins, ends and interrupts a flight.
#[derive(Debug, Clone, PartialEq)]
pub enum FlightCommand {
    /// Change the flight mode by name; its number depends on the vehicle.
    SetMode {
        /// The mode's name, such as `GUIDED`.
        name: String,
    },
    /// Take off straight up, with ArduPilot in GUIDED.
    Takeoff {
        /// Height above home to climb to.
        altitude_m: f64,
    },
    /// Land at the current position. Done once the vehicle is on the ground in LAND; if its modes
    /// have no names, once it has accepted the command.
    Land,
    /// Return to the launch position; a multirotor also lands there. Done once a multirotor is on the ground in RTL, a
    /// rover or boat with `ArduPilot` stands there, or a plane circles there; for any other vehicle, once it is in RTL, or
    /// has accepted the command.
    ReturnToLaunch,
    /// Stop and stay. A copter pauses in GUIDED and AUTO and enters BRAKE from other modes; a plane or boat
    /// enters LOITER, a rover HOLD, a sub POSHOLD, any vehicle with PX4 AUTO.LOITER. A vehicle whose modes have no names is asked to pause.
    Hold,
    /// Resume after a hold.
    Resume,
}

impl FlightCommand {
    pub(super) fn fields(&self, vehicle: &Vehicle) -> Result<LongFields, Text> {
        Ok(match self {
            Self::SetMode { name } => mode_fields(vehicle, name)?,
            Self::Takeoff { altitude_m } => {
                let climb = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, *altitude_m as f32];
                LongFields::new(MavCmd::MAV_CMD_NAV_TAKEOFF, &climb)
            }
            Self::Land => LongFields::new(MavCmd::MAV_CMD_NAV_LAND, &[]),
            Self::ReturnToLaunch => LongFields::new(MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, &[]),
            Self::Hold => match holding_mode(vehicle) {
                Some(mode) => mode_fields(vehicle, mode)?,
                None => LongFields::new(MavCmd::MAV_CMD_DO_PAUSE_CONTINUE, &[0.0]),
            },
            Self::Resume => LongFields::new(MavCmd::MAV_CMD_DO_PAUSE_CONTINUE, &[1.0]),
        })
    }

    pub(super) fn effect(&self, before: &Vehicle) -> Effect {
        match self {
            Self::SetMode { name } => mode_effect(before, name),
            Self::Takeoff { altitude_m } => takeoff_effect(before, *altitude_m),
            Self::Land => landing_effect(before, "LAND"),
            Self::ReturnToLaunch => landing_effect(before, "RTL"),
            Self::Hold => match holding_mode(before) {
                Some(mode) => mode_effect(before, mode),
                None => Effect::new(Watched::Still, Duration::from_secs(15)),
            },
            Self::Resume => Effect::nothing(),
        }
    }

    pub(super) fn likely_reason(&self, vehicle: &Vehicle) -> Option<Text> {
        match self {
            Self::SetMode { name } => Some(text!("reason-mode", mode = name)),
            Self::Takeoff { .. } => takeoff_reason(vehicle),
            Self::Land | Self::ReturnToLaunch | Self::Hold | Self::Resume => None,
        }
    }
}

/// What a takeoff still needs, in the order of the steps; `None` if nothing is known to be missing.
fn takeoff_reason(vehicle: &Vehicle) -> Option<Text> {
    let needs_guided = |mode: &Mode| mode.class != VehicleClass::Px4 && !mode.is("GUIDED");
    let other_mode = vehicle.mode().filter(needs_guided);
    let other_mode = other_mode.map(|mode| vehicle.name_of(mode));
    match other_mode {
        Some(mode) if !vehicle.armed() => Some(text!("reason-takeoff-mode-arm", mode = mode)),
        None if !vehicle.armed() => Some(text!("reason-takeoff-arm")),
        _ if vehicle.airborne() => Some(text!("reason-flying")),
        Some(mode) => Some(text!("reason-takeoff-mode", mode = mode)),
        // A copter in GUIDED on the ground refuses without a text only when its motors are off: the
        // heartbeat that says so is up to a second late.
        None if vehicle.class() == VehicleClass::Copter => Some(text!("reason-takeoff-disarmed")),
        None => None,
    }
}

/// The highest plain mode number for PX4, whose own mode numbers are in the upper two bytes.
const MOST_PLAIN: u32 = 0xffff;

pub(super) fn mode_fields(vehicle: &Vehicle, name: &str) -> Result<LongFields, Text> {
    let number = mode_number(vehicle, name)?;
    let fields = if vehicle.runs_px4() && number > MOST_PLAIN {
        // PX4 takes the main mode and the sub-mode of its number apart.
        let [.., main, sub] = number.to_le_bytes();
        [1.0, f32::from(main), f32::from(sub)]
    } else {
        [1.0, number as f32, 0.0]
    };
    Ok(LongFields::new(MavCmd::MAV_CMD_DO_SET_MODE, &fields))
}
