//! One vehicle: airframe, autopilot state, and its step.

use std::sync::Arc;
use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{MavMessage, MavSeverity};

use super::airframe::{Airframe, Conditions, air_density};
use super::arming::Safety;
use super::battery::Battery;
use super::body::{Body, Demand};
use super::boot::Boot;
use super::control::{Limits, PositionControl};
use super::crash::CrashWatch;
use super::estimator::{Estimator, Surroundings};
use super::failsafe::{self, Failsafe};
use super::fence::{self, Geofence};
use super::mission::Mission;
use super::mode::{self, Mode};
use super::parameters::{Parameters, Tuning};
use super::plan::Plans;
use super::radio::Radio;
use super::rally::Rally;
use super::task::{Act, Cockpit, Pilot, Sticks, Task};
use super::transfer::Transfers;
use super::upset::Drive;
use super::wind::Wind;
use super::workbench::Workbench;
use super::yaw::{Turning, YawControl, YawDemand};
use super::{STEP, Start, texts};
use crate::geo::LatLon;

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

/// One vehicle.
#[derive(Debug, Clone)]
pub(super) struct Autopilot {
    pub(super) system: u8,
    pub(super) start: Start,
    pub(super) airframe: Arc<Airframe>,
    /// Density of the air at the start.
    start_density: f64,
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
    pub(super) crash: CrashWatch,
    pub(super) battery: Battery,
    pub(super) home: Option<Place>,
    pub(super) plans: Plans,
    pub(super) mission: Mission,
    pub(super) fence: Geofence,
    pub(super) transfers: Transfers,
    pub(super) radio: Radio,
    /// What the modes with a pilot remember.
    pub(super) pilot: Pilot,
    pub(super) workbench: Workbench,
    pub(super) servos_us: [u16; 16],
    pub(super) wind: Wind,
    pub(super) board_id: u64,
    pub(super) boot: Boot,
    pub(super) estimator: Estimator,
    /// Where the last takeoff ended.
    takeoff_m: Option<DVec3>,
    /// Messages for every link, in order.
    pub(super) outbox: Vec<MavMessage>,
    steps: u64,
    reboot_at: Option<Duration>,
}

impl Autopilot {
    /// A vehicle that has just been switched on.
    pub(super) fn new(system: u8, start: Start, airframe: Arc<Airframe>, mut wind: Wind) -> Self {
        let board_id = wind.board_id();
        let parameters = factory_parameters(system, &airframe);
        Self::booted(system, (start, airframe), parameters, (wind, board_id))
    }

    /// The same vehicle, which takes as long to boot as a real one.
    pub(super) fn booting_realistically(mut self) -> Self {
        self.boot = Boot::new(true);
        self
    }

    fn booted(
        system: u8,
        (start, airframe): (Start, Arc<Airframe>),
        parameters: Parameters,
        own: (Wind, u64),
    ) -> Self {
        let body = Body::resting(start.heading_deg);
        let tuning = Tuning::read(&parameters);
        Self {
            system,
            start,
            start_density: air_density(start.altitude_amsl_m),
            battery: Battery::charged(&airframe, tuning.battery_set_v),
            airframe,
            tuning,
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
            crash: CrashWatch::default(),
            home: None,
            plans: Plans::default(),
            mission: Mission::default(),
            radio: Radio::default(),
            pilot: Pilot::default(),
            workbench: Workbench::default(),
            fence: Geofence::default(),
            transfers: Transfers::default(),
            servos_us: [0; 16],
            wind: own.0,
            board_id: own.1,
            boot: Boot::new(false),
            estimator: Estimator::new(own.1),
            takeoff_m: None,
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
        self.boot.is_over() && self.estimator.has_position()
    }

    /// What the autopilot believes of the vehicle's motion.
    pub(super) fn believed(&self) -> &Body {
        self.estimator.belief(&self.body)
    }

    /// Says something to every ground station.
    pub(super) fn say(&mut self, severity: MavSeverity, text: &str) {
        texts::say(&mut self.outbox, severity, text);
        self.record_text(text);
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
        let here = self.truly_here();
        let start = Start {
            at: here.at,
            altitude_amsl_m: here.altitude_amsl_m,
            heading_deg: self.body.yaw_deg,
        };
        let system = self.parameters.value("SYSID_THISMAV").clamp(1.0, 255.0) as u8;
        let own = (self.wind.clone(), self.board_id);
        let plans = std::mem::take(&mut self.plans);
        let transfers = std::mem::take(&mut self.transfers).rebooted();
        let boot = Boot::new(self.boot.realistic);
        let built = (start, Arc::clone(&self.airframe));
        let parameters = if self.workbench.erased {
            factory_parameters(self.system, &self.airframe)
        } else {
            self.parameters.clone()
        };
        *self = Self::booted(system, built, parameters, own);
        self.boot = boot;
        self.plans = plans;
        self.transfers = transfers;
        self.fence_changed();
        true
    }

    /// Moves on by one step.
    pub(super) fn step(&mut self) {
        self.steps += 1;
        self.step_boot();
        if self.mode.number == mode::AUTO {
            self.fly_mission();
        }
        let asleep = self.body.on_ground && !self.safety.armed;
        if !asleep {
            self.fly();
        }
        let power_w = self.airframe.power_w(self.body.thrust_m_s2);
        self.estimate();
        self.battery
            .step(power_w, self.tuning.battery_set_v, &self.airframe);
        self.watch_crash();
        self.watch_ground();
        self.watch_alignment();
        self.watch_radio();
        self.report_obstacles(self.steps);
        if self.steps.is_multiple_of(failsafe::EVERY_STEPS) {
            self.watch_failsafes();
            self.watch_workbench();
            self.watch_sticks();
        }
        if self.steps.is_multiple_of(fence::EVERY_STEPS) {
            self.watch_fence();
        }
        self.record(self.steps);
        if self.steps.is_multiple_of(TIMESYNC_EVERY_STEPS) {
            self.ask_time();
        }
    }

    /// Where the vehicle believes to be.
    pub(super) fn here(&self) -> Place {
        self.place_of(self.believed().position_m)
    }

    /// Where the vehicle really is.
    pub(super) fn truly_here(&self) -> Place {
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
        self.radio.sticks(self.uptime())
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
            piloted: self.uptime() < self.radio.until,
            home_m: self.home_point(),
            now: self.uptime(),
            control: &mut self.control,
            body: self.estimator.belief(&self.body),
            has_position: self.estimator.has_position(),
            pilot: &mut self.pilot,
            tuning: &self.tuning,
            fence: &mut self.fence,
            rally: Rally {
                items: &self.plans.rally,
                start: &self.start,
            },
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
            Act::Accelerate(wanted) => Demand::Acceleration(wanted),
            Act::Fly => {
                let lean_max = self.tuning.lean_max_rad;
                let body = self.estimator.belief(&self.body);
                Demand::Acceleration(self.control.demand(body, lean_max))
            }
            Act::Level => {
                let down = self.control.demand_level(self.estimator.belief(&self.body));
                Demand::Acceleration(self.estimator.level_error_m_s2().extend(down))
            }
        };
        self.end_turn();
        self.turn_by_stick();
        let conditions = self.conditions();
        if demand != Demand::Off || !self.body.on_ground {
            let moving = self.control.velocity_m_s.truncate();
            let here = self.body.position_m.truncate();
            let turning = Turning {
                fastest_deg_s: self.tuning.slew_yaw_deg_s,
                accel_deg_s2: self.tuning.yaw_accel_deg_s2,
                is_upset: self.body.upset.is_some(),
            };
            let rate = self.yaw.step(self.body.yaw_deg, moving, here, turning);
            self.body.turn(rate);
        }
        let drive = Drive {
            airframe: &self.airframe,
            conditions: &conditions,
            fault: self.tuning.motor_fault,
            wrecked: self.body.wrecked,
        };
        if let Some(impact_m_s) = self.body.step(demand, &drive) {
            self.report_impact(impact_m_s);
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

    /// Air and battery now.
    fn conditions(&mut self) -> Conditions {
        let height_m = self.body.height_m();
        // A tenth of a percent for 10 m, as in the standard atmosphere.
        let thinner = (1.0 - 1e-4 * height_m).clamp(0.1, 1.5);
        Conditions {
            wind_m_s: self.wind.step(height_m, &self.tuning.wind),
            air_density: self.start_density * thinner,
            voltage_share: self.battery.voltage_share(&self.airframe),
        }
    }

    /// Lets the estimator follow what has happened, and the path what it has jumped.
    fn estimate(&mut self) {
        if !self.boot.is_over() || !self.estimator.has_work(&self.tuning.faults) {
            return;
        }
        let around = Surroundings {
            now: STEP * u32::try_from(self.steps).unwrap_or(u32::MAX),
            truth: &self.body,
            faults: &self.tuning.faults,
            latitude_deg: self.start.at.lat_deg,
        };
        if let Some(jump_m) = self.estimator.step(&around, &mut self.outbox) {
            self.control.path_m += jump_m;
            // The height of a takeoff is held where the vehicle is, wherever that is said to be.
            if let (Task::Goto { goal_m, .. }, Some(hold_m)) = (&mut self.task, &mut self.takeoff_m)
                && *goal_m == *hold_m
            {
                *goal_m += jump_m;
                *hold_m = *goal_m;
            }
        }
    }

    /// A turning rate lasts as long as the setpoint that asked for it.
    fn end_turn(&mut self) {
        let until = match &self.task {
            Task::Velocity { until, .. } | Task::Accelerate { until, .. } => *until,
            Task::Attitude(attitude) => attitude.until,
            _ => return,
        };
        if self.uptime() >= until && matches!(self.yaw.demand, YawDemand::Rate(_)) {
            self.yaw.demand = YawDemand::Hold;
        }
    }

    /// A yaw stick that is over turns the nose, also where the autopilot flies.
    fn turn_by_stick(&mut self) {
        let steered = matches!(self.task, Task::Piloted | Task::Manual);
        let overridden = self.uptime() < self.radio.until;
        if !self.safety.armed || !(steered || overridden) || self.mode.number == mode::BRAKE {
            return;
        }
        let pilot = self.pilot.clone();
        let rate = self.with_cockpit(|_, cockpit| pilot.turn_deg_s(cockpit));
        let turning = matches!(self.yaw.demand, YawDemand::Stick(_));
        if rate != 0.0 || turning {
            self.yaw.demand = YawDemand::Stick(rate);
        }
    }

    fn end_takeoff(&mut self, goal_m: DVec3) {
        self.takeoff_m = Some(goal_m);
        self.task = match self.mode.number {
            mode::GUIDED => Task::goto(goal_m),
            // The mission goes on by itself.
            mode::AUTO => return,
            _ => Task::Piloted,
        };
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

    /// The pulse that a motor gets, in microseconds: the least while the motors stand still.
    pub(super) fn motor_pulse_us(&self, motor: usize) -> u16 {
        if self.body.throttle <= 0.0 {
            return 1000;
        }
        let share = self.body.motor_share(motor, &self.airframe);
        self.airframe.pulse_us(share) as u16
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

/// The parameters of a vehicle that was never flown: the defaults, with its own system id and what its airframe sets.
pub(super) fn factory_parameters(system: u8, airframe: &Airframe) -> Parameters {
    let mut parameters = Parameters::new(system);
    let capacity_ah = airframe.battery_capacity_ah() as f32;
    parameters.set("FRAME_CLASS", airframe.frame_class());
    parameters.set("SIM_BATT_VOLTAGE", airframe.full_voltage_v() as f32);
    parameters.set("SIM_BATT_CAP_AH", capacity_ah);
    if capacity_ah > 0.0 {
        parameters.set("BATT_CAPACITY", capacity_ah * 1000.0);
    }
    parameters
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
