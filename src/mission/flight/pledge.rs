//! The comparison of the trainee's prediction and goal with the result.

use super::Flight;
use crate::commands::{Goal, GoalComponent};
use crate::scoring::FlightOutcome;
use crate::scoring::{CommandTally, Facts, GoalReport, PredictionReport, Score};
use crate::text;
use crate::text::Text;

impl Flight {
    pub(super) fn prediction_report(&self, score: &Score) -> Option<PredictionReport> {
        let predicted = self.pledge.prediction?;
        Some(PredictionReport {
            predicted,
            error: i32::from(score.points) - i32::from(predicted),
        })
    }

    /// The result for the goal; `None` without a goal. A failed flight never reaches its goal:
    /// ending early does not count as fast or safe.
    pub(super) fn goal_report(&self, facts: &Facts, score: &Score) -> Option<GoalReport> {
        let goal = self.pledge.goal?;
        let (kept, result) = self.goal_result(goal, facts, score);
        Some(GoalReport {
            text: goal.title(),
            reached: kept && self.outcome == FlightOutcome::Passed,
            result,
        })
    }

    /// Whether the goal was reached, and the value that decides it.
    fn goal_result(&self, goal: Goal, facts: &Facts, score: &Score) -> (bool, Text) {
        match goal {
            Goal::Time(most) => {
                let used_s = facts.elapsed.as_secs_f64();
                let result = text!("mission-goal-time-result", seconds = format!("{used_s:.0}"));
                (facts.elapsed <= most, result)
            }
            Goal::Battery(least) => {
                let flown = self.crafts.iter().filter(|craft| craft.flown);
                let left = flown
                    .filter_map(|craft| craft.battery_percent)
                    .min_by(f64::total_cmp);
                let result = match left {
                    Some(left) => text!(
                        "mission-goal-battery-result",
                        percent = format!("{left:.0}")
                    ),
                    None => text!("mission-goal-battery-unknown"),
                };
                (left.is_some_and(|left| left >= least), result)
            }
            Goal::Faultless(GoalComponent::Safety) => {
                let count = facts.safety.len();
                let result = text!("mission-goal-safety-result", count = count);
                (count == 0, result)
            }
            Goal::Faultless(GoalComponent::Commands) => {
                let CommandTally { rejected, .. } = facts.commands;
                let result = text!("mission-goal-commands-result", count = rejected);
                (rejected == 0, result)
            }
            Goal::Faultless(GoalComponent::Attention) => {
                let late = facts.alerts.iter().filter(|alert| !alert.is_in_time());
                let (late, all) = (late.count(), facts.alerts.len());
                let result = text!("mission-goal-attention-result", count = late, all = all);
                (late == 0, result)
            }
            Goal::Score(least) => {
                let result = text!("mission-goal-score-result", points = score.points);
                (score.points >= least, result)
            }
        }
    }
}
