//! The model of one vehicle: its latest telemetry.
//!
//! A plain value, cheap to clone: the task that owns a vehicle changes it in place, all other code reads snapshots.
//! `None` means that the vehicle has not reported the value (yet). Times are durations since the start of the program's
//! clock, the same clock that every `now` argument of the pure modules reads.
//!
//! # How the parts fit
//! - What it reports: `readings`, `status`, `traffic`, `control` (the station it obeys), `mode`, `px4_modes`,
//!   `announced` (its own modes); `plan` (its lists), `radio_test`, `held_channels`.
//! - Whether a reading is good, poor or bad: `limits`. Whether its fence is on: `fence_switch`; by which rules its
//!   plans are checked: `check_rules`. Why it disarmed by itself: `idle_disarm`.
//! - Where it is in its plan: `leg` and `pause`; how long the rest takes: `route`. What the way home costs:
//!   `way_home`.
//! - Which vehicles carry the same list: `carried`. Which speeds were commanded: `speeds`.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use crate::alert::crash;
use crate::geo::maths;
use crate::text::Text;
use crate::wire::{ComponentId, GROUND_STATION_SYSTEM, MavAddress, SystemId};

mod announced;
mod arrival;
mod carried;
mod check_rules;
mod control;
mod fence_switch;
mod held_channels;
mod idle_disarm;
mod kind;
mod leg;
mod limits;
mod mode;
mod pause;
mod plan;
mod px4_modes;
mod radio_test;
mod readings;
mod route;
mod speeds;
mod status;
mod traffic;
mod way_home;

pub use crate::vehicle_id::VehicleId;
pub use crate::wire::BoardId;
pub use announced::{AnnouncedMode, AnnouncedModes};
pub use arrival::ArrivalRadii;
pub use carried::CarriedLists;
pub use check_rules::check_rules;
pub use control::ControlStatus;
pub use fence_switch::FenceSwitch;
pub use held_channels::HeldChannels;
pub use idle_disarm::IdleDisarm;
pub use leg::{LegSpeed, PlanLeg};
pub use limits::{EKF_BAD, Grade, VIBRATION_BAD_M_S2};
pub use mode::{Mode, VehicleClass, is_same_name};
pub use pause::{PauseChange, PlanPause};
pub use plan::{
    FenceArea, FencePlan, FenceShape, Plan, Plans, RallyPlan, RallyPoint, Stored, Transfer,
};
pub use radio_test::{RadioPreset, RadioTest, RadioTraffic, TestedRadio};
pub use readings::{
    Attitude, AutopilotVersion, Battery, Ekf, Fence, GlobalPosition, Gps, GpsAccuracy, Health,
    Heartbeat, Hud, LinkQuality, LocalPosition, Place, PlanPhase, PlanProgress, PositionJump,
    RcChannels, StatusText, Target, Unheard, Vibration, Wind,
};
pub use speeds::{AskedSpeeds, SpeedAxis};
pub use status::{EkfFlags, FixType, LandedState, Severity, SystemStatus};
pub use traffic::{Aircraft, Approach, PredictedPass, Traffic, TrafficThreat};
pub use way_home::{HomeReach, MeanCurrent, USUAL_RESERVE_PERCENT, WayHome};

/// The distance, in metres, beyond which a home is not the home of this flight.
const FARTHEST_HOME_M: f64 = 1_000_000.0;

/// The newest snapshots of vehicles, shared by reference.
pub type Vehicles = BTreeMap<VehicleId, Arc<Vehicle>>;

/// Everything known about one vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct Vehicle {
    pub id: VehicleId,
    /// The vehicle's MAVLink system id: the address of messages to it.
    pub system: SystemId,
    /// The component id of the vehicle's autopilot.
    pub component: ComponentId,
    /// The system id as which this program talks to the vehicle.
    pub station: SystemId,
    /// The ground stations in control; `None` if the vehicle announces none.
    pub control: Option<ControlStatus>,
    /// The channels of the transmitter that this program holds; `None` if it holds none.
    pub held: Option<HeldChannels>,
    /// When another vehicle with the same system id was last heard; `None` if there is none.
    pub twin: Option<Duration>,
    /// Identity and state from HEARTBEAT; `None` before the first one.
    pub heartbeat: Option<Heartbeat>,
    /// The modes that the vehicle has announced.
    pub modes: AnnouncedModes,
    /// The number of the mode that was set last (`CURRENT_MODE`), if the vehicle reports it.
    pub intended_mode: Option<u32>,
    pub attitude: Option<Attitude>,
    pub global: Option<GlobalPosition>,
    /// The last jump of its position that no flight explains.
    pub jump: Option<PositionJump>,
    /// `LOCAL_POSITION_NED`: metres from the EKF origin.
    pub local: Option<LocalPosition>,
    /// Home (`HOME_POSITION`); `None` until it is received.
    pub home: Option<Place>,
    /// `POSITION_TARGET_GLOBAL_INT` or `POSITION_TARGET_LOCAL_NED`: the autopilot's target.
    pub target: Option<Target>,
    pub gps: Option<Gps>,
    /// `GPS_RAW_INT`: the receiver's error estimates, if it has any.
    pub gps_accuracy: Option<GpsAccuracy>,
    pub hud: Option<Hud>,
    /// The sensors that are present, in use and healthy (`SYS_STATUS`).
    pub health: Option<Health>,
    /// `BATTERY_STATUS`, one per pack, in order of the pack's id; pack 0 falls back to `SYS_STATUS`.
    pub batteries: Vec<Battery>,
    /// The mean current of the motors; `None` while they are stopped.
    pub load: Option<MeanCurrent>,
    /// The state of the estimator (`EKF_STATUS_REPORT`).
    pub ekf: Option<Ekf>,
    pub vibration: Option<Vibration>,
    /// Whether the vehicle is on the ground (`EXTENDED_SYS_STATE`).
    pub landed: LandedState,
    /// The progress of AUTO through its plan (`MISSION_CURRENT` and `MISSION_ITEM_REACHED`).
    pub plan: PlanProgress,
    /// How many times each jump of its plan has been taken, by the jump's number, as far as the
    /// vehicle has reported them.
    pub plan_jumps: BTreeMap<u16, u16>,
    /// The mean speed on the legs of the plan; `None` in other modes.
    pub cruise: Option<LegSpeed>,
    /// The plan, the fence and the rally points on board, if they have been read.
    pub plans: Plans,
    /// `FENCE_STATUS`; `None` while no fence is enabled.
    pub fence: Option<Fence>,
    /// RANGEFINDER or `DISTANCE_SENSOR` facing down: metres to the ground.
    pub rangefinder_m: Option<f32>,
    /// WIND: the direction that the wind comes from, and its speed.
    pub wind: Option<Wind>,
    /// The height above home at which the vehicle last estimated the wind in flight, in metres.
    pub wind_height_m: Option<f32>,
    /// `RC_CHANNELS`: pulse widths in microseconds, channel 1 first; 0 where unused.
    pub rc: Option<RcChannels>,
    /// `SERVO_OUTPUT_RAW` of port 0: pulse widths in microseconds, output 1 first.
    pub servos_us: [u16; 16],
    pub version: Option<AutopilotVersion>,
    /// The aircraft that the vehicle's ADS-B receiver reports.
    pub traffic: Traffic,
    /// The speeds that this program has commanded.
    pub asked_speeds: AskedSpeeds,
    /// How near to a place it flies or drives.
    pub arrival: ArrivalRadii,
    /// Milliseconds since the autopilot booted, from its messages; a step back means a reboot.
    pub boot_ms: Option<u32>,
    /// The quality of reception from the vehicle.
    pub link: LinkQuality,
    /// The vehicle's current position while simulated radio keeps its messages from the operator;
    /// never shown to the operator.
    pub unheard: Option<Unheard>,
    /// Why the vehicle has disarmed by itself, if known; `None` once it is armed again.
    pub idle_disarm: Option<IdleDisarm>,
    /// The last reported reasons not to arm, newest last, without the "`PreArm`: " prefix.
    pub prearm: Vec<String>,
    /// The last few status texts, newest last.
    pub texts: Vec<StatusText>,
}

/// The number of status texts that a vehicle keeps.
pub const TEXTS_KEPT: usize = 32;

impl Vehicle {
    /// A vehicle of which only the address is known.
    pub fn new(system: SystemId, component: ComponentId) -> Self {
        Self {
            id: VehicleId::from(system),
            system,
            component,
            station: GROUND_STATION_SYSTEM,
            control: None,
            held: None,
            twin: None,
            heartbeat: None,
            modes: AnnouncedModes::default(),
            intended_mode: None,
            attitude: None,
            global: None,
            jump: None,
            local: None,
            home: None,
            target: None,
            gps: None,
            gps_accuracy: None,
            hud: None,
            health: None,
            batteries: Vec::new(),
            load: None,
            ekf: None,
            vibration: None,
            landed: LandedState::Undefined,
            plan: PlanProgress::default(),
            plan_jumps: BTreeMap::new(),
            cruise: None,
            plans: Plans::default(),
            fence: None,
            rangefinder_m: None,
            wind: None,
            wind_height_m: None,
            rc: None,
            servos_us: [0; 16],
            version: None,
            traffic: Traffic::default(),
            asked_speeds: AskedSpeeds::default(),
            arrival: ArrivalRadii::default(),
            boot_ms: None,
            link: LinkQuality::default(),
            unheard: None,
            idle_disarm: None,
            prearm: Vec::new(),
            texts: Vec::new(),
        }
    }

    /// The address for messages to the vehicle.
    pub fn address(&self) -> MavAddress {
        MavAddress {
            system: self.system,
            component: self.component,
        }
    }

    /// The time since the vehicle's boot, by its own clock; `None` if the vehicle has not reported
    /// it. With a speed-up, this clock runs faster than that of the console.
    pub fn clock(&self) -> Option<Duration> {
        self.boot_ms.map(|it| Duration::from_millis(it.into()))
    }

    /// The vehicle's clock in milliseconds since boot, if known, even while simulated radio hides
    /// it.
    pub fn clock_ms(&self) -> Option<u32> {
        self.unheard.map(|unheard| unheard.boot_ms).or(self.boot_ms)
    }

    /// The flight mode, if known.
    pub fn mode(&self) -> Option<Mode> {
        self.heartbeat.map(|heartbeat| heartbeat.mode)
    }

    /// The number of the last item of the plan; 0 without a plan, `None` if that is unknown.
    pub fn last_item(&self) -> Option<u16> {
        let read = self.plans.plan.content.as_ref();
        let last = read.map(|plan| plan.items.len().saturating_sub(1));
        self.plan
            .total
            .or_else(|| last.and_then(|last| u16::try_from(last).ok()))
    }

    /// Whether the motors are known to be armed.
    pub fn armed(&self) -> bool {
        self.heartbeat.is_some_and(|heartbeat| heartbeat.armed)
    }

    /// Whether the vehicle reports an active failsafe, or that control is lost.
    pub fn in_failsafe(&self) -> bool {
        let status = self.heartbeat.map(|heartbeat| heartbeat.status);
        matches!(
            status,
            Some(SystemStatus::Critical | SystemStatus::Emergency)
        )
    }

    /// Height above home in metres, if known.
    pub fn altitude_m(&self) -> Option<f64> {
        self.global.map(|global| global.altitude_m)
    }

    /// Speed over ground in m/s, if known.
    pub fn ground_speed_m_s(&self) -> Option<f32> {
        self.global
            .map(|global| global.ground_speed_m_s())
            .or_else(|| self.hud.map(|hud| hud.ground_speed_m_s))
    }

    /// Heading, 0 to 360 degrees, if known.
    pub fn heading_deg(&self) -> Option<f32> {
        self.attitude
            .map(|attitude| attitude.yaw_deg)
            .or_else(|| self.global.and_then(|global| global.heading_deg))
            .or_else(|| self.hud.map(|hud| hud.heading_deg))
    }

    /// Horizontal distance to home in metres; `None` if unknown, or too far for the home of this
    /// flight.
    pub fn distance_home_m(&self) -> Option<f64> {
        let (global, home) = (self.global?, self.home?);
        let metres = global.at_point.distance_m(home.at_point);
        (metres < FARTHEST_HOME_M).then_some(metres)
    }

    /// The distance from another vehicle, in metres in three dimensions; `None` unless both report
    /// a position.
    pub fn distance_m(&self, other: &Self) -> Option<f64> {
        let (here, there) = (self.global?, other.global?);
        let across_m = here.at_point.distance_m(there.at_point);
        Some(maths::hypot(
            across_m,
            here.altitude_amsl_m - there.altitude_amsl_m,
        ))
    }

    /// The main pack, which powers the motors, if it is reported.
    pub fn battery(&self) -> Option<&Battery> {
        self.batteries.first()
    }

    /// The name of the autopilot and its version, as far as both are known; empty if neither is.
    pub fn firmware_name(&self) -> String {
        let name = self.heartbeat.and_then(|beat| beat.autopilot_name());
        let version = self.version.map(|version| {
            let (major, minor, patch) = version.firmware;
            format!("{major}.{minor}.{patch}")
        });
        let parts = name.map(str::to_owned).into_iter().chain(version);
        parts.collect::<Vec<_>>().join(" ")
    }

    /// Whether the vehicle is known to run PX4.
    pub fn runs_px4(&self) -> bool {
        self.heartbeat.is_some_and(|heartbeat| heartbeat.is_px4())
    }

    /// The crash since the vehicle was last armed, as its texts report it. While it is armed, texts of an unknown
    /// beginning may be about an earlier flight.
    pub fn crash(&self) -> Option<Text> {
        let arming = |line: &StatusText| line.text.contains("Arming motors");
        let begin = self.texts.iter().rposition(arming);
        if self.armed() && begin.is_none() {
            return None;
        }
        let mut since_armed = self.texts.iter().skip(begin.unwrap_or(0)).rev();
        since_armed.find_map(|line| crash(&line.text))
    }

    /// Whether an arm command should succeed in the current mode: the pre-arm bit is set and the filter has a
    /// position.
    pub fn ready_to_arm(&self) -> bool {
        self.health.is_some_and(|health| health.prearm_ok())
            && self
                .ekf
                .is_some_and(|ekf| ekf.flags.has(EkfFlags::POSITION_HORIZONTAL_ABSOLUTE))
    }
}
