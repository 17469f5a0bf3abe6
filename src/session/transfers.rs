//! The file client of a session, and those that it works for: plans, logs, defaults of parameters, orders about files.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{FILE_TRANSFER_PROTOCOL_DATA, MavAutopilot, MavMessage};

use super::Session;
use super::files::{FileOrders, FilesScene};
use super::ftp::FtpPayload;
use super::logs::hands_out_files;
use crate::wire::Outgoing;

impl Session {
    /// Advances the file client, and passes on the events of its tasks.
    pub(super) fn handle_files(&mut self, incoming: Option<&FtpPayload>, now: Duration) {
        if incoming.is_none() && !self.ftp.is_busy() {
            return;
        }
        let round_trip = self.vehicle.link.round_trip.unwrap_or_default();
        let step = self.ftp.step(incoming, round_trip, now);
        let requests = step.requests.into_iter().map(|payload| {
            MavMessage::FILE_TRANSFER_PROTOCOL(FILE_TRANSFER_PROTOCOL_DATA {
                target_network: 0,
                target_system: self.vehicle.system,
                target_component: self.vehicle.component,
                payload,
            })
        });
        self.output.messages.extend(requests.map(Outgoing::from));
        for (ticket, event) in step.events {
            self.lists.hear_file(ticket, &event, now);
            let defaults = self.defaults.hear_file(ticket, &event, &mut self.ftp);
            if let Some(defaults) = defaults {
                self.inbox.note_defaults(defaults);
            }
            let (files, mut scene) = self.files(now);
            files.hear_file(ticket, &event, &mut scene);
            self.logs.hear_file(ticket, event, &mut self.ftp, now);
        }
    }

    /// Whether the vehicle is an ArduPilot that offers files: the defaults of its parameters are one.
    pub(super) fn offers_defaults(&self) -> bool {
        let ardupilot = MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA as u8;
        let heartbeat = self.vehicle.heartbeat;
        let is_ardupilot = heartbeat.is_some_and(|heartbeat| heartbeat.autopilot == ardupilot);
        is_ardupilot && hands_out_files(&self.vehicle)
    }

    pub(super) fn files(&mut self, now: Duration) -> (&mut FileOrders, FilesScene<'_>) {
        let scene = FilesScene {
            vehicle: &self.vehicle,
            ftp: &mut self.ftp,
            now,
            output: &mut self.output,
        };
        (&mut self.files, scene)
    }
}
