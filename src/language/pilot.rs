//! Pilot scripts: lines of the language, in sequence.

use std::ops::Range;
use std::time::Duration;

use super::lexer::words;
use super::wait::{Seen, Until, Wait};
use super::{Channel, Context, Meaning, Statement, Targets, parse};
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::vehicle::VehicleId;

/// A script without faults.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Script {
    steps: Vec<PilotStep>,
}

#[derive(Debug, Clone, PartialEq)]
struct PilotStep {
    /// Its line in the source, counted from 1.
    line: usize,
    statement: Statement,
    /// The target vehicles; `None` for all that exist when the line is reached.
    vehicles: Option<Vec<VehicleId>>,
    /// The condition of the line; if it does not hold, the line is skipped.
    only_if: Option<Guard>,
}

/// The condition of a line: `if 3 alerted then 3 rtl`.
#[derive(Debug, Clone, PartialEq)]
struct Guard {
    condition: Wait,
    /// The vehicles for which the condition must hold; `None` for all.
    vehicles: Option<Vec<VehicleId>>,
}

impl Script {
    /// Reads a script. Empty lines and comments (`#`) are allowed. A script has no selection: every line must have
    /// targets, except a wait for a time, for contacts or for alerts.
    ///
    /// # Errors
    /// Every fault, with its position in the whole source.
    pub fn parse(source: &str, context: &Context) -> Result<Self, Vec<Diagnostic>> {
        let context = &Context {
            channel: Channel::Script,
            ..*context
        };
        let mut steps = Vec::new();
        let mut faults = Vec::new();
        let mut start = 0;
        for (index, line) in source.split_inclusive('\n').enumerate() {
            if !words(line).is_empty() {
                match step(line, index + 1, context) {
                    Ok(step) => steps.push(step),
                    Err(mut fault) => {
                        fault.span = fault.span.start + start..fault.span.end + start;
                        faults.push(fault);
                    }
                }
            }
            start += line.len();
        }
        if faults.is_empty() {
            Ok(Self { steps })
        } else {
            Err(faults)
        }
    }
}

/// The words of a line with a condition.
const IF: &str = "if";
const THEN: &str = "then";

/// Reads a line, with its condition if it has one.
fn step(line: &str, number: usize, context: &Context) -> Result<PilotStep, Diagnostic> {
    let words = words(line);
    let Some(first) = words.first().filter(|word| word.is(IF)) else {
        return plain_step(line, number, context);
    };
    let Some(then) = words.iter().find(|word| word.is(THEN)) else {
        return Err(Diagnostic::new(
            first.span.clone(),
            text!("grammar-if-then"),
        ));
    };
    let guard = guard(line, first.span.end..then.span.start, number, context)?;
    let rest = then.span.end;
    let step = plain_step(&line[rest..], number, context).map_err(|fault| moved(fault, rest, 0))?;
    Ok(PilotStep {
        only_if: Some(guard),
        ..step
    })
}

/// Reads a condition, which is written like that of a wait.
fn guard(
    line: &str,
    span: Range<usize>,
    number: usize,
    context: &Context,
) -> Result<Guard, Diagnostic> {
    let wait = format!("wait{}", line[span.clone()].trim_end());
    let begin = span.start;
    let step =
        plain_step(&wait, number, context).map_err(|fault| moved(fault, begin, "wait".len()))?;
    match step.statement.meaning {
        Meaning::Wait(condition) if !is_pause(&condition) => Ok(Guard {
            condition,
            vehicles: step.vehicles,
        }),
        _ => Err(Diagnostic::new(span, text!("grammar-if-state"))),
    }
}

/// Moves a fault from a part to the whole line, in which the part begins at `start`; the first
/// `before` bytes of the part are not in the line.
fn moved(fault: Diagnostic, start: usize, before: usize) -> Diagnostic {
    let place = |at: usize| start + at.saturating_sub(before);
    Diagnostic {
        span: place(fault.span.start)..place(fault.span.end),
        ..fault
    }
}

fn plain_step(line: &str, number: usize, context: &Context) -> Result<PilotStep, Diagnostic> {
    let statement = parse(line, context)?;
    let needs_no_vehicle =
        matches!(&statement.meaning, Meaning::Wait(wait) if !wait.until.is_of_vehicles());
    let span = words(line).first().map_or(0..0, |word| word.span.clone());
    if matches!(statement.meaning, Meaning::Console(_)) {
        let message = text!("grammar-only-console", verb = statement.line.trim_end());
        return Err(Diagnostic::new(span, message));
    }
    let vehicles = match &statement.targets {
        Targets::Selection if !needs_no_vehicle => {
            return Err(Diagnostic::new(span, text!("grammar-script-selection"))
                .with_help(text!("grammar-say-who", line = with_all(&statement))));
        }
        Targets::Selection | Targets::All => None,
        targets @ (Targets::Ids(_) | Targets::Group(_)) => Some(
            targets
                .resolve(&[], context)
                .map_err(|reason| Diagnostic::new(span, reason))?,
        ),
    };
    Ok(PilotStep {
        line: number,
        statement,
        vehicles,
        only_if: None,
    })
}

/// The line with `all` as its targets.
fn with_all(statement: &Statement) -> String {
    match statement.line.strip_prefix("wait ") {
        Some(rest) => format!("wait all {rest}"),
        None => format!("all {}", statement.line),
    }
}

/// An action of a script.
#[derive(Debug, Clone, PartialEq)]
pub enum PilotEvent {
    /// Carry out this line now.
    Do(Statement),
    /// A wait timed out; the script continues.
    WaitTimedOut {
        /// Its line in the source, counted from 1.
        line: usize,
        text: String,
    },
    /// The script is over; sent once.
    Finished,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Pilot {
    script: Script,
    next: usize,
    waiting_since: Option<Duration>,
    finished: bool,
}

impl Pilot {
    /// A pilot at the beginning of a script.
    pub fn new(script: Script) -> Self {
        Self {
            script,
            next: 0,
            waiting_since: None,
            finished: false,
        }
    }

    /// The script's next actions. The caller opens the ledger's entries for the statements before the next step. A wait
    /// that follows a command is evaluated only then, so that `wait all arrived` refers to the goto before it.
    pub fn step(&mut self, now: Duration, seen: Seen<'_>) -> Vec<PilotEvent> {
        let mut events = Vec::new();
        let mut acted = false;
        while let Some(step) = self.script.steps.get(self.next) {
            if let Some(guard) = &step.only_if
                && self.waiting_since.is_none()
            {
                // A condition that follows a command sees its consequences only in the next step.
                if acted {
                    return events;
                }
                if !holds(&guard.condition, guard.vehicles.as_deref(), seen) {
                    self.next += 1;
                    continue;
                }
            }
            if let Meaning::Wait(wait) = &step.statement.meaning {
                let since = *self.waiting_since.get_or_insert(now);
                let waited = now.saturating_sub(since);
                if !(is_over(wait, waited) || !acted && holds(wait, step.vehicles.as_deref(), seen))
                {
                    if acted || waited < wait.timeout || is_pause(wait) {
                        return events;
                    }
                    events.push(PilotEvent::WaitTimedOut {
                        line: step.line,
                        text: step.statement.line.clone(),
                    });
                }
                self.waiting_since = None;
            } else {
                events.push(PilotEvent::Do(step.statement.clone()));
                acted = true;
            }
            self.next += 1;
        }
        if !self.finished {
            self.finished = true;
            events.push(PilotEvent::Finished);
        }
        events
    }
}

fn is_pause(wait: &Wait) -> bool {
    matches!(wait.until, Until::Passed(_))
}

/// Whether a wait for a time is over.
fn is_over(wait: &Wait, waited: Duration) -> bool {
    matches!(wait.until, Until::Passed(time) if waited >= time)
}

/// Whether a condition holds for all of these vehicles; with `None`, for all known vehicles, of which there must be
/// at least one.
fn holds(wait: &Wait, vehicles: Option<&[VehicleId]>, seen: Seen<'_>) -> bool {
    let known = seen.vehicles;
    match vehicles {
        None => {
            let mut all = known.values();
            !known.is_empty() && all.all(|vehicle| wait.until.holds(vehicle, seen))
        }
        Some(ids) => ids.iter().all(|id| {
            let vehicle = known.get(id);
            vehicle.is_some_and(|vehicle| wait.until.holds(vehicle, seen))
        }),
    }
}

#[cfg(test)]
mod tests;
