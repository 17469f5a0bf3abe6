//! Commands as PX4 takes them, where that differs from `ArduPilot`, and what PX4 does not have.
//!
//! Sources: PX4's `Commander.cpp`, `navigator_main.cpp` and `takeoff.cpp`, and what QGroundControl sends
//! (`PX4FirmwarePlugin.cc`). PX4 takes heights above sea level in every frame, angles of `DO_REPOSITION` in radians, and
//! NaN for whatever is left to the vehicle.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavCmd;

use super::destination::{Destination, Heading};
use super::encode::{self, FRAME_GLOBAL, IntFields, LongFields, finite};
use super::flight::mode_fields;
use super::modes::{AUTO_LOITER, OFFBOARD};
use super::plan_flight::MISSION;
use super::request::{Offboard, Request};
use super::setpoint::{above_ground, heading, height, position};
use super::{Command, DeviceCommand, FlightCommand, MotionCommand, PlanFlight};
use crate::geo::{LatLon, wrap_180};
use crate::text;
use crate::text::Text;
use crate::vehicle::{SpeedAxis, Vehicle};

/// Left to the vehicle.
const UNSET: f32 = f32::NAN;
/// The flag of `DO_REPOSITION` that changes the mode to AUTO.LOITER; PX4 refuses the command without it.
const CHANGE_MODE: f32 = 1.0;
/// No minimum pitch for a takeoff.
const NO_PITCH: f32 = -1.0;
/// The speed of `DO_REPOSITION` that leaves the vehicle's own.
const USUAL_SPEED: f32 = -1.0;
/// How long setpoints are sent before the change to OFFBOARD: PX4 wants them for more than one second.
const OFFBOARD_LEAD: Duration = Duration::from_millis(1500);

/// The request for a vehicle with PX4; `None` if it is the same as for `ArduPilot`.
pub(super) fn request(
    command: &Command,
    vehicle: &Vehicle,
    confirmation: u8,
) -> Option<Result<Request, Text>> {
    let long = |fields: Result<LongFields, Text>| {
        fields.and_then(|fields| Request::long(vehicle, &fields, confirmation))
    };
    match command {
        Command::Flight(command) => flight(command, vehicle).map(long),
        Command::Motion(MotionCommand::Orbit {
            radius_m,
            speed_m_s,
            centre,
            altitude_m,
        }) => {
            let ring = [*radius_m as f32, *speed_m_s as f32, 0.0, 0.0];
            Some(orbit(vehicle, ring, *centre, *altitude_m))
        }
        Command::Motion(MotionCommand::Goto {
            destination,
            heading,
        }) => Some(goto(vehicle, *destination, *heading)),
        Command::Motion(MotionCommand::Velocity { ned_m_s, .. }) => {
            Some(velocity(vehicle, *ned_m_s, confirmation))
        }
        Command::Motion(MotionCommand::RegionOfInterest {
            target: Some((point, height_m)),
        }) => Some(look_at(vehicle, *point, *height_m)),
        Command::Motion(command) => motion(*command, vehicle).map(long),
        Command::PlanFlight(command) => plan_flight(*command, vehicle).map(long),
        Command::Device(command) => lacking(*command).map(Err),
        Command::Arming(_)
        | Command::Query(_)
        | Command::Parameter(_)
        | Command::Log(_)
        | Command::File(_)
        | Command::Plan(_)
        | Command::Signing(_)
        | Command::Raw(_) => None,
    }
}

fn flight(command: &FlightCommand, vehicle: &Vehicle) -> Option<Result<LongFields, Text>> {
    match command {
        FlightCommand::Takeoff { altitude_m } => Some(takeoff(vehicle, *altitude_m)),
        FlightCommand::Land => {
            let here = [0.0, 0.0, 0.0, UNSET, UNSET, UNSET, UNSET];
            Some(Ok(LongFields::new(MavCmd::MAV_CMD_NAV_LAND, &here)))
        }
        FlightCommand::Resume => Some(Err(text!("refused-px4-resume"))),
        FlightCommand::SetMode { .. } | FlightCommand::ReturnToLaunch | FlightCommand::Hold => None,
    }
}

/// A takeoff where the vehicle stands. PX4 accepts it from disarmed vehicles as well, and then only changes the mode.
fn takeoff(vehicle: &Vehicle, altitude_m: f64) -> Result<LongFields, Text> {
    if vehicle.heartbeat.is_some() && !vehicle.armed() {
        return Err(not_armed("takeoff", vehicle));
    }
    let climb = above_sea(vehicle, altitude_m)?;
    let straight_up = [NO_PITCH, 0.0, 0.0, UNSET, UNSET, UNSET, climb];
    Ok(LongFields::new(MavCmd::MAV_CMD_NAV_TAKEOFF, &straight_up))
}

/// Movements that are a `COMMAND_LONG`.
fn motion(command: MotionCommand, vehicle: &Vehicle) -> Option<Result<LongFields, Text>> {
    match command {
        MotionCommand::Altitude { altitude_m } => Some(altitude(vehicle, altitude_m)),
        MotionCommand::Yaw {
            rate_deg_s: Some(_),
            ..
        } => Some(Err(text!("refused-px4-turn-rate"))),
        MotionCommand::Yaw {
            angle_deg,
            relative,
            rate_deg_s: None,
        } => Some(turn(vehicle, angle_deg, relative)),
        MotionCommand::Speed {
            axis: SpeedAxis::Climb | SpeedAxis::Descend,
            ..
        } => Some(Err(text!("refused-px4-vertical-speed"))),
        MotionCommand::Goto { .. }
        | MotionCommand::Velocity { .. }
        | MotionCommand::Speed { .. }
        | MotionCommand::Orbit { .. }
        | MotionCommand::RegionOfInterest { .. }
        | MotionCommand::SetHome { .. } => None,
    }
}

fn goto(vehicle: &Vehicle, destination: Destination, heading: Heading) -> Result<Request, Text> {
    flies("goto", vehicle)?;
    let (point, altitude_m) = destination
        .of(vehicle)
        .ok_or_else(|| text!("refused-no-position"))?;
    let altitude_m = altitude_m.map_or_else(|| height(vehicle), Ok)?;
    above_ground(vehicle, altitude_m)?;
    let yaw = match heading {
        Heading::Auto => UNSET,
        Heading::Keep => radians(f64::from(self::heading(vehicle)?)),
        Heading::Fixed(degrees) => radians(degrees),
    };
    let speed = vehicle.asked_speeds.ground_m_s();
    let speed = speed.map_or(USUAL_SPEED, |speed_m_s| speed_m_s as f32);
    let params = [speed, CHANGE_MODE, 0.0, yaw];
    at(
        MavCmd::MAV_CMD_DO_REPOSITION,
        vehicle,
        params,
        point,
        altitude_m,
    )
}

/// Flies at a velocity in OFFBOARD, and holds in AUTO.LOITER at the end.
fn velocity(vehicle: &Vehicle, ned_m_s: [f64; 3], confirmation: u8) -> Result<Request, Text> {
    flies("velocity", vehicle)?;
    let enter = mode_fields(vehicle, OFFBOARD)?;
    let leave = mode_fields(vehicle, AUTO_LOITER)?;
    let mut request = Request::long(vehicle, &enter, confirmation)?;
    let is_there = vehicle.mode().is_some_and(|mode| mode.is(OFFBOARD));
    request.offboard = Some(Box::new(Offboard {
        setpoint: encode::velocity(vehicle, ned_m_s)?,
        lead: if is_there {
            Duration::ZERO
        } else {
            OFFBOARD_LEAD
        },
        standstill: encode::velocity(vehicle, [0.0; 3])?,
        leave: encode::long(vehicle, &leave, 0)?,
        leave_command: leave.command,
    }));
    Ok(request)
}

fn altitude(vehicle: &Vehicle, altitude_m: f64) -> Result<LongFields, Text> {
    flies("altitude", vehicle)?;
    above_ground(vehicle, altitude_m)?;
    let height = above_sea(vehicle, altitude_m)?;
    Ok(reposition(UNSET, height))
}

/// A turn on the spot to an absolute heading; a relative one is converted here.
fn turn(vehicle: &Vehicle, angle_deg: f64, relative: bool) -> Result<LongFields, Text> {
    flies("yaw", vehicle)?;
    let from_deg = if relative {
        f64::from(heading(vehicle)?)
    } else {
        0.0
    };
    Ok(reposition(radians(from_deg + angle_deg), UNSET))
}

/// `DO_REPOSITION` over the same place; a `COMMAND_INT` could not leave the place to the vehicle.
fn reposition(yaw: f32, height: f32) -> LongFields {
    let params = [USUAL_SPEED, CHANGE_MODE, 0.0, yaw, UNSET, UNSET, height];
    LongFields::new(MavCmd::MAV_CMD_DO_REPOSITION, &params)
}

fn orbit(
    vehicle: &Vehicle,
    ring: [f32; 4],
    centre: Option<LatLon>,
    altitude_m: Option<f64>,
) -> Result<Request, Text> {
    flies("orbit", vehicle)?;
    let centre = centre.map_or_else(|| position(vehicle), Ok)?;
    let altitude_m = altitude_m.map_or_else(|| height(vehicle), Ok)?;
    above_ground(vehicle, altitude_m)?;
    at(MavCmd::MAV_CMD_DO_ORBIT, vehicle, ring, centre, altitude_m)
}

fn look_at(vehicle: &Vehicle, point: LatLon, height_m: f64) -> Result<Request, Text> {
    let command = MavCmd::MAV_CMD_DO_SET_ROI_LOCATION;
    at(command, vehicle, [0.0; 4], point, height_m)
}

fn plan_flight(command: PlanFlight, vehicle: &Vehicle) -> Option<Result<LongFields, Text>> {
    match command {
        PlanFlight::Goto { .. } | PlanFlight::Skip | PlanFlight::Resume { item: Some(_) } => {
            Some(Err(text!("refused-px4-plan-item")))
        }
        PlanFlight::Resume { item: None } if vehicle.armed() && !vehicle.is_on_the_ground() => {
            Some(mode_fields(vehicle, MISSION))
        }
        PlanFlight::Resume { item: None } => Some(Err(text!("refused-plan-on-ground"))),
        PlanFlight::Start | PlanFlight::Pause | PlanFlight::Abort => None,
    }
}

/// Why PX4 cannot carry a command out; `None` if it can.
fn lacking(command: DeviceCommand) -> Option<Text> {
    match command {
        DeviceCommand::Servo { .. } => Some(text!("refused-px4-servo")),
        DeviceCommand::Relay { .. } => Some(text!("refused-px4-relay")),
        DeviceCommand::Fence { .. } => Some(text!("refused-px4-fence")),
        DeviceCommand::Reboot | DeviceCommand::Control(_) | DeviceCommand::Sticks(_) => None,
    }
}

/// A `COMMAND_INT` at a place with its height above home.
fn at(
    command: MavCmd,
    vehicle: &Vehicle,
    params: [f32; 4],
    point: LatLon,
    altitude_m: f64,
) -> Result<Request, Text> {
    let height = above_sea(vehicle, altitude_m)?;
    let fields = IntFields::at(command, FRAME_GLOBAL, params, point, f64::from(height))?;
    Request::int(vehicle, &fields)
}

/// A height above home as the height above sea level, in metres.
fn above_sea(vehicle: &Vehicle, altitude_m: f64) -> Result<f32, Text> {
    let home_m = match (vehicle.home, vehicle.global) {
        (Some(home), _) => home.altitude_amsl_m,
        (None, Some(global)) => global.altitude_amsl_m - global.altitude_m,
        (None, None) => return Err(text!("refused-no-height")),
    };
    let height = (home_m + altitude_m) as f32;
    finite(&[height])?;
    Ok(height)
}

/// Refuses movements of a vehicle that does not fly, or takes off: in AUTO.LOITER on the ground, PX4 would accept and
/// ignore them, and a takeoff would end low.
fn flies(verb: &'static str, vehicle: &Vehicle) -> Result<(), Text> {
    if !vehicle.armed() {
        return Err(not_armed(verb, vehicle));
    }
    if vehicle.mode().is_some_and(|mode| mode.is("AUTO.TAKEOFF")) {
        return Err(text!("refused-taking-off", verb = verb));
    }
    if vehicle.is_on_the_ground() {
        let vehicle = vehicle.id;
        return Err(text!(
            "refused-on-the-ground",
            verb = verb,
            vehicle = vehicle
        ));
    }
    Ok(())
}

fn not_armed(verb: &'static str, vehicle: &Vehicle) -> Text {
    text!("refused-not-armed", verb = verb, vehicle = vehicle.id)
}

/// An angle in degrees as radians from -pi to pi.
fn radians(degrees: f64) -> f32 {
    wrap_180(degrees).to_radians() as f32
}
