//! Shares access to the lists of a vehicle: the background reading ([`plans`](super::plans)) makes
//! way for the orders ([`plan_orders`](super::plan_orders)).

use std::sync::Arc;
use std::time::Duration;

use super::VehicleCommand;
use super::ftp::{FtpClient, FtpEvent, FtpTicket};
use super::output::Output;
use super::plan_orders::{Desk, PlanOrders, PlanShelf};
use super::plans::PlanReader;
use crate::parameters::ParameterList;
use crate::plan::Document;
use crate::vehicle::Vehicle;
use crate::wire::Frame;

/// The plan, the fence and the rally points of a vehicle. While an order is carried out, nothing else is read.
#[derive(Debug, Clone, Default)]
pub(super) struct Lists {
    reader: PlanReader,
    orders: PlanOrders,
}

/// The parts of the session that the lists use.
pub(super) struct ListsDesk<'a> {
    pub vehicle: &'a mut Vehicle,
    pub parameters: &'a ParameterList,
    pub ftp: &'a mut FtpClient,
    pub now: Duration,
    pub output: &'a mut Output,
}

impl Lists {
    /// Reads lists from the answers to other stations' requests, without requesting them.
    pub fn only_follow(&mut self) {
        self.reader.only_follow();
    }

    /// Reads and writes the files of orders through `shelf`.
    pub fn take_from(&mut self, shelf: Arc<dyn PlanShelf>) {
        self.orders.take_from(shelf);
    }

    /// Notes that another ground station is heard.
    pub fn station_heard(&mut self, now: Duration) {
        self.reader.station_heard(now);
    }

    /// Whether a list is being read or an order is being carried out.
    pub fn is_busy(&self) -> bool {
        self.reader.is_busy() || self.orders.is_busy()
    }

    /// Reads all lists again, because the link was down or the vehicle has rebooted.
    pub fn begin_anew(&mut self, ftp: &mut FtpClient, now: Duration) {
        self.reader.forget();
        self.orders.begin_anew(ftp, now);
    }

    /// Puts the lists of a document on board before any order.
    pub fn stock(&mut self, document: &Arc<Document>) {
        self.orders.stock(document);
    }

    pub fn order(&mut self, order: VehicleCommand, desk: ListsDesk<'_>) {
        let (orders, mut desk) = self.desk(desk);
        orders.order(order, &mut desk);
    }

    /// Handles a message of the autopilot.
    pub fn receive(&mut self, frame: &Frame, desk: ListsDesk<'_>) {
        let mut messages = Vec::new();
        if self.orders.is_busy() {
            self.reader.watch(frame, desk.now, &mut messages);
            desk.output.send(messages);
            let (orders, mut desk) = self.desk(desk);
            orders.receive(frame, &mut desk);
        } else {
            self.reader
                .receive(desk.vehicle, frame, desk.now, &mut messages);
            desk.output.send(messages);
        }
    }

    /// Handles an event of the file client.
    pub fn hear_file(&mut self, ticket: FtpTicket, event: &FtpEvent, now: Duration) {
        self.orders.hear_file(ticket, event, now);
    }

    /// Advances reading, which begins only if no command waits for its answer.
    pub fn read(&mut self, is_free: bool, desk: ListsDesk<'_>) {
        if (is_free || self.reader.is_busy()) && !self.orders.is_busy() {
            let ListsDesk {
                vehicle,
                now,
                output,
                parameters: _,
                ftp: _,
            } = desk;
            let mut messages = Vec::new();
            self.reader.poll(vehicle, now, &mut messages);
            output.send(messages);
        }
    }

    /// Takes the steps of the orders that are due.
    pub fn poll(&mut self, desk: ListsDesk<'_>) {
        let (orders, mut desk) = self.desk(desk);
        orders.poll(&mut desk);
    }

    fn desk<'a>(&'a mut self, desk: ListsDesk<'a>) -> (&'a mut PlanOrders, Desk<'a>) {
        let ListsDesk {
            vehicle,
            parameters,
            ftp,
            now,
            output,
        } = desk;
        let desk = Desk {
            vehicle,
            parameters,
            plans: &mut self.reader,
            ftp,
            now,
            output,
        };
        (&mut self.orders, desk)
    }
}
