//! The conversation with one vehicle, without any input or output of its own.
//!
//! A [`Session`] takes frames, orders and the current time, updates the [`Vehicle`] model, and
//! returns reports and the messages to send. The fleet drives one session per vehicle from a task;
//! an exercise drives them in lock step with the simulator. Both therefore behave the same, and
//! every time-out and retry can be tested without waiting.
//!
//! # How the parts fit
//! - What goes in and comes out: `set_up` (what is asked of a new vehicle), `order`, `output`.
//! - When the vehicle counts as heard, lost or back: `reception`, with `hearing`, `streams` (rates of telemetry) and
//!   `timesync` (round-trip time).
//! - What happens with an order: `orders`, with `line` (which order waits for its answer), `transaction` (send, retry,
//!   answer, effect), `precedence` (which order supersedes which), `fit` (refused for the vehicle's parameters),
//!   `acknowledgement`, `control` (which station the vehicle obeys).
//! - What takes minutes and runs beside the orders: `transfers`, with `lists`, `logs`, `files`, `ftp`, `gaps` and
//!   `defaults`; `metadata` (what a vehicle documents); `plan_orders` and `plans`, `signing`, `download` (of parameters), `events`.
//! - How parameters are encoded and named: `parameter_code`, `naming`, `settings` (those that a mission sets).
//! - What lies between vehicle and console: `surroundings`, `radio` (a mission's), `bench` (a radio under test),
//!   `sticks`.

use std::sync::Arc;
use std::time::Duration;

use crate::messages::Inbox;
use crate::notice::Notice;
use crate::parameters::{ParameterSnapshot, own_system};
use crate::text;
use crate::text::Text;
use crate::vehicle::{HeldChannels, Severity, Vehicle};
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
mod metadata;
mod naming;
mod order;
mod orders;
mod output;
mod parameter_code;
mod plan_orders;
mod plans;
mod precedence;
mod radio;
mod reception;
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

use download::Download;
use events::Events;
use hearing::watch_silence;
use line::Moment;
use orders::Orders;
use output::Output;
use reception::Reception;
use surroundings::Surroundings;
use transfers::ReadDefaults;

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
    reception: Reception,
    download: Download,
    events: Events,
    orders: Orders,
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
            reception: Reception::new(now),
            download: Download::new(),
            events: Events::default(),
            orders: Orders::default(),
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
            documents: Arc::clone(self.orders.documents()),
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
        self.reception.begin_anew(now);
        self.orders.transfers().link_up(now);
        self.download.resume(now);
    }

    /// Notes that another ground station is heard on the vehicle's link, which may change what is on board.
    pub fn station_heard(&mut self, now: Duration) {
        self.orders.transfers().station_heard(now);
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
            Want::Lists(document) => self.orders.transfers().stock(&document),
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
        if radio::position(frame).is_some() {
            self.vehicle.unheard = None;
        }
        let is_autopilot = frame.component == self.vehicle.component;
        if is_autopilot {
            let back = self.reception.hear(frame, &mut self.vehicle, now);
            if back.is_some() {
                self.download.resume(now);
            }
            self.output.say(back);
        }
        let reboots = self.vehicle.link.reboots;
        let mut notices = Vec::new();
        self.inbox
            .apply(&mut self.vehicle, frame, now, &mut notices);
        self.orders.hear_texts(&notices);
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

    /// Notes that a vehicle with this system id has appeared on the link of this one: it is the same vehicle if its id was
    /// changed to this one, which takes effect with a reboot.
    pub fn hear_new_vehicle(&mut self, system: SystemId, now: Duration) {
        if own_system(self.inbox.parameters()) != Some(system) {
            return;
        }
        self.vehicle.link.renumbered = Some(system);
        let id = self.vehicle.id;
        let text = text!("heard-renumbered", system = system, before = id);
        let notice = Notice::about(id, now, Severity::Notice, text);
        self.output.say([notice]);
        self.poll(now);
    }

    /// Repeats all requests to the autopilot after a reboot.
    fn begin_anew(&mut self, now: Duration) {
        self.reception.begin_anew(now);
        self.surroundings.begin_anew();
        self.download.begin_anew(&mut self.inbox);
        self.events.forget();
        let (orders, mut moment) = self.orders(now);
        orders.begin_anew(&mut moment);
    }

    /// Queues an order. An urgent one (kill, disarm, land, return, hold) cancels commands that wait or have not been
    /// answered.
    pub fn order(&mut self, order: VehicleCommand, now: Duration) {
        let (orders, moment) = self.orders(now);
        let is_beside_the_line = orders.order(order, moment);
        if is_beside_the_line {
            self.poll(now);
        }
    }

    /// Sends a vehicle's setpoint in a joint manoeuvre: it is not a command, has no answer, and
    /// supersedes only earlier movements.
    ///
    /// # Errors
    /// The setpoint is in the ground or not a valid position; nothing is sent.
    pub fn steer(&mut self, steering: &Steering, now: Duration) -> Result<(), Text> {
        let (orders, moment) = self.orders(now);
        orders.steer(steering, moment)
    }

    /// Notes that another vehicle with the same system id is heard.
    pub fn note_twin(&mut self, now: Duration) {
        self.vehicle.twin = Some(now);
    }

    /// Holds channels that are steered by keys, until the next call or for a second; `None` releases all channels.
    pub fn steer_by_hand(&mut self, held: Option<HeldChannels>, now: Duration) {
        self.orders.steer_by_hand(held, &mut self.vehicle, now);
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
            self.request(now);
        }
        let (orders, moment) = self.orders(now);
        let defaults = orders.poll(moment);
        self.note_defaults(defaults);
    }

    /// Requests telemetry, lists, events and parameters that are missing.
    fn request(&mut self, now: Duration) {
        for command in self.reception.poll(&self.vehicle, now, &mut self.output) {
            self.orders.expect_ack(command, now);
        }
        let fetching = self.download.fetching();
        let (orders, mut moment) = self.orders(now);
        orders.read(fetching, &mut moment);
        let given_up = self.events.poll(&self.vehicle, now, &mut self.output);
        self.output.say(given_up);
        let requests = self.download.poll(&mut self.inbox, &self.vehicle, now);
        self.output.messages.extend(requests);
    }

    /// The maximum time until the next poll if nothing arrives.
    pub fn patience(&self) -> Duration {
        if self.surroundings.is_under_test() {
            return TEST_POLL;
        }
        if !self.surroundings.are_settled()
            || self.download.fetching().is_under_way()
            || self.events.is_busy()
            || self.orders.is_busy(&self.vehicle)
        {
            BUSY_POLL
        } else {
            IDLE_POLL
        }
    }

    /// Takes the messages to send, in order.
    pub fn take_outgoing(&mut self) -> Vec<Outgoing> {
        let said = std::mem::take(&mut self.output.messages);
        self.surroundings.pass(said, self.now)
    }

    /// Takes the reports, in order.
    pub fn take_reports(&mut self) -> Vec<Report> {
        std::mem::take(&mut self.output.reports)
    }

    /// Handles answers to the console's requests, and answers the vehicle's requests.
    fn answer(&mut self, frame: &Frame, now: Duration) {
        if let Content::Message(message) = &frame.content {
            let reply = self.reception.receive(message, &mut self.vehicle, now);
            self.output.messages.extend(reply);
            let heard = self.events.receive(message, &self.vehicle, now);
            self.orders.hear_events(heard.as_slice());
            self.output.say(heard);
        }
        let (orders, mut moment) = self.orders(now);
        let defaults = orders.receive(frame, &mut moment);
        self.note_defaults(defaults);
    }

    fn note_defaults(&mut self, defaults: ReadDefaults) {
        if let Some(documents) = self.orders.transfers().take_events() {
            self.events.use_documents(documents);
        }
        if let Some(defaults) = defaults {
            self.inbox.note_defaults(defaults);
        }
    }

    fn advance(&mut self, now: Duration) {
        let (orders, moment) = self.orders(now);
        orders.advance(moment);
    }

    fn orders(&mut self, now: Duration) -> (&mut Orders, Moment<'_>) {
        let moment = Moment {
            vehicle: &mut self.vehicle,
            parameters: self.inbox.parameters(),
            now,
            output: &mut self.output,
        };
        (&mut self.orders, moment)
    }
}
