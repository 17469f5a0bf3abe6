//! Strangers on the network, and trainees with the certificates of their seats, but other programs.

use std::sync::Arc;
use std::time::Duration;

use sortie_class::protocol::{DeskMessage, Hello, SeatMessage, VERSION};
use tokio::sync::mpsc;
use tokio::time::timeout;
use zenoh::pubsub::Subscriber;
use zenoh::sample::Locality;

use super::*;
use crate::fault::{ClassFault, NetworkFault, StartFault};
use crate::network::frame::{Frame, FrameKind, fresh_number, signer};
use crate::ports::{DeskArrival, DeskPort, Outbox, SeatArrival, SeatPort};
use crate::tests::{found, opened};

/// How long a test waits for what must happen.
const PATIENCE: Duration = Duration::from_secs(30);
/// How long a test waits for what must not happen, after it has seen that the way there works.
const MOMENT: Duration = Duration::from_millis(300);

/// What was received on some keys.
pub struct Ear {
    pub heard: mpsc::UnboundedReceiver<(String, Vec<u8>)>,
    _subscriber: Subscriber<()>,
}

impl Ear {
    pub async fn new(session: &Session, key: &str) -> Self {
        let (sender, heard) = mpsc::unbounded_channel();
        let note = move |sample: zenoh::sample::Sample| {
            let key = sample.key_expr().as_str().to_owned();
            drop(sender.send((key, sample.payload().to_bytes().into_owned())));
        };
        let subscriber = session.declare_subscriber(key.to_owned()).callback(note);
        // A session also hears itself.
        let subscriber = subscriber.allowed_origin(Locality::Remote);
        Self {
            heard,
            _subscriber: subscriber.await.expect("declared"),
        }
    }

    pub async fn next(&mut self) -> (String, Vec<u8>) {
        let next = timeout(PATIENCE, self.heard.recv()).await;
        next.expect("something is heard").expect("the session runs")
    }

    pub fn is_silent(&mut self) -> bool {
        self.heard.try_recv().is_err()
    }
}

/// A program of one's own with the certificate of a seat.
pub async fn session(line: &JoinLine) -> Session {
    let config = config::of_seat(line, &line.addresses[0]).expect("settings");
    zenoh::open(config).await.expect("it connects")
}

fn hello() -> SeatMessage {
    SeatMessage::Hello(Hello {
        protocol: VERSION,
        sitting: 1,
        name: None,
    })
}

/// A greeting on the keys of a seat, signed by somebody.
fn greeting(seat: &str, number: &str, by: &JoinLine) -> (String, Vec<u8>) {
    let key = Channel::new("9-A", seat, number).up;
    let frame = Frame {
        kind: FrameKind::Hello,
        number: 0,
        taken: 0,
        body: Vec::new(),
    };
    let bytes = frame.seal(&signer(&by.key).expect("a key"), &key);
    (key, bytes)
}

fn number() -> String {
    fresh_number().expect("a number")
}

async fn put(session: &Session, (key, bytes): (String, Vec<u8>)) {
    session.put(key, bytes).await.expect("it is sent");
}

/// Greets the desk until it opens a connection; returns what the desk calls the seat.
async fn opened_for(
    desk: &mut DeskPort,
    session: &Session,
    greeting: &(String, Vec<u8>),
) -> String {
    let greet = async {
        loop {
            put(session, greeting.clone()).await;
            // The desk drops a greeting while it looks at another one of the same seat.
            if let Ok((_, user, _)) = timeout(MOMENT, opened(desk)).await {
                return user;
            }
        }
    };
    timeout(PATIENCE, greet).await.expect("it is opened")
}

/// Joins, says hello, and hears an answer; returns what must be kept.
pub async fn talk(desk: &mut DeskPort, seat: &mut SeatPort) -> (Outbox, Outbox) {
    let to_desk = found(seat).await;
    let (_, _, to_seat) = opened(desk).await;
    to_desk.send(&hello());
    let arrival = desk.next().await;
    assert!(
        matches!(arrival, Some(DeskArrival::Line { line: Ok(_), .. })),
        "{arrival:?}"
    );
    to_seat.send(&DeskMessage::Here);
    let arrival = seat.next().await;
    assert!(
        matches!(arrival, Some(SeatArrival::Line(Ok(DeskMessage::Here)))),
        "{arrival:?}"
    );
    (to_desk, to_seat)
}

pub async fn refused(seat: &mut SeatPort) -> Arc<ClassFault> {
    let arrival = timeout(PATIENCE, seat.next()).await.expect("an answer");
    match arrival {
        Some(SeatArrival::Refused(fault)) => fault,
        other => panic!("{other:?}"),
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_seat_cannot_listen_to_another() {
    let (_parent, lab) = lab(2);
    let mut desk = open(&lab.desk()).await.expect("it opens");
    let spy = session(&lab.line(2)).await;
    let mut ears = Vec::new();
    for key in [
        "sortie/1/9-A/seat-01/*/down",
        "sortie/1/9-A/seat-01/*/up",
        "sortie/1/9-A/*/*/down",
        "sortie/**",
        "**",
        "@/**",
    ] {
        ears.push((key, Ear::new(&spy, key).await));
    }
    let mut own = Ear::new(&spy, "sortie/1/9-A/seat-02/*/down").await;
    let mut seat = join(lab.line(1));
    let _kept = talk(&mut desk, &mut seat).await;
    // The spy's own way works, and what the other seat was told came before.
    put(&spy, greeting("seat-02", &number(), &lab.line(2))).await;
    own.next().await;
    for (key, ear) in &mut ears {
        while let Ok((of, _)) = ear.heard.try_recv() {
            assert!(of.contains("/seat-02/"), "{of} is heard on {key}");
        }
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_seat_cannot_speak_for_another() {
    let (_parent, lab) = lab(2);
    let mut desk = open(&lab.desk()).await.expect("it opens");
    let thief = session(&lab.line(2)).await;
    // With its own signature, with the stolen key of the other, and without any.
    put(&thief, greeting("seat-01", &number(), &lab.line(2))).await;
    put(&thief, greeting("seat-01", &number(), &lab.line(1))).await;
    let (key, _) = greeting("seat-01", &number(), &lab.line(1));
    put(&thief, (key, b"nonsense".to_vec())).await;
    // With the certificate of the seat, but without its signature.
    let careless = session(&lab.line(1)).await;
    put(&careless, greeting("seat-01", &number(), &lab.line(2))).await;
    // Rightly signed, but no number that a seat draws.
    for number in ["7", &"x".repeat(32), &"A".repeat(32), &"5".repeat(10_000)] {
        put(&careless, greeting("seat-01", number, &lab.line(1))).await;
    }
    // Later greetings are answered, so the others were not overlooked.
    for (session, seat, line) in [(&thief, "seat-02", 2), (&careless, "seat-01", 1)] {
        let right = greeting(seat, &number(), &lab.line(line));
        assert_eq!(opened_for(&mut desk, session, &right).await, seat);
    }
    let more = timeout(MOMENT, opened(&mut desk)).await;
    assert!(more.is_err(), "{more:?}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_seat_cannot_give_orders_to_another() {
    let (_parent, lab) = lab(2);
    let mut desk = open(&lab.desk()).await.expect("it opens");
    let watched = session(&lab.line(1)).await;
    // What reaches the seat's certificate at all: whatever it is, nothing may come from another seat.
    let mut ear = Ear::new(&watched, "sortie/1/9-A/seat-01/*/down").await;
    let mut seat = join(lab.line(1));
    let _to_desk = found(&mut seat).await;
    let (_, _, to_seat) = opened(&mut desk).await;
    let (down, opening) = ear.next().await;
    let attacker = session(&lab.line(2)).await;
    let order = Frame {
        kind: FrameKind::Line,
        number: 1,
        taken: 0,
        body: b"{\"order\":{\"id\":{\"desk\":5,\"number\":1},\"deed\":\"freeze\"}}\n".to_vec(),
    };
    let forged = order.seal(&signer(&lab.line(2).key).expect("a key"), &down);
    put(&attacker, (down.clone(), forged)).await;
    put(&attacker, (down.clone(), opening)).await;
    let publisher = attacker
        .declare_publisher(down.clone())
        .await
        .expect("declared");
    publisher.put("nonsense").await.expect("it is sent");
    // After it, the attacker's own way still works.
    put(&attacker, greeting("seat-02", &number(), &lab.line(2))).await;
    let _own = opened(&mut desk).await;
    to_seat.send(&DeskMessage::Here);
    let arrival = seat.next().await;
    assert!(
        matches!(arrival, Some(SeatArrival::Line(Ok(DeskMessage::Here)))),
        "{arrival:?}"
    );
    let here = ear.next().await;
    let desk_key = lab.line(1).desk_key;
    assert!(
        Frame::open(&here.1, &desk_key, &here.0).is_some(),
        "nothing came before it"
    );
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn seats_are_no_queryables_and_ask_nobody() {
    let (_parent, lab) = lab(2);
    let _desk = open(&lab.desk()).await.expect("it opens");
    let first = session(&lab.line(1)).await;
    let _answers = first
        .declare_queryable("**")
        .callback(|query| drop(query.reply(query.key_expr(), "stolen").wait()))
        .await
        .expect("declared");
    let _token = first
        .liveliness()
        .declare_token("sortie/1/9-A/seat-02/alive")
        .await;
    let second = session(&lab.line(2)).await;
    for key in ["sortie/1/9-A/seat-02/5/up", "**", "@/**"] {
        let replies = second.get(key).timeout(MOMENT);
        let replies = replies
            .allowed_destination(Locality::Remote)
            .await
            .expect("asked");
        let mut answers = 0;
        while let Ok(reply) = replies.recv_async().await {
            answers += usize::from(reply.result().is_ok());
        }
        assert_eq!(answers, 0, "{key}");
    }
    let alive = second
        .liveliness()
        .get("**")
        .timeout(MOMENT)
        .await
        .expect("asked");
    assert!(alive.recv_async().await.is_err());
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn without_a_certificate_nobody_is_let_in() {
    let (_parent, lab) = lab(1);
    let (_other_parent, other) = super::lab(1);
    let mut desk = open(&lab.desk()).await.expect("it opens");
    // A seat of another class of the same name, whose certificate has the same text.
    let stranger = JoinLine {
        desk_certificate: lab.line(1).desk_certificate,
        addresses: lab.line(1).addresses,
        ..other.line(1)
    };
    let mut settings = config::of_seat(&lab.line(1), &lab.listen).expect("settings");
    let name = "transport/link/tls/enable_mtls";
    settings.insert_json5(name, "false").expect("set");
    let without = timeout(PATIENCE, zenoh::open(settings)).await;
    // TLS 1.3 tells a client late that it was refused: the session may open, but nothing goes through it.
    if let Ok(Ok(session)) = &without {
        drop(session.put("sortie/1/9-A/seat-01/5/up", "nonsense").await);
    }
    let mut bytes = tokio::net::TcpStream::connect(&lab.listen)
        .await
        .expect("connected");
    drop(tokio::io::AsyncWriteExt::write_all(&mut bytes, &[0x16; 512]).await);
    let mut refused_seat = join(stranger);
    let fault = refused(&mut refused_seat).await;
    let is_refused = matches!(
        *fault,
        ClassFault::Network(NetworkFault::NotTheDesk(_) | NetworkFault::Unknown { .. })
    );
    assert!(is_refused, "{fault:?}");
    // Who has one is let in all the while.
    let mut seat = join(lab.line(1));
    let _kept = talk(&mut desk, &mut seat).await;
}

/// Joins, however often it is told that nobody answers.
async fn found_at_last(seat: &mut SeatPort) -> Outbox {
    let find = async {
        loop {
            if let Some(SeatArrival::Found { outbox, .. }) = seat.next().await {
                return outbox;
            }
        }
    };
    timeout(PATIENCE, find).await.expect("the desk is found")
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn connections_that_say_nothing_do_not_use_up_the_files_of_the_desk() {
    const IDLE: usize = 300;
    let (_parent, lab) = lab(1);
    let mut desk = open(&lab.desk()).await.expect("it opens");
    let mut idle = Vec::new();
    for _ in 0..IDLE {
        let connected = tokio::net::TcpStream::connect(&lab.listen).await;
        idle.push(connected.expect("connected"));
    }
    let mut seat = join(lab.line(1));
    let _to_desk = found_at_last(&mut seat).await;
    let _to_seat = opened(&mut desk).await;
    // Both ends of the idle connections are of this process.
    let files = std::fs::read_dir("/proc/self/fd").expect("it is there");
    let files = files.count();
    assert!(files < IDLE + 200, "{files} files are open");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_seat_that_was_taken_out_is_not_let_in() {
    let (_parent, lab) = lab(2);
    // The trainee has the file already; the one in the folder is deleted.
    let line = lab.line(1);
    remove_seat(&lab.folder, "seat-01").expect("it is removed");
    assert!(!lab.folder.join("seats/seat-01.join").exists());
    let mut desk = open(&lab.desk()).await.expect("it opens");
    let mut seat = join(line);
    let fault = refused(&mut seat).await;
    assert!(
        matches!(*fault, ClassFault::Network(NetworkFault::Unknown { .. })),
        "{fault:?}"
    );
    let mut other = join(lab.line(2));
    let _kept = talk(&mut desk, &mut other).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn certificates_that_cannot_be_used_are_told() {
    let (_parent, lab) = lab(1);
    let mut damaged = lab.desk();
    damaged.keys.seats_certificate.0 = b"nonsense".to_vec();
    let opened = open(&damaged).await;
    let expected = NetworkFault::NotStarted {
        address: lab.listen.clone(),
        fault: StartFault::Certificates,
    };
    assert!(
        matches!(&opened, Err(ClassFault::Network(fault)) if *fault == expected),
        "{opened:?}"
    );
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_port_that_is_taken_is_told() {
    let (_parent, lab) = lab(1);
    let _first = open(&lab.desk()).await.expect("it opens");
    let second = open(&lab.desk()).await;
    assert!(
        matches!(
            second,
            Err(ClassFault::Network(NetworkFault::NotOpen { .. }))
        ),
        "{second:?}"
    );
}
