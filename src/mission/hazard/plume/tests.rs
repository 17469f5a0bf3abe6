use proptest::prelude::*;
use rand::SeedableRng;

use super::*;
use crate::geo::maths;
use crate::mission::hazard::dispersion::{Stability, Terrain};
use crate::mission::hazard::gaussian::{Plume, UG_PER_G};

const WEST_WIND: Wind = Wind {
    speed_m_s: 4.0,
    from_deg: 270.0,
};

fn plume(stability: Stability) -> Plume {
    Plume {
        source: [0.0, 0.0],
        height_m: 15.0,
        rate_g_s: 1.0,
        stability,
        terrain: Terrain::Open,
    }
}

fn field(meander_deg: f64, intermittency: f64, wind: Wind, seed: u64) -> Box<dyn Field> {
    let hazard = PlumeHazard {
        leak: LeakPlan::steady(plume(Stability::D)),
        meander_deg,
        intermittency,
    };
    let weather = Weather {
        wind,
        ..Weather::CALM
    };
    hazard.release(&weather, ChaCha8Rng::seed_from_u64(seed))
}

/// The concentration below the plume's axis, at 20 m, for a release of 1 g/s at 15 m in 4 m/s.
#[test]
fn the_centreline_has_the_concentrations_of_the_formula() {
    use Stability::{A, B, C, D, E, F};
    for (class, expected) in [
        (A, [320.8, 107.7, 38.2, 11.0, 2.9]),
        (B, [587.2, 193.9, 69.3, 23.3, 6.5]),
        (C, [827.7, 376.1, 120.3, 45.3, 14.5]),
        (D, [774.4, 599.3, 214.1, 76.7, 30.9]),
        (E, [29.4, 524.3, 400.5, 142.3, 51.7]),
        (F, [0.0, 36.2, 422.1, 302.7, 111.7]),
    ] {
        for (x, expected) in [50.0, 100.0, 200.0, 400.0, 800.0].into_iter().zip(expected) {
            let value = plume(class).concentration_ug_m3(WEST_WIND, [x, 0.0], 20.0);
            assert!(
                (value - expected).abs() < 0.06,
                "{class:?} at {x} m: {value} instead of {expected}"
            );
        }
    }
}

#[test]
fn the_plume_lies_downwind_and_is_symmetric() {
    let plume = plume(Stability::D);
    let at = |at| plume.concentration_ug_m3(WEST_WIND, at, 15.0);
    assert!(at([-1.0, 0.0]).abs() < 1e-12);
    assert!((at([100.0, 12.0]) - at([100.0, -12.0])).abs() < 1e-9);
    assert!(at([100.0, 12.0]) < at([100.0, 0.0]));
}

#[test]
fn what_passes_through_a_plane_across_the_wind_is_what_comes_out() {
    let plume = plume(Stability::C);
    let mut flow_ug_s = 0.0;
    for y in -100..100 {
        for z in 0..150 {
            let at = [200.0, f64::from(y) + 0.5];
            flow_ug_s += 4.0 * plume.concentration_ug_m3(WEST_WIND, at, f64::from(z) + 0.5);
        }
    }
    assert!((flow_ug_s / UG_PER_G - 1.0).abs() < 0.005, "{flow_ug_s}");
}

/// The formula for calm air, for class D at the height of the source and far above its image, gives 1e6 / ((2 pi)^1.5
/// 0.113) / R2 = 5.62e5 / R2, and the image adds a little.
#[test]
fn in_calm_air_the_cloud_is_round_and_falls_with_the_square_of_the_distance() {
    let plume = plume(Stability::D);
    let calm = Weather::CALM.wind;
    let at = |at| plume.concentration_ug_m3(calm, at, 15.0);
    assert!((at([20.0, 0.0]) - at([0.0, -20.0])).abs() < 1e-9);
    assert!(
        (at([10.0, 0.0]) / 5654.8 - 1.0).abs() < 1e-4,
        "{}",
        at([10.0, 0.0])
    );
    assert!((at([20.0, 0.0]) * 4.0 / at([10.0, 0.0]) - 1.0).abs() < 0.03);
}

#[test]
fn the_plume_follows_a_wind_that_turns() {
    let mut field = field(0.0, 0.0, WEST_WIND, 1);
    let north = Weather {
        wind: Wind {
            from_deg: 0.0,
            ..WEST_WIND
        },
        ..Weather::CALM
    };
    assert!(field.amount(Quantity::Vapour, [100.0, 0.0], 15.0) > 100.0);
    for tick in 1..=1200 {
        field.step(TICK * tick, &north);
    }
    assert!(field.amount(Quantity::Vapour, [0.0, -100.0], 15.0) > 100.0);
    assert!(field.amount(Quantity::Vapour, [100.0, 0.0], 15.0) < 1e-6);
    assert!(field.amount(Quantity::Particles, [0.0, -100.0], 15.0).abs() < 1e-12);
}

#[test]
fn gusts_keep_the_mean_and_spread_as_a_lognormal_does() {
    let weather = Weather {
        wind: WEST_WIND,
        ..Weather::CALM
    };
    let steady = field(0.0, 0.0, WEST_WIND, 1).amount(Quantity::Vapour, [40.0, 0.0], 15.0);
    let mut gusty = field(0.0, 0.6, WEST_WIND, 1);
    let mut ratios = Vec::new();
    for tick in 1..=60_000 {
        gusty.step(TICK * tick, &weather);
        ratios.push(gusty.amount(Quantity::Vapour, [40.0, 0.0], 15.0) / steady);
    }
    let count = ratios.len() as f64;
    let mean = ratios.iter().sum::<f64>() / count;
    let logs: Vec<f64> = ratios.iter().map(|ratio| maths::ln(*ratio)).collect();
    let log_mean = logs.iter().sum::<f64>() / count;
    let spread = (logs
        .iter()
        .map(|log| maths::powi(log - log_mean, 2))
        .sum::<f64>()
        / count)
        .sqrt();
    assert!((mean - 1.0).abs() < 0.06, "{mean}");
    assert!((spread - 0.6).abs() < 0.04, "{spread}");
}

#[test]
fn equal_seeds_give_equal_plumes() {
    let run = |seed| {
        let mut field = field(10.0, 0.6, WEST_WIND, seed);
        let weather = Weather {
            wind: WEST_WIND,
            ..Weather::CALM
        };
        for tick in 1..=300 {
            field.step(TICK * tick, &weather);
        }
        field.amount(Quantity::Vapour, [60.0, 3.0], 15.0).to_bits()
    };
    assert_eq!(run(4), run(4));
    assert_ne!(run(4), run(5));
}

proptest! {
    #[test]
    fn a_concentration_is_finite_and_never_negative(
        east in -2000.0_f64..2000.0,
        north in -2000.0_f64..2000.0,
        height in 0.0_f64..200.0,
        speed in 0.0_f64..20.0,
        from in 0.0_f64..360.0,
    ) {
        let wind = Wind { speed_m_s: speed, from_deg: from };
        let value = plume(Stability::F).concentration_ug_m3(wind, [east, north], height);
        prop_assert!(value.is_finite() && value >= 0.0);
    }
}
