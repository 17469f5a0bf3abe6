//! One repeat's figures, and the row that the repeats of a count make.

use serde::Serialize;

use super::strain::{self, Strain};

/// What one repeat has measured.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Sample {
    pub window_s: f64,
    /// Processor time of the simulator.
    pub sim_ms: f64,
    /// Processor time of the console's model update: reading the links, decoding, and the vehicles' models.
    pub model_ms: f64,
    /// Processor time of the hangar, which hands the instances' bytes to the console.
    pub relay_ms: Option<f64>,
    /// Messages that reached the models.
    pub messages: u64,
    /// Pauses between two ATTITUDE messages of a vehicle.
    pub gaps: Gaps,
    /// Simulated seconds per second: the mean over the vehicles, and the slowest.
    pub factor: Option<(f64, f64)>,
    /// Resident memory of all simulator processes.
    pub memory_bytes: Option<u64>,
    pub strain: Strain,
    /// Why the repeat is no measurement of what it should be.
    pub void: Option<String>,
}

/// Pauses; 0 if there was none.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[expect(clippy::struct_field_names, reason = "the unit belongs into the name")]
pub(super) struct Gaps {
    pub p50_ms: f64,
    pub p99_ms: f64,
    pub max_ms: f64,
}

impl Gaps {
    /// Of these pauses, in milliseconds, in any order.
    pub fn of(mut gaps_ms: Vec<f64>) -> Self {
        gaps_ms.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let place = (share * gaps_ms.len() as f64).ceil() as usize;
            gaps_ms
                .get(place.saturating_sub(1))
                .copied()
                .unwrap_or_default()
        };
        Self {
            p50_ms: at(0.5),
            p99_ms: at(0.99),
            max_ms: at(1.0),
        }
    }
}

/// The figures of a count of vehicles: medians over its repeats. The first nine fields are what scripts rely on.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Row {
    pub vehicles: u16,
    pub window_s: f64,
    pub sim_cpu_ms: f64,
    pub sim_core_percent: f64,
    pub sim_core_percent_per_vehicle: Option<f64>,
    pub model_ms: f64,
    pub model_percent: f64,
    pub model_percent_per_vehicle: Option<f64>,
    pub realtime_factor: Option<f64>,
    pub realtime_factor_min: Option<f64>,
    /// Least and most of the repeats.
    pub sim_core_percent_range: [f64; 2],
    pub model_percent_range: [f64; 2],
    pub us_per_message: Option<f64>,
    pub messages_per_s: f64,
    pub messages_lost: u64,
    pub attitude_gap_p50_ms: f64,
    pub attitude_gap_p99_ms: f64,
    pub attitude_gap_max_ms: f64,
    pub relay_ms: Option<f64>,
    pub sim_memory_bytes_per_vehicle: Option<f64>,
    pub machine_busy_percent: f64,
    /// Repeats that the figures are of.
    pub repeats: usize,
    /// What was wrong with the others.
    pub void: Vec<String>,
    /// Which part of the machine or of the program could not keep up, if one could not.
    pub gave_way: Option<String>,
}

impl Row {
    /// The row of a count's repeats. Void repeats are left out as long as there is another one.
    pub fn of(vehicles: u16, samples: &[Sample]) -> Self {
        let good: Vec<&Sample> = samples.iter().filter(|s| s.void.is_none()).collect();
        let used = if good.is_empty() {
            samples.iter().collect()
        } else {
            good
        };
        let all = |value: &dyn Fn(&Sample) -> f64| used.iter().map(|s| value(s)).collect();
        let middle = |value: &dyn Fn(&Sample) -> f64| median(all(value));
        let some = |value: &dyn Fn(&Sample) -> Option<f64>| {
            let known: Option<Vec<f64>> = used.iter().map(|s| value(s)).collect();
            known.filter(|known| !known.is_empty()).map(median)
        };
        let each = |total: f64| (vehicles > 0).then(|| total / f64::from(vehicles));
        let sim = |s: &Sample| percent(s.sim_ms, s.window_s);
        let model = |s: &Sample| percent(s.model_ms, s.window_s);
        let per_message = |s: &Sample| {
            let has_messages = s.messages > 0;
            has_messages.then(|| s.model_ms * 1e3 / s.messages as f64)
        };
        Self {
            vehicles,
            window_s: middle(&|s| s.window_s),
            sim_cpu_ms: middle(&|s| s.sim_ms),
            sim_core_percent: middle(&sim),
            sim_core_percent_per_vehicle: each(middle(&sim)),
            model_ms: middle(&|s| s.model_ms),
            model_percent: middle(&model),
            model_percent_per_vehicle: each(middle(&model)),
            realtime_factor: some(&|s| s.factor.map(|(mean, _)| mean)),
            realtime_factor_min: some(&|s| s.factor.map(|(_, least)| least)),
            sim_core_percent_range: range(all(&sim)),
            model_percent_range: range(all(&model)),
            us_per_message: some(&per_message),
            messages_per_s: middle(&|s| s.messages as f64 / s.window_s.max(f64::EPSILON)),
            messages_lost: used.iter().map(|s| s.strain.lost()).max().unwrap_or(0),
            attitude_gap_p50_ms: middle(&|s| s.gaps.p50_ms),
            attitude_gap_p99_ms: middle(&|s| s.gaps.p99_ms),
            attitude_gap_max_ms: range(all(&|s| s.gaps.max_ms))[1],
            relay_ms: some(&|s| s.relay_ms),
            sim_memory_bytes_per_vehicle: some(&|s| s.memory_bytes.map(|bytes| bytes as f64))
                .and_then(each),
            machine_busy_percent: middle(&|s| s.strain.machine_busy_percent),
            repeats: used.len(),
            void: samples.iter().filter_map(|s| s.void.clone()).collect(),
            gave_way: samples.iter().find_map(strain::gave_way),
        }
    }

    /// Of a count whose vehicles did not even come up.
    pub fn never_flown(vehicles: u16, why: String) -> Self {
        Self {
            vehicles,
            gave_way: Some(why),
            ..Self::default()
        }
    }

    /// Whether there are figures, and they are of vehicles that flew.
    pub fn is_good(&self) -> bool {
        self.repeats > self.void.len() || (self.repeats > 0 && self.void.is_empty())
    }
}

fn percent(ms: f64, window_s: f64) -> f64 {
    ms / 10.0 / window_s.max(f64::EPSILON)
}

/// The middle one, or between the two middle ones; 0 of nothing.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    match values.len() {
        0 => 0.0,
        odd if odd % 2 == 1 => values[half],
        _ => f64::midpoint(values[half - 1], values[half]),
    }
}

fn range(values: Vec<f64>) -> [f64; 2] {
    let least = values.iter().copied().reduce(f64::min);
    let most = values.into_iter().reduce(f64::max);
    [least.unwrap_or_default(), most.unwrap_or_default()]
}
