//! The answer to a command: its reception and its result.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;

use super::{Contrary, Transaction, TransactionPhase};
use crate::commands::{AckResult, Answer, explain};
use crate::ledger::RowState;
use crate::messages::parameter_value;
use crate::session::Output;
use crate::session::acknowledgement::Acknowledgement;
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;
use crate::wire::{Content, Frame};

/// How long status texts may follow a refusal to explain it.
const REASON_PATIENCE: Duration = Duration::from_millis(300);
/// The maximum delay from the telemetry that shows a command's effect to the command's answer:
/// vehicles may send both in any order.
const ANSWER_FOLLOWS_WITHIN: Duration = Duration::from_millis(300);
/// How long after an "in progress" answer the next answer may take.
const PROGRESS_PATIENCE: Duration = Duration::from_secs(20);
/// How long a different value of a parameter that was set may be followed by the one that was set:
/// while a list is downloaded, or another value is read, the old value may still be on its way.
const CONTRARY_PATIENCE: Duration = Duration::from_secs(1);
/// The value in `COMMAND_ACK` for an unknown progress.
const PROGRESS_UNKNOWN: u8 = 255;

impl Transaction {
    /// Looks for the answer in a frame of the vehicle's autopilot.
    pub fn receive(
        &mut self,
        frame: &Frame,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        if !matches!(self.phase, TransactionPhase::AwaitingAnswer { .. }) {
            return;
        }
        match (&self.request.answer, &frame.content) {
            (Answer::Ack(command), _) => {
                if let Some(ack) = Acknowledgement::from_frame(frame, vehicle.station)
                    && ack.command == *command
                {
                    self.acknowledged(ack, now, output);
                }
            }
            (Answer::Parameter(name), Content::Message(MavMessage::PARAM_VALUE(value))) => {
                let id = value.param_id.to_str();
                if id.is_ok_and(|id| id.eq_ignore_ascii_case(name)) {
                    match self
                        .order
                        .parameter_outcome(parameter_value(value, vehicle))
                    {
                        Ok(text) => self.accept(Some(text), now, output),
                        Err(text) => self.contradict(text, now),
                    }
                }
            }
            _ => {}
        }
    }

    /// Advances time while the answer is awaited: retries, or gives up.
    pub(super) fn await_answer(&mut self, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        let TransactionPhase::AwaitingAnswer {
            deadline,
            in_progress,
            rejected,
        } = self.phase
        else {
            return;
        };
        self.stream(now, output);
        if self.has_entered_offboard(vehicle) {
            return self.accept(None, now, output);
        }
        if let Some(contrary) = self.contrary.take_if(|contrary| now >= contrary.until) {
            return self.end(RowState::Refused, Some(contrary.text), now, output);
        }
        if self.is_answer_lost(vehicle, deadline, now) {
            let remark = text!("outcome-answer-lost");
            return self.end(RowState::Done, Some(remark), now, output);
        }
        if now >= deadline {
            if rejected {
                return self.refuse(AckResult::TemporarilyRejected, vehicle, now, output);
            }
            let text = if in_progress {
                text!("outcome-fell-silent")
            } else {
                self.silence(now)
            };
            return self.end(RowState::TimedOut, Some(text), now, output);
        }
        let retry = self.order.verb.retry;
        if !in_progress
            && self.tries < retry.tries
            && now >= self.last_sent + retry.every
            && now < self.given + retry.deadline
        {
            self.send(now, output);
        }
    }

    /// Whether telemetry shows the effect, and the answer can no longer be on its way. The effect
    /// of a chain shows only at its end, and the first steps may bring it about: until the
    /// deadline, the last step is sent again.
    fn is_answer_lost(&mut self, vehicle: &Vehicle, deadline: Duration, now: Duration) -> bool {
        let is_sequel_due = self.request.next.is_some() || self.request.offboard.is_some();
        if is_sequel_due || self.effect_shows(vehicle) != Some(true) {
            self.shown_since = None;
            return false;
        }
        let shown_since = *self.shown_since.get_or_insert(now);
        if self.accepted_steps > 0 {
            now >= deadline
        } else {
            now >= shown_since + ANSWER_FOLLOWS_WITHIN || now >= deadline
        }
    }

    /// Notes that the vehicle has reported another value than the one that was set.
    fn contradict(&mut self, text: Text, now: Duration) {
        let before = self.contrary.take();
        let until = before.map_or(now + CONTRARY_PATIENCE, |before| before.until);
        self.contrary = Some(Contrary { text, until });
    }

    fn silence(&self, now: Duration) -> Text {
        let seconds = now.saturating_sub(self.first_sent).as_secs_f64();
        let seconds = format!("{seconds:.1}");
        let silence = text!("outcome-no-answer", tries = self.tries, seconds = seconds);
        match &self.request.answer {
            // Vehicles ignore unknown parameter names.
            Answer::Parameter(name) => {
                let guess = text!("outcome-no-parameter", name = name);
                Text::joined("; ", vec![silence, guess])
            }
            Answer::Ack(_) | Answer::None | Answer::NotAwaited(_) => silence,
        }
    }

    fn acknowledged(&mut self, ack: Acknowledgement, now: Duration, output: &mut Output) {
        match (ack.result, &mut self.phase) {
            (AckResult::Accepted, _) => self.accept(None, now, output),
            (AckResult::InProgress, _) => {
                let percent = match ack.progress {
                    PROGRESS_UNKNOWN => 0,
                    percent => percent.min(100),
                };
                self.phase = TransactionPhase::AwaitingAnswer {
                    deadline: now + PROGRESS_PATIENCE,
                    in_progress: true,
                    rejected: false,
                };
                self.report(RowState::InProgress(percent), None, now, output);
            }
            (AckResult::TemporarilyRejected, TransactionPhase::AwaitingAnswer { rejected, .. }) => {
                *rejected = true;
            }
            (result, _) => {
                self.phase = TransactionPhase::AwaitingReason {
                    result,
                    until: now + REASON_PATIENCE,
                };
            }
        }
    }

    fn accept(&mut self, remark: Option<Text>, now: Duration, output: &mut Output) {
        if let Some(next) = self.request.next.take() {
            self.request = *next;
            self.tries = 0;
            self.accepted_steps = self.accepted_steps.saturating_add(1);
            self.phase = TransactionPhase::AwaitingAnswer {
                deadline: self.given + self.order.verb.retry.deadline,
                in_progress: false,
                rejected: false,
            };
            return self.send(now, output);
        }
        self.is_accepted = true;
        self.phase = TransactionPhase::AwaitingEffect {
            since: now,
            repeated: 0,
        };
        self.report(RowState::Accepted, remark, now, output);
    }

    /// Ends the command with the vehicle's reason.
    pub(super) fn refuse(
        &mut self,
        result: AckResult,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        let order = &self.order;
        let text = explain(
            order.verb.name,
            result,
            &self.texts,
            vehicle,
            &order.command,
        );
        self.end(RowState::Refused, Some(text), now, output);
    }
}
