//! The body of a vehicle: a point mass whose lean follows the autopilot's demand with a lag, with the thrust and the
//! drag of its airframe. When motors fail or break, it rotates as a rigid body instead.

use glam::{DVec2, DVec3};

use super::airframe::{Airframe, axes};
use super::kinematics::{GRAVITY_M_S2, STEP_S};
use super::upset::{Drive, Upset, WantedTurn};
use super::wheels::Rolling;
use sortie_geo::maths;

/// Lag of the lean behind its demand (`ArduPilot`'s `ATC_INPUT_TC`), in seconds.
const LEAN_LAG_S: f64 = 0.15;
/// Lag of the vertical acceleration behind its demand, in seconds.
const THRUST_LAG_S: f64 = 0.08;
/// The time constant of the autopilot's compensation for vertical drag, in seconds.
const DRAG_LAG_S: f64 = 0.2;
/// The smallest cosine of the lean for which the throttle is raised; a greater lean raises it no
/// further.
const BOOST_LEAST: f64 = 0.5;
const IDLE_THROTTLE: f64 = 0.01;
/// The rotation rate that a collision causes per metre per second of speed, and its limit, in
/// radians per second.
const SPIN_PER_M_S: f64 = 2.0;
const SPIN_MAX_RAD_S: f64 = 12.0;

/// The autopilot's demand on the airframe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Demand {
    /// Motors stopped or idling.
    Off,
    /// An acceleration (north, east, down) by leaning and by thrust; gravity is not part of it.
    Acceleration(DVec3),
    /// A share of the full throttle, 0 to 1, with a lean, given as the horizontal acceleration that
    /// it causes while the thrust carries the weight: a pilot's sticks in a manual mode.
    Throttle { share: f64, lean_m_s2: DVec2 },
}

/// The air flowing through the rotors, and its effect on the body.
#[derive(Debug, Clone, Copy)]
struct RotorStream {
    drag_down_m_s2: f64,
    /// The downward part of the thrust's direction: -1 if the body is level.
    axis_down: f64,
    /// The speed of the inflow along the rotors' axis, in m/s.
    inflow_m_s: f64,
}

/// Position, motion and attitude: the true state of one vehicle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Body {
    /// Metres north, east and down from the start.
    pub(super) position_m: DVec3,
    pub(super) velocity_m_s: DVec3,
    /// The actual acceleration in the last step, in metres per second squared.
    pub(super) accel_m_s2: DVec3,
    /// The horizontal acceleration that the current lean causes while the thrust carries the
    /// weight.
    pub(super) lean_m_s2: DVec2,
    lift_m_s2: f64,
    known_drag_m_s2: f64,
    /// Thrust of all motors per mass in the last step, in m/s².
    pub(super) thrust_m_s2: f64,
    /// Whether the motors could not provide the demanded thrust.
    pub(super) saturated: bool,
    /// The heading in degrees clockwise from north, unwrapped.
    pub(super) yaw_deg: f64,
    pub(super) yaw_rate_deg_s: f64,
    /// The heading as a unit vector, north and east.
    heading: DVec2,
    pub(super) on_ground: bool,
    /// The mean throttle of all motors, 0 to 1.
    pub(super) throttle: f64,
    angles_rad: (f64, f64),
    /// Roll and pitch rates, radians per second.
    pub(super) angle_rates_rad_s: (f64, f64),
    /// Whether a collision has broken the propellers; only a reboot repairs them.
    pub(super) wrecked: bool,
    /// The rotation of a vehicle that is out of control; `None` in normal flight.
    pub(super) upset: Option<Box<Upset>>,
}

impl Body {
    /// A body at rest on the ground.
    pub(super) fn resting(yaw_deg: f64) -> Self {
        Self {
            position_m: DVec3::ZERO,
            velocity_m_s: DVec3::ZERO,
            accel_m_s2: DVec3::ZERO,
            lean_m_s2: DVec2::ZERO,
            lift_m_s2: 0.0,
            known_drag_m_s2: 0.0,
            thrust_m_s2: 0.0,
            saturated: false,
            yaw_deg,
            yaw_rate_deg_s: 0.0,
            heading: DVec2::from_angle(yaw_deg.to_radians()),
            on_ground: true,
            throttle: 0.0,
            angles_rad: (0.0, 0.0),
            angle_rates_rad_s: (0.0, 0.0),
            wrecked: false,
            upset: None,
        }
    }

    /// Height above the start, in metres.
    pub(super) fn height_m(&self) -> f64 {
        -self.position_m.z
    }

    /// The heading as a unit vector, north and east.
    pub(super) fn heading(&self) -> DVec2 {
        self.heading
    }

    /// Rolls along the heading for one step, as a rover on the ground or a boat.
    pub(super) fn roll(&mut self, rolling: Rolling, throttle: f64) {
        let before = self.velocity_m_s;
        let speed_m_s = before.truncate().dot(self.heading) + rolling.accel_m_s2 * STEP_S;
        self.turn(rolling.turn_deg_s);
        self.throttle = throttle;
        self.velocity_m_s = (self.heading * speed_m_s).extend(0.0);
        self.accel_m_s2 = (self.velocity_m_s - before) / STEP_S;
        self.position_m += self.velocity_m_s * STEP_S;
    }

    /// Stands still, with the motors off.
    pub(super) fn park(&mut self) {
        self.rest();
        self.yaw_rate_deg_s = 0.0;
    }

    /// Roll and pitch in radians.
    pub(super) fn roll_pitch_rad(&self) -> (f64, f64) {
        self.angles_rad
    }

    /// Advances by one step. Returns the speed of a touchdown in this step, if any, in m/s.
    pub(super) fn step(&mut self, demand: Demand, drive: &Drive<'_>) -> Option<f64> {
        if self.on_ground && demand == Demand::Off {
            self.rest();
            return None;
        }
        if self.upset.is_none() && (self.wrecked || drive.fault.is_some()) {
            self.start_tumbling();
        }
        let through_air = self.velocity_m_s - drive.conditions.wind_m_s;
        let accel = if let Some(mut upset) = self.upset.take() {
            let accel = self.tumble(&mut upset, demand, through_air, drive);
            let healthy = !self.wrecked && drive.fault.is_none() && upset.is_calm();
            self.note_attitude(&upset);
            if healthy {
                self.recover(upset.axes());
            } else {
                self.upset = Some(upset);
            }
            accel
        } else {
            let accel = self.fly(demand, through_air, drive);
            self.note_angles();
            accel
        };
        // The ground supports a standing vehicle.
        let carried = self.position_m.z >= 0.0;
        let down = if carried { accel.z.min(0.0) } else { accel.z };
        self.accel_m_s2 = accel.truncate().extend(down);
        self.velocity_m_s += self.accel_m_s2 * STEP_S;
        self.position_m += self.velocity_m_s * STEP_S;
        self.touch_ground()
    }

    /// Turns towards the demanded rate `rate_deg_s`.
    pub(super) fn turn(&mut self, rate_deg_s: f64) {
        self.yaw_rate_deg_s = rate_deg_s;
        if self.upset.is_some() || rate_deg_s == 0.0 {
            return;
        }
        let turned_deg = self.yaw_deg + rate_deg_s * STEP_S;
        // A decaying turn ends once it no longer changes the heading.
        if turned_deg.to_bits() == self.yaw_deg.to_bits() {
            return;
        }
        self.yaw_deg = turned_deg;
        if self.yaw_deg.abs() > 720.0 {
            self.yaw_deg = self.yaw_deg.rem_euclid(360.0);
        }
        self.heading = DVec2::from_angle(self.yaw_deg.to_radians());
    }

    /// Turns by an angle at once.
    pub(super) fn turn_by(&mut self, right_deg: f64) {
        self.yaw_deg += right_deg;
        self.heading = DVec2::from_angle(self.yaw_deg.to_radians());
    }

    /// Applies a collision: the velocity changes, the propellers break, and the vehicle tumbles.
    pub(super) fn hit(&mut self, change_m_s: DVec3) {
        self.velocity_m_s += change_m_s;
        self.wrecked = true;
        if self.upset.is_none() {
            self.start_tumbling();
        }
        let [forward, right, up] = self.axes();
        let push = up.cross(change_m_s) * SPIN_PER_M_S;
        let spin = DVec3::new(push.dot(forward), push.dot(right), 0.0);
        if let Some(upset) = &mut self.upset {
            upset.rates_rad_s += spin.clamp_length_max(SPIN_MAX_RAD_S);
        }
    }

    /// The angle between the demanded and the actual thrust, radians; zero in normal flight.
    pub(super) fn lean_error_rad(&self) -> f64 {
        self.upset.as_ref().map_or(0.0, |upset| upset.error_rad)
    }

    /// A motor's demand, as a share of its thrust range.
    pub(super) fn motor_share(&self, motor: usize, airframe: &Airframe) -> f64 {
        match &self.upset {
            Some(upset) => upset.mixer.shares.get(motor).copied().unwrap_or(0.0),
            None => self.thrust_m_s2 / GRAVITY_M_S2 * airframe.hover_share(),
        }
    }

    fn rest(&mut self) {
        self.accel_m_s2 = DVec3::ZERO;
        self.velocity_m_s = DVec3::ZERO;
        self.lean_m_s2 = DVec2::ZERO;
        self.lift_m_s2 = 0.0;
        self.known_drag_m_s2 = 0.0;
        self.thrust_m_s2 = 0.0;
        self.saturated = false;
        self.throttle = 0.0;
        self.angle_rates_rad_s = (0.0, 0.0);
        if let Some(upset) = self.upset.as_mut().filter(|_| self.wrecked) {
            upset.lie();
        } else {
            self.upset = None;
            self.angles_rad = (0.0, 0.0);
        }
    }

    /// The body's axes: forward, right and up.
    fn axes(&self) -> [DVec3; 3] {
        if let Some(upset) = &self.upset {
            return upset.axes();
        }
        axes(self.heading, self.up())
    }

    /// The direction of the thrust in normal flight.
    fn up(&self) -> DVec3 {
        self.lean_m_s2.extend(-GRAVITY_M_S2).normalize()
    }

    /// Drag per mass, limited so that it never reverses the airspeed within a step.
    fn drag(&self, through_air: DVec3, axes: &[DVec3; 3], drive: &Drive<'_>) -> DVec3 {
        if self.on_ground || through_air == DVec3::ZERO {
            return DVec3::ZERO;
        }
        let density = drive.conditions.air_density;
        let along = DVec3::from_array(axes.map(|axis| through_air.dot(axis)));
        let form = drive.airframe.form_drag(along, density);
        let braked =
            form / (DVec3::ONE + form.abs() / along.abs().max(DVec3::splat(1e-9)) * STEP_S);
        axes[0] * braked.x + axes[1] * braked.y + axes[2] * braked.z
    }

    /// The acceleration in normal flight; sets thrust and throttle.
    fn fly(&mut self, demand: Demand, through_air: DVec3, drive: &Drive<'_>) -> DVec3 {
        self.lean(demand);
        let up = self.up();
        let drag = self.drag(through_air, &axes(self.heading, up), drive);
        let density = drive.conditions.air_density;
        let inflow = drive.airframe.momentum_drag(self.thrust_m_s2, density);
        let on_ground = if self.on_ground { 0.0 } else { 1.0 };
        let drag = drag + through_air * (inflow * on_ground / (1.0 + inflow * STEP_S));
        let into_rotors = through_air.dot(up);
        let stream = RotorStream {
            drag_down_m_s2: drag.z,
            axis_down: up.z,
            inflow_m_s: into_rotors,
        };
        self.thrust(demand, stream, drive);
        up * self.thrust_m_s2 - drag + DVec3::Z * GRAVITY_M_S2
    }

    /// Sets thrust and throttle after lag and saturation.
    fn thrust(&mut self, demand: Demand, stream: RotorStream, drive: &Drive<'_>) {
        let inflow = stream.inflow_m_s;
        let (airframe, conditions) = (drive.airframe, drive.conditions);
        self.saturated = false;
        match demand {
            Demand::Off => {
                self.lift_m_s2 = 0.0;
                self.thrust_m_s2 = 0.0;
                self.throttle = 0.0;
            }
            Demand::Throttle { share, .. } => {
                // A leaning vehicle gets more throttle, so that its lift stays the same.
                let boost = 1.0 / (-stream.axis_down).max(BOOST_LEAST);
                let throttle = (share * boost).clamp(0.0, 1.0);
                self.throttle = throttle;
                self.lift_m_s2 = 0.0;
                self.thrust_m_s2 = airframe.thrust_for(throttle, inflow, conditions);
            }
            Demand::Acceleration(wanted) => {
                // The autopilot compensates drag as it learns it.
                let learnt = stream.drag_down_m_s2 - self.known_drag_m_s2;
                self.known_drag_m_s2 += learnt * (STEP_S / (STEP_S + DRAG_LAG_S));
                let lift = self.lagged_lift(wanted.z) - self.known_drag_m_s2;
                let most = airframe.thrust_max(inflow, conditions);
                let asked = lift / -stream.axis_down;
                self.saturated = asked >= most;
                self.thrust_m_s2 = asked.clamp(0.0, most);
                self.throttle = if self.saturated {
                    1.0
                } else {
                    airframe
                        .throttle_for(self.thrust_m_s2, inflow, conditions)
                        .max(IDLE_THROTTLE)
                };
            }
        }
    }

    /// The lift per mass that carries the weight and follows the demand with its lag.
    fn lagged_lift(&mut self, wanted_down_m_s2: f64) -> f64 {
        let blend = STEP_S / (STEP_S + THRUST_LAG_S);
        self.lift_m_s2 += (-wanted_down_m_s2 - self.lift_m_s2) * blend;
        GRAVITY_M_S2 + self.lift_m_s2
    }

    fn lean(&mut self, demand: Demand) {
        let wanted = match demand {
            Demand::Acceleration(accel) => accel.truncate(),
            Demand::Throttle { lean_m_s2, .. } => lean_m_s2,
            Demand::Off => DVec2::ZERO,
        };
        self.lean_m_s2 += (wanted - self.lean_m_s2) * (STEP_S / (STEP_S + LEAN_LAG_S));
    }

    /// The acceleration of a tumbling vehicle.
    fn tumble(
        &mut self,
        upset: &mut Upset,
        demand: Demand,
        through_air: DVec3,
        drive: &Drive<'_>,
    ) -> DVec3 {
        self.lean(demand);
        let most = GRAVITY_M_S2 * maths::tan(upset.lean_limit_rad(self.throttle));
        self.lean_m_s2 = self.lean_m_s2.clamp_length_max(most);
        let lift_m_s2 = match demand {
            Demand::Off => None,
            Demand::Throttle { share, .. } => {
                Some(drive.airframe.thrust_for(share, 0.0, drive.conditions))
            }
            Demand::Acceleration(wanted) => Some(self.lagged_lift(wanted.z)),
        };
        let wanted = WantedTurn {
            up: self.up(),
            yaw_rate_rad_s: self.yaw_rate_deg_s.to_radians(),
            lift_m_s2,
        };
        let lifting_m_s2 = GRAVITY_M_S2 - self.accel_m_s2.z;
        let motors = upset.step(
            &wanted,
            through_air,
            lifting_m_s2,
            &Drive {
                wrecked: self.wrecked,
                ..*drive
            },
        );
        let drag = self.drag(through_air, &upset.axes(), drive);
        self.thrust_m_s2 = upset.thrust_m_s2;
        self.saturated = upset.mixer.limited.throttle;
        self.throttle = match lift_m_s2 {
            None => 0.0,
            Some(_) if self.saturated => 1.0,
            Some(_) => drive
                .airframe
                .throttle_for(upset.asked_m_s2, 0.0, drive.conditions)
                .max(IDLE_THROTTLE),
        };
        motors - drag + DVec3::Z * GRAVITY_M_S2
    }

    fn start_tumbling(&mut self) {
        let (roll_rate, pitch_rate) = self.angle_rates_rad_s;
        let rates = DVec3::new(roll_rate, pitch_rate, self.yaw_rate_deg_s.to_radians());
        self.upset = Some(Box::new(Upset::new(self.axes(), rates)));
    }

    /// Returns to the simple lean model.
    fn recover(&mut self, axes: [DVec3; 3]) {
        let up = axes[2];
        self.lean_m_s2 = up.truncate() * (GRAVITY_M_S2 / (-up.z).max(0.1));
    }

    fn note_angles(&mut self) {
        let (old_roll, old_pitch) = self.angles_rad;
        let (roll, pitch) = if self.lean_m_s2 == DVec2::ZERO {
            (0.0, 0.0)
        } else {
            let forward = self.lean_m_s2.dot(self.heading);
            let right = self.heading.perp_dot(self.lean_m_s2);
            let down = maths::hypot(forward, GRAVITY_M_S2);
            (
                maths::atan(right / down),
                -maths::atan(forward / GRAVITY_M_S2),
            )
        };
        self.angle_rates_rad_s = ((roll - old_roll) / STEP_S, (pitch - old_pitch) / STEP_S);
        self.angles_rad = (roll, pitch);
    }

    fn note_attitude(&mut self, upset: &Upset) {
        let (roll, pitch, yaw) = upset.angles_rad();
        self.angles_rad = (roll, pitch);
        self.angle_rates_rad_s = (upset.rates_rad_s.x, upset.rates_rad_s.y);
        self.yaw_rate_deg_s = upset.rates_rad_s.z.to_degrees();
        self.yaw_deg += sortie_geo::wrap_180(yaw.to_degrees() - self.yaw_deg);
        self.heading = DVec2::from_angle(yaw);
    }

    /// Stops at the ground; returns the speed of an impact from the air, in m/s.
    fn touch_ground(&mut self) -> Option<f64> {
        if self.position_m.z < 0.0 {
            if self.position_m.z < -0.02 {
                self.on_ground = false;
            }
            return None;
        }
        let impact = (!self.on_ground).then_some(self.velocity_m_s.z);
        self.position_m.z = 0.0;
        self.velocity_m_s = DVec3::ZERO;
        self.lean_m_s2 = DVec2::ZERO;
        self.accel_m_s2 = DVec3::ZERO;
        self.on_ground = true;
        match &mut self.upset {
            Some(upset) if self.wrecked => upset.lie(),
            Some(upset) => upset.settle(),
            None => {}
        }
        impact
    }
}

#[cfg(test)]
mod tests;
