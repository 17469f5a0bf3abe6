//! The content of single messages of a vehicle.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavAutopilot, MavSysStatusSensor};

use super::radio_test::TestedRadio;
use super::{BoardId, EkfFlags, FixType, Mode, PlanPause, Severity, SystemStatus, VehicleClass};
use crate::geo::LatLon;
use crate::geo::maths;
use crate::wire::SystemId;

/// HEARTBEAT of the autopilot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heartbeat {
    /// `MAV_TYPE` as sent, known to this program or not.
    pub mav_type: u8,
    /// `MAV_AUTOPILOT` as sent, known to this program or not.
    pub autopilot: u8,
    /// The class by `MAV_TYPE`, whatever the autopilot. Names of modes follow the class of `mode` instead.
    pub class: VehicleClass,
    /// The mode. Its class is that of the vehicle with `ArduPilot`, [`VehicleClass::Px4`] with PX4, and
    /// [`VehicleClass::Other`] with other autopilots, whose modes have no names.
    pub mode: Mode,
    /// Whether the motors are armed.
    pub armed: bool,
    /// The autopilot's own summary of its state.
    pub status: SystemStatus,
    pub at: Duration,
}

impl Heartbeat {
    /// The `MAV_AUTOPILOT` of `ArduPilot`.
    pub const ARDUPILOT: u8 = MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA as u8;

    /// The `MAV_AUTOPILOT` of PX4.
    pub const PX4: u8 = MavAutopilot::MAV_AUTOPILOT_PX4 as u8;

    /// The autopilot's name, if this program knows it.
    pub fn autopilot_name(&self) -> Option<&'static str> {
        match self.autopilot {
            Self::ARDUPILOT => Some("ArduPilot"),
            Self::PX4 => Some("PX4"),
            _ => None,
        }
    }

    /// Whether the autopilot is `ArduPilot`.
    pub fn is_ardupilot(&self) -> bool {
        self.autopilot == Self::ARDUPILOT
    }

    /// Whether the autopilot is PX4, whose mode numbers have the main mode and the sub-mode in the upper two bytes.
    pub fn is_px4(&self) -> bool {
        self.autopilot == Self::PX4
    }
}

/// The attitude of the vehicle (ATTITUDE).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attitude {
    /// Roll in degrees, positive with the right wing down.
    pub roll_deg: f32,
    /// Pitch in degrees, positive with the nose up.
    pub pitch_deg: f32,
    /// Yaw clockwise from north, 0 to 360 degrees.
    pub yaw_deg: f32,
    pub at: Duration,
}

/// The estimated position on the earth (`GLOBAL_POSITION_INT`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GlobalPosition {
    pub at_point: LatLon,
    /// Height above mean sea level, in metres.
    pub altitude_amsl_m: f64,
    /// Height above home, in metres.
    pub altitude_m: f64,
    /// Velocity to the north, in m/s.
    pub north_m_s: f32,
    /// Velocity to the east, in m/s.
    pub east_m_s: f32,
    /// Velocity downwards, in m/s.
    pub down_m_s: f32,
    /// Heading, 0 to 360 degrees.
    pub heading_deg: Option<f32>,
    pub at: Duration,
}

impl GlobalPosition {
    /// Horizontal speed in m/s.
    pub fn ground_speed_m_s(&self) -> f32 {
        maths::hypot_f32(self.north_m_s, self.east_m_s)
    }

    /// Speed along its path, also up and down, in m/s.
    pub fn speed_m_s(&self) -> f32 {
        maths::hypot_f32(self.ground_speed_m_s(), self.down_m_s)
    }
}

/// `LOCAL_POSITION_NED`, relative to the EKF origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalPosition {
    /// North, east, down, in metres.
    pub ned_m: [f32; 3],
    /// North, east, down, in m/s.
    pub velocity_m_s: [f32; 3],
    pub at: Duration,
}

/// A place with a height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    pub at_point: LatLon,
    /// Height above mean sea level, in metres.
    pub altitude_amsl_m: f64,
}

/// The autopilot's target. Parts that the type mask ignores are `None`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    pub at_point: Option<LatLon>,
    /// The target's height above home, in metres.
    pub altitude_m: Option<f64>,
    /// The target velocity north, east, down, in m/s.
    pub velocity_m_s: Option<[f32; 3]>,
    pub at: Duration,
}

/// A jump from one reported position to the next, farther than the vehicle can have flown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PositionJump {
    pub distance_m: f64,
    pub at: Duration,
}

/// The GPS report (`GPS_RAW_INT`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gps {
    pub fix: FixType,
    /// Satellites in use; `None` if unknown.
    pub satellites: Option<u8>,
    /// Horizontal dilution of precision; `None` if unknown.
    pub hdop: Option<f32>,
    pub at: Duration,
}

/// A GPS receiver's own error estimates: `GPS_RAW_INT`'s extension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GpsAccuracy {
    /// Horizontal error, in metres.
    pub horizontal_m: f32,
    /// Vertical error, in metres.
    pub vertical_m: f32,
}

/// Speeds and throttle for a pilot's display (`VFR_HUD`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hud {
    /// Indicated airspeed in m/s.
    pub airspeed_m_s: f32,
    /// Speed over ground in m/s.
    pub ground_speed_m_s: f32,
    /// Climb rate in m/s, up positive.
    pub climb_m_s: f32,
    /// Height above mean sea level, in metres.
    pub altitude_amsl_m: f32,
    /// Throttle, 0 to 100 percent.
    pub throttle_percent: u16,
    /// Heading, 0 to 360 degrees.
    pub heading_deg: f32,
    pub at: Duration,
}

/// `SYS_STATUS`: which subsystems are present, enabled and healthy (`MAV_SYS_STATUS_SENSOR` bits).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Health {
    /// Bits of the fitted sensors.
    pub present: u32,
    /// Bits of the sensors in use.
    pub enabled: u32,
    /// Bits of the working sensors.
    pub healthy: u32,
    /// Processor load, 0 to 100 percent; NaN if unknown.
    pub load_percent: f32,
    pub at: Duration,
}

impl Health {
    /// The bit of the checks before arming.
    pub const PREARM: u32 = MavSysStatusSensor::MAV_SYS_STATUS_PREARM_CHECK.bits();

    /// The bit of the fence.
    pub const FENCE: u32 = MavSysStatusSensor::MAV_SYS_STATUS_GEOFENCE.bits();

    /// The bit of the airspeed sensor.
    pub const AIRSPEED: u32 =
        MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_DIFFERENTIAL_PRESSURE.bits();

    /// Whether an airspeed sensor is in use.
    pub fn measures_airspeed(&self) -> bool {
        self.present & self.enabled & Self::AIRSPEED != 0
    }

    /// Whether the fence is on; `None` without a fence. One that only reports breaches (`FENCE_ACTION` 0) is shown as
    /// off.
    pub fn fence_on(&self) -> Option<bool> {
        let is_present = self.present & Self::FENCE != 0;
        is_present.then_some(self.enabled & Self::FENCE != 0)
    }

    /// Whether all checks before arming pass, in the current mode only.
    pub fn prearm_ok(&self) -> bool {
        self.healthy & Self::PREARM != 0
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Battery {
    /// The pack's id, 0 first.
    pub id: u8,
    pub voltage_v: Option<f32>,
    /// Amperes drawn; `None` if unknown or negative.
    pub current_a: Option<f32>,
    /// Charge used since power-up, in mAh.
    pub consumed_mah: Option<f32>,
    /// Energy used since power-up, in Wh.
    pub consumed_wh: Option<f32>,
    /// Charge left, 0 to 100 percent.
    pub remaining_percent: Option<u8>,
    pub at: Duration,
}

/// `EKF_STATUS_REPORT`. An unknown ratio is NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ekf {
    /// The valid estimates of the filter.
    pub flags: EkfFlags,
    /// Test ratio of the velocity innovations; 1 is the limit.
    pub velocity_variance: f32,
    /// Test ratio of the horizontal position innovations.
    pub position_horizontal_variance: f32,
    /// Test ratio of the vertical position innovations.
    pub position_vertical_variance: f32,
    /// Test ratio of the compass innovations.
    pub compass_variance: f32,
    pub at: Duration,
}

impl Ekf {
    /// The worst test ratio; 1 is the limit.
    pub fn worst(&self) -> f32 {
        let ratios = [
            self.velocity_variance,
            self.position_horizontal_variance,
            self.position_vertical_variance,
            self.compass_variance,
        ];
        ratios.into_iter().fold(0.0, f32::max)
    }
}

/// The vibration of the sensors (VIBRATION).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vibration {
    /// Vibration along x, y, z, in m/s2; below 30 is good, above 60 is bad (ArduPilot's documentation). NaN
    /// if a sensor does not work.
    pub level_m_s2: [f32; 3],
    /// How many times each accelerometer clipped.
    pub clipping: Option<[u32; 3]>,
}

/// Progress through the plan on board.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlanProgress {
    /// The item being flown; 0 is home.
    pub current: u16,
    /// Items after home; `None` if unknown.
    pub total: Option<u16>,
    /// The last item that was reported as reached.
    pub reached: Option<u16>,
    /// The phase of the plan in AUTO; `None` if the vehicle does not report it.
    pub phase: Option<PlanPhase>,
    /// The current pause in the plan; `None` if the vehicle flies on or has left its plan. It may outlast
    /// [`PlanPhase::Paused`], as [`PlanPause`] explains.
    pub pause: Option<PlanPause>,
    /// When the current item became current, by the vehicle's clock.
    pub since: Option<Duration>,
    /// When the vehicle arrived at the place where it stays for the current item, by its clock.
    pub arrived: Option<Duration>,
    /// When this program last set the item at which the vehicle continues.
    pub asked: Option<Duration>,
}

/// The phase of a plan in AUTO (`MISSION_STATE`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanPhase {
    /// No plan is on board.
    NoPlan,
    /// The plan has not begun, or another mode has interrupted it.
    NotStarted,
    Active,
    /// The vehicle has stopped on the way.
    Paused,
    /// The end of the plan has been reached.
    Complete,
}

/// The state of the fence (`FENCE_STATUS`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fence {
    /// Whether the vehicle is in breach of the fence.
    pub breached: bool,
    /// The number of breaches so far.
    pub breaches: u16,
    /// The kind of the last breach (`FENCE_BREACH`).
    pub breach_type: u8,
}

/// The mean wind: as the vehicle estimates it (WIND), or as it is known from elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wind {
    /// The direction that the wind comes from, in degrees clockwise from north.
    pub from_deg: f32,
    /// Horizontal speed in m/s.
    pub speed_m_s: f32,
}

/// The output of the radio receiver (`RC_CHANNELS`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RcChannels {
    /// Pulse widths in microseconds, channel 1 first; 0 for unused channels.
    pub channels_us: [u16; 18],
    /// Signal strength, 0 to 254; `None` if unknown.
    pub rssi: Option<u8>,
}

/// The autopilot's version (`AUTOPILOT_VERSION`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AutopilotVersion {
    /// Major and minor version, and the patch.
    pub firmware: (u8, u8, u8),
    /// The vehicle's capabilities, as bits of `MAV_PROTOCOL_CAPABILITY`.
    pub capabilities: u64,
    /// The board's unique id, if it has one; it distinguishes two vehicles with the same system id.
    pub board: Option<BoardId>,
    /// The first eight bytes of the firmware's hash, as text.
    pub hash: [u8; 8],
}

/// The quality of reception from a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LinkQuality {
    /// The time of the last message.
    pub last_heard: Option<Duration>,
    /// Whether the vehicle has been silent for `session::LOST_AFTER` or longer.
    pub lost: bool,
    /// The number of frames received from the vehicle.
    pub received: u64,
    /// The number of frames missing, from the gaps in its sequence numbers.
    pub missing: u64,
    /// The round-trip time, measured with TIMESYNC.
    pub round_trip: Option<Duration>,
    /// The number of reboots observed.
    pub reboots: u32,
    /// The system id under which the vehicle is heard since it was given another one and rebooted.
    pub renumbered: Option<SystemId>,
    /// The number of the link on which it is heard.
    pub via: Option<u16>,
    /// When it was last heard from another sender than before, which may be another vehicle with its system id.
    pub moved_at: Option<Duration>,
    /// The test of the vehicle's radio, if a test is on.
    pub radio: Option<TestedRadio>,
}

impl LinkQuality {
    /// Received frames as a share of all that were sent, 0 to 100 percent.
    pub fn percent(&self) -> u8 {
        match self.received + self.missing {
            0 => 0,
            sent => (self.received * 100 / sent) as u8,
        }
    }
}

/// A STATUSTEXT, with its chunks joined and without control characters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StatusText {
    pub severity: Severity,
    pub text: String,
    pub at: Duration,
}

/// The prefixes of a reason not to arm: of `ArduPilot` from its periodic check, or from a refused arm command; of PX4
/// from its checks, or from a refused arm command.
const REASON_PREFIXES: [&str; 4] = ["PreArm:", "Arm:", "Preflight Fail:", "Arming denied:"];

impl StatusText {
    /// The reason not to arm that a text gives.
    pub fn reason_not_to_arm(text: &str) -> Option<&str> {
        let mut prefixes = REASON_PREFIXES.iter();
        let reason = prefixes.find_map(|prefix| text.strip_prefix(prefix));
        reason.map(str::trim_start)
    }
}

/// The position of a vehicle out of radio contact: the mission needs it for jamming and radio
/// shadows, but the operator does not see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unheard {
    pub at: LatLon,
    /// Height above home, in metres.
    pub altitude_m: f64,
    /// Milliseconds since the autopilot booted, at that message.
    pub boot_ms: u32,
}
