//! Figures about one operator of many vehicles; displayed, but not scored.
//!
//! Fan-out is the number of vehicles that an operator can keep busy: `neglect time / interaction time + 1` (Olsen and
//! Goodrich 2003), or with the time that vehicles wait for attention, `NT / (IT + WT) + 1` (Cummings).

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::text::rounded;

/// If more time than this passes between two commands, the operator was doing something else.
pub(super) const AT_IT: Duration = Duration::from_secs(20);
/// The minimum time that giving a command takes; otherwise a script's interaction time would be zero.
pub(super) const LEAST_INTERACTION: Duration = Duration::from_secs(1);

/// Measurements during a mission.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SwarmTimes {
    /// Each period in which a vehicle stayed productive after a command.
    pub neglected: Vec<Duration>,
    /// Each period in which a vehicle in the air waited for its next command.
    pub waited: Vec<Duration>,
    /// The time of each command, the number of its vehicles, and whether these differ from the
    /// vehicles of the previous command.
    pub commands: Vec<(Duration, usize, bool)>,
}

/// An operator's handling of a swarm. Times are in seconds; `None` without data.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SwarmFigures {
    /// Neglect time: the median time that a vehicle stays productive without its operator.
    pub neglect_s: Option<f64>,
    /// Interaction time: the median time between commands while the operator is active. At least 1 s.
    pub interaction_s: Option<f64>,
    /// Wait time: the median time that an idle vehicle in the air waits for its next command; 0 if
    /// no vehicle waited.
    pub wait_s: f64,
    /// Fan-out without the time spent waiting.
    pub fan_out: Option<f64>,
    /// Fan-out with the time spent waiting.
    pub fan_out_waiting: Option<f64>,
    /// The number of vehicles flown.
    pub flown: usize,
    /// How many times per minute the operator switched to other vehicles.
    pub switches_per_min: f64,
    /// The share of the commands that addressed several vehicles.
    pub group_share: f64,
}

impl SwarmTimes {
    /// The figures of a flight of this length with `flown` vehicles.
    pub fn figures(&self, flown: usize, elapsed: Duration) -> SwarmFigures {
        let pairs = self.commands.windows(2);
        let between = pairs.map(|pair| pair[1].0.saturating_sub(pair[0].0));
        let at_it: Vec<Duration> = between.filter(|gap| *gap <= AT_IT).collect();
        let seconds = |time: Duration| time.as_secs_f64();
        let neglect = median(&self.neglected).map(seconds);
        let interaction = median(&at_it).map(|gap| seconds(gap.max(LEAST_INTERACTION)));
        let wait = median(&self.waited).map_or(0.0, seconds);
        let fan_out = |extra: f64| Some(neglect? / (interaction? + extra) + 1.0);
        let count = |wanted: fn(&(Duration, usize, bool)) -> bool| {
            self.commands
                .iter()
                .filter(|command| wanted(command))
                .count() as f64
        };
        let tenth = |value: Option<f64>| value.map(|value| rounded(value, 1));
        SwarmFigures {
            neglect_s: tenth(neglect),
            interaction_s: tenth(interaction),
            wait_s: rounded(wait, 1),
            fan_out: tenth(fan_out(0.0)),
            fan_out_waiting: tenth(fan_out(wait)),
            flown,
            switches_per_min: rounded(count(|command| command.2) / (seconds(elapsed) / 60.0), 1),
            group_share: rounded(count(|command| command.1 > 1) / count(|_| true), 2),
        }
    }
}

/// The median; of two middle values, the lower. `None` without values.
fn median(times: &[Duration]) -> Option<Duration> {
    let mut sorted = times.to_vec();
    sorted.sort_unstable();
    sorted.get(sorted.len().saturating_sub(1) / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seconds(all: &[u64]) -> Vec<Duration> {
        all.iter().copied().map(Duration::from_secs).collect()
    }

    #[test]
    fn fan_out_is_neglect_time_by_interaction_time_and_one() {
        let times = SwarmTimes {
            neglected: seconds(&[10, 40, 90]),
            waited: seconds(&[10]),
            commands: vec![
                (Duration::from_secs(0), 1, false),
                (Duration::from_secs(10), 1, true),
                (Duration::from_secs(20), 4, true),
                (Duration::from_secs(80), 4, false),
            ],
        };
        let figures = times.figures(4, Duration::from_secs(120));
        assert_eq!(figures.neglect_s, Some(40.0));
        assert_eq!(figures.interaction_s, Some(10.0));
        assert_eq!(figures.fan_out, Some(5.0));
        assert_eq!(figures.fan_out_waiting, Some(3.0));
        assert!((figures.switches_per_min - 1.0).abs() < 1e-9);
        assert!((figures.group_share - 0.5).abs() < 1e-9);
    }

    #[test]
    fn without_commands_there_are_no_figures_and_no_division_by_nothing() {
        let figures = SwarmTimes::default().figures(0, Duration::ZERO);
        assert_eq!(figures, SwarmFigures::default());
    }
}
