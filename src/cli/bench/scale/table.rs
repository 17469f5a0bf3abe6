//! The figures as tables, beside the paper's.

use super::figure::{PAPER_MODEL, PAPER_SIM, PAPER_US_PER_MESSAGE};
use super::row::ScaleRow;

/// The subject of the tables.
pub(super) struct ScaleHeading<'a> {
    pub simulator: &'a str,
    pub seconds: f64,
    pub repeats: u16,
    pub cores: usize,
    /// Whether the simulator is `ArduPilot`, for which the paper has figures.
    pub is_ardupilot: bool,
}

/// The tables, at most 80 columns wide except for remarks on single repeats.
pub(super) fn table(rows: &[ScaleRow], heading: &ScaleHeading<'_>) -> String {
    let flown = || rows.iter().filter(|row| row.repeats > 0);
    let mut lines = vec![
        format!("Simulator: {}.", heading.simulator),
        format!(
            "{} s, median of {} repeat(s), {} core(s).",
            heading.seconds, heading.repeats, heading.cores
        ),
        "Streamed per drone: GLOBAL_POSITION_INT 10 Hz, ATTITUDE 10 Hz, HEARTBEAT 1 Hz;".to_owned(),
        "also TIMESYNC every 5 s. GUIDED, climbing to 200 m, 1 km to the north.".to_owned(),
        "\n1. Processor time of the simulator".to_owned(),
        "drones   CPU ms  % of a core  % per drone  paper: % per drone   x real time".to_owned(),
    ];
    lines.extend(flown().map(simulator));
    if heading.is_ardupilot {
        let others = "An ArduCopter 4.6 measured elsewhere on two cores: 3.06 % per drone.";
        lines.push(others.to_owned());
    }
    lines.extend(
        [
            "\n2. Processor time of the console's model update (links, decoding, models)",
            "drones   CPU ms  % of a core  % per drone  paper: % per drone  us/message  paper",
        ]
        .map(str::to_owned),
    );
    lines.extend(flown().map(model));
    lines.push(String::new());
    if let Some((percent, row)) = flown()
        .filter_map(|row| Some((row.relay_percent?, row)))
        .next_back()
    {
        let vehicles = row.vehicles;
        lines.push(format!(
            "Not in 1 and 2: the hangar passes on {vehicles} instances' bytes with {percent:.2} % of a core."
        ));
    }
    let busiest = flown()
        .map(|row| row.machine_busy_percent)
        .fold(0.0, f64::max);
    lines.push(format!(
        "The machine, other programs included, was busy for up to {busiest:.0} % of its time."
    ));
    for row in rows {
        let vehicles = row.vehicles;
        let voids = row.void.iter();
        lines.extend(voids.map(|why| format!("{vehicles} drones: a repeat does not count: {why}")));
        let gave_way = row.gave_way.iter();
        lines.extend(gave_way.map(|part| format!("{vehicles} drones: overloaded: {part}")));
    }
    lines.push(String::new());
    lines.join("\n")
}

fn simulator(row: &ScaleRow) -> String {
    let [least, most] = PAPER_SIM;
    format!(
        "{:>6} {:>8.0} {:>12.2} {:>12} {:>19} {:>13}",
        row.vehicles,
        row.sim_cpu_ms,
        row.sim_core_percent,
        optional(row.sim_core_percent_per_vehicle, 3),
        paper(row, format!("{least} to {most}")),
        optional(row.realtime_factor, 3),
    )
}

fn model(row: &ScaleRow) -> String {
    let [least, most] = PAPER_MODEL;
    format!(
        "{:>6} {:>8.1} {:>12.3} {:>12} {:>19} {:>11} {:>6}",
        row.vehicles,
        row.model_ms,
        row.model_percent,
        optional(row.model_percent_per_vehicle, 4),
        paper(row, format!("{least} to {most}")),
        optional(row.us_per_message, 1),
        paper(row, PAPER_US_PER_MESSAGE.to_string()),
    )
}

/// The paper's figure; `-` beyond the 1 to 32 drones that the paper measured.
fn paper(row: &ScaleRow, figure: String) -> String {
    if (1..=32).contains(&row.vehicles) {
        figure
    } else {
        "-".to_owned()
    }
}

fn optional(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.decimals$}"))
}
