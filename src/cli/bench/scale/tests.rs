use std::time::{Duration, Instant};

use super::row::ScaleRow;
use super::sample::{ScaleMark, ScaleSample};
use super::{chart, svg, table};
use crate::cli::bench::cost::Machine;

fn sample(vehicles: u16, slowness: f64) -> ScaleSample {
    let each = f64::from(vehicles);
    ScaleSample {
        window_s: 20.0,
        sim_ms: (5.0 + 2.0 * each) * slowness,
        model_ms: (1.0 + 8.0 * each) * slowness,
        messages: 424 * u64::from(vehicles),
        factor: (vehicles > 0).then_some((1.0, 0.9998)),
        machine_busy_percent: 3.0,
        ..ScaleSample::default()
    }
}

fn rows() -> Vec<ScaleRow> {
    let row = |vehicles| ScaleRow::of(vehicles, &[1.0, 1.3, 0.9].map(|s| sample(vehicles, s)));
    [0, 1, 2, 4, 8, 16, 32].map(row).into()
}

fn mark(at_ms: u64, clocks_ms: [Option<u32>; 2]) -> ScaleMark {
    let passed = Duration::from_millis(at_ms);
    ScaleMark {
        at: Instant::now() + passed,
        sim: vec![passed / 10, passed / 2],
        model: vec![passed / 100],
        relay: None,
        messages: at_ms,
        missing: at_ms / 10,
        missing_before: at_ms / 50,
        clocks: clocks_ms.map(|clock| Some((clock?, passed))).into(),
        machine: Machine::default(),
    }
}

#[test]
fn what_is_measured_is_what_the_meters_rose_by() {
    let before = mark(1000, [Some(70_000), Some(500)]);
    let sample = ScaleSample::between(&before, &mark(3000, [Some(72_000), Some(2300)]));
    let near =
        |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 1e-3, "{sample:?}");
    near(sample.window_s, 2.0);
    near(sample.sim_ms, 1200.0);
    near(sample.sim_most_percent, 50.0);
    near(sample.model_ms, 20.0);
    let (mean, least) = sample.factor.expect("two vehicles");
    near(mean, 0.95);
    near(least, 0.9);
    let lost = (sample.messages, sample.lost_in_console, sample.lost_before);
    assert_eq!(lost, (2000, 160, 40));
    let nothing = ScaleMark {
        sim: Vec::new(),
        ..mark(3000, [None; 2])
    };
    let nothing = ScaleSample::between(&nothing, &nothing).sim_ms;
    assert!(nothing.is_sign_positive(), "0, and not {nothing}");
    let silent = ScaleSample::between(&before, &mark(3000, [Some(72_000), None]));
    assert_eq!(
        silent.factor,
        Some((0.5, 0.0)),
        "a silent vehicle stands still"
    );
}

#[test]
fn the_median_counts_and_void_repeats_do_not() {
    let mut samples = vec![sample(4, 1.0), sample(4, 2.0), sample(4, 9.0)];
    assert!((ScaleRow::of(4, &samples).sim_cpu_ms - 26.0).abs() < 1e-9);
    samples[1].void = Some("1 of 4 vehicles did not move".to_owned());
    let row = ScaleRow::of(4, &samples);
    assert!((row.sim_cpu_ms - 65.0).abs() < 1e-9, "{row:?}");
    assert_eq!((row.repeats, row.void.len()), (2, 1));
    let void = ScaleRow::of(4, &samples[1..2]);
    assert_eq!((void.repeats, void.sim_core_percent_per_vehicle), (0, None));
    assert_eq!(ScaleRow::never_flown(4, "memory".to_owned()).repeats, 0);
}

#[test]
fn shares_are_of_a_core_and_of_a_vehicle() {
    let row = ScaleRow::of(4, &[sample(4, 1.0)]);
    assert!((row.sim_core_percent - 13.0 / 200.0).abs() < 1e-9);
    assert_eq!(
        row.sim_core_percent_per_vehicle,
        Some(row.sim_core_percent / 4.0)
    );
    assert!((row.us_per_message.expect("messages") - 33_000.0 / 1696.0).abs() < 1e-9);
    let none = ScaleRow::of(0, &[sample(0, 1.0)]);
    assert_eq!(
        (none.model_percent_per_vehicle, none.us_per_message),
        (None, None)
    );
}

#[test]
fn the_document_begins_with_what_scripts_rely_on() {
    let document = serde_json::to_string(&rows()).expect("it has no odd keys");
    let fields = "vehicles window_s sim_cpu_ms sim_core_percent sim_core_percent_per_vehicle model_ms model_percent \
                  model_percent_per_vehicle realtime_factor";
    let mut from = 0;
    for field in fields.split(' ') {
        let at = document.find(&format!("\"{field}\":")).expect(field);
        assert!(at > from, "{field}");
        from = at;
    }
}

fn heading(is_ardupilot: bool) -> table::ScaleHeading<'static> {
    table::ScaleHeading {
        simulator: "embedded",
        seconds: 20.0,
        repeats: 3,
        cores: 2,
        is_ardupilot,
    }
}

#[test]
fn the_tables_stand_beside_the_papers() {
    let mut rows = rows();
    rows[6].gave_way = Some("0.900 of real time: processor time".to_owned());
    rows.push(ScaleRow::never_flown(
        64,
        "40 of 64 vehicles could be armed".to_owned(),
    ));
    let table = table::table(&rows, &heading(false));
    assert!(
        table.lines().all(|line| line.chars().count() <= 80),
        "{table}"
    );
    insta::assert_snapshot!("tables", table);
}

#[test]
fn processes_have_a_hangar() {
    let with_processes = ScaleSample {
        relay_ms: Some(100.0),
        ..sample(32, 1.0)
    };
    let table = table::table(&[ScaleRow::of(32, &[with_processes])], &heading(true));
    for words in ["32 instances' bytes with 0.50 %", "3.06 % per drone"] {
        assert!(table.contains(words), "{words:?} is not in\n{table}");
    }
}

#[test]
fn the_chart_fits_a_terminal_and_one_of_ascii_gets_ascii() {
    let drawn = chart::chart(&rows(), false);
    assert!(
        drawn.lines().all(|line| line.chars().count() <= 80),
        "{drawn}"
    );
    insta::assert_snapshot!("chart", drawn);
    let drawn = chart::chart(&rows(), true);
    assert!(drawn.is_ascii() && drawn.contains('*'), "{drawn}");
}

#[test]
fn nothing_measured_can_be_drawn_and_printed() {
    let rows = [ScaleRow::never_flown(2, "no processes".to_owned())];
    assert!(table::table(&rows, &heading(false)).contains("no processes"));
    assert!(chart::chart(&rows, false).contains("Simulator"));
    assert!(svg::svg(&rows, "Nothing").ends_with("</svg>\n"));
}

#[test]
fn the_drawing_has_four_figures_with_their_units() {
    let drawn = svg::svg(&rows(), "Processor time & drones");
    for title in [
        "Simulator, % of a core",
        "Simulator, % of a core per drone",
        "Model update, % of a core",
        "Model update, % of a core per drone",
    ] {
        assert!(drawn.contains(title), "{title}");
    }
    assert_eq!(drawn.matches("measured here").count(), 4);
    assert_eq!(drawn.matches("the paper, least and most").count(), 4);
    assert!(drawn.contains("Processor time &amp; drones"));
}
