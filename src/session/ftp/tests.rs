//! The client against a server, over a channel that loses, duplicates and reorders packets.

use proptest::prelude::*;
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;

use super::server::{FileServer, Quirks, Sums};
use super::*;

const STEP: Duration = Duration::from_millis(10);

/// The faults of the channel between client and server: loss, repetition, delay.
#[derive(Debug, Clone, Copy, Default)]
struct Channel {
    loss: f64,
    doubling: f64,
    /// The number of steps in which later packets may overtake a packet.
    delay: u32,
}

struct Scene {
    client: FtpClient,
    server: FileServer,
    channel: Channel,
    random: ChaCha8Rng,
    now: Duration,
    /// The number of packets that the server sends in one step.
    rate: usize,
    on_the_way: Vec<(Duration, FtpPayload, bool)>,
    events: Vec<FtpEvent>,
    /// The size with which the last file was opened.
    opened: Option<u32>,
    file: Vec<u8>,
}

impl Scene {
    fn new(server: FileServer) -> Self {
        Self {
            client: FtpClient::default(),
            server,
            channel: Channel::default(),
            random: ChaCha8Rng::seed_from_u64(1),
            now: Duration::ZERO,
            rate: 8,
            on_the_way: Vec::new(),
            events: Vec::new(),
            opened: None,
            file: Vec::new(),
        }
    }

    fn post(&mut self, payload: FtpPayload, is_answer: bool) {
        let copies = 1 + u32::from(self.random.random_bool(self.channel.doubling));
        for _ in 0..copies {
            if !self.random.random_bool(self.channel.loss) {
                let late = STEP * self.random.random_range(0..=self.channel.delay);
                self.on_the_way.push((self.now + late, payload, is_answer));
            }
        }
    }

    fn tell(&mut self, incoming: Option<&FtpPayload>) {
        let round_trip = STEP * self.channel.delay * 2;
        let step = self.client.step(incoming, round_trip, self.now);
        for request in step.requests {
            self.post(request, false);
        }
        for (_, event) in step.events {
            match event {
                FtpEvent::Bytes(bytes) => {
                    let range = bytes.range();
                    let len = self.file.len().max(range.end as usize);
                    self.file.resize(len, 0);
                    let place = range.start as usize..range.end as usize;
                    self.file[place].copy_from_slice(&bytes.bytes);
                }
                FtpEvent::Opened(size) => self.opened = Some(size),
                other => self.events.push(other),
            }
        }
    }

    fn step(&mut self) {
        self.now += STEP;
        self.tell(None);
        let now = self.now;
        let there: Vec<_> = self.on_the_way.extract_if(.., |it| it.0 <= now).collect();
        for (_, payload, is_answer) in there {
            if is_answer {
                self.tell(Some(&payload));
            } else {
                self.server.hear(payload);
            }
        }
        for _ in 0..self.rate {
            if let Some(answer) = self.server.say() {
                self.post(answer, true);
            }
        }
    }

    /// Advances time until the client is idle; returns how long that took.
    fn run(&mut self, task: FtpTask) -> Duration {
        let begun = self.now;
        self.client.ask(task);
        while self.client.is_busy() && self.now < begun + Duration::from_secs(900) {
            self.step();
        }
        assert!(!self.client.is_busy(), "it goes on: {:?}", self.client);
        self.now.saturating_sub(begun)
    }

    fn read(&mut self, path: &str, gaps: Option<GapMap>) -> Duration {
        self.run(FtpTask::Read {
            path: path.to_owned(),
            gaps,
        })
    }

    fn last(&self) -> &FtpEvent {
        self.events.last().expect("an event")
    }
}

fn content(len: usize) -> Vec<u8> {
    (0..len).map(|at| (at * 31 + at / 256) as u8).collect()
}

fn failed(nak: FtpNak) -> FtpEvent {
    FtpEvent::Failed(FtpFault::Refused(nak))
}

#[test]
fn a_file_comes_in_bursts_and_is_closed() {
    for len in [0, 1, 239, 239 * 3, 239 * 500, 300_001] {
        let mut scene = Scene::new(FileServer::with("logs/1", &content(len)));
        scene.read("logs/1", Some(GapMap::new(len as u32)));
        assert_eq!(scene.events, [FtpEvent::Complete(len as u32)]);
        assert_eq!(scene.opened, Some(len as u32));
        assert!(scene.file == content(len), "{len}");
        assert!(!scene.server.is_open());
        let pieces = scene.server.carried_out.iter().filter(|it| **it == 5);
        let bursts = scene.server.carried_out.iter().filter(|it| **it == 15);
        assert!(pieces.count() <= 4, "{len}");
        assert!(bursts.count() <= len / (239 * 500) + 1, "{len}");
    }
}

#[test]
fn only_what_is_missing_is_read() {
    let mut scene = Scene::new(FileServer::with("a", &content(50_000)));
    let gaps = vec![100..200, 40_000..40_001, 49_000..50_000];
    let gaps = GapMap::of_gaps(50_000, gaps).expect("gaps");
    scene.read("a", Some(gaps));
    assert_eq!(scene.events, [FtpEvent::Complete(50_000)]);
    assert_eq!(scene.server.carried_out, [4, 15, 5, 5, 1]);
    assert_eq!(
        scene.file[..200],
        [vec![0; 100], content(200)[100..].to_vec()].concat()
    );
}

#[test]
fn a_file_of_estimated_size_ends_where_the_server_says() {
    for (len, estimate) in [
        (15_140, 1444),
        (0, 100),
        (478, 0),
        (478, 5000),
        (1000, 4_000_000),
    ] {
        for refuses_bursts in [None, Some(7), Some(1)] {
            let mut scene = Scene::new(FileServer::with("@PARAM/param.pck", &content(len)));
            scene.server.quirks = Quirks {
                refuses_bursts,
                estimate,
                ..Quirks::default()
            };
            scene.read("@PARAM/param.pck", None);
            assert_eq!(scene.events, [FtpEvent::Complete(len as u32)]);
            assert!(scene.file == content(len));
        }
    }
}

#[test]
fn other_sizes_and_refusals_fail_and_leave_nothing_open() {
    let mut scene = Scene::new(FileServer::with("a", &content(5000)));
    scene.read("b", None);
    assert_eq!(*scene.last(), failed(FtpNak::NotFound));
    scene.read("a", Some(GapMap::new(6000)));
    assert_eq!(*scene.last(), FtpEvent::Failed(FtpFault::OtherSize(5000)));
    assert!(!scene.server.is_open());
    scene.server.quirks.estimate = 1000;
    scene.read("a", Some(GapMap::new(6000)));
    assert!(matches!(
        scene.last(),
        FtpEvent::Failed(FtpFault::OtherSize(_))
    ));
    scene.server.quirks = Quirks {
        refuses_from: Some(2500),
        ..Quirks::default()
    };
    scene.file.clear();
    scene.read("a", Some(GapMap::new(5000)));
    assert_eq!(*scene.last(), failed(FtpNak::Fail));
    assert!(scene.file.len() >= 2390 && scene.file == content(scene.file.len()));
    assert!(!scene.server.is_open());
    for path in [String::new(), "a\0b".to_owned(), "x".repeat(239)] {
        scene.read(&path, None);
        assert_eq!(*scene.last(), FtpEvent::Failed(FtpFault::BadPath));
    }
    scene.server.quirks.is_silent = true;
    let took = scene.read("a", None);
    assert_eq!(*scene.last(), FtpEvent::Failed(FtpFault::Silent));
    assert!(took < Duration::from_secs(15), "{took:?}");
}

#[test]
fn a_busy_server_is_asked_again_later() {
    for (busy_for, last) in [
        (1, FtpEvent::Complete(500)),
        (2, FtpEvent::Complete(500)),
        (99, failed(FtpNak::InvalidSession)),
    ] {
        let mut scene = Scene::new(FileServer::with("a", &content(500)));
        scene.server.quirks.busy_for = busy_for;
        scene.read("a", None);
        assert_eq!(*scene.last(), last);
    }
    // A file that an earlier run of the program has left open.
    let mut scene = Scene::new(FileServer::with("a", &content(500)));
    scene.client.ask(FtpTask::Read {
        path: "a".to_owned(),
        gaps: None,
    });
    while !scene.server.is_open() {
        scene.step();
    }
    scene.client.forget();
    scene.on_the_way.clear();
    scene.read("a", None);
    assert_eq!(*scene.last(), FtpEvent::Complete(500));
}

#[test]
fn a_server_that_forgets_the_file_is_asked_to_open_it_again() {
    let mut scene = Scene::new(FileServer::with("a", &content(200_000)));
    scene.server.quirks.forgets_after = Some(600);
    scene.read("a", Some(GapMap::new(200_000)));
    assert_eq!(*scene.last(), FtpEvent::Complete(200_000));
    assert!(scene.file == content(200_000));
    let opened = scene.server.carried_out.iter().filter(|it| **it == 4);
    assert_eq!(opened.count(), 2);
}

#[test]
fn a_server_may_number_its_sessions_and_end_bursts_without_a_word() {
    let mut scene = Scene::new(FileServer::with("a", &content(200_000)));
    scene.server.quirks = Quirks {
        session: Some(0),
        ends_without_word: true,
        ..Quirks::default()
    };
    let took = scene.read("a", None);
    assert_eq!(*scene.last(), FtpEvent::Complete(200_000));
    assert!(scene.file == content(200_000));
    assert!(took < Duration::from_secs(4), "{took:?}");
}

#[test]
fn folders_are_listed_packet_by_packet() {
    let mut scene = Scene::new(FileServer::default());
    let names: Vec<String> = (0..100).map(|it| format!("{it:08}.BIN")).collect();
    for name in &names {
        let path = format!("logs/{name}");
        scene.server.files.insert(path, content(10));
    }
    let folder = "logs".to_owned();
    scene.run(FtpTask::List { folder });
    let FtpEvent::Listed(entries) = scene.last() else {
        panic!("{:?}", scene.events);
    };
    assert!(entries.iter().map(|it| &it.name).eq(&names));
    assert!(entries.iter().all(|it| it.size == Some(10)));
    let folder = "nowhere".to_owned();
    scene.run(FtpTask::List { folder });
    assert_eq!(*scene.last(), failed(FtpNak::NotFound));
}

#[test]
fn check_sums_are_asked_for_without_opening() {
    let mut scene = Scene::new(FileServer::with("a", b"123456789"));
    let task = FtpTask::Checksum {
        path: "a".to_owned(),
        size: 9,
    };
    scene.run(task.clone());
    assert_eq!(*scene.last(), FtpEvent::Checksum(0x2DFD_2D88));
    scene.server.quirks.sums = Sums::None;
    scene.run(task);
    assert_eq!(*scene.last(), failed(FtpNak::UnknownCommand));
}

#[test]
fn a_task_that_is_cancelled_says_no_more_and_makes_room() {
    let mut scene = Scene::new(FileServer::with("a", &content(900_000)));
    let read = FtpTask::Read {
        path: "a".to_owned(),
        gaps: None,
    };
    let first = scene.client.ask(read.clone());
    let waiting = scene.client.ask(read);
    while scene.file.len() < 50_000 {
        scene.step();
    }
    scene.client.cancel(waiting);
    scene.client.cancel(first);
    let before = scene.file.len();
    while scene.client.is_busy() {
        scene.step();
    }
    assert_eq!((scene.file.len(), &scene.events[..]), (before, &[][..]));
    // The server finishes its burst before it closes the file.
    assert!(!scene.server.is_open());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// As long as some packets arrive, the received file is correct, whatever is lost, duplicated or late.
    #[test]
    fn a_file_survives_the_channel(
        seed in any::<u64>(),
        // With more losses, sometimes nothing at all arrives for as long as the client waits.
        loss in 0.0..0.2,
        doubling in 0.0..0.3,
        delay in 0u32..20,
        len in 0usize..150_000,
        rate in 1usize..20,
        ends_without_word in any::<bool>(),
        refuses_bursts in prop_oneof![3 => Just(None), 1 => Just(Some(7u8))],
        session in prop_oneof![Just(None), Just(Some(0u8))],
    ) {
        // Without bursts, the transfer takes longer.
        let len = if refuses_bursts.is_some() { len / 8 } else { len };
        let mut scene = Scene::new(FileServer::with("logs/1", &content(len)));
        scene.server.quirks = Quirks { refuses_bursts, ends_without_word, session, ..Quirks::default() };
        scene.channel = Channel { loss, doubling, delay };
        scene.random = ChaCha8Rng::seed_from_u64(seed);
        scene.rate = rate;
        scene.read("logs/1", Some(GapMap::new(len as u32)));
        prop_assert_eq!(&scene.events, &[FtpEvent::Complete(len as u32)]);
        prop_assert!(scene.file == content(len));
    }

    /// A hostile server can end a task, but never writes outside the file, and never blocks the client forever.
    #[test]
    fn hostile_answers_do_no_harm(seed in any::<u64>(), size in 0u32..100_000, copies in any::<bool>()) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut client = FtpClient::default();
        let path = "a".to_owned();
        let gaps = copies.then(|| GapMap::new(size));
        client.ask(FtpTask::Read { path: path.clone(), gaps });
        client.ask(FtpTask::List { folder: path.clone() });
        client.ask(FtpTask::Checksum { path, size: 0 });
        let mut now = Duration::ZERO;
        let mut opened = size;
        let mut last: Option<FtpPayload> = None;
        while client.is_busy() {
            now += STEP;
            prop_assert!(now < Duration::from_secs(3600));
            let mut answer = [0; 251];
            random.fill_bytes(&mut answer);
            // Most answers match the request in some of their fields.
            if let Some(request) = &last {
                let number = u16::from_le_bytes([request[0], request[1]]);
                let number = number.wrapping_add(1 + random.random_range(0..3));
                answer[..2].copy_from_slice(&number.to_le_bytes());
                answer[5] = request[3];
                if random.random_bool(0.9) {
                    answer[2] = request[2];
                    answer[3] = if random.random_bool(0.95) { 128 } else { 129 };
                    answer[8..12].copy_from_slice(&random.random_range(0..size.max(1) * 2).to_le_bytes());
                }
                if request[3] == 4 {
                    answer[4] = 4;
                    opened = if copies { size } else { random.random_range(0..200_000) };
                    answer[12..16].copy_from_slice(&opened.to_le_bytes());
                }
            }
            let step = client.step(random.random_bool(0.8).then_some(&answer), Duration::ZERO, now);
            last = step.requests.last().copied().or(last);
            for (_, event) in step.events {
                if let FtpEvent::Bytes(bytes) = event {
                    prop_assert!(bytes.range().end <= opened.max(200_000));
                    prop_assert!(gaps_fit(copies, size, &bytes));
                }
            }
        }
    }
}

fn gaps_fit(is_exact: bool, size: u32, bytes: &FileBytes) -> bool {
    bytes.bytes.len() <= 239 && (!is_exact || bytes.range().end <= size)
}
