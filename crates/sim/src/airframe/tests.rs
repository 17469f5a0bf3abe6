use proptest::prelude::*;

use super::*;
use sortie_geo::maths;

const CALM: Conditions = Conditions {
    wind_m_s: DVec3::ZERO,
    air_density: 1.156_8,
    voltage_share: 1.0,
};

/// A heavy octocopter with the figures of ArduPilot's Callisto.
const HEAVY: &str = r#"
# A comment with a "quote"
{
    "mass": 32.5, "diagonal_size": 1.325,
    "refSpd": 25.0,    # m/s
    "refAngle": 30.0, "refVoltage": 46.9, "refCurrent": 65.36, "refAlt": 26, "refTempC": 25,
    "refBatRes": 0.024, "maxVoltage": 50.4, "battCapacityAh": 44, "propExpo": 0.5,
    "refRotRate": 120, "hoverThrOut": 0.36, "pwmMin": 1000, "pwmMax": 1940, "spin_min": 0.2,
    "spin_max": 0.975, "slew_max": 75, "disc_area": 1.82, "mdrag_coef": 0.10, "num_motors": 8
}"#;

fn heavy() -> Airframe {
    let (airframe, warnings) = Airframe::from_json(HEAVY).expect("valid");
    assert!(warnings.is_empty(), "{warnings:?}");
    airframe
}

#[test]
fn the_default_hovers_like_a_sitl() {
    let airframe = Airframe::default();
    let amperes = airframe.power_w(GRAVITY_M_S2) / 12.6;
    assert!((amperes - 28.11).abs() < 0.01, "{amperes}");
    let throttle = airframe.throttle_for(GRAVITY_M_S2, 0.0, &CALM);
    assert!((0.36..0.361).contains(&throttle), "{throttle}");
    let empty = Airframe::from_json("{}").expect("valid").0;
    assert_eq!(empty.figures, airframe.figures);
}

/// At the reference speed and lean, thrust, weight and drag of any frame are in balance: this is the meaning of the
/// reference flight.
#[test]
fn the_reference_flight_is_in_balance() {
    for airframe in [Airframe::default(), heavy()] {
        let figures = &airframe.figures;
        let lean = figures.reference_lean_deg.to_radians();
        let along = DVec3::new(maths::cos(lean), 0.0, 0.0) * figures.reference_speed_m_s;
        let density = air_density(figures.reference_altitude_m);
        let thrust = GRAVITY_M_S2 / maths::cos(lean);
        // SIM_Frame balances the whole form drag at the reference speed against the lean's pull.
        let form = airframe
            .form_drag(DVec3::X * figures.reference_speed_m_s, density)
            .x;
        let inflow = along.x * maths::cos(lean) * airframe.momentum_drag(thrust, density);
        let pull = GRAVITY_M_S2 * maths::tan(lean);
        assert!(
            (form + inflow - pull).abs() < 1e-9,
            "{form} {inflow} {pull}"
        );
    }
}

#[test]
fn a_heavy_octocopter_has_its_own_figures() {
    let airframe = heavy();
    assert_eq!(airframe.motors(), 8);
    assert_eq!(airframe.vehicle_type(), MavType::MAV_TYPE_OCTOROTOR);
    let amperes = airframe.power_w(GRAVITY_M_S2) / 46.9;
    assert!((amperes - 65.36).abs() < 1e-9, "{amperes}");
    assert!((airframe.thrust_max(0.0, &CALM) / GRAVITY_M_S2 - 1.0 / 0.36).abs() < 0.2);
}

#[test]
fn throttle_and_thrust_undo_each_other_at_any_voltage() {
    let airframe = Airframe::default();
    for voltage_share in [1.0, 0.8, 0.6] {
        for inflow in [0.0, 3.0] {
            let conditions = Conditions {
                voltage_share,
                ..CALM
            };
            let throttle = airframe.throttle_for(7.0, inflow, &conditions);
            let thrust = airframe.thrust_for(throttle, inflow, &conditions);
            assert!((thrust - 7.0).abs() < 1e-9, "{thrust}");
        }
    }
    let flat = Conditions {
        voltage_share: 0.05,
        ..CALM
    };
    assert!(
        airframe.thrust_for(1.0, 0.0, &flat) <= 0.0,
        "a dead battery lifts nothing"
    );
}

#[test]
fn a_motor_at_a_share_of_its_pulse_loses_more_than_that_share_of_its_thrust() {
    let airframe = Airframe::default();
    assert!((airframe.share_after_fault(0.39, 1.0) - 0.39).abs() < 1e-9);
    let left = airframe.share_after_fault(0.39, 0.7) / 0.39;
    assert!((left - 0.476).abs() < 0.01, "{left}");
    assert!(airframe.share_after_fault(1.0, 0.0) <= 0.0);
}

#[test]
fn faults_in_a_file_are_told_with_their_place() {
    for (text, line, column, what) in [
        (
            "{\n  \"mass\": -1\n}",
            2,
            3,
            "mass: -1 is not between 0.01 and 10000",
        ),
        (
            "{\"mass\": \"3\"}",
            1,
            2,
            "mass: expected a number, not \"3\"",
        ),
        (
            "{\n\"num_motors\": 5}",
            2,
            1,
            "num_motors: a frame has 4, 6, 8, 10 or 12 motors",
        ),
        (
            "{\"moment_inertia\": [1, 2]}",
            1,
            2,
            "moment_inertia: expected three numbers",
        ),
        (
            "{\"motor1_vector\": 1}",
            1,
            2,
            "motor1_vector: expected three numbers",
        ),
        (
            "{\"hoverThrOut\": 0}",
            1,
            2,
            "hoverThrOut: 0 is not between",
        ),
        (
            "{\"pwmMin\": 1950}",
            1,
            1,
            "pwmMax: must be at least 100 µs above pwmMin",
        ),
        (
            "{\"spin_min\": 0.95}",
            1,
            1,
            "spin_max: must be at least 0.05",
        ),
        (
            "{\"mass\": 100}",
            1,
            1,
            "refCurrent: refVoltage and refCurrent make",
        ),
        ("{\"mass\": 3,}", 1, 12, "not JSON: trailing comma"),
        ("{\"mass\": 1e999}", 1, 14, "not JSON: number out of range"),
        ("# only a comment\n", 2, 0, "not JSON: EOF"),
        ("[]", 1, 1, "a frame file is one JSON object"),
    ] {
        let error = Airframe::from_json(text).expect_err(text);
        assert!(error.what.starts_with(what), "{text}: {error}");
        assert_eq!(
            (error.line, error.column),
            (line, column),
            "{text}: {error}"
        );
    }
}

#[test]
fn fields_that_nobody_reads_are_warned_of() {
    let text = "{\"mass\": 3,\n \"colour\": 1, \"motor5_yaw\": 1, \"motor13_yaw\": 1}";
    let (_, warnings) = Airframe::from_json(text).expect("valid");
    let said: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        [
            "line 2, column 2: colour: not a field of a frame, ignored",
            "line 2, column 32: motor13_yaw: not a field of a frame, ignored",
            "line 2, column 15: motor5_yaw: the frame has 4 motors, ignored",
        ]
    );
}

/// Frame files with random values, if they can be loaded.
pub(crate) fn any_frame() -> impl Strategy<Value = Airframe> {
    let part = 0.0..=1.0_f64;
    (
        proptest::collection::vec(part, file::tests::RANGES),
        0..layout::COUNTS.len(),
        proptest::array::uniform3(0.0..10.0_f64),
    )
        .prop_filter_map("loads", |(parts, count, inertia)| {
            let text = file::tests::fields_at(&parts);
            let count = layout::COUNTS[count];
            let text =
                format!("{{{text}\"num_motors\": {count}, \"moment_inertia\": {inertia:?}}}");
            Airframe::from_json(&text).ok()
        })
        .prop_map(|(airframe, _)| airframe)
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in ".{0,200}") {
        let _ = Airframe::from_json(&text);
    }

    #[test]
    fn figures_that_load_give_finite_thrust_drag_and_current(
        airframe in any_frame(),
        share in 0.0..1.0_f64,
        speed in -100.0..100.0_f64,
        voltage_share in 0.0..2.0_f64,
    ) {
        let conditions = Conditions { voltage_share, ..CALM };
        for value in [
            airframe.thrust_max(speed, &conditions),
            airframe.throttle_for(share * 30.0, speed, &conditions),
            airframe.thrust_for(share, speed, &conditions),
            airframe.power_w(share * 30.0),
            airframe.momentum_drag(share * 30.0, 1.2),
            airframe.share_after_fault(share, 0.5),
            airframe.inertia_m2().min_element(),
        ] {
            prop_assert!(value.is_finite() && value >= 0.0, "{value} {airframe:?}");
        }
        prop_assert!(airframe.form_drag(DVec3::splat(speed), 1.2).is_finite());
        prop_assert!(airframe.inertia_m2().min_element() > 0.0);
    }
}
