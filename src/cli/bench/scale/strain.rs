//! Which part gave way when real time was not held.

use super::sample::Sample;

/// Below this many simulated seconds per second, real time is not held.
pub(super) const HELD_FROM: f64 = 0.97;
/// More lost messages than this share of all is too many.
const LOST_SHARE: f64 = 0.01;
/// A thread, or the machine, that works for this share of the time has none to spare.
const SATURATED_PERCENT: f64 = 90.0;
/// A model update that takes this share of its thread is at its end, whatever the simulator does.
const MODEL_AT_ITS_END_PERCENT: f64 = 98.0;
/// So little free memory means that the system swaps or ends programs.
const MEMORY_SHORT_PERCENT: f64 = 3.0;

/// How hard everything worked during a measurement.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Strain {
    pub cores: usize,
    /// Share of all processors that was at work, other programs included.
    pub machine_busy_percent: f64,
    /// Share of a core that the simulator took.
    pub sim_percent: f64,
    /// The same of the one thread that steps embedded vehicles.
    pub sim_thread_percent: Option<f64>,
    /// The same of the busiest thread of the model update: there is one per 254 vehicles.
    pub model_thread_percent: f64,
    /// Messages that the console's queues dropped.
    pub lost_in_console: u64,
    /// Messages that never reached the console.
    pub lost_before: u64,
    pub memory_available_percent: Option<f64>,
}

impl Strain {
    /// Messages that did not reach the models.
    pub fn lost(&self) -> u64 {
        self.lost_in_console + self.lost_before
    }
}

/// What could not keep up; `None` if everything could.
pub(super) fn gave_way(sample: &Sample) -> Option<String> {
    let strain = &sample.strain;
    let factor = sample.factor.map_or(1.0, |(mean, _)| mean);
    let lost_share = strain.lost() as f64 / (strain.lost() + sample.messages).max(1) as f64;
    let is_model_full = strain.model_thread_percent >= MODEL_AT_ITS_END_PERCENT;
    if factor >= HELD_FROM && lost_share <= LOST_SHARE && !is_model_full {
        return None;
    }
    let part = part(strain);
    Some(if factor < HELD_FROM {
        format!("{factor:.3} of real time: {part}")
    } else if lost_share > LOST_SHARE {
        format!(
            "{:.1} % of the messages were lost: {part}",
            lost_share * 100.0
        )
    } else {
        part
    })
}

fn part(strain: &Strain) -> String {
    let capacity = strain.cores as f64 * 100.0;
    if let Some(free) = strain.memory_available_percent
        && free < MEMORY_SHORT_PERCENT
    {
        return format!("memory ({free:.1} % of it is free)");
    }
    if let Some(thread) = strain.sim_thread_percent
        && thread >= SATURATED_PERCENT
    {
        return format!("the simulator's thread takes {thread:.0} % of a core");
    }
    if strain.model_thread_percent >= SATURATED_PERCENT {
        return format!(
            "the console's model update takes {:.0} % of a core in one thread",
            strain.model_thread_percent
        );
    }
    if strain.lost_in_console > 0 && strain.lost_in_console >= strain.lost_before {
        return format!(
            "the console's queues dropped {} messages (its busiest thread takes {:.0} % of a core)",
            strain.lost_in_console, strain.model_thread_percent
        );
    }
    if strain.machine_busy_percent < SATURATED_PERCENT {
        return format!(
            "for no reason that shows (the machine is busy for {:.0} % only; {} messages never reached the \
             console)",
            strain.machine_busy_percent, strain.lost_before
        );
    }
    // All processors are at work; the question is for whom.
    let is_ours = strain.sim_percent + strain.model_thread_percent >= capacity / 2.0;
    let simulator = format!("the simulator takes {:.0} % of a core", strain.sim_percent);
    if is_ours {
        format!("processor time: {simulator}, and the machine has {capacity:.0} %")
    } else {
        format!("processor time, which other programs take: {simulator} of {capacity:.0} %")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(factor: f64, strain: Strain) -> Sample {
        Sample {
            factor: Some((factor, factor)),
            messages: 1000,
            strain: Strain { cores: 2, ..strain },
            ..Sample::default()
        }
    }

    #[test]
    fn whatever_could_not_keep_up_is_named_with_its_figures() {
        let calm = Strain::default();
        let cases = [
            (0.99, calm, None),
            (
                0.5,
                Strain {
                    sim_thread_percent: Some(99.0),
                    machine_busy_percent: 60.0,
                    ..calm
                },
                Some("0.500 of real time: the simulator's thread takes 99 % of a core"),
            ),
            (
                1.0,
                Strain {
                    model_thread_percent: 99.0,
                    ..calm
                },
                Some("the console's model update takes 99 % of a core in one thread"),
            ),
            (
                1.0,
                Strain {
                    lost_in_console: 50,
                    model_thread_percent: 40.0,
                    ..calm
                },
                Some("4.8 % of the messages were lost: the console's queues dropped 50 messages"),
            ),
            (
                0.8,
                Strain {
                    machine_busy_percent: 100.0,
                    sim_percent: 190.0,
                    ..calm
                },
                Some(
                    "0.800 of real time: processor time: the simulator takes 190 % of a core, and the machine has 200 %",
                ),
            ),
            (
                0.8,
                Strain {
                    machine_busy_percent: 100.0,
                    sim_percent: 20.0,
                    ..calm
                },
                Some("which other programs take"),
            ),
            (
                0.9,
                Strain {
                    memory_available_percent: Some(1.0),
                    ..calm
                },
                Some("memory (1.0 % of it is free)"),
            ),
            (0.9, calm, Some("no reason that shows")),
        ];
        for (factor, strain, expected) in cases {
            let said = gave_way(&sample(factor, strain));
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
