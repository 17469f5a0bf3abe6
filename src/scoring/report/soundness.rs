//! Whether a report's figures are consistent: files may have been edited by hand.

use super::{ComponentReport, ObjectiveReport, Report};
use crate::scoring::Component;

/// The tolerance of a component's points: weights and values are rounded to a thousandth.
const POINTS_OFF: f64 = 1.2;
/// The tolerance of a sum of points, which are rounded to tenths.
const TENTH: f64 = 0.051;
const SHARE_OFF: f64 = 0.005;
const LEAST_FACTOR: f64 = 0.7;
const PERFECT: f64 = 1000.0;

impl Report {
    /// Why the result does not follow from its parts, in English; `None` if it does. Only the flight's record can show
    /// whether the parts are true.
    pub fn fault(&self) -> Option<String> {
        let parts = self.components.iter().find_map(ComponentReport::fault);
        let objectives = self.objectives.iter().find_map(ObjectiveReport::fault);
        parts
            .or(objectives)
            .or_else(|| self.sum_fault())
            .or_else(|| self.verdict_fault())
    }

    fn sum_fault(&self) -> Option<String> {
        let weights: f64 = self.components.iter().map(|it| it.weight).sum();
        let points: f64 = self.components.iter().map(|it| it.points).sum();
        let share = self.objective_share();
        let claimed = self
            .components
            .iter()
            .find(|it| it.component == Component::Objective);
        let is_fair = |value: f64| share.is_some_and(|share| value <= share + SHARE_OFF);
        let most = self.subtotal * self.hint_factor;
        if weights > 1.0 + SHARE_OFF {
            Some(format!("the components weigh {weights:.3} together"))
        } else if claimed.is_some_and(|it| !is_fair(it.value)) {
            Some("the objectives do not add up to the component's value".to_owned())
        } else if (points - self.subtotal).abs() > TENTH {
            Some(format!("`subtotal` is {}, not {points:.1}", self.subtotal))
        } else if !(LEAST_FACTOR - SHARE_OFF..=1.0).contains(&self.hint_factor) {
            Some(format!("`hint_factor` is {}", self.hint_factor))
        } else if f64::from(self.score) > most + SHARE_OFF * PERFECT + 0.5 {
            Some(format!("`score` is {}, more than {most:.1}", self.score))
        } else {
            None
        }
    }

    /// The share of the objectives' points, if they have any.
    fn objective_share(&self) -> Option<f64> {
        let most: f64 = self.objectives.iter().map(|it| it.points_max).sum();
        let reached: f64 = self.objectives.iter().map(|it| it.points).sum();
        (most > 0.0).then(|| reached / most)
    }

    fn verdict_fault(&self) -> Option<String> {
        let missed = self.objectives.iter().find(|it| it.mandatory && !it.met);
        if let (true, Some(missed)) = (self.passed, missed) {
            return Some(format!("passed without the objective {:?}", missed.id));
        }
        if self.passed && self.given_up {
            return Some("both passed and given up".to_owned());
        }
        let is_won = self.medal.is_some() && !self.passed;
        is_won.then(|| "a medal of a flight that did not pass".to_owned())
    }
}

impl ComponentReport {
    fn fault(&self) -> Option<String> {
        let points = PERFECT * self.weight * self.value;
        let is_fine = (0.0..=1.0).contains(&self.weight)
            && (0.0..=1.0).contains(&self.value)
            && (self.points - points).abs() <= POINTS_OFF;
        let given = self.points;
        (!is_fine).then(|| {
            format!(
                "component {:?}: {given} points, not {points:.1}",
                self.component.name()
            )
        })
    }
}

impl ObjectiveReport {
    fn fault(&self) -> Option<String> {
        let is_fine = self.points >= 0.0 && self.points <= self.points_max + TENTH;
        (!is_fine).then(|| {
            format!(
                "objective {:?}: {} of {} points",
                self.id, self.points, self.points_max
            )
        })
    }
}
