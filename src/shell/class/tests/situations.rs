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

#[tokio::test(start_paused = true)]
async fn a_recalled_flight_goes_on_from_where_it_was_captured() {
    let mut pair = Box::pin(Pair::flying(FIRST)).await;
    for line in ["1 guided", "1 arm", "1 takeoff 10"] {
        pair.anna.say(line).await;
        pair.run(3).await;
    }
    let done = OrderState::Ended(Outcome::Done);
    pair.desk.say("class capture climbing").await;
    pair.run(1).await;
    assert_eq!(pair.newest().0, done);
    assert!(!pair.anna.console.app.state().session().is_paused());
    let (then, captured) = (clock(&pair.anna), height(&pair.anna));

    pair.run(20).await;
    pair.anna.say("1 land").await;
    pair.run(20).await;
    let mut ends = Vec::new();
    for _ in 0..2 {
        pair.desk.say("class recall climbing").await;
        pair.desk.console.feed(key(KeyCode::Char('y'))).await;
        pair.run(1).await;
        assert_eq!(pair.newest().0, done);
        let state = pair.anna.console.app.state();
        assert!(state.session().is_paused());
        assert_eq!(state.session().ledger().entries().len(), 3);
        let (now, recalled) = (clock(&pair.anna), height(&pair.anna));
        assert!(
            now.abs_diff(then) <= Duration::from_secs(1),
            "{now:?} {then:?}"
        );
        assert!((recalled - captured).abs() < 3.0, "{recalled} {captured}");
        pair.run(5).await;
        assert_eq!(clock(&pair.anna), now, "it is frozen");

        pair.desk.say("class resume").await;
        pair.run(25).await;
        assert!(clock(&pair.anna) > now + Duration::from_secs(20));
        let hovering = height(&pair.anna);
        assert!((hovering - 10.0).abs() < 0.5, "{hovering}");
        let ledger = pair.anna.console.app.state().session().ledger();
        let takeoff = ledger.entries().next_back().expect("an entry");
        ends.push((takeoff.rows[0].state, takeoff.line.clone()));
    }
    assert_eq!(ends[0], ends[1]);
    assert_eq!(ends[0].0, crate::ledger::RowState::Done);
    // The vehicle obeys as before.
    pair.anna.say("1 land").await;
    pair.run(30).await;
    let landed = height(&pair.anna);
    assert!(landed < 0.5, "{landed}");
}

#[tokio::test(start_paused = true)]
async fn two_orders_at_once_are_carried_out_in_their_order() {
    let mut pair = Box::pin(Pair::flying(FIRST)).await;
    pair.desk.say("class capture early").await;
    pair.desk.say("class capture again").await;
    pair.run(2).await;
    let ends: Vec<OrderState> = pair.desk.seats()[0].orders().map(|it| it.state).collect();
    assert_eq!(ends, [OrderState::Ended(Outcome::Done); 2]);
    let then = clock(&pair.anna);
    pair.run(5).await;
    assert!(clock(&pair.anna) > then, "mission time continues");
}
