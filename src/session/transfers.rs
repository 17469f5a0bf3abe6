//! What a vehicle keeps on board: its lists (plan, fence, rally points), logs, files, and the defaults and the
//! documentation of its parameters.
//!
//! They are together because they share one file client: its events reach the part whose task they are about, and a
//! reboot ends all tasks at once. They are apart from the line of commands, which a transfer of minutes must not hold
//! up.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{FILE_TRANSFER_PROTOCOL_DATA, MavAutopilot, MavMessage};

use super::VehicleCommand;
use super::defaults::DefaultsReader;
use super::files::{FileDesk, FileOrders, FilesScene};
use super::ftp::{FtpClient, FtpPayload};
use super::line::Moment;
use super::lists::{Lists, ListsDesk};
use super::logs::{LogKeeper, LogReader, hands_out_files};
use super::metadata::MetadataReader;
use super::plan_orders::PlanShelf;
use crate::commands::{Command, FileCommand};
use crate::metadata::EventDocuments;
use crate::parameters::{Fetching, ParameterDocuments};
use crate::plan::Document;
use crate::text::Text;
use crate::vehicle::Vehicle;
use crate::wire::{Content, Frame, Outgoing};

/// The defaults of a vehicle's parameters, by name; `None` until their file is whole.
pub(super) type ReadDefaults = Option<BTreeMap<String, f64>>;

/// The file client of one vehicle, and the parts that it works for.
#[derive(Debug, Clone, Default)]
pub(super) struct SessionTransfers {
    ftp: FtpClient,
    lists: Lists,
    logs: LogReader,
    files: FileOrders,
    defaults: DefaultsReader,
    metadata: MetadataReader,
}

impl SessionTransfers {
    /// Stores downloaded logs with `keeper`.
    pub fn keep_logs_in(&mut self, keeper: Arc<dyn LogKeeper>) {
        self.logs.keep_in(keeper);
    }

    /// Reads and writes the files that are copied to and from the vehicle through `desk`.
    pub fn use_desk(&mut self, desk: Arc<dyn FileDesk>) {
        self.files.use_desk(Arc::clone(&desk));
        self.metadata.use_desk(desk);
    }

    /// Reads and writes plan files through `shelf`.
    pub fn take_plans_from(&mut self, shelf: Arc<dyn PlanShelf>) {
        self.lists.take_from(shelf);
    }

    /// Reads lists from the answers to other stations' requests, without requesting them.
    pub fn only_follow(&mut self) {
        self.lists.only_follow();
    }

    /// Puts the lists of a document on board before any order.
    pub fn stock(&mut self, document: &Arc<Document>) {
        self.lists.stock(document);
    }

    /// What the vehicle documents about its parameters, as far as it has been read.
    pub fn documents(&self) -> &Arc<ParameterDocuments> {
        self.metadata.parameters()
    }

    /// The texts of events that were read since the last call.
    pub fn take_events(&mut self) -> Option<Arc<EventDocuments>> {
        self.metadata.take_events()
    }

    /// Notes that another ground station is heard, which may change the lists.
    pub fn station_heard(&mut self, now: Duration) {
        self.lists.station_heard(now);
    }

    /// Reads all lists again, because the link has come up again.
    pub fn link_up(&mut self, now: Duration) {
        self.lists.begin_anew(&mut self.ftp, now);
    }

    /// Ends all orders and reads everything again, because the vehicle has rebooted.
    pub fn begin_anew(&mut self, newer: &Text, moment: &mut Moment<'_>) {
        self.defaults.begin_anew();
        let (files, mut scene) = self.files(moment);
        files.clear(newer, &mut scene);
        let (metadata, mut scene) = self.metadata(moment);
        metadata.clear(newer, &mut scene);
        self.ftp.forget();
        self.lists.begin_anew(&mut self.ftp, moment.now);
        self.logs
            .clear(newer, moment.vehicle, moment.now, moment.output);
    }

    /// Queues an order about lists, logs or files; returns any other order.
    pub fn order(
        &mut self,
        order: VehicleCommand,
        moment: &mut Moment<'_>,
    ) -> Option<VehicleCommand> {
        match order.command {
            Command::Plan(_) => {
                let (lists, desk) = self.lists(moment);
                lists.order(order, desk);
            }
            Command::Log(_) => {
                self.logs
                    .order(order, moment.vehicle, moment.now, moment.output);
            }
            Command::File(FileCommand::Documentation) => {
                let (metadata, mut scene) = self.metadata(moment);
                metadata.order(order, &mut scene);
            }
            Command::File(_) => {
                let (files, mut scene) = self.files(moment);
                files.order(order, &mut scene);
            }
            Command::Arming(_)
            | Command::Flight(_)
            | Command::PlanFlight(_)
            | Command::Motion(_)
            | Command::Device(_)
            | Command::Query(_)
            | Command::Parameter(_)
            | Command::Signing(_)
            | Command::Raw(_) => return Some(order),
        }
        None
    }

    /// Handles a frame of the autopilot; returns the defaults that it completes.
    pub fn receive(&mut self, frame: &Frame, moment: &mut Moment<'_>) -> ReadDefaults {
        let (lists, desk) = self.lists(moment);
        lists.receive(frame, desk);
        self.logs.receive(frame, moment.now);
        if let Content::Message(message) = &frame.content {
            let (metadata, mut scene) = self.metadata(moment);
            metadata.receive(message, &mut scene);
        }
        if let Content::Message(MavMessage::FILE_TRANSFER_PROTOCOL(data)) = &frame.content
            && [0, moment.vehicle.station].contains(&data.target_system)
        {
            return self.step(Some(&data.payload), moment);
        }
        None
    }

    /// Begins to read what is missing: lists only if `is_free`, so that no command waits for its answer; defaults once
    /// the list of parameters is complete.
    pub fn read(&mut self, is_free: bool, fetching: Fetching, moment: &mut Moment<'_>) {
        let (lists, desk) = self.lists(moment);
        lists.read(is_free, desk);
        let offers_file = offers_defaults(moment.vehicle);
        self.defaults.poll(fetching, offers_file, &mut self.ftp);
    }

    /// Takes the steps that are due; returns the defaults that they complete.
    pub fn poll(&mut self, moment: &mut Moment<'_>) -> ReadDefaults {
        let (lists, desk) = self.lists(moment);
        lists.poll(desk);
        self.logs
            .poll(moment.vehicle, &mut self.ftp, moment.now, moment.output);
        let (files, mut scene) = self.files(moment);
        files.poll(&mut scene);
        let (metadata, mut scene) = self.metadata(moment);
        metadata.poll(&mut scene);
        self.step(None, moment)
    }

    /// Whether an order is carried out, or an answer is awaited.
    pub fn is_busy(&self) -> bool {
        self.logs.is_busy()
            || self.lists.is_busy()
            || self.files.is_busy()
            || self.metadata.is_busy()
            || self.ftp.is_busy()
    }

    /// Advances the file client, and passes on the events of its tasks.
    fn step(&mut self, incoming: Option<&FtpPayload>, moment: &mut Moment<'_>) -> ReadDefaults {
        if incoming.is_none() && !self.ftp.is_busy() {
            return None;
        }
        let (system, component) = (moment.vehicle.system, moment.vehicle.component);
        let round_trip = moment.vehicle.link.round_trip.unwrap_or_default();
        let step = self.ftp.step(incoming, round_trip, moment.now);
        let requests = step.requests.into_iter().map(|payload| {
            MavMessage::FILE_TRANSFER_PROTOCOL(FILE_TRANSFER_PROTOCOL_DATA {
                target_network: 0,
                target_system: system,
                target_component: component,
                payload,
            })
        });
        moment.output.messages.extend(requests.map(Outgoing::from));
        let mut read = None;
        for (ticket, event) in step.events {
            self.lists.hear_file(ticket, &event, moment.now);
            let defaults = self.defaults.hear_file(ticket, &event, &mut self.ftp);
            read = defaults.or(read);
            let (files, mut scene) = self.files(moment);
            files.hear_file(ticket, &event, &mut scene);
            let (metadata, mut scene) = self.metadata(moment);
            metadata.hear_file(ticket, &event, &mut scene);
            self.logs
                .hear_file(ticket, event, &mut self.ftp, moment.now);
        }
        read
    }

    fn lists<'a>(&'a mut self, moment: &'a mut Moment<'_>) -> (&'a mut Lists, ListsDesk<'a>) {
        let desk = ListsDesk {
            vehicle: moment.vehicle,
            parameters: moment.parameters,
            ftp: &mut self.ftp,
            now: moment.now,
            output: moment.output,
        };
        (&mut self.lists, desk)
    }

    fn files<'a>(&'a mut self, moment: &'a mut Moment<'_>) -> (&'a mut FileOrders, FilesScene<'a>) {
        let scene = FilesScene {
            vehicle: moment.vehicle,
            ftp: &mut self.ftp,
            now: moment.now,
            output: moment.output,
        };
        (&mut self.files, scene)
    }

    fn metadata<'a>(
        &'a mut self,
        moment: &'a mut Moment<'_>,
    ) -> (&'a mut MetadataReader, FilesScene<'a>) {
        let scene = FilesScene {
            vehicle: moment.vehicle,
            ftp: &mut self.ftp,
            now: moment.now,
            output: moment.output,
        };
        (&mut self.metadata, scene)
    }
}

/// Whether the vehicle is an ArduPilot that offers files: the defaults of its parameters are one.
fn offers_defaults(vehicle: &Vehicle) -> bool {
    let ardupilot = MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA as u8;
    let heartbeat = vehicle.heartbeat;
    let is_ardupilot = heartbeat.is_some_and(|heartbeat| heartbeat.autopilot == ardupilot);
    is_ardupilot && hands_out_files(vehicle)
}
