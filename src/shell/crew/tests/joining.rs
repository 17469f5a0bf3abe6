//! How a member joins and leaves, and how the host ends the crew.

use super::strangers::Raw;
use super::*;
use crate::app::state::{CrewLink, Overlay};
use crate::carrier::{DeskPort, Outbox};
use crate::crew::MOST_OF_ONE_USER;

impl Aboard {
    fn link(&self) -> Option<CrewLink> {
        let state = self.console.app.state();
        Some(state.crew().member()?.link(state.wall()))
    }

    fn message(&self) -> String {
        let message = self.console.app.state().message();
        message.map(|it| it.text.to_string()).unwrap_or_default()
    }

    fn question(&self) -> Option<String> {
        match self.console.app.state().overlay() {
            Some(Overlay::Confirm(confirm)) => Some(confirm.reason().to_string()),
            _ => None,
        }
    }
}

/// A host without a flight.
async fn idle_host(folder: &Path) -> Aboard {
    let crew = CrewOptions::Host {
        place: place(folder),
        name: "alpha".to_owned(),
    };
    let options = options(Opening::Home, crew, &folder.join("host"));
    Box::pin(Aboard::new(options)).await
}

/// Ends the host's console as the user or a signal does, while a member stays.
async fn end(host: Aboard, member: &mut Aboard) {
    let Aboard {
        mut console,
        mut end,
    } = host;
    Box::pin(console.close()).await;
    console.tell_crew(&mut end);
    let turns = async {
        while member.link() != Some(CrewLink::Ended) {
            Box::pin(member.turn()).await;
        }
    };
    tokio::join!(end.close(), turns);
}

#[tokio::test]
async fn who_is_not_let_in_ends_with_the_reason() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(idle_host(folder.path())).await;
    let mut others = Vec::new();
    for _ in 0..MOST_OF_ONE_USER {
        let mut raw = Raw::new(folder.path());
        raw.join(&mut host).await;
        others.push(raw);
    }
    let mut fifth = Box::pin(member(folder.path(), "anna", None)).await;
    until(&mut [&mut host, &mut fifth], |aboard| {
        aboard[1].console.over
    })
    .await;
    let why = fifth.console.require_joined().expect_err("it is denied");
    let expected = "your user has four consoles on the crew already: end one of them";
    assert_eq!(why.to_string(), expected);
    assert!(host.console.require_joined().is_ok());
}

#[tokio::test]
async fn a_member_hears_that_a_host_without_a_flight_ends_the_crew_and_leaves_at_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(idle_host(folder.path())).await;
    let mut anna = Box::pin(member(folder.path(), "anna", None)).await;
    assert_eq!(anna.link(), Some(CrewLink::Awaited));
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[1].link() == Some(CrewLink::Up)
    })
    .await;
    Box::pin(end(host, &mut anna)).await;
    assert!(anna.has_notice("has ended the crew"));
    assert!(!folder.path().join("alpha").exists(), "the folder is gone");
    // The end of the connection is no news then.
    until(&mut [&mut anna], |aboard| {
        let member = aboard[0].console.app.state().crew().member();
        !member.is_some_and(MemberPlace::is_connected)
    })
    .await;
    assert!(!anna.has_notice("is lost"));
    anna.say("leave").await;
    assert!(anna.console.over);
    assert!(anna.console.require_joined().is_ok());
}

#[tokio::test]
async fn a_member_is_asked_before_the_vehicles_go_back_to_the_host() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(host(folder.path(), THREE)).await;
    let mut anna = Box::pin(member(folder.path(), "anna", None)).await;
    until(&mut [&mut host, &mut anna], |aboard| {
        !aboard[1].is_waiting(3)
    })
    .await;
    let own = own_user_name();
    host.say(&format!("crew offer 3 to {}", named(2))).await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[1].has_notice("offers you 3: `crew accept 3` or `crew decline 3`")
    })
    .await;
    anna.say("crew").await;
    let open = format!("{own} offers 3 to {}", named(2));
    assert!(anna.message().contains(&open), "{}", anna.message());
    anna.say("crew accept 3").await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[1].session().pilots().own() == Some(vec![3])
    })
    .await;
    for line in ["quit", "leave"] {
        anna.say(line).await;
        let expected = format!("{own} then flies 3, which you fly now");
        assert_eq!(anna.question(), Some(expected), "{line}");
        anna.console.feed(key(KeyCode::Esc)).await;
        assert!(!anna.console.over, "{line}");
    }
    // The key needs no line, in the flight and in the brief.
    for room in ['1', 'b'] {
        anna.console.feed(key(KeyCode::Char(room))).await;
        anna.console.feed(key(KeyCode::Char('q'))).await;
        let expected = format!("{own} then flies 3, which you fly now");
        assert_eq!(anna.question(), Some(expected), "{room}");
        anna.console.feed(key(KeyCode::Esc)).await;
        assert!(!anna.console.over, "{room}");
    }
    // What a member has confirmed is named to the host.
    anna.say("3 kill").await;
    anna.console.feed(key(KeyCode::Char('1'))).await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[0].has_notice("has confirmed `3 kill`")
    })
    .await;
    Box::pin(end(host, &mut anna)).await;
    anna.console.feed(key(KeyCode::Char('q'))).await;
    assert!(anna.console.over);
}

/// The next line of a member at a host without a console.
async fn next_line(desk: &mut DeskPort<MemberMessage>, open: &mut Vec<Outbox>) -> MemberMessage {
    loop {
        match desk.next().await.expect("the crew is open") {
            DeskArrival::Opened { outbox, .. } => open.push(outbox),
            DeskArrival::Line { line, .. } => return line.expect("a line of a member"),
            DeskArrival::Closed(_) => panic!("the connection has ended"),
        }
    }
}

#[tokio::test]
async fn a_member_is_heard_while_its_console_does_something_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = place(folder.path()).open().expect("the crew opens");
    let mut anna = Box::pin(member(folder.path(), "anna", None)).await;
    let mut open = Vec::new();
    let joins = async {
        loop {
            Box::pin(anna.turn()).await;
        }
    };
    tokio::select! {
        line = next_line(&mut desk, &mut open) => {
            assert!(matches!(line, MemberMessage::Hello(_)), "{line:?}");
        }
        () = joins => {}
    }
    // The run loop of the console does not run any more.
    let long = Duration::from_secs(20);
    let line = tokio::time::timeout(long, next_line(&mut desk, &mut open)).await;
    assert_eq!(line, Ok(MemberMessage::Here));
}
