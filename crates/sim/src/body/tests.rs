use proptest::prelude::*;

use super::*;
use crate::airframe::Conditions;
use crate::airframe::tests::any_frame;
use crate::upset::MotorFault;
use sortie_geo::maths;

const CALM: Conditions = Conditions {
    wind_m_s: DVec3::ZERO,
    air_density: 1.156_8,
    voltage_share: 1.0,
};

fn drive<'a>(airframe: &'a Airframe, conditions: &'a Conditions) -> Drive<'a> {
    Drive {
        airframe,
        conditions,
        fault: None,
        wrecked: false,
    }
}

fn flying(height_m: f64, velocity_m_s: DVec3) -> Body {
    let mut body = Body::resting(30.0);
    body.position_m.z = -height_m;
    body.velocity_m_s = velocity_m_s;
    body.on_ground = false;
    body
}

/// The energy per mass, relative to the ground.
fn energy(body: &Body) -> f64 {
    0.5 * body.velocity_m_s.length_squared() + GRAVITY_M_S2 * body.height_m()
}

fn any_velocity() -> impl Strategy<Value = DVec3> {
    proptest::array::uniform3(-40.0..40.0_f64).prop_map(DVec3::from_array)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn without_power_no_energy_is_made(
        airframe in any_frame(),
        velocity in any_velocity(),
        hit in proptest::option::of(any_velocity()),
        height in 0.1..200.0_f64,
    ) {
        let mut body = flying(height, velocity);
        if let Some(change) = hit {
            body.hit(change);
        }
        let mut before = energy(&body);
        for _ in 0..600 {
            body.step(Demand::Off, &drive(&airframe, &CALM));
            let now = energy(&body);
            prop_assert!(now <= before + 1e-9, "{before} {now} {body:?}");
            prop_assert!(body.position_m.z <= 0.0 && body.position_m.is_finite());
            before = now;
        }
    }

    #[test]
    fn with_power_no_more_energy_is_made_than_the_thrust_does_work(
        velocity in any_velocity(),
        demands in proptest::collection::vec(any_velocity(), 1..20),
        fault in proptest::option::of((0..4_usize, 0.0..1.0_f64)),
    ) {
        let airframe = Airframe::default();
        let mut body = flying(50.0, velocity);
        let fault = fault.map(|(motor, multiplier)| MotorFault { motor, multiplier });
        for demand in demands {
            for _ in 0..50 {
                let before = energy(&body);
                let was = body.velocity_m_s.length();
                let drive = Drive { fault, ..drive(&airframe, &CALM) };
                body.step(Demand::Acceleration(demand), &drive);
                // The motors of a tumbling vehicle move faster than its centre.
                let tumbling = body.upset.as_ref().map_or(0.0, |upset| upset.rates_rad_s.length());
                let speed = was.max(body.velocity_m_s.length()) + 0.35 * tumbling;
                let work = body.thrust_m_s2 * speed * STEP_S;
                let now = energy(&body);
                prop_assert!(now - before <= work + 1e-6, "{before} {now} {work} {body:?}");
                prop_assert!(body.position_m.z <= 0.0);
            }
        }
    }

    #[test]
    fn nothing_makes_the_body_lose_its_numbers(
        airframe in any_frame(),
        start in (any_velocity(), any_velocity()),
        demand in any_velocity(),
        fault in proptest::option::of((0..16_usize, -10.0..10.0_f64)),
        air in (0.05..1.8_f64, 0.0..2.0_f64),
    ) {
        let conditions = Conditions {
            wind_m_s: start.1,
            air_density: air.0,
            voltage_share: air.1,
        };
        let mut body = flying(20.0, start.0);
        let fault = fault.map(|(motor, multiplier)| MotorFault { motor, multiplier });
        for step in 0..400 {
            let drive = Drive { fault, ..drive(&airframe, &conditions) };
            let asked = match step / 100 {
                0 | 2 => Demand::Acceleration(demand),
                1 => Demand::Throttle {
                    share: demand.x.abs() / 40.0,
                    lean_m_s2: DVec2::ZERO,
                },
                _ => Demand::Off,
            };
            body.turn(demand.y);
            body.step(asked, &drive);
            let (roll, pitch) = body.roll_pitch_rad();
            prop_assert!(body.position_m.is_finite() && body.velocity_m_s.is_finite(), "{body:?}");
            prop_assert!(body.position_m.z <= 0.0, "{body:?}");
            prop_assert!(roll.is_finite() && pitch.is_finite() && body.yaw_deg.is_finite());
            prop_assert!((0.0..=1.0).contains(&body.throttle) && body.thrust_m_s2 >= 0.0);
        }
    }
}

#[test]
fn a_wreck_tumbles_and_does_not_rise_again() {
    let airframe = Airframe::default();
    let mut body = flying(20.0, DVec3::new(5.0, 0.0, 0.0));
    body.hit(DVec3::new(-6.0, 0.0, 0.0));
    let mut most_lean: f64 = 0.0;
    let mut impact = None;
    for _ in 0..500 {
        let up = Demand::Acceleration(DVec3::new(0.0, 0.0, -5.0));
        impact = impact.or(body.step(up, &drive(&airframe, &CALM)));
        let (roll, pitch) = body.roll_pitch_rad();
        most_lean = most_lean.max(maths::acos(maths::cos(roll) * maths::cos(pitch)));
    }
    assert!(impact.is_some_and(|speed| speed > 10.0), "{impact:?}");
    assert!(
        body.on_ground && body.wrecked && most_lean > 1.5,
        "{body:?}"
    );
    assert!(body.thrust_m_s2.abs() < 1e-12);
}
