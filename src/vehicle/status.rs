//! Small enumerations of the vehicle model. Wire numbers that this program has no name for keep a
//! variant of their own: a newer autopilot must never become invisible.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::text;
use crate::text::Text;

/// `MAV_STATE`: the autopilot's summary of itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SystemStatus {
    Boot,
    Calibrating,
    /// On the ground, ready to start.
    Standby,
    Active,
    /// A failsafe is active.
    Critical,
    /// Mayday.
    Emergency,
    /// Anything else, by number.
    Other(u8),
}

impl SystemStatus {
    /// From the wire number.
    pub fn from_wire(number: u8) -> Self {
        match number {
            1 => Self::Boot,
            2 => Self::Calibrating,
            3 => Self::Standby,
            4 => Self::Active,
            5 => Self::Critical,
            6 => Self::Emergency,
            other => Self::Other(other),
        }
    }
}

impl fmt::Display for SystemStatus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self {
            Self::Boot => "boot",
            Self::Calibrating => "calibrating",
            Self::Standby => "standby",
            Self::Active => "active",
            Self::Critical => "critical",
            Self::Emergency => "emergency",
            Self::Other(number) => return f.pad(&format!("state {number}")),
        };
        f.pad(name)
    }
}

/// `GPS_FIX_TYPE`, in order of quality.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FixType {
    NoGps,
    /// Receiver without a fix.
    NoFix,
    Fix2d,
    Fix3d,
    Dgps,
    RtkFloat,
    RtkFixed,
    /// Static or PPP fix.
    Other,
}

impl FixType {
    /// From the wire number.
    pub fn from_wire(number: u8) -> Self {
        match number {
            0 => Self::NoGps,
            1 => Self::NoFix,
            2 => Self::Fix2d,
            3 => Self::Fix3d,
            4 => Self::Dgps,
            5 => Self::RtkFloat,
            6 => Self::RtkFixed,
            _ => Self::Other,
        }
    }
}

impl FixType {
    pub fn text(self) -> Text {
        match self {
            Self::NoGps => text!("fix-no-gps"),
            Self::NoFix => text!("fix-none"),
            Self::Fix2d => "2D".into(),
            Self::Fix3d => "3D".into(),
            Self::Dgps => "DGPS".into(),
            Self::RtkFloat => text!("fix-float"),
            Self::RtkFixed => "RTK".into(),
            Self::Other => text!("fix-other"),
        }
    }
}

impl fmt::Display for FixType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.text().fmt(f)
    }
}

/// `MAV_LANDED_STATE`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum LandedState {
    /// Not said.
    #[default]
    Undefined,
    OnGround,
    InAir,
    Takeoff,
    Landing,
}

impl fmt::Display for LandedState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Undefined => "unknown",
            Self::OnGround => "on ground",
            Self::InAir => "in air",
            Self::Takeoff => "taking off",
            Self::Landing => "landing",
        })
    }
}

/// `MAV_SEVERITY`, most serious first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// System is unusable.
    Emergency,
    /// Act at once.
    Alert,
    /// A primary system fails.
    Critical,
    /// A secondary system fails.
    Error,
    /// May become an error.
    Warning,
    /// Unusual.
    Notice,
    Info,
    Debug,
}

impl Severity {
    /// From the wire number; anything beyond the known is `Debug`.
    pub fn from_wire(number: u8) -> Self {
        match number {
            0 => Self::Emergency,
            1 => Self::Alert,
            2 => Self::Critical,
            3 => Self::Error,
            4 => Self::Warning,
            5 => Self::Notice,
            6 => Self::Info,
            _ => Self::Debug,
        }
    }
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Emergency => "emergency",
            Self::Alert => "alert",
            Self::Critical => "critical",
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Notice => "notice",
            Self::Info => "info",
            Self::Debug => "debug",
        })
    }
}

/// `EKF_STATUS_FLAGS`: what the navigation filter can estimate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct EkfFlags(pub u16);

impl EkfFlags {
    /// Position on the earth: needed for GUIDED.
    pub const POSITION_HORIZONTAL_ABSOLUTE: u16 = 0x0010;
    /// GPS and inertial estimates disagree.
    pub const GPS_GLITCHING: u16 = 0x8000;

    /// Whether all of `bits` are set.
    pub fn has(self, bits: u16) -> bool {
        self.0 & bits == bits
    }
}
