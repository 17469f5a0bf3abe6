//! Orders about the lists that a vehicle carries: its plan, its fence and its rally points.
//!
//! These orders are separate from the line of commands, one at a time. An upload is a [`Transaction`]: afterwards the
//! vehicle holds the new list or the old one. It survives a lost link and a reboot of the vehicle.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavAutopilot;

use super::ftp::{FtpClient, FtpEvent, FtpTicket};
use super::plans::PlanReader;
use super::{Output, Report, VehicleCommand};
use crate::commands::{Command, PlanCommand, PlanDeed, PlanSource};
use crate::ledger::{RowState, RowUpdate};
use crate::parameters::ParameterList;
use crate::plan::{Document, Home, Item, ListKind, command};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleId};
use crate::wire::Frame;

mod compare;
mod judging;
mod packed;
mod reading;
mod sending;
mod shelf;
mod stock;
#[cfg(test)]
mod tests;
mod transaction;

pub(crate) use shelf::format_of;
pub use shelf::{GuardedShelf, PlanOnFile, PlanShelf};
use stock::Stock;
use transaction::{Outcome, Transaction};

/// The maximum number of orders that wait for one vehicle.
const MOST_WAITING: usize = 8;
/// HEARTBEAT's autopilot of `ArduPilot`.
const ARDUPILOT: u8 = MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA as u8;

/// The inputs and outputs of an order.
pub(super) struct Desk<'a> {
    pub vehicle: &'a mut Vehicle,
    pub parameters: &'a ParameterList,
    pub plans: &'a mut PlanReader,
    pub ftp: &'a mut FtpClient,
    pub now: Duration,
    pub output: &'a mut Output,
}

/// The orders about the lists of one vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct PlanOrders {
    shelf: Option<Arc<dyn PlanShelf>>,
    /// Lists that a mission puts on board, before any order.
    stock: Stock,
    waiting: VecDeque<VehicleCommand>,
    job: Option<Job>,
    /// Whether the lists kept from earlier transfers have been named.
    has_named_kept: bool,
}

/// The order in progress, and its transfer.
#[derive(Debug, Clone)]
struct Job {
    /// The order whose row shows the progress; `None` for a list that the mission puts on board.
    order: Option<VehicleCommand>,
    command: PlanCommand,
    transaction: Box<Transaction>,
    /// Warnings about the list that is sent.
    warnings: Vec<Text>,
    /// The progress last reported, and whether the link was lost then.
    told: Option<(u8, bool)>,
}

/// How an order ends.
type Ending = (RowState, Text);

impl PlanOrders {
    pub fn take_from(&mut self, shelf: Arc<dyn PlanShelf>) {
        self.shelf = Some(shelf);
    }

    /// Whether an order is carried out.
    pub fn is_busy(&self) -> bool {
        self.job.is_some() || !self.waiting.is_empty() || !self.stock.is_empty()
    }

    /// Puts the lists of a document on board before any order, as soon as the vehicle is heard.
    pub fn stock(&mut self, document: &Arc<Document>) {
        self.stock.add(document);
    }

    pub fn order(&mut self, order: VehicleCommand, desk: &mut Desk<'_>) {
        if self.waiting.len() >= MOST_WAITING {
            let reason = text!("outcome-queue-full", count = MOST_WAITING);
            let row = order.unsent(desk.vehicle.id, RowState::Refused, reason, desk.now);
            desk.output.row(row);
            return;
        }
        self.waiting.push_back(order);
    }

    /// Begins to read what is on board, because the link was down or the vehicle has rebooted.
    pub fn begin_anew(&mut self, ftp: &mut FtpClient, now: Duration) {
        if let Some(job) = &mut self.job {
            job.transaction.begin_anew(ftp, now);
        }
    }

    /// Handles a message of the vehicle.
    pub fn receive(&mut self, frame: &Frame, desk: &mut Desk<'_>) {
        if let Some(job) = &mut self.job {
            job.transaction.receive(frame, desk);
        }
    }

    /// Handles an event of the client for files.
    pub fn hear_file(&mut self, ticket: FtpTicket, event: &FtpEvent, now: Duration) {
        if let Some(job) = &mut self.job {
            job.transaction.hear_file(ticket, event, now);
        }
    }

    /// Advances time: begins, continues and ends orders.
    pub fn poll(&mut self, desk: &mut Desk<'_>) {
        self.name_kept(desk);
        if self.job.is_none() {
            self.begin_stock(desk);
        }
        if self.job.is_none() && self.stock.is_empty() {
            self.begin(desk);
        }
        let Some(job) = &mut self.job else {
            return;
        };
        match job.transaction.poll(self.shelf.as_deref(), desk) {
            None => job.tell_progress(desk),
            Some(outcome) => {
                self.has_named_kept = outcome != Outcome::Unknown;
                job.put_away(&outcome, self.shelf.as_deref(), desk.vehicle.id);
                let (state, text) = job.finish(outcome, self.shelf.as_deref(), desk);
                job.report(state, Some(text), desk);
                if job.order.is_none() {
                    self.stock.note(state == RowState::Done);
                }
                self.job = None;
            }
        }
    }

    /// Reports the lists that have been kept since a transfer was interrupted, once the vehicle is heard.
    fn name_kept(&mut self, desk: &mut Desk<'_>) {
        let Some(shelf) = &self.shelf else {
            return;
        };
        if self.has_named_kept || self.job.is_some() || desk.vehicle.heartbeat.is_none() {
            return;
        }
        self.has_named_kept = true;
        let notices = shelf::broken_off(shelf.as_ref(), desk.vehicle.id, desk.now);
        desk.output.reports.extend(notices.map(Report::Notice));
    }

    /// Sends the next list of the mission. The vehicle must have a home by then: it is read back as item 0 of the plan.
    fn begin_stock(&mut self, desk: &mut Desk<'_>) {
        let is_ready = desk.vehicle.heartbeat.is_some() && desk.vehicle.home.is_some();
        let Some((command, document)) = self.stock.upload().filter(|_| is_ready) else {
            return;
        };
        // It is not checked: a mission may put faulty lists on board.
        let list = Wanted {
            items: Some(whole(&document, command.kind)),
            ..Wanted::default()
        };
        self.job = Some(Job::begin(None, command, list, desk));
    }

    fn begin(&mut self, desk: &mut Desk<'_>) {
        while let Some(order) = self.waiting.pop_front() {
            let Command::Plan(command) = order.command.clone() else {
                continue;
            };
            match wanted(&command, self.shelf.as_deref(), desk) {
                Ok(new) => {
                    let job = Job::begin(Some(order), command, new, desk);
                    job.report(RowState::Sent, None, desk);
                    self.job = Some(job);
                    return;
                }
                Err(reason) => {
                    let row = order.unsent(desk.vehicle.id, RowState::Refused, reason, desk.now);
                    desk.output.row(row);
                }
            }
        }
    }
}

/// The state that an order should reach.
#[derive(Debug, Default)]
struct Wanted {
    /// The list that the vehicle is to carry; `None` if the order only reads.
    items: Option<Vec<Item>>,
    /// Warnings about the list.
    warnings: Vec<Text>,
}

fn wanted(
    command: &PlanCommand,
    shelf: Option<&dyn PlanShelf>,
    desk: &Desk<'_>,
) -> Result<Wanted, Text> {
    let vehicle = &*desk.vehicle;
    let writes = match &command.deed {
        PlanDeed::Upload { .. } | PlanDeed::Clear => true,
        PlanDeed::Download { .. } | PlanDeed::Show => false,
    };
    let is_ardupilot = vehicle
        .heartbeat
        .is_some_and(|it| it.autopilot == ARDUPILOT);
    if writes && !is_ardupilot {
        return Err(text!("refused-plan-autopilot"));
    }
    match &command.deed {
        PlanDeed::Download { .. } if shelf.is_none() => Err(text!("refused-plan-no-files")),
        PlanDeed::Download { .. } | PlanDeed::Show => Ok(Wanted::default()),
        PlanDeed::Clear if command.kind == ListKind::Plan && vehicle.flies_plan() => {
            Err(text!("refused-plan-clear-auto"))
        }
        PlanDeed::Clear => Ok(Wanted {
            items: Some(Vec::new()),
            ..Wanted::default()
        }),
        PlanDeed::Upload { source } => {
            let content = match source {
                PlanSource::Document(document) => PlanOnFile {
                    document: Document::clone(document),
                    notes: Vec::new(),
                },
                PlanSource::Remarked(document, remark) => PlanOnFile {
                    document: Document::clone(document),
                    notes: vec![(command.kind, remark.clone())],
                },
                PlanSource::File(file) => {
                    let shelf = shelf.ok_or_else(|| text!("refused-plan-no-files"))?;
                    shelf.read(&named(file, vehicle))?
                }
            };
            judging::checked(content, command.kind, desk)
        }
    }
}

/// A list as a vehicle carries it: with home as item 0 of a plan, which the vehicle replaces by its own.
fn whole(document: &Document, kind: ListKind) -> Vec<Item> {
    let home = document.home.unwrap_or(Home { x: 0, y: 0, z: 0.0 });
    let first = Item {
        command: command::WAYPOINT,
        frame: 0,
        auto_continue: true,
        params: [0.0; 4],
        x: home.x,
        y: home.y,
        z: home.z,
    };
    let of_plan = (kind == ListKind::Plan).then_some(first);
    of_plan
        .into_iter()
        .chain(document.list(kind).iter().copied())
        .collect()
}

/// The content of a file with a vehicle's list.
fn document_of(kind: ListKind, items: &[Item]) -> Document {
    let first = items.first().filter(|_| kind == ListKind::Plan);
    let mut document = Document {
        home: first.map(|home| Home {
            x: home.x,
            y: home.y,
            z: home.z,
        }),
        ..Document::default()
    };
    document.list_mut(kind).extend(compare::own(kind, items));
    document
}

/// A file's name for a vehicle: `{id}` stands for its number.
fn named(file: &str, vehicle: &Vehicle) -> String {
    file.replace("{id}", &vehicle.id.to_string())
}

impl Job {
    /// Begins a transfer, before which any reading makes way.
    fn begin(
        order: Option<VehicleCommand>,
        command: PlanCommand,
        wanted: Wanted,
        desk: &mut Desk<'_>,
    ) -> Self {
        let mut messages = Vec::new();
        desk.plans.make_way(desk.now, &mut messages);
        desk.output.send(messages);
        let transaction = Transaction::new(command.kind, wanted.items, desk);
        Self {
            order,
            command,
            transaction: Box::new(transaction),
            warnings: wanted.warnings,
            told: None,
        }
    }

    fn report(&self, state: RowState, explanation: Option<Text>, desk: &mut Desk<'_>) {
        let Some(order) = &self.order else {
            return;
        };
        let row = RowUpdate {
            entry: order.entry,
            vehicle: desk.vehicle.id,
            state,
            tries: 1,
            at: desk.now,
            explanation,
        };
        desk.output.row(row);
    }

    fn tell_progress(&mut self, desk: &mut Desk<'_>) {
        let told = (self.transaction.percent(), desk.vehicle.link.lost);
        if self.told == Some(told) {
            return;
        }
        self.told = Some(told);
        let explanation = if desk.vehicle.link.lost {
            Some(text!("plan-stage-lost"))
        } else {
            self.transaction
                .is_restoring()
                .then(|| text!("plan-stage-restoring"))
        };
        self.report(RowState::InProgress(told.0), explanation, desk);
    }

    /// Removes the stored old list, unless it may still be needed.
    fn put_away(&self, outcome: &Outcome, shelf: Option<&dyn PlanShelf>, vehicle: VehicleId) {
        let writes = match self.command.deed {
            PlanDeed::Upload { .. } | PlanDeed::Clear => true,
            PlanDeed::Download { .. } | PlanDeed::Show => false,
        };
        let is_over = match outcome {
            Outcome::Written(_) | Outcome::Same(_) => writes,
            // The list before this transfer may itself be an incomplete one.
            Outcome::Kept(..) | Outcome::Restored(..) => self.transaction.is_stored(),
            Outcome::Read(_)
            | Outcome::Changed(_)
            | Outcome::Unfamiliar(_)
            | Outcome::Unsupported
            | Outcome::Unread
            | Outcome::Unknown => false,
        };
        if let Some(shelf) = shelf.filter(|_| is_over) {
            shelf.release(vehicle, self.command.kind);
        }
    }

    /// Notes what the vehicle holds, and says how the order has ended.
    fn finish(
        &self,
        outcome: Outcome,
        shelf: Option<&dyn PlanShelf>,
        desk: &mut Desk<'_>,
    ) -> Ending {
        let kind = self.command.kind;
        let is_unknown = outcome == Outcome::Unknown;
        let (held, ending) = self.ended(outcome, shelf, desk.vehicle);
        if let Some(items) = held {
            desk.plans.learn(desk.vehicle, kind, items, desk.now);
        } else {
            if is_unknown {
                desk.plans.forget_acknowledged(kind);
            }
            desk.plans.read_again(kind, desk.now);
        }
        ending
    }

    /// The list that the vehicle holds, if known, and how the order has ended.
    fn ended(
        &self,
        outcome: Outcome,
        shelf: Option<&dyn PlanShelf>,
        vehicle: &Vehicle,
    ) -> (Option<Vec<Item>>, Ending) {
        let kind = self.command.kind;
        let done = |message, items: Vec<Item>| {
            let text = self.warned(counted(message, kind, &items));
            (Some(items), (RowState::Done, text))
        };
        let refused = |message, items: Vec<Item>| {
            let text = counted(message, kind, &items);
            (Some(items), (RowState::Refused, text))
        };
        match outcome {
            Outcome::Read(items) => {
                let ending = self.was_read(&items, shelf, vehicle);
                (Some(items), ending)
            }
            Outcome::Written(items) => done("outcome-plan-written", items),
            Outcome::Same(items) => done("outcome-plan-same", items),
            Outcome::Changed(items) => refused("refused-plan-changed", items),
            Outcome::Unfamiliar(items) => refused("refused-plan-unfamiliar", items),
            Outcome::Kept(items, reason) => {
                let text = text!("outcome-plan-kept", reason = reason);
                (Some(items), (RowState::Refused, text))
            }
            Outcome::Restored(items, reason) => {
                let text = text!("outcome-plan-restored", reason = reason);
                (Some(items), (RowState::Refused, text))
            }
            Outcome::Unsupported => (None, (RowState::Refused, text!("refused-plan-no-list"))),
            Outcome::Unread => (None, (RowState::TimedOut, text!("outcome-plan-unread"))),
            Outcome::Unknown => (None, (RowState::TimedOut, text!("outcome-plan-unknown"))),
        }
    }

    /// An outcome with the warnings about the list.
    fn warned(&self, outcome: Text) -> Text {
        let Some(warned) = judging::warned(&self.warnings) else {
            return outcome;
        };
        Text::joined("; ", vec![outcome, warned])
    }

    fn was_read(&self, items: &[Item], shelf: Option<&dyn PlanShelf>, vehicle: &Vehicle) -> Ending {
        let kind = self.command.kind;
        let (PlanDeed::Download { file }, Some(shelf)) = (&self.command.deed, shelf) else {
            return (RowState::Done, counted("outcome-plan-read", kind, items));
        };
        match shelf.write(&named(file, vehicle), kind, &document_of(kind, items)) {
            Ok(path) => {
                let count = compare::own(kind, items).len();
                let text = text!("outcome-plan-saved", count = count, file = path);
                (RowState::Done, text)
            }
            Err(reason) => (RowState::Refused, reason),
        }
    }
}

/// A message about a list with its length and its fingerprint.
fn counted(message: &'static str, kind: ListKind, items: &[Item]) -> Text {
    let own = compare::own(kind, items);
    let mark = compare::mark(own);
    Text::new(
        message,
        vec![("count", own.len().into()), ("mark", mark.into())],
    )
}
