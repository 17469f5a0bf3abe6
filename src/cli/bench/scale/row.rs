//! The table row for all repeats with one number of vehicles.

use serde::Serialize;

use super::sample::{ScaleSample, percent};
use super::strain;

/// The figures for a number of vehicles: medians over its repeats, except the lost messages, which
/// are the maximum. Scripts rely on the first nine fields.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct ScaleRow {
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
    pub us_per_message: Option<f64>,
    pub messages_per_s: f64,
    pub messages_lost: u64,
    /// The share of a core that the hangar used, in percent; neither the simulator's nor the model
    /// update's figures include it.
    pub relay_percent: Option<f64>,
    pub machine_busy_percent: f64,
    /// The number of repeats behind the figures.
    pub repeats: usize,
    /// The faults of the invalid repeats.
    pub void: Vec<String>,
    /// The part of the machine or of the program that could not keep up, if any.
    pub gave_way: Option<String>,
}

impl ScaleRow {
    /// The row for all repeats with one number of vehicles; invalid repeats do not count.
    pub fn of(vehicles: u16, samples: &[ScaleSample]) -> Self {
        let used: Vec<&ScaleSample> = samples.iter().filter(|s| s.void.is_none()).collect();
        let some = |value: &dyn Fn(&ScaleSample) -> Option<f64>| {
            median(used.iter().filter_map(|s| value(s)).collect())
        };
        let middle = |value: &dyn Fn(&ScaleSample) -> f64| some(&|s| Some(value(s))).unwrap_or(0.0);
        let each =
            |total: f64| (vehicles > 0 && !used.is_empty()).then(|| total / f64::from(vehicles));
        let sim = middle(&|s| percent(s.sim_ms, s.window_s));
        let model = middle(&|s| percent(s.model_ms, s.window_s));
        let per_message =
            |s: &ScaleSample| (s.messages > 0).then(|| s.model_ms * 1e3 / s.messages as f64);
        let lost = used.iter().map(|s| s.lost_in_console + s.lost_before);
        Self {
            vehicles,
            window_s: middle(&|s| s.window_s),
            sim_cpu_ms: middle(&|s| s.sim_ms),
            sim_core_percent: sim,
            sim_core_percent_per_vehicle: each(sim),
            model_ms: middle(&|s| s.model_ms),
            model_percent: model,
            model_percent_per_vehicle: each(model),
            realtime_factor: some(&|s| s.factor.map(|(mean, _)| mean)),
            realtime_factor_min: some(&|s| s.factor.map(|(_, least)| least)),
            us_per_message: some(&per_message),
            messages_per_s: middle(&|s| s.messages as f64 / s.window_s.max(f64::EPSILON)),
            messages_lost: lost.max().unwrap_or(0),
            relay_percent: some(&|s| Some(percent(s.relay_ms?, s.window_s))),
            machine_busy_percent: middle(&|s| s.machine_busy_percent),
            repeats: used.len(),
            void: samples.iter().filter_map(|s| s.void.clone()).collect(),
            gave_way: samples.iter().find_map(strain::gave_way),
        }
    }

    /// The row for a number of vehicles that did not start.
    pub fn never_flown(vehicles: u16, why: String) -> Self {
        Self {
            vehicles,
            gave_way: Some(why),
            ..Self::default()
        }
    }
}

/// The middle value, or the mean of the two middle values.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = *values.get(values.len() / 2)?;
    let lower = values[(values.len() - 1) / 2];
    Some(f64::midpoint(lower, upper))
}
