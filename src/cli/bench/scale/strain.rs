//! The part that was overloaded when the simulation fell behind real time.

use super::cost;
use super::sample::ScaleSample;

/// Below this many simulated seconds per second, the simulation counts as behind real time.
const HELD_FROM: f64 = 0.97;
/// The highest tolerable share of lost messages.
const LOST_SHARE: f64 = 0.01;
/// A thread that is busy for this share of the time is saturated.
const SATURATED_PERCENT: f64 = 90.0;
/// On a machine that is busy for this share of the time, threads wait for processors: 12 800
/// embedded drones fell behind real time at 81 %, although no thread was saturated.
const CROWDED_PERCENT: f64 = 75.0;
/// A model update that needs this share of its thread is saturated, whatever the simulator needs.
const AT_ITS_END_PERCENT: f64 = 98.0;
/// With less free memory than this, the system swaps or ends programs.
const MEMORY_SHORT_PERCENT: f64 = 3.0;

/// The part that could not keep up; `None` if all could.
pub(super) fn gave_way(sample: &ScaleSample) -> Option<String> {
    let factor = sample.factor.map_or(1.0, |(mean, _)| mean);
    let lost = sample.lost_in_console + sample.lost_before;
    let lost_share = lost as f64 / (lost + sample.messages).max(1) as f64;
    let part = part(sample);
    if factor < HELD_FROM {
        Some(format!("{factor:.3} of real time: {part}"))
    } else if lost_share > LOST_SHARE {
        let lost_percent = lost_share * 100.0;
        Some(format!(
            "{lost_percent:.1} % of the messages were lost: {part}"
        ))
    } else {
        (sample.model_most_percent >= AT_ITS_END_PERCENT).then_some(part)
    }
}

fn part(sample: &ScaleSample) -> String {
    let (sim, model) = (sample.sim_most_percent, sample.model_most_percent);
    if let Some(free) = sample.memory_free_percent
        && free < MEMORY_SHORT_PERCENT
    {
        return format!("memory ({free:.1} % of it is free)");
    }
    if sim >= SATURATED_PERCENT {
        return format!("the simulator uses {sim:.0} % of a core in one thread");
    }
    if model >= SATURATED_PERCENT {
        return format!("the console's model update uses {model:.0} % of a core in one thread");
    }
    if sample.lost_in_console > sample.lost_before {
        return format!(
            "the console's queues dropped {} messages (its busiest thread uses {model:.0} % of a core)",
            sample.lost_in_console
        );
    }
    let busy = sample.machine_busy_percent;
    if busy < CROWDED_PERCENT {
        return format!(
            "for an unknown reason (the machine is busy for only {busy:.0} %; {} messages never reached the \
             console)",
            sample.lost_before
        );
    }
    // The processors are busy; the sums below show which programs use them.
    let of_all = |ms: f64| ms / 10.0 / sample.window_s.max(f64::EPSILON);
    let (sim, model) = (of_all(sample.sim_ms), of_all(sample.model_ms));
    let relay = of_all(sample.relay_ms.unwrap_or(0.0));
    let capacity = cost::cores() as f64 * 100.0;
    let whose = if sim + model + relay >= capacity / 2.0 {
        "processor time"
    } else {
        "processor time, used by other programs"
    };
    format!(
        "{whose}: of {capacity:.0} % the simulator uses {sim:.0}, the model update {model:.0}, the hangar {relay:.0}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    type Change = fn(&mut ScaleSample);

    #[test]
    fn whatever_could_not_keep_up_is_named_with_its_figures() {
        let calm = ScaleSample {
            window_s: 1.0,
            messages: 1000,
            ..ScaleSample::default()
        };
        let cases: [(f64, Change, Option<&str>); 10] = [
            (0.99, |_| {}, None),
            (0.96, |_| {}, Some("for an unknown reason")),
            (
                0.5,
                |s| s.sim_most_percent = 99.0,
                Some("0.500 of real time: the simulator uses 99 % of a core in one thread"),
            ),
            (1.0, |s| s.model_most_percent = 95.0, None),
            (
                1.0,
                |s| s.model_most_percent = 99.0,
                Some("the console's model update uses 99 % of a core in one thread"),
            ),
            (
                1.0,
                |s| s.lost_in_console = 50,
                Some("4.8 % of the messages were lost: the console's queues dropped 50 messages"),
            ),
            (
                0.8,
                |s| (s.machine_busy_percent, s.sim_ms) = (100.0, 900.0 * cost::cores() as f64),
                Some("0.800 of real time: processor time: of"),
            ),
            (
                0.7,
                |s| (s.machine_busy_percent, s.model_ms) = (81.0, 600.0 * cost::cores() as f64),
                Some("0.700 of real time: processor time: of"),
            ),
            (
                0.8,
                |s| s.machine_busy_percent = 100.0,
                Some("processor time, used by other programs"),
            ),
            (
                0.9,
                |s| s.memory_free_percent = Some(1.0),
                Some("memory (1.0 % of it is free)"),
            ),
        ];
        for (factor, change, expected) in cases {
            let mut sample = calm.clone();
            sample.factor = Some((factor, factor));
            change(&mut sample);
            let said = gave_way(&sample);
            match expected {
                None => assert_eq!(said, None),
                Some(words) => assert!(
                    said.as_deref().is_some_and(|said| said.contains(words)),
                    "{said:?} does not say {words:?}"
                ),
            }
        }
    }
}
