//! The steering and speed control of a rover: from a course to the outputs, with the controllers of `ArduRover`
//! (`AR_AttitudeControl`, `AR_PosControl`, `AP_MotorsUGV`).

mod pid;
mod rules;

use glam::DVec2;

use self::pid::Pid;
pub(super) use self::rules::{CircleRules, HelmRules, PIVOT_WITHIN_DEG};
use super::body::Body;
use super::control::FlatMotion;
use super::kind::{Chassis, VehicleKind};
use super::kinematics::{STEP_S, square_root};
use super::wheels::Outputs;
use sortie_geo::maths;
use sortie_geo::wrap_180;

/// Steering commands assume at least this speed, in m/s.
const STEER_SPEED_MIN_M_S: f64 = 1.0;
/// The share of a new velocity error in the filtered one in each step: a filter of 5 Hz.
const VELOCITY_BLEND: f64 = 0.239_057_188_6;
/// A vehicle that has stopped stays stopped for this long, whatever its speed: in steps.
const STAYS_STOPPED_STEPS: u32 = 30;
/// The controllers start afresh after this pause, in steps.
const TIMEOUT_STEPS: u32 = 20;

/// What the current task asks of the helm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Course {
    /// Motors off: the vehicle rolls on.
    Off,
    /// A pilot's sticks, -1 to 1.
    Sticks(Outputs),
    /// Brake until it stands, and then hold it there.
    Stop,
    /// Follow a moving point, no faster than a speed.
    Follow {
        point: FlatMotion,
        fastest_m_s: f64,
        backwards: bool,
    },
    /// Turn on the spot to a heading, in degrees.
    Pivot(f64),
    /// Drive at a speed while turning to a heading, in degrees.
    Heading { heading_deg: f64, speed_m_s: f64 },
    /// Drive at a speed, and turn at a rate in degrees per second.
    Turn { rate_deg_s: f64, speed_m_s: f64 },
}

/// The state of the controllers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Helm {
    pub(super) outputs: Outputs,
    /// The speed that the controller aims at.
    desired_m_s: f64,
    desired_turn_rad_s: f64,
    speed: Pid,
    steering: Pid,
    velocity_error_m_s: DVec2,
    is_limited: HelmLimits,
    /// Steps since each controller was in use.
    speed_idle: u32,
    steering_idle: u32,
    following_idle: u32,
    stopped_idle: u32,
    /// The heading of the last turn on the spot, in degrees; 0 before the first.
    pivot_deg: f64,
}

/// The outputs that are at their limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct HelmLimits {
    steering: bool,
    throttle: bool,
}

impl Default for Helm {
    fn default() -> Self {
        Self {
            outputs: Outputs::default(),
            desired_m_s: 0.0,
            desired_turn_rad_s: 0.0,
            speed: Pid::default(),
            steering: Pid::default(),
            velocity_error_m_s: DVec2::ZERO,
            is_limited: HelmLimits::default(),
            speed_idle: TIMEOUT_STEPS,
            steering_idle: TIMEOUT_STEPS,
            following_idle: TIMEOUT_STEPS,
            stopped_idle: STAYS_STOPPED_STEPS,
            pivot_deg: 0.0,
        }
    }
}

impl Helm {
    /// Whether the vehicle has been brought to a stop.
    pub(super) fn has_stopped(&self) -> bool {
        self.stopped_idle == 0
    }

    /// The heading of the last turn on the spot, in degrees; 0 before the first.
    pub(super) fn last_pivot_deg(&self) -> f64 {
        self.pivot_deg
    }

    /// The pulses of the first and the third output in microseconds: steering and throttle, or the left and the right
    /// motors.
    pub(super) fn pulses_us(&self, kind: VehicleKind) -> [u16; 2] {
        let outputs = self.outputs;
        let shares = match kind.chassis() {
            Some(Chassis::Skid) => [outputs.left(), outputs.right()],
            _ => [outputs.steering, outputs.throttle],
        };
        shares.map(|share| (1500.0 + 500.0 * share) as u16)
    }

    /// The outputs for a course in this step.
    pub(super) fn step(
        &mut self,
        course: Course,
        body: &Body,
        chassis: Chassis,
        rules: &HelmRules,
    ) -> Outputs {
        self.count_idle_steps();
        let motion = DrivenMotion::of(body);
        let asked = self.asked(course, body, &motion, rules);
        self.is_limited = HelmLimits::default();
        let slewed = self.slewed(asked, rules);
        let is_piloted = matches!(course, Course::Sticks(_));
        self.outputs = match chassis {
            Chassis::Skid => self.mixed(slewed),
            Chassis::Ackermann | Chassis::Boat if is_piloted => slewed,
            Chassis::Ackermann | Chassis::Boat => self.scaled(slewed, motion.speed_m_s, rules),
        };
        self.outputs
    }

    fn count_idle_steps(&mut self) {
        for idle in [
            &mut self.speed_idle,
            &mut self.steering_idle,
            &mut self.following_idle,
            &mut self.stopped_idle,
        ] {
            *idle = idle.saturating_add(1);
        }
    }

    fn asked(
        &mut self,
        course: Course,
        body: &Body,
        motion: &DrivenMotion,
        rules: &HelmRules,
    ) -> Outputs {
        let (rate_rad_s, speed_m_s) = match course {
            Course::Off => return Outputs::default(),
            Course::Sticks(sticks) => return sticks,
            Course::Stop => return self.stop(motion, rules),
            Course::Follow {
                point,
                fastest_m_s,
                backwards,
            } => {
                let wanted = wanted_m_s(&point, body, rules).clamp_length_max(fastest_m_s);
                return self.follow(&point, wanted, backwards, motion, rules);
            }
            Course::Pivot(heading_deg) => return self.pivot(heading_deg, motion, rules),
            Course::Heading {
                heading_deg,
                speed_m_s,
            } => (turn_to(heading_deg, 0.0, motion, rules), speed_m_s),
            Course::Turn {
                rate_deg_s,
                speed_m_s,
            } => (rate_deg_s.to_radians(), speed_m_s),
        };
        Outputs {
            steering: self.steer(rate_rad_s, motion, rules),
            throttle: self.drive(speed_m_s, motion, rules),
        }
    }

    /// Follows a moving point (`AR_PosControl::update`).
    fn follow(
        &mut self,
        point: &FlatMotion,
        wanted: DVec2,
        backwards: bool,
        motion: &DrivenMotion,
        rules: &HelmRules,
    ) -> Outputs {
        if self.following_idle > TIMEOUT_STEPS {
            self.velocity_error_m_s = DVec2::ZERO;
        }
        self.following_idle = 0;
        let error = wanted - motion.velocity_m_s;
        self.velocity_error_m_s += (error - self.velocity_error_m_s) * VELOCITY_BLEND;
        let is_stopping = point.velocity_m_s == DVec2::ZERO;
        let mut speed = wanted.dot(motion.heading);
        let mut lateral = 0.0;
        if !is_stopping {
            // A vehicle that cannot turn on the spot must keep rolling to turn.
            let least = wanted.length().min(rules.turning_speed_m_s());
            speed = if backwards {
                speed.min(-least)
            } else {
                speed.max(least)
            };
            let accel = self.velocity_error_m_s * rules.velocity_p + point.accel_m_s2;
            lateral = motion.heading.perp_dot(accel);
        }
        let speed = self.limited_speed(speed, rules);
        let rate = turn_of_lateral(lateral, speed);
        Outputs {
            throttle: self.drive(speed, motion, rules),
            steering: self.steer(rate, motion, rules),
        }
    }

    /// Stops, then turns to a heading.
    fn pivot(&mut self, heading_deg: f64, motion: &DrivenMotion, rules: &HelmRules) -> Outputs {
        self.pivot_deg = heading_deg;
        let rate = if self.limited_speed(0.0, rules) == 0.0 {
            turn_to(heading_deg, rules.pivot_rad_s, motion, rules)
        } else {
            0.0
        };
        Outputs {
            throttle: self.drive(0.0, motion, rules),
            steering: self.steer(rate, motion, rules),
        }
    }

    fn stop(&mut self, motion: &DrivenMotion, rules: &HelmRules) -> Outputs {
        let throttle = self.brake(motion, rules);
        let steering = if self.has_stopped() {
            0.0
        } else {
            self.steer(0.0, motion, rules)
        };
        Outputs { steering, throttle }
    }

    fn drive(&mut self, speed_m_s: f64, motion: &DrivenMotion, rules: &HelmRules) -> f64 {
        let limited = self.limited_speed(speed_m_s, rules);
        if limited == 0.0 {
            self.brake(motion, rules)
        } else {
            self.reach(limited, motion, rules)
        }
    }

    /// The throttle for a stop (`get_throttle_out_stop`).
    fn brake(&mut self, motion: &DrivenMotion, rules: &HelmRules) -> f64 {
        let limited = self.limited_speed(0.0, rules);
        let was_stopped = self.stopped_idle <= STAYS_STOPPED_STEPS;
        let is_slow = motion.speed_m_s.abs() <= rules.stop_speed_m_s;
        if was_stopped || (limited == 0.0 && is_slow) {
            self.stopped_idle = 0;
            self.speed_idle = 0;
            self.speed = Pid::default();
            self.desired_m_s = 0.0;
            return 0.0;
        }
        self.reach(limited, motion, rules)
    }

    /// The throttle for a speed (`get_throttle_out_speed`).
    fn reach(&mut self, speed_m_s: f64, motion: &DrivenMotion, rules: &HelmRules) -> f64 {
        self.stopped_idle = self.stopped_idle.max(STAYS_STOPPED_STEPS + 1);
        if self.speed_idle > TIMEOUT_STEPS {
            self.speed = Pid::default();
            self.desired_m_s = motion.speed_m_s;
        }
        self.speed_idle = 0;
        self.desired_m_s = self.limited_speed(speed_m_s, rules);
        let aim = [self.desired_m_s, motion.speed_m_s];
        let throttle = self.speed.step(aim, self.is_limited.throttle, &rules.speed)
            + self.desired_m_s * rules.throttle_per_m_s;
        if rules.brakes {
            throttle
        } else if self.desired_m_s >= 0.0 {
            throttle.max(0.0)
        } else {
            throttle.min(0.0)
        }
    }

    /// A speed that is reached with limited acceleration.
    fn limited_speed(&self, speed_m_s: f64, rules: &HelmRules) -> f64 {
        if self.speed_idle > TIMEOUT_STEPS || rules.accel_max_m_s2 <= 0.0 {
            return speed_m_s;
        }
        let slows = speed_m_s.abs() < self.desired_m_s.abs() && rules.decel_max_m_s2 > 0.0;
        let most = if slows {
            rules.decel_max_m_s2
        } else {
            rules.accel_max_m_s2
        } * STEP_S;
        speed_m_s.clamp(self.desired_m_s - most, self.desired_m_s + most)
    }

    /// The steering for a turn rate in radians per second (`get_steering_out_rate`).
    fn steer(&mut self, rate_rad_s: f64, motion: &DrivenMotion, rules: &HelmRules) -> f64 {
        if self.steering_idle > TIMEOUT_STEPS {
            self.steering = Pid::default();
            self.desired_turn_rad_s = motion.turn_rad_s;
        }
        self.steering_idle = 0;
        let mut rate = rate_rad_s;
        if rules.turn_accel_rad_s2 > 0.0 {
            let most = rules.turn_accel_rad_s2 * STEP_S;
            rate = rate.clamp(
                self.desired_turn_rad_s - most,
                self.desired_turn_rad_s + most,
            );
        }
        if rules.turn_max_rad_s > 0.0 {
            rate = rate.clamp(-rules.turn_max_rad_s, rules.turn_max_rad_s);
        }
        let most = (rules.lateral_m_s2 / motion.speed_m_s.abs().max(STEER_SPEED_MIN_M_S))
            .max(1f64.to_radians());
        self.desired_turn_rad_s = rate.clamp(-most, most);
        let aim = [self.desired_turn_rad_s, motion.turn_rad_s];
        self.steering
            .step(aim, self.is_limited.steering, &rules.steering)
            + self.desired_turn_rad_s * rules.steering_feed_forward
    }

    /// Limits the change of the throttle (`MOT_SLEWRATE`).
    fn slewed(&mut self, asked: Outputs, rules: &HelmRules) -> Outputs {
        let asked_throttle = asked.throttle.clamp(-1.0, 1.0);
        let most = rules.slew_per_s.map_or(f64::INFINITY, |slew| slew * STEP_S);
        let before = self.outputs.throttle;
        let throttle = asked_throttle.clamp(before - most, before + most);
        self.is_limited.throttle =
            (throttle - asked_throttle).abs() > f64::EPSILON || throttle.abs() >= 1.0;
        self.is_limited.steering = asked.steering.abs() >= 1.0;
        Outputs {
            steering: asked.steering.clamp(-1.0, 1.0),
            throttle,
        }
    }

    /// Steered wheels turn less the faster the vehicle is (`MOT_SPD_SCA_BASE`), and the other way when it backs up.
    fn scaled(&mut self, outputs: Outputs, speed_m_s: f64, rules: &HelmRules) -> Outputs {
        let mut steering = outputs.steering;
        if rules.speed_base_m_s > 0.0 && speed_m_s.abs() > rules.speed_base_m_s {
            steering *= rules.speed_base_m_s / speed_m_s.abs();
        } else {
            self.is_limited.steering = true;
        }
        if speed_m_s < 0.0 {
            steering = -steering;
        }
        Outputs {
            steering,
            ..outputs
        }
    }

    /// The motors of both sides together have no more than full throttle.
    fn mixed(&mut self, outputs: Outputs) -> Outputs {
        let sum = outputs.steering.abs() + outputs.throttle.abs();
        if sum <= 1.0 {
            return outputs;
        }
        self.is_limited = HelmLimits {
            steering: true,
            throttle: true,
        };
        Outputs {
            steering: outputs.steering / sum,
            throttle: outputs.throttle / sum,
        }
    }
}

/// The motion of a body along its heading.
#[derive(Debug, Clone, Copy)]
struct DrivenMotion {
    heading_deg: f64,
    heading: DVec2,
    velocity_m_s: DVec2,
    /// The part of the velocity along the heading.
    speed_m_s: f64,
    turn_rad_s: f64,
}

impl DrivenMotion {
    fn of(body: &Body) -> Self {
        let heading = body.heading();
        let velocity_m_s = body.velocity_m_s.truncate();
        Self {
            heading_deg: body.yaw_deg,
            heading,
            velocity_m_s,
            speed_m_s: velocity_m_s.dot(heading),
            turn_rad_s: body.yaw_rate_deg_s.to_radians(),
        }
    }
}

/// The velocity that brings a body onto a moving point.
fn wanted_m_s(point: &FlatMotion, body: &Body, rules: &HelmRules) -> DVec2 {
    let off_m = point.place_m - body.position_m.truncate();
    let back = square_root(off_m.length(), rules.position_p, rules.accel_m_s2);
    point.velocity_m_s + off_m.normalize_or_zero() * back
}

/// The turn rate towards a heading (`get_turn_rate_from_heading`), in radians per second; `most` is 0 for no limit.
fn turn_to(heading_deg: f64, most: f64, motion: &DrivenMotion, rules: &HelmRules) -> f64 {
    let error = wrap_180(heading_deg - motion.heading_deg).to_radians();
    let mut rate = error * rules.heading_p;
    if most > 0.0 {
        rate = rate.clamp(-most, most);
    }
    if rules.turn_accel_rad_s2 > 0.0 {
        let stops = (2.0 * error.abs() * rules.turn_accel_rad_s2).sqrt();
        rate = rate.clamp(-stops, stops);
    }
    rate
}

/// The turn rate for an acceleration to the right at a speed.
fn turn_of_lateral(lateral_m_s2: f64, speed_m_s: f64) -> f64 {
    let least = if speed_m_s < 0.0 {
        speed_m_s.min(-STEER_SPEED_MIN_M_S)
    } else {
        speed_m_s.max(STEER_SPEED_MIN_M_S)
    };
    lateral_m_s2 / least
}

/// The heading from a point to another, in degrees.
pub(super) fn bearing_deg(from_m: DVec2, to_m: DVec2) -> f64 {
    let way = to_m - from_m;
    maths::atan2(way.y, way.x).to_degrees()
}
