//! Several hangars on other machines, and a console that spreads its vehicles over them.

use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use sortie::hangar::client::{ClientError, RemoteHangar};
use sortie::hangar::{HangarRefusal, HangarToken, Hangars, Launch, Seen, SitlStage};
use sortie::text::Text;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, copy_bidirectional};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{mpsc, watch};

use super::{PATIENCE, Served};

async fn until(
    seen: &mut watch::Receiver<Seen>,
    what: &str,
    is_true: impl Fn(&Seen) -> bool,
) -> Seen {
    let waiting = tokio::time::timeout(PATIENCE, seen.wait_for(|all| is_true(all)));
    let now = waiting
        .await
        .unwrap_or_else(|_| panic!("in vain until {what}"));
    Arc::clone(&now.expect("it goes on"))
}

fn launches(count: usize) -> Vec<Launch> {
    vec![Launch::default(); count]
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn vehicles_are_spread_by_room_and_a_hangar_that_dies_hurts_no_other() {
    let (first, second) = (Served::start(1).await, Served::start(3).await);
    let hangars = Hangars::far(vec![first.remote(), second.remote()]);
    assert_eq!(
        hangars.names(),
        [first.address.to_string(), second.address.to_string()]
    );
    let mut launched = hangars.launch(launches(3)).await.expect("there is room");
    let at: Vec<usize> = launched
        .iter()
        .map(|vehicle| vehicle.place.hangar)
        .collect();
    assert_eq!(at, [0, 1, 1]);
    let mut seen = hangars.instances();
    let all = until(&mut seen, "all are ready", |all| {
        all.len() == 3 && all.iter().all(|(_, one)| one.stage == SitlStage::Ready)
    })
    .await;
    let place = launched[0].place;
    let printed = hangars.output(place, 0).await.expect("it is there");
    assert_eq!(printed[0].number, 1);
    let last = printed[printed.len() - 1].number;
    let rest = hangars.output(place, last).await.expect("it is there");
    assert_eq!(rest[0].number, last);
    let mut systems: Vec<u8> = all.iter().map(|(_, one)| one.system).collect();
    systems.sort_unstable();
    assert_eq!(systems, [1, 2, 3]);
    let mut some = [0; 16];
    for vehicle in &mut launched {
        vehicle.pipe.read_exact(&mut some).await.expect("it speaks");
    }
    first.end().await;
    let all = until(&mut seen, "the first hangar is lost", |all| {
        all.iter()
            .any(|(place, one)| place.hangar == 0 && one.stage == SitlStage::Ended)
    })
    .await;
    let lost = all[0].1.fault.clone().expect("a reason");
    assert!(lost.contains("does not answer"), "{lost}");
    assert!(
        all[1..]
            .iter()
            .all(|(_, one)| one.stage == SitlStage::Ready)
    );
    for _ in 0..200 {
        launched[1]
            .pipe
            .read_exact(&mut some)
            .await
            .expect("it goes on");
    }
    hangars
        .restart(launched[1].place)
        .await
        .expect("it is there");
    until(&mut seen, "it was started again", |all| {
        all.iter().any(|(_, one)| one.restarts == 1)
    })
    .await;
    hangars.stop(launched[2].place).await.expect("it is there");
    assert!(matches!(
        hangars.restart(launched[2].place).await,
        Err(HangarRefusal::Unknown(_))
    ));
    hangars.close().await;
    assert_eq!(second.ask("GET", "/vehicles").await.body, "[]");
    second.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn all_are_launched_or_none() {
    let (first, second) = (Served::start(2).await, Served::with(2, None, |_| ()).await);
    let hangars = Hangars::far(vec![first.remote(), second.remote()]);
    let error = hangars
        .launch(launches(5))
        .await
        .expect_err("there is no room");
    assert!(matches!(error, HangarRefusal::Full(0)), "{error}");
    // The second hangar has no program to start.
    let error = hangars
        .launch(launches(2))
        .await
        .expect_err("one of them fails");
    assert!(matches!(error, HangarRefusal::Far { .. }), "{error}");
    assert!(
        error.to_string().contains("no arducopter was found"),
        "{error}"
    );
    assert_eq!(first.ask("GET", "/vehicles").await.body, "[]");
    assert!(hangars.instances().borrow().is_empty());
    let dead = second.remote();
    second.end().await;
    let hangars = Hangars::far(vec![dead, first.remote()]);
    let launched = hangars
        .launch(launches(2))
        .await
        .expect("the other has room");
    assert!(launched.iter().all(|vehicle| vehicle.place.hangar == 1));
    let error = hangars
        .launch(launches(1))
        .await
        .expect_err("there is no room");
    assert!(error.to_string().contains("cannot be reached"), "{error}");
    first.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_was_launched_ends_with_the_console() {
    let served = Served::start(2).await;
    // A hangar uses each system id only once.
    let launch = Launch {
        system: Some(9),
        ..Launch::default()
    };
    let by_another = served
        .remote()
        .launch(&launch)
        .await
        .expect("there is room");
    let hangars = Hangars::far(vec![served.remote()]);
    let launched = hangars.launch(launches(1)).await.expect("there is room");
    assert_ne!(launched[0].place.id, by_another.id);
    drop(hangars);
    let gone = async {
        while served.remote().instances().await.expect("it answers").len() > 1 {
            tokio::task::yield_now().await;
        }
    };
    tokio::time::timeout(PATIENCE, gone)
        .await
        .expect("it is ended");
    let left = served.remote().instances().await.expect("it answers");
    assert_eq!(left[0].id, by_another.id);
    served.end().await;
}

/// Forwards connections to a service, and reports for each request to end a vehicle whether the
/// client disconnects before the answer.
async fn attentive(listener: TcpListener, service: SocketAddr, told: mpsc::UnboundedSender<bool>) {
    while let Ok((mut client, _)) = listener.accept().await {
        let told = told.clone();
        tokio::spawn(async move {
            let mut server = TcpStream::connect(service).await.expect("it listens");
            let mut head = [0; 4096];
            let len = client.read(&mut head).await.expect("it is open");
            if head.starts_with(b"DELETE") {
                let mut byte = [0];
                let more = client.read(&mut byte);
                let more = tokio::time::timeout(Duration::from_millis(300), more).await;
                let _ = told.send(more.is_ok());
            }
            server.write_all(&head[..len]).await.expect("it is open");
            let _ = copy_bidirectional(&mut client, &mut server).await;
        });
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_console_that_ends_waits_until_it_is_heard() {
    let served = Served::start(1).await;
    let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
    let address = format!("http://{}", listener.local_addr().expect("it is bound"));
    let (told, mut hung_up) = mpsc::unbounded_channel();
    let between = tokio::spawn(attentive(listener, served.address, told));
    let token = Some(served.token.clone());
    let remote = RemoteHangar::new(address.parse().expect("an address"), token);
    let hangars = Hangars::far(vec![remote]);
    hangars.launch(launches(1)).await.expect("there is room");
    drop(hangars);
    assert_eq!(hung_up.recv().await, Some(false));
    between.abort();
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_hangar_that_was_started_anew_has_none_of_the_vehicles() {
    let first = Served::start(1).await;
    let hangars = Hangars::far(vec![first.remote()]);
    let launched = hangars.launch(launches(1)).await.expect("there is room");
    let mut seen = hangars.instances();
    until(&mut seen, "it is known", |all| {
        all[0].1.stage > SitlStage::Queued
    })
    .await;
    let second = first.again().await;
    let other = second
        .remote()
        .launch(&Launch::default())
        .await
        .expect("there is room");
    assert_eq!(other.id, launched[0].place.id);
    let all = until(&mut seen, "that is noticed", |all| {
        all[0]
            .1
            .fault
            .as_ref()
            .is_some_and(|fault| fault.contains("was restarted"))
    })
    .await;
    assert_eq!(all[0].1.stage, SitlStage::Ended);
    assert!(hangars.stop(launched[0].place).await.is_err());
    drop(hangars);
    assert_eq!(
        second.remote().instances().await.expect("it answers").len(),
        1
    );
    second.end().await;
}

#[tokio::test]
async fn what_is_no_hangar_is_told_from_one_that_is_not_there() {
    let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
    let address = format!("http://{}", listener.local_addr().expect("it is bound"));
    let remote = RemoteHangar::new(address.parse().expect("an address"), None);
    let answers = [
        "SSH-2.0-OpenSSH_9.6\r\n",
        "HTTP/1.1 404 Not Found\r\nContent-Length: 5\r\n\r\nnginx",
        "HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\n{}",
    ];
    let server = tokio::spawn(async move {
        for answer in answers {
            let (mut stream, _) = listener.accept().await.expect("it listens");
            let mut head = [0; 4096];
            let _ = stream.read(&mut head).await;
            stream
                .write_all(answer.as_bytes())
                .await
                .expect("it is open");
            let _ = stream.shutdown().await;
        }
    });
    for answer in answers {
        let error = remote.status().await.expect_err("it is none");
        assert!(
            matches!(error, ClientError::NotAHangar { .. }),
            "{answer}: {error}"
        );
    }
    server.await.expect("no panic");
    let error = remote.status().await.expect_err("nobody listens");
    assert!(matches!(error, ClientError::Unreachable { .. }), "{error}");
    let text = Text::from(&error);
    assert!(text.to_string().contains("cannot be reached"), "{text}");
    assert!(error.to_string().contains("ssh -L"));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_wrong_token_is_told_as_such() {
    let served = Served::start(1).await;
    let wrong = HangarToken::random().expect("random numbers");
    let remote = RemoteHangar::new(served.remote().address().clone(), Some(wrong));
    let error = remote.status().await.expect_err("it is wrong");
    assert!(matches!(error, ClientError::Unauthorised { .. }), "{error}");
    let hangars = Hangars::far(vec![remote]);
    let error = hangars.launch(launches(1)).await.expect_err("it is wrong");
    assert!(error.to_string().contains("--hangar-token FILE"), "{error}");
    served.end().await;
}
