use super::figure::slope;
use super::sample::{Gaps, Row, Sample};
use super::strain::Strain;
use super::{chart, svg, table};

fn sample(vehicles: u16, slowness: f64) -> Sample {
    let each = f64::from(vehicles);
    Sample {
        window_s: 20.0,
        sim_ms: (5.0 + 2.0 * each) * slowness,
        model_ms: (1.0 + 8.0 * each) * slowness,
        relay_ms: None,
        messages: 424 * u64::from(vehicles),
        gaps: Gaps {
            p50_ms: 100.0,
            p99_ms: 101.0,
            max_ms: 110.0,
        },
        factor: (vehicles > 0).then_some((1.0, 0.9998)),
        memory_bytes: None,
        strain: Strain {
            cores: 2,
            machine_busy_percent: 3.0,
            ..Strain::default()
        },
        void: None,
    }
}

fn rows() -> Vec<Row> {
    [0, 1, 2, 4, 8, 16, 32]
        .map(|vehicles| {
            let samples = [1.0, 1.3, 0.9].map(|slowness| sample(vehicles, slowness));
            Row::of(vehicles, &samples)
        })
        .into()
}

#[test]
fn the_median_counts_and_void_repeats_do_not() {
    let mut samples = vec![sample(4, 1.0), sample(4, 2.0), sample(4, 9.0)];
    assert!((Row::of(4, &samples).sim_cpu_ms - 26.0).abs() < 1e-9);
    samples[1].void = Some("1 of 4 vehicles did not move".to_owned());
    let row = Row::of(4, &samples);
    assert!((row.sim_cpu_ms - 65.0).abs() < 1e-9, "{row:?}");
    assert_eq!((row.repeats, row.void.len()), (2, 1));
    assert!(row.is_good());
    let void = Row::of(4, &samples[1..2]);
    assert!(!void.is_good());
    assert!(!Row::never_flown(4, "memory".to_owned()).is_good());
}

#[test]
fn shares_are_of_a_core_and_of_a_vehicle() {
    let row = Row::of(4, &[sample(4, 1.0)]);
    assert!((row.sim_core_percent - 13.0 / 200.0).abs() < 1e-9);
    assert_eq!(
        row.sim_core_percent_per_vehicle,
        Some(row.sim_core_percent / 4.0)
    );
    assert!((row.us_per_message.expect("messages") - 33_000.0 / 1696.0).abs() < 1e-9);
    let none = Row::of(0, &[sample(0, 1.0)]);
    assert_eq!(
        (none.model_percent_per_vehicle, none.us_per_message),
        (None, None)
    );
}

#[test]
fn a_further_vehicle_costs_what_the_line_rises() {
    let points = [(0.0, 0.5), (1.0, 0.7), (2.0, 0.9), (32.0, 6.9)];
    assert!(slope(&points).is_some_and(|slope| (slope - 0.2).abs() < 1e-9));
    assert_eq!((slope(&points[..1]), slope(&[])), (None, None));
}

#[test]
fn pauses_have_their_quantiles() {
    let gaps = Gaps::of((1..=100).rev().map(f64::from).collect());
    let expected = Gaps {
        p50_ms: 50.0,
        p99_ms: 99.0,
        max_ms: 100.0,
    };
    assert_eq!(gaps, expected);
    assert_eq!(Gaps::of(Vec::new()), Gaps::default());
}

#[test]
fn the_document_begins_with_what_scripts_rely_on() {
    let document = serde_json::to_string(&rows()).expect("it has no odd keys");
    let mut from = 0;
    for field in [
        "vehicles",
        "window_s",
        "sim_cpu_ms",
        "sim_core_percent",
        "sim_core_percent_per_vehicle",
        "model_ms",
        "model_percent",
        "model_percent_per_vehicle",
        "realtime_factor",
        "realtime_factor_min",
    ] {
        let at = document.find(&format!("\"{field}\":")).expect(field);
        assert!(at > from, "{field}");
        from = at;
    }
}

fn heading(is_ardupilot: bool) -> table::Heading<'static> {
    table::Heading {
        backend: "embedded",
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
    rows.push(Row::never_flown(
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
fn processes_have_memory_and_a_hangar() {
    let with_processes = Sample {
        memory_bytes: Some(32 * 8_100_000),
        relay_ms: Some(100.0),
        ..sample(32, 1.0)
    };
    let table = table::table(&[Row::of(32, &[with_processes])], &heading(true));
    for words in [
        "8.1\n",
        "32 instances' bytes on for 0.50 %",
        "3.06 % per drone",
    ] {
        assert!(table.contains(words), "{words:?} is not in\n{table}");
    }
}

#[test]
fn the_chart_fits_a_terminal() {
    let drawn = chart::chart(&rows(), false);
    assert!(
        drawn.lines().all(|line| line.chars().count() <= 80),
        "{drawn}"
    );
    insta::assert_snapshot!("chart", drawn);
}

#[test]
fn a_terminal_of_ascii_gets_ascii() {
    let drawn = chart::chart(&rows(), true);
    assert!(drawn.is_ascii() && drawn.contains('*'), "{drawn}");
}

#[test]
fn nothing_measured_can_be_drawn_and_printed() {
    let rows = [Row::never_flown(2, "no processes".to_owned())];
    assert!(table::table(&rows, &heading(false)).contains("no processes"));
    assert!(chart::chart(&rows, false).contains("Simulator"));
    assert!(svg::svg(&rows, "Nothing").is_ok());
}

#[test]
fn the_drawing_has_four_figures_with_their_units_and_is_well_formed() {
    let drawn = svg::svg(&rows(), "Processor time & drones").expect("it is drawn");
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
    let mut open: Vec<Option<&str>> = Vec::new();
    for tag in drawn.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').expect("a tag ends");
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        let name = tag.trim_start_matches('/').split([' ', '\n']).next();
        match tag {
            comment if comment.starts_with(['?', '!']) => {}
            end if end.starts_with('/') => assert_eq!(open.pop(), Some(name)),
            alone if alone.ends_with('/') => {}
            _ => open.push(name),
        }
    }
    assert!(open.is_empty(), "{open:?}");
}
