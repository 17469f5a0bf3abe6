//! Where and how a vehicle flies, its point of interest, and its home.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavCmd;

use super::destination::{Destination, Heading};
use super::effect::{Effect, SOON, Watched, altitude_effect, mode_effect, travel_time, yaw_effect};
use super::encode::{self, FRAME_GLOBAL, FRAME_RELATIVE, IntFields, LongFields};
use super::request::{Repeat, Request};
use super::setpoint::{
    above_ground, arrival, goto, heading, height, needs_guided, place, position, setpoint,
};
use super::speeds;
use crate::geo::{LatLon, maths, wrap_360};
use crate::text;
use crate::text::Text;
use crate::vehicle::{SpeedAxis, Vehicle};

/// The time between repetitions of a velocity; ArduCopter stops 3 s after the last one (`GUID_TIMEOUT`).
const SETPOINT_EVERY: Duration = Duration::from_millis(200);

/// Sets where and how a vehicle flies, its point of interest, and its home.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MotionCommand {
    /// Fly to a place in GUIDED.
    Goto {
        destination: Destination,
        /// The heading on the way.
        heading: Heading,
    },
    /// Change the height at the current position, in GUIDED.
    Altitude {
        /// New height above home.
        altitude_m: f64,
    },
    /// Change the speed of the current mode.
    Speed {
        axis: SpeedAxis,
        /// The new limit in m/s.
        speed_m_s: f64,
    },
    Yaw {
        /// Degrees: clockwise from north, or from the current heading if `relative`.
        angle_deg: f64,
        /// Whether the angle counts from the current heading (clockwise positive).
        relative: bool,
        /// The turn rate in deg/s; `None` leaves it to the autopilot.
        rate_deg_s: Option<f64>,
    },
    /// Fly at a velocity for a time in GUIDED, then stop.
    Velocity {
        /// North, east, down, in m/s.
        ned_m_s: [f64; 3],
        lasting: Duration,
    },
    /// Circle around a point, with autopilots that support it in GUIDED.
    Orbit {
        /// Radius in metres; negative turns counterclockwise.
        radius_m: f64,
        /// Tangential speed in m/s.
        speed_m_s: f64,
        /// The centre; `None` for the vehicle's position.
        centre: Option<LatLon>,
        /// Height above home; `None` for the current one.
        altitude_m: Option<f64>,
    },
    /// Point the nose and camera at a place; `None` ends that.
    RegionOfInterest {
        /// The place and its height above home.
        target: Option<(LatLon, f64)>,
    },
    SetHome {
        /// The place and its height above sea level; `None` for the vehicle's position.
        place: Option<(LatLon, f64)>,
    },
}

impl MotionCommand {
    /// Whether the command is a setpoint, which vehicles do not answer.
    pub(super) fn is_setpoint(self) -> bool {
        match self {
            Self::Goto { .. } | Self::Altitude { .. } | Self::Velocity { .. } => true,
            Self::Speed { .. }
            | Self::Yaw { .. }
            | Self::Orbit { .. }
            | Self::RegionOfInterest { .. }
            | Self::SetHome { .. } => false,
        }
    }

    pub(super) fn request(self, vehicle: &Vehicle, confirmation: u8) -> Result<Request, Text> {
        match self {
            Self::Goto {
                destination,
                heading,
            } => goto(vehicle, destination, heading),
            Self::Altitude { altitude_m } => {
                needs_guided("altitude", vehicle)?;
                let here = position(vehicle)?;
                above_ground(vehicle, altitude_m)?;
                place(
                    encode::global_position(vehicle, here, altitude_m, None),
                    vehicle,
                )
            }
            Self::Velocity { ned_m_s, .. } => {
                needs_guided("velocity", vehicle)?;
                velocity(vehicle, ned_m_s)
            }
            Self::Speed { axis, speed_m_s } => {
                speeds::check(axis, vehicle)?;
                let fields = speeds::fields(vehicle, axis, speed_m_s);
                Request::long(vehicle, &fields, confirmation)
            }
            Self::Yaw {
                angle_deg,
                relative,
                rate_deg_s,
            } => {
                let rate = rate_deg_s.unwrap_or(0.0);
                let turned = yaw_params(vehicle, angle_deg, relative, rate)?;
                let fields = LongFields::new(MavCmd::MAV_CMD_CONDITION_YAW, &turned);
                Request::long(vehicle, &fields, confirmation)
            }
            Self::Orbit {
                radius_m,
                speed_m_s,
                centre,
                altitude_m,
            } => {
                // Parameter 3: face the centre; 4: circle until a new command.
                let ring = [radius_m as f32, speed_m_s as f32, 0.0, 0.0];
                orbit(vehicle, ring, centre, altitude_m)
            }
            Self::RegionOfInterest { target } => look_at(vehicle, target),
            Self::SetHome { place } => set_home(vehicle, place, confirmation),
        }
    }

    pub(super) fn repeat(self) -> Option<Repeat> {
        match self {
            Self::Velocity { lasting, .. } => Some(Repeat {
                every: SETPOINT_EVERY,
                lasting,
            }),
            Self::Goto { .. }
            | Self::Altitude { .. }
            | Self::Speed { .. }
            | Self::Yaw { .. }
            | Self::Orbit { .. }
            | Self::RegionOfInterest { .. }
            | Self::SetHome { .. } => None,
        }
    }

    pub(super) fn effect(self, before: &Vehicle) -> Effect {
        match self {
            Self::Goto { destination, .. } => match arrival(before, destination) {
                Ok(place) => Effect::new(Watched::Place(place), travel_time(before, place)),
                Err(_) => Effect::nothing(),
            },
            Self::Altitude { altitude_m } => altitude_effect(before, altitude_m, 0.0),
            Self::Yaw {
                angle_deg,
                relative,
                rate_deg_s,
            } => yaw_effect(before, angle_deg, relative, rate_deg_s),
            Self::Velocity { ned_m_s, lasting } => {
                Effect::new(Watched::Velocity(ned_m_s), lasting + SOON)
            }
            Self::SetHome { place } => {
                match place.map_or_else(|| position(before).ok(), |(point, _)| Some(point)) {
                    Some(point) => Effect::new(Watched::Home(point), SOON),
                    None => Effect::nothing(),
                }
            }
            Self::Orbit { .. } if before.runs_px4() => mode_effect(before, "POSCTL.ORBIT"),
            Self::Speed {
                axis: SpeedAxis::Ground,
                ..
            } if speeds::is_unmeasured(before) => {
                Effect::new(Watched::UnmeasuredSpeed, Duration::ZERO)
            }
            Self::Speed { .. } | Self::Orbit { .. } | Self::RegionOfInterest { .. } => {
                Effect::nothing()
            }
        }
    }
}

/// Moves at a velocity, and stops at the end.
fn velocity(vehicle: &Vehicle, ned_m_s: [f64; 3]) -> Result<Request, Text> {
    let [north, east, down] = ned_m_s;
    if vehicle.is_on_surface() && down != 0.0 {
        return Err(text!(
            "refused-surface-vertical",
            kind = vehicle.kind_name()
        ));
    }
    let mut request = setpoint(encode::velocity(vehicle, ned_m_s))?;
    request.closing = Some(if vehicle.is_on_surface() {
        let course_deg = maths::atan2(east, north).to_degrees();
        encode::standstill(vehicle, course_deg)?
    } else {
        encode::velocity(vehicle, [0.0; 3])?
    });
    Ok(request)
}

/// Circles around a centre at a height above home; by default, around the current position.
fn orbit(
    vehicle: &Vehicle,
    ring: [f32; 4],
    centre: Option<LatLon>,
    altitude_m: Option<f64>,
) -> Result<Request, Text> {
    let centre = centre.map_or_else(|| position(vehicle), Ok)?;
    let altitude_m = altitude_m.map_or_else(|| height(vehicle), Ok)?;
    let command = MavCmd::MAV_CMD_DO_ORBIT;
    let fields = IntFields::at(command, FRAME_RELATIVE, ring, centre, altitude_m)?;
    Request::int(vehicle, &fields)
}

/// Points the nose or the camera at a place with its height above home; `None` ends that.
fn look_at(vehicle: &Vehicle, target: Option<(LatLon, f64)>) -> Result<Request, Text> {
    let fields = match target {
        Some((point, height_m)) => {
            let command = MavCmd::MAV_CMD_DO_SET_ROI_LOCATION;
            IntFields::at(command, FRAME_RELATIVE, [0.0; 4], point, height_m)?
        }
        None => IntFields {
            command: MavCmd::MAV_CMD_DO_SET_ROI_NONE as u16,
            frame: FRAME_GLOBAL,
            params: [0.0; 4],
            x: 0,
            y: 0,
            z: 0.0,
        },
    };
    Request::int(vehicle, &fields)
}

/// Sets home to a place with its height above sea level, or to the vehicle's position.
fn set_home(
    vehicle: &Vehicle,
    place: Option<(LatLon, f64)>,
    confirmation: u8,
) -> Result<Request, Text> {
    let command = MavCmd::MAV_CMD_DO_SET_HOME;
    let Some((point, height_m)) = place else {
        let here = LongFields::new(command, &[1.0]);
        return Request::long(vehicle, &here, confirmation);
    };
    let fields = IntFields::at(command, FRAME_GLOBAL, [0.0; 4], point, height_m)?;
    Request::int(vehicle, &fields)
}

/// `CONDITION_YAW` with an absolute heading and a direction: 1 clockwise, -1 counterclockwise, 0 the shortest. A
/// relative turn is converted here, since a repeated relative command would turn twice.
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
