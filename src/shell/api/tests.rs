use tokio::io::{AsyncBufReadExt as _, AsyncWriteExt as _, BufReader, DuplexStream, duplex, split};

use super::*;
use crate::api::Ended;

/// A program's end of a connection that is served, and the arrivals from it.
fn connected() -> (DuplexStream, mpsc::Receiver<Arrival>) {
    let (near, far) = duplex(1024);
    let (arrived, arrivals) = mpsc::channel(CALLS_KEPT);
    let (read, write) = split(far);
    let exchange = Exchange {
        arrived,
        ending: CancellationToken::new(),
        writing: mpsc::channel(1).0,
    };
    tokio::spawn(converse(ProgramId(1), read, write, exchange));
    (near, arrivals)
}

async fn next_line(arrivals: &mut mpsc::Receiver<Arrival>) -> Option<Result<String, LineFault>> {
    loop {
        match arrivals.recv().await? {
            Arrival::Opened(..) | Arrival::Crowded(_) => {}
            Arrival::Closed(_) => return None,
            Arrival::Line { line, reply, .. } => {
                reply.send("{}".to_owned());
                return Some(line);
            }
        }
    }
}

#[tokio::test]
async fn lines_are_passed_on_and_answered_in_order() {
    let (mut near, mut arrivals) = connected();
    near.write_all(b"one\n\n  \ntwo\n").await.expect("written");
    assert_eq!(next_line(&mut arrivals).await, Some(Ok("one\n".to_owned())));
    assert_eq!(next_line(&mut arrivals).await, Some(Ok("two\n".to_owned())));
    let mut answers = BufReader::new(&mut near).lines();
    for _ in 0..2 {
        let answer = answers.next_line().await.expect("readable");
        assert_eq!(answer.as_deref(), Some("{}"));
    }
}

#[tokio::test]
async fn a_line_that_is_too_long_ends_the_connection_with_its_reason() {
    let (near, mut arrivals) = connected();
    let (mut read, mut write) = split(near);
    tokio::spawn(async move {
        // The other end may stop reading early.
        drop(write.write_all(&vec![b'x'; 2 * LONGEST_LINE]).await);
    });
    assert_eq!(
        next_line(&mut arrivals).await,
        Some(Err(LineFault::TooLong))
    );
    assert_eq!(next_line(&mut arrivals).await, None);
    let mut answer = String::new();
    let mut answers = BufReader::new(&mut read);
    answers.read_line(&mut answer).await.expect("readable");
    assert_eq!(answer, "{}\n");
}

#[tokio::test]
async fn bytes_that_are_no_text_are_a_fault() {
    let (mut near, mut arrivals) = connected();
    near.write_all(b"\xff\xfe\n").await.expect("written");
    assert_eq!(
        next_line(&mut arrivals).await,
        Some(Err(LineFault::NotUtf8))
    );
}

#[tokio::test(start_paused = true)]
async fn a_program_that_does_not_read_is_asked_to_wait_and_holds_nobody_up() {
    let (mut near, mut arrivals) = connected();
    let Some(Arrival::Opened(_, outbox)) = arrivals.recv().await else {
        panic!("not opened");
    };
    let writing = tokio::spawn(async move {
        let mut sent = 0;
        while near.write_all(b"ask\n").await.is_ok() {
            sent += 1;
            if sent == 10 * OUTBOX {
                break;
            }
        }
        near
    });
    let mut answered = 0;
    // Each answer is larger than the connection can buffer.
    let answer = "x".repeat(900);
    loop {
        let next = tokio::time::timeout(std::time::Duration::from_millis(200), arrivals.recv());
        match next.await {
            Ok(Some(Arrival::Line { reply, .. })) => {
                reply.send(answer.clone());
                answered += 1;
            }
            Ok(_) => panic!("the connection has ended"),
            // No further request is taken.
            Err(_) => break,
        }
    }
    assert!(answered <= OUTBOX + 3, "{answered}");
    assert_eq!(outbox.capacity(), 0);
    writing.abort();
}

#[test]
fn a_flood_of_news_is_sent_in_order_and_in_full_as_it_is_read() {
    let (outbox, mut lines) = mpsc::channel(OUTBOX);
    let mut program = Program {
        client: Client::default(),
        outbox,
        held: VecDeque::new(),
        is_noticed: false,
    };
    let ended = |entry| Message::Ended(Ended { entry, done: true });
    let flood: Vec<Message> = (0..3 * OUTBOX as u32).map(ended).collect();
    let expected: Vec<String> = flood.iter().map(Message::line).collect();
    program.send(&flood);
    assert_eq!(program.outbox.capacity(), 0);
    let mut read = Vec::new();
    while read.len() < expected.len() {
        read.push(lines.try_recv().expect("held until there is room"));
        program.send(&[]);
    }
    assert_eq!(read, expected);
}

mod sockets {
    use std::os::unix::fs::PermissionsExt as _;

    use super::*;

    fn options(socket: PathBuf) -> ApiOptions {
        ApiOptions {
            socket,
            commands: true,
        }
    }

    #[tokio::test]
    async fn the_socket_is_its_owners_and_goes_with_the_console() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("api");
        let programs = Programs::open(Some(&options(path.clone()))).expect("opened");
        let mode = std::fs::metadata(&path)
            .expect("it is there")
            .permissions()
            .mode();
        assert_eq!(mode & 0o777, 0o600);
        let again = Programs::open(Some(&options(path.clone())));
        assert!(
            again
                .err()
                .is_some_and(|error| error.to_string().contains("in use"))
        );
        drop(programs);
        assert!(!path.exists());
    }

    #[tokio::test]
    async fn a_socket_that_nobody_answers_on_is_replaced_and_other_files_are_kept() {
        let folder = tempfile::tempdir().expect("a folder");
        let left = folder.path().join("left");
        drop(std::os::unix::net::UnixListener::bind(&left).expect("bound"));
        assert!(Programs::open(Some(&options(left))).is_ok());
        let file = folder.path().join("notes");
        std::fs::write(&file, "mine").expect("written");
        assert!(Programs::open(Some(&options(file.clone()))).is_err());
        assert_eq!(std::fs::read_to_string(&file).expect("kept"), "mine");
    }
}
