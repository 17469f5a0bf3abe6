//! The desk captures a situation of a seat and recalls it.

use super::*;

/// The height of the vehicle above home, in metres.
fn height(seat: &Member) -> f64 {
    let vehicles = seat.console.app.state().session().vehicles();
    let position = vehicles[&1].global.as_ref().expect("a position");
    position.altitude_m
}

fn clock(seat: &Member) -> Duration {
    let progress = seat.console.app.state().session().mission();
    progress.expect("it flies").elapsed
}

fn newest(desk: &Member) -> OrderState {
    let order = desk.seats()[0].orders().next_back();
    order.expect("an order").state
}

#[tokio::test(start_paused = true)]
async fn a_recalled_flight_goes_on_from_where_it_was_captured() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = Box::pin(self::desk(folder.path())).await;
    let mut anna = Box::pin(seat(folder.path())).await;
    run(&mut [&mut desk, &mut anna], 4).await;
    anna.console.feed(key(KeyCode::Enter)).await;
    run(&mut [&mut desk, &mut anna], 2).await;
    for line in ["1 guided", "1 arm", "1 takeoff 10"] {
        anna.say(line).await;
        run(&mut [&mut desk, &mut anna], 3).await;
    }
    let done = OrderState::Ended(Outcome::Done);
    desk.say("class capture climbing").await;
    run(&mut [&mut desk, &mut anna], 1).await;
    assert_eq!(newest(&desk), done);
    assert!(!anna.console.app.state().session().is_paused());
    let (then, captured) = (clock(&anna), height(&anna));

    run(&mut [&mut desk, &mut anna], 20).await;
    anna.say("1 land").await;
    run(&mut [&mut desk, &mut anna], 20).await;
    let mut ends = Vec::new();
    for _ in 0..2 {
        desk.say("class recall climbing").await;
        desk.console.feed(key(KeyCode::Char('y'))).await;
        run(&mut [&mut desk, &mut anna], 1).await;
        assert_eq!(newest(&desk), done);
        let state = anna.console.app.state();
        assert!(state.session().is_paused());
        assert_eq!(state.session().ledger().entries().len(), 3);
        let (now, recalled) = (clock(&anna), height(&anna));
        assert!(
            now.abs_diff(then) <= Duration::from_secs(1),
            "{now:?} {then:?}"
        );
        assert!((recalled - captured).abs() < 3.0, "{recalled} {captured}");
        run(&mut [&mut desk, &mut anna], 5).await;
        assert_eq!(clock(&anna), now, "it is frozen");

        desk.say("class resume").await;
        run(&mut [&mut desk, &mut anna], 25).await;
        assert!(clock(&anna) > now + Duration::from_secs(20));
        let hovering = height(&anna);
        assert!((hovering - 10.0).abs() < 0.5, "{hovering}");
        let ledger = anna.console.app.state().session().ledger();
        let takeoff = ledger.entries().next_back().expect("an entry");
        ends.push((takeoff.rows[0].state, takeoff.line.clone()));
    }
    assert_eq!(ends[0], ends[1]);
    assert_eq!(ends[0].0, crate::ledger::RowState::Done);
    // The vehicle obeys as before.
    anna.say("1 land").await;
    run(&mut [&mut desk, &mut anna], 30).await;
    let landed = height(&anna);
    assert!(landed < 0.5, "{landed}");
}

#[tokio::test(start_paused = true)]
async fn two_orders_at_once_are_carried_out_in_their_order() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = Box::pin(self::desk(folder.path())).await;
    let mut anna = Box::pin(seat(folder.path())).await;
    run(&mut [&mut desk, &mut anna], 4).await;
    anna.console.feed(key(KeyCode::Enter)).await;
    run(&mut [&mut desk, &mut anna], 5).await;
    desk.say("class capture early").await;
    desk.say("class capture again").await;
    run(&mut [&mut desk, &mut anna], 2).await;
    let ends: Vec<OrderState> = desk.seats()[0].orders().map(|it| it.state).collect();
    assert_eq!(ends, [OrderState::Ended(Outcome::Done); 2]);
    let then = clock(&anna);
    run(&mut [&mut desk, &mut anna], 5).await;
    assert!(clock(&anna) > then, "mission time continues");
}
