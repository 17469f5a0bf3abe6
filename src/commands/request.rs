//! From a command to what goes out for it.

use std::time::Duration;

use super::encode::{self, FRAME_GLOBAL, FRAME_RELATIVE, IntFields};
use super::setpoint::{
    above_ground, acknowledged_int, goto, heading, height, needs_guided, position, setpoint,
};
use super::{Command, SpeedAxis};
use crate::geo::wrap_360;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleClass};
use crate::wire::Outgoing;

/// `MAV_CMD` numbers that this program sends.
pub(super) mod cmd {
    pub const NAV_RETURN_TO_LAUNCH: u16 = 20;
    pub const NAV_LAND: u16 = 21;
    pub const NAV_TAKEOFF: u16 = 22;
    pub const DO_ORBIT: u16 = 34;
    pub const CONDITION_YAW: u16 = 115;
    pub const DO_SET_MODE: u16 = 176;
    pub const DO_CHANGE_SPEED: u16 = 178;
    pub const DO_SET_HOME: u16 = 179;
    pub const DO_SET_RELAY: u16 = 181;
    pub const DO_SET_SERVO: u16 = 183;
    pub const DO_REPOSITION: u16 = 192;
    pub const DO_PAUSE_CONTINUE: u16 = 193;
    pub const DO_SET_ROI_LOCATION: u16 = 195;
    pub const DO_SET_ROI_NONE: u16 = 197;
    pub const PREFLIGHT_REBOOT_SHUTDOWN: u16 = 246;
    pub const COMPONENT_ARM_DISARM: u16 = 400;
    pub const SET_MESSAGE_INTERVAL: u16 = 511;
    pub const REQUEST_MESSAGE: u16 = 512;
}

/// Makes ArduPilot disarm in flight.
pub(super) const FORCE_DISARM: f32 = 21196.0;
/// How often a velocity is repeated; ArduCopter stops 3 s after the last one (`GUID_TIMEOUT`).
const SETPOINT_EVERY: Duration = Duration::from_millis(200);

/// What answers a request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Answer {
    /// `COMMAND_ACK` of this `MAV_CMD`.
    Ack(u16),
    /// `PARAM_VALUE` of this parameter.
    Parameter(String),
    /// Nothing ever comes (setpoints): only the effect tells.
    None,
}

/// What goes out for a command.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The messages, in order; usually one.
    pub messages: Vec<Outgoing>,
    /// What to wait for.
    pub answer: Answer,
    /// Sent once when a [`Repeat`] is over: a velocity ends with a stop.
    pub closing: Option<Outgoing>,
}

impl Request {
    pub(super) fn new(message: Outgoing, answer: Answer) -> Self {
        Self {
            messages: vec![message],
            answer,
            closing: None,
        }
    }

    /// Prepares the next try: the same messages, with the confirmation of a `COMMAND_LONG` counted up.
    pub fn again(&mut self) {
        for message in &mut self.messages {
            encode::confirm_again(message);
        }
    }
}

/// Setpoints that have to be repeated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Repeat {
    /// The time between two.
    pub every: Duration,
    /// For how long.
    pub lasting: Duration,
}

impl Command {
    /// What to send to `vehicle`, as it is now.
    ///
    /// Relative commands (an offset, the present height) are worked out here from the vehicle's state, so
    /// call it once per transaction and send the same messages again for another try
    /// ([`Request::again`]): asking anew would move the target.
    ///
    /// # Errors
    /// Plain words when it makes no sense for this vehicle now: a mode that its class lacks, a setpoint outside
    /// GUIDED (ArduCopter would ignore it silently), a relative target without a position, a value that is
    /// no finite number.
    pub fn request(&self, vehicle: &Vehicle, confirmation: u8) -> Result<Request, Text> {
        match self {
            Self::Goto {
                destination,
                heading,
            } => goto(vehicle, *destination, *heading),
            Self::Altitude { altitude_m } => {
                needs_guided("altitude", vehicle)?;
                let here = position(vehicle)?;
                above_ground(vehicle, *altitude_m)?;
                setpoint(encode::global_position(vehicle, here, *altitude_m, None))
            }
            Self::Velocity { ned_m_s, .. } => {
                needs_guided("velocity", vehicle)?;
                let mut request = setpoint(encode::velocity(vehicle, *ned_m_s))?;
                request.closing = Some(encode::velocity(vehicle, [0.0; 3])?);
                Ok(request)
            }
            Self::GetParameter { name } => Ok(Request::new(
                encode::read_parameter(vehicle, name)?,
                Answer::Parameter(name.clone()),
            )),
            Self::SetParameter { name, value } => Ok(Request::new(
                encode::write_parameter(vehicle, name, *value as f32)?,
                Answer::Parameter(name.clone()),
            )),
            Self::Orbit { .. } | Self::RegionOfInterest { .. } | Self::Int { .. } => {
                acknowledged_int(vehicle, &self.int_fields(vehicle)?)
            }
            Self::SetHome { place: Some(place) } => acknowledged_int(
                vehicle,
                &IntFields::at(cmd::DO_SET_HOME, FRAME_GLOBAL, [0.0; 4], *place)?,
            ),
            _ => {
                let (command, params) = self.long_fields(vehicle)?;
                let message = encode::long(vehicle, command, params, confirmation)?;
                Ok(Request::new(message, Answer::Ack(command)))
            }
        }
    }

    /// Whether and how its message has to be repeated to keep working.
    pub fn repeat(&self) -> Option<Repeat> {
        match self {
            Self::Velocity { lasting, .. } => Some(Repeat {
                every: SETPOINT_EVERY,
                lasting: *lasting,
            }),
            _ => None,
        }
    }

    /// What a `PARAM_VALUE` says about a parameter command, as "`WPNAV_SPEED` = 500". It also says so where rounding
    /// has made another value of the one that was asked for.
    ///
    /// # Errors
    /// In plain words when the vehicle kept another value than was set. Whole-numbered parameters cut off the
    /// fraction, which is no fault.
    pub fn parameter_outcome(&self, value: f32) -> Result<Text, Text> {
        let (name, wanted) = match self {
            Self::SetParameter { name, value } => (name, *value),
            Self::GetParameter { name } => return Ok(format!("{name} = {value}").into()),
            _ => return Ok(value.to_string().into()),
        };
        let carried = wanted as f32;
        let is_kept = (value - carried).abs() <= 1e-6 * carried.abs();
        if !is_kept && (value - carried.trunc()).abs() > f32::EPSILON {
            let (value, wanted) = (value.to_string(), wanted.to_string());
            return Err(text!(
                "refused-value",
                name = name,
                value = value,
                wanted = wanted
            ));
        }
        if is_written_so(value, wanted) {
            return Ok(format!("{name} = {value}").into());
        }
        let (value, wanted) = (value.to_string(), wanted.to_string());
        Ok(text!(
            "outcome-value-became",
            name = name,
            value = value,
            wanted = wanted
        ))
    }

    /// Command and parameters of those that go as `COMMAND_LONG`.
    fn long_fields(&self, vehicle: &Vehicle) -> Result<(u16, [f32; 7]), Text> {
        Ok(match self {
            Self::Arm if vehicle.airborne() && !vehicle.armed() => {
                return Err(text!("refused-arm-in-the-air"));
            }
            Self::Arm => (cmd::COMPONENT_ARM_DISARM, params(&[1.0])),
            Self::Disarm => (cmd::COMPONENT_ARM_DISARM, params(&[0.0])),
            Self::Kill => (cmd::COMPONENT_ARM_DISARM, params(&[0.0, FORCE_DISARM])),
            Self::SetMode { name } => (
                cmd::DO_SET_MODE,
                params(&[1.0, mode_number(vehicle, name)? as f32]),
            ),
            Self::Takeoff { altitude_m } => {
                let climb = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, *altitude_m as f32];
                (cmd::NAV_TAKEOFF, climb)
            }
            Self::Land => (cmd::NAV_LAND, params(&[])),
            Self::ReturnToLaunch => (cmd::NAV_RETURN_TO_LAUNCH, params(&[])),
            Self::Hold => match holding_mode(vehicle) {
                Some(mode) => (
                    cmd::DO_SET_MODE,
                    params(&[1.0, mode_number(vehicle, mode)? as f32]),
                ),
                None => (cmd::DO_PAUSE_CONTINUE, params(&[0.0])),
            },
            Self::Resume => (cmd::DO_PAUSE_CONTINUE, params(&[1.0])),
            Self::SetHome { .. } => (cmd::DO_SET_HOME, params(&[1.0])),
            Self::Reboot if vehicle.armed() => {
                return Err(text!("refused-reboot-armed"));
            }
            Self::Reboot => (cmd::PREFLIGHT_REBOOT_SHUTDOWN, params(&[1.0])),
            Self::Speed { .. } | Self::Yaw { .. } => return self.motion_fields(vehicle),
            other => return other.device_fields(),
        })
    }

    /// `COMMAND_LONG` of what changes a movement.
    fn motion_fields(&self, vehicle: &Vehicle) -> Result<(u16, [f32; 7]), Text> {
        Ok(match self {
            Self::Speed { axis, speed_m_s } => {
                let kind = match axis {
                    SpeedAxis::Ground => 1.0,
                    SpeedAxis::Climb => 2.0,
                    SpeedAxis::Descend => 3.0,
                };
                // -1 leaves the throttle alone.
                let changed = params(&[kind, *speed_m_s as f32, -1.0]);
                (cmd::DO_CHANGE_SPEED, changed)
            }
            Self::Yaw {
                angle_deg,
                relative,
                rate_deg_s,
            } => {
                let rate = rate_deg_s.unwrap_or(0.0);
                let turned = yaw_params(vehicle, *angle_deg, *relative, rate)?;
                (cmd::CONDITION_YAW, turned)
            }
            other => return Err(other.has_no_encoding("COMMAND_LONG")),
        })
    }

    /// `COMMAND_LONG` of what does not depend on the vehicle's state.
    fn device_fields(&self) -> Result<(u16, [f32; 7]), Text> {
        Ok(match self {
            Self::Servo { output, pulse_us } => (
                cmd::DO_SET_SERVO,
                params(&[f32::from(*output), f32::from(*pulse_us)]),
            ),
            Self::Relay { relay, on } => (
                cmd::DO_SET_RELAY,
                params(&[f32::from(*relay), f32::from(u8::from(*on))]),
            ),
            Self::MessageInterval { message, rate_hz } => {
                let interval_us = if *rate_hz > 0.0 { 1e6 / rate_hz } else { -1.0 };
                (
                    cmd::SET_MESSAGE_INTERVAL,
                    params(&[*message as f32, interval_us as f32]),
                )
            }
            Self::RequestMessage { message } => (cmd::REQUEST_MESSAGE, params(&[*message as f32])),
            Self::Long { command, params } => (*command, *params),
            other => return Err(other.has_no_encoding("COMMAND_LONG")),
        })
    }

    /// The fields of those that go as `COMMAND_INT`.
    fn int_fields(&self, vehicle: &Vehicle) -> Result<IntFields, Text> {
        match self {
            Self::Orbit {
                radius_m,
                speed_m_s,
                centre,
                altitude_m,
            } => {
                let centre = centre.map_or_else(|| position(vehicle), Ok)?;
                let altitude = altitude_m.map_or_else(|| height(vehicle), Ok)?;
                // Parameter 3: face the centre; 4: circle until told otherwise.
                let ring = [*radius_m as f32, *speed_m_s as f32, 0.0, 0.0];
                IntFields::at(cmd::DO_ORBIT, FRAME_RELATIVE, ring, (centre, altitude))
            }
            Self::RegionOfInterest { target } => match target {
                Some(place) => {
                    IntFields::at(cmd::DO_SET_ROI_LOCATION, FRAME_RELATIVE, [0.0; 4], *place)
                }
                None => Ok(IntFields {
                    command: cmd::DO_SET_ROI_NONE,
                    frame: FRAME_GLOBAL,
                    params: [0.0; 4],
                    x: 0,
                    y: 0,
                    z: 0.0,
                }),
            },
            Self::Int {
                command,
                frame,
                params,
                x,
                y,
                z,
            } => Ok(IntFields {
                command: *command,
                frame: *frame,
                params: *params,
                x: *x,
                y: *y,
                z: *z,
            }),
            other => Err(other.has_no_encoding("COMMAND_INT")),
        }
    }

    fn has_no_encoding(&self, message: &'static str) -> Text {
        let command = format!("{self:?}");
        text!("refused-encoding", command = command, message = message)
    }
}

/// Whether a value is just what somebody wrote: exactly, or as the shortest number that means it (0.1).
pub fn is_written_so(value: f32, written: f64) -> bool {
    let differs = |value: f64| (value - written).abs() > 0.0;
    let shortest = value.to_string().parse().unwrap_or(f64::NAN);
    !differs(f64::from(value)) || !differs(shortest)
}

fn params(given: &[f32]) -> [f32; 7] {
    let mut all = [0.0; 7];
    all[..given.len()].copy_from_slice(given);
    all
}

/// `CONDITION_YAW` with an absolute heading and a direction: 1 clockwise, -1 counter-clockwise, 0 the shortest. A
/// relative turn is worked out here, since a vehicle that is asked twice for a relative one turns twice.
fn yaw_params(
    vehicle: &Vehicle,
    angle_deg: f64,
    relative: bool,
    rate_deg_s: f64,
) -> Result<[f32; 7], Text> {
    let (heading, direction) = if relative {
        let now = f64::from(heading(vehicle)?);
        (now + angle_deg, if angle_deg < 0.0 { -1.0 } else { 1.0 })
    } else {
        (angle_deg, 0.0)
    };
    Ok(params(&[
        wrap_360(heading) as f32,
        rate_deg_s as f32,
        direction,
    ]))
}

/// The mode in which a vehicle stays where it is; `None` where pausing does it.
pub(super) fn holding_mode(vehicle: &Vehicle) -> Option<&'static str> {
    let mode = vehicle.mode()?;
    match mode.class {
        VehicleClass::Copter if mode.is("GUIDED") || mode.is("AUTO") => None,
        VehicleClass::Copter => Some("BRAKE"),
        VehicleClass::Plane => Some("LOITER"),
        VehicleClass::Rover => Some("HOLD"),
        VehicleClass::Sub => Some("POSHOLD"),
        VehicleClass::Other => None,
    }
}

/// The number of a mode; a plain number is taken as it is.
pub(super) fn mode_number(vehicle: &Vehicle, name: &str) -> Result<u32, Text> {
    if let Ok(number) = name.parse::<u8>() {
        return Ok(u32::from(number));
    }
    let Some(heartbeat) = vehicle.heartbeat else {
        return Err(text!("refused-not-heard"));
    };
    heartbeat
        .class
        .mode(name)
        .map(|mode| mode.number)
        .ok_or_else(|| text!("refused-no-mode", mode = name))
}
