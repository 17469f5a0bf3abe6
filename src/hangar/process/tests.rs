use std::process::{Child, Command, Stdio};

use proptest::prelude::*;
use tokio::net::{TcpListener, TcpStream};

use super::*;

/// A process that sleeps until it is dropped.
struct Sleeper(Child);

impl Sleeper {
    fn start() -> Self {
        let child = Command::new("sleep")
            .arg("1000")
            .stdin(Stdio::null())
            .spawn();
        Self(child.expect("it starts"))
    }
}

impl Drop for Sleeper {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

#[test]
fn a_process_is_known_while_it_runs() {
    let mut sleeper = Sleeper::start();
    let pid = sleeper.0.id();
    let it = identity(pid).expect("it runs");
    assert_eq!(it.pid, pid);
    assert!(
        !it.boot.is_empty() && it.namespace.starts_with("pid:"),
        "{it:?}"
    );
    assert!(is_running(&it));
    let later = ProcessIdentity {
        started: it.started + 1,
        ..it.clone()
    };
    let before = ProcessIdentity {
        boot: "another".to_owned(),
        ..it.clone()
    };
    assert!(!is_running(&later) && !is_running(&before));
    assert_eq!(user(pid), Some(own_user()));
    assert!(executable(pid).is_some_and(|path| path.is_absolute()));
    sleeper.0.kill().expect("ours");
    // The process has ended before it is waited for, and must not count as running in between.
    while is_running(&it) {
        std::thread::yield_now();
    }
    sleeper.0.wait().expect("ours");
    assert_eq!(
        (identity(pid), user(pid), executable(pid)),
        (None, None, None)
    );
    assert_eq!(usage(pid), None);
}

#[test]
fn this_program_uses_memory_and_processor_time_of_all_its_threads() {
    let me = std::process::id();
    let before = usage(me).expect("it runs");
    assert!(before.memory_bytes > 100_000, "{before:?}");
    let work = std::thread::spawn(move || {
        let mut number = 1_u64;
        while usage(me).is_some_and(|now| now.cpu < before.cpu + Duration::from_millis(30)) {
            number = std::hint::black_box(number.wrapping_mul(3));
        }
    });
    work.join().expect("it ends");
    assert!(usage(me).expect("it runs").cpu >= before.cpu + Duration::from_millis(30));
}

#[test]
fn an_unknown_process_is_nobody() {
    let none = u32::MAX;
    assert_eq!(
        (identity(none), user(none), usage(none)),
        (None, None, None)
    );
}

async fn connection(listen_at: &str, connect_to: &str) -> (TcpStream, TcpStream) {
    let listener = TcpListener::bind(listen_at).await.expect("a port");
    let port = listener.local_addr().expect("bound").port();
    let client = TcpStream::connect((connect_to, port))
        .await
        .expect("it listens");
    let (accepted, _) = listener.accept().await.expect("it has connected");
    (client, accepted)
}

#[tokio::test]
async fn a_connection_belongs_to_the_process_that_holds_it() {
    let (_client, accepted) = connection("127.0.0.1:0", "127.0.0.1").await;
    let connection = Connection::of(&accepted).expect("connected");
    assert_eq!(connection.user(), Some(own_user()));
    assert_eq!(connection.is_of_process(std::process::id()), Belongs::Yes);
    let sleeper = Sleeper::start();
    // Inherited files are closed when the process becomes `sleep`.
    while executable(sleeper.0.id()) == executable(std::process::id()) {
        std::thread::yield_now();
    }
    assert_eq!(connection.is_of_process(sleeper.0.id()), Belongs::No);
    assert_eq!(connection.is_of_process(u32::MAX), Belongs::Unknown);
}

#[tokio::test]
async fn a_connection_of_a_script_s_program_belongs_to_the_script() {
    let (_client, accepted) = connection("127.0.0.1:0", "127.0.0.1").await;
    let connection = Connection::of(&accepted).expect("connected");
    // The script stands for the leader of this program's session.
    let leader = nix::unistd::getsid(None).expect("it has one").as_raw() as u32;
    let me = std::process::id();
    assert!(leader == me || session(leader).contains(&me));
    if identity(leader).is_some() && user(leader) == Some(own_user()) {
        assert_eq!(connection.is_of_process(leader), Belongs::Yes);
    }
}

#[tokio::test]
async fn a_connection_to_a_socket_for_both_versions_of_ip_is_found() {
    if TcpListener::bind("[::1]:0").await.is_err() {
        eprintln!("skipped: no IPv6 here");
        return;
    }
    for to in ["127.0.0.1", "::1"] {
        let (_client, accepted) = connection("[::]:0", to).await;
        let connection = Connection::of(&accepted).expect("connected");
        assert_eq!(
            connection.is_of_process(std::process::id()),
            Belongs::Yes,
            "{to}"
        );
    }
}

#[tokio::test]
async fn a_connection_that_is_gone_belongs_to_nobody() {
    let (client, accepted) = connection("127.0.0.1:0", "127.0.0.1").await;
    let connection = Connection::of(&accepted).expect("connected");
    drop((client, accepted));
    assert_eq!(
        connection.is_of_process(std::process::id()),
        Belongs::Unknown
    );
    assert_eq!(connection.user(), None);
}

#[test]
fn the_systems_table_is_read_by_both_ends_and_its_owner() {
    let line = "  7: 0100007F:A1B2 0100007F:1F90 01 00000000:00000000 00:00000000 00000000  1000        0 424242 1 0 20 4 0 10 -1";
    let at = |port: u16| SocketAddr::from(([127, 0, 0, 1], port));
    let connection = Connection {
        peer: at(0xA1B2),
        local: at(0x1F90),
    };
    let found = linux::socket_of(line, connection);
    assert_eq!(
        found,
        Some(ProcessSocket {
            user: 1000,
            inode: 424_242
        })
    );
    let backwards = Connection {
        peer: connection.local,
        local: connection.peer,
    };
    assert_eq!(linux::socket_of(line, backwards), None);
    let closed = line.replace("424242", "0");
    assert_eq!(linux::socket_of(&closed, connection), None);
    let mapped = "0000000000000000FFFF00000100007F:A1B2";
    assert_eq!(linux::address(mapped).map(plain), Some(connection.peer));
}

proptest! {
    #[test]
    fn junk_in_the_systems_table_is_no_connection(line in "\\PC{0,120}", word in "[0-9A-F:]{0,40}") {
        let at = SocketAddr::from(([127, 0, 0, 1], 1));
        let connection = Connection { peer: at, local: at };
        prop_assert_eq!(linux::socket_of(&line, connection), None);
        linux::address(&word);
    }
}
