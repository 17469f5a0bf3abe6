//! Reads one log after the other, and stores the bytes.

use std::collections::VecDeque;
use std::time::Duration;

use super::files::LogFiles;
use super::transfer::{Received, Transfer};
use super::words::{FileCheck, LogCarrier, LogWay, WholeLog};
use super::{ListedLog, LogKeeper, LogsDesk, VehicleLog, failed};
use crate::ledger::{RowEnding, RowState};
use crate::session::ftp::{FtpClient, FtpEvent, FtpFault, FtpTask, FtpTicket};
use crate::session::gaps::{FileBytes, GapMap};
use crate::text;
use crate::text::Text;

/// How many bytes are collected before they are written.
const BLOCK: usize = 64 * 1024;
/// Received bytes are written after this time at the latest.
const WRITE_EVERY: Duration = Duration::from_secs(1);

/// The reading of a log, and the logs that follow.
#[derive(Debug, Clone)]
pub(super) struct Reading {
    log: VehicleLog,
    later: VecDeque<ListedLog>,
    /// The size of all logs to read, in bytes.
    bytes: u64,
    files: LogFiles,
    transfer: Transfer,
    route: LogRoute,
    carrier: LogCarrier,
    /// Whether the log is being read for the second time because the checksum differed.
    is_again: bool,
    /// The file, if it was complete before.
    file: Option<String>,
    unwritten: Vec<FileBytes>,
    written_at: Duration,
}

/// How the bytes arrive, and the steps that follow.
#[derive(Debug, Clone)]
enum LogRoute {
    /// By log messages, which `ArduPilot` sends much faster than files.
    Messages,
    /// As a file, because log messages have stopped; with the task under way.
    File(String, FtpTicket),
    /// All bytes have arrived, and the vehicle is asked for the checksum of its file.
    Checking(String, FtpTicket),
    Summed(String, u32),
    /// The checksum differs: the file is opened once more to see whether it has grown.
    Measuring(FtpTicket),
    /// Nothing is left to request; the result of the check.
    Checked(FileCheck),
}

impl Reading {
    /// Begins to read a log; `later` are the logs that follow it.
    ///
    /// # Errors
    /// The log cannot be stored in its folder.
    pub fn begin(
        first: VehicleLog,
        later: VecDeque<ListedLog>,
        files: LogFiles,
        desk: &mut LogsDesk<'_>,
    ) -> Result<Self, Text> {
        let known = desk.keeper.find(&first)?;
        let log = &first.log;
        let transfer = Transfer::new(log.number, known.gaps, known.samples, desk.now);
        let bytes = later.iter().map(|it| u64::from(it.size)).sum::<u64>() + u64::from(log.size);
        Ok(Self {
            route: LogRoute::Messages,
            carrier: LogCarrier::Messages,
            is_again: false,
            transfer,
            file: known.file,
            log: first,
            later,
            bytes,
            files,
            unwritten: Vec::new(),
            written_at: desk.now,
        })
    }

    /// Continues with the next log; returns whether there is one.
    pub fn turn_to_next(&mut self, desk: &mut LogsDesk<'_>) -> Result<bool, Text> {
        let Some(next) = self.later.pop_front() else {
            return Ok(false);
        };
        let log = VehicleLog {
            log: next,
            ..self.log.clone()
        };
        let files = std::mem::take(&mut self.files);
        let begun = Self::begin(log, std::mem::take(&mut self.later), files, desk)?;
        *self = Self {
            bytes: self.bytes,
            ..begun
        };
        Ok(true)
    }

    /// The received share of all logs, including the finished ones, in percent, 0 to 99.
    pub fn percent(&self, finished: &[WholeLog]) -> u8 {
        let whole: u64 = finished.iter().map(|it| u64::from(it.log.size)).sum();
        let gaps = self.transfer.gaps();
        let there = whole + u64::from(gaps.size() - gaps.missing_bytes());
        (there * 100 / self.bytes.max(1)).min(99) as u8
    }

    pub fn transfer(&mut self) -> &mut Transfer {
        &mut self.transfer
    }

    /// Stores received bytes, or starts over if they show that the stored ones belong to another log.
    pub fn note(&mut self, received: Received) {
        match received {
            Received::Nothing => {}
            Received::Bytes(new) => match self.unwritten.last_mut() {
                Some(last) if last.range().end == new.at => last.bytes.extend(new.bytes),
                Some(_) | None => self.unwritten.push(new),
            },
            Received::Other => {
                self.file = None;
                self.unwritten.clear();
            }
        }
    }

    /// Handles an event of the file client.
    pub fn hear(&mut self, ticket: FtpTicket, event: FtpEvent, ftp: &mut FtpClient, now: Duration) {
        match &self.route {
            LogRoute::File(path, asked) if *asked == ticket => {
                let path = path.clone();
                self.hear_file(path, event, ftp, now);
            }
            LogRoute::Checking(path, asked) if *asked == ticket => {
                self.route = match event {
                    FtpEvent::Checksum(sum) => LogRoute::Summed(path.clone(), sum),
                    FtpEvent::Failed(fault) => LogRoute::Checked(self.unchecked(fault)),
                    FtpEvent::Listed(_)
                    | FtpEvent::Opened(_)
                    | FtpEvent::Done
                    | FtpEvent::Bytes(_)
                    | FtpEvent::Complete(_)
                    | FtpEvent::Wrote(_)
                    | FtpEvent::Written => return,
                };
            }
            LogRoute::Measuring(asked) if *asked == ticket => {
                self.route = LogRoute::Checked(match event {
                    FtpEvent::Complete(_) => FileCheck::Other,
                    FtpEvent::Failed(FtpFault::OtherSize(_)) => FileCheck::Grown,
                    FtpEvent::Failed(fault) => self.unchecked(fault),
                    FtpEvent::Listed(_)
                    | FtpEvent::Opened(_)
                    | FtpEvent::Done
                    | FtpEvent::Bytes(_)
                    | FtpEvent::Checksum(_)
                    | FtpEvent::Wrote(_)
                    | FtpEvent::Written => return,
                });
            }
            LogRoute::File(..)
            | LogRoute::Checking(..)
            | LogRoute::Summed(..)
            | LogRoute::Measuring(_)
            | LogRoute::Checked(_)
            | LogRoute::Messages => {}
        }
    }

    /// The result of the check if its task has failed.
    fn unchecked(&mut self, fault: FtpFault) -> FileCheck {
        let reason = Text::from(fault);
        if fault == FtpFault::Silent {
            // Later logs need not try MAVFTP again.
            self.files = LogFiles::none(reason.clone());
        }
        FileCheck::Unknown(Some(reason))
    }

    fn hear_file(&mut self, path: String, event: FtpEvent, ftp: &mut FtpClient, now: Duration) {
        match event {
            FtpEvent::Bytes(bytes) => {
                let received = self.transfer.take(bytes, now);
                let is_other = received == Received::Other;
                self.note(received);
                if is_other {
                    self.leave(ftp);
                    self.route = LogRoute::file(path, self.transfer.gaps(), ftp);
                }
            }
            FtpEvent::Complete(_) => {
                self.carrier = LogCarrier::File;
                self.route = self.checking(path, ftp);
            }
            FtpEvent::Failed(fault) => {
                // This log can no longer be read unless log messages arrive again.
                self.files = LogFiles::none(fault.into());
                self.route = LogRoute::Messages;
                self.transfer.resume(now);
            }
            FtpEvent::Listed(_)
            | FtpEvent::Opened(_)
            | FtpEvent::Done
            | FtpEvent::Checksum(_)
            | FtpEvent::Wrote(_)
            | FtpEvent::Written => {}
        }
    }

    /// Cancels the task of the file client.
    pub fn leave(&self, ftp: &mut FtpClient) {
        match &self.route {
            LogRoute::File(_, ticket)
            | LogRoute::Checking(_, ticket)
            | LogRoute::Measuring(ticket) => {
                ftp.cancel(*ticket);
            }
            LogRoute::Summed(..) | LogRoute::Checked(_) | LogRoute::Messages => {}
        }
    }

    /// Writes the collected bytes. Does nothing for a file that was already complete.
    pub fn write(&mut self, keeper: &dyn LogKeeper, now: Duration) -> Result<(), Text> {
        self.written_at = now;
        let bytes = std::mem::take(&mut self.unwritten);
        if self.file.is_some() || bytes.is_empty() {
            return Ok(());
        }
        keeper.keep(&self.log, &bytes, self.transfer.gaps())
    }

    /// Takes the steps that are due; returns the log once it is complete.
    pub fn advance(&mut self, desk: &mut LogsDesk<'_>) -> Result<Option<WholeLog>, RowEnding> {
        let collected: usize = self.unwritten.iter().map(|it| it.bytes.len()).sum();
        let is_whole = self.transfer.gaps().is_complete();
        let by_messages = matches!(self.route, LogRoute::Messages);
        let mut is_stalled = by_messages && self.transfer.is_stalled(desk.now);
        if is_stalled
            && !is_whole
            && let Ok(path) = self.files.path(self.log.log.number)
        {
            self.route = LogRoute::file(path.to_owned(), self.transfer.gaps(), desk.ftp);
            is_stalled = false;
        }
        let ends = is_whole || desk.vehicle.armed() || is_stalled;
        if ends || collected >= BLOCK || desk.now >= self.written_at + WRITE_EVERY {
            self.write(desk.keeper, desk.now).map_err(failed)?;
        }
        if is_whole {
            return self.finish(desk).map_err(failed);
        }
        let (number, kept) = (self.log.log.number, self.transfer.gaps().percent());
        if desk.vehicle.armed() {
            self.leave(desk.ftp);
            let text = text!("outcome-logs-armed", number = number, percent = kept);
            return Err(RowEnding::new(RowState::Refused, text));
        }
        if is_stalled {
            let text = text!("outcome-log-stalled", number = number, percent = kept);
            return Err(RowEnding::new(RowState::TimedOut, text));
        }
        if by_messages {
            let round_trip = desk.vehicle.link.round_trip.unwrap_or_default();
            let address = desk.vehicle.address();
            let requests = self.transfer.poll(address, round_trip, desk.now);
            desk.output.messages.extend(requests);
        }
        Ok(None)
    }

    /// Once all bytes have been received, compares the checksums and gives the file its final name.
    fn finish(&mut self, desk: &mut LogsDesk<'_>) -> Result<Option<WholeLog>, Text> {
        if let Some(file) = self.file.take() {
            self.leave(desk.ftp);
            return Ok(Some(self.whole(file, None)));
        }
        let check = match &self.route {
            LogRoute::File(..) | LogRoute::Checking(..) | LogRoute::Measuring(_) => {
                return Ok(None);
            }
            LogRoute::Messages => {
                self.route = match self.files.path(self.log.log.number) {
                    Ok(path) => self.checking(path.to_owned(), desk.ftp),
                    Err(reason) => LogRoute::Checked(FileCheck::Unknown(reason)),
                };
                return Ok(None);
            }
            LogRoute::Summed(path, sum) => {
                let is_same = desk.keeper.checksum(&self.log)? == *sum;
                self.route = if is_same {
                    LogRoute::Checked(FileCheck::Same)
                } else {
                    LogRoute::measuring(path.clone(), self.transfer.gaps(), desk.ftp)
                };
                return Ok(None);
            }
            LogRoute::Checked(FileCheck::Other) if !self.is_again => {
                self.begin_anew(desk)?;
                return Ok(None);
            }
            LogRoute::Checked(check) => check.clone(),
        };
        let file = desk.keeper.finish(&self.log)?;
        let carrier = self.carrier;
        Ok(Some(self.whole(file, Some(LogWay { carrier, check }))))
    }

    fn checking(&self, path: String, ftp: &mut FtpClient) -> LogRoute {
        let task = FtpTask::Checksum {
            path: path.clone(),
            size: self.log.log.size,
        };
        LogRoute::Checking(path, ftp.ask(task))
    }

    fn whole(&self, file: String, way: Option<LogWay>) -> WholeLog {
        let log = self.log.log;
        WholeLog { log, file, way }
    }

    /// Reads the whole log again, by log messages.
    fn begin_anew(&mut self, desk: &LogsDesk<'_>) -> Result<(), Text> {
        let gaps = GapMap::new(self.log.log.size);
        desk.keeper.keep(&self.log, &[], &gaps)?;
        self.transfer = Transfer::new(self.log.log.number, gaps, Vec::new(), desk.now);
        (self.route, self.carrier) = (LogRoute::Messages, LogCarrier::Messages);
        self.is_again = true;
        Ok(())
    }
}

impl LogRoute {
    fn file(path: String, gaps: &GapMap, ftp: &mut FtpClient) -> Self {
        let ticket = ask_for(path.clone(), gaps, ftp);
        Self::File(path, ticket)
    }

    /// Requests the file with a map without gaps: no bytes are read, only the size is compared.
    fn measuring(path: String, gaps: &GapMap, ftp: &mut FtpClient) -> Self {
        Self::Measuring(ask_for(path, gaps, ftp))
    }
}

fn ask_for(path: String, gaps: &GapMap, ftp: &mut FtpClient) -> FtpTicket {
    let gaps = Some(gaps.clone());
    ftp.ask(FtpTask::Read { path, gaps })
}
