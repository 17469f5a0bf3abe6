//! A built ground robot or boat in SITL, whose models of vehicles cannot be changed: the parameters that bring them
//! nearest to its figures.

use crate::sim::{Chassis, RunningGear, VehicleKind};

/// Full throttle of the models: the speed in m/s, and the current in amperes.
const ROVER_M_S: f64 = 20.0;
const SKID_M_S: f64 = 4.0;
const BOAT_M_S: f64 = 10.0;
const FULL_A: f64 = 50.0;
/// The scale of the current sensor of SITL's battery.
const AMPERES_PER_VOLT: f64 = 17.0;
/// The pulse without throttle, and its distance to the pulse of full throttle, in microseconds.
const IDLE_US: f64 = 1500.0;
const FULL_US: f64 = 500.0;
/// The least distance that still moves a model.
const LEAST_US: f64 = 10.0;

/// The parameters that follow from the running gear: the pulses of the motors end at the top speed (`MOT_THR_MAX` would
/// not go below 30 %), and the battery counts the current that the vehicle draws at cruise speed. The model keeps its
/// acceleration, its turns and its voltage. Empty for a vehicle that flies.
pub fn gear_parameters(kind: VehicleKind, gear: &RunningGear) -> Vec<(&'static str, f64)> {
    let VehicleKind::Rover(chassis) = kind else {
        return Vec::new();
    };
    let throttle = |speed_m_s: f64| match chassis {
        Chassis::Ackermann => speed_m_s / ROVER_M_S,
        Chassis::Skid => speed_m_s / SKID_M_S,
        Chassis::Boat => (speed_m_s / BOAT_M_S) * (speed_m_s / BOAT_M_S),
    };
    let cruise = throttle(gear.cruise_speed_m_s).min(1.0);
    let amperes = AMPERES_PER_VOLT * gear.cruise_current_a / (FULL_A * cruise);
    let range_us = (FULL_US * throttle(gear.top_speed_m_s)).round();
    let range_us = range_us.clamp(LEAST_US, FULL_US);
    // The first output of a skid-steered vehicle is a motor, too.
    let motors: &[(&str, &str)] = match chassis {
        Chassis::Skid => &[("SERVO1_MIN", "SERVO1_MAX"), ("SERVO3_MIN", "SERVO3_MAX")],
        Chassis::Ackermann | Chassis::Boat => &[("SERVO3_MIN", "SERVO3_MAX")],
    };
    let pulses = motors
        .iter()
        .flat_map(|&(least, most)| [(least, IDLE_US - range_us), (most, IDLE_US + range_us)]);
    let mut all: Vec<_> = pulses.collect();
    all.extend([
        (
            "CRUISE_THROTTLE",
            (100.0 * gear.cruise_throttle(chassis)).round(),
        ),
        ("BATT_AMP_PERVLT", (amperes * 1e3).round() * 1e-3),
        (
            "SIM_BATT_VOLTAGE",
            (gear.full_voltage_v * 1e3).round() / 1e3,
        ),
        ("SIM_BATT_CAP_AH", gear.battery_capacity_ah),
    ]);
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workshop::{AirframeBuild, Design};

    fn of(source: &str) -> Vec<(&'static str, f64)> {
        let design = Design::from_toml(source).expect("a good design");
        let built = design.airframe().expect("complete");
        let AirframeBuild::Gear(gear) = built.build else {
            panic!("it drives");
        };
        gear_parameters(design.vehicle_kind(), &gear)
    }

    #[test]
    fn the_pulses_of_the_motors_end_at_the_top_speed_and_the_steering_keeps_its_own() {
        for (source, least, most, is_steered) in [
            (
                include_str!("../../designs/courier.toml"),
                1675.0,
                1690.0,
                true,
            ),
            (
                include_str!("../../designs/sapper.toml"),
                1695.0,
                1712.0,
                false,
            ),
            (
                include_str!("../../designs/lifeboat.toml"),
                1598.0,
                1610.0,
                true,
            ),
        ] {
            let all = of(source);
            let value = |name| {
                all.iter()
                    .find(|(it, _)| *it == name)
                    .map(|(_, value)| *value)
            };
            let (low, high) = (value("SERVO3_MIN"), value("SERVO3_MAX"));
            let high = high.expect("it is set");
            assert!((least..=most).contains(&high), "{all:?}");
            assert_eq!(low, Some(3000.0 - high), "the same backwards");
            assert_eq!(value("SERVO1_MAX").is_none(), is_steered, "{all:?}");
        }
    }
}
