//! The `DataFlash` logs of a vehicle: their list, and copying them into files.
//!
//! They have orders of their own, one at a time, beside the line of commands: a download takes minutes, and must not hold
//! up a command. `ArduPilot` sends no logs while it is armed.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{LOG_REQUEST_END_DATA, MavMessage};

use super::{Output, VehicleCommand};
use crate::commands::{Command, LogChoice, LogCommand};
use crate::ledger::{RowState, RowUpdate};
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;
use crate::wire::{Content, Frame, Outgoing};

mod gaps;
mod keeper;
mod listing;
mod transfer;
mod words;

pub use gaps::GapMap;
pub use keeper::{KeptLog, ListedLog, LogBytes, LogKeeper, VehicleLog};
use listing::Listing;
use transfer::{Received, Transfer};
use words::{kept, list};

/// Bytes that are collected before they are written.
const BLOCK: usize = 64 * 1024;
/// What has come is written at the latest after so long.
const WRITE_EVERY: Duration = Duration::from_secs(1);
/// Orders that may wait for one vehicle.
const MOST_WAITING: usize = 8;

/// The orders about the logs of one vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct LogReader {
    keeper: Option<Arc<dyn LogKeeper>>,
    waiting: VecDeque<VehicleCommand>,
    job: Option<Job>,
}

/// The order that is carried out.
#[derive(Debug, Clone)]
struct Job {
    order: VehicleCommand,
    command: LogCommand,
    phase: Phase,
    /// What was reported last.
    percent: Option<u8>,
    /// The files that are whole by now, with their sizes.
    files: Vec<(ListedLog, String)>,
}

#[derive(Debug, Clone)]
enum Phase {
    Listing(Listing),
    Reading(Box<Reading>),
}

/// A log that is read, and those after it.
#[derive(Debug, Clone)]
struct Reading {
    log: VehicleLog,
    later: VecDeque<ListedLog>,
    /// Bytes of all logs that are to be read.
    bytes: u64,
    transfer: Transfer,
    /// The file, if it was whole before.
    file: Option<String>,
    /// What has not been written yet.
    unwritten: Vec<LogBytes>,
    written_at: Duration,
}

/// How an order ends.
type Ending = (RowState, Text);

impl LogReader {
    /// Where logs are kept from now on.
    pub fn keep_in(&mut self, keeper: Arc<dyn LogKeeper>) {
        self.keeper = Some(keeper);
    }

    /// Whether something is awaited.
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

    /// Gives up everything: the vehicle has rebooted. What was read of a log stays.
    pub fn clear(&mut self, newer: &Text, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        let reason = text!("outcome-superseded", by = newer);
        for order in self.waiting.drain(..) {
            output.row(order.unsent(vehicle.id, RowState::Superseded, reason.clone(), now));
        }
        if let Some(mut job) = self.job.take() {
            if let (Phase::Reading(reading), Some(keeper)) = (&mut job.phase, &self.keeper) {
                // Nothing more can be done where it cannot be written.
                drop(reading.write(keeper.as_ref(), now));
            }
            job.report(RowState::Superseded, Some(reason), vehicle, now, output);
        }
    }

    /// Handles the vehicle's messages about its logs.
    pub fn receive(&mut self, frame: &Frame, now: Duration) {
        let (Some(job), Content::Message(message)) = (&mut self.job, &frame.content) else {
            return;
        };
        match (&mut job.phase, message) {
            (Phase::Listing(listing), MavMessage::LOG_ENTRY(entry)) => listing.receive(entry, now),
            (Phase::Reading(reading), MavMessage::LOG_DATA(data)) => {
                match reading.transfer.receive(data, now) {
                    Received::Nothing => {}
                    Received::Bytes(bytes) => reading.note(bytes),
                    Received::Other => {
                        reading.file = None;
                        reading.unwritten.clear();
                    }
                }
            }
            _ => {}
        }
    }

    /// Lets time pass: requests, files, the end.
    pub fn poll(&mut self, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        if self.job.is_none() {
            self.job = self.waiting.pop_front().and_then(Job::new);
            if let Some(job) = &self.job {
                job.report(RowState::Sent, None, vehicle, now, output);
            }
        }
        let Some(job) = &mut self.job else {
            return;
        };
        match job.advance(self.keeper.as_deref(), vehicle, now, output) {
            Ok(()) => job.tell_progress(vehicle, now, output),
            Err((state, text)) => {
                job.report(state, Some(text), vehicle, now, output);
                output.messages.push(request_end(vehicle));
                self.job = None;
            }
        }
    }
}

impl Job {
    fn new(order: VehicleCommand) -> Option<Self> {
        let Command::Log(command) = order.command.clone() else {
            return None;
        };
        Some(Self {
            order,
            command,
            phase: Phase::Listing(Listing::new()),
            percent: None,
            files: Vec::new(),
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
        let Phase::Reading(reading) = &self.phase else {
            return;
        };
        let whole: u64 = self.files.iter().map(|(log, _)| u64::from(log.size)).sum();
        let gaps = reading.transfer.gaps();
        let there = whole + u64::from(gaps.size() - gaps.missing_bytes());
        let percent = (there * 100 / reading.bytes.max(1)).min(99) as u8;
        if self.percent.is_none_or(|before| before != percent) {
            self.percent = Some(percent);
            self.report(RowState::InProgress(percent), None, vehicle, now, output);
        }
    }

    /// Does what is due; the end as an error.
    fn advance(
        &mut self,
        keeper: Option<&dyn LogKeeper>,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) -> Result<(), Ending> {
        match &mut self.phase {
            Phase::Listing(listing) => {
                if let Some(logs) = listing.complete() {
                    return self.listed(logs, keeper, vehicle, now);
                }
                if vehicle.armed() {
                    return Err((RowState::Refused, text!("refused-logs-armed")));
                }
                if listing.is_stalled() {
                    return Err((RowState::TimedOut, text!("outcome-logs-silent")));
                }
                let request = listing.poll(vehicle.address(), now);
                output.messages.extend(request);
                Ok(())
            }
            Phase::Reading(reading) => {
                let Some(keeper) = keeper else {
                    return Err((RowState::Refused, text!("refused-logs-nowhere")));
                };
                let Some(file) = reading.advance(keeper, vehicle, now, output)? else {
                    return Ok(());
                };
                self.files.push((reading.log.log, file));
                match reading.later.pop_front() {
                    Some(next) => reading.turn_to(next, keeper, now).map_err(failed),
                    None => Err((RowState::Done, kept(&self.files))),
                }
            }
        }
    }

    /// The list is there.
    fn listed(
        &mut self,
        logs: Vec<ListedLog>,
        keeper: Option<&dyn LogKeeper>,
        vehicle: &Vehicle,
        now: Duration,
    ) -> Result<(), Ending> {
        let LogCommand::Download { which, folder } = &self.command else {
            return Err((RowState::Done, list(&logs)));
        };
        let count = logs.len();
        let mut chosen: VecDeque<ListedLog> = match which {
            LogChoice::All => logs.into(),
            LogChoice::Last => logs.into_iter().next_back().into_iter().collect(),
            LogChoice::Number(number) => {
                logs.into_iter().filter(|it| it.number == *number).collect()
            }
        };
        let bytes = chosen.iter().map(|it| u64::from(it.size)).sum();
        let Some(log) = chosen.pop_front() else {
            let reason = match which {
                LogChoice::Number(number) if count > 0 => {
                    text!("refused-no-log", number = *number, count = count)
                }
                LogChoice::Number(_) | LogChoice::Last | LogChoice::All => {
                    text!("outcome-logs-none")
                }
            };
            return Err((RowState::Refused, reason));
        };
        let Some(keeper) = keeper else {
            return Err((RowState::Refused, text!("refused-logs-nowhere")));
        };
        let log = VehicleLog {
            vehicle: vehicle.id,
            log,
            folder: folder.clone(),
        };
        let reading = Reading::begin(log, chosen, keeper, now).map_err(failed)?;
        self.phase = Phase::Reading(Box::new(Reading { bytes, ..reading }));
        Ok(())
    }
}

impl Reading {
    fn begin(
        log: VehicleLog,
        later: VecDeque<ListedLog>,
        keeper: &dyn LogKeeper,
        now: Duration,
    ) -> Result<Self, Text> {
        let known = keeper.find(&log)?;
        Ok(Self {
            transfer: Transfer::new(log.log.number, known.gaps, known.sample, now),
            file: known.file,
            log,
            later,
            bytes: 0,
            unwritten: Vec::new(),
            written_at: now,
        })
    }

    /// Goes on with the next log.
    fn turn_to(
        &mut self,
        next: ListedLog,
        keeper: &dyn LogKeeper,
        now: Duration,
    ) -> Result<(), Text> {
        let log = VehicleLog {
            log: next,
            ..self.log.clone()
        };
        let begun = Self::begin(log, std::mem::take(&mut self.later), keeper, now)?;
        *self = Self {
            bytes: self.bytes,
            ..begun
        };
        Ok(())
    }

    /// Collects bytes to be written.
    fn note(&mut self, new: LogBytes) {
        match self.unwritten.last_mut() {
            Some(last) if last.range().end == new.at => last.bytes.extend(new.bytes),
            Some(_) | None => self.unwritten.push(new),
        }
    }

    /// Writes what was collected. A file that is whole already needs nothing.
    fn write(&mut self, keeper: &dyn LogKeeper, now: Duration) -> Result<(), Text> {
        self.written_at = now;
        let bytes = std::mem::take(&mut self.unwritten);
        if self.file.is_some() || bytes.is_empty() {
            return Ok(());
        }
        keeper.keep(&self.log, &bytes, self.transfer.gaps())
    }

    /// Does what is due; returns the file once it is whole.
    fn advance(
        &mut self,
        keeper: &dyn LogKeeper,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) -> Result<Option<String>, Ending> {
        let collected: usize = self.unwritten.iter().map(|it| it.bytes.len()).sum();
        let is_whole = self.transfer.gaps().is_complete();
        let ends = vehicle.armed() || self.transfer.is_stalled(now);
        if collected >= BLOCK || is_whole || ends || now >= self.written_at + WRITE_EVERY {
            self.write(keeper, now).map_err(failed)?;
        }
        if is_whole {
            let known = self.file.take();
            let file = known.map_or_else(|| keeper.finish(&self.log), Ok);
            return file.map(Some).map_err(failed);
        }
        let kept = self.transfer.gaps().percent();
        if vehicle.armed() {
            let text = text!("outcome-logs-armed", percent = kept);
            return Err((RowState::Refused, text));
        }
        if self.transfer.is_stalled(now) {
            let text = text!("outcome-log-stalled", percent = kept);
            return Err((RowState::TimedOut, text));
        }
        let round_trip = vehicle.link.round_trip.unwrap_or_default();
        let requests = self.transfer.poll(vehicle.address(), round_trip, now);
        output.messages.extend(requests);
        Ok(None)
    }
}

/// Nothing can be kept.
fn failed(reason: Text) -> Ending {
    (RowState::Refused, reason)
}

/// Ends a transfer, so that the vehicle may write its log again.
fn request_end(vehicle: &Vehicle) -> Outgoing {
    MavMessage::LOG_REQUEST_END(LOG_REQUEST_END_DATA {
        target_system: vehicle.system,
        target_component: vehicle.component,
    })
    .into()
}
