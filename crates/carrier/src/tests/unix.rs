//! What only the Unix socket does: it knows users, and folders that others could change.

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;

use sortie_class::protocol::{DeskMessage, SeatMessage};

use super::opened;
use crate::host::{HostPlace, own_user_name};
use crate::{ClassFault, DeskArrival, SeatArrival, socket, unix};

fn place(folder: &Path) -> HostPlace {
    let path = folder.join("class").display().to_string();
    HostPlace::named(&path, None)
}

#[tokio::test]
async fn the_folder_can_be_entered_but_only_its_owner_changes_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    let desk = unix::open::<SeatMessage>(&place).expect("it opens");
    let mode = |path: &Path| {
        fs::metadata(path)
            .expect("it is there")
            .permissions()
            .mode()
            & 0o777
    };
    assert_eq!(mode(&folder.path().join("class")), 0o711);
    assert_eq!(mode(&place.socket), 0o666);
    let again = unix::open::<SeatMessage>(&place);
    let in_use = |it: &ClassFault| {
        let fault = socket::SocketFault::InUse;
        let expected = std::mem::discriminant(&fault);
        matches!(it, ClassFault::Socket { fault, .. } if std::mem::discriminant(fault) == expected)
    };
    assert!(again.is_err_and(|fault| in_use(&fault)));
    drop(desk);
}

#[tokio::test]
async fn the_folder_of_a_crew_goes_with_its_host_and_that_of_a_class_stays() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let crew = HostPlace::crew(&path("crew"), None);
    assert!(!crew.is_open());
    let host = crew.open::<SeatMessage>().expect("it opens");
    assert!(crew.is_open());
    host.close().await;
    assert!(!crew.is_open());
    assert!(!folder.path().join("crew").exists());
    // What somebody else has put there is not removed.
    let kept = HostPlace::crew(&path("kept"), None);
    let host = kept.open::<SeatMessage>().expect("it opens");
    fs::write(folder.path().join("kept/notes"), "").expect("written");
    host.close().await;
    assert!(folder.path().join("kept/notes").exists());
    let desk = unix::open::<SeatMessage>(&place(folder.path())).expect("it opens");
    desk.close().await;
    assert!(folder.path().join("class").exists());
}

#[tokio::test]
async fn a_folder_that_others_may_change_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    let class = folder.path().join("class");
    fs::create_dir(&class).expect("made");
    fs::set_permissions(&class, Permissions::from_mode(0o777)).expect("set");
    let opened = unix::open::<SeatMessage>(&place);
    assert!(matches!(opened, Err(ClassFault::Folder(_))), "{opened:?}");
    let link = folder.path().join("link");
    std::os::unix::fs::symlink(&class, &link).expect("made");
    let path = link.display().to_string();
    let opened = unix::open::<SeatMessage>(&HostPlace::named(&path, None));
    assert!(matches!(opened, Err(ClassFault::Folder(_))), "{opened:?}");
}

#[test]
fn a_socket_of_the_own_user_may_be_in_a_folder_of_anybody() {
    let own = nix::unistd::geteuid();
    let folder = tempfile::tempdir().expect("a folder");
    let folder = if own.is_root() {
        std::os::unix::fs::chown(folder.path(), Some(65_534), None).expect("given away");
        folder.path()
    } else {
        Path::new("/")
    };
    let place = HostPlace {
        socket: folder.join("alpha"),
        instructor: None,
        is_passing: false,
    };
    place.check(own.as_raw()).expect("it is the own user's");
    let stranger = place.check(4_000_000);
    assert!(
        matches!(stranger, Err(ClassFault::Stranger { .. })),
        "{stranger:?}"
    );
}

#[tokio::test(start_paused = true)]
async fn a_desk_that_sends_no_more_is_rid_of_who_does_not_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    let mut desk = unix::open::<SeatMessage>(&place).expect("it opens");
    let _silent = tokio::net::UnixStream::connect(&place.socket).await;
    let (connection, _, outbox) = opened(&mut desk).await;
    for _ in 0..100 {
        outbox.send(&"x".repeat(100_000));
        tokio::task::yield_now().await;
    }
    drop(outbox);
    let arrival = desk.next().await;
    assert!(
        matches!(arrival, Some(DeskArrival::Closed(closed)) if closed == connection),
        "{arrival:?}"
    );
}

#[tokio::test(start_paused = true)]
async fn a_seat_does_not_speak_to_a_desk_of_somebody_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    let mut desk = unix::open::<SeatMessage>(&place).expect("it opens");
    let other = HostPlace {
        instructor: Some("nobody-of-that-name".to_owned()),
        ..place.clone()
    };
    let mut seat = unix::join::<DeskMessage>(other);
    let arrival = seat.next().await;
    let Some(SeatArrival::Refused(fault)) = arrival else {
        panic!("{arrival:?}");
    };
    let ClassFault::Stranger { user, .. } = &*fault else {
        panic!("{fault:?}");
    };
    assert_eq!(*user, own_user_name());
    // Told once; the desk hears nothing from the seat but that it came and went.
    let silence = tokio::time::timeout(std::time::Duration::from_secs(30), seat.next());
    assert!(silence.await.is_err());
    let (first, _, _) = opened(&mut desk).await;
    let arrival = desk.next().await;
    assert!(
        matches!(arrival, Some(DeskArrival::Closed(closed)) if closed == first),
        "{arrival:?}"
    );
}

/// A seat once waited without a word at a path where no desk can ever be.
#[tokio::test(start_paused = true)]
async fn a_seat_says_that_its_path_leads_to_something_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(folder.path());
    fs::create_dir(folder.path().join("class")).expect("made");
    fs::write(&place.socket, "no socket").expect("written");
    let mut seat = unix::join::<DeskMessage>(place.clone());
    let arrival = seat.next().await;
    let Some(SeatArrival::Refused(fault)) = arrival else {
        panic!("{arrival:?}");
    };
    let fault_of = |fault| ClassFault::Socket {
        socket: place.socket.clone(),
        fault,
    };
    assert_eq!(*fault, fault_of(socket::SocketFault::NoSocket));
    // A desk does not replace the file.
    let second = unix::open::<SeatMessage>(&place);
    let fault = second.expect_err("it is not a socket");
    assert_eq!(fault, fault_of(socket::SocketFault::NoSocket));
    let kept = fs::read_to_string(&place.socket).expect("it is there");
    assert_eq!(kept, "no socket");
    // A socket that a killed desk has left is replaced.
    fs::remove_file(&place.socket).expect("removed");
    drop(std::os::unix::net::UnixListener::bind(&place.socket).expect("bound"));
    let mut desk = unix::open::<SeatMessage>(&place).expect("it opens");
    let _connection = opened(&mut desk).await;
}
