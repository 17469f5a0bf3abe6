//! Several seats watched at once, and a replay that the desk shows to its class.

use super::records::{keeping, until};
use super::*;
use crate::app::state::{Room, SMALLEST};
use crate::class::Watching;

impl Member {
    fn room(&self) -> Room {
        self.console.app.state().room()
    }

    fn sees(&self, word: &str) -> bool {
        let seat = self.place().seat();
        seat.shown()
            .is_some_and(|picture| text(picture).contains(word))
    }

    fn is_replaying(&self) -> bool {
        self.console.app.state().replay().is_some()
    }
}

#[tokio::test(start_paused = true)]
async fn four_seats_tell_what_is_behind_their_screens_while_they_have_a_tile() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = Box::pin(self::desk(folder.path())).await;
    let mut seats = Vec::new();
    for _ in 0..5 {
        seats.push(Box::pin(flying(folder.path(), WITH_INJECTS)).await);
    }
    let [one, two, three, four, five] = &mut seats[..] else {
        unreachable!("there are five");
    };
    run(&mut [&mut desk, one, two, three, four, five], 4).await;
    for seat in [&mut *one, two, three, four, five] {
        seat.console.feed(key(KeyCode::Enter)).await;
    }
    run(&mut [&mut desk, one, two, three, four, five], 2).await;
    assert!(desk.seats().iter().all(|seat| seat.insight().is_none()));

    desk.console.feed(key(KeyCode::Char('w'))).await;
    run(&mut [&mut desk, one, two, three, four, five], 3).await;
    let role = desk.console.app.state().class_role();
    let watching = role.desk().expect("a desk").watching();
    assert!(matches!(watching, Watching::Tiles(seats) if seats.len() == 4));
    let known: Vec<_> = desk.seats().iter().filter_map(|it| it.insight()).collect();
    assert_eq!(known.len(), 4);
    for insight in known {
        assert!(!insight.objectives.is_empty());
        for vehicle in &insight.vehicles {
            assert!(vehicle.truth.is_some(), "{vehicle:?}");
            assert!(vehicle.error_m().is_some_and(|it| it < 5.0), "{vehicle:?}");
        }
    }
    assert!(desk.seats().iter().all(|seat| seat.picture().is_none()));

    desk.console.feed(key(KeyCode::Enter)).await;
    run(&mut [&mut desk, one, two, three, four, five], 1).await;
    let pictures = desk.seats().iter().filter_map(|it| it.picture());
    assert_eq!(pictures.count(), 1);
}

#[tokio::test]
async fn a_replay_at_the_desk_is_shown_to_seats_that_do_not_fly() {
    let folder = tempfile::tempdir().expect("a folder");
    let (own, theirs) = (folder.path().join("anna"), folder.path().join("petro"));
    let mut desk = keeping(Opening::Home, desk_options(folder.path()), &theirs).await;
    let mission = Arc::new(Mission::parse(FIRST).expect("it is good"));
    let opening = || Opening::Mission(Arc::clone(&mission));
    for _ in 0..2 {
        let mut anna = keeping(opening(), seat_options(folder.path()), &own).await;
        anna.console.feed(key(KeyCode::Enter)).await;
        until(&mut [&mut desk, &mut anna], |members| {
            members[1].is_flying()
        })
        .await;
        let before = desk.flights();
        let mut quits = Box::pin(anna.quit());
        // Its console hands the record in while it ends.
        loop {
            tokio::select! {
                () = &mut quits => break,
                () = tokio::time::sleep(TICK) => Box::pin(desk.turn()).await,
            }
        }
        until(&mut [&mut desk], |members| members[0].flights() > before).await;
    }

    let mut watches = keeping(Opening::Home, seat_options(folder.path()), &own).await;
    // The smallest terminal.
    let (columns, rows) = SMALLEST;
    let resize = TerminalEvent::Resize { columns, rows };
    watches.console.feed(resize).await;
    let mut flies = Box::pin(seat(folder.path())).await;
    let user = desk.seats()[0].user().to_owned();
    desk.say(&format!("class replay {user} with {user}")).await;
    until(&mut [&mut desk, &mut watches, &mut flies], |members| {
        let state = members[0].console.app.state();
        state.replay().is_some() && state.ghost().is_some() && state.room() == Room::Class
    })
    .await;
    desk.say("class show @all").await;
    until(&mut [&mut desk, &mut watches, &mut flies], |members| {
        members[1].sees("score") && members[1].room() == Room::Class
    })
    .await;
    let at_seat = text(&drawn(&watches.console));
    assert!(at_seat.contains("shows"), "{at_seat}");
    let refused = OrderState::Ended(Outcome::Refused(Refusal::Flying));
    let last = |desk: &Member| -> Vec<_> {
        let seats = desk.seats().iter();
        let orders = seats.filter_map(|seat| seat.orders().next_back());
        orders.map(|given| given.state).collect()
    };
    until(&mut [&mut desk, &mut watches, &mut flies], |members| {
        last(members[0]).contains(&refused)
    })
    .await;
    assert!(!flies.place().seat().looks_on());
    assert_ne!(flies.room(), Room::Class);

    // The board is not for the class: what was shown last stays.
    desk.say("show home").await;
    run(&mut [&mut desk, &mut watches, &mut flies], 1).await;
    assert!(watches.sees("score"));
    watches.console.feed(key(KeyCode::Esc)).await;
    until(&mut [&mut desk, &mut watches, &mut flies], |members| {
        members[0].seats().iter().all(|seat| !seat.looks_on())
    })
    .await;
    assert_eq!(watches.room(), Room::Home);

    desk.say("class show @all").await;
    until(&mut [&mut desk, &mut watches, &mut flies], |members| {
        members[1].place().seat().looks_on()
    })
    .await;
    desk.console.feed(key(KeyCode::Char('Q'))).await;
    until(&mut [&mut desk, &mut watches, &mut flies], |members| {
        !members[0].is_replaying() && !members[1].place().seat().looks_on()
    })
    .await;
    assert_eq!(watches.room(), Room::Home);
    assert_eq!(desk.room(), Room::Class);
}
