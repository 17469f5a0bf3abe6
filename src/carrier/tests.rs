//! What every carrier has to do, tried with the Unix socket.

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;

use nix::unistd::geteuid;
use tokio::io::AsyncWriteExt as _;
use tokio::net::UnixStream;

use super::place::user_name;
use super::*;
use crate::class::ConnectionId;
use crate::class::protocol::{DeskMessage, Hello, LineFault, SeatMessage, VERSION};

fn place(folder: &Path) -> ClassPlace {
    let path = folder.join("class").display().to_string();
    ClassPlace::named(&path, None)
}

fn hello() -> SeatMessage {
    SeatMessage::Hello(Hello {
        protocol: VERSION,
        sitting: 5,
        name: None,
    })
}

fn own_name() -> String {
    user_name(geteuid().as_raw())
}

async fn found(seat: &mut SeatPort) -> Outbox {
    loop {
        match seat.next().await.expect("the carrier runs") {
            SeatArrival::Found { desk, outbox } => {
                assert_eq!(desk.user, own_name());
                return outbox;
            }
            SeatArrival::Line(_) | SeatArrival::Lost => {}
            SeatArrival::Refused(fault) => panic!("{fault:?}"),
        }
    }
}

async fn opened(desk: &mut DeskPort) -> (ConnectionId, Outbox) {
    match desk.next().await.expect("the carrier runs") {
        DeskArrival::Opened {
            connection,
            peer,
            outbox,
        } => {
            assert_eq!(peer.user, own_name());
            (connection, outbox)
        }
        other => panic!("{other:?}"),
    }
}

#[tokio::test(start_paused = true)]
async fn lines_go_both_ways_and_say_from_whom() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    let mut desk = unix::open(&place).expect("it opens");
    let mut connections = Vec::new();
    for _ in 0..2 {
        let mut seat = unix::join(place.clone());
        let to_desk = found(&mut seat).await;
        let (connection, to_seat) = opened(&mut desk).await;
        to_desk.send(&hello());
        let arrival = desk.next().await.expect("the carrier runs");
        let DeskArrival::Line { from, line } = arrival else {
            panic!("{arrival:?}");
        };
        assert_eq!((from, line.expect("a message")), (connection, hello()));
        to_seat.send(&DeskMessage::Ask { from: 3 });
        let arrival = seat.next().await.expect("the carrier runs");
        let SeatArrival::Line(Ok(said)) = arrival else {
            panic!("{arrival:?}");
        };
        assert_eq!(said, DeskMessage::Ask { from: 3 });
        // The ends of the connections are held: without them, they would close.
        connections.push((seat, to_desk, to_seat));
    }
}

#[tokio::test(start_paused = true)]
async fn a_seat_connects_before_its_desk_opens_and_again_after_it_has_closed() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    let mut seat = unix::join(place.clone());
    for _ in 0..3 {
        let mut desk = unix::open(&place).expect("it opens");
        let _to_desk = found(&mut seat).await;
        let _to_seat = opened(&mut desk).await;
        drop(desk);
        let arrival = seat.next().await;
        assert!(matches!(arrival, Some(SeatArrival::Lost)), "{arrival:?}");
    }
}

#[tokio::test]
async fn the_folder_can_be_entered_but_only_its_owner_changes_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    let desk = unix::open(&place).expect("it opens");
    let mode = |path: &Path| {
        fs::metadata(path)
            .expect("it is there")
            .permissions()
            .mode()
            & 0o777
    };
    assert_eq!(mode(&folder.path().join("class")), 0o711);
    assert_eq!(mode(&place.socket), 0o666);
    let again = unix::open(&place);
    let in_use = |it: &ClassFault| {
        let fault = socket::SocketFault::InUse;
        let expected = std::mem::discriminant(&fault);
        matches!(it, ClassFault::Socket { fault, .. } if std::mem::discriminant(fault) == expected)
    };
    assert!(again.is_err_and(|fault| in_use(&fault)));
    drop(desk);
}

#[tokio::test]
async fn a_folder_that_others_may_change_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    let class = folder.path().join("class");
    fs::create_dir(&class).expect("made");
    fs::set_permissions(&class, Permissions::from_mode(0o777)).expect("set");
    let opened = unix::open(&place);
    assert!(matches!(opened, Err(ClassFault::Folder(_))), "{opened:?}");
    let link = folder.path().join("link");
    std::os::unix::fs::symlink(&class, &link).expect("made");
    let path = link.display().to_string();
    let opened = unix::open(&ClassPlace::named(&path, None));
    assert!(matches!(opened, Err(ClassFault::Folder(_))), "{opened:?}");
}

#[tokio::test(start_paused = true)]
async fn a_seat_does_not_speak_to_a_desk_of_somebody_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    let mut desk = unix::open(&place).expect("it opens");
    let other = ClassPlace {
        instructor: Some("nobody-of-that-name".to_owned()),
        ..place.clone()
    };
    let mut seat = unix::join(other);
    let arrival = seat.next().await;
    let Some(SeatArrival::Refused(ClassFault::Stranger { user, .. })) = arrival else {
        panic!("{arrival:?}");
    };
    assert_eq!(user, own_name());
    // Told once; the desk hears nothing from the seat but that it came and went.
    let silence = tokio::time::timeout(std::time::Duration::from_secs(30), seat.next());
    assert!(silence.await.is_err());
    let (first, _) = opened(&mut desk).await;
    let arrival = desk.next().await;
    assert!(
        matches!(arrival, Some(DeskArrival::Closed(closed)) if closed == first),
        "{arrival:?}"
    );
}

#[tokio::test]
async fn lines_that_are_no_messages_or_too_long_end_the_connection() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    let mut desk = unix::open(&place).expect("it opens");
    let long = vec![b'x'; 2 * crate::class::protocol::LONGEST_LINE];
    for (bytes, is_long) in [(b"\xff\xfe nonsense\n".to_vec(), false), (long, true)] {
        let mut stream = UnixStream::connect(&place.socket).await.expect("connected");
        let (connection, _to_seat) = opened(&mut desk).await;
        // The other end may stop reading early.
        drop(stream.write_all(&bytes).await);
        let arrival = desk.next().await.expect("the carrier runs");
        let DeskArrival::Line {
            line: Err(fault), ..
        } = arrival
        else {
            panic!("{arrival:?}");
        };
        assert_eq!(matches!(fault, LineFault::TooLong), is_long);
        let arrival = desk.next().await;
        assert!(
            matches!(arrival, Some(DeskArrival::Closed(closed)) if closed == connection),
            "{arrival:?}"
        );
    }
}

#[tokio::test]
async fn who_does_not_read_fills_only_the_queue_of_its_own_connection() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    let mut desk = unix::open(&place).expect("it opens");
    let _silent = UnixStream::connect(&place.socket).await.expect("connected");
    let (_, to_silent) = opened(&mut desk).await;
    let text = "x".repeat(150).as_str().into();
    let message = DeskMessage::Welcome {
        protocol: VERSION,
        class: text,
        name: "anna".into(),
    };
    let mut sent = 0;
    while to_silent.has_room() {
        to_silent.send(&message);
        sent += 1;
        tokio::task::yield_now().await;
        assert!(sent < 1_000_000, "nothing queues without bound");
    }
    let mut seat = unix::join(place.clone());
    let to_desk = found(&mut seat).await;
    let _to_seat = opened(&mut desk).await;
    to_desk.send(&hello());
    let arrival = desk.next().await;
    assert!(
        matches!(arrival, Some(DeskArrival::Line { line: Ok(_), .. })),
        "{arrival:?}"
    );
}
