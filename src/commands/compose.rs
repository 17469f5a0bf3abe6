//! From a command to what goes out for it.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavCmd;

use super::encode::{self, FRAME_GLOBAL, FRAME_RELATIVE, IntFields};
use super::request::{Answer, Repeat, Request};
use super::setpoint::{
    above_ground, acknowledged_int, goto, heading, height, needs_guided, position, setpoint,
};
use super::{
    ArmingCommand, Command, DeviceCommand, FlightCommand, MotionCommand, QueryCommand, RawCommand,
    SpeedAxis,
};
use crate::geo::wrap_360;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleClass};

/// Makes ArduPilot disarm in flight.
pub(super) const FORCE_DISARM: f32 = 21196.0;
/// How often a velocity is repeated; ArduCopter stops 3 s after the last one (`GUID_TIMEOUT`).
const SETPOINT_EVERY: Duration = Duration::from_millis(200);

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
        let long = |fields: LongFields| fields.request(vehicle, confirmation);
        match self {
            Self::Arming(command) => long(command.fields(vehicle)?),
            Self::Flight(command) => long(command.fields(vehicle)?),
            Self::Motion(command) => command.request(vehicle, confirmation),
            Self::Device(command) => long(command.fields(vehicle)?),
            Self::Query(command) => long(command.fields()),
            Self::Parameter(command) => command.request(vehicle),
            Self::Raw(RawCommand::Long { command, params }) => long(LongFields {
                command: *command,
                params: *params,
            }),
            Self::Raw(RawCommand::Int {
                command,
                frame,
                params,
                x,
                y,
                z,
            }) => acknowledged_int(
                vehicle,
                &IntFields {
                    command: *command,
                    frame: *frame,
                    params: *params,
                    x: *x,
                    y: *y,
                    z: *z,
                },
            ),
        }
    }

    /// Whether and how its message has to be repeated to keep working.
    pub fn repeat(&self) -> Option<Repeat> {
        match self {
            Self::Motion(MotionCommand::Velocity { lasting, .. }) => Some(Repeat {
                every: SETPOINT_EVERY,
                lasting: *lasting,
            }),
            Self::Motion(_)
            | Self::Arming(_)
            | Self::Flight(_)
            | Self::Device(_)
            | Self::Query(_)
            | Self::Parameter(_)
            | Self::Raw(_) => None,
        }
    }
}

/// Command and parameters of a `COMMAND_LONG`.
struct LongFields {
    command: u16,
    params: [f32; 7],
}

impl LongFields {
    /// The first parameters are given; the others are 0.
    fn new(command: MavCmd, given: &[f32]) -> Self {
        let mut params = [0.0; 7];
        params[..given.len()].copy_from_slice(given);
        Self {
            command: command as u16,
            params,
        }
    }

    fn request(&self, vehicle: &Vehicle, confirmation: u8) -> Result<Request, Text> {
        let message = encode::long(vehicle, self.command, self.params, confirmation)?;
        Ok(Request::new(message, Answer::Ack(self.command)))
    }

    fn mode(vehicle: &Vehicle, name: &str) -> Result<Self, Text> {
        let number = mode_number(vehicle, name)? as f32;
        Ok(Self::new(MavCmd::MAV_CMD_DO_SET_MODE, &[1.0, number]))
    }
}

impl ArmingCommand {
    fn fields(self, vehicle: &Vehicle) -> Result<LongFields, Text> {
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
}

impl FlightCommand {
    fn fields(&self, vehicle: &Vehicle) -> Result<LongFields, Text> {
        Ok(match self {
            Self::SetMode { name } => LongFields::mode(vehicle, name)?,
            Self::Takeoff { altitude_m } => {
                let climb = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, *altitude_m as f32];
                LongFields::new(MavCmd::MAV_CMD_NAV_TAKEOFF, &climb)
            }
            Self::Land => LongFields::new(MavCmd::MAV_CMD_NAV_LAND, &[]),
            Self::ReturnToLaunch => LongFields::new(MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, &[]),
            Self::Hold => match holding_mode(vehicle) {
                Some(mode) => LongFields::mode(vehicle, mode)?,
                None => LongFields::new(MavCmd::MAV_CMD_DO_PAUSE_CONTINUE, &[0.0]),
            },
            Self::Resume => LongFields::new(MavCmd::MAV_CMD_DO_PAUSE_CONTINUE, &[1.0]),
        })
    }
}

impl MotionCommand {
    fn request(self, vehicle: &Vehicle, confirmation: u8) -> Result<Request, Text> {
        match self {
            Self::Goto {
                destination,
                heading,
            } => goto(vehicle, destination, heading),
            Self::Altitude { altitude_m } => {
                needs_guided("altitude", vehicle)?;
                let here = position(vehicle)?;
                above_ground(vehicle, altitude_m)?;
                setpoint(encode::global_position(vehicle, here, altitude_m, None))
            }
            Self::Velocity { ned_m_s, .. } => {
                needs_guided("velocity", vehicle)?;
                let mut request = setpoint(encode::velocity(vehicle, ned_m_s))?;
                request.closing = Some(encode::velocity(vehicle, [0.0; 3])?);
                Ok(request)
            }
            Self::Speed { axis, speed_m_s } => {
                // -1 leaves the throttle alone.
                let changed = [axis.number(), speed_m_s as f32, -1.0];
                LongFields::new(MavCmd::MAV_CMD_DO_CHANGE_SPEED, &changed)
                    .request(vehicle, confirmation)
            }
            Self::Yaw {
                angle_deg,
                relative,
                rate_deg_s,
            } => {
                let rate = rate_deg_s.unwrap_or(0.0);
                let turned = yaw_params(vehicle, angle_deg, relative, rate)?;
                LongFields::new(MavCmd::MAV_CMD_CONDITION_YAW, &turned)
                    .request(vehicle, confirmation)
            }
            Self::Orbit {
                radius_m,
                speed_m_s,
                centre,
                altitude_m,
            } => {
                let centre = centre.map_or_else(|| position(vehicle), Ok)?;
                let altitude_m = altitude_m.map_or_else(|| height(vehicle), Ok)?;
                // Parameter 3: face the centre; 4: circle until told otherwise.
                let ring = [radius_m as f32, speed_m_s as f32, 0.0, 0.0];
                let command = MavCmd::MAV_CMD_DO_ORBIT;
                let fields = IntFields::at(command, FRAME_RELATIVE, ring, (centre, altitude_m))?;
                acknowledged_int(vehicle, &fields)
            }
            Self::RegionOfInterest { target } => acknowledged_int(
                vehicle,
                &match target {
                    Some(place) => {
                        let command = MavCmd::MAV_CMD_DO_SET_ROI_LOCATION;
                        IntFields::at(command, FRAME_RELATIVE, [0.0; 4], place)?
                    }
                    None => IntFields {
                        command: MavCmd::MAV_CMD_DO_SET_ROI_NONE as u16,
                        frame: FRAME_GLOBAL,
                        params: [0.0; 4],
                        x: 0,
                        y: 0,
                        z: 0.0,
                    },
                },
            ),
            Self::SetHome { place: Some(place) } => {
                let command = MavCmd::MAV_CMD_DO_SET_HOME;
                let fields = IntFields::at(command, FRAME_GLOBAL, [0.0; 4], place)?;
                acknowledged_int(vehicle, &fields)
            }
            Self::SetHome { place: None } => {
                let here = LongFields::new(MavCmd::MAV_CMD_DO_SET_HOME, &[1.0]);
                here.request(vehicle, confirmation)
            }
        }
    }
}

impl SpeedAxis {
    /// `SPEED_TYPE`.
    fn number(self) -> f32 {
        match self {
            Self::Ground => 1.0,
            Self::Climb => 2.0,
            Self::Descend => 3.0,
        }
    }
}

impl DeviceCommand {
    fn fields(self, vehicle: &Vehicle) -> Result<LongFields, Text> {
        Ok(match self {
            Self::Servo { output, pulse_us } => LongFields::new(
                MavCmd::MAV_CMD_DO_SET_SERVO,
                &[f32::from(output), f32::from(pulse_us)],
            ),
            Self::Relay { relay, on } => LongFields::new(
                MavCmd::MAV_CMD_DO_SET_RELAY,
                &[f32::from(relay), f32::from(u8::from(on))],
            ),
            Self::Reboot if vehicle.armed() => return Err(text!("refused-reboot-armed")),
            Self::Reboot => LongFields::new(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, &[1.0]),
        })
    }
}

impl QueryCommand {
    fn fields(self) -> LongFields {
        match self {
            Self::Interval { message, rate_hz } => {
                let interval_us = if rate_hz > 0.0 { 1e6 / rate_hz } else { -1.0 };
                LongFields::new(
                    MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL,
                    &[message as f32, interval_us as f32],
                )
            }
            Self::Request { message } => {
                LongFields::new(MavCmd::MAV_CMD_REQUEST_MESSAGE, &[message as f32])
            }
        }
    }
}

/// `CONDITION_YAW` with an absolute heading and a direction: 1 clockwise, -1 counter-clockwise, 0 the shortest. A
/// relative turn is worked out here, since a vehicle that is asked twice for a relative one turns twice.
fn yaw_params(
    vehicle: &Vehicle,
    angle_deg: f64,
    relative: bool,
    rate_deg_s: f64,
) -> Result<[f32; 3], Text> {
    let (heading, direction) = if relative {
        let now = f64::from(heading(vehicle)?);
        (now + angle_deg, if angle_deg < 0.0 { -1.0 } else { 1.0 })
    } else {
        (angle_deg, 0.0)
    };
    Ok([wrap_360(heading) as f32, rate_deg_s as f32, direction])
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
