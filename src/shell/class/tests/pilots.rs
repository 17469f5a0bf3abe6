//! The instructor flies a vehicle of a seat.

use super::*;
use crate::ledger::{LedgerEntry, RowState};

fn ledger(seat: &Member) -> Vec<LedgerEntry> {
    let ledger = seat.console.app.state().session().ledger();
    ledger.entries().cloned().collect()
}

#[tokio::test(start_paused = true)]
async fn the_instructor_takes_a_vehicle_over_flies_it_and_hands_it_back() {
    let mut pair = Box::pin(Pair::flying(FIRST)).await;

    pair.desk.say("class say guided").await;
    pair.run(1).await;
    let refused = OrderState::Ended(Outcome::Refused(Refusal::NotTaken));
    assert_eq!(pair.newest().0, refused);

    pair.desk.say("class take").await;
    pair.run(1).await;
    let done = OrderState::Ended(Outcome::Done);
    assert_eq!(pair.newest().0, done);
    let flight = pair.desk.seats()[0].report.clone().and_then(|it| it.flight);
    assert_eq!(flight.map(|it| it.taken), Some(vec![1]));
    let screen = text(&drawn(&pair.anna.console));
    assert!(screen.contains(" flies 1 "), "{screen}");

    // The trainee's command is refused, and named as such.
    pair.anna.say("1 guided").await;
    pair.run(1).await;
    let entries = ledger(&pair.anna);
    let row = &entries[0].rows[0];
    assert_eq!(row.state, RowState::Barred);
    let why = row.explanation.as_ref().expect("a reason").to_string();
    assert!(why.ends_with(" flies 1"), "{why}");

    // Watching the seat, the instructor types as the trainee does.
    pair.desk.console.feed(key(KeyCode::Enter)).await;
    for (line, state) in [
        ("guided", done),
        ("1 arm", done),
        ("takeoff 20", OrderState::Ended(Outcome::UnderWay)),
    ] {
        pair.desk.say(line).await;
        pair.run(6).await;
        assert_eq!(pair.newest().0, state, "{line}");
    }
    pair.run(15).await;
    assert_eq!(pair.newest().0, done);
    let entries = ledger(&pair.anna);
    assert_eq!(entries.len(), 4);
    assert!(entries[1..].iter().all(|entry| entry.by.is_some()));
    assert!(entries[3].said().to_string().ends_with(": 1 takeoff 20"));
    pair.desk.say("1 mode acro").await;
    pair.run(2).await;

    // The trainee's commands are counted without the instructor's.
    let commands = pair.anna.place().seat().journal().entries();
    let commands = commands.filter(|it| matches!(it.what, Noted::Command { .. }));
    assert_eq!(commands.count(), 1);

    pair.desk.say("class give").await;
    pair.run(1).await;
    pair.anna.say("1 land").await;
    pair.run(2).await;
    let last = ledger(&pair.anna).pop().expect("an entry");
    assert_ne!(last.rows[0].state, RowState::Barred);
    assert_eq!(last.by, None);
}

#[tokio::test(start_paused = true)]
async fn a_command_that_a_vehicle_does_not_take_from_the_instructor_is_a_matter_of_the_desk() {
    let mut pair = Box::pin(Pair::flying(FIRST)).await;
    pair.anna.say("1 guided").await;
    pair.run(3).await;
    pair.desk.say("class take").await;
    pair.run(1).await;
    let shown = |seat: &Member| {
        let session = seat.console.app.state().session();
        let latest = session
            .latest(1)
            .map(|(entry, row)| (entry.line.clone(), row.state));
        (latest, session.ledger().newest_first().count())
    };
    let before = shown(&pair.anna);
    assert_eq!(before, (Some(("1 guided".to_owned(), RowState::Done)), 1));
    // It is not armed.
    for _ in 0..2 {
        pair.desk.say("class say takeoff 20").await;
        pair.run(3).await;
        let refused = OrderState::Ended(Outcome::Refused(Refusal::Vehicle));
        assert_eq!(pair.newest().0, refused, "{}", pair.newest().1);
        assert_eq!(shown(&pair.anna), before);
    }
    pair.desk.say("class say arm").await;
    pair.run(3).await;
    let arm = (Some(("1 arm".to_owned(), RowState::Done)), 2);
    assert_eq!(shown(&pair.anna), arm);
}

#[tokio::test(start_paused = true)]
async fn vehicles_go_back_to_the_trainee_when_the_desk_is_gone() {
    let mut pair = Box::pin(Pair::flying(FIRST)).await;
    pair.desk.say("class take 1").await;
    pair.run(2).await;
    let Pair {
        desk,
        mut anna,
        folder: _folder,
    } = pair;
    anna.say("class leave").await;
    assert!(anna.place().seat().class().is_some(), "it is kept");
    drop(desk);
    run(&mut [&mut anna], 6).await;
    let taken = |anna: &Member| anna.console.app.state().session().pilots().of(1).is_some();
    assert!(taken(&anna));
    run(&mut [&mut anna], 5).await;
    assert!(!taken(&anna));
    let screen = text(&drawn(&anna.console));
    assert!(screen.contains("no longer flies 1; you do"), "{screen}");
}
