//! The orders to one vehicle, while they are carried out: to which part each goes, and the sequence in which the parts
//! act.
//!
//! Commands wait in the line, because an acknowledgement names only the command. Transfers, the signing key and held
//! channels are carried out beside it. Together they are apart from the session, which hears the vehicle and keeps its
//! model, orders or not.

use std::sync::Arc;
use std::time::Duration;

use super::control::ControlDesk;
use super::line::{Line, Moment};
use super::signing::{KeyDesk, VehicleSigning};
use super::sticks::Sticks;
use super::transfers::{ReadDefaults, SessionTransfers};
use super::{Steering, VehicleCommand};
use crate::commands::{Command, DeviceCommand, REQUEST_CONTROL};
use crate::notice::Notice;
use crate::parameters::{Fetching, ParameterDocuments};
use crate::text;
use crate::text::Text;
use crate::vehicle::{AskedSpeeds, HeldChannels, Vehicle};
use crate::wire::Frame;

/// The parts of a session that carry out orders.
#[derive(Debug, Clone, Default)]
pub(super) struct Orders {
    line: Line,
    transfers: SessionTransfers,
    signing: VehicleSigning,
    control: ControlDesk,
    sticks: Sticks,
}

impl Orders {
    /// The part for lists, logs and files.
    pub fn transfers(&mut self) -> &mut SessionTransfers {
        &mut self.transfers
    }

    /// What the vehicle documents about its parameters, as far as it has been read.
    pub fn documents(&self) -> &Arc<ParameterDocuments> {
        self.transfers.documents()
    }

    /// Takes the keys for signing from this desk; without one, keys cannot be changed.
    pub fn sign_with(&mut self, desk: Option<Arc<dyn KeyDesk>>) {
        self.signing.use_desk(desk);
    }

    /// Queues an order. Returns whether it is carried out beside the line: its first step is then due at the next poll.
    pub fn order(&mut self, order: VehicleCommand, mut moment: Moment<'_>) -> bool {
        let Some(order) = self.transfers.order(order, &mut moment) else {
            return true;
        };
        let now = moment.now;
        if matches!(order.command, Command::Signing(_)) {
            self.signing
                .order(order, moment.vehicle, now, moment.output);
            return true;
        }
        if let Command::Device(DeviceCommand::Sticks(change)) = order.command {
            self.sticks.order(&order, change, moment);
            return true;
        }
        self.control.note(&order.command, now);
        self.line.order(order, moment);
        false
    }

    /// Sends a vehicle's setpoint in a joint manoeuvre.
    ///
    /// # Errors
    /// The setpoint is in the ground or not a valid position; nothing is sent.
    pub fn steer(&mut self, steering: &Steering, moment: Moment<'_>) -> Result<(), Text> {
        self.line.steer(steering, moment)
    }

    /// Holds channels that are steered by keys; `None` releases all channels.
    pub fn steer_by_hand(
        &mut self,
        held: Option<HeldChannels>,
        vehicle: &mut Vehicle,
        now: Duration,
    ) {
        match held {
            Some(held) => self.sticks.steer(held, vehicle, now),
            None => self.sticks.release(vehicle, now),
        }
    }

    /// Ends all orders after a reboot of the vehicle: messages from before must not reach it afterwards.
    pub fn begin_anew(&mut self, moment: &mut Moment<'_>) {
        let newer = text!("outcome-the-reboot");
        self.line.clear(&newer, moment);
        self.line
            .supersede_movements(&newer, moment.now, moment.output);
        moment.vehicle.asked_speeds = AskedSpeeds::default();
        self.transfers.begin_anew(&newer, moment);
    }

    /// Stores status texts, which may explain a refusal.
    pub fn hear_texts(&mut self, notices: &[Notice]) {
        self.line.hear_texts(notices);
        self.signing.hear_texts(notices);
    }

    /// Stores the reports of events, which may explain the refusal of a command.
    pub fn hear_events(&mut self, notices: &[Notice]) {
        self.line.hear_texts(notices);
    }

    /// Notes that an acknowledgement may arrive for which no order waits.
    pub fn expect_ack(&mut self, command: u16, now: Duration) {
        self.line.expect_ack(command, now);
    }

    /// Looks for awaited answers in a frame of the autopilot; returns the defaults of parameters that it completes.
    pub fn receive(&mut self, frame: &Frame, moment: &mut Moment<'_>) -> ReadDefaults {
        let now = moment.now;
        self.signing
            .receive(frame, moment.vehicle, now, moment.output);
        let defaults = self.transfers.receive(frame, moment);
        ControlDesk::receive(frame, moment.vehicle, now, moment.output);
        self.line.receive(frame, moment.vehicle, now, moment.output);
        defaults
    }

    /// Begins to read the defaults that are missing, and the lists unless a command waits for its answer.
    pub fn read(&mut self, fetching: Fetching, moment: &mut Moment<'_>) {
        self.transfers.read(self.line.is_free(), fetching, moment);
    }

    /// Takes the steps that are due; returns the defaults of parameters that they complete.
    pub fn poll(&mut self, mut moment: Moment<'_>) -> ReadDefaults {
        let now = moment.now;
        let defaults = self.transfers.poll(&mut moment);
        self.signing.poll(moment.vehicle, now, moment.output);
        if self.control.poll(moment.vehicle, now, moment.output) {
            self.line.expect_ack(REQUEST_CONTROL, now);
        }
        self.sticks.poll(moment.vehicle, now, moment.output);
        self.line.advance(moment);
        defaults
    }

    /// Advances the line of commands as far as possible.
    pub fn advance(&mut self, moment: Moment<'_>) {
        self.line.advance(moment);
    }

    /// Whether an answer is awaited, or something must be repeated.
    pub fn is_busy(&self, vehicle: &Vehicle) -> bool {
        self.line.is_busy()
            || self.transfers.is_busy()
            || self.signing.is_busy()
            || self.control.is_busy()
            || self.sticks.is_busy(vehicle)
    }
}
