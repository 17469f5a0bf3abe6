//! One command to one vehicle, from the first transmission to the effect in telemetry.

use std::time::Duration;

use super::{Output, VehicleCommand, parameter_code, precedence};
use crate::commands::{AckResult, Answer, Claim, Effect, Request};
use crate::ledger::{RowEnding, RowState, RowUpdate};
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle, VehicleId};
use crate::verb::Verb;

mod answer;
mod effect;
mod offboard;

/// How long later commands wait for the effect of a command that they depend on.
const SETTLE_PATIENCE: Duration = Duration::from_millis(1500);
/// Whether a transaction still holds up the commands behind it in its line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Progress {
    /// The line stays occupied.
    Waiting,
    /// The line is free; the effect is still awaited.
    Watching,
    Ended,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum TransactionPhase {
    /// Setpoints are sent that must arrive before the mode changes.
    Leading {
        until: Duration,
    },
    AwaitingAnswer {
        deadline: Duration,
        /// The vehicle is working on the command, so the command is not sent again.
        in_progress: bool,
        /// The vehicle rejected the command temporarily, so another attempt is worthwhile.
        rejected: bool,
    },
    /// Refused; the reason may still come.
    AwaitingReason {
        result: AckResult,
        until: Duration,
    },
    /// Accepted, or sent as a message that has no answer; the effect is awaited.
    AwaitingEffect {
        since: Duration,
        /// How many times a setpoint, which has no answer, was repeated.
        repeated: u8,
    },
    /// The time of a velocity in OFFBOARD is over, and the vehicle changes to AUTO.LOITER.
    Leaving {
        until: Duration,
        /// When the command is sent next.
        due: Duration,
    },
    Done,
    /// Refused, timed out, without effect, or ended because another source has taken over the
    /// vehicle.
    Over,
}

/// A command in progress.
#[derive(Debug, Clone)]
pub(super) struct Transaction {
    pub(super) order: VehicleCommand,
    vehicle: VehicleId,
    given: Duration,
    phase: TransactionPhase,
    tries: u8,
    first_sent: Duration,
    last_sent: Duration,
    /// When the next setpoint of OFFBOARD is sent.
    setpoint_due: Duration,
    /// The request, built once from the state at the first transmission: a repeated "10 m further"
    /// must not accumulate.
    request: Request,
    effect: Effect,
    /// Whether the effect was there before the command, in which case only newer telemetry proves
    /// it.
    effect_was_there: bool,
    is_accepted: bool,
    claim: Claim,
    /// When telemetry first agreed with the claim; only after that can another source contradict it.
    holds_since: Option<Duration>,
    /// How many steps of a chain have been accepted.
    accepted_steps: u8,
    /// When telemetry began to show the effect of a command that has not been answered.
    shown_since: Option<Duration>,
    /// Whether the effect showed while setpoints were being repeated.
    effect_has_shown: bool,
    texts: Vec<Text>,
    /// The report of another value than the one that was set.
    contrary: Option<Contrary>,
}

/// A parameter's value that differs from the one that was set: an old one, or the refusal.
#[derive(Debug, Clone)]
struct Contrary {
    text: Text,
    /// How long the value that was set may still follow.
    until: Duration,
}

impl Transaction {
    /// Sends a command that was given earlier, now that the line is free. `None` if it ended at once: too late, or
    /// invalid for this vehicle.
    pub fn start(
        order: VehicleCommand,
        given: Duration,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) -> Option<Self> {
        let deadline = given + order.verb.retry.deadline;
        let mut request = match prepare(&order, deadline, vehicle, now) {
            Ok(request) => request,
            Err(RowEnding { state, text }) => {
                output.row(order.unsent(vehicle.id, state, text, now));
                return None;
            }
        };
        parameter_code::encode(&mut request, &order);
        let effect = order.command.effect(vehicle);
        let phase = match request.answer {
            Answer::None | Answer::NotAwaited(_) => TransactionPhase::AwaitingEffect {
                since: now,
                repeated: 0,
            },
            Answer::Ack(_) | Answer::Parameter(_) => TransactionPhase::AwaitingAnswer {
                deadline,
                in_progress: false,
                rejected: false,
            },
        };
        let phase = offboard::lead(&request, now)
            .map_or(phase, |until| TransactionPhase::Leading { until });
        let mut transaction = Self {
            vehicle: vehicle.id,
            given,
            phase,
            tries: 0,
            first_sent: now,
            last_sent: now,
            setpoint_due: now,
            effect_was_there: effect.seen(vehicle) == Some(true),
            is_accepted: request.answer == Answer::None,
            claim: order.command.claim(vehicle),
            holds_since: None,
            accepted_steps: 0,
            shown_since: None,
            effect_has_shown: false,
            effect,
            request,
            texts: Vec::new(),
            contrary: None,
            order,
        };
        if matches!(transaction.phase, TransactionPhase::Leading { .. }) {
            transaction.stream(now, output);
            return Some(transaction);
        }
        transaction.send(now, output);
        if matches!(transaction.request.answer, Answer::NotAwaited(_)) {
            transaction.end(RowState::SentOnly, None, now, output);
        }
        Some(transaction)
    }

    pub fn verb(&self) -> &'static Verb {
        self.order.verb
    }

    /// Whether it was accepted and decides where the vehicle flies.
    pub fn moves_the_vehicle(&self) -> bool {
        self.is_accepted && self.order.verb.movement.moves()
    }

    /// Whether the vehicle has accepted it, or it has no answer.
    pub fn is_accepted(&self) -> bool {
        self.is_accepted
    }

    /// The claim that holds while its effect lasts.
    pub fn claim(&self) -> Claim {
        self.claim
    }

    /// Whether it was carried out.
    pub fn is_done(&self) -> bool {
        self.phase == TransactionPhase::Done
    }

    /// Whether a newer movement supersedes the command.
    pub fn gives_way_to_movement(&self) -> bool {
        self.order.verb.movement.gives_way()
    }

    /// The command whose acknowledgements may still arrive if it is dropped now, and their number.
    pub fn owed_acks(&self) -> Option<(u16, u8)> {
        match (&self.request.answer, self.phase) {
            (Answer::Ack(command), TransactionPhase::AwaitingAnswer { .. })
            | (Answer::NotAwaited(Some(command)), TransactionPhase::Over) => {
                Some((*command, self.tries))
            }
            _ => None,
        }
    }

    /// Ends the command in favour of another one.
    pub fn supersede(&self, reason: &Text, now: Duration, output: &mut Output) {
        self.report(RowState::Superseded, Some(reason.clone()), now, output);
    }

    /// Stores a status text, which may explain a refusal.
    pub fn hear_text(&mut self, notice: &Notice) {
        // A command that was sent again may be refused with the same texts.
        if notice.severity <= Severity::Warning && !self.texts.contains(&notice.text) {
            self.texts.push(notice.text.clone());
        }
    }

    /// Ends the command if telemetry contradicts its claim after having agreed with it: another
    /// source has taken control of the vehicle.
    pub fn yield_to_others(&mut self, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        if matches!(self.phase, TransactionPhase::Leaving { .. }) {
            return;
        }
        let by = self.claim.contradicted(vehicle);
        match by {
            Some(by) if self.holds_since.is_some() => {
                self.end(RowState::Overtaken, Some(by), now, output);
            }
            Some(_) => {}
            None => {
                self.holds_since.get_or_insert(now);
            }
        }
    }

    /// Advances time and reports changes.
    pub fn poll(&mut self, vehicle: &Vehicle, now: Duration, output: &mut Output) -> Progress {
        match self.phase {
            TransactionPhase::Leading { until } => self.lead_in(until, now, output),
            TransactionPhase::Leaving { until, due } => {
                self.leave_offboard(until, due, vehicle, now, output);
            }
            TransactionPhase::AwaitingAnswer { .. } => self.await_answer(vehicle, now, output),
            TransactionPhase::AwaitingReason { result, until } if now >= until => {
                self.refuse(result, vehicle, now, output);
            }
            TransactionPhase::AwaitingReason { .. }
            | TransactionPhase::Done
            | TransactionPhase::Over => {}
            TransactionPhase::AwaitingEffect { since, .. } => match self.order.command.repeat() {
                Some(repeat) => self.keep_up(repeat, since, vehicle, now, output),
                None => self.await_effect(since, vehicle, now, output),
            },
        }
        match self.phase {
            TransactionPhase::Done | TransactionPhase::Over => Progress::Ended,
            TransactionPhase::AwaitingEffect { since, .. } if self.is_settled(since, now) => {
                Progress::Watching
            }
            TransactionPhase::Leaving { .. } => Progress::Watching,
            TransactionPhase::Leading { .. }
            | TransactionPhase::AwaitingAnswer { .. }
            | TransactionPhase::AwaitingReason { .. }
            | TransactionPhase::AwaitingEffect { .. } => Progress::Waiting,
        }
    }

    fn is_settled(&self, since: Duration, now: Duration) -> bool {
        let is_awaited = precedence::later_ones_depend_on_it(&self.order);
        !is_awaited || now >= since + SETTLE_PATIENCE
    }

    /// Adds the messages to the output, followed by the speeds that the vehicle forgets with them.
    fn transmit(&self, output: &mut Output) {
        let Request {
            messages, speeds, ..
        } = &self.request;
        output.messages.extend(messages.iter().cloned());
        output.say_speeds(speeds.clone());
    }

    fn send(&mut self, now: Duration, output: &mut Output) {
        self.transmit(output);
        self.request.again();
        self.tries = self.tries.saturating_add(1);
        self.last_sent = now;
        self.report(RowState::Sent, None, now, output);
    }

    fn end(
        &mut self,
        state: RowState,
        explanation: Option<Text>,
        now: Duration,
        output: &mut Output,
    ) {
        self.phase = if state == RowState::Done {
            TransactionPhase::Done
        } else {
            TransactionPhase::Over
        };
        self.report(state, explanation, now, output);
    }

    fn report(
        &self,
        state: RowState,
        explanation: Option<Text>,
        now: Duration,
        output: &mut Output,
    ) {
        output.row(RowUpdate {
            entry: self.order.entry,
            vehicle: self.vehicle,
            state,
            tries: self.tries,
            at: now,
            explanation,
        });
    }
}

/// Prepares the request of an order, or ends the order without sending.
fn prepare(
    order: &VehicleCommand,
    deadline: Duration,
    vehicle: &Vehicle,
    now: Duration,
) -> Result<Request, RowEnding> {
    if now >= deadline {
        let allowed_s = order.verb.retry.deadline.as_secs_f64();
        let reason = text!("outcome-too-late", seconds = format!("{allowed_s:.1}"));
        return Err(RowEnding::new(RowState::TimedOut, reason));
    }
    order
        .command
        .request(vehicle, 0)
        .map_err(|reason| RowEnding::new(RowState::Refused, reason))
}
