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
/// The lowest limit of the throttle that `ArduRover` accepts, in percent.
const LEAST_LIMIT: f64 = 5.0;

/// The parameters that follow from the running gear: the throttle is limited to the top speed, the throttle at cruise
/// speed is that of the model, and the battery counts the current that the vehicle draws there. The model keeps its
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
    let limit = (100.0 * throttle(gear.top_speed_m_s)).round();
    let amperes = AMPERES_PER_VOLT * gear.cruise_current_a / (FULL_A * cruise);
    vec![
        ("MOT_THR_MAX", limit.clamp(LEAST_LIMIT, 100.0)),
        ("CRUISE_THROTTLE", (100.0 * cruise).round().max(1.0)),
        ("BATT_AMP_PERVLT", (amperes * 1e3).round() * 1e-3),
        ("SIM_BATT_VOLTAGE", gear.full_voltage_v),
        ("SIM_BATT_CAP_AH", gear.battery_capacity_ah),
    ]
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
    fn the_throttle_of_the_models_is_limited_to_the_top_speed() {
        for (source, least, most) in [
            (include_str!("../../designs/courier.toml"), 34.0, 40.0),
            (include_str!("../../designs/sapper.toml"), 38.0, 42.0),
            (include_str!("../../designs/lifeboat.toml"), 19.0, 23.0),
        ] {
            let all = of(source);
            let limit = all.iter().find(|(name, _)| *name == "MOT_THR_MAX");
            let limit = limit.expect("it is set").1;
            assert!((least..=most).contains(&limit), "{all:?}");
        }
    }
}
