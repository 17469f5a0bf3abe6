//! The effect of a command, as telemetry shows it.

use std::time::Duration;

use super::{Transaction, TransactionPhase};
use crate::commands::{Answer, Repeat};
use crate::ledger::RowState;
use crate::session::Output;
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;

/// A velocity that lasts less than this may end before the vehicle has accelerated (an ArduCopter takes 2.4 s from 0 to
/// 5 m/s), so a missing effect proves nothing.
const GATHERING_SPEED: Duration = Duration::from_secs(4);
/// How long a vehicle may take to start an accepted command: the change shows with its next heartbeat.
const BEGINS_WITHIN: Duration = Duration::from_secs(3);
/// How old a command must be at a report of the vehicle's target: an earlier report may be about the previous target.
const TARGET_CHANGES_WITHIN: Duration = Duration::from_secs(3);
/// How old a command to fly somewhere must be when the vehicle, without a target, still stands.
const SETS_OUT_WITHIN: Duration = Duration::from_secs(5);

impl Transaction {
    /// Advances time while the effect is awaited.
    pub(super) fn await_effect(
        &mut self,
        since: Duration,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        match self.effect_shows(vehicle) {
            None | Some(true) => {
                let remark = self.effect.remark(vehicle);
                self.end(RowState::Done, remark, now, output);
            }
            Some(false) if !self.has_begun(vehicle) && now >= since + BEGINS_WITHIN => {
                let text = not_seen(&self.claim.describe(vehicle), BEGINS_WITHIN);
                self.end(RowState::NoEffect, Some(text), now, output);
            }
            Some(false) if self.keeps_another_target(vehicle) => {
                let text = text!("outcome-other-target");
                self.end(RowState::NoEffect, Some(text), now, output);
            }
            Some(false) if self.does_not_set_out(vehicle) => {
                let text = text!("outcome-no-target");
                self.end(RowState::NoEffect, Some(text), now, output);
            }
            Some(false) if now >= since + self.effect.within() => {
                let text = not_seen(&self.effect.describe(vehicle), self.effect.within());
                self.end(RowState::NoEffect, Some(text), now, output);
            }
            Some(false) => self.repeat_setpoint(now, output),
        }
    }

    /// Whether the vehicle flies to another place, long after the command: it has dropped the command without an answer.
    fn keeps_another_target(&self, vehicle: &Vehicle) -> bool {
        let target = vehicle.target;
        target.is_some_and(|target| {
            target.at >= self.first_sent + TARGET_CHANGES_WITHIN
                && self.effect.is_elsewhere(vehicle, &target)
        })
    }

    /// Whether the vehicle neither moves nor reports a target, long after the command: it has dropped the command
    /// without an answer. After a takeoff, ArduCopter has no earlier target that it could report.
    fn does_not_set_out(&self, vehicle: &Vehicle) -> bool {
        let latest = vehicle.global.map(|global| global.at);
        vehicle.target.is_none()
            && vehicle.heartbeat.is_some_and(|it| it.is_ardupilot())
            && latest.is_some_and(|at| at >= self.last_sent + SETS_OUT_WITHIN)
            && self.effect.stays_behind(vehicle)
    }

    fn has_begun(&self, vehicle: &Vehicle) -> bool {
        self.holds_since.is_some() || self.claim.contradicted(vehicle).is_none()
    }

    /// Repeats a setpoint, which has no acknowledgement, in case it was lost. That does not count as a new attempt.
    fn repeat_setpoint(&mut self, now: Duration, output: &mut Output) {
        let TransactionPhase::AwaitingEffect { repeated, .. } = &mut self.phase else {
            return;
        };
        let retry = self.order.verb.retry;
        if self.request.answer == Answer::None
            && *repeated + 1 < retry.tries
            && now >= self.last_sent + retry.every
        {
            *repeated += 1;
            self.last_sent = now;
            self.transmit(output);
        }
    }

    /// Repeats a velocity for its duration, and then stops the vehicle.
    pub(super) fn keep_up(
        &mut self,
        repeat: Repeat,
        since: Duration,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        self.effect_has_shown |= self.effect_shows(vehicle) == Some(true);
        if !self.has_begun(vehicle) && now >= since + BEGINS_WITHIN {
            let text = not_seen(&self.claim.describe(vehicle), BEGINS_WITHIN);
            return self.end(RowState::NoEffect, Some(text), now, output);
        }
        if now >= since + repeat.lasting {
            if self.request.offboard.is_some() {
                return self.begin_to_leave(vehicle, now);
            }
            output.messages.extend(self.request.closing.take());
            return self.end_velocity(repeat, vehicle, now, output);
        }
        self.stream(now, output);
        if self.request.offboard.is_none() && now >= self.last_sent + repeat.every {
            self.last_sent = now;
            output
                .messages
                .extend(self.request.messages.iter().cloned());
        }
    }

    /// Ends a velocity, as done if the vehicle has had it.
    pub(super) fn end_velocity(
        &mut self,
        repeat: Repeat,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        if self.effect_has_shown || repeat.lasting < GATHERING_SPEED {
            return self.end(RowState::Done, None, now, output);
        }
        let text = text!("outcome-not-seen", effect = self.effect.describe(vehicle));
        self.end(RowState::NoEffect, Some(text), now, output);
    }

    /// Whether telemetry shows the effect of this particular command; `None` if the effect is not observable. An effect
    /// that was present before must be confirmed by a later heartbeat.
    pub(super) fn effect_shows(&self, vehicle: &Vehicle) -> Option<bool> {
        let seen = self.effect.seen(vehicle)?;
        let is_news = !self.effect_was_there
            || vehicle
                .heartbeat
                .is_some_and(|heartbeat| heartbeat.at > self.first_sent);
        let is_proof = match self.phase {
            // Without an answer, only a change proves that the command arrived.
            TransactionPhase::AwaitingAnswer { .. } => !self.effect_was_there,
            TransactionPhase::Leading { .. }
            | TransactionPhase::AwaitingReason { .. }
            | TransactionPhase::AwaitingEffect { .. }
            | TransactionPhase::Leaving { .. }
            | TransactionPhase::Done
            | TransactionPhase::Over => is_news,
        };
        Some(seen && is_proof)
    }
}

fn not_seen(effect: &Text, within: Duration) -> Text {
    let seconds = format!("{:.0}", within.as_secs_f64());
    text!(
        "outcome-not-seen-within",
        effect = effect,
        seconds = seconds
    )
}
