//! Checks where the steps of a plan lead.

use std::collections::BTreeSet;

use toml::Spanned;

use super::Findings;
use super::written::WrittenStep;
use crate::class::{LessonStep, StepStart, StepTarget};
use crate::text;

/// Adds a fault for each step that nothing leads to, from which nothing leads to an end, or that goes round in a circle
/// without ever waiting.
pub(super) fn check(
    written: &Spanned<Vec<WrittenStep>>,
    steps: &[LessonStep],
    findings: &mut Findings,
) {
    let reached = LessonStep::reached(steps, 0);
    let ending = ending(steps);
    for (at, (step, read)) in written.get_ref().iter().zip(steps).enumerate() {
        let name = step.id.get_ref();
        let place = step.id.span();
        if !reached.contains(&at) {
            findings.fault(place, text!("lesson-unreached", name = name));
        } else if is_in_circle(steps, at) {
            let then = step.then.as_ref().map_or(place, Spanned::span);
            findings.fault(then, text!("lesson-circle", name = name));
        } else if !ending.contains(&at) {
            findings.fault(place, text!("lesson-endless", name = read.id.as_str()));
        }
    }
}

/// The steps from which a way leads to the end.
fn ending(steps: &[LessonStep]) -> BTreeSet<usize> {
    let mut ending = BTreeSet::new();
    loop {
        let ends = |target: StepTarget| target.index().is_none_or(|step| ending.contains(&step));
        let all = steps.iter().enumerate();
        let new: Vec<usize> = all
            .filter(|(at, step)| !ending.contains(at) && step.targets().any(ends))
            .map(|(at, _)| at)
            .collect();
        if new.is_empty() {
            return ending;
        }
        ending.extend(new);
    }
}

/// Whether a step is part of a circle of steps that all start at once.
fn is_in_circle(steps: &[LessonStep], from: usize) -> bool {
    let mut at = from;
    for _ in steps {
        let Some(step) = steps.get(at).filter(|it| it.start == StepStart::AtOnce) else {
            return false;
        };
        match step.then.index() {
            Some(next) if next == from => return true,
            Some(next) => at = next,
            None => return false,
        }
    }
    false
}
