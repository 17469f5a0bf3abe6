//! Small enumerations of the vehicle model. Unknown wire numbers have their own variant, so a newer
//! autopilot is still shown.

use std::fmt;

use mavlink::dialects::ardupilotmega::{GpsFixType, MavSeverity, MavState};
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
    /// Control is lost over parts of the airframe or all of it.
    Emergency,
    /// Anything else, by number.
    Other(u8),
}

impl SystemStatus {
    /// The variant for a number in a message.
    pub fn from_wire(number: u8) -> Self {
        const NAMED: [(MavState, SystemStatus); 6] = [
            (MavState::MAV_STATE_BOOT, SystemStatus::Boot),
            (MavState::MAV_STATE_CALIBRATING, SystemStatus::Calibrating),
            (MavState::MAV_STATE_STANDBY, SystemStatus::Standby),
            (MavState::MAV_STATE_ACTIVE, SystemStatus::Active),
            (MavState::MAV_STATE_CRITICAL, SystemStatus::Critical),
            (MavState::MAV_STATE_EMERGENCY, SystemStatus::Emergency),
        ];
        let named = NAMED.iter().find(|(wire, _)| *wire as u8 == number);
        named.map_or(Self::Other(number), |(_, status)| *status)
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
    /// The variant for a number in a message.
    pub fn from_wire(number: u8) -> Self {
        const NAMED: [(GpsFixType, FixType); 7] = [
            (GpsFixType::GPS_FIX_TYPE_NO_GPS, FixType::NoGps),
            (GpsFixType::GPS_FIX_TYPE_NO_FIX, FixType::NoFix),
            (GpsFixType::GPS_FIX_TYPE_2D_FIX, FixType::Fix2d),
            (GpsFixType::GPS_FIX_TYPE_3D_FIX, FixType::Fix3d),
            (GpsFixType::GPS_FIX_TYPE_DGPS, FixType::Dgps),
            (GpsFixType::GPS_FIX_TYPE_RTK_FLOAT, FixType::RtkFloat),
            (GpsFixType::GPS_FIX_TYPE_RTK_FIXED, FixType::RtkFixed),
        ];
        let named = NAMED.iter().find(|(wire, _)| *wire as u8 == number);
        named.map_or(Self::Other, |(_, fix)| *fix)
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

/// Whether the vehicle is on the ground, by `MAV_LANDED_STATE`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum LandedState {
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

/// `MAV_SEVERITY`, the most serious one first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The whole system is unusable.
    Emergency,
    /// Immediate action is needed.
    Alert,
    /// A primary system fails.
    Critical,
    /// A secondary system fails.
    Error,
    /// A condition that may become an error.
    Warning,
    /// Unusual, but not a fault.
    Notice,
    Info,
    Debug,
}

impl Severity {
    /// The variant for a number in a message; unknown numbers become `Debug`.
    pub fn from_wire(number: u8) -> Self {
        const NAMED: [(MavSeverity, Severity); 7] = [
            (MavSeverity::MAV_SEVERITY_EMERGENCY, Severity::Emergency),
            (MavSeverity::MAV_SEVERITY_ALERT, Severity::Alert),
            (MavSeverity::MAV_SEVERITY_CRITICAL, Severity::Critical),
            (MavSeverity::MAV_SEVERITY_ERROR, Severity::Error),
            (MavSeverity::MAV_SEVERITY_WARNING, Severity::Warning),
            (MavSeverity::MAV_SEVERITY_NOTICE, Severity::Notice),
            (MavSeverity::MAV_SEVERITY_INFO, Severity::Info),
        ];
        let named = NAMED.iter().find(|(wire, _)| *wire as u8 == number);
        named.map_or(Self::Debug, |(_, severity)| *severity)
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

/// `EKF_STATUS_FLAGS`: the valid estimates of the navigation filter.
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
