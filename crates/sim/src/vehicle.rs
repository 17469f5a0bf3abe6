//! A vehicle that can be flown: its build, its estimated position and its current task. The
//! decisions (commands, plans, failsafes) are made in the autopilot, which contains the vehicle.

mod breadcrumbs;
mod circling;
mod flight;
mod fly;
mod follow;
mod plant;
mod roll;
mod traffic;

use std::sync::Arc;
use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{MavMessage, MavSeverity, PARAM_VALUE_DATA};

pub(super) use self::flight::{AskedSpeeds, FlightState};
pub(super) use self::plant::Plant;
use super::adsb::Adsb;
use super::airframe::Airframe;
use super::arming::Safety;
use super::body::Body;
use super::boot::Boot;
use super::estimator::{Estimator, Odometry};
use super::failsafe::RadioInputs;
use super::fence::{Geofence, severity};
use super::flight_log::{self, FlightLog, LogInputs, LogSample};
use super::kind::VehicleKind;
use super::parameters::{BY_NAME, Parameters};
use super::place::{LocalDatum, Place};
use super::plan::Plans;
use super::radio::{Radio, Sticks};
use super::rally::Rally;
use super::task::{Cockpit, Task};
use super::tuning::Tuning;
use super::wind::Wind;
use super::yaw::YawDemand;
use super::{STEP, Start, texts};

/// The current of a rover at full throttle.
const ROVER_FULL_CURRENT_A: f64 = 50.0;

/// The properties that survive a reboot.
#[derive(Debug, Clone)]
pub(super) struct Build {
    pub(super) kind: VehicleKind,
    pub(super) system: u8,
    pub(super) board_id: u64,
    pub(super) airframe: Arc<Airframe>,
    pub(super) start: Start,
}

#[derive(Debug, Clone)]
pub(super) struct Vehicle {
    pub(super) kind: VehicleKind,
    pub(super) system: u8,
    pub(super) board_id: u64,
    pub(super) parameters: Parameters,
    /// Shared with other vehicles while their parameters are equal.
    pub(super) tuning: Arc<Tuning>,
    pub(super) plant: Plant,
    /// The autopilot's estimate of the plant.
    pub(super) estimator: Estimator,
    /// The small errors of a rover's estimate; `None` for a vehicle that flies.
    pub(super) odometry: Option<Box<Odometry>>,
    pub(super) datum: LocalDatum,
    pub(super) flight: FlightState,
    pub(super) safety: Safety,
    pub(super) fence: Geofence,
    pub(super) plans: Plans,
    pub(super) radio: Radio,
    pub(super) servos_us: [u16; 16],
    pub(super) boot: Boot,
    pub(super) log: FlightLog,
    /// The traffic around the vehicle, if there is any.
    pub(super) adsb: Option<Box<Adsb>>,
    /// The vehicle to follow, once one was heard.
    pub(super) following: Option<Box<follow::Following>>,
    /// Messages for every link, in order.
    pub(super) outbox: Vec<MavMessage>,
    pub(super) steps: u64,
}

impl Vehicle {
    /// A vehicle that has just been switched on.
    pub(super) fn booted(build: Build, parameters: Parameters, wind: Wind) -> Self {
        let tuning = Tuning::read(&parameters);
        let adsb = Adsb::booted(parameters.value("SIM_ADSB_COUNT"), build.board_id);
        let plant = Plant::resting(build.airframe, wind, &build.start, tuning.battery_set_v);
        Self {
            kind: build.kind,
            system: build.system,
            board_id: build.board_id,
            parameters,
            estimator: Estimator::new(build.board_id, build.kind),
            odometry: build.kind.chassis().map(|_| Box::default()),
            datum: LocalDatum::at(build.start),
            flight: FlightState::resting(build.kind, &plant.body),
            tuning: Arc::new(tuning),
            plant,
            safety: Safety::default(),
            fence: Geofence::default(),
            plans: Plans::default(),
            radio: Radio::new(build.kind),
            servos_us: [0; 16],
            boot: Boot::new(build.kind, false),
            log: FlightLog::default(),
            adsb,
            following: None,
            outbox: Vec::new(),
            steps: 0,
        }
    }

    pub(super) fn uptime(&self) -> Duration {
        // Multiplying keeps this exact; a vehicle would have to fly for a year to overflow.
        STEP * u32::try_from(self.steps).unwrap_or(u32::MAX)
    }

    /// Whether the position estimate is good.
    pub(super) fn is_ready(&self) -> bool {
        self.boot.is_over() && self.estimator.has_position()
    }

    /// The autopilot's estimate of the vehicle's motion.
    pub(super) fn believed(&self) -> &Body {
        self.estimator.belief(&self.plant.body)
    }

    /// The place estimated by the autopilot.
    pub(super) fn here(&self) -> Place {
        self.datum.place_of(self.believed().position_m)
    }

    /// The true place of the vehicle.
    pub(super) fn truly_here(&self) -> Place {
        self.datum.place_of(self.plant.body.position_m)
    }

    /// The distance to home in metres, and its direction in degrees.
    pub(super) fn way_home(&self) -> (f64, f64) {
        let way_m = (self.datum.home_point() - self.believed().position_m).truncate();
        let direction_rad = sortie_geo::maths::atan2(way_m.y, way_m.x);
        (way_m.length(), direction_rad.to_degrees())
    }

    /// Sends a text to every ground station.
    pub(super) fn say(&mut self, severity: MavSeverity, text: &str) {
        texts::say(&mut self.outbox, severity, text);
        let now = self.uptime();
        self.log.note(text, now);
    }

    /// Version, board and frame, each as a text.
    pub(super) fn say_banner(&mut self) {
        let board = format!("{:016x}{:016x}", self.board_id, u64::from(self.system));
        let texts = [
            Some(self.kind.version()),
            Some(board.as_str()),
            self.kind.frame_text(),
        ];
        for text in texts.into_iter().flatten() {
            self.say(MavSeverity::MAV_SEVERITY_INFO, text);
        }
    }

    /// Whether the motor interlock is on; `None` without a switch for it.
    pub(super) fn interlock(&self) -> Option<bool> {
        let has_switch = self.tuning.flight.radio.has_interlock();
        has_switch.then_some(self.safety.interlock)
    }

    /// Whether a switch keeps the motors from turning.
    pub(super) fn is_stopped(&self) -> bool {
        self.safety.emergency_stop || self.interlock() == Some(false)
    }

    /// The current sticks: centred unless moved recently.
    pub(super) fn sticks(&self) -> Sticks {
        self.radio.sticks(self.uptime())
    }

    pub(super) fn reception(&self) -> RadioInputs {
        let is_overridden = self.uptime() < self.radio.until;
        let was_heard = self.radio.was_heard;
        RadioInputs::new(
            self.tuning.faults.radio,
            is_overridden,
            was_heard,
            &self.sticks(),
        )
    }

    /// Sets a parameter, and announces it on every link; `false` if it does not exist.
    pub(super) fn store_parameter(&mut self, name: &str, value: f32) -> bool {
        let Some(parameter) = self.parameters.set(name, value) else {
            return false;
        };
        // Without an index, since it was not requested by one.
        let value = PARAM_VALUE_DATA {
            param_index: BY_NAME,
            ..self.parameters.fields_of(&parameter)
        };
        self.outbox.push(MavMessage::PARAM_VALUE(value));
        true
    }

    /// Reads the parameters again after a change.
    pub(super) fn retune(&mut self) {
        let before = self.tuning.flight.speeds_m_s();
        let mut tuning = Tuning::read(&self.parameters);
        tuning.faults.switch_gps(self.flight.gps_off);
        self.tuning = Arc::new(tuning);
        let now = self.tuning.flight.speeds_m_s();
        if self.safety.armed {
            self.flight.speeds_changed(before, now);
        }
    }

    /// Shares the tuning of another vehicle if it is equal: in a swarm that does not fit into the processor's caches,
    /// fetching each vehicle's own copy takes longer than using it.
    pub(super) fn share_tuning(&mut self, other: &Self) {
        if self.tuning == other.tuning {
            self.tuning = Arc::clone(&other.tuning);
        }
    }

    /// Calls `work` with the task and the parts of the vehicle that it uses.
    pub(super) fn with_cockpit<T>(
        &mut self,
        work: impl FnOnce(&mut Task, &mut Cockpit<'_>) -> T,
    ) -> T {
        let mut cockpit = Cockpit {
            limits: self.flight.limits(&self.tuning.flight),
            sticks: self.sticks(),
            stick_heading_deg: self.flight.simple.heading_deg(),
            piloted: self.uptime() < self.radio.until,
            home_m: self.datum.home_point(),
            now: self.uptime(),
            lifts_from: self.safety.lifts_from(),
            control: &mut self.flight.control,
            body: self.estimator.belief(&self.plant.body),
            has_position: self.estimator.has_position(),
            pilot: &mut self.flight.pilot,
            tuning: &self.tuning.flight,
            fence: &mut self.fence,
            trail: &mut self.flight.trail,
            backs_up: self.flight.backs_up,
            leader: self.following.as_deref().and_then(|it| it.leader.as_ref()),
            rally: Rally {
                items: &self.plans.rally,
                start: &self.datum.start,
            },
        };
        work(&mut self.flight.task, &mut cockpit)
    }

    /// The default heading demand of a mode or a target.
    pub(super) fn default_yaw(&self) -> YawDemand {
        if self.tuning.yaw_behaviour == 0 {
            YawDemand::Hold
        } else {
            YawDemand::Course
        }
    }

    /// The default heading demand on the way home, where `WP_YAW_BEHAVIOR` 2 keeps the heading.
    pub(super) fn default_yaw_home(&self) -> YawDemand {
        if self.tuning.yaw_behaviour == 2 {
            YawDemand::Hold
        } else {
            self.default_yaw()
        }
    }

    /// Whether the task lets a vehicle on the ground rest.
    pub(super) fn has_nothing_to_do(&self) -> bool {
        let throttle_is_low = self.sticks().throttle_is_low();
        self.flight.task.is_resting(throttle_is_low)
    }

    /// Stops the motors, even in the air; `false` if they were already stopped.
    pub(super) fn disarm(&mut self) -> bool {
        if !self.safety.armed {
            return false;
        }
        self.safety.disarm();
        self.say(MavSeverity::MAV_SEVERITY_INFO, self.kind.disarmed_text());
        if self.plant.body.on_ground {
            self.safety.landed = true;
            self.plant.body.throttle = 0.0;
            self.flight.wait_on_ground();
        }
        true
    }

    /// Whether a landing has reached the point where the motors are disarmed.
    pub(super) fn landing_is_over(&self) -> bool {
        let touched = self.flight.task.touched_in_landing();
        touched.is_some_and(|touched| self.safety.ends_landing(touched, self.uptime()))
    }

    /// Sets home and announces it.
    pub(super) fn set_home(&mut self, home: Place) {
        self.datum.set_home(home);
        let boot_us = self.uptime().as_micros() as u64;
        self.outbox.extend(self.datum.global_origin(boot_us));
        self.outbox.extend(self.datum.home_position(boot_us));
    }

    /// Reports a home that was set by a command, as a rover does.
    pub(super) fn tell_home(&mut self) {
        if let (VehicleKind::Rover(_), Some(home)) = (self.kind, self.datum.home()) {
            let (lat, lon) = (home.at.lat_deg, home.at.lon_deg);
            let altitude_m = home.altitude_amsl_m;
            let text = format!("Set HOME to {lat:.5} {lon:.4} at {altitude_m:.2}m");
            self.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        }
    }

    /// Sets home to the current place, also for `SMART_RTL`.
    pub(super) fn set_home_here(&mut self) {
        self.set_home(self.here());
        self.begin_trail(true);
    }

    /// Makes the vehicle's place home, at the altitude of the origin: for a position that is found in flight.
    pub(super) fn set_home_in_flight(&mut self) {
        self.set_home(Place {
            altitude_amsl_m: self.datum.start.altitude_amsl_m,
            ..self.here()
        });
    }

    /// Applies the uploaded fence.
    pub(super) fn fence_changed(&mut self) {
        let from = self.datum.start.at;
        if let Err(error) = self.fence.take(&self.plans.fence, from) {
            self.say(severity(error), &error.to_string());
        }
    }

    /// Switches the fence on or off; `false` if there is no fence to switch on.
    pub(super) fn enable_fence(&mut self, on: bool) -> bool {
        if on && !self.fence.can_be_enabled(&self.tuning.flight.fence) {
            return false;
        }
        self.parameters.set("FENCE_ENABLE", f32::from(u8::from(on)));
        self.retune();
        self.fence.enabled(on);
        true
    }

    /// Whether the fence lets the vehicle fly to a point.
    pub(super) fn may_fly_to(&self, point_m: DVec3) -> bool {
        let rules = &self.tuning.flight.fence;
        self.fence.allows(rules, point_m, self.datum.home_point())
    }

    /// The power that the motors draw, in watts.
    pub(super) fn power_w(&self) -> f64 {
        match self.kind {
            VehicleKind::Copter => self.plant.power_w(),
            VehicleKind::Rover(_) => {
                let Plant {
                    body,
                    battery,
                    airframe,
                    ..
                } = &self.plant;
                let speed_m_s = body.velocity_m_s.truncate().dot(body.heading());
                let accel_m_s2 = body.accel_m_s2.truncate().dot(body.heading());
                match airframe.gear() {
                    Some(gear) if self.safety.armed => gear.power_at_w(speed_m_s, accel_m_s2),
                    Some(_) => 0.0,
                    None => body.throttle.abs() * ROVER_FULL_CURRENT_A * battery.voltage_v,
                }
            }
        }
    }

    /// The remaining charge of the battery, in milliampere hours.
    pub(super) fn charge_left_mah(&self) -> f64 {
        self.tuning.battery_capacity_mah - self.plant.battery.consumed_mah
    }

    /// Reports the alignment of the yaw in flight.
    pub(super) fn watch_alignment(&mut self) {
        if !self.safety.awaits_alignment() {
            return;
        }
        let height_m = self.believed().height_m();
        let Some(compass) = self.estimator.compass_in_use() else {
            return;
        };
        if !self.safety.aligns_at(height_m) {
            return;
        }
        for core in 0..2 {
            let text = format!("EKF3 IMU{core} MAG{compass} in-flight yaw alignment complete");
            self.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        }
    }

    /// Writes the log records that are due after a step. A log contains the autopilot's estimate.
    pub(super) fn record(&mut self) {
        if !self.steps.is_multiple_of(flight_log::EVERY_STEPS) {
            return;
        }
        let (rules, now) = (self.tuning.recorder, self.uptime());
        if self
            .log
            .wants_sample(rules, &self.parameters, self.safety.armed, now)
        {
            let ratios = self.estimator.ratios();
            let sample = LogSample::taken(&LogInputs {
                now,
                body: self.believed(),
                datum: &self.datum,
                battery: &self.plant.battery,
                capacity_mah: self.tuning.battery_capacity_mah,
                satellites: self.tuning.faults.gps.satellites,
                ratios: [
                    ratios.velocity,
                    ratios.position,
                    ratios.height,
                    ratios.compass,
                ],
            });
            self.log.add(sample, self.flight.mode.number);
        }
    }
}
