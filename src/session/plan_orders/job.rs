//! The order in progress.

use std::time::Duration;

use super::goal::named;
use super::list::{PlanOrderGoal, document_of};
use super::transaction::{Outcome, Transaction};
use super::{Desk, PlanShelf, compare, judging};
use crate::commands::{PlanCommand, PlanDeed};
use crate::ledger::{RowEnding, RowState, RowUpdate};
use crate::plan::{Item, ListKind};
use crate::session::VehicleCommand;
use crate::session::ftp::{FtpClient, FtpEvent, FtpTicket};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleId};
use crate::wire::Frame;

/// The order in progress, and its transfer.
#[derive(Debug, Clone)]
pub(super) struct Job {
    /// The order whose row shows the progress; `None` for a list that the mission puts on board.
    order: Option<VehicleCommand>,
    command: PlanCommand,
    transaction: Box<Transaction>,
    warnings: Vec<Text>,
    /// The progress last reported, and whether the link was lost then.
    told: Option<(u8, bool)>,
}

/// The end of a transfer: of an order, or of a list that the mission puts on board.
pub(super) struct FinishedJob {
    pub is_done: bool,
    /// Whether the list that the vehicle holds is known.
    pub is_known: bool,
    /// Whether the list was one that the mission puts on board.
    pub is_of_stock: bool,
}

struct TransferResult {
    /// The list that the vehicle holds, if known.
    held: Option<Vec<Item>>,
    ending: RowEnding,
}

impl TransferResult {
    fn holding(items: Vec<Item>, state: RowState, text: Text) -> Self {
        Self {
            held: Some(items),
            ending: RowEnding::new(state, text),
        }
    }

    fn unknown(state: RowState, text: Text) -> Self {
        Self {
            held: None,
            ending: RowEnding::new(state, text),
        }
    }
}

impl Job {
    /// Advances the transfer; returns the end of the order.
    pub fn poll(
        &mut self,
        shelf: Option<&dyn PlanShelf>,
        desk: &mut Desk<'_>,
    ) -> Option<FinishedJob> {
        let Some(outcome) = self.transaction.poll(shelf, desk) else {
            self.tell_progress(desk);
            return None;
        };
        let is_known = !matches!(outcome, Outcome::Neither(_) | Outcome::Unknown);
        self.put_away(&outcome, shelf, desk.vehicle.id);
        let RowEnding { state, text } = self.finish(outcome, shelf, desk);
        self.report(state, Some(text), desk);
        Some(FinishedJob {
            is_done: state == RowState::Done,
            is_known,
            is_of_stock: self.order.is_none(),
        })
    }

    pub fn begin_anew(&mut self, ftp: &mut FtpClient, now: Duration) {
        self.transaction.begin_anew(ftp, now);
    }

    pub fn receive(&mut self, frame: &Frame, desk: &mut Desk<'_>) {
        self.transaction.receive(frame, desk);
    }

    pub fn hear_file(&mut self, ticket: FtpTicket, event: &FtpEvent, now: Duration) {
        self.transaction.hear_file(ticket, event, now);
    }

    /// Begins a transfer; a reading in progress makes way for it.
    pub fn begin(
        order: Option<VehicleCommand>,
        command: PlanCommand,
        goal: PlanOrderGoal,
        desk: &mut Desk<'_>,
    ) -> Self {
        let mut messages = Vec::new();
        desk.plans.make_way(desk.now, &mut messages);
        desk.output.send(messages);
        let transaction = Transaction::new(command.kind, goal.items, desk);
        Self {
            order,
            command,
            transaction: Box::new(transaction),
            warnings: goal.warnings,
            told: None,
        }
    }

    pub fn report(&self, state: RowState, explanation: Option<Text>, desk: &mut Desk<'_>) {
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
        let writes = self.command.deed.writes();
        let is_over = match outcome {
            Outcome::Written(_) | Outcome::Same(_) => writes,
            // The list before this transfer may itself be incomplete.
            Outcome::Kept(..) | Outcome::Restored(..) => self.transaction.is_stored(),
            Outcome::Read(_)
            | Outcome::Changed(_)
            | Outcome::Unfamiliar(_)
            | Outcome::Unsupported
            | Outcome::Unread
            | Outcome::Neither(_)
            | Outcome::Unknown => false,
        };
        if let Some(shelf) = shelf.filter(|_| is_over) {
            shelf.release(vehicle, self.command.kind);
        }
    }

    /// Notes the list that the vehicle holds; returns the end of the order.
    fn finish(
        &self,
        outcome: Outcome,
        shelf: Option<&dyn PlanShelf>,
        desk: &mut Desk<'_>,
    ) -> RowEnding {
        let kind = self.command.kind;
        let is_unknown = outcome == Outcome::Unknown;
        let TransferResult { held, ending } = self.result(outcome, shelf, desk.vehicle);
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

    fn result(
        &self,
        outcome: Outcome,
        shelf: Option<&dyn PlanShelf>,
        vehicle: &Vehicle,
    ) -> TransferResult {
        let kind = self.command.kind;
        let done = |message, items: Vec<Item>| {
            let text = self.warned(counted(message, kind, &items));
            TransferResult::holding(items, RowState::Done, text)
        };
        let refused = |items, text| TransferResult::holding(items, RowState::Refused, text);
        let differs = |message, items: Vec<Item>| {
            let text = counted(message, kind, &items);
            refused(items, text)
        };
        let unknown = TransferResult::unknown;
        match outcome {
            Outcome::Read(items) => {
                let ending = self.was_read(&items, shelf, vehicle);
                let held = Some(items);
                TransferResult { held, ending }
            }
            Outcome::Written(items) => done("outcome-plan-written", items),
            Outcome::Same(items) => done("outcome-plan-same", items),
            Outcome::Changed(items) => differs("refused-plan-changed", items),
            Outcome::Unfamiliar(items) => differs("refused-plan-unfamiliar", items),
            Outcome::Kept(items, reason) => {
                let text = text!("outcome-plan-kept", reason = reason);
                refused(items, text)
            }
            Outcome::Restored(items, reason) => {
                let text = text!("outcome-plan-restored", reason = reason);
                refused(items, text)
            }
            Outcome::Unsupported => unknown(RowState::Refused, text!("refused-plan-no-list")),
            Outcome::Unread => unknown(RowState::TimedOut, text!("outcome-plan-unread")),
            Outcome::Neither(items) => {
                let text = counted("outcome-plan-neither", kind, &items);
                TransferResult::holding(items, RowState::NoEffect, text)
            }
            Outcome::Unknown => {
                let text = text!("outcome-plan-unknown", list = kind.name());
                unknown(RowState::TimedOut, text)
            }
        }
    }

    fn warned(&self, outcome: Text) -> Text {
        let Some(warned) = judging::warned(&self.warnings) else {
            return outcome;
        };
        Text::joined("; ", vec![outcome, warned])
    }

    fn was_read(
        &self,
        items: &[Item],
        shelf: Option<&dyn PlanShelf>,
        vehicle: &Vehicle,
    ) -> RowEnding {
        let kind = self.command.kind;
        let (PlanDeed::Download { file }, Some(shelf)) = (&self.command.deed, shelf) else {
            let text = counted("outcome-plan-read", kind, items);
            return RowEnding::new(RowState::Done, text);
        };
        match shelf.write(&named(file, vehicle), kind, &document_of(kind, items)) {
            Ok(path) => {
                let count = compare::own(kind, items).len();
                let text = text!("outcome-plan-saved", count = count, file = path);
                RowEnding::new(RowState::Done, text)
            }
            Err(reason) => RowEnding::new(RowState::Refused, reason),
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
