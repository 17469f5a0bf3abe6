//! One vehicle: what its subsystems remember, and the order in which they work in a step. What a subsystem does stands
//! beside its state, in a module of its own, as methods of [`Autopilot`].

mod fly;

use std::sync::Arc;
use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{MavMessage, MavSeverity};

use super::airframe::{Airframe, air_density};
use super::arming::Safety;
use super::auto_plan::Mission;
use super::battery::Battery;
use super::body::Body;
use super::boot::Boot;
use super::control::{Limits, PositionControl};
use super::counters::Counters;
use super::crash::CrashWatch;
use super::estimator::Estimator;
use super::failsafe::{self, Failsafe};
use super::fence::{self, Geofence};
use super::mode::{self, Mode};
use super::parameters::Parameters;
use super::place::{Datum, Place};
use super::plan::Plans;
use super::radio::{Radio, Sticks};
use super::rally::Rally;
use super::task::{Cockpit, FlightTuning, Pilot, Task};
use super::trail::{self, Trail};
use super::transfer::Transfers;
use super::tuning::Tuning;
use super::wind::Wind;
use super::workbench::Workbench;
use super::yaw::{YawControl, YawDemand};
use super::{STEP, Start, texts};

/// A vehicle that reboots drops its links this long after the acknowledgement.
const REBOOT_AFTER: Duration = Duration::from_millis(200);
/// The autopilot asks for the time this often.
const TIMESYNC_EVERY_STEPS: u64 = 1000;

/// Speeds asked by commands; they last until the mode changes, in GUIDED also only as long as one kind of target.
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
    pub(super) datum: Datum,
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
    /// The way back of `SMART_RTL`.
    pub(super) trail: Trail,
    pub(super) safety: Safety,
    pub(super) failsafe: Failsafe,
    pub(super) crash: CrashWatch,
    pub(super) battery: Battery,
    pub(super) plans: Plans,
    pub(super) mission: Mission,
    pub(super) fence: Geofence,
    pub(super) transfers: Transfers,
    pub(super) radio: Radio,
    /// What the modes with a pilot remember.
    pub(super) pilot: Pilot,
    /// When BRAKE, entered by the pause button, turns into LOITER.
    pub(super) brake_until: Option<Duration>,
    pub(super) workbench: Workbench,
    pub(super) counters: Counters,
    pub(super) servos_us: [u16; 16],
    pub(super) wind: Wind,
    pub(super) board_id: u64,
    pub(super) boot: Boot,
    pub(super) estimator: Estimator,
    /// Where the last takeoff ended, until it is told where to fly.
    pub(super) takeoff_m: Option<DVec3>,
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
            datum: Datum { start, home: None },
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
            trail: Trail::default(),
            safety: Safety::default(),
            failsafe: Failsafe::default(),
            crash: CrashWatch::default(),
            plans: Plans::default(),
            mission: Mission::default(),
            radio: Radio::default(),
            pilot: Pilot::default(),
            brake_until: None,
            workbench: Workbench::default(),
            counters: Counters::default(),
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

    /// Where the vehicle believes to be.
    pub(super) fn here(&self) -> Place {
        self.datum.place_of(self.believed().position_m)
    }

    /// Where the vehicle really is.
    pub(super) fn truly_here(&self) -> Place {
        self.datum.place_of(self.body.position_m)
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
            self.watch_brake();
            self.count();
            self.watch_sticks();
        }
        if self.steps.is_multiple_of(fence::EVERY_STEPS) {
            self.watch_fence();
        }
        if self.steps.is_multiple_of(trail::EVERY_STEPS) {
            self.watch_trail();
        }
        self.record(self.steps);
        if self.steps.is_multiple_of(TIMESYNC_EVERY_STEPS) {
            self.ask_time();
        }
    }

    /// The sticks as they are now: released when nobody has moved them lately.
    pub(super) fn sticks(&self) -> Sticks {
        self.radio.sticks(self.uptime())
    }

    /// Reads the parameters again after a change.
    pub(super) fn retune(&mut self) {
        let entered_with = self.tuning.flight.speed_m_s;
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
            limits: limits(&self.tuning.flight, self.speeds),
            sticks: self.sticks(),
            piloted: self.uptime() < self.radio.until,
            home_m: self.datum.home_point(),
            now: self.uptime(),
            control: &mut self.control,
            body: self.estimator.belief(&self.body),
            has_position: self.estimator.has_position(),
            pilot: &mut self.pilot,
            tuning: &self.tuning.flight,
            fence: &mut self.fence,
            trail: &mut self.trail,
            rally: Rally {
                items: &self.plans.rally,
                start: &self.datum.start,
            },
        };
        work(&mut self.task, &mut cockpit)
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
    for &(name, value) in airframe.parameters() {
        parameters.set(name, value as f32);
    }
    parameters
}

/// The limits of the flight: parameters, with what commands changed.
fn limits(tuning: &FlightTuning, speeds: Speeds) -> Limits {
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
