//! Setpoints: the end of a `goto`, and the conditions for setpoints.

use mavlink::dialects::ardupilotmega::MavCmd;

use super::destination::{Destination, Heading};
use super::encode::{self, FRAME_RELATIVE, IntFields};
use super::request::{Answer, Request};
use super::speeds;

use crate::geo::LatLon;
use crate::text;
use crate::text::Text;
use crate::vehicle::{LandedState, Vehicle, VehicleClass};
use crate::wire::Outgoing;

/// The minimum height of a setpoint above home; any lower, the vehicle would fly into the ground.
const LOWEST_M: f64 = 0.5;
/// Below this height above home, or while the vehicle climbs faster than [`TAKEOFF_CLIMB_M_S`], a
/// setpoint would abort a takeoff. Near the end of a takeoff the climb slows down (to about 1 m/s
/// at 90 % of the height), and a setpoint does no harm.
const TAKEOFF_BELOW_M: f64 = 1.5;
const TAKEOFF_CLIMB_M_S: f32 = 1.5;
/// A vehicle that climbs faster than this has left the ground, whatever its status.
const LIFTING_M_S: f32 = 0.3;

pub(super) fn goto(
    vehicle: &Vehicle,
    destination: Destination,
    heading: Heading,
) -> Result<Request, Text> {
    needs_guided("goto", vehicle)?;
    if vehicle.class() == VehicleClass::Plane {
        return match heading {
            Heading::Auto => reposition(vehicle, destination),
            Heading::Fixed(_) | Heading::Keep => Err(text!("refused-plane-heading")),
        };
    }
    let yaw_deg = match heading {
        Heading::Auto => None,
        Heading::Fixed(degrees) => Some(degrees),
        Heading::Keep => Some(f64::from(self::heading(vehicle)?)),
    };
    match arrival(vehicle, destination)? {
        TravelEnd::Global { point, altitude_m } => {
            above_ground(vehicle, altitude_m)?;
            place(
                encode::global_position(vehicle, point, altitude_m, yaw_deg),
                vehicle,
            )
        }
        TravelEnd::Local { ned_m } => {
            above_ground(vehicle, height_of(vehicle, ned_m[2]))?;
            place(encode::local_position(vehicle, ned_m, yaw_deg), vehicle)
        }
    }
}

/// A `DO_REPOSITION`, the only command with which `ArduPlane` flies to a point.
fn reposition(vehicle: &Vehicle, destination: Destination) -> Result<Request, Text> {
    let (point, altitude_m) = place_of(vehicle, destination)?;
    // Parameters 1 and 2: the default speed (-1); stay in or change to GUIDED (1).
    let fields = IntFields::at(
        MavCmd::MAV_CMD_DO_REPOSITION,
        FRAME_RELATIVE,
        [-1.0, 1.0, 0.0, 0.0],
        point,
        altitude_m,
    )?;
    Request::int(vehicle, &fields)
}

/// The place of a destination on the earth, and its height above home.
fn place_of(vehicle: &Vehicle, destination: Destination) -> Result<(LatLon, f64), Text> {
    let place = destination.of(vehicle);
    let (point, asked_m) = place.ok_or_else(|| text!("refused-no-position"))?;
    Ok((point, asked_m.map_or_else(|| height(vehicle), Ok)?))
}

/// The end of a `goto`, in the frame in which it is sent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum TravelEnd {
    Global { point: LatLon, altitude_m: f64 },
    Local { ned_m: [f64; 3] },
}

/// Resolves the relative and missing parts of a destination, using the vehicle's position.
pub(super) fn arrival(vehicle: &Vehicle, destination: Destination) -> Result<TravelEnd, Text> {
    if vehicle.class() == VehicleClass::Plane {
        let (point, altitude_m) = place_of(vehicle, destination)?;
        return Ok(TravelEnd::Global { point, altitude_m });
    }
    match destination {
        Destination::Global {
            at_point,
            altitude_m,
        } => Ok(TravelEnd::Global {
            point: at_point,
            altitude_m: altitude_m.map_or_else(|| height(vehicle), Ok)?,
        }),
        Destination::Local {
            north_m,
            east_m,
            up_m,
        } => {
            let down_m = match up_m {
                Some(up_m) => -up_m,
                None => local(vehicle)?[2],
            };
            Ok(TravelEnd::Local {
                ned_m: [north_m, east_m, down_m],
            })
        }
        Destination::Offset {
            north_m,
            east_m,
            up_m,
        } => match local(vehicle) {
            Ok([north, east, down]) => Ok(TravelEnd::Local {
                ned_m: [north + north_m, east + east_m, down - up_m],
            }),
            Err(_) => Ok(TravelEnd::Global {
                point: position(vehicle)?.moved(north_m, east_m),
                altitude_m: height(vehicle)? + up_m,
            }),
        },
    }
}

impl TravelEnd {
    /// Its point on the earth; `None` for a local one of a vehicle whose positions are not known.
    pub fn point(self, vehicle: &Vehicle) -> Option<LatLon> {
        match self {
            Self::Global { point, .. } => Some(point),
            Self::Local { ned_m } => {
                let (at_point, [north_m, east_m, _]) = both_positions(vehicle)?;
                Some(at_point.moved(ned_m[0] - north_m, ned_m[1] - east_m))
            }
        }
    }
}

/// The height above home of a local position, from its offset to the vehicle.
fn height_of(vehicle: &Vehicle, down_m: f64) -> f64 {
    match (vehicle.altitude_m(), both_positions(vehicle)) {
        (Some(altitude_m), Some((_, here))) => altitude_m + here[2] - down_m,
        _ => -down_m,
    }
}

/// The vehicle's position on the earth and its local one at that time. It reports them at different times, between
/// which it may move: at a constant acceleration, by its mean velocity.
fn both_positions(vehicle: &Vehicle) -> Option<(LatLon, [f64; 3])> {
    let (global, local) = (vehicle.global?, vehicle.local?);
    let later_s = global.at.as_secs_f64() - local.at.as_secs_f64();
    let velocity_m_s = [global.north_m_s, global.east_m_s, global.down_m_s];
    let here = std::array::from_fn(|axis| {
        let mean_m_s = f32::midpoint(local.velocity_m_s[axis], velocity_m_s[axis]);
        f64::from(local.ned_m[axis]) + f64::from(mean_m_s) * later_s
    });
    Some((global.at_point, here))
}

/// Refuses setpoints that the autopilot would silently ignore: outside GUIDED, disarmed, or before
/// takeoff. A plane on the ground would start its motor.
pub(super) fn needs_guided(verb: &'static str, vehicle: &Vehicle) -> Result<(), Text> {
    let id = vehicle.id;
    let Some(heartbeat) = vehicle.heartbeat else {
        return Err(text!("refused-not-heard"));
    };
    if heartbeat.class == VehicleClass::Other {
        return Ok(());
    }
    if !heartbeat.is_ardupilot() {
        return Err(text!("refused-guided-autopilot", verb = verb));
    }
    if !heartbeat.mode.is("GUIDED") {
        return Err(text!(
            "refused-not-guided",
            verb = verb,
            mode = vehicle.name_of(heartbeat.mode),
            vehicle = id
        ));
    }
    if !heartbeat.armed {
        return Err(text!("refused-not-armed", verb = verb, vehicle = id));
    }
    match heartbeat.class {
        VehicleClass::Copter => flies_freely(verb, vehicle),
        VehicleClass::Plane if vehicle.landed == LandedState::OnGround => {
            Err(text!("refused-plane-on-ground", verb = verb, vehicle = id))
        }
        VehicleClass::Plane
        | VehicleClass::Rover
        | VehicleClass::Sub
        | VehicleClass::Px4
        | VehicleClass::Other => Ok(()),
    }
}

/// Refuses setpoints on the ground, where they do nothing, and during a takeoff, which they would abort silently.
fn flies_freely(verb: &'static str, vehicle: &Vehicle) -> Result<(), Text> {
    let climb_m_s = vehicle.global.map_or(0.0, |global| -global.down_m_s);
    let low = vehicle
        .altitude_m()
        .is_some_and(|height_m| height_m < TAKEOFF_BELOW_M);
    let taking_off = match vehicle.landed {
        LandedState::Takeoff => low || climb_m_s > TAKEOFF_CLIMB_M_S,
        LandedState::OnGround => climb_m_s > LIFTING_M_S,
        LandedState::Undefined | LandedState::InAir | LandedState::Landing => false,
    };
    if taking_off {
        return Err(text!("refused-taking-off", verb = verb));
    }
    if !vehicle.airborne() {
        return Err(text!(
            "refused-on-the-ground",
            verb = verb,
            vehicle = vehicle.id
        ));
    }
    Ok(())
}

/// Refuses heights at which a multirotor would fly into the ground.
pub(super) fn above_ground(vehicle: &Vehicle, altitude_m: f64) -> Result<(), Text> {
    if vehicle.class() == VehicleClass::Copter && altitude_m < LOWEST_M {
        return Err(text!(
            "refused-too-low",
            metres = format!("{altitude_m:.1}"),
            vehicle = vehicle.id
        ));
    }
    Ok(())
}

pub(super) fn position(vehicle: &Vehicle) -> Result<LatLon, Text> {
    vehicle
        .global
        .map(|global| global.at_point)
        .ok_or_else(|| text!("refused-no-position"))
}

pub(super) fn heading(vehicle: &Vehicle) -> Result<f32, Text> {
    vehicle
        .heading_deg()
        .ok_or_else(|| text!("refused-no-heading"))
}

pub(super) fn height(vehicle: &Vehicle) -> Result<f64, Text> {
    vehicle
        .altitude_m()
        .ok_or_else(|| text!("refused-no-height"))
}

fn local(vehicle: &Vehicle) -> Result<[f64; 3], Text> {
    vehicle
        .local
        .map(|local| local.ned_m.map(f64::from))
        .ok_or_else(|| text!("refused-no-position"))
}

/// A request that expects no answer.
pub(super) fn setpoint(message: Result<Outgoing, Text>) -> Result<Request, Text> {
    Ok(Request::new(message?, Answer::None))
}

/// A request to fly to a place, followed by the commanded speeds.
pub(super) fn place(message: Result<Outgoing, Text>, vehicle: &Vehicle) -> Result<Request, Text> {
    let mut request = setpoint(message)?;
    request.speeds = speeds::asked_again(vehicle)?;
    Ok(request)
}

/// A vehicle's setpoint in a manoeuvre, repeated while the manoeuvre lasts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setpoint {
    pub at_point: LatLon,
    /// Height above home in metres.
    pub altitude_m: f64,
    /// The velocity of `at_point`: north, east, down in m/s; `None` if the point is fixed.
    pub velocity_m_s: Option<[f64; 3]>,
}

impl Setpoint {
    /// The message for a vehicle.
    ///
    /// # Errors
    /// A text if the setpoint would lead into the ground or its point is not valid.
    pub fn message(&self, vehicle: &Vehicle) -> Result<Outgoing, Text> {
        above_ground(vehicle, self.altitude_m)?;
        match self.velocity_m_s {
            None => encode::global_position(vehicle, self.at_point, self.altitude_m, None),
            Some(velocity) => {
                encode::moving_position(vehicle, self.at_point, self.altitude_m, velocity)
            }
        }
    }
}

/// Checks that a vehicle can take part in the manoeuvre `verb`.
///
/// # Errors
/// A text if something is missing: GUIDED, armed motors, height or a position.
pub fn ready_for(verb: &'static str, vehicle: &Vehicle) -> Result<(), Text> {
    needs_guided(verb, vehicle)?;
    position(vehicle)?;
    height(vehicle).map(drop)
}
