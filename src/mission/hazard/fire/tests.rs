use proptest::prelude::*;
use rand::SeedableRng;

use super::*;

const WEST_WIND: Wind = Wind {
    speed_m_s: 5.0,
    from_deg: 270.0,
};

fn windy() -> Weather {
    Weather {
        wind: WEST_WIND,
        ..Weather::CALM
    }
}

fn meadow(patches: &[FuelPatch]) -> FireGrid {
    let cell = FireCell {
        fuel: Fuel::Grass,
        state: CellState::Unburnt(0.0),
        pace: 1.0,
    };
    let mut grid = FireGrid {
        corner: [0.0, 0.0],
        columns: 40,
        rows: 21,
        side_m: 10.0,
        moisture: 0.05,
        embers: 0.0,
        cells: vec![cell; 40 * 21],
    };
    grid.cover(patches);
    grid
}

fn hazard(grid: FireGrid) -> FireHazard {
    FireHazard {
        grid,
        ignitions: vec![Ignition {
            at: [15.0, 105.0],
            time: Duration::ZERO,
            radius_m: 0.0,
        }],
        jitter_m: 0.0,
    }
}

fn burn(field: &mut dyn Field, seconds: u32, weather: &Weather) {
    for tick in 1..=seconds * 10 {
        field.step(TICK * tick, weather);
    }
}

fn released(patches: &[FuelPatch], seed: u64) -> Box<dyn Field> {
    hazard(meadow(patches)).release(&windy(), ChaCha8Rng::seed_from_u64(seed))
}

/// Grass with 5 % water in wind of 5 m/s: 0.05 + 0.1 * 5 = 0.55 m/s, and 0.27 of that against the wind.
#[test]
fn a_front_runs_with_the_wind_and_against_it_at_the_speeds_of_the_formula() {
    let mut grid = meadow(&[]);
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let at =
        |grid: &FireGrid, east: f64| grid.has_burnt(grid.index([east, 105.0]).expect("inside"));
    let start = grid.index([205.0, 105.0]).expect("inside");
    grid.ignite(start);
    for second in 1..=300 {
        grid.step(WEST_WIND, &mut random);
        let (ahead_m, behind_m) = (0.55 * f64::from(second), 0.148 * f64::from(second));
        // A cell catches fire when the front has reached its centre; each cell on the way adds at most one step.
        assert!(
            at(&grid, (205.0 + ahead_m * 0.93 - 10.0).max(205.0)),
            "{second} s"
        );
        assert!(!at(&grid, 205.0 + ahead_m + 10.0), "{second} s");
        assert!(
            at(&grid, (205.0 - behind_m * 0.93 + 10.0).min(205.0)),
            "{second} s"
        );
        assert!(!at(&grid, 205.0 - behind_m - 10.0), "{second} s");
    }
}

#[test]
fn no_fire_crosses_a_road_even_where_its_cells_only_touch() {
    let road = |area| FuelPatch {
        area,
        fuel: Fuel::Bare,
    };
    let straight = [road([100.0, 0.0, 110.0, 210.0])];
    let stairs: Vec<FuelPatch> = (0..21)
        .map(|row| {
            let (x, y) = (50.0 + 10.0 * f64::from(row), 10.0 * f64::from(row));
            road([x, y, x + 10.0, y + 10.0])
        })
        .collect();
    for (patches, far) in [
        (&straight[..], [115.0, 105.0]),
        (&stairs[..], [255.0, 155.0]),
    ] {
        let mut field = released(patches, 3);
        burn(field.as_mut(), 900, &windy());
        let fire = field.fire().expect("it is one");
        let cell = fire.grid().index(far).expect("inside");
        assert!(!fire.grid().has_burnt(cell), "{far:?}");
        assert!(fire.grid().burnt() > 50);
    }
}

#[test]
fn the_same_seed_burns_the_same_and_another_one_otherwise() {
    let burnt = |seed| {
        let mut field = released(&[], seed);
        burn(field.as_mut(), 240, &windy());
        format!("{:?}", field.truth())
    };
    assert_eq!(burnt(5), burnt(5));
    assert_ne!(burnt(5), burnt(6));
}

#[test]
fn a_wet_line_from_road_to_road_holds_the_fire_and_the_untouched_one_runs_on() {
    let mut field = released(&[], 2);
    for row in 0..21 {
        let at = [155.0, 5.0 + 10.0 * f64::from(row)];
        assert!(field.affect(Load::Spray, at).expect("it is there").good);
    }
    burn(field.as_mut(), 900, &windy());
    let fire = field.fire().expect("it is one");
    let beyond = |grid: &FireGrid| grid.has_burnt(grid.index([205.0, 105.0]).expect("inside"));
    assert!(!beyond(fire.grid()));
    assert!(beyond(fire.untouched()));
    assert!(fire.grid().burnt() < fire.untouched().burnt());
    assert!(fire.is_out());
}

#[test]
fn balls_put_out_flames_nine_times_in_ten_and_do_nothing_elsewhere() {
    let mut out = 0;
    for seed in 0..300 {
        let mut field = released(&[], seed);
        let flames = [15.0, 105.0];
        out += u32::from(field.affect(Load::Ball, flames).expect("it is there").good);
        assert!(
            !field
                .affect(Load::Ball, [305.0, 55.0])
                .expect("it is there")
                .good
        );
        assert!(field.affect(Load::Ball, [-50.0, 0.0]).is_none());
        assert!(field.affect(Load::Kit, flames).is_none());
    }
    assert!((255..=285).contains(&out), "{out}");
}

#[test]
fn detectors_see_one_fire_for_each_block_that_burns_and_smoke_drifts_from_it() {
    let mut field = released(&[], 1);
    let count = field.objects().len();
    burn(field.as_mut(), 60, &windy());
    assert_eq!(field.objects().len(), count);
    let seen: Vec<&Object> = field
        .objects()
        .iter()
        .filter(|object| object.present)
        .collect();
    assert!(!seen.is_empty() && seen.len() < 10);
    assert!(field.amount(Quantity::Particles, [115.0, 105.0], 10.0) > 100.0);
    assert!(field.amount(Quantity::Particles, [115.0, 5.0], 10.0) < 1.0);
}

#[test]
fn a_later_ignition_waits_for_its_time() {
    let mut hazard = hazard(meadow(&[]));
    hazard.ignitions[0].time = Duration::from_secs(30);
    let mut field = hazard.release(&windy(), ChaCha8Rng::seed_from_u64(1));
    burn(field.as_mut(), 29, &windy());
    let burnt = |field: &dyn Field| {
        field
            .fire()
            .map(|fire| (fire.grid().burnt(), fire.is_out()))
    };
    assert_eq!(burnt(field.as_ref()), Some((0, false)));
    for tick in 291..=310 {
        field.step(TICK * tick, &windy());
    }
    assert_eq!(burnt(field.as_ref()), Some((1, false)));
}

proptest! {
    #[test]
    fn burnt_ground_never_grows_back(seed in 0_u64..1000, from_deg in 0.0_f64..360.0) {
        let weather = Weather { wind: Wind { from_deg, ..WEST_WIND }, ..Weather::CALM };
        let mut field = released(&[], seed);
        let mut before = 0;
        for second in 1..=120 {
            burn(field.as_mut(), 1, &weather);
            let burnt = field.fire().map_or(0, |fire| fire.grid().burnt());
            prop_assert!(burnt >= before && burnt > 0, "{second}");
            before = burnt;
        }
    }
}
