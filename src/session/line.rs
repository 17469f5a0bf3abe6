//! The line to a vehicle: the waiting orders, the order that awaits its answer, and the orders that
//! await their effect.
//!
//! Only one order at a time awaits its answer, because an acknowledgement names only the command.

use std::collections::VecDeque;
use std::time::Duration;

use super::acknowledgement::{Acknowledgement, OwedAcks};
use super::naming::{self, Search, Searching};
use super::transaction::{Progress, Transaction};
use super::{Output, Steering, VehicleCommand, fit, parameter_code, precedence};
use crate::commands::{self, Claim, Command, MotionCommand};
use crate::ledger::{EntryId, RowEnding, RowState, RowUpdate};
use crate::notice::Notice;
use crate::parameters::ParameterList;
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;
use crate::wire::Frame;

/// The maximum number of orders that wait for one vehicle; more are refused.
const MOST_WAITING: usize = 32;

/// How many of a manoeuvre's setpoints repeat the vehicle's speeds, since the first may be lost.
const SPEEDS_SAID: u8 = 3;

/// The orders of one vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct Line {
    /// The orders that wait for their turn, with the time they were given.
    queue: VecDeque<(VehicleCommand, Duration)>,
    search: Search,
    /// The order that awaits its answer.
    active: Option<Transaction>,
    /// The orders that were accepted and await their effect.
    watched: Vec<Transaction>,
    /// The last order carried out, while its effect lasts.
    holding: Option<Holding>,
    /// The number of consecutive manoeuvre setpoints that end at rest at a place.
    places_in_a_row: u8,
    owed: OwedAcks,
}

/// An order that was carried out, and the claim that holds while its effect lasts.
#[derive(Debug, Clone)]
struct Holding {
    entry: EntryId,
    claim: Claim,
}

/// The inputs and the output of the line at one time.
pub(super) struct Moment<'a> {
    pub vehicle: &'a mut Vehicle,
    pub parameters: &'a ParameterList,
    pub now: Duration,
    pub output: &'a mut Output,
}

impl Moment<'_> {
    /// Ends an order that was never sent.
    fn drop_order(&mut self, order: &VehicleCommand, ending: RowEnding) {
        let row = order.unsent(self.vehicle.id, ending.state, ending.text, self.now);
        self.output.row(row);
    }
}

impl Line {
    /// Queues an order. An urgent order (kill, disarm, land, return, hold) cancels the orders that
    /// wait or have not been answered.
    pub fn order(&mut self, mut order: VehicleCommand, mut moment: Moment) {
        if precedence::is_urgent(&order, moment.vehicle) {
            self.clear(&order.verb.name.into(), &mut moment);
        }
        naming::settle(&mut order, moment.parameters);
        let checked = if self.queue.len() >= MOST_WAITING {
            Err(text!("outcome-queue-full", count = MOST_WAITING))
        } else {
            fit::check(&order, moment.parameters, moment.vehicle)
        };
        if let Err(reason) = checked {
            moment.drop_order(&order, RowEnding::new(RowState::Refused, reason));
        } else {
            self.queue.push_back((order, moment.now));
            self.advance(moment);
        }
    }

    /// Stores status texts, which may explain a refusal.
    pub fn hear_texts(&mut self, notices: &[Notice]) {
        if let Some(active) = &mut self.active {
            for notice in notices {
                active.hear_text(notice);
            }
        }
    }

    /// Looks for the awaited answer in a frame of the vehicle's autopilot.
    pub fn receive(
        &mut self,
        frame: &Frame,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        let ack = Acknowledgement::from_frame(frame, vehicle.station);
        if ack.is_some_and(|ack| self.owed.take(ack.command, now)) {
            return;
        }
        if let Some(active) = &mut self.active {
            active.receive(frame, vehicle, now, output);
        }
    }

    /// Notes that an acknowledgement may arrive for which no order waits.
    pub fn expect_ack(&mut self, command: u16, now: Duration) {
        self.owed.add(command, 1, now);
    }

    /// Cancels all waiting and unanswered orders because of a newer one. A movement continues until
    /// the newer order is accepted.
    pub fn clear(&mut self, newer: &Text, moment: &mut Moment) {
        let reason = text!("outcome-superseded", by = newer);
        for (order, _) in self.queue.drain(..) {
            moment.drop_order(&order, RowEnding::new(RowState::Superseded, reason.clone()));
        }
        if let Some((command, acks)) = self.active.as_ref().and_then(Transaction::owed_acks) {
            self.owed.add(command, acks, moment.now);
        }
        if let Some(active) = self.active.take() {
            active.supersede(&reason, moment.now, moment.output);
        }
    }

    /// Supersedes earlier movements: a vehicle flies to one place at a time.
    pub fn supersede_movements(&mut self, newer: &Text, now: Duration, output: &mut Output) {
        let reason = text!("outcome-superseded", by = newer);
        self.watched.retain(|transaction| {
            let superseded = transaction.gives_way_to_movement();
            if superseded {
                transaction.supersede(&reason, now, output);
            }
            !superseded
        });
    }

    /// Sends a vehicle's setpoint in a joint manoeuvre.
    pub fn steer(&mut self, steering: &Steering, moment: Moment) -> Result<(), Text> {
        let Moment {
            vehicle,
            now,
            output,
            ..
        } = moment;
        let message = steering.setpoint.message(vehicle)?;
        self.supersede_movements(&steering.verb.name.into(), now, output);
        self.holding = None;
        output.messages.push(message);
        let is_place = steering.setpoint.velocity_m_s.is_none();
        self.places_in_a_row = if is_place {
            self.places_in_a_row.saturating_add(1)
        } else {
            0
        };
        // The first messages may be lost.
        if is_place && self.places_in_a_row <= SPEEDS_SAID {
            output.say_speeds(commands::asked_again(vehicle)?);
        }
        self.note_unawaited(now, output);
        Ok(())
    }

    /// Advances all orders as far as possible.
    pub fn advance(&mut self, mut moment: Moment) {
        let now = moment.now;
        loop {
            if self.active.is_none() {
                let Some((mut order, given)) = self.next(&mut moment) else {
                    break;
                };
                order.stored_as =
                    parameter_code::kind(&order.command, moment.parameters, moment.vehicle);
                if order.command.sets_plan_item() {
                    moment.vehicle.plan.asked = Some(now);
                }
                self.active = Transaction::start(order, given, moment.vehicle, now, moment.output);
            }
            let Some(active) = &mut self.active else {
                continue;
            };
            // The transaction is polled in place, not moved: it is large, and waits in most steps.
            let progress = active.poll(moment.vehicle, now, moment.output);
            if progress == Progress::Waiting {
                break;
            }
            if let Some(active) = self.active.take() {
                self.settle(active, progress, &mut moment);
            }
        }
        self.watch(&mut moment);
        self.note_unawaited(now, moment.output);
    }

    /// Handles an order that was accepted or has ended.
    fn settle(&mut self, order: Transaction, progress: Progress, moment: &mut Moment) {
        if order.is_accepted() {
            if let &Command::Motion(MotionCommand::Speed { axis, speed_m_s }) = &order.order.command
            {
                moment.vehicle.asked_speeds.ask(axis, speed_m_s);
            }
            if let Some(change) = order.order.command.changes_pause() {
                moment.vehicle.note_pause(change);
            }
            if !order.claim().is_empty() {
                self.holding = None;
                self.places_in_a_row = 0;
            }
        }
        if order.moves_the_vehicle() {
            self.supersede_movements(&order.verb().name.into(), moment.now, moment.output);
            // The old target is void; the next message contains the new one.
            moment.vehicle.target = None;
        }
        if progress == Progress::Ended
            && let Some((command, acks)) = order.owed_acks()
        {
            self.owed.add(command, acks, moment.now);
        }
        match progress {
            Progress::Watching => self.watched.push(order),
            Progress::Ended => self.hold(&order),
            Progress::Waiting => {}
        }
    }

    /// Checks for awaited effects, and whether another source has taken control.
    fn watch(&mut self, moment: &mut Moment) {
        let (vehicle, now) = (&*moment.vehicle, moment.now);
        // A change that our own order is about to cause does not come from another source.
        let is_ours = self
            .active
            .as_ref()
            .is_some_and(|active| !active.claim().is_empty());
        let mut watched = std::mem::take(&mut self.watched);
        watched.retain_mut(|order| {
            if !is_ours {
                order.yield_to_others(vehicle, now, moment.output);
            }
            match order.poll(vehicle, now, moment.output) {
                Progress::Ended => {
                    self.hold(order);
                    false
                }
                Progress::Waiting | Progress::Watching => true,
            }
        });
        self.watched = watched;
        if !is_ours && let Some(update) = self.ended(vehicle, now) {
            moment.output.row(update);
            self.holding = None;
        }
    }

    /// Keeps the claim of an order that was carried out, if it has one.
    fn hold(&mut self, order: &Transaction) {
        if order.is_done() && !order.claim().is_empty() {
            self.holding = Some(Holding {
                entry: order.order.entry,
                claim: order.claim(),
            });
        }
    }

    /// The row update if another source has ended the last order's effect.
    fn ended(&self, vehicle: &Vehicle, now: Duration) -> Option<RowUpdate> {
        let holding = self.holding.as_ref()?;
        let by = holding.claim.contradicted(vehicle)?;
        Some(RowUpdate {
            entry: holding.entry,
            vehicle: vehicle.id,
            state: RowState::Overtaken,
            tries: 0,
            at: now,
            explanation: Some(by),
        })
    }

    /// Notes the expected acknowledgements for which no order waits: of repeated speeds, and of the end of OFFBOARD.
    fn note_unawaited(&mut self, now: Duration, output: &mut Output) {
        let count = std::mem::take(&mut output.speed_acks);
        self.owed.add(commands::CHANGE_SPEED, count, now);
        for command in output.unawaited.drain(..) {
            self.owed.add(command, 1, now);
        }
    }

    /// Whether no answer is awaited.
    pub fn is_free(&self) -> bool {
        self.active.is_none()
    }

    /// Whether a command awaits its answer, waits in the queue, or must be repeated.
    pub fn is_busy(&self) -> bool {
        // Effects show in arriving messages, and their deadline is seconds away.
        let is_kept_up = |watched: &Transaction| watched.order.command.repeat().is_some();
        self.active.is_some() || !self.queue.is_empty() || self.watched.iter().any(is_kept_up)
    }

    /// The next order, with the vehicle's own name for its parameter. `None` if there is no order, or while that name
    /// is unknown.
    fn next(&mut self, moment: &mut Moment) -> Option<(VehicleCommand, Duration)> {
        loop {
            let (order, given) = self.queue.front_mut()?;
            let ending = if naming::settle(order, moment.parameters) {
                // A name that was found only now has not been checked.
                let is_new = order.renamed.is_some();
                match fit::check(order, moment.parameters, moment.vehicle) {
                    Err(reason) if is_new => RowEnding::new(RowState::Refused, reason),
                    _ => return self.queue.pop_front(),
                }
            } else {
                let deadline = *given + order.verb.retry.deadline;
                match self
                    .search
                    .poll(order, deadline, moment.vehicle, moment.now)
                {
                    Searching::Ask(messages) => {
                        moment.output.messages.extend(messages);
                        return None;
                    }
                    Searching::Wait => return None,
                    // Its transaction ends the order at once, with a report.
                    Searching::TooLate => return self.queue.pop_front(),
                    Searching::Over => {
                        naming::not_found(&order.command, moment.parameters, moment.vehicle)
                    }
                }
            };
            let (order, _) = self.queue.pop_front()?;
            moment.drop_order(&order, ending);
        }
    }
}
