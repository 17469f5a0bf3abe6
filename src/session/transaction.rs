//! One command to one vehicle, from the first transmission to the effect in telemetry.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;

use super::acknowledgement::Acknowledgement;
use super::{Order, Output, precedence};
use crate::commands::{AckResult, Answer, Effect, Repeat, Request, explain};
use crate::ledger::{RowState, RowUpdate};
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle, VehicleId};
use crate::wire::{Content, Frame};

/// Status texts that explain a refusal may come a little after it.
const REASON_PATIENCE: Duration = Duration::from_millis(300);
/// A vehicle that says "in progress" is given this long until it says something again.
const PROGRESS_PATIENCE: Duration = Duration::from_secs(20);
/// How long later commands wait for the effect of one that they depend on.
const SETTLE_PATIENCE: Duration = Duration::from_millis(1500);
/// A velocity that is held for less than this may end before the vehicle has gathered speed (0 to 5 m/s takes
/// an ArduCopter 2.4 s), so that nothing follows from not having seen it.
const GATHERING_SPEED: Duration = Duration::from_secs(4);
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
#[derive(Debug, Clone, Copy, PartialEq)]
enum Phase {
    /// Sent; the answer is awaited.
    AwaitingAnswer {
        deadline: Duration,
        /// The vehicle works on it, so it is not sent again.
        in_progress: bool,
        /// It has said "not now": worth another try.
        rejected: bool,
    },
    /// Refused; the reason may still come.
    AwaitingReason { result: AckResult, until: Duration },
    /// Accepted, or sent where no answer exists.
    AwaitingEffect {
        since: Duration,
        /// How often a setpoint, which nothing answers, has been said again.
        repeated: u8,
    },
    /// Over.
    Over,
}

/// A command under way.
#[derive(Debug)]
pub(super) struct Transaction {
    pub(super) order: Order,
    vehicle: VehicleId,
    given: Duration,
    phase: Phase,
    tries: u8,
    first_sent: Duration,
    last_sent: Duration,
    /// Built once, from the state at the first transmission: a repeated "10 m further" must not add up.
    request: Request,
    effect: Effect,
    /// The effect was there before the command was: only telemetry that is newer proves anything.
    effect_was_there: bool,
    /// It was accepted, or sent where nothing accepts it.
    is_accepted: bool,
    /// The effect has shown while setpoints were being repeated.
    effect_has_shown: bool,
    /// What the vehicle said since the first transmission.
    texts: Vec<Text>,
}

impl Transaction {
    /// Sends a command that was given at some time, now that the line is free. `None` when it had to end at
    /// once: too late, or senseless for this vehicle.
    pub fn start(
        order: Order,
        given: Duration,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) -> Option<Self> {
        let deadline = given + order.retry.deadline;
        let request = match prepare(&order, deadline, vehicle, now) {
            Ok(request) => request,
            Err((state, reason)) => {
                output.row(order.unsent(vehicle.id, state, reason, now));
                return None;
            }
        };
        let effect = order.command.effect(vehicle);
        let phase = match request.answer {
            Answer::None => Phase::AwaitingEffect {
                since: now,
                repeated: 0,
            },
            Answer::Ack(_) | Answer::Parameter(_) => Phase::AwaitingAnswer {
                deadline,
                in_progress: false,
                rejected: false,
            },
        };
        let mut transaction = Self {
            vehicle: vehicle.id,
            given,
            phase,
            tries: 0,
            first_sent: now,
            last_sent: now,
            effect_was_there: effect.seen(vehicle) == Some(true),
            is_accepted: request.answer == Answer::None,
            effect_has_shown: false,
            effect,
            request,
            texts: Vec::new(),
            order,
        };
        transaction.send(now, output);
        Some(transaction)
    }

    /// The verb it was given with.
    pub fn verb(&self) -> &'static str {
        self.order.verb
    }

    /// Whether it decides where the vehicle flies from now on.
    pub fn moves_the_vehicle(&self) -> bool {
        self.is_accepted && precedence::moves_the_vehicle(&self.order.command)
    }

    /// Whether a newer movement ends what is awaited of it.
    pub fn gives_way_to_movement(&self) -> bool {
        precedence::gives_way_to_movement(&self.order.command)
    }

    /// The command whose acknowledgements may still come although nobody waits for them, and how many.
    pub fn owed_acks(&self) -> Option<(u16, u8)> {
        match (&self.request.answer, self.phase) {
            (Answer::Ack(command), Phase::AwaitingAnswer { .. }) => Some((*command, self.tries)),
            _ => None,
        }
    }

    /// Gives way to another command.
    pub fn supersede(&self, reason: &Text, now: Duration, output: &mut Output) {
        self.report(RowState::Superseded, Some(reason.clone()), now, output);
    }

    /// Remembers what the vehicle says meanwhile; it may be the reason of a refusal.
    pub fn hear_text(&mut self, notice: &Notice) {
        if notice.severity <= Severity::Warning {
            self.texts.push(notice.text.clone());
        }
    }

    /// Looks for the answer in a frame of the vehicle's autopilot.
    pub fn receive(&mut self, frame: &Frame, now: Duration, output: &mut Output) {
        if !matches!(self.phase, Phase::AwaitingAnswer { .. }) {
            return;
        }
        match (&self.request.answer, &frame.content) {
            (Answer::Ack(command), _) => {
                if let Some(ack) = Acknowledgement::from_frame(frame)
                    && ack.command == *command
                {
                    self.acknowledged(ack, now, output);
                }
            }
            (Answer::Parameter(name), Content::Message(MavMessage::PARAM_VALUE(value))) => {
                let id = value.param_id.to_str();
                if id.is_ok_and(|id| id.eq_ignore_ascii_case(name)) {
                    match self.order.parameter_outcome(value.param_value) {
                        Ok(text) => self.accept(Some(text), now, output),
                        Err(text) => self.end(RowState::Refused, Some(text), now, output),
                    }
                }
            }
            _ => {}
        }
    }

    /// Lets time pass and reports what changed.
    pub fn poll(&mut self, vehicle: &Vehicle, now: Duration, output: &mut Output) -> Progress {
        match self.phase {
            Phase::AwaitingAnswer { .. } => self.await_answer(vehicle, now, output),
            Phase::AwaitingReason { result, until } if now >= until => {
                self.refuse(result, vehicle, now, output);
            }
            Phase::AwaitingReason { .. } | Phase::Over => {}
            Phase::AwaitingEffect { since, .. } => match self.order.command.repeat() {
                Some(repeat) => self.keep_up(repeat, vehicle, now, output),
                None => self.await_effect(since, vehicle, now, output),
            },
        }
        match self.phase {
            Phase::Over => Progress::Ended,
            Phase::AwaitingEffect { since, .. } if self.is_settled(since, now) => {
                Progress::Watching
            }
            _ => Progress::Waiting,
        }
    }

    fn is_settled(&self, since: Duration, now: Duration) -> bool {
        let is_awaited = precedence::later_ones_depend_on_it(&self.order.command);
        !is_awaited || now >= since + SETTLE_PATIENCE
    }

    fn send(&mut self, now: Duration, output: &mut Output) {
        output
            .messages
            .extend(self.request.messages.iter().cloned());
        self.request.again();
        self.tries = self.tries.saturating_add(1);
        self.last_sent = now;
        self.report(RowState::Sent, None, now, output);
    }

    fn await_answer(&mut self, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        let Phase::AwaitingAnswer {
            deadline,
            in_progress,
            rejected,
        } = self.phase
        else {
            return;
        };
        if self.effect_shows(vehicle) == Some(true) {
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
        let retry = self.order.retry;
        if !in_progress
            && self.tries < retry.tries
            && now >= self.last_sent + retry.every
            && now < self.given + retry.deadline
        {
            self.send(now, output);
        }
    }

    fn silence(&self, now: Duration) -> Text {
        let seconds = now.saturating_sub(self.first_sent).as_secs_f64();
        let seconds = format!("{seconds:.1}");
        let silence = text!("outcome-no-answer", tries = self.tries, seconds = seconds);
        match &self.request.answer {
            // Vehicles say nothing at all to the name of a parameter that they lack.
            Answer::Parameter(name) => {
                let guess = text!("outcome-no-parameter", name = name);
                Text::joined("; ", vec![silence, guess])
            }
            _ => silence,
        }
    }

    fn await_effect(
        &mut self,
        since: Duration,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        match self.effect_shows(vehicle) {
            None | Some(true) => self.end(RowState::Done, None, now, output),
            Some(false) if now >= since + self.effect.within() => {
                let within_s = self.effect.within().as_secs_f64();
                let text = text!(
                    "outcome-not-seen-within",
                    effect = self.effect.describe(),
                    seconds = format!("{within_s:.0}")
                );
                self.end(RowState::NoEffect, Some(text), now, output);
            }
            Some(false) => self.repeat_setpoint(now, output),
        }
    }

    /// Nothing acknowledges a setpoint, so it is said again in case it was lost. That is no new try: nobody
    /// knows that the first one failed.
    fn repeat_setpoint(&mut self, now: Duration, output: &mut Output) {
        let Phase::AwaitingEffect { repeated, .. } = &mut self.phase else {
            return;
        };
        let retry = self.order.retry;
        if self.request.answer == Answer::None
            && *repeated + 1 < retry.tries
            && now >= self.last_sent + retry.every
        {
            *repeated += 1;
            self.last_sent = now;
            output
                .messages
                .extend(self.request.messages.iter().cloned());
        }
    }

    /// A velocity is said again and again for its time, and then a stop.
    fn keep_up(&mut self, repeat: Repeat, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        self.effect_has_shown |= self.effect_shows(vehicle) == Some(true);
        let mode = vehicle.mode();
        if let Some(mode) = mode.filter(|mode| !mode.is("GUIDED")) {
            let text = text!("outcome-left-guided", mode = mode.to_string());
            return self.end(RowState::NoEffect, Some(text), now, output);
        }
        if now >= self.first_sent + repeat.lasting {
            output.messages.extend(self.request.closing.take());
            if self.effect_has_shown || repeat.lasting < GATHERING_SPEED {
                return self.end(RowState::Done, None, now, output);
            }
            let text = text!("outcome-not-seen", effect = self.effect.describe());
            return self.end(RowState::NoEffect, Some(text), now, output);
        }
        if now >= self.last_sent + repeat.every {
            self.last_sent = now;
            output
                .messages
                .extend(self.request.messages.iter().cloned());
        }
    }

    /// Whether telemetry shows the effect of this very command; `None` where there is nothing to see. What was
    /// there before has to be confirmed by a heartbeat that came after the command.
    fn effect_shows(&self, vehicle: &Vehicle) -> Option<bool> {
        let seen = self.effect.seen(vehicle)?;
        let is_news = !self.effect_was_there
            || vehicle
                .heartbeat
                .is_some_and(|heartbeat| heartbeat.at > self.first_sent);
        let is_proof = match self.phase {
            // Without an answer, only a change proves that the command arrived.
            Phase::AwaitingAnswer { .. } => !self.effect_was_there,
            _ => is_news,
        };
        Some(seen && is_proof)
    }

    fn acknowledged(&mut self, ack: Acknowledgement, now: Duration, output: &mut Output) {
        match (ack.result, &mut self.phase) {
            (AckResult::Accepted, _) => self.accept(None, now, output),
            (AckResult::InProgress, _) => {
                let percent = match ack.progress {
                    PROGRESS_UNKNOWN => 0,
                    percent => percent.min(100),
                };
                self.phase = Phase::AwaitingAnswer {
                    deadline: now + PROGRESS_PATIENCE,
                    in_progress: true,
                    rejected: false,
                };
                self.report(RowState::InProgress(percent), None, now, output);
            }
            (AckResult::TemporarilyRejected, Phase::AwaitingAnswer { rejected, .. }) => {
                *rejected = true;
            }
            (result, _) => {
                self.phase = Phase::AwaitingReason {
                    result,
                    until: now + REASON_PATIENCE,
                };
            }
        }
    }

    fn accept(&mut self, remark: Option<Text>, now: Duration, output: &mut Output) {
        self.is_accepted = true;
        self.phase = Phase::AwaitingEffect {
            since: now,
            repeated: 0,
        };
        self.report(RowState::Accepted, remark, now, output);
    }

    fn refuse(&mut self, result: AckResult, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        let order = &self.order;
        let text = explain(order.verb, result, &self.texts, vehicle, &order.command);
        self.end(RowState::Refused, Some(text), now, output);
    }

    fn end(
        &mut self,
        state: RowState,
        explanation: Option<Text>,
        now: Duration,
        output: &mut Output,
    ) {
        self.phase = Phase::Over;
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

/// The request of an order whose turn has come, or how it ends unsent.
fn prepare(
    order: &Order,
    deadline: Duration,
    vehicle: &Vehicle,
    now: Duration,
) -> Result<Request, (RowState, Text)> {
    if now >= deadline {
        let allowed_s = order.retry.deadline.as_secs_f64();
        let reason = text!("outcome-too-late", seconds = format!("{allowed_s:.1}"));
        return Err((RowState::TimedOut, reason));
    }
    order
        .command
        .request(vehicle, 0)
        .map_err(|reason| (RowState::Refused, reason))
}
