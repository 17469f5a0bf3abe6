//! The measurements of one repeat.

use std::ops::Add as _;
use std::time::{Duration, Instant};

use crate::cli::bench::cost::{self, Machine};

/// The state of all meters.
#[derive(Debug)]
pub(super) struct ScaleMark {
    pub at: Instant,
    /// Processor time of each thread or process of the simulator.
    pub sim: Vec<Duration>,
    /// Processor time of each thread of the console's model update: reading the links, decoding, and the vehicles'
    /// models.
    pub model: Vec<Duration>,
    /// Processor time of the hangar, which passes the instances' bytes to the console.
    pub relay: Option<Duration>,
    /// Messages that have reached the models.
    pub messages: u64,
    /// Messages missing in the models.
    pub missing: u64,
    /// The part of [`Self::missing`] that was already lost on the links.
    pub missing_before: u64,
    /// Each vehicle's clock in milliseconds, and when it was read.
    pub clocks: Vec<Option<(u32, Duration)>>,
    pub machine: Machine,
}

/// The measurements of one repeat.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct ScaleSample {
    pub window_s: f64,
    pub sim_ms: f64,
    pub model_ms: f64,
    pub relay_ms: Option<f64>,
    /// The share of a core that the simulator's busiest thread or process used.
    pub sim_most_percent: f64,
    /// The share of a core that the busiest thread of the model update used.
    pub model_most_percent: f64,
    pub messages: u64,
    /// Messages that the console's queues dropped.
    pub lost_in_console: u64,
    /// Messages that never reached the console.
    pub lost_before: u64,
    /// Simulated seconds per second: the mean over the vehicles, and the slowest.
    pub factor: Option<(f64, f64)>,
    /// Share of all processors that was busy, other programs included.
    pub machine_busy_percent: f64,
    /// Share of the memory that was still available at the end, in percent.
    pub memory_free_percent: Option<f64>,
    /// Why the repeat is invalid, if it is.
    pub void: Option<String>,
}

impl ScaleSample {
    /// The differences between two marks.
    pub fn between(before: &ScaleMark, after: &ScaleMark) -> Self {
        let window_s = (after.at - before.at).as_secs_f64();
        let ms =
            |after: Duration, before: Duration| after.saturating_sub(before).as_secs_f64() * 1e3;
        let total_and_most = |before: &[Duration], after: &[Duration]| {
            let each = || {
                after
                    .iter()
                    .zip(before)
                    .map(|(&after, &before)| ms(after, before))
            };
            (
                each().fold(0.0, f64::add),
                percent(each().fold(0.0, f64::max), window_s),
            )
        };
        let (sim_ms, sim_most_percent) = total_and_most(&before.sim, &after.sim);
        let (model_ms, model_most_percent) = total_and_most(&before.model, &after.model);
        let relay = after.relay.zip(before.relay);
        let missing = after.missing.saturating_sub(before.missing);
        let lost_before = after.missing_before.saturating_sub(before.missing_before);
        Self {
            window_s,
            sim_ms,
            model_ms,
            relay_ms: relay.map(|(after, before)| ms(after, before)),
            sim_most_percent,
            model_most_percent,
            messages: after.messages.saturating_sub(before.messages),
            lost_in_console: missing.saturating_sub(lost_before),
            lost_before,
            factor: factor(&before.clocks, &after.clocks),
            machine_busy_percent: after.machine.busy_percent_since(before.machine),
            memory_free_percent: cost::memory_free_percent(),
            void: None,
        }
    }
}

/// The pace of the vehicles' clocks: the mean, and the slowest. A vehicle without messages has a pace of zero.
fn factor(
    before: &[Option<(u32, Duration)>],
    after: &[Option<(u32, Duration)>],
) -> Option<(f64, f64)> {
    let pace = |(before, after): (&Option<_>, &Option<_>)| {
        let ((boot_before, before), (boot_after, after)): ((u32, Duration), (u32, Duration)) =
            (*before).zip(*after)?;
        let wall_ms = after.saturating_sub(before).as_secs_f64() * 1e3;
        (wall_ms > 0.0).then(|| f64::from(boot_after.saturating_sub(boot_before)) / wall_ms)
    };
    let paces: Vec<f64> = before
        .iter()
        .zip(after)
        .map(|pair| pace(pair).unwrap_or(0.0))
        .collect();
    let least = paces.iter().copied().reduce(f64::min)?;
    Some((paces.iter().sum::<f64>() / paces.len() as f64, least))
}

/// Milliseconds as a percentage of a time in seconds.
pub(super) fn percent(ms: f64, window_s: f64) -> f64 {
    ms / 10.0 / window_s.max(f64::EPSILON)
}
