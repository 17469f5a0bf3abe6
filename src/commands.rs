//! Typed commands to a vehicle.
//!
//! Each command is a value with named fields in physical units. It knows how to become a MAVLink request
//! for a given vehicle ([`Command::request`]), what answer to wait for ([`Request::answer`]) and what
//! telemetry will show once it works ([`Command::effect`]).

use std::time::Duration;

use crate::geo::LatLon;

mod compose;
mod deed;
mod effect;
mod encode;
mod explain;
mod manoeuvre;
mod mav_cmd;
mod order;
mod parameter;
mod request;
mod risk;
mod setpoint;
#[cfg(test)]
mod tests;

pub use deed::{Deed, Goal, KindName, Spot, Subject};
pub use effect::Effect;
pub use explain::{AckResult, explain};
pub use manoeuvre::{Datum, FarEnd, Ground, Manoeuvre, Pattern, Shape};
pub use mav_cmd::{command_by_name, command_name, command_names};
pub use order::{Act, Order};
pub use request::{Answer, Repeat, Request, is_written_so};
pub use setpoint::{Setpoint, ready_for};

/// A command to one vehicle, by subject. Every variant is said with one verb of the grammar.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Motors on and off.
    Arming(ArmingCommand),
    /// What begins, ends and interrupts a flight.
    Flight(FlightCommand),
    /// Where and how a vehicle flies, what it looks at, and where its home is.
    Motion(MotionCommand),
    /// Outputs, and the autopilot as a device.
    Device(DeviceCommand),
    /// What a vehicle is to say.
    Query(QueryCommand),
    /// Parameters.
    Parameter(ParameterCommand),
    /// Bare MAVLink.
    Raw(RawCommand),
}

/// Motors on and off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArmingCommand {
    /// Arm the motors.
    Arm,
    /// Disarm on the ground.
    Disarm,
    /// Stop the motors at once, in flight too (disarm with the magic number 21196).
    Kill,
}

/// What begins, ends and interrupts a flight.
#[derive(Debug, Clone, PartialEq)]
pub enum FlightCommand {
    /// Change the flight mode, by name; which number that is depends on the vehicle.
    SetMode {
        /// The mode's name, such as `GUIDED`.
        name: String,
    },
    /// Take off straight up in GUIDED.
    Takeoff {
        /// Height above home to climb to.
        altitude_m: f64,
    },
    /// Land where it is.
    Land,
    /// Return to launch.
    ReturnToLaunch,
    /// Stop and stay (pause in GUIDED and AUTO, BRAKE in other modes).
    Hold,
    /// Go on after a hold.
    Resume,
}

/// Where and how a vehicle flies, what it looks at, and where its home is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MotionCommand {
    /// Fly to a place in GUIDED.
    Goto {
        /// Where to.
        destination: Destination,
        /// What the nose does on the way.
        heading: Heading,
    },
    /// Change height where it is, in GUIDED.
    Altitude {
        /// New height above home.
        altitude_m: f64,
    },
    /// Change the speed of the current mode.
    Speed {
        /// Which speed.
        axis: SpeedAxis,
        /// The new limit in m/s.
        speed_m_s: f64,
    },
    /// Turn the nose.
    Yaw {
        /// Degrees: clockwise from north, or from the present heading where `relative`.
        angle_deg: f64,
        /// Whether the angle counts from the present heading (clockwise positive).
        relative: bool,
        /// How fast to turn in deg/s; `None` leaves it to the autopilot.
        rate_deg_s: Option<f64>,
    },
    /// Fly with a velocity for a time in GUIDED, then stop.
    Velocity {
        /// North, east, down, in m/s.
        ned_m_s: [f64; 3],
        /// For how long.
        lasting: Duration,
    },
    /// Circle around a point in GUIDED-capable autopilots.
    Orbit {
        /// Radius in metres; negative turns counter-clockwise.
        radius_m: f64,
        /// Tangential speed in m/s.
        speed_m_s: f64,
        /// The centre; `None` is where the vehicle is.
        centre: Option<LatLon>,
        /// Height above home; `None` is the present one.
        altitude_m: Option<f64>,
    },
    /// Point the nose and camera at a place; `None` stops that.
    RegionOfInterest {
        /// Where to look and its height above home.
        target: Option<(LatLon, f64)>,
    },
    /// Set home.
    SetHome {
        /// Where and how high above sea level; `None` is where the vehicle is.
        place: Option<(LatLon, f64)>,
    },
}

/// Outputs, and the autopilot as a device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DeviceCommand {
    /// Set a servo output.
    Servo {
        /// Output number, 1 first.
        output: u8,
        /// Pulse width in microseconds.
        pulse_us: u16,
    },
    /// Switch a relay.
    Relay {
        /// Relay number, 0 first.
        relay: u8,
        /// On or off.
        on: bool,
    },
    /// Reboot the autopilot (refused while armed).
    Reboot,
}

/// What a vehicle is to say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum QueryCommand {
    /// Ask for a message at a rate on this link.
    Interval {
        /// MAVLink message id.
        message: u32,
        /// Rate in Hz; 0 switches it off.
        rate_hz: f64,
    },
    /// Ask for a message once.
    Request {
        /// MAVLink message id.
        message: u32,
    },
}

/// Parameters.
#[derive(Debug, Clone, PartialEq)]
pub enum ParameterCommand {
    /// Read a parameter.
    Get {
        /// Its name.
        name: String,
    },
    /// Write a parameter.
    Set {
        /// Its name.
        name: String,
        /// The new value as it was written; `PARAM_SET` carries the nearest `f32`.
        value: f64,
    },
}

/// Bare MAVLink.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RawCommand {
    /// Any `MAV_CMD` as `COMMAND_LONG`.
    Long {
        /// `MAV_CMD` number.
        command: u16,
        /// Parameters 1 to 7.
        params: [f32; 7],
    },
    /// Any `MAV_CMD` as `COMMAND_INT`.
    Int {
        /// `MAV_CMD` number.
        command: u16,
        /// `MAV_FRAME` number.
        frame: u8,
        /// Parameters 1 to 4.
        params: [f32; 4],
        /// Parameter 5: latitude in degrees times 1e7, or as the command says.
        x: i32,
        /// Parameter 6: longitude in degrees times 1e7, or as the command says.
        y: i32,
        /// Parameter 7: height in metres, or as the command says.
        z: f32,
    },
}

/// Where a `goto` leads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Destination {
    /// A point on the earth; `None` keeps the present height.
    Global {
        /// Where.
        at_point: LatLon,
        /// Height above home.
        altitude_m: Option<f64>,
    },
    /// Metres from the EKF origin (`LOCAL_POSITION_NED`); `None` keeps the present height.
    Local {
        /// North of the origin.
        north_m: f64,
        /// East of the origin.
        east_m: f64,
        /// Above the origin.
        up_m: Option<f64>,
    },
    /// Metres from where the vehicle is when the command is sent.
    Offset {
        /// To the north.
        north_m: f64,
        /// To the east.
        east_m: f64,
        /// Upwards.
        up_m: f64,
    },
}

/// What the nose does during a `goto`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Heading {
    /// As the autopilot is set up (ArduCopter by default faces the way it flies).
    Auto,
    /// Stays as it is.
    Keep,
    /// A fixed heading, degrees clockwise from north.
    Fixed(f64),
}

/// Which speed a speed command changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpeedAxis {
    /// Over ground.
    Ground,
    /// Upwards.
    Climb,
    /// Downwards.
    Descend,
}
