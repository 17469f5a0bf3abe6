//! The instructor flies a vehicle of a seat.

use super::*;
use crate::ledger::{LedgerEntry, RowState};

/// The newest order to the first seat, and what was said about it.
fn newest(desk: &Member) -> (OrderState, String) {
    let order = desk.seats()[0].orders().next_back().expect("an order");
    let why = order.why.as_ref().map(ToString::to_string);
    (order.state, why.unwrap_or_default())
}

fn ledger(seat: &Member) -> Vec<LedgerEntry> {
    let ledger = seat.console.app.state().session().ledger();
    ledger.entries().cloned().collect()
}

#[tokio::test(start_paused = true)]
async fn the_instructor_takes_a_vehicle_over_flies_it_and_hands_it_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = Box::pin(self::desk(folder.path())).await;
    let mut anna = Box::pin(seat(folder.path())).await;
    run(&mut [&mut desk, &mut anna], 4).await;
    anna.console.feed(key(KeyCode::Enter)).await;
    run(&mut [&mut desk, &mut anna], 2).await;

    desk.say("class say guided").await;
    run(&mut [&mut desk, &mut anna], 1).await;
    let refused = OrderState::Ended(Outcome::Refused(Refusal::NotTaken));
    assert_eq!(newest(&desk).0, refused);

    desk.say("class take").await;
    run(&mut [&mut desk, &mut anna], 1).await;
    let done = OrderState::Ended(Outcome::Done);
    assert_eq!(newest(&desk).0, done);
    let flight = desk.seats()[0].report.clone().and_then(|it| it.flight);
    assert_eq!(flight.map(|it| it.taken), Some(vec![1]));
    let screen = text(&drawn(&anna.console));
    assert!(screen.contains(" flies 1 "), "{screen}");

    // The trainee's command is refused, and named as such.
    anna.say("1 guided").await;
    run(&mut [&mut desk, &mut anna], 1).await;
    let entries = ledger(&anna);
    let row = &entries[0].rows[0];
    assert_eq!(row.state, RowState::Barred);
    let why = row.explanation.as_ref().expect("a reason").to_string();
    assert!(why.ends_with(" flies 1"), "{why}");

    // Watching the seat, the instructor types as the trainee does.
    desk.console.feed(key(KeyCode::Enter)).await;
    for (line, state) in [
        ("guided", done),
        ("1 arm", done),
        ("takeoff 20", OrderState::Ended(Outcome::UnderWay)),
    ] {
        desk.say(line).await;
        run(&mut [&mut desk, &mut anna], 6).await;
        assert_eq!(newest(&desk).0, state, "{line}");
    }
    run(&mut [&mut desk, &mut anna], 15).await;
    assert_eq!(newest(&desk).0, done);
    let entries = ledger(&anna);
    assert_eq!(entries.len(), 4);
    assert!(entries[1..].iter().all(|entry| entry.by.is_some()));
    assert!(entries[3].said().to_string().ends_with(": 1 takeoff 20"));
    desk.say("1 mode acro").await;
    run(&mut [&mut desk, &mut anna], 2).await;

    // The trainee's commands are counted without the instructor's.
    let commands = anna.place().seat().journal().entries();
    let commands = commands.filter(|it| matches!(it.what, Noted::Command { .. }));
    assert_eq!(commands.count(), 1);

    desk.say("class give").await;
    run(&mut [&mut desk, &mut anna], 1).await;
    anna.say("1 land").await;
    run(&mut [&mut desk, &mut anna], 2).await;
    let last = ledger(&anna).pop().expect("an entry");
    assert_ne!(last.rows[0].state, RowState::Barred);
    assert_eq!(last.by, None);
}

#[tokio::test(start_paused = true)]
async fn vehicles_go_back_to_the_trainee_when_the_desk_is_gone() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = Box::pin(self::desk(folder.path())).await;
    let mut anna = Box::pin(seat(folder.path())).await;
    run(&mut [&mut desk, &mut anna], 4).await;
    anna.console.feed(key(KeyCode::Enter)).await;
    desk.say("class take 1").await;
    run(&mut [&mut desk, &mut anna], 2).await;
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
