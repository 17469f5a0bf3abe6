//! The conversation with one vehicle, without any input or output of its own.
//!
//! A [`Session`] takes frames, orders and the current time, updates the [`Vehicle`] model, and
//! returns reports and the messages to send. The fleet drives one session per vehicle from a task;
//! an exercise drives them in lock step with the simulator. Both therefore behave the same, and
//! every time-out and retry can be tested without waiting.

use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;

use crate::commands::{Command, DeviceCommand, REQUEST_CONTROL};
use crate::messages::Inbox;
use crate::parameters::ParameterSnapshot;
use crate::text;
use crate::text::Text;
use crate::vehicle::{AskedSpeeds, HeldChannels, Vehicle};
use crate::wire::{ComponentId, Content, Frame, Outgoing, SystemId};

mod acknowledgement;
mod bench;
mod control;
mod defaults;
mod download;
mod events;
mod files;
mod fit;
mod ftp;
mod gaps;
mod hearing;
mod line;
mod lists;
mod logs;
mod naming;
mod order;
mod output;
mod parameter_code;
mod plan_orders;
mod plans;
mod precedence;
mod radio;
mod set_up;
mod settings;
mod signing;
mod sticks;
mod streams;
mod surroundings;
#[cfg(test)]
mod tests;
mod timesync;
mod transaction;
mod transfers;

use control::ControlDesk;
use defaults::DefaultsReader;
use download::Download;
use events::Events;
use files::FileOrders;
use hearing::{Hearing, watch_silence};
use line::{Line, Moment};
use lists::{Lists, ListsDesk};
use logs::LogReader;
use output::Output;
use signing::VehicleSigning;
use sticks::Sticks;
use streams::Streams;
use surroundings::Surroundings;
use timesync::Timesync;

pub use files::FileDesk;
pub use ftp::{
    FtpClient, FtpEntry, FtpEvent, FtpFault, FtpNak, FtpPayload, FtpStep, FtpTask, FtpTicket,
};
pub use gaps::{FileBytes, GapMap};
pub use hearing::{LOST_AFTER, autopilot_of};
pub use logs::{KeptLog, ListedLog, LogKeeper, VehicleLog};
pub use naming::Renamed;

pub use order::{ListedFolder, Report, Steering, VehicleCommand};
pub(crate) use plan_orders::format_of;
pub use plan_orders::{GuardedShelf, PlanOnFile, PlanShelf};
pub use radio::RadioFault;
pub use settings::Want;
pub use signing::KeyDesk;
pub use streams::{Stream, WANTED_STREAMS};

/// The maximum time between polls while an answer is awaited or something is repeated.
const BUSY_POLL: Duration = Duration::from_millis(50);
/// The maximum time between polls while no answer is awaited and nothing is repeated.
const IDLE_POLL: Duration = Duration::from_millis(500);
/// The time between polls while a radio is tested: the precision of its delays.
const TEST_POLL: Duration = Duration::from_millis(10);

/// Another vehicle with the same system id is gone after this much silence.
const TWIN_GONE_AFTER: Duration = Duration::from_secs(5);

/// The state of a conversation with one vehicle.
#[derive(Debug, Clone)]
pub struct Session {
    vehicle: Vehicle,
    inbox: Inbox,
    hearing: Hearing,
    streams: Streams,
    timesync: Timesync,
    lists: Lists,
    line: Line,
    download: Download,
    defaults: DefaultsReader,
    events: Events,
    logs: LogReader,
    files: FileOrders,
    ftp: FtpClient,
    signing: VehicleSigning,
    control: ControlDesk,
    sticks: Sticks,
    output: Output,
    surroundings: Surroundings,
    /// The time of the last poll.
    now: Duration,
}

impl Session {
    /// A conversation that begins now. Nothing is requested before the vehicle's first heartbeat: requests in the
    /// first 40 ms of an ArduPilot's link are acknowledged and then lost.
    pub fn new(system: SystemId, component: ComponentId, now: Duration) -> Self {
        Self {
            vehicle: Vehicle::new(system, component),
            inbox: Inbox::new(),
            hearing: Hearing::default(),
            streams: Streams::new(WANTED_STREAMS, now),
            timesync: Timesync::default(),
            lists: Lists::default(),
            line: Line::default(),
            download: Download::new(),
            defaults: DefaultsReader::default(),
            events: Events::default(),
            logs: LogReader::default(),
            files: FileOrders::default(),
            ftp: FtpClient::default(),
            signing: VehicleSigning::default(),
            control: ControlDesk::default(),
            sticks: Sticks::default(),
            output: Output::default(),
            surroundings: Surroundings::new(),
            now,
        }
    }

    /// The session, as the ground station with another system id than the usual one.
    #[must_use]
    pub fn as_station(mut self, station: SystemId) -> Self {
        self.vehicle.station = station;
        self
    }

    /// The model of the vehicle, as far as it has been heard.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// The parameters received so far, and the state of their download. Cheap: no value is copied.
    pub fn parameters(&self) -> ParameterSnapshot {
        ParameterSnapshot {
            list: Arc::clone(self.inbox.parameters()),
            fetching: self.download.fetching(),
            reboots: self.vehicle.link.reboots,
        }
    }

    /// Downloads all parameters of the vehicle, even known ones; a download under way continues.
    pub fn fetch_parameters(&mut self, now: Duration) {
        self.download.begin(&mut self.inbox);
        self.poll(now);
    }

    /// Sets the number of the link on which the vehicle is heard. Must also be called when that link comes up again:
    /// the vehicle may have rebooted, and requests are repeated.
    pub fn heard_via(&mut self, link: u16, now: Duration) {
        self.vehicle.link.via = Some(link);
        self.streams.forget(now);
        self.lists.begin_anew(&mut self.ftp, now);
        self.download.resume(now);
    }

    /// Notes that another ground station is heard on the vehicle's link, which may change what is on board.
    pub fn station_heard(&mut self, now: Duration) {
        self.lists.station_heard(now);
    }

    /// Notes that the vehicle is heard from another sender than before.
    pub fn moved(&mut self, now: Duration) {
        self.vehicle.link.moved_at = Some(now);
    }

    /// Handles one frame from this vehicle's system. Only its autopilot counts as heard: a companion computer with the
    /// same system id may keep sending when the autopilot has stopped.
    pub fn receive(&mut self, frame: &Frame, now: Duration) {
        self.now = now;
        if self.surroundings.hear(frame, &mut self.vehicle, now) {
            self.take_in(frame, now);
        } else {
            self.take_in_arrived(now);
        }
    }

    /// Notes a pause in which nothing could be heard: it does not count as silence.
    pub fn rest(&mut self, lasted: Duration) {
        let link = &mut self.vehicle.link;
        link.last_heard = link.last_heard.map(|heard| heard + lasted);
    }

    /// Applies a change to the vehicle, its simulator or the radio link.
    pub fn carry_out(&mut self, want: Want) {
        match want {
            Want::Parameter { name, value } => self.surroundings.set_parameter(name, value),
            Want::Radio(fault) => self.surroundings.set_radio(fault, self.vehicle.id),
            Want::RadioTest(test) => {
                let surroundings = &mut self.surroundings;
                surroundings.test_radio(test, self.vehicle.id, self.now);
            }
            Want::Lists(document) => self.lists.stock(&document),
        }
    }

    /// Whether the radio link is cut, even for the console's heartbeats.
    pub fn is_cut(&self) -> bool {
        self.surroundings.is_cut()
    }

    fn take_in_arrived(&mut self, now: Duration) {
        while let Some(frame) = self.surroundings.arrived(now) {
            self.take_in(&frame, now);
        }
    }

    fn take_in(&mut self, frame: &Frame, now: Duration) {
        let frame = &*parameter_code::received(frame, &self.vehicle);
        if radio::position(frame).is_some() {
            self.vehicle.unheard = None;
        }
        let is_autopilot = frame.component == self.vehicle.component;
        if is_autopilot {
            self.hear(frame, now);
        }
        let reboots = self.vehicle.link.reboots;
        let mut notices = Vec::new();
        self.inbox
            .apply(&mut self.vehicle, frame, now, &mut notices);
        self.line.hear_texts(&notices);
        self.signing.hear_texts(&notices);
        self.output.say(notices);
        if is_autopilot {
            self.answer(frame, now);
        }
        self.advance(now);
        if self.vehicle.link.reboots > reboots {
            self.begin_anew(now);
        }
    }

    /// Notes a restart of the autopilot before its clock shows it; its earlier state is forgotten, including its mode
    /// and whether it is armed.
    pub fn restarted(&mut self, now: Duration) {
        let mut notices = Vec::new();
        self.inbox.restarted(&mut self.vehicle, now, &mut notices);
        self.output.say(notices);
        self.begin_anew(now);
    }

    /// Repeats all requests to the autopilot after a reboot.
    fn begin_anew(&mut self, now: Duration) {
        self.streams.forget(now);
        self.surroundings.begin_anew();
        self.download.begin_anew(&mut self.inbox);
        self.defaults.begin_anew();
        // Messages for the vehicle before its reboot must not reach it afterwards.
        let newer = text!("outcome-the-reboot");
        let (line, mut moment) = self.line(now);
        line.clear(&newer, &mut moment);
        line.supersede_movements(&newer, now, moment.output);
        self.vehicle.asked_speeds = AskedSpeeds::default();
        let (files, mut scene) = self.files(now);
        files.clear(&newer, &mut scene);
        self.events.forget();
        self.ftp.forget();
        self.lists.begin_anew(&mut self.ftp, now);
        self.logs
            .clear(&newer, &self.vehicle, now, &mut self.output);
    }

    /// Queues an order. An urgent one (kill, disarm, land, return, hold) cancels commands that wait or have not been
    /// answered.
    pub fn order(&mut self, order: VehicleCommand, now: Duration) {
        if matches!(order.command, Command::Log(_)) {
            self.logs.order(order, &self.vehicle, now, &mut self.output);
            self.poll(now);
            return;
        }
        if matches!(order.command, Command::File(_)) {
            let (files, mut scene) = self.files(now);
            files.order(order, &mut scene);
            self.poll(now);
            return;
        }
        if matches!(order.command, Command::Signing(_)) {
            let signing = &mut self.signing;
            signing.order(order, &self.vehicle, now, &mut self.output);
            self.poll(now);
            return;
        }
        if let Command::Device(DeviceCommand::Sticks(change)) = order.command {
            self.sticks
                .order(&order, change, &mut self.vehicle, now, &mut self.output);
            self.poll(now);
            return;
        }
        if matches!(order.command, Command::Plan(_)) {
            let (lists, desk) = self.lists(now);
            lists.order(order, desk);
            self.poll(now);
            return;
        }
        self.control.note(&order.command, now);
        let (line, moment) = self.line(now);
        line.order(order, moment);
    }

    /// Sends a vehicle's setpoint in a joint manoeuvre: it is not a command, has no answer, and
    /// supersedes only earlier movements.
    ///
    /// # Errors
    /// The setpoint is in the ground or not a valid position; nothing is sent.
    pub fn steer(&mut self, steering: &Steering, now: Duration) -> Result<(), Text> {
        let (line, moment) = self.line(now);
        line.steer(steering, moment)
    }

    /// Notes that another vehicle with the same system id is heard.
    pub fn note_twin(&mut self, now: Duration) {
        self.vehicle.twin = Some(now);
    }

    /// Holds channels that are steered by keys, until the next call or for a second; `None` releases all channels.
    pub fn steer_by_hand(&mut self, held: Option<HeldChannels>, now: Duration) {
        match held {
            Some(held) => self.sticks.steer(held, &mut self.vehicle, now),
            None => self.sticks.release(&mut self.vehicle, now),
        }
        self.poll(now);
    }

    /// Advances time: retries, deadlines, silence. Must be called within the time that [`Self::patience`] returns.
    pub fn poll(&mut self, now: Duration) {
        self.now = now;
        self.take_in_arrived(now);
        self.surroundings.poll(&self.vehicle, now);
        self.vehicle.link.radio = self.surroundings.tested(now);
        let mut notices = Vec::new();
        self.inbox.poll(&mut self.vehicle, now, &mut notices);
        self.output.say(notices);
        let twin = &mut self.vehicle.twin;
        *twin = twin.filter(|heard| now < *heard + TWIN_GONE_AFTER);
        let lost = watch_silence(&mut self.vehicle, now);
        self.output.say(lost);
        if !self.vehicle.link.lost && self.vehicle.heartbeat.is_some() {
            self.output
                .messages
                .extend(self.timesync.poll(self.vehicle.address(), now));
            for (message, command) in self.streams.poll(&self.vehicle, now) {
                self.output.messages.push(message);
                self.line.expect_ack(command, now);
            }
            let is_free = self.line.is_free();
            let (lists, desk) = self.lists(now);
            lists.read(is_free, desk);
            let offers_file = self.offers_defaults();
            let fetching = self.download.fetching();
            self.defaults.poll(fetching, offers_file, &mut self.ftp);
            let given_up = self.events.poll(&self.vehicle, now, &mut self.output);
            self.output.say(given_up);
            let requests = self.download.poll(&mut self.inbox, &self.vehicle, now);
            self.output.messages.extend(requests);
        }
        let (lists, desk) = self.lists(now);
        lists.poll(desk);
        self.logs
            .poll(&self.vehicle, &mut self.ftp, now, &mut self.output);
        let (files, mut scene) = self.files(now);
        files.poll(&mut scene);
        self.handle_files(None, now);
        self.signing.poll(&self.vehicle, now, &mut self.output);
        if self.control.poll(&self.vehicle, now, &mut self.output) {
            self.line.expect_ack(REQUEST_CONTROL, now);
        }
        self.sticks.poll(&mut self.vehicle, now, &mut self.output);
        self.advance(now);
    }

    /// The maximum time until the next poll if nothing arrives.
    pub fn patience(&self) -> Duration {
        if self.surroundings.is_under_test() {
            return TEST_POLL;
        }
        if !self.surroundings.are_settled()
            || self.line.is_busy()
            || self.logs.is_busy()
            || self.lists.is_busy()
            || self.download.fetching().is_under_way()
            || self.files.is_busy()
            || self.ftp.is_busy()
            || self.events.is_busy()
            || self.signing.is_busy()
            || self.control.is_busy()
            || self.sticks.is_busy(&self.vehicle)
        {
            BUSY_POLL
        } else {
            IDLE_POLL
        }
    }

    /// Takes the messages to send, in order.
    pub fn take_outgoing(&mut self) -> Vec<Outgoing> {
        let mut said = std::mem::take(&mut self.output.messages);
        for message in &mut said {
            parameter_code::encode(message, &self.vehicle, self.inbox.parameters());
        }
        self.surroundings.pass(said, self.now)
    }

    /// Takes the reports, in order.
    pub fn take_reports(&mut self) -> Vec<Report> {
        std::mem::take(&mut self.output.reports)
    }

    fn hear(&mut self, frame: &Frame, now: Duration) {
        let back = self.hearing.hear(frame, &mut self.vehicle, now);
        if frame.is_verified() {
            self.streams.note(frame.content.id());
        }
        if back.is_some() {
            self.streams.forget(now);
            self.download.resume(now);
        }
        self.output.say(back);
    }

    /// Handles answers to the console's requests, and answers the vehicle's requests.
    fn answer(&mut self, frame: &Frame, now: Duration) {
        if let Content::Message(message) = &frame.content {
            let (reply, round_trip) = self.timesync.receive(message, self.vehicle.system, now);
            self.output.messages.extend(reply);
            if round_trip.is_some() {
                self.vehicle.link.round_trip = round_trip;
            }
            let heard = self.events.receive(message, &self.vehicle, now);
            self.line.hear_texts(heard.as_slice());
            self.output.say(heard);
        }
        self.signing
            .receive(frame, &self.vehicle, now, &mut self.output);
        let (lists, desk) = self.lists(now);
        lists.receive(frame, desk);
        self.logs.receive(frame, now);
        if let Content::Message(MavMessage::FILE_TRANSFER_PROTOCOL(data)) = &frame.content
            && [0, self.vehicle.station].contains(&data.target_system)
        {
            self.handle_files(Some(&data.payload), now);
        }
        ControlDesk::receive(frame, &self.vehicle, now, &mut self.output);
        self.line
            .receive(frame, self.vehicle.station, now, &mut self.output);
    }

    fn advance(&mut self, now: Duration) {
        let (line, moment) = self.line(now);
        line.advance(moment);
    }

    fn lists(&mut self, now: Duration) -> (&mut Lists, ListsDesk<'_>) {
        let desk = ListsDesk {
            vehicle: &mut self.vehicle,
            parameters: self.inbox.parameters(),
            ftp: &mut self.ftp,
            now,
            output: &mut self.output,
        };
        (&mut self.lists, desk)
    }

    fn line(&mut self, now: Duration) -> (&mut Line, Moment<'_>) {
        let moment = Moment {
            vehicle: &mut self.vehicle,
            parameters: self.inbox.parameters(),
            now,
            output: &mut self.output,
        };
        (&mut self.line, moment)
    }
}
