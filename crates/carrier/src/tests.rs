//! What every carrier has to do, tried with each of them.

use std::time::Duration;

use serde::Serialize;
use sortie_class::ConnectionId;
use sortie_class::protocol::{DeskMessage, Hello, LONGEST_LINE, LineFault, SeatMessage, VERSION};
use tempfile::TempDir;

use super::address::with_port_of;
use super::*;

mod unix;

/// A class with two seats that is tried.
struct Tried {
    desk: DeskPlace,
    seats: [ClassPlace; 2],
    /// What the desk calls each seat.
    seat_users: [String; 2],
    _folder: TempDir,
}

impl Tried {
    fn on_a_host() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("class").display().to_string();
        let seat = || ClassPlace::named(&path, None).expect("a place");
        Self {
            desk: DeskPlace::Host(HostPlace::named(&path, None)),
            seats: [seat(), seat()],
            seat_users: [own_user_name(), own_user_name()],
            _folder: folder,
        }
    }

    #[cfg(feature = "zenoh")]
    fn on_a_network() -> Self {
        let (folder, lab) = network::tests::lab(2);
        Self {
            desk: DeskPlace::Network(Box::new(lab.desk())),
            seats: [1, 2].map(|number| ClassPlace::Network(Box::new(lab.line(number)))),
            seat_users: ["seat-01".to_owned(), "seat-02".to_owned()],
            _folder: folder,
        }
    }

    /// Opens the desk. The listener of a desk that was dropped just before may take a moment to close its port.
    async fn open(&self) -> DeskPort {
        for _ in 0..100 {
            match self.desk.open().await {
                Ok(desk) => return desk,
                Err(_) => tokio::time::sleep(Duration::from_millis(100)).await,
            }
        }
        self.desk.open().await.expect("it opens")
    }
}

/// Tries the same with each carrier. Zenoh needs real time and threads.
macro_rules! with_each_carrier {
    ($($name:ident)*) => {
        mod on_a_host {
            $(#[tokio::test(start_paused = true)]
            async fn $name() {
                super::$name(super::Tried::on_a_host()).await;
            })*
        }
        #[cfg(feature = "zenoh")]
        mod on_a_network {
            $(#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
            async fn $name() {
                super::$name(super::Tried::on_a_network()).await;
            })*
        }
    };
}

with_each_carrier! {
    lines_go_both_ways_and_say_from_whom
    a_seat_connects_before_its_desk_opens_and_again_after_it_has_closed
    what_is_no_message_or_too_long_ends_the_connection
    who_does_not_read_fills_only_the_queue_of_its_own_connection
    long_lines_arrive_all_and_in_order
    a_seat_that_ends_is_seen_to_leave
    two_consoles_of_one_trainee_have_a_connection_each
}

fn hello(sitting: u64) -> SeatMessage {
    SeatMessage::Hello(Hello {
        protocol: VERSION,
        sitting,
        name: None,
    })
}

pub(crate) async fn found(seat: &mut SeatPort) -> Outbox {
    loop {
        match seat.next().await.expect("the carrier runs") {
            SeatArrival::Found { desk, outbox } => {
                assert_eq!(desk.user, own_user_name());
                return outbox;
            }
            SeatArrival::Line(_) | SeatArrival::Lost => {}
            SeatArrival::Refused(fault) => panic!("{fault:?}"),
        }
    }
}

/// The next connection that is opened, and the user at its other end.
pub(crate) async fn opened(desk: &mut DeskPort) -> (ConnectionId, String, Outbox) {
    loop {
        match desk.next().await.expect("the carrier runs") {
            DeskArrival::Opened {
                connection,
                peer,
                outbox,
            } => return (connection, peer.user, outbox),
            // Of a connection before.
            DeskArrival::Closed(_) => {}
            other @ DeskArrival::Line { .. } => panic!("{other:?}"),
        }
    }
}

async fn heard(desk: &mut DeskPort) -> (ConnectionId, Result<SeatMessage, LineFault>) {
    match desk.next().await.expect("the carrier runs") {
        DeskArrival::Line { from, line } => (from, line),
        other => panic!("{other:?}"),
    }
}

async fn said(seat: &mut SeatPort) -> DeskMessage {
    match seat.next().await.expect("the carrier runs") {
        SeatArrival::Line(line) => line.expect("a message"),
        other => panic!("{other:?}"),
    }
}

async fn lines_go_both_ways_and_say_from_whom(tried: Tried) {
    let mut desk = tried.open().await;
    let mut connections = Vec::new();
    for (place, user) in tried.seats.iter().zip(&tried.seat_users) {
        let mut seat = place.join();
        let to_desk = found(&mut seat).await;
        let (connection, seen, to_seat) = opened(&mut desk).await;
        assert_eq!(seen, *user);
        to_desk.send(&hello(5));
        let (from, line) = heard(&mut desk).await;
        assert_eq!((from, line.expect("a message")), (connection, hello(5)));
        to_seat.send(&DeskMessage::Ask { from: 3 });
        assert_eq!(said(&mut seat).await, DeskMessage::Ask { from: 3 });
        // The ends of the connections are held: without them, they would close.
        connections.push((seat, to_desk, to_seat));
    }
}

async fn a_seat_connects_before_its_desk_opens_and_again_after_it_has_closed(tried: Tried) {
    let mut seat = tried.seats[0].join();
    for _ in 0..3 {
        let mut desk = tried.open().await;
        let _to_desk = found(&mut seat).await;
        let _to_seat = opened(&mut desk).await;
        drop(desk);
        let arrival = seat.next().await;
        assert!(matches!(arrival, Some(SeatArrival::Lost)), "{arrival:?}");
    }
}

async fn what_is_no_message_or_too_long_ends_the_connection(tried: Tried) {
    let mut desk = tried.open().await;
    let mut seat = tried.seats[0].join();
    let long = "x".repeat(LONGEST_LINE + 100);
    for (line, is_long) in [("nonsense", false), (&long, true)] {
        let to_desk = found(&mut seat).await;
        let (connection, _, _to_seat) = opened(&mut desk).await;
        to_desk.send(&line);
        let (_, line) = heard(&mut desk).await;
        let fault = line.expect_err("no message");
        assert_eq!(matches!(fault, LineFault::TooLong), is_long, "{fault:?}");
        let arrival = desk.next().await;
        assert!(
            matches!(arrival, Some(DeskArrival::Closed(closed)) if closed == connection),
            "{arrival:?}"
        );
    }
}

async fn who_does_not_read_fills_only_the_queue_of_its_own_connection(tried: Tried) {
    let mut desk = tried.open().await;
    // Nobody takes its arrivals.
    let mut silent = tried.seats[0].join();
    let _from_silent = found(&mut silent).await;
    let (_, _, to_silent) = opened(&mut desk).await;
    let mut sent = 0;
    while fill(&to_silent).await {
        sent += 1;
        assert!(sent < 100_000, "nothing queues without bound");
    }
    let mut seat = tried.seats[1].join();
    let to_desk = found(&mut seat).await;
    let _to_seat = opened(&mut desk).await;
    to_desk.send(&hello(5));
    let (_, line) = heard(&mut desk).await;
    assert_eq!(line.expect("a message"), hello(5));
}

/// Sends a line if there is room for one within a while.
async fn fill(outbox: &Outbox) -> bool {
    for _ in 0..200 {
        if outbox.has_room() {
            let class = "x".repeat(150).as_str().into();
            let protocol = VERSION;
            outbox.send(&DeskMessage::Welcome {
                protocol,
                class,
                name: "seat".into(),
                instructor: "petro".into(),
            });
            return true;
        }
        tokio::time::sleep(std::time::Duration::from_millis(2)).await;
    }
    false
}

/// Sends a message as soon as there is room for it.
async fn send(outbox: &Outbox, message: &impl Serialize) {
    while !outbox.has_room() {
        tokio::time::sleep(std::time::Duration::from_millis(1)).await;
    }
    outbox.send(message);
}

async fn long_lines_arrive_all_and_in_order(tried: Tried) {
    const COUNT: u64 = 100;
    let mut desk = tried.open().await;
    let mut seat = tried.seats[0].join();
    let to_desk = found(&mut seat).await;
    let (_, _, to_seat) = opened(&mut desk).await;
    // About as long as a line may be.
    let padding = "x".repeat(LONGEST_LINE - 100);
    // Unknown fields are ignored.
    let long = |from: u64| serde_json::json!({ "ask": { "from": from, "padding": padding } });
    let of_seat = |sitting: u64| {
        let hello = serde_json::json!({ "protocol": 1, "sitting": sitting, "padding": padding });
        serde_json::json!({ "hello": hello })
    };
    let sending = async {
        for number in 0..COUNT {
            send(&to_seat, &long(number)).await;
            send(&to_desk, &of_seat(number)).await;
        }
    };
    let receiving = async {
        for number in 0..COUNT {
            assert_eq!(said(&mut seat).await, DeskMessage::Ask { from: number });
            let (_, line) = heard(&mut desk).await;
            assert_eq!(line.expect("a message"), hello(number));
        }
    };
    tokio::join!(sending, receiving);
}

async fn a_seat_that_ends_is_seen_to_leave(tried: Tried) {
    let mut desk = tried.open().await;
    let mut seat = tried.seats[0].join();
    let _to_desk = found(&mut seat).await;
    let (connection, _, _to_seat) = opened(&mut desk).await;
    drop(seat);
    let arrival = desk.next().await;
    assert!(
        matches!(arrival, Some(DeskArrival::Closed(closed)) if closed == connection),
        "{arrival:?}"
    );
}

/// As if a trainee joined twice, one console late.
async fn two_consoles_of_one_trainee_have_a_connection_each(tried: Tried) {
    let mut desk = tried.open().await;
    let mut consoles = Vec::new();
    for sitting in [5, 6] {
        let mut seat = tried.seats[0].join();
        let to_desk = found(&mut seat).await;
        let (connection, user, to_seat) = opened(&mut desk).await;
        assert_eq!(user, tried.seat_users[0]);
        consoles.push((seat, to_desk, to_seat, connection, sitting));
    }
    for (seat, to_desk, to_seat, connection, sitting) in &mut consoles {
        to_desk.send(&hello(*sitting));
        let (from, line) = heard(&mut desk).await;
        assert_eq!(from, *connection);
        assert_eq!(line.expect("a message"), hello(*sitting));
        to_seat.send(&DeskMessage::Ask { from: *sitting });
        assert_eq!(said(seat).await, DeskMessage::Ask { from: *sitting });
    }
}

#[test]
fn an_address_without_a_port_has_the_default_one() {
    for (written, address) in [
        ("192.168.1.9", "192.168.1.9:7447"),
        ("lab", "lab:7447"),
        ("[::1]", "[::1]:7447"),
        ("lab:7000", "lab:7000"),
        // These are no addresses, and are refused as they were written.
        ("7447", "7447"),
        ("::1", "::1"),
        ("lab:", "lab:"),
        ("lab:70000", "lab:70000"),
        ("", ""),
        ("two words", "two words"),
    ] {
        assert_eq!(with_port(written), address);
    }
}

/// A desk once listened on the default port, on which none of its seats looked.
#[test]
fn an_address_without_a_port_has_that_of_its_class() {
    let class = ["127.0.0.1:7461".to_owned(), "lab:7000".to_owned()];
    for (written, address) in [
        ("127.0.0.1", "127.0.0.1:7461"),
        ("0.0.0.0", "0.0.0.0:7461"),
        ("lab:7000", "lab:7000"),
        ("7447", "7447"),
    ] {
        assert_eq!(with_port_of(written, &class), address);
    }
    assert_eq!(with_port_of("lab", &[]), "lab:7447");
}

#[test]
fn an_address_of_this_machine_only_is_recognised() {
    for own in ["127.0.0.1:7461", "127.8.0.1", "[::1]:7447", "localhost:1"] {
        assert!(is_loopback(own), "{own}");
    }
    for other in ["192.168.1.5:7447", "lab:7447", "0.0.0.0:7447", "[::]:7447"] {
        assert!(!is_loopback(other), "{other}");
    }
}
