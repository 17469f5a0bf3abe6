//! The `DataFlash` logs of a vehicle: their list, and copying them into files.
//!
//! These orders are separate from the line of commands, one at a time: a download takes minutes, and must not hold up a
//! command. `ArduPilot` sends no logs while it is armed.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{LOG_REQUEST_END_DATA, MavMessage};

use super::ftp::{FtpClient, FtpEvent, FtpTicket};
use super::{Output, VehicleCommand};
use crate::commands::{Command, LogChoice, LogCommand, LogGroup};
use crate::ledger::{RowEnding, RowState, RowUpdate};
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;
use crate::wire::{Content, Frame, Outgoing};

mod files;
mod keeper;
mod listing;
mod reading;
mod transfer;
mod words;

pub(super) use files::hands_out_files;
use files::{FileSearch, LogFiles};
pub use keeper::{KeptLog, ListedLog, LogKeeper, VehicleLog};
use listing::Listing;
use reading::Reading;
use words::{WholeLog, kept, list};

const MOST_WAITING: usize = 8;

/// The orders about the logs of one vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct LogReader {
    keeper: Option<Arc<dyn LogKeeper>>,
    waiting: VecDeque<VehicleCommand>,
    job: Option<LogsJob>,
    /// The order that ends all other orders.
    stop: Option<VehicleCommand>,
}

#[derive(Debug, Clone)]
struct LogsJob {
    order: VehicleCommand,
    command: LogCommand,
    phase: LogsPhase,
    /// The progress last reported, in percent.
    percent: Option<u8>,
    whole: Vec<WholeLog>,
}

#[derive(Debug, Clone)]
enum LogsPhase {
    Listing(Listing),
    /// The list has been read; if the vehicle offers files, the files of its logs are searched for.
    Searching(Box<FileSearch>),
    Reading(Box<Reading>),
}

struct LogsDesk<'a> {
    keeper: &'a dyn LogKeeper,
    vehicle: &'a Vehicle,
    ftp: &'a mut FtpClient,
    now: Duration,
    output: &'a mut Output,
}

impl LogReader {
    /// Sets where logs are stored from now on.
    pub fn keep_in(&mut self, keeper: Arc<dyn LogKeeper>) {
        self.keeper = Some(keeper);
    }

    /// Whether an answer is awaited.
    pub fn is_busy(&self) -> bool {
        self.job.is_some()
    }

    pub fn order(
        &mut self,
        order: VehicleCommand,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        if order.command == Command::Log(LogCommand::Stop) {
            self.stop = Some(order);
            return;
        }
        let is_download = matches!(order.command, Command::Log(LogCommand::Download { .. }));
        let refusal = if vehicle.armed() {
            Some(text!("refused-logs-armed"))
        } else if is_download && self.keeper.is_none() {
            Some(text!("refused-logs-nowhere"))
        } else if self.waiting.len() >= MOST_WAITING {
            Some(text!("outcome-queue-full", count = MOST_WAITING))
        } else {
            None
        };
        match refusal {
            Some(reason) => {
                output.row(order.unsent(vehicle.id, RowState::Refused, reason, now));
            }
            None => self.waiting.push_back(order),
        }
    }

    /// Ends all orders, because the vehicle has rebooted. The parts of a log that were read are kept.
    pub fn clear(&mut self, newer: &Text, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        let reason = text!("outcome-superseded", by = newer);
        for order in self.waiting.drain(..) {
            output.row(order.unsent(vehicle.id, RowState::Superseded, reason.clone(), now));
        }
        if let Some(mut job) = self.job.take() {
            if let (LogsPhase::Reading(reading), Some(keeper)) = (&mut job.phase, &self.keeper) {
                // If this cannot be written, nothing more can be done.
                drop(reading.write(keeper.as_ref(), now));
            }
            job.report(RowState::Superseded, Some(reason), vehicle, now, output);
        }
    }

    /// Carries out the order that ends all other orders.
    fn stop(
        &mut self,
        stop: &VehicleCommand,
        vehicle: &Vehicle,
        ftp: &mut FtpClient,
        now: Duration,
        output: &mut Output,
    ) {
        if self.job.is_none() && self.waiting.is_empty() {
            let reason = text!("refused-logs-none-read");
            output.row(stop.unsent(vehicle.id, RowState::Refused, reason, now));
            return;
        }
        match self.job.as_ref().map(|job| &job.phase) {
            Some(LogsPhase::Reading(reading)) => reading.leave(ftp),
            Some(LogsPhase::Searching(search)) => ftp.cancel(search.ticket()),
            Some(LogsPhase::Listing(_)) | None => {}
        }
        self.clear(&Text::verbatim("logs stop"), vehicle, now, output);
        output.messages.push(request_end(vehicle));
        let told = text!("outcome-logs-stopped");
        output.row(stop.unsent(vehicle.id, RowState::Done, told, now));
    }

    /// Handles the vehicle's messages about its logs.
    pub fn receive(&mut self, frame: &Frame, now: Duration) {
        let (Some(job), Content::Message(message)) = (&mut self.job, &frame.content) else {
            return;
        };
        match (&mut job.phase, message) {
            (LogsPhase::Listing(listing), MavMessage::LOG_ENTRY(entry)) => {
                listing.receive(entry, now);
            }
            (LogsPhase::Reading(reading), MavMessage::LOG_DATA(data)) => {
                let received = reading.transfer().receive(data, now);
                reading.note(received);
            }
            _ => {}
        }
    }

    /// Handles an event of the file client.
    pub fn hear_file(
        &mut self,
        ticket: FtpTicket,
        event: FtpEvent,
        ftp: &mut FtpClient,
        now: Duration,
    ) {
        match self.job.as_mut().map(|job| &mut job.phase) {
            Some(LogsPhase::Searching(search)) if search.ticket() == ticket => {
                search.receive(event, ftp);
            }
            Some(LogsPhase::Reading(reading)) => reading.hear(ticket, event, ftp, now),
            Some(LogsPhase::Searching(_) | LogsPhase::Listing(_)) | None => {}
        }
    }

    /// Advances time: sends requests, writes files, ends orders.
    pub fn poll(
        &mut self,
        vehicle: &Vehicle,
        ftp: &mut FtpClient,
        now: Duration,
        output: &mut Output,
    ) {
        if let Some(stop) = self.stop.take() {
            self.stop(&stop, vehicle, ftp, now, output);
        }
        if self.job.is_none() {
            self.job = self.waiting.pop_front().and_then(LogsJob::new);
            if let Some(job) = &self.job {
                job.report(RowState::Sent, None, vehicle, now, output);
            }
        }
        let Some(job) = &mut self.job else {
            return;
        };
        let advanced = match self.keeper.as_deref() {
            None => job.list(vehicle, now, output),
            Some(keeper) => job.advance(&mut LogsDesk {
                keeper,
                vehicle,
                ftp,
                now,
                output,
            }),
        };
        match advanced {
            Ok(()) => job.tell_progress(vehicle, now, output),
            Err(RowEnding { state, text }) => {
                job.report(state, Some(text), vehicle, now, output);
                output.messages.push(request_end(vehicle));
                self.job = None;
            }
        }
    }
}

impl LogsJob {
    fn new(order: VehicleCommand) -> Option<Self> {
        let Command::Log(command) = order.command.clone() else {
            return None;
        };
        Some(Self {
            order,
            command,
            phase: LogsPhase::Listing(Listing::new()),
            percent: None,
            whole: Vec::new(),
        })
    }

    fn report(
        &self,
        state: RowState,
        explanation: Option<Text>,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        output.row(RowUpdate {
            entry: self.order.entry,
            vehicle: vehicle.id,
            state,
            tries: 1,
            at: now,
            explanation,
        });
    }

    fn tell_progress(&mut self, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        let LogsPhase::Reading(reading) = &self.phase else {
            return;
        };
        let percent = reading.percent(&self.whole);
        if self.percent.is_none_or(|before| before != percent) {
            self.percent = Some(percent);
            self.report(RowState::InProgress(percent), None, vehicle, now, output);
        }
    }

    /// Takes the steps that are due. The end of the order is returned as an error.
    fn advance(&mut self, desk: &mut LogsDesk<'_>) -> Result<(), RowEnding> {
        match &mut self.phase {
            LogsPhase::Listing(listing) => match listing.complete() {
                Some(logs) => self.listed(logs, desk),
                None => self.list(desk.vehicle, desk.now, desk.output),
            },
            LogsPhase::Searching(search) => {
                if desk.vehicle.armed() {
                    desk.ftp.cancel(search.ticket());
                    return Err(RowEnding::new(
                        RowState::Refused,
                        text!("refused-logs-armed"),
                    ));
                }
                match search.finished() {
                    Some((logs, files)) => self.choose(logs, files, desk),
                    None => Ok(()),
                }
            }
            LogsPhase::Reading(reading) => {
                let Some(whole) = reading.advance(desk)? else {
                    return Ok(());
                };
                self.whole.push(whole);
                if reading.turn_to_next(desk).map_err(failed)? {
                    return Ok(());
                }
                Err(RowEnding::new(RowState::Done, kept(&self.whole)))
            }
        }
    }

    /// Requests the list of logs until it is complete.
    fn list(
        &mut self,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) -> Result<(), RowEnding> {
        let LogsPhase::Listing(listing) = &mut self.phase else {
            return Ok(());
        };
        if let (Some(logs), LogCommand::List) = (listing.complete(), &self.command) {
            return Err(RowEnding::new(RowState::Done, list(&logs)));
        }
        if vehicle.armed() {
            return Err(RowEnding::new(
                RowState::Refused,
                text!("refused-logs-armed"),
            ));
        }
        if listing.is_stalled() {
            return Err(RowEnding::new(
                RowState::TimedOut,
                text!("outcome-logs-silent"),
            ));
        }
        let request = listing.poll(vehicle.address(), now);
        output.messages.extend(request);
        Ok(())
    }

    fn listed(&mut self, logs: Vec<ListedLog>, desk: &mut LogsDesk<'_>) -> Result<(), RowEnding> {
        if self.command == LogCommand::List {
            return Err(RowEnding::new(RowState::Done, list(&logs)));
        }
        if logs.is_empty() || !hands_out_files(desk.vehicle) {
            return self.choose(logs, LogFiles::default(), desk);
        }
        self.phase = LogsPhase::Searching(Box::new(FileSearch::new(logs, desk.ftp)));
        Ok(())
    }

    /// Begins to read the requested logs.
    fn choose(
        &mut self,
        logs: Vec<ListedLog>,
        files: LogFiles,
        desk: &mut LogsDesk<'_>,
    ) -> Result<(), RowEnding> {
        let LogCommand::Download { which, folder } = &self.command else {
            return Err(RowEnding::new(RowState::Done, list(&logs)));
        };
        let count = logs.len();
        let mut chosen: VecDeque<ListedLog> = match which {
            LogChoice::Group(LogGroup::All) => logs.into_iter().filter(|it| it.size > 0).collect(),
            LogChoice::Group(LogGroup::Last) => logs.into_iter().next_back().into_iter().collect(),
            LogChoice::Number(number) => {
                logs.into_iter().filter(|it| it.number == *number).collect()
            }
        };
        let Some(log) = chosen.pop_front() else {
            let reason = match which {
                LogChoice::Number(number) if count > 0 => {
                    text!("refused-no-log", number = *number, count = count)
                }
                LogChoice::Number(_) | LogChoice::Group(_) => text!("outcome-logs-none"),
            };
            return Err(RowEnding::new(RowState::Refused, reason));
        };
        let first = VehicleLog {
            vehicle: desk.vehicle.id,
            log,
            folder: folder.clone(),
        };
        let reading = Reading::begin(first, chosen, files, desk).map_err(failed)?;
        self.phase = LogsPhase::Reading(Box::new(reading));
        Ok(())
    }
}

fn failed(reason: Text) -> RowEnding {
    RowEnding::new(RowState::Refused, reason)
}

/// A request to end a transfer, so that the vehicle may write its log again.
fn request_end(vehicle: &Vehicle) -> Outgoing {
    MavMessage::LOG_REQUEST_END(LOG_REQUEST_END_DATA {
        target_system: vehicle.system,
        target_component: vehicle.component,
    })
    .into()
}
