//! The operator's workload over a flight. It is shown afterwards, and never scored.
//!
//! Utilisation is the share of the last minute that an operator was busy with commands (Donmez, Nehme and Cummings
//! 2010). Above 0.7 for a minute or longer, performance falls. In addition, the trainee rates the workload from 1 to 5
//! every two minutes, as in the instantaneous self-assessment (ISA) of air traffic control.

use std::iter::Sum;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::swarm::{AT_IT, LEAST_INTERACTION};
use crate::text::rounded;

/// The time between two points of the curves.
const POINT_EVERY: Duration = Duration::from_secs(10);
/// The time over which utilisation is measured.
const WINDOW: Duration = Duration::from_secs(60);
/// Utilisation above this share for at least the time below counts as overload.
const OVERLOADED_ABOVE: f64 = 0.7;
const OVERLOADED_FOR: Duration = Duration::from_secs(60);
/// The time between two questions, by the mission's clock.
const ASK_EVERY: Duration = Duration::from_secs(120);
/// How long a question stays open.
const ASK_FOR: Duration = Duration::from_secs(15);

/// The question about the workload that is open at a mission time, counted from 1; `None` between two questions.
pub fn workload_question(elapsed: Duration) -> Option<u64> {
    let number = elapsed.as_secs() / ASK_EVERY.as_secs();
    let since = elapsed.as_secs() % ASK_EVERY.as_secs();
    (number > 0 && since < ASK_FOR.as_secs()).then_some(number)
}

/// The share of the last minute in which an operator was busy with commands that were given at these times, oldest
/// first.
pub fn utilisation(commands: &[Duration], now: Duration) -> f64 {
    busy_share(&BusyTime::of(commands), now)
}

fn busy_share(busy: &BusyTime, to: Duration) -> f64 {
    let spent = busy.between(to.saturating_sub(WINDOW), to);
    rounded(spent.as_secs_f64() / WINDOW.as_secs_f64(), 2)
}

/// The vehicles' load on their operator at one time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct VehicleLoad {
    /// The number of vehicles that wait for a command, in the air without a task.
    pub waiting: u16,
    /// The total time so far in which they worked on their own after a command.
    pub neglected: Duration,
    /// The total time so far in which they waited.
    pub waited: Duration,
}

impl Sum for VehicleLoad {
    fn sum<I: Iterator<Item = Self>>(loads: I) -> Self {
        loads.fold(Self::default(), |sum, one| Self {
            waiting: sum.waiting + one.waiting,
            neglected: sum.neglected + one.neglected,
            waited: sum.waited + one.waited,
        })
    }
}

/// The measurements of the workload while a mission is flown.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WorkloadCourse {
    loads: Vec<VehicleLoad>,
    answers: Vec<WorkloadAnswer>,
}

/// The workload over a flight. The curves have a point every `every_s`, the first at the start.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct WorkloadReport {
    /// Seconds between two points.
    pub every_s: f64,
    /// The share of the last minute that the operator was busy with commands, 0 to 1.
    pub utilisation: Vec<f64>,
    /// The number of vehicles that waited for a command.
    pub waiting: Vec<u16>,
    /// The total time so far in which the operator was busy, in seconds.
    pub interaction_s: Vec<f64>,
    /// The total time so far in which vehicles worked on their own, in seconds.
    pub neglect_s: Vec<f64>,
    /// The total time so far in which vehicles waited, in seconds.
    pub wait_s: Vec<f64>,
    /// The stretches with a utilisation above 0.7 for a minute or longer.
    pub overloaded: Vec<OverloadedStretch>,
    /// The number of commands on which the figures are based.
    pub commands: usize,
    /// The trainee's ratings of the workload, oldest first.
    pub answers: Vec<WorkloadAnswer>,
}

/// A stretch of a flight with too much to do. Times are mission time in seconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct OverloadedStretch {
    pub from_s: f64,
    pub to_s: f64,
}

/// A trainee's rating of the workload.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WorkloadAnswer {
    /// Mission time, in seconds.
    pub at_s: f64,
    /// The rating, from 1 (almost nothing to do) to 5 (too much).
    pub level: u8,
}

impl WorkloadCourse {
    /// Whether a point of the curves is due at this mission time.
    pub fn is_due(&self, now: Duration) -> bool {
        now >= POINT_EVERY * self.loads.len() as u32
    }

    pub fn note(&mut self, load: VehicleLoad) {
        self.loads.push(load);
    }

    /// Records the trainee's answer; it replaces an earlier answer to the same question.
    pub fn answer(&mut self, now: Duration, level: u8) {
        let question = workload_question(now);
        let is_again = |known: &WorkloadAnswer| {
            question.is_some() && workload_question(Duration::from_secs_f64(known.at_s)) == question
        };
        self.answers.retain(|known| !is_again(known));
        let at_s = rounded(now.as_secs_f64(), 1);
        self.answers.push(WorkloadAnswer { at_s, level });
    }

    /// The newest question that was answered, counted from 1, if any was.
    pub fn answered_question(&self) -> Option<u64> {
        let answers = self.answers.iter().rev();
        answers
            .map(|it| Duration::from_secs_f64(it.at_s))
            .find_map(workload_question)
    }

    /// The curves of a flight in which commands were given at these times, oldest first.
    pub fn report(&self, commands: &[Duration]) -> WorkloadReport {
        let busy = BusyTime::of(commands);
        let times = (0..self.loads.len() as u32).map(|point| POINT_EVERY * point);
        let share = |to: Duration| busy_share(&busy, to);
        let seconds = |time: Duration| rounded(time.as_secs_f64(), 1);
        let utilisation: Vec<f64> = times.clone().map(share).collect();
        WorkloadReport {
            every_s: POINT_EVERY.as_secs_f64(),
            overloaded: overloaded(&utilisation),
            utilisation,
            waiting: self.loads.iter().map(|load| load.waiting).collect(),
            interaction_s: times
                .map(|to| seconds(busy.between(Duration::ZERO, to)))
                .collect(),
            neglect_s: self.loads.iter().map(|it| seconds(it.neglected)).collect(),
            wait_s: self.loads.iter().map(|it| seconds(it.waited)).collect(),
            commands: commands.len(),
            answers: self.answers.clone(),
        }
    }
}

impl WorkloadReport {
    /// Whether it has nothing to show.
    pub fn is_empty(&self) -> bool {
        self.utilisation.is_empty() && self.answers.is_empty()
    }

    /// The number of questions that the flight was long enough for.
    pub fn questions(&self) -> usize {
        let length_s = self.every_s * self.utilisation.len().saturating_sub(1) as f64;
        (length_s / ASK_EVERY.as_secs_f64()) as usize
    }
}

/// The periods in which the operator was busy with commands: from one command to the next if they follow each other
/// closely, and for the minimum time that giving one takes.
struct BusyTime(Vec<(Duration, Duration)>);

impl BusyTime {
    fn of(commands: &[Duration]) -> Self {
        let mut spans: Vec<(Duration, Duration)> = Vec::new();
        for &at in commands {
            match spans.last_mut() {
                Some((_, end)) if at.saturating_sub(*end) <= AT_IT => *end = at,
                Some(_) | None => spans.push((at.saturating_sub(LEAST_INTERACTION), at)),
            }
        }
        Self(spans)
    }

    fn between(&self, from: Duration, to: Duration) -> Duration {
        let parts = self.0.iter();
        parts
            .map(|&(begin, end)| end.min(to).saturating_sub(begin.max(from)))
            .sum()
    }
}

fn overloaded(utilisation: &[f64]) -> Vec<OverloadedStretch> {
    let every_s = POINT_EVERY.as_secs_f64();
    let mut stretches: Vec<OverloadedStretch> = Vec::new();
    for (point, share) in utilisation.iter().enumerate() {
        if *share <= OVERLOADED_ABOVE {
            continue;
        }
        let at_s = point as f64 * every_s;
        match stretches.last_mut() {
            Some(last) if at_s <= last.to_s + 1.5 * every_s => last.to_s = at_s,
            Some(_) | None => stretches.push(OverloadedStretch {
                from_s: at_s,
                to_s: at_s,
            }),
        }
    }
    stretches.retain(|it| it.to_s - it.from_s >= OVERLOADED_FOR.as_secs_f64());
    stretches
}

#[cfg(test)]
mod tests {
    use super::*;

    fn course(seconds: u64) -> WorkloadCourse {
        let mut course = WorkloadCourse::default();
        for second in 0..=seconds {
            if course.is_due(Duration::from_secs(second)) {
                course.note(VehicleLoad {
                    waiting: 2,
                    neglected: Duration::from_secs(second),
                    waited: Duration::from_secs(2 * second),
                });
            }
        }
        course
    }

    fn at(seconds: &[u64]) -> Vec<Duration> {
        seconds.iter().copied().map(Duration::from_secs).collect()
    }

    #[test]
    fn utilisation_is_the_busy_share_of_the_last_minute() {
        let report = course(120).report(&at(&[30, 40, 60, 110]));
        // The operator is busy from 29 to 60 s and from 109 to 110 s.
        let shares = [
            0.0, 0.0, 0.0, 0.02, 0.18, 0.35, 0.52, 0.52, 0.52, 0.5, 0.33, 0.18, 0.02,
        ];
        assert_eq!(report.utilisation, shares);
        assert_eq!(report.interaction_s.last(), Some(&32.0));
        assert_eq!(report.neglect_s.last(), Some(&120.0));
        assert_eq!(report.wait_s.last(), Some(&240.0));
        assert_eq!(report.waiting, [2; 13]);
        assert_eq!((report.commands, report.questions()), (4, 1));
    }

    #[test]
    fn only_a_minute_of_too_much_is_flagged() {
        let commands: Vec<u64> = (0..=15).map(|at| at * 10).collect();
        let report = course(300).report(&at(&commands));
        let stretch = OverloadedStretch {
            from_s: 50.0,
            to_s: 160.0,
        };
        assert_eq!(report.overloaded, [stretch]);
        let short: Vec<u64> = (0..=7).map(|at| at * 10).collect();
        assert_eq!(course(300).report(&at(&short)).overloaded, []);
    }

    #[test]
    fn a_question_stands_for_a_quarter_of_a_minute_every_two_and_its_last_answer_counts() {
        let asked: Vec<u64> = (0..300)
            .filter(|&second| workload_question(Duration::from_secs(second)).is_some())
            .collect();
        let expected: Vec<u64> = (120..135).chain(240..255).collect();
        assert_eq!(asked, expected);
        let mut course = course(300);
        for (second, level) in [(121, 2), (130, 4), (245, 5), (290, 1)] {
            course.answer(Duration::from_secs(second), level);
        }
        let levels: Vec<u8> = course
            .report(&[])
            .answers
            .iter()
            .map(|it| it.level)
            .collect();
        assert_eq!(levels, [4, 5, 1]);
    }

    #[test]
    fn a_flight_without_commands_has_no_utilisation() {
        assert!(WorkloadCourse::default().report(&[]).is_empty());
        let report = course(30).report(&[]);
        assert_eq!(report.utilisation, [0.0; 4]);
        assert_eq!(report.overloaded, []);
    }
}
