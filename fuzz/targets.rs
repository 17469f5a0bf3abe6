//! Every reader of bytes from outside the program, as functions for fuzzing. None may panic, hang, or take memory
//! without bound, whatever the bytes are.
//!
//! `fuzz_targets/` runs them with libFuzzer, guided by coverage; `tests/it/fuzzing.rs` runs them in `cargo test` with
//! damaged seeds. docs/contributing.md describes both.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::io::{ErrorKind, Read as _, Write as _};
use std::net::{Shutdown, SocketAddr, TcpStream};
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use sortie::api::Call;
use sortie::campaign::{MissionCourse, Offer};
use sortie::class::protocol::{self, DeskMessage, SeatMessage};
use sortie::class::{ConnectionId, Desk, SeatLine};
use sortie::dataflash::{JoinedLog, LoggedFlight};
use sortie::exam_plan::ExamFile;
use sortie::exercise::Exercise;
use sortie::geo::LatLon;
use sortie::grading::Rubric;
use sortie::hangar::service::{self, ServiceBounds, ServiceSetup};
use sortie::hangar::{Hangar, HangarLimits, HangarSetup, HangarToken, Restart};
use sortie::inspector::{self, FieldReading};
use sortie::language::{Context, Script, parse};
use sortie::lesson_plan::{Lesson, LessonMissions, LessonSetting};
use sortie::link::{TlogPiece, TlogReader, TlogSalvage};
use sortie::metadata::{EventDocuments, general, unpacked};
use sortie::mission::Mission;
use sortie::mission::record::{Stored, WithoutEnd};
use sortie::parameters::ParameterDocuments;
use sortie::plan::check::{CheckOptions, check};
use sortie::plan::generate::source::areas;
use sortie::plan::{FileFormat, ReadOptions};
use sortie::record::{Journal, StoredInputs};
use sortie::review::Review;
use sortie::session::Session;
use sortie::sim::mavlink::dialects::ardupilotmega::MavMessage;
use sortie::sim::mavlink::{Message as _, calculate_crc};
use sortie::sim::{STEP, Start, World, WorldConfig};
use sortie::text::Locale;
use sortie::wire::{Anatomy, Decoder};
use tokio_util::sync::CancellationToken;

/// A reader of foreign bytes.
pub struct Target {
    /// The name of its binary in `fuzz_targets/` and of its folder in `seeds/`.
    pub name: &'static str,
    pub run: fn(&[u8]),
}

pub const TARGETS: [Target; 13] = [
    Target {
        name: "frames",
        run: frames,
    },
    Target {
        name: "vehicle",
        run: vehicle,
    },
    Target {
        name: "simulator",
        run: simulator,
    },
    Target {
        name: "tlog",
        run: tlog,
    },
    Target {
        name: "dataflash",
        run: dataflash,
    },
    Target {
        name: "plan",
        run: plan,
    },
    Target {
        name: "mission",
        run: mission,
    },
    Target {
        name: "journal",
        run: journal,
    },
    Target {
        name: "line",
        run: line,
    },
    Target {
        name: "documentation",
        run: documentation,
    },
    Target {
        name: "teaching",
        run: teaching,
    },
    Target {
        name: "class",
        run: class,
    },
    Target {
        name: "http",
        run: http,
    },
];

/// What a vehicle documents about itself: files of any kind, compressed or not.
pub fn documentation(bytes: &[u8]) {
    let Ok(text) = unpacked(bytes.to_vec()) else {
        return;
    };
    let parameters = ParameterDocuments::read(&text).documents;
    for name in ["RTL_ALT", "COM_RC_IN_MODE"] {
        if let Some(document) = parameters.get(name) {
            black_box((document.about(4.0), document.doubt(-1.0)));
        }
    }
    drop(black_box(general(&text)));
    if let Ok(events) = EventDocuments::read(&text) {
        for own in [1, 100, 101, 102, 1234] {
            black_box(events.documents.text(1 << 24 | own, &[7; 40]));
        }
    }
}

/// Bytes of a link: framing, and the decoding of every field for the inspector.
pub fn frames(bytes: &[u8]) {
    let mut decoder = Decoder::new();
    // The first byte is the size of the pieces in which the bytes arrive.
    let Some((&size, bytes)) = bytes.split_first() else {
        return;
    };
    for piece in bytes.chunks(usize::from(size).max(1)) {
        decoder.push(piece);
        while let Some(frame) = decoder.next_frame() {
            inspect(decoder.bytes_of(&frame));
        }
    }
    while let Some(frame) = decoder.next_frame_at_end() {
        inspect(decoder.bytes_of(&frame));
    }
}

fn inspect(frame: &[u8]) {
    if let Some(anatomy) = Anatomy::of(frame) {
        let reading = inspector::read(&anatomy);
        let mut figures = reading.values.iter().filter_map(FieldReading::number);
        assert!(figures.all(f64::is_finite), "only numbers are drawn");
    }
}

/// Messages of a vehicle that is not to be trusted: the conversation answers them and keeps its model.
pub fn vehicle(bytes: &[u8]) {
    let mut now = Duration::from_secs(1);
    let mut session = Session::new(1, 1, now);
    session.fetch_parameters(now);
    for message in messages(bytes) {
        let mut decoder = Decoder::new();
        decoder.push(&message.frame(1, 1));
        while let Some(frame) = decoder.next_frame() {
            session.receive(&frame, now);
        }
        now += message.later;
        session.poll(now);
        drop((session.take_outgoing(), session.take_reports()));
    }
}

/// Messages of a ground station that is not to be trusted, to a simulated vehicle.
pub fn simulator(bytes: &[u8]) {
    let start = Start {
        at: LatLon::new(50.45, 30.52),
        altitude_amsl_m: 120.0,
        heading_deg: 0.0,
    };
    let mut world = World::new(&WorldConfig::row(1, start));
    let port = world.connect(0);
    let mut output = Vec::new();
    for message in messages(bytes) {
        world.receive(port, &message.frame(255, 190));
        let steps = (message.later.as_millis() / STEP.as_millis()).min(20);
        for _ in 0..=steps {
            world.step();
        }
        output.clear();
        world.take_output(port, &mut output);
    }
    assert!(
        world.truth(0).at.lat_deg.is_finite(),
        "the vehicle is somewhere"
    );
}

/// A message of the dialect with any payload, and the time until the next one.
struct Sent<'a> {
    id: u32,
    payload: &'a [u8],
    later: Duration,
}

/// The ids of the messages that the dialect has.
static IDS: LazyLock<Vec<u32>> = LazyLock::new(|| {
    let known = |id: &u32| MavMessage::default_message_from_id(*id).is_some();
    (0..70_000).filter(known).collect()
});

/// Reads fuzzed bytes as messages: each has a header of four bytes (id, id, time in 4 ms, length) and its payload.
/// Messages have correct checksums later, because random bytes would hardly ever get past them.
fn messages(mut bytes: &[u8]) -> impl Iterator<Item = Sent<'_>> {
    std::iter::from_fn(move || {
        let (&[low, high, later, length], rest) = bytes.split_first_chunk()?;
        let (payload, rest) = rest.split_at(usize::from(length).min(rest.len()));
        bytes = rest;
        let index = usize::from(u16::from_le_bytes([low, high]));
        Some(Sent {
            id: IDS[index % IDS.len()],
            payload,
            later: Duration::from_millis(u64::from(later) * 4),
        })
    })
    .take(64)
}

impl Sent<'_> {
    /// The message as a MAVLink 2 frame.
    fn frame(&self, system: u8, component: u8) -> Vec<u8> {
        let [low, middle, high, _] = self.id.to_le_bytes();
        let length = self.payload.len() as u8;
        let mut frame = vec![0xfd, length, 0, 0, 0, system, component, low, middle, high];
        frame.extend_from_slice(self.payload);
        let crc = calculate_crc(&frame[1..], MavMessage::extra_crc(self.id));
        frame.extend_from_slice(&crc.to_le_bytes());
        frame
    }
}

/// A recording of frames, read strictly and past damage.
pub fn tlog(bytes: &[u8]) {
    black_box(TlogReader::new(bytes).map_while(Result::ok).count());
    let pieces: Result<Vec<TlogPiece>, _> = TlogSalvage::new(bytes).collect();
    let length = |piece: &TlogPiece| match piece {
        TlogPiece::Record(record) => 8 + record.bytes.len(),
        TlogPiece::Damage { len, .. } => *len as usize,
    };
    // An error is a cut last record.
    if let Ok(pieces) = pieces {
        let covered: usize = pieces.iter().map(length).sum();
        assert_eq!(
            covered,
            bytes.len(),
            "every byte is in a record or is damage"
        );
    }
}

/// A log from the memory of an autopilot.
pub fn dataflash(bytes: &[u8]) {
    drop(LoggedFlight::read(bytes));
}

/// A plan, a fence or rally points in any format. What was read can be checked, and written in every format.
pub fn plan(bytes: &[u8]) {
    match sortie::plan::read(bytes, &ReadOptions::default()) {
        Ok(loaded) => {
            drop(check(&loaded.document, &CheckOptions::default()));
            drop(areas(&loaded.document));
            for format in [FileFormat::QgcPlan, FileFormat::Kml, FileFormat::GeoJson] {
                drop(sortie::plan::write(&loaded.document, format));
            }
        }
        Err((text, faults)) => {
            assert!(!faults.is_empty(), "a refusal has a reason");
            for fault in faults {
                assert!(
                    text.get(fault.span.clone()).is_some(),
                    "{fault:?} is in the text"
                );
            }
        }
    }
}

/// A mission file; one that is accepted can be listed, checked and flown.
pub fn mission(bytes: &[u8]) {
    let source = String::from_utf8_lossy(bytes);
    let mission = match Mission::parse(&source) {
        Ok(mission) => mission,
        Err(faults) => {
            assert!(!faults.is_empty(), "a refusal has a reason");
            for fault in faults {
                drop(fault.one_line("m", &source));
            }
            return;
        }
    };
    drop((mission.listing(), mission.places_to_name(), mission.check()));
    let mut exercise = Exercise::new(Arc::new(mission), 1, Script::default(), Vec::new());
    for _ in 0..5 {
        exercise.step();
    }
}

/// The text files of a record: the journal, the mission's record, the simulator's inputs, a joined log and a review.
pub fn journal(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    if let Ok(journal) = Journal::read(&text) {
        black_box((journal.faults().count(), journal.bookmarks().count()));
    }
    if let Ok(stored) = Stored::read(&text) {
        drop(stored.rescore(WithoutEnd::Left));
    }
    if let Ok(inputs) = StoredInputs::read(&text) {
        black_box((
            inputs.is_whole(),
            inputs.is_cut(),
            inputs.lasts(),
            inputs.has_fingerprints(),
        ));
    }
    drop((JoinedLog::read(&text), Review::read(&text)));
}

/// What is typed, or sent by another program: a line of the grammar, a script, a request of the interface for programs.
pub fn line(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let context = Context::default();
    for line in text.lines() {
        if let Err(fault) = parse(line, &context) {
            drop(fault.one_line("line", line));
        }
        drop(Call::read(line, &Locale::default()));
    }
    if let Err(faults) = Script::parse(&text, &context) {
        assert!(!faults.is_empty(), "a refusal has a reason");
    }
}

/// What an instructor writes: a lesson plan, an exam, a rubric.
pub fn teaching(bytes: &[u8]) {
    let source = String::from_utf8_lossy(bytes);
    let setting = LessonSetting {
        missions: &LESSON_MISSIONS,
        locale: &Locale::default(),
    };
    let results = [
        Lesson::parse("lesson", &source, &setting).map(drop),
        ExamFile::parse("exam", &source, &COURSE).map(drop),
        Rubric::parse("rubric", &source).map(drop),
    ];
    for faults in results.into_iter().filter_map(Result::err) {
        assert!(!faults.is_empty(), "a refusal has a reason");
        for fault in faults {
            drop(fault.one_line("file", &source));
        }
    }
}

/// A mission that lessons and exams may name.
const FIRST_FLIGHT: &str = include_str!("../missions/00-first-flight.toml");
static LESSON_MISSIONS: LazyLock<LessonMissions> =
    LazyLock::new(|| LessonMissions::of([FIRST_FLIGHT]));
static COURSE: LazyLock<MissionCourse> = LazyLock::new(|| {
    let mission = Mission::parse(FIRST_FLIGHT).expect("a mission that ships");
    MissionCourse::new([Offer::of(&mission)])
});

/// Lines of a class: those of a seat that is not to be trusted, which the desk takes in, and those of a false desk.
pub fn class(bytes: &[u8]) {
    let mut desk = Desk::new(1, "class".into(), "petro".into());
    for (line, second) in bytes.split(|&byte| byte == b'\n').zip(0..) {
        if let Ok(message) = protocol::read::<SeatMessage>(line) {
            let now = Duration::from_secs(second);
            drop(desk.hear(ConnectionId(1), "anna", message, now));
            black_box(desk.board());
        }
        if let Ok(message) = protocol::read::<DeskMessage>(line) {
            let mut connection = SeatLine::default();
            connection.hear(&message);
        }
    }
    assert!(desk.seats().len() <= 1, "a connection has one seat");
}

/// A client's bytes on a connection to the hangar's service: requests, or anything else. The service answers with HTTP
/// or closes the connection. It can start no programs here.
pub fn http(bytes: &[u8]) {
    let mut connection = TcpStream::connect(*SERVICE).expect("the service listens");
    let patience = Some(Duration::from_secs(5));
    connection.set_read_timeout(patience).expect("a timeout");
    // The service may close the connection before it has read everything.
    let sent = connection.write_all(bytes);
    if sent.is_err() || connection.shutdown(Shutdown::Write).is_err() {
        return;
    }
    let mut answer = Vec::new();
    match connection.read_to_end(&mut answer) {
        Ok(_) => assert!(
            answer.is_empty() || answer.starts_with(b"HTTP/1."),
            "{answer:?}"
        ),
        Err(error) => assert_eq!(error.kind(), ErrorKind::ConnectionReset, "{error}"),
    }
}

/// The address of a service in this process, for as long as it runs.
static SERVICE: LazyLock<SocketAddr> = LazyLock::new(|| {
    let (tell, told) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        let runtime = tokio::runtime::Runtime::new().expect("a runtime");
        runtime.block_on(async {
            let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await;
            let listener = listener.expect("a port");
            let _ = tell.send(listener.local_addr().expect("an address"));
            let folder = tempfile::tempdir().expect("a folder");
            let limits = HangarLimits::default();
            let hangar = Hangar::open(HangarSetup {
                programs: BTreeMap::new(),
                folder: folder.path().to_owned(),
                limits,
                restart: Restart::Never,
                sortie: "no-program-is-started".into(),
            });
            let setup = ServiceSetup {
                token: HangarToken::random().expect("random numbers"),
                require_token: false,
                expose: false,
                bounds: ServiceBounds::default(),
                owner: |_, _| Some(nix::unistd::geteuid().as_raw()),
                programs: Vec::new(),
                restart: Restart::Never,
                limits,
            };
            let hangar = hangar.expect("an empty folder");
            service::serve(listener, hangar, setup, CancellationToken::new()).await
        })
    });
    told.recv().expect("the service starts")
});
