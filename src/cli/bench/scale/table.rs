//! The figures as tables, beside the paper's.

use std::fmt::Write as _;

use super::figure::{PAPER_MODEL, PAPER_SIM, PAPER_US_PER_MESSAGE, slope};
use super::sample::Row;

/// Of what the tables are.
pub(super) struct Heading<'a> {
    pub backend: &'a str,
    pub seconds: f64,
    pub repeats: u16,
    pub cores: usize,
    /// Whether the simulator is an `ArduPilot`, of which others have measured the same.
    pub is_ardupilot: bool,
}

/// The tables, 80 columns wide at most.
pub(super) fn table(rows: &[Row], heading: &Heading<'_>) -> String {
    let mut text = String::new();
    let head = [
        format!(
            "Simulator: {}. {} s, median of {} repeat(s), {} core(s).",
            heading.backend, heading.seconds, heading.repeats, heading.cores
        ),
        "Streamed per drone: GLOBAL_POSITION_INT 10 Hz, ATTITUDE 10 Hz, HEARTBEAT 1 Hz;".to_owned(),
        "beside them TIMESYNC every 5 s. GUIDED, climbing to 200 m, 1 km to the north.".to_owned(),
    ];
    for line in head {
        line_end(&mut text, &line);
    }
    simulator(&mut text, rows, heading);
    model(&mut text, rows);
    quality(&mut text, rows);
    remarks(&mut text, rows);
    text
}

fn line_end(text: &mut String, line: &str) {
    text.push_str(line.trim_end());
    text.push('\n');
}

fn simulator(text: &mut String, rows: &[Row], heading: &Heading<'_>) {
    let [least, most] = PAPER_SIM;
    line_end(text, "\n1. Processor time of the simulator");
    line_end(
        text,
        "drones   CPU ms  % of a core  (least-most)   % per drone   paper, % per drone",
    );
    for row in flown(rows) {
        let [from, to] = row.sim_core_percent_range;
        let line = format!(
            "{:>6} {:>8.0} {:>12.2}  {:<14} {:>11}   {}",
            row.vehicles,
            row.sim_cpu_ms,
            row.sim_core_percent,
            format!("({from:.2}-{to:.2})"),
            optional(row.sim_core_percent_per_vehicle, 3),
            paper(row, &format!("{least} to {most}")),
        );
        line_end(text, &line);
    }
    further(text, rows, |row| row.sim_core_percent);
    if heading.is_ardupilot {
        line_end(
            text,
            "An ArduCopter 4.6 measured elsewhere on two cores: 3.06 % per drone, 8.1 MB.",
        );
    }
}

fn model(text: &mut String, rows: &[Row]) {
    let [least, most] = PAPER_MODEL;
    line_end(
        text,
        "\n2. Processor time of the console's model update (links, decoding, models)",
    );
    line_end(
        text,
        "drones       ms  % of a core  % per drone  us/message   paper: % per drone, us",
    );
    for row in flown(rows) {
        let line = format!(
            "{:>6} {:>8.1} {:>12.3} {:>12} {:>11}   {}",
            row.vehicles,
            row.model_ms,
            row.model_percent,
            optional(row.model_percent_per_vehicle, 4),
            optional(row.us_per_message, 1),
            paper(row, &format!("{least} to {most}, {PAPER_US_PER_MESSAGE}")),
        );
        line_end(text, &line);
    }
    further(text, rows, |row| row.model_percent);
}

/// What is left when the cost that there is without any vehicle does not count.
fn further(text: &mut String, rows: &[Row], value: fn(&Row) -> f64) {
    let points: Vec<_> = flown(rows)
        .map(|row| (f64::from(row.vehicles), value(row)))
        .collect();
    if let Some(slope) = slope(&points) {
        let line =
            format!("Each further drone takes {slope:.4} % (the straight line that fits best).");
        line_end(text, &line);
    }
}

fn quality(text: &mut String, rows: &[Row]) {
    line_end(text, "\n3. Real time, messages and memory");
    line_end(
        text,
        "drones  x real time mean/min  messages/s  ATTITUDE gap p50/p99/max ms  MB/drone",
    );
    for row in flown(rows).filter(|row| row.vehicles > 0) {
        let factor = format!(
            "{} / {}",
            optional(row.realtime_factor, 4),
            optional(row.realtime_factor_min, 4)
        );
        let gaps = format!(
            "{:.0} / {:.0} / {:.0}",
            row.attitude_gap_p50_ms, row.attitude_gap_p99_ms, row.attitude_gap_max_ms
        );
        let memory = row.sim_memory_bytes_per_vehicle.map(|bytes| bytes / 1e6);
        let line = format!(
            "{:>6}  {factor:>20}  {:>10.1}  {gaps:>27}  {:>8}",
            row.vehicles,
            row.messages_per_s,
            optional(memory, 1),
        );
        line_end(text, &line);
    }
    let relays = flown(rows).filter_map(|row| row.relay_ms.zip(Some(row)));
    if let Some((relay_ms, row)) = relays.last() {
        let line = format!(
            "Not in 1 and 2: the hangar hands {} instances' bytes on for {:.2} % of a core.",
            row.vehicles,
            relay_ms / 10.0 / row.window_s.max(f64::EPSILON)
        );
        line_end(text, &line);
    }
    let busiest = flown(rows).map(|row| row.machine_busy_percent);
    let busiest = busiest.fold(0.0, f64::max);
    // Writing into a string does not fail.
    let _ = writeln!(
        text,
        "The machine, other programs included, was busy for up to {busiest:.0} % of its time."
    );
}

fn remarks(text: &mut String, rows: &[Row]) {
    for row in rows {
        for void in &row.void {
            line_end(
                text,
                &format!("{} drones: a repeat does not count: {void}", row.vehicles),
            );
        }
        if let Some(part) = &row.gave_way {
            line_end(
                text,
                &format!("{} drones: what gave way: {part}", row.vehicles),
            );
        }
    }
}

fn flown(rows: &[Row]) -> impl Iterator<Item = &Row> {
    rows.iter().filter(|row| row.repeats > 0)
}

/// The paper's figure where it has one: it went up to 32 drones.
fn paper(row: &Row, figure: &str) -> String {
    if (1..=32).contains(&row.vehicles) {
        figure.to_owned()
    } else {
        String::new()
    }
}

fn optional(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.decimals$}"))
}
