//! The motion of a rover or a boat: the models `rover`, `rover-skid` and `motorboat` of `ArduPilot`'s SITL. A vehicle
//! moves along its heading only, and its speed follows the throttle.

use super::kind::Chassis;
use sortie_geo::maths;

/// The steering angle of wheels and rudder at full deflection.
const TURN_MAX_DEG: f64 = 35.0;
/// The diameter of the circle that the models drive with it.
const TURNING_CIRCLE_M: f64 = 1.8;
/// The rate at which the skid-steered model turns for each unit of difference between its sides.
const MODEL_SKID_DEG_S: f64 = 140.0;
/// The gains of the rate controller that suit the models (`ATC_STR_RAT_P`, `_I` and `_FF`).
const STEERING_GAIN: f64 = 0.2;
/// The fastest turn of a car, in degrees per second.
const TURN_RATE_MAX_DEG_S: f64 = 360.0;
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
    /// The outputs of a skid-steered vehicle whose sides have these, -1 to 1.
    pub(super) fn of_sides(left: f64, right: f64) -> Self {
        Self {
            steering: (left - right) / 2.0,
            throttle: f64::midpoint(left, right),
        }
    }

    /// That to the left side of a skid-steered vehicle.
    pub(super) fn left(self) -> f64 {
        self.throttle + self.steering
    }

    /// That to the right side of a skid-steered vehicle.
    pub(super) fn right(self) -> f64 {
        self.throttle - self.steering
    }

    pub(super) fn are_off(self) -> bool {
        self == Self::default()
    }
}

/// How a vehicle answers its outputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Handling {
    traction: Traction,
    turning: Turning,
}

/// How the speed follows the throttle.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Traction {
    /// Wheels: the top speed, and the time in which the speed follows the throttle.
    Wheels { top_m_s: f64, lag_s: f64 },
    /// A propeller in water: its force at full throttle per mass, and the drag of the hull per mass and squared speed.
    Water { force_m_s2: f64, drag_per_m: f64 },
}

/// How the heading follows the steering.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Turning {
    /// On a circle of this diameter at full deflection.
    Steered { circle_m: f64 },
    /// On the spot: the rate for each unit of difference between the sides.
    Skid { rate_deg_s: f64 },
}

impl Handling {
    /// The handling of SITL's model.
    pub(super) fn of_model(chassis: Chassis) -> Self {
        let circle_m = TURNING_CIRCLE_M;
        let (traction, turning) = match chassis {
            Chassis::Ackermann => (
                Traction::Wheels {
                    top_m_s: 20.0,
                    lag_s: 2.0,
                },
                Turning::Steered { circle_m },
            ),
            Chassis::Skid => (
                Traction::Wheels {
                    top_m_s: 4.0,
                    lag_s: 4.0 / 14.0,
                },
                Turning::Skid {
                    rate_deg_s: MODEL_SKID_DEG_S,
                },
            ),
            Chassis::Boat => (
                Traction::Water {
                    force_m_s2: 25.0,
                    drag_per_m: 0.25,
                },
                Turning::Steered { circle_m },
            ),
        };
        Self { traction, turning }
    }

    /// The handling of a vehicle with this running gear.
    pub(super) fn of_gear(chassis: Chassis, gear: &RunningGear) -> Self {
        let (top_m_s, accel_m_s2) = (gear.top_speed_m_s, gear.accel_m_s2);
        Self {
            traction: match chassis {
                Chassis::Ackermann | Chassis::Skid => Traction::Wheels {
                    top_m_s,
                    lag_s: top_m_s / accel_m_s2,
                },
                Chassis::Boat => Traction::Water {
                    force_m_s2: accel_m_s2,
                    drag_per_m: accel_m_s2 / (top_m_s * top_m_s),
                },
            },
            turning: match chassis {
                Chassis::Skid => Turning::Skid {
                    rate_deg_s: 0.5 * gear.turn_rate_deg_s,
                },
                Chassis::Ackermann | Chassis::Boat => Turning::Steered {
                    circle_m: 2.0 * gear.turning_radius_m,
                },
            },
        }
    }

    /// The motion at a speed over ground, positive forwards.
    pub(super) fn rolling(self, outputs: Outputs, speed_m_s: f64) -> Rolling {
        Rolling {
            accel_m_s2: self.accel_m_s2(outputs.throttle, speed_m_s),
            turn_deg_s: match self.turning {
                Turning::Skid { rate_deg_s } => 2.0 * outputs.steering * rate_deg_s,
                Turning::Steered { circle_m } => {
                    steered_deg_s(outputs.steering, speed_m_s, circle_m)
                }
            }
            .clamp(-TURN_RATE_MAX_DEG_S, TURN_RATE_MAX_DEG_S),
        }
    }

    fn accel_m_s2(self, throttle: f64, speed_m_s: f64) -> f64 {
        match self.traction {
            Traction::Wheels { top_m_s, lag_s } => (throttle * top_m_s - speed_m_s) / lag_s,
            Traction::Water {
                force_m_s2,
                drag_per_m,
            } => throttle * force_m_s2 - drag_per_m * speed_m_s * speed_m_s.abs(),
        }
    }
}

impl Chassis {
    /// Whether a vehicle is so slow that it stands.
    pub(super) fn stands(speed_m_s: f64) -> bool {
        speed_m_s.abs() < STANDING_M_S
    }
}

/// The turn rate of a vehicle that steers, on the circle of its steering angle.
fn steered_deg_s(steering: f64, speed_m_s: f64, circle_m: f64) -> f64 {
    let full = maths::sin(TURN_MAX_DEG.to_radians());
    let diameter_m = circle_m * full;
    let bend = maths::sin((steering * TURN_MAX_DEG).to_radians());
    (2.0 * speed_m_s * bend / diameter_m).to_degrees()
}

/// What drives a built ground robot or boat, and its battery: the figures of a vehicle that differs from SITL's models.
#[derive(Debug, Clone, PartialEq)]
pub struct RunningGear {
    /// The mass ready to drive.
    pub mass_kg: f64,
    /// The length of the chassis or hull.
    pub length_m: f64,
    /// The speed at full throttle on level ground or calm water.
    pub top_speed_m_s: f64,
    /// The usual speed on paths.
    pub cruise_speed_m_s: f64,
    /// The current from the battery at that speed, in amperes.
    pub cruise_current_a: f64,
    /// The acceleration at full throttle from a standstill.
    pub accel_m_s2: f64,
    /// The radius of the tightest turn of a vehicle that steers.
    pub turning_radius_m: f64,
    /// The fastest turn on the spot of a vehicle with motors on both sides, in degrees per second.
    pub turn_rate_deg_s: f64,
    /// The power from the battery by steady speed, in watts and m/s, with electronics and payload: rising speeds from 0
    /// to the top speed.
    pub power_w: Vec<(f64, f64)>,
    /// The share of the battery's power that becomes motion when the vehicle gains speed.
    pub efficiency: f64,
    /// The voltage of the full battery.
    pub full_voltage_v: f64,
    /// The charge of the full battery, in ampere hours.
    pub battery_capacity_ah: f64,
    /// The resistance of the battery, in ohms.
    pub battery_resistance_ohm: f64,
}

impl RunningGear {
    /// The throttle at cruise speed, 0 to 1.
    pub fn cruise_throttle(&self, chassis: Chassis) -> f64 {
        let share = self.cruise_speed_m_s / self.top_speed_m_s;
        match chassis {
            Chassis::Ackermann | Chassis::Skid => share,
            Chassis::Boat => share * share,
        }
    }

    /// The parameters with which the autopilot controls this running gear as well as SITL's model with its own ones: the
    /// feed-forward of the throttle, and gains of the steering for the turn that full deflection gives.
    pub(super) fn tuning(&self, chassis: Chassis) -> [(&'static str, f64); 4] {
        let gain = match chassis {
            Chassis::Skid => 2.0 * MODEL_SKID_DEG_S / self.turn_rate_deg_s,
            Chassis::Ackermann | Chassis::Boat => 2.0 * self.turning_radius_m / TURNING_CIRCLE_M,
        };
        let steering = STEERING_GAIN * gain;
        [
            (
                "CRUISE_THROTTLE",
                (100.0 * self.cruise_throttle(chassis)).round(),
            ),
            ("ATC_STR_RAT_P", steering),
            ("ATC_STR_RAT_I", steering),
            ("ATC_STR_RAT_FF", steering),
        ]
    }

    /// The power from the battery at a speed and acceleration. Nothing is won back by braking.
    pub(super) fn power_at_w(&self, speed_m_s: f64, accel_m_s2: f64) -> f64 {
        let idle_w = self.power_w.first().map_or(0.0, |point| point.1);
        let gained_w = self.mass_kg * accel_m_s2 * speed_m_s / self.efficiency;
        (self.steady_w(speed_m_s.abs()) + gained_w).max(idle_w)
    }

    fn steady_w(&self, speed_m_s: f64) -> f64 {
        let next = self.power_w.partition_point(|point| point.0 < speed_m_s);
        let (before, after) = (
            self.power_w.get(next.saturating_sub(1)),
            self.power_w.get(next),
        );
        match (before, after.or(self.power_w.last())) {
            (Some(low), Some(high)) if high.0 > low.0 => {
                let share = ((speed_m_s - low.0) / (high.0 - low.0)).clamp(0.0, 1.0);
                low.1 + (high.1 - low.1) * share
            }
            (_, end) => end.map_or(0.0, |point| point.1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rolling(chassis: Chassis, steering: f64, throttle: f64, speed_m_s: f64) -> Rolling {
        Handling::of_model(chassis).rolling(Outputs { steering, throttle }, speed_m_s)
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

    fn gear() -> RunningGear {
        RunningGear {
            mass_kg: 40.0,
            length_m: 1.0,
            top_speed_m_s: 3.0,
            cruise_speed_m_s: 1.8,
            cruise_current_a: 5.0,
            accel_m_s2: 1.5,
            turning_radius_m: 2.0,
            turn_rate_deg_s: 90.0,
            power_w: vec![(0.0, 10.0), (1.0, 60.0), (3.0, 260.0)],
            efficiency: 0.5,
            full_voltage_v: 25.2,
            battery_capacity_ah: 10.0,
            battery_resistance_ohm: 0.02,
        }
    }

    #[test]
    fn a_built_vehicle_moves_by_its_gear() {
        for chassis in [Chassis::Ackermann, Chassis::Skid, Chassis::Boat] {
            let handling = Handling::of_gear(chassis, &gear());
            let full = Outputs {
                steering: 1.0,
                throttle: 1.0,
            };
            let from_rest = handling.rolling(full, 0.0).accel_m_s2;
            assert!((from_rest - 1.5).abs() < 1e-9, "{chassis:?}: {from_rest}");
            assert!(
                handling.rolling(full, 3.0).accel_m_s2.abs() < 1e-9,
                "{chassis:?}"
            );
            let turn_deg_s = handling.rolling(full, 1.0).turn_deg_s;
            let wanted = match chassis {
                Chassis::Skid => 90.0,
                Chassis::Ackermann | Chassis::Boat => 0.5f64.to_degrees(),
            };
            assert!(
                (turn_deg_s - wanted).abs() < 1e-9,
                "{chassis:?}: {turn_deg_s}"
            );
            let cruise = Outputs {
                steering: 0.0,
                throttle: gear().cruise_throttle(chassis),
            };
            let accel = handling.rolling(cruise, 1.8).accel_m_s2;
            assert!(accel.abs() < 1e-9, "{chassis:?}: {accel}");
        }
    }

    #[test]
    fn power_follows_speed_and_acceleration_and_braking_wins_nothing_back() {
        let gear = gear();
        for (speed_m_s, accel_m_s2, power_w) in [
            (0.0, 0.0, 10.0),
            (2.0, 0.0, 160.0),
            (-2.0, 0.0, 160.0),
            (4.0, 0.0, 260.0),
            (1.0, 0.5, 60.0 + 40.0 * 0.5 / 0.5),
            (2.0, -1.5, 10.0),
            (-1.0, -0.5, 60.0 + 40.0 * 0.5 / 0.5),
            (-2.0, 1.5, 10.0),
        ] {
            let found = gear.power_at_w(speed_m_s, accel_m_s2);
            assert!((found - power_w).abs() < 1e-9, "{speed_m_s}: {found}");
        }
    }
}
