//! Reads the steps of a plan.

use std::time::Duration;

use toml::Spanned;

use super::orders::{self, StepFlight};
use super::written::WrittenStep;
use super::{Findings, LessonSetting};
use crate::class::{FlightMoment, LessonStep, StepLimit, StepStart, StepTarget};
use crate::diagnostic::Diagnostic;
use crate::mission::check_condition;
use crate::text;
use crate::text::Text;

/// The word for a step that waits for the instructor.
const MANUAL: &str = "manual";
/// The word for the end of the lesson.
pub(super) const END: &str = "end";
/// The maximum number of steps.
const MOST_STEPS: usize = 200;
/// The maximum length of a step's name, in characters.
const LONGEST_ID: usize = 24;
/// The maximum length of a condition, in characters: it is sent to the seats.
const LONGEST_CONDITION: usize = 200;
/// The longest time limit, in seconds.
const LONGEST_LIMIT_S: u32 = 24 * 3600;

/// The steps, and what the instructor reads at each.
pub(super) fn read(
    written: &Spanned<Vec<WrittenStep>>,
    setting: &LessonSetting<'_>,
    findings: &mut Findings,
) -> (Vec<LessonStep>, Vec<Text>) {
    let steps = written.get_ref();
    if steps.is_empty() || steps.len() > MOST_STEPS {
        let fault = text!("lesson-steps", count = steps.len(), most = MOST_STEPS);
        findings.fault(written.span(), fault);
    }
    let mut flight = StepFlight::default();
    let mut read = Vec::new();
    let mut notes = Vec::new();
    for (at, step) in steps.iter().enumerate() {
        check_id(&step.id, &steps[..at], findings);
        notes.push(findings.text(&step.text, step.text_uk.as_ref(), "text_uk"));
        let mission = flight.mission_id();
        let start = start(step, &flight, findings);
        let targets = Targets { steps, at };
        read.push(LessonStep {
            id: step.id.get_ref().as_str().into(),
            mission: mission.map(Into::into),
            limit: limit(step, &start, &targets, findings),
            start,
            together: step.together,
            then: targets.named(step.then.as_ref(), findings),
            deeds: orders::read(step, setting, &mut flight, findings),
        });
    }
    (read, notes)
}

fn check_id(id: &Spanned<String>, before: &[WrittenStep], findings: &mut Findings) {
    let name = id.get_ref();
    let plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
    let is_good = !name.is_empty() && name.chars().all(plain) && name != END;
    if !is_good || name.chars().count() > LONGEST_ID {
        let fault = text!("lesson-id", name = name, most = LONGEST_ID);
        findings.fault(id.span(), fault);
    }
    if before.iter().any(|other| other.id.get_ref() == name) {
        findings.fault(id.span(), text!("lesson-id-twice", name = name));
    }
}

/// What a step waits for. Its condition is about the mission that is flown then.
fn start(step: &WrittenStep, flight: &StepFlight, findings: &mut Findings) -> StepStart {
    let Some(when) = &step.when else {
        return StepStart::AtOnce;
    };
    let source = when.get_ref().trim();
    if source == MANUAL {
        return StepStart::Instructor;
    }
    if let Some(fault) = condition_fault(source, flight) {
        let fault = fault.in_string(when.span(), when.get_ref().len());
        findings.faults.push(fault);
    }
    StepStart::When(source.into())
}

fn condition_fault(source: &str, flight: &StepFlight) -> Option<Diagnostic> {
    let whole = || 0..source.len();
    if flight.mission_id().is_none() {
        let fault = Diagnostic::new(whole(), text!("lesson-no-flight"));
        return Some(fault.with_help(text!("lesson-no-flight-help")));
    }
    if FlightMoment::named(source).is_some() {
        return None;
    }
    if source.chars().count() > LONGEST_CONDITION {
        let fault = text!("lesson-condition-long", most = LONGEST_CONDITION);
        return Some(Diagnostic::new(whole(), fault));
    }
    let checked = match flight.mission() {
        Some(mission) => mission.check_condition(source),
        None => check_condition(source),
    };
    let fault = checked.err()?;
    let is_word = source.chars().all(|c| c.is_alphanumeric() || c == '_');
    let moments = FlightMoment::ALL.into_iter().map(|(name, _)| name);
    Some(if is_word {
        let known = [MANUAL].into_iter().chain(moments);
        let fault = Diagnostic::new(whole(), text!("lesson-when", word = source));
        fault.with_nearest(source, known)
    } else {
        fault
    })
}

fn limit(
    step: &WrittenStep,
    start: &StepStart,
    targets: &Targets<'_>,
    findings: &mut Findings,
) -> Option<StepLimit> {
    match (&step.within, &step.otherwise) {
        (Some(within), Some(otherwise)) => {
            let seconds = *within.get_ref();
            if *start == StepStart::AtOnce && !step.together {
                findings.fault(within.span(), text!("lesson-limit-at-once"));
            } else if seconds == 0 || seconds > LONGEST_LIMIT_S {
                let fault = text!("lesson-limit", most = LONGEST_LIMIT_S, found = seconds);
                findings.fault(within.span(), fault);
            }
            Some(StepLimit {
                within: Duration::from_secs(seconds.into()),
                otherwise: targets.named(Some(otherwise), findings),
            })
        }
        (Some(alone), None) => {
            findings.fault(alone.span(), text!("lesson-within-alone"));
            None
        }
        (None, Some(alone)) => {
            findings.fault(alone.span(), text!("lesson-otherwise-alone"));
            None
        }
        (None, None) => None,
    }
}

/// The steps that a step may name.
struct Targets<'a> {
    steps: &'a [WrittenStep],
    at: usize,
}

impl Targets<'_> {
    /// The step with this name; without a name, the next one in the file.
    fn named(&self, name: Option<&Spanned<String>>, findings: &mut Findings) -> StepTarget {
        let next = if self.at + 1 < self.steps.len() {
            StepTarget::Step(self.at + 1)
        } else {
            StepTarget::End
        };
        let Some(name) = name else {
            return next;
        };
        let word = name.get_ref();
        let ids = || self.steps.iter().map(|step| step.id.get_ref().as_str());
        match ids().position(|id| id == word) {
            _ if word == END => StepTarget::End,
            Some(step) => StepTarget::Step(step),
            None => {
                let fault = Diagnostic::new(name.span(), text!("lesson-no-step", name = word));
                let known = ids().chain([END]);
                let list = known.clone().collect::<Vec<_>>().join(", ");
                let fault = fault.with_help(text!("lesson-known-steps", known = list));
                findings.faults.push(fault.with_nearest(word, known));
                next
            }
        }
    }
}
