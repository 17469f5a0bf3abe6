//! A velocity of PX4, which accepts setpoints only in OFFBOARD: setpoints before the mode changes, while it lasts, and
//! until the vehicle has left it. Without them, PX4 leaves the mode by itself, and its failsafe decides (`COM_OF_LOSS_T`,
//! `COM_OBL_RC_ACT`).

use std::time::Duration;

use super::{Transaction, TransactionPhase};
use crate::commands::{Claim, Request};
use crate::ledger::RowState;
use crate::session::Output;
use crate::text;
use crate::vehicle::Vehicle;

/// The time between setpoints. PX4 wants at least two a second.
const SETPOINT_EVERY: Duration = Duration::from_millis(200);
/// The time between the commands that leave OFFBOARD.
const LEAVE_EVERY: Duration = Duration::from_secs(1);
/// How long the vehicle may take to leave OFFBOARD.
const LEAVES_WITHIN: Duration = Duration::from_secs(5);

/// When the mode of a request can change; `None` if no setpoints must come first.
pub(super) fn lead(request: &Request, now: Duration) -> Option<Duration> {
    let offboard = request.offboard.as_ref()?;
    (!offboard.lead.is_zero()).then(|| now + offboard.lead)
}

impl Transaction {
    /// Sends the setpoint of OFFBOARD that is due, if the request has one.
    pub(super) fn stream(&mut self, now: Duration, output: &mut Output) {
        if let Some(offboard) = &self.request.offboard
            && now >= self.setpoint_due
        {
            self.setpoint_due = now + SETPOINT_EVERY;
            let is_over = matches!(self.phase, TransactionPhase::Leaving { .. });
            let setpoint = if is_over {
                &offboard.standstill
            } else {
                &offboard.setpoint
            };
            output.messages.push(setpoint.clone());
        }
    }

    /// Sends setpoints until the mode can change, and then the command that changes it.
    pub(super) fn lead_in(&mut self, until: Duration, now: Duration, output: &mut Output) {
        self.stream(now, output);
        if now < until {
            return;
        }
        self.given = now;
        self.first_sent = now;
        self.phase = TransactionPhase::AwaitingAnswer {
            deadline: now + self.order.verb.retry.deadline,
            in_progress: false,
            rejected: false,
        };
        self.send(now, output);
    }

    /// Whether the vehicle has changed to OFFBOARD since the command, so that its answer is lost or still on its way.
    pub(super) fn has_entered_offboard(&self, vehicle: &Vehicle) -> bool {
        let is_change = self.request.offboard.as_ref();
        let is_change = is_change.is_some_and(|offboard| !offboard.lead.is_zero());
        is_change && self.claim.contradicted(vehicle).is_none()
    }

    /// Ends the time of the velocity: the vehicle is to stop and to hold.
    pub(super) fn begin_to_leave(&mut self, vehicle: &Vehicle, now: Duration) {
        self.claim = Claim::after_offboard(vehicle);
        self.setpoint_due = now;
        self.phase = TransactionPhase::Leaving {
            until: now + LEAVES_WITHIN,
            due: now,
        };
    }

    /// Stops the vehicle, until telemetry shows that it holds, or that something else has taken over.
    pub(super) fn leave_offboard(
        &mut self,
        until: Duration,
        due: Duration,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        let Some(by) = self.claim.contradicted(vehicle) else {
            if let Some(repeat) = self.order.command.repeat() {
                self.end_velocity(repeat, vehicle, now, output);
            }
            return;
        };
        let remains = Claim::in_offboard(vehicle).contradicted(vehicle).is_none();
        if !remains {
            return self.end(RowState::Overtaken, Some(by), now, output);
        }
        if now >= until {
            let text = text!("outcome-offboard-kept");
            return self.end(RowState::NoEffect, Some(text), now, output);
        }
        self.stream(now, output);
        if now >= due
            && let Some(offboard) = &self.request.offboard
        {
            output.messages.push(offboard.leave.clone());
            output.unawaited.push(offboard.leave_command);
            self.phase = TransactionPhase::Leaving {
                until,
                due: now + LEAVE_EVERY,
            };
        }
    }
}
