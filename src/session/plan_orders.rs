//! Carries out an operator's orders about the plan, the fence and the rally points of a vehicle: `upload`, `download`,
//! `clear`, `show`.
//!
//! These orders are separate from the line of commands, one at a time. An upload is a [`Transaction`]: afterwards the
//! vehicle holds the new list or the old one. It survives a lost link and a reboot of the vehicle.
//!
//! # How the parts fit
//! - What to send: `goal`, or why nothing can be sent; `judging` says whether the list suits the vehicle.
//! - How it gets there: `transaction` ends with the new list or the old one, over `sending` (item by item) or
//!   `packed` (as a file); `reading` fetches a list, `compare` says whether it is the one that was sent.
//! - `list` and `shelf` are the lists and files that this needs, `stock` those that a mission puts on board, `job`
//!   the order under way.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use self::goal::goal;
use self::job::Job;
use self::list::{PlanOrderGoal, whole};
use self::stock::Stock;
use super::ftp::{FtpClient, FtpEvent, FtpTicket};
use super::plans::PlanReader;
use super::{Output, Report, VehicleCommand};
use crate::commands::Command;
use crate::ledger::RowState;
use crate::parameters::ParameterList;
use crate::plan::Document;
use crate::text;
use crate::vehicle::Vehicle;
use crate::wire::Frame;

mod compare;
mod goal;
mod job;
mod judging;
mod list;
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

const MOST_WAITING: usize = 8;

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
    stock: Stock,
    waiting: VecDeque<VehicleCommand>,
    job: Option<Job>,
    /// Whether the lists kept from earlier transfers have been reported.
    has_named_kept: bool,
}

impl PlanOrders {
    pub fn take_from(&mut self, shelf: Arc<dyn PlanShelf>) {
        self.shelf = Some(shelf);
    }

    /// Whether an order is being carried out.
    pub fn is_busy(&self) -> bool {
        self.job.is_some() || !self.waiting.is_empty() || !self.stock.is_empty()
    }

    /// Puts the lists of a document on board before any order, once the vehicle has a home.
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

    /// Begins to read the list on board, because the link was down or the vehicle has rebooted.
    pub fn begin_anew(&mut self, ftp: &mut FtpClient, now: Duration) {
        if let Some(job) = &mut self.job {
            job.begin_anew(ftp, now);
        }
    }

    /// Handles a message of the vehicle.
    pub fn receive(&mut self, frame: &Frame, desk: &mut Desk<'_>) {
        if let Some(job) = &mut self.job {
            job.receive(frame, desk);
        }
    }

    /// Handles an event of the file client.
    pub fn hear_file(&mut self, ticket: FtpTicket, event: &FtpEvent, now: Duration) {
        if let Some(job) = &mut self.job {
            job.hear_file(ticket, event, now);
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
        if let Some(ended) = job.poll(self.shelf.as_deref(), desk) {
            self.has_named_kept = ended.is_known;
            if ended.is_of_stock {
                self.stock.note(ended.is_done);
            }
            self.job = None;
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

    /// Sends the next list of the mission. The vehicle must have a home by then: the home is read
    /// back as item 0 of the plan.
    fn begin_stock(&mut self, desk: &mut Desk<'_>) {
        let is_ready = desk.vehicle.heartbeat.is_some() && desk.vehicle.home.is_some();
        let Some((command, document)) = self.stock.upload().filter(|_| is_ready) else {
            return;
        };
        // The list is not checked: a mission may put faulty lists on board.
        let list = PlanOrderGoal {
            items: Some(whole(&document, command.kind)),
            ..PlanOrderGoal::default()
        };
        self.job = Some(Job::begin(None, command, list, desk));
    }

    fn begin(&mut self, desk: &mut Desk<'_>) {
        while let Some(order) = self.waiting.pop_front() {
            let Command::Plan(command) = order.command.clone() else {
                continue;
            };
            match goal(&command, self.shelf.as_deref(), desk) {
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
