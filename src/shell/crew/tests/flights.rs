//! What members see of the host's flights, and what they command.

use std::collections::BTreeMap;

use super::*;
use crate::ledger::RowState;

#[tokio::test]
async fn a_member_flies_a_vehicle_that_was_handed_over_and_both_see_who_commanded() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(host(folder.path(), THREE)).await;
    let mut anna = Box::pin(member(folder.path(), "anna", None)).await;
    until(&mut [&mut host, &mut anna], |aboard| {
        !aboard[1].is_waiting(3)
    })
    .await;
    let (own, theirs) = (own_user_name(), named(2));
    // A late joiner has the whole flight, with the names as this member sees them.
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[1].has_ended("all guided", Some(&own), RowState::Done)
    })
    .await;
    assert_eq!(anna.session().pilots().own(), Some(Vec::new()));

    host.say(&format!("crew offer 3 to {theirs}")).await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[1].has_notice("offers you 3")
    })
    .await;
    anna.say("crew accept").await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[1].session().pilots().own() == Some(vec![3])
    })
    .await;
    anna.say("3 arm").await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[0].has_ended("3 arm", Some(&theirs), RowState::Done)
            && aboard[1].has_ended("3 arm", None, RowState::Done)
    })
    .await;
    // The member's own console asks before a dangerous command.
    anna.say("3 kill").await;
    anna.console.feed(key(KeyCode::Char('1'))).await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[0].has_ended("3 kill", Some(&theirs), RowState::Done)
    })
    .await;
    // Each is refused the vehicles of the other.
    host.say("3 land").await;
    anna.say("1 arm").await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[1].has_ended("1 arm", None, RowState::Barred)
    })
    .await;
    let (entry, _) = anna.last().expect("a command");
    let why = entry.rows[0].explanation.as_ref().expect("a reason");
    assert_eq!(why.to_string(), format!("{own} flies 1"));
    let landed = host
        .session()
        .ledger()
        .entries()
        .find(|it| it.line == "3 land");
    assert_eq!(landed.map(|it| it.rows[0].state), Some(RowState::Barred));

    // Who leaves gives the vehicles back.
    let copy = std::fs::read_dir(folder.path().join("anna/crew")).expect("a copy");
    assert_eq!(copy.count(), 4, "the copy remains");
    anna.end.close().await;
    until(&mut [&mut host], |aboard| {
        aboard[0].has_notice("has left the crew: you fly 3")
    })
    .await;
    assert_eq!(host.session().pilots().of(3), None);
}

/// The files in a folder and below, by name.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            let name = path.file_name().expect("a name").to_string_lossy();
            found.insert(name.into_owned(), std::fs::read(&path).expect("a file"));
        }
    }
    found
}

/// The copies of a member that differ from the host's files.
fn differing(folder: &Path, member: &str) -> Vec<String> {
    let (own, theirs) = (
        files(&folder.join("host")),
        files(&folder.join(member).join("crew")),
    );
    let differs = theirs
        .iter()
        .filter(|(name, _)| !name.ends_with(".viewer.json"))
        .filter(|(name, bytes)| own.get(*name) != Some(bytes));
    differs.map(|(name, _)| name.clone()).collect()
}

#[tokio::test]
async fn a_member_gets_every_flight_to_its_end() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(host(folder.path(), THREE)).await;
    let mut anna = Box::pin(member(folder.path(), "anna", None)).await;
    until(&mut [&mut host, &mut anna], |aboard| {
        !aboard[1].is_waiting(3)
    })
    .await;
    host.say("all arm").await;
    Box::pin(host.console.start_again(true))
        .await
        .expect("it starts");
    let copies = folder.path().join("anna/crew");
    let first: Vec<_> = files(&copies).into_keys().collect();
    until(&mut [&mut host, &mut anna], |aboard| {
        files(&copies).len() == 8 && !aboard[1].is_waiting(3)
    })
    .await;
    let differing_now = differing(folder.path(), "anna");
    assert!(first.iter().all(|name| !differing_now.contains(name)));
    host.say("all guided").await;
    Box::pin(host.turn()).await;
    // The host quits.
    let Aboard {
        mut console,
        mut end,
    } = host;
    Box::pin(console.close()).await;
    console.tell_crew(&mut end);
    let turns = async {
        while anna
            .console
            .app
            .state()
            .crew()
            .member()
            .is_some_and(MemberPlace::is_connected)
        {
            Box::pin(anna.turn()).await;
        }
    };
    tokio::join!(end.close(), turns);
    assert_eq!(differing(folder.path(), "anna"), [""; 0]);
    until(&mut [&mut anna], |aboard| {
        aboard[0].has_notice("has ended")
            && aboard[0]
                .last()
                .is_some_and(|(entry, _)| entry.line == "all guided")
    })
    .await;
}
