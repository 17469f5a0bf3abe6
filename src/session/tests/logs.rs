//! Logs from a scripted vehicle that answers as `ArduPilot` does.

use std::collections::BTreeMap;
use std::sync::Mutex;

use mavlink::dialects::ardupilotmega::{
    AUTOPILOT_VERSION_DATA, FILE_TRANSFER_PROTOCOL_DATA, LOG_DATA_DATA, LOG_ENTRY_DATA,
    MavProtocolCapability,
};
use proptest::prelude::*;
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::commands::{LogChoice, LogCommand, LogGroup};
use crate::session::ftp::server::FileServer;
use crate::text::Text;

mod files;

/// Keeps logs in memory.
#[derive(Debug, Default)]
struct Memory {
    parts: Mutex<BTreeMap<u16, (Vec<u8>, GapMap)>>,
    whole: Mutex<BTreeMap<u16, Vec<u8>>>,
    /// The largest number of gaps stored.
    kept_gaps: Mutex<usize>,
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

/// A vehicle with logs at the other end of a session. It answers one request at a time, and drops those that arrive in
/// the meantime.
struct Shelf {
    scene: Scene,
    keeper: Arc<Memory>,
    logs: Vec<Vec<u8>>,
    /// The share of messages that are lost, either way.
    loss: f64,
    random: ChaCha8Rng,
    passed: usize,
    sending: Option<(u16, std::ops::Range<u32>)>,
    /// The number of stream messages per 10 ms.
    rate: usize,
    requests: usize,
    /// The number of requests that it answers; later ones get no answer.
    answers: usize,
    /// The number of bytes sent in log messages.
    carried: usize,
    /// The file server, if the vehicle offers files.
    server: FileServer,
}

impl Shelf {
    fn new(logs: Vec<Vec<u8>>) -> Self {
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
    fn with_files(logs: Vec<Vec<u8>>) -> Self {
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

    fn explanation(&self) -> String {
        let words = self.last_row().explanation.as_ref();
        words.expect("words").to_string()
    }

    fn kept(&self, number: u16) -> Vec<u8> {
        self.keeper.whole.lock().expect("kept")[&number].clone()
    }

    fn is_lost(&mut self) -> bool {
        self.passed += 1;
        self.loss > 0.0 && self.random.random_bool(self.loss)
    }

    fn order(&mut self, command: LogCommand) {
        let verb = &language::row("logs").expect("a verb").verb;
        let entry = EntryId(1);
        let order = VehicleCommand::new(entry, verb, Command::Log(command));
        self.scene.session.order(order, self.scene.now);
        self.scene.collect();
    }

    fn download(&mut self, which: LogChoice) {
        let folder = None;
        self.order(LogCommand::Download { which, folder });
    }

    fn last_row(&self) -> &RowUpdate {
        self.scene.rows.last().expect("a row")
    }

    /// Advances time by 10 ms.
    fn step(&mut self) {
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

    fn list(&mut self, start: u16, end: u16) {
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

    fn send(&mut self) {
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

    fn send_file(&mut self) {
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

    fn until_over(&mut self, patience: Duration) {
        let until = self.scene.now + patience;
        while self.scene.now < until && !self.is_over() {
            self.scene.heartbeat_if_due();
            self.step();
        }
    }

    fn is_over(&self) -> bool {
        self.scene
            .rows
            .last()
            .is_some_and(|row| row.state.is_final())
    }
}

impl Scene {
    fn heartbeat_if_due(&mut self) {
        if self.now.subsec_millis() == 0 {
            self.heartbeat(STABILIZE, false);
        }
    }
}

fn log(len: usize, seed: usize) -> Vec<u8> {
    (0..len)
        .map(|at| (at * 31 + at / 256 + seed) as u8)
        .collect()
}

#[test]
fn logs_are_listed() {
    let mut shelf = Shelf::new(vec![log(1000, 1), log(48_200, 2)]);
    shelf.order(LogCommand::List);
    shelf.until_over(ms(3000));
    let row = shelf.last_row();
    assert_eq!(row.state, RowState::Done);
    let text = row.explanation.as_ref().expect("words").to_string();
    assert_eq!(
        text,
        "2 logs, 49.2 kB: 2 (48.2 kB, 2026-01-01 00:00:00); 1 (1.0 kB, 2026-01-01 00:00:00)"
    );
    let mut empty = Shelf::new(Vec::new());
    empty.order(LogCommand::List);
    empty.until_over(ms(3000));
    assert_eq!(empty.last_row().state, RowState::Done);
    empty.download(LogChoice::Group(LogGroup::Last));
    empty.step();
    empty.until_over(ms(3000));
    assert_eq!(empty.last_row().state, RowState::Refused);
}

#[test]
fn a_log_comes_with_one_request_where_nothing_is_lost() {
    let mut shelf = Shelf::new(vec![log(10, 1), log(50_000, 2)]);
    shelf.download(LogChoice::Group(LogGroup::Last));
    shelf.until_over(ms(10_000));
    assert_eq!(
        shelf.last_row().state,
        RowState::Done,
        "{:?}",
        shelf.last_row()
    );
    assert_eq!(shelf.requests, 1);
    assert_eq!(shelf.keeper.whole.lock().expect("kept")[&2], log(50_000, 2));
    let percents = shelf.scene.rows.iter();
    let percents = percents.filter(|row| matches!(row.state, RowState::InProgress(_)));
    assert!(percents.count() > 20);
}

#[test]
fn a_download_that_was_broken_off_goes_on_unless_it_is_another_log() {
    for (is_other, most) in [(false, 25_000), (true, 51_000)] {
        let mut shelf = Shelf::new(vec![log(50_000, 2)]);
        shelf.download(LogChoice::Group(LogGroup::All));
        while shelf.last_row().state != RowState::InProgress(60) {
            shelf.step();
        }
        shelf.scene.heartbeat(STABILIZE, true);
        shelf.step();
        let row = shelf.last_row().clone();
        assert_eq!(row.state, RowState::Refused);
        let words = row.explanation.expect("words").to_string();
        assert!(
            words.contains(": 60 % of log 1") || words.contains(": 61 % of log 1"),
            "{words}"
        );
        shelf.sending = None;
        shelf.scene.heartbeat(STABILIZE, false);
        if is_other {
            shelf.logs[0] = log(50_000, 3);
        }
        let before = shelf.passed;
        shelf.download(LogChoice::Number(1));
        shelf.step();
        shelf.until_over(ms(10_000));
        assert_eq!(shelf.last_row().state, RowState::Done);
        let kept = shelf.keeper.whole.lock().expect("kept")[&1].clone();
        assert!(kept == shelf.logs[0], "other bytes");
        let bytes = (shelf.passed - before) * 90;
        assert!(bytes < most, "{bytes} bytes");
    }
}

#[test]
fn a_download_is_stopped_and_goes_on_later() {
    let mut shelf = Shelf::new(vec![log(50_000, 2)]);
    shelf.download(LogChoice::Group(LogGroup::Last));
    while shelf.last_row().state != RowState::InProgress(30) {
        shelf.step();
    }
    shelf.order(LogCommand::Stop);
    shelf.step();
    let states: Vec<_> = shelf.scene.rows.iter().rev().take(2).collect();
    assert_eq!(states[0].state, RowState::Done);
    assert_eq!(states[1].state, RowState::Superseded);
    let requests = shelf.requests;
    shelf.sending = None;
    shelf.until_over(ms(3000));
    assert_eq!(shelf.requests, requests);
    shelf.order(LogCommand::Stop);
    shelf.step();
    assert_eq!(shelf.last_row().state, RowState::Refused);
    shelf.carried = 0;
    shelf.download(LogChoice::Group(LogGroup::Last));
    shelf.step();
    shelf.until_over(ms(10_000));
    assert_eq!(shelf.last_row().state, RowState::Done);
    assert!(shelf.kept(1) == log(50_000, 2) && shelf.carried < 40_000);
}

#[test]
fn a_vehicle_that_falls_silent_is_given_up_and_what_came_is_kept() {
    let mut shelf = Shelf::new(vec![log(50_000, 2)]);
    shelf.download(LogChoice::Group(LogGroup::Last));
    while shelf.last_row().state != RowState::InProgress(30) {
        shelf.step();
    }
    shelf.loss = 1.0;
    shelf.until_over(Duration::from_secs(120));
    assert_eq!(shelf.last_row().state, RowState::TimedOut);
    let parts = shelf.keeper.parts.lock().expect("kept");
    assert!((30..=31).contains(&parts[&1].1.percent()));
}

#[test]
fn logs_are_refused_while_armed_and_where_they_cannot_be_kept() {
    let mut shelf = Shelf::new(vec![log(500, 2)]);
    shelf.scene.heartbeat(STABILIZE, true);
    shelf.order(LogCommand::List);
    assert_eq!(shelf.last_row().state, RowState::Refused);
    let mut scene = Scene::new();
    let verb = &language::row("logs").expect("a verb").verb;
    let command = Command::Log(LogCommand::Download {
        which: LogChoice::Group(LogGroup::Last),
        folder: None,
    });
    let order = VehicleCommand::new(EntryId(1), verb, command);
    scene.session.order(order, scene.now);
    scene.collect();
    assert_eq!(scene.rows.last().expect("a row").state, RowState::Refused);
}

#[test]
fn the_highest_number_of_logs_is_listed() {
    let mut shelf = Shelf::new(vec![log(100, 1)]);
    shelf.order(LogCommand::List);
    for id in 1..=u16::MAX {
        let entry = LOG_ENTRY_DATA {
            time_utc: 0,
            size: 1,
            id,
            num_logs: u16::MAX,
            last_log_num: u16::MAX,
        };
        shelf.scene.pass(Duration::ZERO);
        shelf.scene.hear(MavMessage::LOG_ENTRY(entry));
    }
    shelf.scene.pass(ms(10));
    assert_eq!(shelf.last_row().state, RowState::Done);
    assert!(
        shelf
            .explanation()
            .starts_with("65535 logs, 65.5 kB: 65535")
    );
}

#[test]
fn bytes_all_over_a_huge_log_make_no_endless_list() {
    let mut shelf = Shelf::new(vec![Vec::new()]);
    shelf.download(LogChoice::Number(1));
    let entry = LOG_ENTRY_DATA {
        time_utc: 0,
        size: u32::MAX,
        id: 1,
        num_logs: 1,
        last_log_num: 1,
    };
    shelf.scene.pass(Duration::ZERO);
    shelf.scene.hear(MavMessage::LOG_ENTRY(entry));
    shelf.scene.pass(ms(10));
    for (step, count) in [(2, 1), (180, 90)] {
        for place in 0..20_000 {
            let data = LOG_DATA_DATA {
                ofs: place * step,
                id: 1,
                count,
                ..LOG_DATA_DATA::DEFAULT
            };
            shelf.scene.hear(MavMessage::LOG_DATA(data));
        }
        shelf.scene.pass(Duration::from_secs(2));
    }
    let parts = shelf.keeper.kept_gaps.lock().expect("kept");
    assert!(*parts > 5000 && *parts <= 10_000, "{parts} gaps");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// As long as some messages arrive, the received log is correct, whatever is lost.
    #[test]
    fn a_log_survives_losses(
        seed in any::<u64>(),
        loss in 0.0..0.4,
        len in 1usize..60_000,
        rate in 1usize..40,
    ) {
        let mut shelf = Shelf::new(vec![log(len, 7)]);
        shelf.loss = loss;
        shelf.random = ChaCha8Rng::seed_from_u64(seed);
        shelf.rate = rate;
        shelf.download(LogChoice::Group(LogGroup::Last));
        shelf.until_over(Duration::from_secs(600));
        prop_assert_eq!(shelf.last_row().state, RowState::Done);
        let whole = shelf.keeper.whole.lock().expect("kept");
        prop_assert!(whole[&1] == log(len, 7));
    }
}
