//! `MAVLink` FTP: one session at a time, across all links.

mod open;
mod wire;

use std::collections::VecDeque;
use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::FILE_TRANSFER_PROTOCOL_DATA;
use mavlink::dialects::ardupilotmega::MavSeverity::MAV_SEVERITY_DEBUG;
use sortie_wire::FtpChecksum;

use self::open::Open;
use self::wire::{
    ACCEPTED, BURST_READ, CRC32, CREATE, DATA, FtpRequest, LIST, MAKE_FOLDER, OPEN_RO, OPEN_WO,
    READ, REFUSED, REMOVE_FILE, REMOVE_FOLDER, RENAME, RESET, Refusal, Reply, TERMINATE, WRITE,
    listing,
};
use super::content::{self, FileContent, FilePlace};
use super::packed;
use super::tree::{Disk, NO_SUCH_FILE};
use super::{Talk, plan_file};
use crate::payload::Payload;

const MESSAGE: u32 = FILE_TRANSFER_PROTOCOL_DATA::ID;
/// The maximum number of requests that wait while a burst is under way; further ones are dropped.
const MOST_WAITING: usize = 5;
/// A session without a request for this long makes room for another.
const SESSION_TIMEOUT: Duration = Duration::from_secs(3);
/// The maximum number of messages in one burst, and the number sent in one step of 10 ms.
const BURST: usize = 500;
const BURST_PER_STEP: usize = 2;

#[derive(Debug, Clone)]
struct SentBurst {
    request: FtpRequest,
    sent: usize,
    reply: Reply,
}

#[derive(Debug, Clone, Default)]
pub(super) struct Files {
    disk: Disk,
    open: Option<(u8, Open)>,
    /// The last answer, to be repeated if its request arrives again.
    last: Option<Reply>,
    waiting: VecDeque<FtpRequest>,
    burst: Option<Box<SentBurst>>,
    sent_at: Duration,
}

impl Files {
    /// Whether nothing is left to send.
    pub(super) fn is_idle(&self) -> bool {
        self.burst.is_none() && self.waiting.is_empty()
    }

    pub(super) fn disk(&self) -> &Disk {
        &self.disk
    }

    /// A file server after a reboot: files stay, sessions do not.
    pub(super) fn rebooted(self) -> Self {
        Self {
            disk: self.disk,
            ..Self::default()
        }
    }
}

/// Whether a message belongs to the protocol.
pub(super) fn is_part(id: u32) -> bool {
    id == MESSAGE
}

/// Answers a message of the protocol; `false` if it is not one.
pub(super) fn handle(talk: &mut Talk<'_>, id: u32, payload: &Payload) -> bool {
    if id != MESSAGE {
        return false;
    }
    if talk.is_for_us(payload.byte(1)) && talk.autopilot.vehicle.parameters.hands_out_files() {
        let request = FtpRequest::read(payload, talk.peer);
        let files = &mut talk.transfers.files;
        if files.burst.is_none() {
            talk.serve(request);
        } else if files.waiting.len() < MOST_WAITING {
            files.waiting.push_back(request);
        }
    }
    true
}

/// Sends the next messages of a burst, then answers the requests that waited for its end.
pub(super) fn step(talk: &mut Talk<'_>) {
    let now = talk.autopilot.vehicle.uptime();
    let files = &mut talk.transfers.files;
    if let Some(burst) = &files.burst {
        if burst.request.from.link == talk.peer.link {
            talk.continue_burst(BURST_PER_STEP);
        } else if now.saturating_sub(files.sent_at) > SESSION_TIMEOUT {
            // The link of the burst is gone.
            files.burst = None;
        }
        return;
    }
    // Answers are sent on the link on which the request arrived.
    let due = files.waiting.front().map(|request| request.from.link);
    if due == Some(talk.peer.link) {
        if let Some(request) = files.waiting.pop_front() {
            talk.serve(request);
        }
    } else if now.saturating_sub(files.sent_at) > SESSION_TIMEOUT {
        files.waiting.clear();
    }
}

impl Talk<'_> {
    fn files(&mut self) -> &mut Files {
        &mut self.transfers.files
    }

    fn send(&mut self, reply: Reply) {
        self.raw(MESSAGE, reply.payload());
        let now = self.autopilot.vehicle.uptime();
        let files = self.files();
        files.sent_at = now;
        files.last = Some(reply);
    }

    fn serve(&mut self, request: FtpRequest) {
        if matches!(request.opcode, ACCEPTED | REFUSED) {
            return;
        }
        let again = self.files().last.as_ref().is_some_and(|reply| {
            // A request that follows a burst may have the number of the burst's end.
            reply.asked == request.opcode
                && reply.to.is_same_sender(request.from)
                && reply.session == request.session
                && reply.seq == request.seq.wrapping_add(1)
        });
        if again && let Some(reply) = self.files().last.take() {
            return self.send(reply);
        }
        let mut reply = request.reply();
        let wants_banner =
            request.opcode == OPEN_RO && request.data.starts_with(b"@PARAM/param.pck");
        if request.opcode == BURST_READ
            && usize::from(request.size) <= DATA
            && self.check_session(&request).is_ok()
        {
            return self.begin_burst(request, reply);
        }
        let done = self.carry_out(&request, &mut reply);
        if let Err(reason) = done {
            reply.refuse(reason);
        }
        self.send(reply);
        if wants_banner && done.is_ok() {
            let banner = self.banner();
            self.link.replies.extend(banner.into_iter().map(Into::into));
        }
    }

    /// Refuses a second session while the first is in use.
    fn check_session(&mut self, request: &FtpRequest) -> Result<(), Refusal> {
        let now = self.autopilot.vehicle.uptime();
        let files = &self.transfers.files;
        let idle = now.saturating_sub(files.sent_at) >= SESSION_TIMEOUT;
        match &files.open {
            Some((session, _)) if *session != request.session && !idle => {
                Err(Refusal::InvalidSession)
            }
            Some((session, _)) if *session != request.session => {
                self.close();
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn carry_out(&mut self, request: &FtpRequest, reply: &mut Reply) -> Result<(), Refusal> {
        if usize::from(request.size) > DATA {
            return Err(Refusal::InvalidSize);
        }
        if matches!(request.opcode, TERMINATE | RESET) {
            let own = |(session, _): &(u8, Open)| *session == request.session;
            if self.files().open.as_ref().is_some_and(own) {
                self.close();
            }
            return Ok(());
        }
        self.check_session(request)?;
        match request.opcode {
            0 => {}
            LIST => {
                reply.offset = request.offset;
                let entries = content::list(
                    &self.autopilot.vehicle,
                    self.transfers.files.disk(),
                    &request.path()?,
                )?;
                reply.data = listing(&entries, request.offset)?;
            }
            OPEN_RO => reply.data = self.open(request)?.to_le_bytes().to_vec(),
            READ => {
                reply.data = self.read(request.offset as usize, usize::from(request.size))?;
                reply.offset = request.offset;
            }
            CREATE | OPEN_WO => self.open_to_write(request)?,
            WRITE => {
                self.write(request)?;
                reply.offset = request.offset;
            }
            CRC32 => reply.data = self.crc32(request)?.to_le_bytes().to_vec(),
            _ => self.rearrange(request)?,
        }
        Ok(())
    }

    /// Creates, renames and removes files and folders.
    fn rearrange(&mut self, request: &FtpRequest) -> Result<(), Refusal> {
        match request.opcode {
            REMOVE_FILE | REMOVE_FOLDER => {
                let path = content::writable(&request.path()?)?;
                self.files().disk.remove(&path)?;
            }
            MAKE_FOLDER => {
                let path = content::writable(&request.path()?)?;
                self.files().disk.make_folder(&path)?;
            }
            RENAME => {
                let (from, to) = request.paths()?;
                let (from, to) = (content::writable(&from)?, content::writable(&to)?);
                self.files().disk.rename(&from, &to)?;
            }
            opcode => {
                let text = format!("Unsupported FTP: {opcode}");
                self.autopilot.vehicle.say(MAV_SEVERITY_DEBUG, &text);
                return Err(Refusal::Fail);
            }
        }
        Ok(())
    }

    /// Opens a file for reading and returns its length.
    fn open(&mut self, request: &FtpRequest) -> Result<u32, Refusal> {
        let idle = self
            .autopilot
            .vehicle
            .uptime()
            .saturating_sub(self.files().sent_at);
        if self.files().open.is_some() && idle > SESSION_TIMEOUT {
            self.close();
        }
        if self.files().open.is_some() {
            return Err(Refusal::Fail);
        }
        let (content, len) = FileContent::open(
            &self.autopilot.vehicle,
            self.transfers.files.disk(),
            &request.path()?,
        )?;
        self.files().open = Some((request.session, Open::Reading(content)));
        Ok(len as u32)
    }

    fn open_to_write(&mut self, request: &FtpRequest) -> Result<(), Refusal> {
        if self.files().open.is_some() {
            return Err(Refusal::Fail);
        }
        let path = request.path()?;
        let open = match FilePlace::of(&path) {
            FilePlace::Parameters(name) if packed::is_name(&name) => {
                Open::WritingParameters(Vec::new())
            }
            FilePlace::Plans(name) => {
                let kind = plan_file::kind_of(&name).ok_or(NO_SUCH_FILE)?;
                Open::WritingPlan(kind, Vec::new())
            }
            FilePlace::System(_)
            | FilePlace::Parameters(_)
            | FilePlace::Firmware(_)
            | FilePlace::Logs(_)
            | FilePlace::Disk(_) => {
                let path = content::writable(&path)?;
                if request.opcode == CREATE {
                    self.files().disk.create(&path)?;
                }
                self.files().disk.read(&path)?;
                Open::Writing(path)
            }
        };
        self.files().open = Some((request.session, open));
        Ok(())
    }

    fn read(&mut self, offset: usize, len: usize) -> Result<Vec<u8>, Refusal> {
        let parameters = &self.autopilot.vehicle.parameters;
        let open = self.transfers.files.open.as_mut();
        let (_, open) = open.ok_or(Refusal::NothingOpen)?;
        open.read(parameters, offset, len)
    }

    fn write(&mut self, request: &FtpRequest) -> Result<(), Refusal> {
        let bytes = &request.data[..usize::from(request.size).min(request.data.len())];
        let files = self.files();
        let (_, open) = files.open.as_mut().ok_or(Refusal::NothingOpen)?;
        open.write(&mut files.disk, request.offset as usize, bytes)
    }

    fn crc32(&mut self, request: &FtpRequest) -> Result<u32, Refusal> {
        let (mut content, _) = FileContent::open(
            &self.autopilot.vehicle,
            self.transfers.files.disk(),
            &request.path()?,
        )?;
        // Files that are packed while they are read are read in blocks of this size.
        let block = match &content {
            FileContent::Bytes(bytes) => bytes.len(),
            FileContent::Parameters { .. } => 64,
        };
        let mut all = Vec::new();
        loop {
            let bytes = content.read(&self.autopilot.vehicle.parameters, all.len(), block)?;
            if bytes.is_empty() {
                return Ok(FtpChecksum::of(&all));
            }
            all.extend_from_slice(bytes);
        }
    }

    /// Closes the file; a file of parameters or of a plan takes effect.
    fn close(&mut self) {
        match self.files().open.take() {
            Some((_, Open::WritingParameters(file))) => {
                for (name, value) in packed::unpack(&file).unwrap_or_default() {
                    self.autopilot.vehicle.parameters.set(&name, value);
                }
                self.autopilot.vehicle.retune();
            }
            Some((_, Open::WritingPlan(kind, file))) => {
                plan_file::take(self.autopilot, kind, &file);
            }
            _ => {}
        }
    }

    fn begin_burst(&mut self, request: FtpRequest, reply: Reply) {
        let burst = SentBurst {
            request,
            sent: 0,
            reply,
        };
        self.files().burst = Some(Box::new(burst));
        self.continue_burst(1);
    }

    fn continue_burst(&mut self, messages: usize) {
        for _ in 0..messages {
            let Some(mut burst) = self.files().burst.take() else {
                return;
            };
            let size = match burst.request.size {
                0 => DATA,
                size => usize::from(size),
            };
            let offset = (burst.request.offset as usize).saturating_add(burst.sent * size);
            let reply = &mut burst.reply;
            match self.read(offset, size) {
                Ok(data) => {
                    burst.sent += 1;
                    reply.offset = offset as u32;
                    reply.burst_complete = burst.sent == BURST;
                    let short = (data.len() < size).then_some(data.len() as u32);
                    reply.data = data;
                    self.send(reply.clone());
                    reply.seq = reply.seq.wrapping_add(1);
                    // The refusal that ends the burst has the offset of the file's end.
                    reply.offset += short.unwrap_or(0);
                    if burst.sent < BURST {
                        self.files().burst = Some(burst);
                    }
                }
                Err(reason) => {
                    reply.refuse(reason);
                    self.send(reply.clone());
                }
            }
        }
    }
}
