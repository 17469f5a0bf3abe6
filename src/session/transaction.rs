//! One command to one vehicle, from the first transmission to the effect in telemetry.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;

use super::acknowledgement::Acknowledgement;
use super::{Order, Report, precedence};
use crate::commands::{AckResult, Answer, Effect, Request, explain};
use crate::ledger::{RowState, RowUpdate};
use crate::notice::Notice;
use crate::vehicle::{Severity, Vehicle};
use crate::wire::{Content, Frame, Outgoing};

/// Status texts that explain a refusal may come a little after it.
const REASON_PATIENCE: Duration = Duration::from_millis(300);
/// A vehicle that says "in progress" is given this long until it says something again.
const PROGRESS_PATIENCE: Duration = Duration::from_secs(20);
/// How long later commands wait for the effect of one that they depend on.
const SETTLE_PATIENCE: Duration = Duration::from_millis(1500);
/// The progress that `COMMAND_ACK` carries where it says nothing about it.
const PROGRESS_UNKNOWN: u8 = 255;

/// What a transaction needs next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Progress {
    /// The line stays taken.
    Waiting,
    /// The line is free; the effect is still awaited.
    Watching,
    /// Nothing more will happen.
    Ended,
}

/// Where a transaction stands.
#[derive(Debug, Clone, PartialEq)]
enum Phase {
    /// Not sent yet.
    Fresh,
    /// Sent; the answer is awaited until the deadline.
    AwaitingAnswer { deadline: Duration },
    /// Refused; the reason may still come.
    AwaitingReason { result: AckResult, until: Duration },
    /// Accepted, or sent where no answer exists.
    AwaitingEffect { since: Duration },
    /// Over.
    Over,
}

/// A command under way.
#[derive(Debug)]
pub(super) struct Transaction {
    order: Order,
    given: Duration,
    phase: Phase,
    tries: u8,
    /// How often a setpoint, which nothing answers, has been said again.
    setpoints_repeated: u8,
    first_sent: Duration,
    last_sent: Duration,
    /// Built once, from the state at the first transmission: a repeated "10 m further" must not add up.
    request: Option<Request>,
    effect: Option<Effect>,
    /// The effect was there before the command was; it proves nothing then.
    effect_was_there: bool,
    /// What the vehicle said since the first transmission.
    texts: Vec<String>,
    /// It has been heard and is worked on, so it is not sent again.
    in_progress: bool,
    /// The answer so far, where it was one that allows another try.
    last_result: Option<AckResult>,
    /// When it was accepted.
    answered_at: Option<Duration>,
    /// Row updates that `receive` found and `poll` has yet to report.
    pending: Vec<(RowState, Option<String>)>,
}

impl Transaction {
    /// A command that was given at some time and has not been sent.
    pub fn new(order: Order, given: Duration) -> Self {
        Self {
            order,
            given,
            phase: Phase::Fresh,
            tries: 0,
            setpoints_repeated: 0,
            first_sent: given,
            last_sent: given,
            request: None,
            effect: None,
            effect_was_there: false,
            texts: Vec::new(),
            in_progress: false,
            last_result: None,
            answered_at: None,
            pending: Vec::new(),
        }
    }

    /// The verb it was given with.
    pub fn verb(&self) -> &'static str {
        self.order.verb
    }

    /// Whether it decides where the vehicle flies.
    pub fn moves_the_vehicle(&self) -> bool {
        precedence::moves_the_vehicle(&self.order.command)
    }

    /// The last update of a transaction that gives way to another.
    pub fn superseded(&self, vehicle: &Vehicle, reason: &str, now: Duration) -> RowUpdate {
        self.row(vehicle, RowState::Superseded, Some(reason.to_owned()), now)
    }

    /// Remembers what the vehicle says meanwhile; it may be the reason of a refusal.
    pub fn hear_text(&mut self, notice: &Notice) {
        if self.tries > 0 && notice.severity <= Severity::Warning {
            self.texts.push(notice.text.clone());
        }
    }

    /// Looks for the answer in a frame of the vehicle.
    pub fn receive(&mut self, frame: &Frame, vehicle: &Vehicle, now: Duration) {
        if !matches!(self.phase, Phase::AwaitingAnswer { .. })
            || frame.component != vehicle.component
        {
            return;
        }
        let answer = self.request.as_ref().map(|request| &request.answer);
        match (answer, &frame.content) {
            (Some(Answer::Ack(command)), _) => {
                if let Some(ack) = Acknowledgement::from_frame(frame)
                    && ack.command == *command
                {
                    self.acknowledged(ack, now);
                }
            }
            (Some(Answer::Parameter(name)), Content::Message(MavMessage::PARAM_VALUE(value)))
                if value
                    .param_id
                    .to_str()
                    .is_ok_and(|id| id.eq_ignore_ascii_case(name)) =>
            {
                match self.order.command.parameter_outcome(value.param_value) {
                    Ok(text) => self.accept(Some(text), now),
                    Err(text) => self.end(RowState::Refused, Some(text)),
                }
            }
            _ => {}
        }
    }

    /// Lets time pass and reports what changed.
    pub fn poll(
        &mut self,
        vehicle: &Vehicle,
        now: Duration,
        outgoing: &mut Vec<Outgoing>,
        reports: &mut Vec<Report>,
    ) -> Progress {
        match self.phase {
            Phase::Fresh => self.start(vehicle, now, outgoing),
            Phase::AwaitingAnswer { deadline } => {
                self.await_answer(vehicle, deadline, now, outgoing);
            }
            Phase::AwaitingReason { result, until } if now >= until => {
                self.refuse(result, vehicle);
            }
            Phase::AwaitingReason { .. } | Phase::Over => {}
            Phase::AwaitingEffect { since } => self.await_effect(vehicle, since, now, outgoing),
        }
        for (state, explanation) in std::mem::take(&mut self.pending) {
            reports.push(Report::Row(self.row(vehicle, state, explanation, now)));
        }
        self.progress(now)
    }

    fn progress(&self, now: Duration) -> Progress {
        match self.phase {
            Phase::Over => Progress::Ended,
            Phase::AwaitingEffect { .. } if self.is_settled(now) => Progress::Watching,
            _ => Progress::Waiting,
        }
    }

    fn is_settled(&self, now: Duration) -> bool {
        !precedence::later_ones_depend_on_it(&self.order.command)
            || self
                .answered_at
                .is_none_or(|answered| now >= answered + SETTLE_PATIENCE)
    }

    fn start(&mut self, vehicle: &Vehicle, now: Duration, outgoing: &mut Vec<Outgoing>) {
        let deadline = self.given + self.order.retry.deadline;
        if now > deadline {
            let text = format!(
                "not sent: its {:.1} s were over before the line was free",
                self.order.retry.deadline.as_secs_f64()
            );
            return self.end(RowState::TimedOut, Some(text));
        }
        let request = match self.order.command.request(vehicle, 0) {
            Ok(request) => request,
            Err(reason) => return self.end(RowState::Refused, Some(reason)),
        };
        let effect = self.order.command.effect(vehicle);
        self.effect_was_there = effect.seen(vehicle) == Some(true);
        self.effect = Some(effect);
        self.first_sent = now;
        self.phase = match request.answer {
            Answer::None => Phase::AwaitingEffect { since: now },
            Answer::Ack(_) | Answer::Parameter(_) => Phase::AwaitingAnswer { deadline },
        };
        self.request = Some(request);
        self.send(now, outgoing);
    }

    /// Sends the request, and prepares it for another try.
    fn send(&mut self, now: Duration, outgoing: &mut Vec<Outgoing>) {
        let Some(request) = &mut self.request else {
            return;
        };
        outgoing.extend(request.messages.iter().cloned());
        request.again();
        self.tries = self.tries.saturating_add(1);
        self.last_sent = now;
        self.pending.push((RowState::Sent, None));
    }

    fn may_send_again(&self, now: Duration) -> bool {
        !self.in_progress
            && self.tries < self.order.retry.tries
            && now >= self.last_sent + self.order.retry.every
            && now < self.given + self.order.retry.deadline
    }

    fn may_repeat_setpoint(&self, now: Duration) -> bool {
        self.setpoints_repeated + 1 < self.order.retry.tries
            && now >= self.last_sent + self.order.retry.every
    }

    fn await_answer(
        &mut self,
        vehicle: &Vehicle,
        deadline: Duration,
        now: Duration,
        outgoing: &mut Vec<Outgoing>,
    ) {
        if self.effect_has_come(vehicle) {
            return self.end(
                RowState::Done,
                Some("seen in telemetry, the answer was lost".to_owned()),
            );
        }
        if now >= deadline {
            return match self.last_result {
                Some(result) => self.refuse(result, vehicle),
                None => self.end(
                    RowState::TimedOut,
                    Some(format!(
                        "no answer to {} {} in {:.1} s",
                        self.tries,
                        if self.tries == 1 { "try" } else { "tries" },
                        now.saturating_sub(self.first_sent).as_secs_f64()
                    )),
                ),
            };
        }
        if self.may_send_again(now) {
            self.send(now, outgoing);
        }
    }

    fn await_effect(
        &mut self,
        vehicle: &Vehicle,
        since: Duration,
        now: Duration,
        outgoing: &mut Vec<Outgoing>,
    ) {
        let repeat = self.order.command.repeat();
        if let Some(repeat) = &repeat {
            if now >= since + repeat.lasting {
                outgoing.extend(
                    self.request
                        .as_mut()
                        .and_then(|request| request.closing.take()),
                );
                return self.end(RowState::Done, None);
            }
            if now >= self.last_sent + repeat.every {
                self.last_sent = now;
                outgoing.extend(
                    self.request
                        .iter()
                        .flat_map(|request| request.messages.clone()),
                );
            }
            return;
        }
        let Some(effect) = &self.effect else {
            return self.end(RowState::Done, None);
        };
        match effect.seen(vehicle) {
            None | Some(true) => self.end(RowState::Done, None),
            Some(false) if now >= since + effect.within() => {
                let text = format!(
                    "{} not seen within {:.0} s",
                    effect.describe(),
                    effect.within().as_secs_f64()
                );
                self.end(RowState::NoEffect, Some(text));
            }
            // Nothing acknowledges a setpoint, so it is said again in case it was lost. That is no new try:
            // nobody knows that the first one failed.
            Some(false) if self.answered_at.is_none() && self.may_repeat_setpoint(now) => {
                self.setpoints_repeated += 1;
                self.last_sent = now;
                outgoing.extend(
                    self.request
                        .iter()
                        .flat_map(|request| request.messages.clone()),
                );
            }
            Some(false) => {}
        }
    }

    fn effect_has_come(&self, vehicle: &Vehicle) -> bool {
        !self.effect_was_there
            && self
                .effect
                .as_ref()
                .is_some_and(|effect| effect.seen(vehicle) == Some(true))
    }

    fn acknowledged(&mut self, ack: Acknowledgement, now: Duration) {
        match ack.result {
            AckResult::Accepted => self.accept(None, now),
            AckResult::InProgress => {
                let percent = match ack.progress {
                    PROGRESS_UNKNOWN => 0,
                    percent => percent.min(100),
                };
                self.pending.push((RowState::InProgress(percent), None));
                self.in_progress = true;
                self.phase = Phase::AwaitingAnswer {
                    deadline: now + PROGRESS_PATIENCE,
                };
            }
            AckResult::TemporarilyRejected => self.last_result = Some(ack.result),
            result => {
                self.phase = Phase::AwaitingReason {
                    result,
                    until: now + REASON_PATIENCE,
                };
            }
        }
    }

    fn accept(&mut self, remark: Option<String>, now: Duration) {
        self.pending.push((RowState::Accepted, remark));
        self.answered_at = Some(now);
        self.phase = Phase::AwaitingEffect { since: now };
    }

    fn refuse(&mut self, result: AckResult, vehicle: &Vehicle) {
        let text = explain(
            self.order.verb,
            result,
            &self.texts,
            vehicle,
            &self.order.command,
        );
        self.end(RowState::Refused, Some(text));
    }

    fn end(&mut self, state: RowState, explanation: Option<String>) {
        self.pending.push((state, explanation));
        self.phase = Phase::Over;
    }

    fn row(
        &self,
        vehicle: &Vehicle,
        state: RowState,
        explanation: Option<String>,
        now: Duration,
    ) -> RowUpdate {
        RowUpdate {
            entry: self.order.entry,
            vehicle: vehicle.id,
            state,
            tries: self.tries,
            at: now,
            explanation,
        }
    }
}
