//! Vehicles with PX4: conversations with a scripted stand-in, first with a session alone, then with the whole program
//! over a UDP socket. No PX4 takes part.

use std::io::Write as _;
use std::net::UdpSocket;
use std::process::{Command as Process, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;
use sortie::commands::{
    ArmingCommand, Command, Destination, FlightCommand, Heading, MotionCommand,
};
use sortie::geo::LatLon;
use sortie::language;
use sortie::ledger::{EntryId, RowState, RowUpdate};
use sortie::session::{Report, Session, VehicleCommand};
use sortie::wire::{Content, Decoder, Encoder, Outgoing};

use crate::terminal::{home_variables, program};

mod parameters;
mod stand_in;
mod velocity;

use stand_in::{HOME_E7, Px4, STEP_MS, Unwilling};

/// A session and a stand-in, which hear each other at once.
struct Talk {
    px4: Px4,
    session: Session,
    encoder: Encoder,
    decoder: Decoder,
    now: Duration,
    rows: Vec<RowUpdate>,
    notices: Vec<String>,
}

impl Talk {
    fn new() -> Self {
        let mut talk = Self {
            px4: Px4::new(),
            session: Session::new(1, 1, Duration::ZERO),
            encoder: Encoder::new(1, 1),
            decoder: Decoder::new(),
            now: Duration::ZERO,
            rows: Vec::new(),
            notices: Vec::new(),
        };
        talk.pass(3);
        talk
    }

    fn pass(&mut self, seconds: u32) {
        for _ in 0..seconds * 1000 / STEP_MS {
            self.now += Duration::from_millis(STEP_MS.into());
            let said = self.px4.step();
            self.carry(said);
            self.session.poll(self.now);
            self.settle();
        }
    }

    /// Carries messages of the stand-in to the session.
    fn carry(&mut self, said: Vec<MavMessage>) {
        for message in said {
            let mut bytes = Vec::new();
            self.encoder.encode_message(&message, &mut bytes);
            self.decoder.push(&bytes);
            while let Some(frame) = self.decoder.next_frame() {
                self.session.receive(&frame, self.now);
            }
        }
    }

    /// Carries answers until both are silent.
    fn settle(&mut self) {
        loop {
            for report in self.session.take_reports() {
                match report {
                    Report::Row(row) => self.rows.push(row),
                    Report::Notice(notice) => self.notices.push(notice.text.to_string()),
                    Report::Folder(_) => {}
                }
            }
            let sent = self.session.take_outgoing();
            if sent.is_empty() {
                return;
            }
            for message in sent {
                if let Outgoing::Message(message) = message {
                    let answers = self.px4.hear(&message);
                    self.carry(answers);
                }
            }
        }
    }

    fn order(&mut self, entry: u32, verb: &str, command: Command) {
        let verb = language::verb(verb).expect("a verb");
        let order = VehicleCommand::new(EntryId(entry), verb, command);
        self.session.order(order, self.now);
        self.settle();
    }

    fn last(&self, entry: u32) -> Option<RowState> {
        let rows = self.rows.iter().rev();
        let mut own = rows.filter(|row| row.entry == EntryId(entry));
        own.next().map(|row| row.state)
    }

    fn explanation(&self, entry: u32) -> String {
        let rows = self.rows.iter().rev();
        let mut own = rows.filter(|row| row.entry == EntryId(entry));
        own.find_map(|row| row.explanation.as_ref().map(ToString::to_string))
            .unwrap_or_default()
    }

    fn mode(&self) -> String {
        self.session.vehicle().mode_name().unwrap_or_default()
    }
}

/// A place 100 m north of home.
fn north() -> LatLon {
    LatLon::new(
        f64::from(HOME_E7.0) / 1e7 + 0.0009,
        f64::from(HOME_E7.1) / 1e7,
    )
}

fn takeoff(altitude_m: f64) -> Command {
    Command::Flight(FlightCommand::Takeoff { altitude_m })
}

#[test]
fn a_flight_with_px4_shows_each_effect() {
    let mut talk = Talk::new();
    assert_eq!(talk.mode(), "AUTO.LOITER");
    assert!(talk.session.vehicle().ready_to_arm());
    talk.order(1, "takeoff", takeoff(10.0));
    assert_eq!(talk.last(1), Some(RowState::Refused), "it is not armed");
    talk.order(2, "arm", Command::Arming(ArmingCommand::Arm));
    talk.order(3, "takeoff", takeoff(10.0));
    talk.pass(1);
    assert_eq!(talk.mode(), "AUTO.TAKEOFF");
    assert_eq!(talk.last(2), Some(RowState::Done));
    assert_eq!(talk.last(3), Some(RowState::Accepted));
    talk.pass(5);
    assert_eq!(
        (talk.mode(), talk.last(3)),
        ("AUTO.LOITER".into(), Some(RowState::Done))
    );
    assert!((talk.px4.height_m() - 10.0).abs() < 0.1);
    let goto = MotionCommand::Goto {
        destination: Destination::Global {
            at_point: north(),
            altitude_m: Some(15.0),
        },
        heading: Heading::Auto,
    };
    talk.order(4, "goto", Command::Motion(goto));
    talk.pass(3);
    assert_eq!(talk.last(4), Some(RowState::Accepted));
    talk.pass(15);
    assert_eq!(talk.last(4), Some(RowState::Done));
    assert!((talk.px4.height_m() - 15.0).abs() < 0.1);
    talk.order(5, "hold", Command::Flight(FlightCommand::Hold));
    talk.pass(1);
    assert_eq!(talk.last(5), Some(RowState::Done));
    talk.order(6, "rtl", Command::Flight(FlightCommand::ReturnToLaunch));
    talk.pass(2);
    assert_eq!(talk.mode(), "AUTO.RTL");
    talk.pass(20);
    assert_eq!(
        talk.last(6),
        Some(RowState::Done),
        "{}",
        talk.explanation(6)
    );
    assert!(
        !talk.px4.armed && talk.px4.faults.is_empty(),
        "{:?}",
        talk.px4.faults
    );
}

#[test]
fn another_mode_ends_a_landing_but_disarming_does_not() {
    let mut talk = Talk::new();
    talk.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    talk.order(2, "takeoff", takeoff(8.0));
    talk.pass(6);
    talk.order(3, "land", Command::Flight(FlightCommand::Land));
    talk.pass(1);
    // A pilot takes over.
    talk.px4.mode = (3, 0);
    talk.pass(1);
    assert_eq!(talk.last(3), Some(RowState::Overtaken));
    assert_eq!(talk.explanation(3), "by POSCTL");
    talk.order(4, "land", Command::Flight(FlightCommand::Land));
    talk.pass(10);
    assert_eq!(
        (talk.mode(), talk.last(4)),
        ("AUTO.LOITER".into(), Some(RowState::Done))
    );
}

#[test]
fn a_refused_arming_names_the_reasons_of_px4() {
    let mut talk = Talk::new();
    talk.px4.unwilling = Some(Unwilling::Arm);
    talk.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    talk.pass(8);
    assert_eq!(talk.last(1), Some(RowState::Refused));
    let why = talk.explanation(1);
    assert_eq!(
        why.matches("Preflight Fail: ekf2 missing data").count(),
        1,
        "{why}"
    );
    assert!(why.contains("event 17001234 (critical)"), "{why}");
    assert!(!why.contains("data?"), "{why}");
    assert_eq!(talk.session.vehicle().prearm, ["ekf2 missing data"]);
}

#[test]
fn lost_events_are_requested_again_and_each_is_shown_once() {
    let mut talk = Talk::new();
    let first = talk.px4.event(101, 6);
    talk.carry(vec![first.clone(), first]);
    // Two are lost, one of them the newest.
    talk.px4.event(102, 4);
    let third = talk.px4.event(103, 3);
    talk.carry(vec![third]);
    talk.px4.event(104, 2);
    talk.px4.event(105, 8);
    talk.pass(2);
    let heard: Vec<&str> = talk.notices.iter().map(String::as_str).collect();
    let events: Vec<&str> = heard
        .into_iter()
        .filter(|it| it.contains("event"))
        .collect();
    assert_eq!(
        events,
        [
            "event 101 (info)",
            "event 103 (error)",
            "event 102 (warning)",
            "event 104 (critical)",
        ]
    );
}

/// Serves a stand-in on a UDP socket until the flag is set.
fn serve(socket: &UdpSocket, ends: &AtomicBool) -> Px4 {
    let wait = Duration::from_millis(STEP_MS.into()) / 10;
    socket.set_read_timeout(Some(wait)).expect("a socket");
    let (mut px4, mut encoder, mut decoder) = (Px4::new(), Encoder::new(1, 1), Decoder::new());
    // Its time runs up to ten times as fast as the console's.
    px4.longest_gap_ms *= 10;
    let mut console = None;
    let mut buffer = [0; 2048];
    while !ends.load(Ordering::Relaxed) {
        let mut said = Vec::new();
        if let Ok((length, from)) = socket.recv_from(&mut buffer) {
            console = Some(from);
            decoder.push(&buffer[..length]);
            while let Some(frame) = decoder.next_frame() {
                if let Content::Message(message) = &frame.content {
                    said.extend(px4.hear(message));
                }
            }
        } else {
            said = px4.step();
        }
        for message in said {
            let mut bytes = Vec::new();
            encoder.encode_message(&message, &mut bytes);
            if let Some(console) = console {
                // An error means that the console has ended.
                drop(socket.send_to(&bytes, console));
            }
        }
    }
    px4
}

#[test]
fn the_program_flies_a_px4_over_udp() {
    let socket = UdpSocket::bind("127.0.0.1:0").expect("a port");
    let port = socket.local_addr().expect("bound").port();
    let ends = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&ends);
    let server = thread::spawn(move || serve(&socket, &seen));
    let folder = tempfile::tempdir().expect("a folder");
    let command = program();
    let mut child = Process::new(&command[0])
        .args(&command[1..])
        .args(["connect", &format!("udp:127.0.0.1:{port}"), "--plain"])
        .envs(home_variables(folder.path()))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    let lines = "1 arm\n1 takeoff 10\n1 mode auto.loiter\n1 velocity n 1 e 0 d 0 for 2s\n1 land\n";
    let mut input = child.stdin.take().expect("it is piped");
    input.write_all(lines.as_bytes()).expect("read");
    drop(input);
    let output = child.wait_with_output().expect("it ends");
    ends.store(true, Ordering::Relaxed);
    let px4 = server.join().expect("the stand-in ends");
    let said = String::from_utf8_lossy(&output.stdout);
    let wrong = String::from_utf8_lossy(&output.stderr);
    for expected in [
        "1 arm: 1 effect seen",
        "1 takeoff 10: 1 effect seen",
        "AUTO.TAKEOFF",
        "1 mode auto.loiter: 1 effect seen",
        "1 velocity n 1 e 0 d 0 for 2s: 1 effect seen",
        "1 land: 1 effect seen",
    ] {
        assert!(said.contains(expected), "{expected:?} in:\n{said}{wrong}");
    }
    assert!(!px4.armed && px4.faults.is_empty(), "{:?}", px4.faults);
}
