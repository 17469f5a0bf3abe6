//! The motion of a rover or a boat: the models `rover`, `rover-skid` and `motorboat` of `ArduPilot`'s SITL. A vehicle
//! moves along its heading only, and its speed follows the throttle.

use super::kind::Chassis;
use sortie_geo::maths;

/// The steering angle of wheels and rudder at full deflection.
const TURN_MAX_DEG: f64 = 35.0;
/// The diameter of the circle driven with it.
const TURNING_CIRCLE_M: f64 = 1.8;
/// The fastest turn of a car, in degrees per second.
const TURN_RATE_MAX_DEG_S: f64 = 360.0;
/// The rate at which a skid-steered vehicle turns for each unit of difference between its sides.
const SKID_TURN_DEG_S: f64 = 140.0;
/// The force of a boat's motor at full throttle per mass, and the drag of the hull per mass and squared speed.
const BOAT_FORCE_M_S2: f64 = 25.0;
const BOAT_DRAG_PER_M: f64 = 0.25;
/// A slower vehicle stands, in m/s.
const STANDING_M_S: f64 = 1e-3;

/// The outputs to the steering and the motors, -1 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Outputs {
    /// Positive to the right.
    pub(super) steering: f64,
    pub(super) throttle: f64,
}

/// How a vehicle moves with its current outputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rolling {
    pub(super) accel_m_s2: f64,
    pub(super) turn_deg_s: f64,
}

impl Outputs {
    pub(super) fn are_off(self) -> bool {
        self == Self::default()
    }
}

impl Chassis {
    /// The motion at a speed over ground, positive forwards.
    pub(super) fn rolling(self, outputs: Outputs, speed_m_s: f64) -> Rolling {
        Rolling {
            accel_m_s2: self.accel_m_s2(outputs.throttle, speed_m_s),
            turn_deg_s: match self {
                Self::Skid => 2.0 * outputs.steering * SKID_TURN_DEG_S,
                Self::Ackermann | Self::Boat => steered_deg_s(outputs.steering, speed_m_s),
            }
            .clamp(-TURN_RATE_MAX_DEG_S, TURN_RATE_MAX_DEG_S),
        }
    }

    fn accel_m_s2(self, throttle: f64, speed_m_s: f64) -> f64 {
        // The top speed and the time in which the speed follows the throttle.
        let follow = |top_m_s: f64, lag_s: f64| (throttle * top_m_s - speed_m_s) / lag_s;
        match self {
            Self::Ackermann => follow(20.0, 2.0),
            Self::Skid => follow(4.0, 4.0 / 14.0),
            Self::Boat => {
                throttle * BOAT_FORCE_M_S2 - BOAT_DRAG_PER_M * speed_m_s * speed_m_s.abs()
            }
        }
    }

    /// Whether a vehicle is so slow that it stands.
    pub(super) fn stands(speed_m_s: f64) -> bool {
        speed_m_s.abs() < STANDING_M_S
    }
}

/// The turn rate of a vehicle that steers, on the circle of its steering angle.
fn steered_deg_s(steering: f64, speed_m_s: f64) -> f64 {
    let full = maths::sin(TURN_MAX_DEG.to_radians());
    let diameter_m = TURNING_CIRCLE_M * full;
    let bend = maths::sin((steering * TURN_MAX_DEG).to_radians());
    (2.0 * speed_m_s * bend / diameter_m).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rolling(chassis: Chassis, steering: f64, throttle: f64, speed_m_s: f64) -> Rolling {
        chassis.rolling(Outputs { steering, throttle }, speed_m_s)
    }

    #[test]
    fn a_car_turns_on_its_circle_and_only_while_it_moves() {
        let turn = rolling(Chassis::Ackermann, 1.0, 0.0, 1.0).turn_deg_s;
        let lap_s = std::f64::consts::PI * TURNING_CIRCLE_M;
        assert!((turn - 360.0 / lap_s).abs() < 1e-9, "{turn}");
        let standing = rolling(Chassis::Ackermann, 1.0, 0.0, 0.0).turn_deg_s;
        assert!(standing.abs() < 1e-9);
        let backwards = rolling(Chassis::Ackermann, 1.0, 0.0, -1.0).turn_deg_s;
        assert!((backwards + turn).abs() < 1e-9, "it turns the other way");
    }

    #[test]
    fn a_skid_steered_vehicle_turns_on_the_spot() {
        assert!((rolling(Chassis::Skid, 0.25, 0.0, 0.0).turn_deg_s - 70.0).abs() < 1e-9);
    }

    #[test]
    fn the_top_speeds_are_those_of_the_models() {
        for (chassis, top_m_s) in [
            (Chassis::Ackermann, 20.0),
            (Chassis::Skid, 4.0),
            (Chassis::Boat, 10.0),
        ] {
            let at_top = rolling(chassis, 0.0, 1.0, top_m_s).accel_m_s2;
            assert!(at_top.abs() < 1e-9, "{chassis:?}: {at_top}");
            let astern = rolling(chassis, 0.0, -1.0, -top_m_s).accel_m_s2;
            assert!(astern.abs() < 1e-9, "{chassis:?}: {astern}");
        }
    }
}
