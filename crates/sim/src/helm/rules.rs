//! The parameters of steering and speed control, in SI units.

use super::pid::PidGains;
use crate::kind::{Chassis, VehicleKind};
use crate::kinematics::GRAVITY_M_S2;
use crate::parameters::Parameters;

/// An acceleration without a limit, in m/s².
const ACCEL_UNLIMITED_M_S2: f64 = 20.0;

/// The acceleration on a circle without a limit, in m/s².
const CIRCLE_ACCEL_M_S2: f64 = 1.0;
/// The radius of the smallest circle, in metres.
const CIRCLE_RADIUS_MIN_M: f64 = 0.5;

const PILOT_SPEED_MAX_M_S: f64 = 30.0;
/// The value of `FRAME_CLASS` for a boat.
const BOAT: i32 = 2;

/// The limits and gains of the helm.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HelmRules {
    /// `ATC_ACCEL_MAX` and `ATC_DECEL_MAX`; 0 for no limit of their own.
    pub(crate) accel_max_m_s2: f64,
    pub(super) decel_max_m_s2: f64,
    /// The acceleration along a path.
    pub(crate) accel_m_s2: f64,
    /// The highest speed on a path.
    pub(crate) speed_max_m_s: f64,
    pub(super) turn_max_rad_s: f64,
    pub(super) turn_accel_rad_s2: f64,
    /// The greatest acceleration to the side (`ATC_TURN_MAX_G`).
    pub(crate) lateral_m_s2: f64,
    pub(super) heading_p: f64,
    pub(super) steering: PidGains,
    pub(super) steering_feed_forward: f64,
    pub(super) speed: PidGains,
    /// The throttle for each metre per second (`CRUISE_THROTTLE` by `CRUISE_SPEED`).
    pub(super) throttle_per_m_s: f64,
    /// Whether the motors may also brake.
    pub(super) brakes: bool,
    pub(super) stop_speed_m_s: f64,
    pub(super) speed_base_m_s: f64,
    /// `MOT_SLEWRATE`, in full throttles per second; `None` for no limit.
    pub(super) slew_per_s: Option<f64>,
    /// Gains along a path (`PSC_POS_P`, `PSC_VEL_P`).
    pub(crate) position_p: f64,
    pub(super) velocity_p: f64,
    /// The smallest circle (`TURN_RADIUS`), in metres; 0 for a vehicle that turns on the spot.
    pub(crate) turn_radius_m: f64,
    /// The smallest change of heading for which a vehicle stops and turns on the spot; `None` for never.
    pub(crate) pivot_from_deg: Option<f64>,
    pub(super) pivot_rad_s: f64,
    /// Whether the vehicle holds its places by driving back to them (`FRAME_CLASS` 2).
    pub(crate) is_boat: bool,
    pub(crate) acro_turn_deg_s: f64,
    /// The pilot's highest speed (`SPEED_MAX`); 0 for the one that full throttle gives.
    pilot_speed_max_m_s: f64,
    pub(crate) circle: CircleRules,
    /// `LOIT_RADIUS`, and the speed per metre beyond it.
    pub(crate) loiter_radius_m: f64,
    pub(crate) loiter_speed_per_m: f64,
}

impl HelmRules {
    pub(crate) fn read(all: &Parameters) -> Self {
        let rad = |name| all.value(name).to_radians();
        let [accel, decel] = ["ATC_ACCEL_MAX", "ATC_DECEL_MAX"].map(|name| all.value(name));
        let pivots = all.kind() == VehicleKind::Rover(Chassis::Skid);
        let radius_m = all.value("TURN_RADIUS").max(0.0);
        let slew = all.value("MOT_SLEWRATE");
        Self {
            accel_max_m_s2: accel,
            decel_max_m_s2: decel,
            accel_m_s2: path_accel_m_s2(
                [accel, decel],
                all.value("WP_ACCEL"),
                ACCEL_UNLIMITED_M_S2,
            ),
            speed_max_m_s: all.value("WP_SPEED").clamp(0.05, 100.0),
            turn_max_rad_s: rad("ATC_STR_RAT_MAX"),
            turn_accel_rad_s2: rad("ATC_STR_ACC_MAX"),
            lateral_m_s2: lateral_m_s2(all),
            heading_p: all.value("ATC_STR_ANG_P"),
            steering: PidGains::read(all, "ATC_STR_RAT"),
            steering_feed_forward: all.value("ATC_STR_RAT_FF"),
            speed: PidGains::read(all, "ATC_SPEED"),
            throttle_per_m_s: throttle_per_m_s(all),
            brakes: all.value("ATC_BRAKE") > 0.0,
            stop_speed_m_s: all.value("ATC_STOP_SPEED").abs(),
            speed_base_m_s: all.value("MOT_SPD_SCA_BASE"),
            slew_per_s: (slew > 0.0).then_some(slew * 0.01),
            position_p: all.value("PSC_POS_P"),
            velocity_p: all.value("PSC_VEL_P"),
            turn_radius_m: if pivots { 0.0 } else { radius_m },
            pivot_from_deg: pivots
                .then(|| all.value("WP_PIVOT_ANGLE"))
                .filter(|angle| *angle > PIVOT_WITHIN_DEG),
            pivot_rad_s: rad("WP_PIVOT_RATE"),
            is_boat: all.value("FRAME_CLASS") as i32 == BOAT,
            acro_turn_deg_s: all.value("ACRO_TURN_RATE"),
            pilot_speed_max_m_s: all.value("SPEED_MAX"),
            circle: CircleRules::read(all, [accel, decel]),
            loiter_radius_m: all.value("LOIT_RADIUS").max(0.0),
            loiter_speed_per_m: all.value("LOIT_SPEED_GAIN"),
        }
    }

    /// The speed of a pilot's full throttle, in m/s.
    pub(crate) fn pilot_speed_m_s(&self) -> f64 {
        let projected = 1.0 / self.throttle_per_m_s.max(1e-3);
        let most = if self.pilot_speed_max_m_s > 0.0 {
            self.pilot_speed_max_m_s
        } else {
            projected
        };
        most.min(PILOT_SPEED_MAX_M_S)
    }

    /// The speed below which a vehicle that cannot turn on the spot does not turn.
    pub(super) fn turning_speed_m_s(&self) -> f64 {
        (self.lateral_m_s2 * 0.5 * self.turn_radius_m).sqrt()
    }
}

/// The circle of CIRCLE (`CIRC_*`).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CircleRules {
    asked_radius_m: f64,
    asked_speed_m_s: f64,
    pub(crate) is_counterclockwise: bool,
    pub(crate) accel_m_s2: f64,
    lateral_m_s2: f64,
    /// `TURN_RADIUS`, which also limits vehicles that turn on the spot.
    pub(crate) turn_radius_m: f64,
}

impl CircleRules {
    fn read(all: &Parameters, accels: [f64; 2]) -> Self {
        let speed = all.value("CIRC_SPEED");
        let asked_speed = if speed > 0.0 {
            speed
        } else {
            all.value("WP_SPEED")
        };
        Self {
            asked_radius_m: all.value("CIRC_RADIUS"),
            asked_speed_m_s: asked_speed.clamp(0.05, 100.0),
            is_counterclockwise: all.value("CIRC_DIR") as i32 == 1,
            accel_m_s2: path_accel_m_s2(accels, all.value("WP_ACCEL"), CIRCLE_ACCEL_M_S2),
            lateral_m_s2: lateral_m_s2(all),
            turn_radius_m: all.value("TURN_RADIUS").max(0.0),
        }
    }

    pub(crate) fn radius_m(&self) -> f64 {
        self.possible_radius_m(self.asked_radius_m)
    }

    /// A radius that the vehicle can drive.
    pub(crate) fn possible_radius_m(&self, asked_m: f64) -> f64 {
        let least_m = self.turn_radius_m.max(CIRCLE_RADIUS_MIN_M);
        asked_m.abs().max(least_m)
    }

    /// The warning about a radius that the vehicle cannot drive.
    pub(crate) fn radius_warning(&self, asked_m: f64) -> Option<String> {
        let turn_radius_m = self.turn_radius_m;
        let is_narrow = asked_m.abs().max(CIRCLE_RADIUS_MIN_M) < turn_radius_m;
        is_narrow.then(|| format!("Circle: radius increased to TURN_RADIUS ({turn_radius_m:4.1})"))
    }

    /// The highest speed on the circle.
    pub(crate) fn fastest_m_s(&self) -> f64 {
        (self.lateral_m_s2 * self.radius_m()).sqrt()
    }

    pub(crate) fn speed_m_s(&self) -> f64 {
        self.asked_speed_m_s.min(self.fastest_m_s())
    }

    /// The warning about a speed that the circle does not allow, if it is one.
    pub(crate) fn speed_warning(&self, asked_m_s: f64) -> Option<String> {
        let most = self.fastest_m_s();
        (asked_m_s > most).then(|| format!("Circle: max speed is {most:4.1}"))
    }

    /// The warnings at the begin about what the circle does not allow.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let wider = self.radius_warning(self.asked_radius_m);
        let slower = self.speed_warning(self.asked_speed_m_s);
        wider.into_iter().chain(slower).collect()
    }
}

fn lateral_m_s2(all: &Parameters) -> f64 {
    all.value("ATC_TURN_MAX_G").max(0.1) * GRAVITY_M_S2
}

/// The throttle for each metre per second: that of the cruise.
fn throttle_per_m_s(all: &Parameters) -> f64 {
    let throttle = all.value("CRUISE_THROTTLE") * 0.01;
    let speed_m_s = all.value("CRUISE_SPEED");
    if throttle > 0.0 && speed_m_s > 0.0 {
        throttle / speed_m_s
    } else {
        0.0
    }
}

/// A turn on the spot ends within this angle of its heading.
pub(crate) const PIVOT_WITHIN_DEG: f64 = 5.0;

/// The acceleration along a path: that of the waypoints, unless the controller allows less; `unlimited` for a controller
/// without a limit.
fn path_accel_m_s2([accel, decel]: [f64; 2], waypoints: f64, unlimited: f64) -> f64 {
    let slower = if decel > 0.0 { accel.min(decel) } else { accel };
    let controller = if slower > 0.0 { slower } else { unlimited };
    if waypoints > 0.0 {
        waypoints.min(controller)
    } else {
        controller
    }
}
