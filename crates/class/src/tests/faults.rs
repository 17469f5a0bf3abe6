//! Faults of consoles and machines, and seats that mean harm.

use super::rig::end_order;
use super::*;

/// Lets a desk and a seat talk for so many steps.
fn run(rig: &mut Rig, steps: u32) {
    (0..steps).for_each(|_| rig.step());
}

fn note(seat: &mut Seat, count: usize) {
    for _ in 0..count {
        seat.note(Some(1.0), Happening::Started { mission: None });
    }
}

#[test]
fn clocks_that_are_hours_apart_change_nothing() {
    let hours = seconds(7 * 3600);
    for (desk_at, seat_ahead) in [(Duration::ZERO, hours), (hours, Duration::ZERO)] {
        let mut rig = Rig::new(Vec::new());
        (rig.now, rig.seat_ahead) = (desk_at, seat_ahead);
        rig.fly();
        note(&mut rig.seat, 100);
        rig.seat.hand_in_mut().offer(submission(&content()));
        run(&mut rig, 10);
        let now = rig.now;
        rig.desk.give(&[0], &Deed::Freeze, now);
        run(&mut rig, 20);
        let now = rig.now;
        assert!(!rig.desk.expire(now), "no order is late");
        let seat = &rig.desk.seats()[0];
        let given: Vec<OrderState> = seat.orders().map(|it| it.state).collect();
        assert_eq!(given, [OrderState::Ended(Outcome::Done)]);
        assert!(seat.journal.entries().eq(rig.seat.journal().entries()));
        assert!(now <= seat.heard_at + REPORT_EVERY + STEP, "it reports");
        assert_eq!(rig.kept, 1, "the record was handed in");
    }
}

#[test]
fn a_full_journal_loses_its_oldest_entries_which_the_desk_counts() {
    let mut rig = Rig::new(Vec::new());
    // The network is gone all the while.
    note(&mut rig.seat, KEPT + 100);
    run(&mut rig, 20);
    let journal = |rig: &Rig| rig.desk.seats()[0].journal.clone();
    let copy = journal(&rig);
    assert_eq!((copy.missing(), copy.last()), (100, KEPT as u64 + 100));
    assert!(copy.entries().eq(rig.seat.journal().entries()));
    // The desk drops the oldest ones, too, and counts them.
    note(&mut rig.seat, 50);
    run(&mut rig, 20);
    let copy = journal(&rig);
    assert_eq!((copy.missing(), copy.entries().count()), (150, KEPT));
    assert!(copy.entries().eq(rig.seat.journal().entries()));
}

#[test]
fn a_seat_that_joins_late_hands_in_its_whole_journal_and_gets_no_earlier_order() {
    let mut rig = Rig::new(Vec::new());
    joined(&mut rig.desk, 100, "bohdan", 12);
    let before = rig.now;
    rig.desk.give(&[0], &Deed::Freeze, before);
    rig.now += seconds(3600);
    note(&mut rig.seat, 200);
    run(&mut rig, 20);
    let late = &rig.desk.seats()[1];
    assert_eq!((late.name.as_str(), late.journal.missing()), ("anna", 0));
    assert!(late.journal.entries().eq(rig.seat.journal().entries()));
    assert!(rig.done.is_empty(), "{:?}", rig.done);
}

/// A copy of a running console has the number of its sitting.
#[test]
fn of_two_connections_with_one_sitting_only_the_newer_one_speaks() {
    let mut desk = desk();
    joined(&mut desk, 1, "anna", 10);
    joined(&mut desk, 2, "anna", 10);
    assert_eq!(names(&desk), ["anna"]);
    let said = desk.hear(ConnectionId(1), "anna", report(None), seconds(1));
    assert_eq!(said, Err(Denial::NoHello));
    let said = desk.hear(ConnectionId(2), "anna", report(None), seconds(1));
    assert_eq!(said, Ok(DeskHeard::Known));
}

#[test]
fn a_seat_cannot_answer_for_another() {
    let mut desk = desk();
    joined(&mut desk, 1, "anna", 10);
    joined(&mut desk, 2, "eve", 11);
    desk.give(&[0], &Deed::Freeze, Duration::ZERO);
    let order = desk.seats()[0].orders().next().expect("an order");
    let order = order.order.clone();
    let mut journal = Journal::default();
    end_order(&mut journal, order, Outcome::Done);
    let batch = journal.from(1).expect("an entry");
    let said = SeatMessage::Entries(batch);
    let heard = desk.hear(ConnectionId(2), "eve", said, seconds(1));
    assert_eq!(heard, Ok(DeskHeard::Known));
    let state = desk.seats()[0].orders().next().map(|it| it.state);
    assert_eq!(state, Some(OrderState::Waiting));
}

#[test]
fn a_console_that_is_back_before_its_old_connection_has_ended_keeps_its_seat() {
    let mut desk = desk();
    joined(&mut desk, 1, "anna", 10);
    joined(&mut desk, 2, "anna", 10);
    desk.leave(ConnectionId(1), seconds(1));
    assert_eq!(desk.seats().len(), 1);
    assert_eq!(desk.seats()[0].presence, Presence::Here(ConnectionId(2)));
}

#[test]
fn another_user_cannot_take_a_seat_by_its_number() {
    let mut desk = desk();
    joined(&mut desk, 1, "anna", 10);
    joined(&mut desk, 2, "eve", 10);
    assert_eq!(names(&desk), ["anna", "eve"]);
}

#[test]
fn what_a_seat_has_dropped_is_known_to_be_missing() {
    let mut journal = Journal::default();
    let what = Happening::Started { mission: None };
    for _ in 0..KEPT + 10 {
        journal.note(None, what.clone());
    }
    let mut copy = JournalCopy::default();
    let new = copy.receive(journal.from(1).expect("there are entries"));
    assert_eq!(copy.missing(), 10);
    assert_eq!(
        (new[0].number, new.len(), copy.last()),
        (11, BATCH, 10 + BATCH as u64)
    );
}

#[test]
fn numbers_beyond_all_reason_do_no_harm() {
    let what = Happening::Started { mission: None };
    let entry = |number| Entry {
        number,
        clock_s: None,
        what: what.clone(),
    };
    let mut copy = JournalCopy::default();
    for kept_from in [u64::MAX, u64::MAX - 1, 5] {
        copy.receive(JournalBatch {
            kept_from,
            entries: vec![entry(u64::MAX), entry(0), entry(u64::MAX)],
        });
    }
    assert!(copy.missing() > 0);
    assert_eq!(copy.next_number(), u64::MAX);
}
