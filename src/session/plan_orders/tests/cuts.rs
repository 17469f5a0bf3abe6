//! Links that are cut in the middle of a transfer.

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use super::*;

/// The results of many transfers over a link that loses messages and is cut once.
#[derive(Debug, Default, PartialEq, Eq)]
struct Tally {
    new: usize,
    old: usize,
}

/// Uploads two lists alternately over a link that loses 30 % and is cut at a random moment of each transfer.
fn cut(kind: ListKind, by_file: bool, cuts: u64) -> Tally {
    // Item by item, reading the list on board alone takes most of a minute over such a link.
    let longest_ms = if by_file { 15_000 } else { 90_000 };
    let mut rig = Rig::new(by_file);
    let mut random = ChaCha8Rng::seed_from_u64(7 + cuts);
    let lists = [list(kind, 12, 1.0), list(kind, 17, 2.0)];
    rig.file("0", kind, &lists[0]);
    rig.file("1", kind, &lists[1]);
    rig.upload(kind, "0");
    assert_eq!(rig.ended(s(60)), RowState::Done);
    let mut tally = Tally::default();
    let mut held = 0;
    for round in 0..cuts {
        let wanted = 1 - held;
        rig.radio(0.3, 100, round);
        rig.upload(kind, &wanted.to_string());
        rig.pass(Duration::from_millis(random.random_range(0..longest_ms)));
        if !rig.state().is_some_and(RowState::is_final) {
            rig.radio(1.0, 100, round);
            rig.pass(Duration::from_millis(random.random_range(200..14_000)));
            rig.radio(0.3, 100, round + 1);
        }
        let state = rig.ended(s(600));
        rig.radio(0.0, 0, 0);
        let board = rig.on_board(kind);
        let has = |list: usize| {
            let file = rig.shelf.read(&list.to_string()).expect("it is there");
            compare::is_held(kind, &whole(&file.document, kind), &board)
        };
        assert!(
            has(0) != has(1),
            "round {round}: neither, {board:?}, {:?}",
            rig.row
        );
        let is_new = has(wanted);
        assert_eq!(
            is_new,
            state == RowState::Done,
            "round {round}: {:?}",
            rig.row
        );
        assert!(!rig.explanation().contains("not known"));
        if is_new {
            tally.new += 1;
            held = wanted;
        } else {
            tally.old += 1;
        }
        // Nothing that is still under way may change it later.
        rig.pass(s(10));
        let later = rig.on_board(kind);
        assert!(compare::is_same(kind, &board, &later), "round {round}");
    }
    tally
}

#[test]
fn a_plan_by_file_is_old_or_new_after_any_cut() {
    let tally = cut(ListKind::Plan, true, 30);
    assert!(tally.new >= 10 && tally.old >= 1, "{tally:?}");
}

#[test]
fn a_plan_by_items_is_old_or_new_after_any_cut() {
    let tally = cut(ListKind::Plan, false, 30);
    assert!(tally.new >= 10 && tally.old >= 1, "{tally:?}");
}

#[test]
fn a_fence_and_rally_points_are_old_or_new_after_any_cut() {
    for kind in [ListKind::Fence, ListKind::Rally] {
        for by_file in [true, false] {
            let tally = cut(kind, by_file, 8);
            assert!(tally.new >= 1, "{tally:?}");
        }
    }
}

#[test]
#[ignore = "takes minutes: run it after a change of the transfer"]
fn two_hundred_cuts_of_each_list_each_way() {
    for kind in ListKind::ALL {
        for by_file in [true, false] {
            let tally = cut(kind, by_file, 200);
            assert_eq!(tally.new + tally.old, 200);
            println!("{kind:?}, by file {by_file}: {tally:?}");
        }
    }
}
