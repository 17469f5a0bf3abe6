//! Channels of the transmitter that this program holds, for tests. A vehicle drops an override that is not repeated
//! (ArduPilot after `RC_OVERRIDE_TIME`, usually 3 s), so nothing that stops this program can leave it on.

use std::time::Duration;

use super::line::Moment;
use super::{Output, VehicleCommand};
use crate::commands::{
    StickChange, hold_message, may_ignore_sticks, release_message, stick_obstacle,
};
use crate::ledger::RowState;
use crate::parameters::ParameterList;
use crate::text;
use crate::text::Text;
use crate::vehicle::{HeldChannels, Vehicle};

/// The interval of the messages. One that is lost does no harm.
const EVERY: Duration = Duration::from_millis(100);
/// The number of messages that release the channels, since some may be lost.
const RELEASES: u8 = 3;
/// Channels that are steered by keys are released this long after the last input, whatever keeps it away.
const STEERED_FOR: Duration = Duration::from_secs(1);

/// The channels that are held, and the messages that are still to be sent.
#[derive(Debug, Clone, Default)]
pub(super) struct Sticks {
    /// The channels that are being released.
    leaving: HeldChannels,
    releases: u8,
    due: Duration,
    /// When steering by keys ends without a further input; `None` for channels that lines hold.
    steered_until: Option<Duration>,
}

impl Sticks {
    /// Carries out an order, and ends its row.
    pub fn order(&mut self, order: &VehicleCommand, change: StickChange, moment: Moment<'_>) {
        let Moment {
            vehicle,
            parameters,
            now,
            output,
        } = moment;
        if matches!(change, StickChange::Hold { .. })
            && let Some(reason) = obstacle(vehicle, parameters)
        {
            return output.row(order.unsent(vehicle.id, RowState::Refused, reason, now));
        }
        let text = match change {
            StickChange::Hold { channel, pulse_us } => {
                let mut held = vehicle.held.unwrap_or_default();
                held.hold(usize::from(channel).saturating_sub(1), pulse_us);
                vehicle.held = Some(held);
                self.steered_until = None;
                self.due = now;
                let outcome = text!("outcome-sticks-held", channels = held.text());
                if may_ignore_sticks(vehicle, parameters) {
                    let remark = text!("outcome-sticks-unsure", own = vehicle.station);
                    Text::joined("; ", vec![outcome, remark])
                } else {
                    outcome
                }
            }
            StickChange::Release => {
                self.release(vehicle, now);
                text!("outcome-sticks-released")
            }
        };
        output.row(order.unsent(vehicle.id, RowState::Done, text, now));
    }

    /// Holds channels that are steered by keys; they are released unless this is repeated within a second.
    pub fn steer(&mut self, held: HeldChannels, vehicle: &mut Vehicle, now: Duration) {
        if vehicle.barred_by().is_some() {
            return self.release(vehicle, now);
        }
        vehicle.held = Some(held);
        self.steered_until = Some(now + STEERED_FOR);
        self.due = now;
    }

    /// Gives the channels back to the transmitter.
    pub fn release(&mut self, vehicle: &mut Vehicle, now: Duration) {
        if let Some(held) = vehicle.held.take() {
            self.leaving = held;
            self.releases = RELEASES;
            self.due = now;
        }
        self.steered_until = None;
    }

    /// Sends the messages that are due.
    pub fn poll(&mut self, vehicle: &mut Vehicle, now: Duration, output: &mut Output) {
        if self.steered_until.is_some_and(|until| now >= until) {
            self.release(vehicle, now);
        }
        if !self.is_busy(vehicle) || now < self.due {
            return;
        }
        self.due = now + EVERY;
        let message = if let Some(held) = &vehicle.held {
            hold_message(vehicle, held)
        } else {
            self.releases -= 1;
            release_message(vehicle, &self.leaving)
        };
        output.messages.push(message.into());
    }

    /// Whether messages must be repeated.
    pub fn is_busy(&self, vehicle: &Vehicle) -> bool {
        vehicle.held.is_some() || self.releases > 0
    }
}

/// Why the vehicle would ignore held channels.
fn obstacle(vehicle: &Vehicle, list: &ParameterList) -> Option<Text> {
    let is_barred = vehicle.barred_by().is_some();
    let by_control = is_barred.then(|| vehicle.not_in_control().unwrap_or_default());
    by_control.or_else(|| stick_obstacle(vehicle, list))
}
