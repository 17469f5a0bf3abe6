//! A scripted vehicle with logs, and a keeper for downloaded logs.

use std::collections::BTreeMap;
use std::sync::Mutex;

use mavlink::dialects::ardupilotmega::{
    AUTOPILOT_VERSION_DATA, FILE_TRANSFER_PROTOCOL_DATA, LOG_DATA_DATA, LOG_ENTRY_DATA,
    MavProtocolCapability,
};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::session::ftp::server::FileServer;
use crate::wire::FtpChecksum;

/// Keeps logs in memory.
#[derive(Debug, Default)]
pub(super) struct Memory {
    pub(super) parts: Mutex<BTreeMap<u16, (Vec<u8>, GapMap)>>,
    pub(super) whole: Mutex<BTreeMap<u16, Vec<u8>>>,
    /// The largest number of gaps stored.
    pub(super) kept_gaps: Mutex<usize>,
}

impl LogKeeper for Memory {
    fn find(&self, log: &VehicleLog) -> Result<KeptLog, Text> {
        let parts = self.parts.lock().expect("no panic");
        let Some((bytes, gaps)) = parts.get(&log.log.number) else {
            return Ok(KeptLog {
                gaps: GapMap::new(log.log.size),
                samples: Vec::new(),
                file: None,
            });
        };
        let known = gaps.missing().first().map_or(0, |gap| gap.start);
        let at = known.saturating_sub(720);
        let sample = FileBytes {
            at,
            bytes: bytes[at as usize..known as usize].to_vec(),
        };
        Ok(KeptLog {
            gaps: gaps.clone(),
            samples: Some(sample).filter(|_| known > 0).into_iter().collect(),
            file: None,
        })
    }

    fn keep(&self, log: &VehicleLog, bytes: &[FileBytes], gaps: &GapMap) -> Result<(), Text> {
        let mut most = self.kept_gaps.lock().expect("no panic");
        *most = gaps.missing().len().max(*most);
        if log.log.size == u32::MAX {
            return Ok(());
        }
        let mut parts = self.parts.lock().expect("no panic");
        let part = parts.entry(log.log.number);
        let (part, known) = part.or_insert_with(|| (vec![0; log.log.size as usize], gaps.clone()));
        for stretch in bytes {
            let range = stretch.range();
            part[range.start as usize..range.end as usize].copy_from_slice(&stretch.bytes);
        }
        *known = gaps.clone();
        Ok(())
    }

    fn checksum(&self, log: &VehicleLog) -> Result<u32, Text> {
        let parts = self.parts.lock().expect("no panic");
        let mut sum = FtpChecksum::default();
        sum.add(&parts[&log.log.number].0);
        Ok(sum.value())
    }

    fn finish(&self, log: &VehicleLog) -> Result<String, Text> {
        let mut parts = self.parts.lock().expect("no panic");
        let (bytes, gaps) = parts.remove(&log.log.number).expect("it was kept");
        assert!(gaps.is_complete());
        self.whole
            .lock()
            .expect("no panic")
            .insert(log.log.number, bytes);
        Ok(format!("log{}.bin", log.log.number))
    }
}

/// A vehicle with logs at the other end of a session. It answers one request at a time, and drops
/// requests that arrive in the meantime.
pub(super) struct Shelf {
    pub(super) scene: Scene,
    pub(super) keeper: Arc<Memory>,
    pub(super) logs: Vec<Vec<u8>>,
    /// The share of messages that are lost, either way.
    pub(super) loss: f64,
    pub(super) random: ChaCha8Rng,
    pub(super) passed: usize,
    pub(super) sending: Option<(u16, std::ops::Range<u32>)>,
    /// The number of stream messages per 10 ms.
    pub(super) rate: usize,
    pub(super) requests: usize,
    /// The number of requests that it answers; later ones get no answer.
    pub(super) answers: usize,
    /// The number of bytes sent in log messages.
    pub(super) carried: usize,
    /// The file server, if the vehicle offers files.
    pub(super) server: FileServer,
}

impl Shelf {
    pub(super) fn new(logs: Vec<Vec<u8>>) -> Self {
        let mut scene = Scene::new();
        let keeper = Arc::new(Memory::default());
        scene.session = scene
            .session
            .clone()
            .keeping_logs(Arc::clone(&keeper) as Arc<dyn LogKeeper>);
        Self {
            scene,
            keeper,
            logs,
            loss: 0.0,
            random: ChaCha8Rng::seed_from_u64(1),
            passed: 0,
            sending: None,
            rate: 4,
            requests: 0,
            answers: usize::MAX,
            carried: 0,
            server: FileServer::default(),
        }
    }

    /// A vehicle that offers the files of its logs.
    pub(super) fn with_files(logs: Vec<Vec<u8>>) -> Self {
        let mut shelf = Self::new(logs);
        for (number, log) in (1..).zip(&shelf.logs) {
            let path = format!("logs/{number:08}.BIN");
            shelf.server.files.insert(path, log.clone());
        }
        let version = AUTOPILOT_VERSION_DATA {
            capabilities: MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_FTP,
            ..AUTOPILOT_VERSION_DATA::DEFAULT
        };
        shelf.scene.hear(MavMessage::AUTOPILOT_VERSION(version));
        shelf
    }

    pub(super) fn explanation(&self) -> String {
        let words = self.last_row().explanation.as_ref();
        words.expect("words").to_string()
    }

    pub(super) fn kept(&self, number: u16) -> Vec<u8> {
        self.keeper.whole.lock().expect("kept")[&number].clone()
    }

    pub(super) fn is_lost(&mut self) -> bool {
        self.passed += 1;
        self.loss > 0.0 && self.random.random_bool(self.loss)
    }

    pub(super) fn order(&mut self, command: LogCommand) {
        let verb = &language::row("logs").expect("a verb").verb;
        let entry = EntryId(1);
        let order = VehicleCommand::new(entry, verb, Command::Log(command));
        self.scene.session.order(order, self.scene.now);
        self.scene.collect();
    }

    pub(super) fn download(&mut self, which: LogChoice) {
        let folder = None;
        self.order(LogCommand::Download { which, folder });
    }

    pub(super) fn last_row(&self) -> &RowUpdate {
        self.scene.rows.last().expect("a row")
    }

    /// Advances time by 10 ms.
    pub(super) fn step(&mut self) {
        self.scene.pass(ms(10));
        for message in std::mem::take(&mut self.scene.sent) {
            if self.is_lost() {
                continue;
            }
            let Outgoing::Message(message) = message else {
                continue;
            };
            match message {
                MavMessage::LOG_REQUEST_LIST(asked) => self.list(asked.start, asked.end),
                MavMessage::LOG_REQUEST_DATA(asked) if self.sending.is_none() => {
                    self.requests += 1;
                    if self.requests > self.answers {
                        continue;
                    }
                    let size = self.logs[usize::from(asked.id) - 1].len() as u32;
                    let end = asked.ofs.saturating_add(asked.count).min(size);
                    self.sending = Some((asked.id, asked.ofs..end));
                    self.send();
                }
                MavMessage::LOG_REQUEST_END(_) => self.sending = None,
                MavMessage::FILE_TRANSFER_PROTOCOL(asked) => self.server.hear(asked.payload),
                _ => {}
            }
        }
        for _ in 0..self.rate {
            self.send();
            self.send_file();
        }
    }

    pub(super) fn list(&mut self, start: u16, end: u16) {
        let count = self.logs.len() as u16;
        let (first, last) = if count == 0 {
            (0, 0)
        } else {
            (start.max(1), end.min(count))
        };
        for id in first..=last {
            let log = usize::from(id).checked_sub(1).map(|at| &self.logs[at]);
            let entry = LOG_ENTRY_DATA {
                time_utc: 1_767_225_600,
                size: log.map_or(0, |log| log.len() as u32),
                id,
                num_logs: count,
                last_log_num: last,
            };
            if !self.is_lost() {
                self.scene.hear(MavMessage::LOG_ENTRY(entry));
            }
        }
    }

    pub(super) fn send(&mut self) {
        let Some((id, range)) = self.sending.clone() else {
            return;
        };
        let end = range.end.min(range.start + 90);
        let bytes = &self.logs[usize::from(id) - 1][range.start as usize..end as usize];
        let mut data = LOG_DATA_DATA {
            ofs: range.start,
            id,
            count: bytes.len() as u8,
            ..LOG_DATA_DATA::DEFAULT
        };
        data.data[..bytes.len()].copy_from_slice(bytes);
        self.carried += bytes.len();
        let is_over = bytes.len() < 90 || end == range.end;
        self.sending = (!is_over).then_some((id, end..range.end));
        if !self.is_lost() {
            self.scene.hear(MavMessage::LOG_DATA(data));
        }
    }

    pub(super) fn send_file(&mut self) {
        if let Some(payload) = self.server.say()
            && !self.is_lost()
        {
            let data = FILE_TRANSFER_PROTOCOL_DATA {
                target_system: 255,
                payload,
                ..FILE_TRANSFER_PROTOCOL_DATA::DEFAULT
            };
            self.scene.hear(MavMessage::FILE_TRANSFER_PROTOCOL(data));
        }
    }

    pub(super) fn until_over(&mut self, patience: Duration) {
        let until = self.scene.now + patience;
        while self.scene.now < until && !self.is_over() {
            self.scene.heartbeat_if_due();
            self.step();
        }
    }

    pub(super) fn is_over(&self) -> bool {
        self.scene
            .rows
            .last()
            .is_some_and(|row| row.state.is_final())
    }
}

impl Scene {
    pub(super) fn heartbeat_if_due(&mut self) {
        if self.now.subsec_millis() == 0 {
            self.heartbeat(STABILIZE, false);
        }
    }
}

pub(super) fn log(len: usize, seed: usize) -> Vec<u8> {
    (0..len)
        .map(|at| (at * 31 + at / 256 + seed) as u8)
        .collect()
}
