//! One vehicle: airframe, autopilot state, and its step.

use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{MavMessage, MavSeverity};

use super::arming::Safety;
use super::battery::Battery;
use super::body::{Body, Demand};
use super::control::{Limits, PositionControl};
use super::failsafe::{self, Failsafe};
use super::mission::Mission;
use super::mode::{self, Mode};
use super::parameters::{Parameters, Tuning};
use super::plan::Plans;
use super::task::{Act, Cockpit, Sticks, Task};
use super::wind::Wind;
use super::yaw::{YawControl, YawDemand};
use super::{STEP, Start, texts};
use crate::geo::LatLon;

/// The position estimate is good from here on.
pub(super) const READY_AFTER: Duration = Duration::from_millis(1200);
/// A vehicle that reboots drops its links this long after the acknowledgement.
const REBOOT_AFTER: Duration = Duration::from_millis(200);
/// The autopilot asks for the time this often.
const TIMESYNC_EVERY_STEPS: u64 = 1000;

/// A place with its altitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub(super) at: LatLon,
    pub(super) altitude_amsl_m: f64,
}

/// Speeds asked by commands; they last until the mode changes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[expect(clippy::struct_field_names, reason = "the unit belongs to each name")]
pub(super) struct Speeds {
    pub(super) ground_m_s: Option<f64>,
    pub(super) up_m_s: Option<f64>,
    pub(super) down_m_s: Option<f64>,
}

/// What a transmitter, or a ground station in its place, last said.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Radio {
    pub(super) sticks: Sticks,
    pub(super) until: Duration,
}

/// One vehicle.
#[derive(Debug, Clone)]
pub(super) struct Autopilot {
    pub(super) system: u8,
    pub(super) start: Start,
    pub(super) parameters: Parameters,
    pub(super) tuning: Tuning,
    pub(super) body: Body,
    pub(super) control: PositionControl,
    pub(super) yaw: YawControl,
    pub(super) mode: Mode,
    pub(super) task: Task,
    /// The task that `DO_PAUSE_CONTINUE` interrupted.
    pub(super) paused: Option<Task>,
    pub(super) speeds: Speeds,
    pub(super) safety: Safety,
    pub(super) failsafe: Failsafe,
    pub(super) battery: Battery,
    pub(super) home: Option<Place>,
    pub(super) plans: Plans,
    pub(super) mission: Mission,
    pub(super) radio: Radio,
    pub(super) servos_us: [u16; 16],
    pub(super) wind: Wind,
    pub(super) board_id: u64,
    /// Messages for every link, in order.
    pub(super) outbox: Vec<MavMessage>,
    steps: u64,
    reboot_at: Option<Duration>,
}

impl Autopilot {
    /// A vehicle that has just been switched on.
    pub(super) fn new(system: u8, start: Start, mut wind: Wind) -> Self {
        let board_id = wind.board_id();
        Self::booted(system, start, Parameters::new(system), (wind, board_id))
    }

    fn booted(system: u8, start: Start, parameters: Parameters, own: (Wind, u64)) -> Self {
        let body = Body::resting(start.heading_deg);
        Self {
            system,
            start,
            tuning: Tuning::read(&parameters),
            parameters,
            control: PositionControl::at(&body),
            yaw: YawControl::holding(start.heading_deg),
            body,
            mode: Mode::BOOT,
            task: Task::Manual,
            paused: None,
            speeds: Speeds::default(),
            safety: Safety::default(),
            failsafe: Failsafe::default(),
            battery: Battery::default(),
            home: None,
            plans: Plans::default(),
            mission: Mission::default(),
            radio: Radio {
                sticks: Sticks::RELEASED,
                until: Duration::ZERO,
            },
            servos_us: [0; 16],
            wind: own.0,
            board_id: own.1,
            outbox: Vec::new(),
            steps: 0,
            reboot_at: None,
        }
    }

    /// Time since boot.
    pub(super) fn uptime(&self) -> Duration {
        // Multiplying keeps this exact; a vehicle would have to fly for a year to overflow.
        STEP * u32::try_from(self.steps).unwrap_or(u32::MAX)
    }

    /// Whether the position estimate is good.
    pub(super) fn is_ready(&self) -> bool {
        self.uptime() >= READY_AFTER
    }

    /// Says something to every ground station.
    pub(super) fn say(&mut self, severity: MavSeverity, text: &str) {
        texts::say(&mut self.outbox, severity, text);
    }

    /// Asks for a reboot; [`Autopilot::take_reboot`] performs it when it is due.
    pub(super) fn schedule_reboot(&mut self) {
        self.reboot_at.get_or_insert(self.uptime() + REBOOT_AFTER);
    }

    /// Performs a reboot that is due. Parameters survive, and the place where the vehicle stands.
    pub(super) fn take_reboot(&mut self) -> bool {
        if self.reboot_at.is_none_or(|at| self.uptime() < at) {
            return false;
        }
        let here = self.here();
        let start = Start {
            at: here.at,
            altitude_amsl_m: here.altitude_amsl_m,
            heading_deg: self.body.yaw_deg,
        };
        let system = self.parameters.value("SYSID_THISMAV").clamp(1.0, 255.0) as u8;
        let own = (self.wind.clone(), self.board_id);
        let plans = std::mem::take(&mut self.plans);
        *self = Self::booted(system, start, self.parameters.clone(), own);
        self.plans = plans;
        true
    }

    /// Moves on by one step.
    pub(super) fn step(&mut self) {
        self.steps += 1;
        self.boot();
        if self.mode.number == mode::AUTO {
            self.fly_mission();
        }
        let asleep = self.body.on_ground && !self.safety.armed;
        if !asleep {
            self.fly();
        }
        self.battery
            .step(self.body.throttle, self.tuning.battery_voltage_v);
        self.watch_ground();
        if self.steps.is_multiple_of(failsafe::EVERY_STEPS) {
            self.watch_failsafes();
        }
        if self.steps.is_multiple_of(TIMESYNC_EVERY_STEPS) {
            self.ask_time();
        }
    }

    /// Where the vehicle is.
    pub(super) fn here(&self) -> Place {
        self.place_of(self.body.position_m)
    }

    /// The place of a point in metres north, east and down from the start.
    pub(super) fn place_of(&self, point_m: DVec3) -> Place {
        Place {
            at: self.start.at.moved(point_m.x, point_m.y),
            altitude_amsl_m: self.start.altitude_amsl_m - point_m.z,
        }
    }

    /// The point of a place in metres north, east and down from the start.
    pub(super) fn point_of(&self, place: Place) -> DVec3 {
        let (north, east) = self.start.at.offset_to(place.at);
        DVec3::new(
            north,
            east,
            self.start.altitude_amsl_m - place.altitude_amsl_m,
        )
    }

    /// Home as a point; the start until home is set.
    pub(super) fn home_point(&self) -> DVec3 {
        self.home.map_or(DVec3::ZERO, |home| self.point_of(home))
    }

    /// The sticks as they are now: released when nobody has moved them lately.
    pub(super) fn sticks(&self) -> Sticks {
        if self.uptime() < self.radio.until {
            self.radio.sticks
        } else {
            Sticks::RELEASED
        }
    }

    /// Reads the parameters again after a change.
    pub(super) fn retune(&mut self) {
        let entered_with = self.tuning.speed_m_s;
        self.tuning = Tuning::read(&self.parameters);
        // The cruise speed is taken over when the mode is entered, not in the middle of a flight.
        if self.safety.armed && self.speeds.ground_m_s.is_none() {
            self.speeds.ground_m_s = Some(entered_with);
        }
    }

    /// Works with the position control and the rest of the state at once.
    pub(super) fn with_cockpit<T>(
        &mut self,
        work: impl FnOnce(&mut Task, &mut Cockpit<'_>) -> T,
    ) -> T {
        let mut cockpit = Cockpit {
            limits: limits(&self.tuning, self.speeds),
            sticks: self.sticks(),
            home_m: self.home_point(),
            now: self.uptime(),
            control: &mut self.control,
            body: &self.body,
            tuning: &self.tuning,
        };
        work(&mut self.task, &mut cockpit)
    }

    fn fly(&mut self) {
        let act = if self.safety.armed {
            self.with_cockpit(super::task::Task::step)
        } else {
            Act::Idle
        };
        let demand = match act {
            Act::Idle => Demand::Off,
            Act::Throttle(throttle) => Demand::Throttle(throttle),
            Act::Fly => {
                let lean_max = self.tuning.lean_max_rad;
                Demand::Acceleration(self.control.demand(&self.body, lean_max))
            }
        };
        self.end_turn();
        let wind = self.wind.step(self.body.height_m(), &self.tuning);
        if demand != Demand::Off || !self.body.on_ground {
            let moving = self.control.velocity_m_s.truncate();
            let here = self.body.position_m.truncate();
            let rate = self
                .yaw
                .step(self.body.yaw_deg, moving, here, self.tuning.slew_yaw_deg_s);
            self.body.turn(rate);
        }
        if let Some(impact_m_s) = self.body.step(demand, wind) {
            let text = format!("SIM Hit ground at {impact_m_s:.3} m/s");
            self.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        }
        if let Task::Takeoff(takeoff) = &self.task {
            if takeoff.is_spooled(self.uptime()) {
                self.safety.landed = false;
            }
            if takeoff.reached {
                let goal_m = takeoff.goal_m;
                self.end_takeoff(goal_m);
            }
        }
    }

    /// A turning rate lasts as long as the setpoint that asked for it.
    fn end_turn(&mut self) {
        let until = match &self.task {
            Task::Velocity { until, .. } | Task::Accelerate { until, .. } => *until,
            _ => return,
        };
        if self.uptime() >= until && matches!(self.yaw.demand, YawDemand::Rate(_)) {
            self.yaw.demand = YawDemand::Hold;
        }
    }

    fn end_takeoff(&mut self, goal_m: DVec3) {
        self.task = match self.mode.number {
            mode::GUIDED => Task::goto(goal_m),
            // The mission goes on by itself.
            mode::AUTO => return,
            _ => Task::Piloted,
        };
    }

    /// What a boot says and when.
    fn boot(&mut self) {
        match self.steps {
            30 => self.say(MavSeverity::MAV_SEVERITY_INFO, "ArduPilot Ready"),
            50 => self.say(MavSeverity::MAV_SEVERITY_INFO, "EKF3 IMU0 initialised"),
            _ => {}
        }
        if self.home.is_none() && self.is_ready() {
            self.say(MavSeverity::MAV_SEVERITY_INFO, "EKF3 IMU0 origin set");
            self.say(MavSeverity::MAV_SEVERITY_INFO, "EKF3 IMU0 is using GPS");
            self.set_home(self.here());
        }
    }

    fn ask_time(&mut self) {
        let ns = self.uptime().as_nanos() as i64;
        self.outbox.push(MavMessage::TIMESYNC(
            mavlink::dialects::ardupilotmega::TIMESYNC_DATA {
                tc1: 0,
                ts1: ns + i64::from(self.system),
                ..Default::default()
            },
        ));
    }

    /// How the nose behaves when a mode or a target leaves it to the autopilot.
    pub(super) fn default_yaw(&self) -> YawDemand {
        if self.tuning.yaw_behaviour == 0 {
            YawDemand::Hold
        } else {
            YawDemand::Course
        }
    }

    /// The same on the way home, where `WP_YAW_BEHAVIOR` 2 keeps the heading.
    pub(super) fn default_yaw_home(&self) -> YawDemand {
        if self.tuning.yaw_behaviour == 2 {
            YawDemand::Hold
        } else {
            self.default_yaw()
        }
    }
}

/// The limits of the flight: parameters, with what commands changed.
fn limits(tuning: &Tuning, speeds: Speeds) -> Limits {
    Limits {
        speed_m_s: speeds.ground_m_s.unwrap_or(tuning.speed_m_s),
        speed_up_m_s: speeds.up_m_s.unwrap_or(tuning.speed_up_m_s),
        speed_down_m_s: speeds.down_m_s.unwrap_or(tuning.speed_down_m_s),
        accel_m_s2: tuning.accel_m_s2,
        accel_z_m_s2: tuning.accel_z_m_s2,
        jerk_m_s3: tuning.jerk_m_s3,
        jerk_z_m_s3: tuning.jerk_z_m_s3,
    }
}
