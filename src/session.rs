//! The conversation with one vehicle, without any input or output of its own.
//!
//! A [`Session`] takes frames and orders, with the time, updates the [`Vehicle`] model, and returns messages to send
//! and reports. The fleet drives one per vehicle from a task; an exercise drives them in lock step with the simulator.
//! Both therefore behave the same, and every time-out and retry can be tested without waiting.

use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{FILE_TRANSFER_PROTOCOL_DATA, MavMessage};

use crate::commands::Command;
use crate::ledger::RowUpdate;
use crate::messages::Inbox;
use crate::notice::Notice;
use crate::parameters::ParameterSnapshot;
use crate::text;
use crate::text::Text;
use crate::vehicle::{AskedSpeeds, Vehicle};
use crate::wire::{ComponentId, Content, Frame, GROUND_STATION_SYSTEM, Outgoing, SystemId};

mod acknowledgement;
mod download;
mod fit;
mod ftp;
mod gaps;
mod hearing;
mod line;
mod logs;
mod naming;
mod order;
mod plan_orders;
mod plans;
mod precedence;
mod radio;
mod settings;
mod streams;
#[cfg(test)]
mod tests;
mod timesync;
mod transaction;

use download::Download;
use hearing::{Hearing, watch_silence};
use line::{Line, Moment};
use logs::LogReader;
use plan_orders::{Desk, PlanOrders};
use plans::PlanReader;
use streams::Streams;
use timesync::Timesync;

pub use ftp::{
    FtpChecksum, FtpClient, FtpEntry, FtpEvent, FtpFault, FtpNak, FtpPayload, FtpStep, FtpTask,
    FtpTicket,
};
pub use gaps::{FileBytes, GapMap};
pub use hearing::{LOST_AFTER, autopilot_of};
pub use logs::{KeptLog, ListedLog, LogKeeper, VehicleLog};
pub use naming::Renamed;

pub use order::{Report, Steering, VehicleCommand};
pub use plan_orders::PlanShelf;
pub(crate) use plan_orders::format_of;
pub use radio::RadioFault;
pub use settings::Want;
pub use streams::{Stream, WANTED_STREAMS};

/// The maximum time between polls while an answer is awaited or something is repeated.
const BUSY_POLL: Duration = Duration::from_millis(50);
/// The maximum time between polls otherwise.
const IDLE_POLL: Duration = Duration::from_millis(500);

/// A session's messages and reports.
#[derive(Debug, Clone, Default)]
struct Output {
    messages: Vec<Outgoing>,
    /// Acknowledgements of `DO_CHANGE_SPEED` that no order waits for.
    speed_acks: u8,
    reports: Vec<Report>,
}

impl Output {
    /// Repeats speeds that were set before.
    fn say_speeds(&mut self, speeds: Vec<Outgoing>) {
        let count = u8::try_from(speeds.len()).unwrap_or(u8::MAX);
        self.speed_acks = self.speed_acks.saturating_add(count);
        self.messages.extend(speeds);
    }

    fn row(&mut self, update: RowUpdate) {
        self.reports.push(Report::Row(update));
    }
}

/// The state of a conversation with one vehicle.
#[derive(Debug, Clone)]
pub struct Session {
    vehicle: Vehicle,
    inbox: Inbox,
    hearing: Hearing,
    streams: Streams,
    timesync: Timesync,
    plans: PlanReader,
    plan_orders: PlanOrders,
    line: Line,
    download: Download,
    logs: LogReader,
    ftp: FtpClient,
    output: Output,
    /// The radio between the vehicle and us.
    channel: radio::Channel,
    settings: settings::Settings,
    /// Messages that bypass the simulated radio.
    beside: Vec<Outgoing>,
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
            plans: PlanReader::default(),
            plan_orders: PlanOrders::default(),
            line: Line::default(),
            download: Download::new(),
            logs: LogReader::default(),
            ftp: FtpClient::default(),
            output: Output::default(),
            channel: radio::Channel::new(),
            settings: settings::Settings::default(),
            beside: Vec::new(),
            now,
        }
    }

    /// Requests different telemetry from that of the console.
    #[must_use]
    pub fn wanting(mut self, streams: &'static [Stream], now: Duration) -> Self {
        self.streams = Streams::new(streams, now);
        self
    }

    /// Stores the vehicle's downloaded logs with `keeper`.
    #[must_use]
    pub fn keeping_logs(mut self, keeper: Arc<dyn LogKeeper>) -> Self {
        self.logs.keep_in(keeper);
        self
    }

    /// Takes the files of plans from `shelf`, and writes them there.
    #[must_use]
    pub fn with_plan_files(mut self, shelf: Arc<dyn PlanShelf>) -> Self {
        self.plan_orders.take_from(shelf);
        self
    }

    /// Reads plans from the answers to others' requests, as in a recording, instead of its own.
    #[must_use]
    pub fn following_plans(mut self) -> Self {
        self.plans.only_follow();
        self
    }

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
        self.plans.forget();
        self.plan_orders.begin_anew(&mut self.ftp, now);
        self.download.resume(now);
    }

    /// Handles one frame from this vehicle's system. Only its autopilot counts as heard: a companion computer with the
    /// same system id may keep sending when the autopilot has stopped.
    pub fn receive(&mut self, frame: &Frame, now: Duration) {
        self.now = now;
        if frame.component == self.vehicle.component && frame.is_verified() {
            self.settings.receive(frame);
        }
        if self.channel.is_clear() {
            self.take_in(frame, now);
            return;
        }
        if !self.channel.hear(frame, now)
            && let Some(unheard) = radio::position(frame)
        {
            self.vehicle.unheard = Some(unheard);
        }
        self.take_in_arrived(now);
    }

    /// Notes a pause in which nothing could be heard: it does not count as silence.
    pub fn rest(&mut self, lasted: Duration) {
        let link = &mut self.vehicle.link;
        link.last_heard = link.last_heard.map(|heard| heard + lasted);
    }

    /// Applies a change to the vehicle's simulator or to the radio link.
    pub fn carry_out(&mut self, want: Want) {
        match want {
            Want::Parameter { name, value } => self.settings.want(name, value),
            Want::Radio(fault) => self.channel.set(fault, u64::from(self.vehicle.id)),
        }
    }

    /// Whether the radio link is cut, also for our heartbeats.
    pub fn is_cut(&self) -> bool {
        self.channel.is_cut()
    }

    fn take_in_arrived(&mut self, now: Duration) {
        while let Some(frame) = self.channel.arrived(now) {
            self.take_in(&frame, now);
        }
    }

    fn take_in(&mut self, frame: &Frame, now: Duration) {
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
        self.say(notices);
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
        self.say(notices);
        self.begin_anew(now);
    }

    /// Repeats all requests to the autopilot after a reboot.
    fn begin_anew(&mut self, now: Duration) {
        self.streams.forget(now);
        self.plans.forget();
        self.settings.forget();
        self.download.begin_anew(&mut self.inbox);
        // Messages for the vehicle before its reboot must not reach it afterwards.
        let newer = text!("outcome-the-reboot");
        let (line, mut moment) = self.line(now);
        line.clear(&newer, &mut moment);
        line.supersede_movements(&newer, now, moment.output);
        self.vehicle.asked_speeds = AskedSpeeds::default();
        self.ftp.forget();
        self.plan_orders.begin_anew(&mut self.ftp, now);
        self.logs
            .clear(&newer, &self.vehicle, now, &mut self.output);
    }

    /// Queues an order. Urgent ones (kill, disarm, land, return, hold) go before everything that waits.
    pub fn order(&mut self, order: VehicleCommand, now: Duration) {
        if matches!(order.command, Command::Log(_)) {
            self.logs.order(order, &self.vehicle, now, &mut self.output);
            self.poll(now);
            return;
        }
        if matches!(order.command, Command::Plan(_)) {
            let (orders, mut desk) = self.plan_desk(now);
            orders.order(order, &mut desk);
            self.poll(now);
            return;
        }
        let (line, moment) = self.line(now);
        line.order(order, moment);
    }

    /// Sends a vehicle's setpoint in a joint manoeuvre: it is not a command, has no answer, and only ends earlier
    /// movements.
    ///
    /// # Errors
    /// A text if the place does not exist; nothing is sent.
    pub fn steer(&mut self, steering: &Steering, now: Duration) -> Result<(), Text> {
        let (line, moment) = self.line(now);
        line.steer(steering, moment)
    }

    /// Advances time: retries, deadlines, silence. Must be called within the time that [`Self::patience`] returns.
    pub fn poll(&mut self, now: Duration) {
        self.now = now;
        self.take_in_arrived(now);
        self.beside.extend(self.settings.poll(&self.vehicle, now));
        let mut notices = Vec::new();
        self.inbox.poll(&mut self.vehicle, now, &mut notices);
        self.say(notices);
        let lost = watch_silence(&mut self.vehicle, now);
        self.say(lost);
        if !self.vehicle.link.lost && self.vehicle.heartbeat.is_some() {
            self.output
                .messages
                .extend(self.timesync.poll(self.vehicle.address(), now));
            for (message, command) in self.streams.poll(&self.vehicle, now) {
                self.output.messages.push(message);
                self.line.expect_ack(command, now);
            }
            self.read_plans(now);
            let requests = self.download.poll(&mut self.inbox, &self.vehicle, now);
            self.output.messages.extend(requests);
        }
        let (orders, mut desk) = self.plan_desk(now);
        orders.poll(&mut desk);
        self.logs
            .poll(&self.vehicle, &mut self.ftp, now, &mut self.output);
        self.handle_files(None, now);
        self.advance(now);
    }

    /// The maximum time until the next poll if nothing arrives.
    pub fn patience(&self) -> Duration {
        let is_fetching = self.plans.is_busy() || self.download.fetching().is_under_way();
        let is_late = !self.channel.is_clear() || !self.settings.are_settled();
        if is_late
            || self.line.is_busy()
            || self.logs.is_busy()
            || self.plan_orders.is_busy()
            || is_fetching
            || self.ftp.is_busy()
        {
            BUSY_POLL
        } else {
            IDLE_POLL
        }
    }

    /// Takes the messages to send, in order.
    pub fn take_outgoing(&mut self) -> Vec<Outgoing> {
        let said = std::mem::take(&mut self.output.messages);
        if self.channel.is_clear() && self.beside.is_empty() {
            return said;
        }
        let mut there = self.channel.say(said, self.now);
        there.append(&mut self.beside);
        there
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
        self.say(back);
    }

    /// Handles answers to our requests, and answers the vehicle's requests.
    fn answer(&mut self, frame: &Frame, now: Duration) {
        if let Content::Message(message) = &frame.content {
            let (reply, round_trip) = self.timesync.receive(message, self.vehicle.system, now);
            self.output.messages.extend(reply);
            if round_trip.is_some() {
                self.vehicle.link.round_trip = round_trip;
            }
        }
        let mut messages = Vec::new();
        if self.plan_orders.is_busy() {
            self.plans.watch(frame, now, &mut messages);
            let (orders, mut desk) = self.plan_desk(now);
            orders.receive(frame, &mut desk);
        } else {
            self.plans
                .receive(&mut self.vehicle, frame, now, &mut messages);
        }
        self.send(messages);
        self.logs.receive(frame, now);
        if let Content::Message(MavMessage::FILE_TRANSFER_PROTOCOL(data)) = &frame.content
            && matches!(data.target_system, 0 | GROUND_STATION_SYSTEM)
        {
            self.handle_files(Some(&data.payload), now);
        }
        self.line.receive(frame, now, &mut self.output);
    }

    /// Advances the client for files, and passes on the events of its tasks.
    fn handle_files(&mut self, incoming: Option<&FtpPayload>, now: Duration) {
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
            self.plan_orders.hear_file(ticket, &event, now);
            self.logs.hear_file(ticket, event, &mut self.ftp, now);
        }
    }

    /// Reads plans, unless a command waits for its answer.
    fn read_plans(&mut self, now: Duration) {
        let is_free = self.line.is_free() || self.plans.is_busy();
        if is_free && !self.plan_orders.is_busy() {
            let mut messages = Vec::new();
            self.plans.poll(&mut self.vehicle, now, &mut messages);
            self.send(messages);
        }
    }

    fn send(&mut self, messages: Vec<MavMessage>) {
        let messages = messages.into_iter().map(Outgoing::from);
        self.output.messages.extend(messages);
    }

    fn say(&mut self, notices: impl IntoIterator<Item = Notice>) {
        let reports = notices.into_iter().map(Report::Notice);
        self.output.reports.extend(reports);
    }

    /// Advances all orders as far as possible.
    fn advance(&mut self, now: Duration) {
        let (line, moment) = self.line(now);
        line.advance(moment);
    }

    fn plan_desk(&mut self, now: Duration) -> (&mut PlanOrders, Desk<'_>) {
        let desk = Desk {
            vehicle: &mut self.vehicle,
            plans: &mut self.plans,
            ftp: &mut self.ftp,
            now,
            output: &mut self.output,
        };
        (&mut self.plan_orders, desk)
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
