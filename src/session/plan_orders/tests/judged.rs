//! The lists that an upload replaces or refuses, and the hash of the list that it writes.

use super::*;

/// A list that is read in the background after another program's upload is new to the user as well.
#[test]
fn a_changed_list_that_was_read_in_the_background_is_replaced_only_by_a_second_order() {
    let mut rig = Rig::new(true);
    for (file, seed) in [("a", 1.0), ("b", 2.0), ("c", 3.0)] {
        rig.file(file, ListKind::Plan, &list(ListKind::Plan, 5, seed));
    }
    rig.upload(ListKind::Plan, "a");
    assert_eq!(rig.ended(s(30)), RowState::Done);
    rig.pass(s(10));
    // Another program's upload, after which the console reads the list again.
    let before = rig.session.clone();
    rig.upload(ListKind::Plan, "b");
    assert_eq!(rig.ended(s(30)), RowState::Done);
    let others = known(rig.session.vehicle(), ListKind::Plan);
    rig.session = before;
    rig.pass(s(300));
    let kind = ListKind::Plan;
    let read = known(rig.session.vehicle(), kind).expect("read again");
    assert!(compare::is_same(kind, &read, &others.expect("read")));
    rig.upload(kind, "c");
    assert_eq!(rig.ended(s(30)), RowState::Refused);
    let explanation = rig.explanation();
    assert!(
        explanation.contains("changed the list since this console"),
        "{explanation}"
    );
    rig.upload(kind, "c");
    assert_eq!(rig.ended(s(30)), RowState::Done);
}

/// A console that has just begun has not read the list on board: it requires a second order only if
/// there is a list to lose.
#[test]
fn a_list_that_is_not_known_yet_is_replaced_only_by_a_second_order() {
    let mut rig = Rig::new(true);
    for (file, seed) in [("a", 1.0), ("b", 2.0)] {
        rig.file(file, ListKind::Plan, &list(ListKind::Plan, 5, seed));
    }
    let anew = |rig: &mut Rig| {
        rig.session = Session::new(1, 1, rig.now)
            .with_plan_files(Arc::clone(&rig.shelf) as Arc<dyn PlanShelf>);
        rig.pass(s(2));
        assert_eq!(known(rig.session.vehicle(), ListKind::Plan), None);
    };
    anew(&mut rig);
    rig.upload(ListKind::Plan, "a");
    assert_eq!(rig.ended(s(30)), RowState::Done, "nothing was on board");
    anew(&mut rig);
    rig.upload(ListKind::Plan, "a");
    assert_eq!(rig.ended(s(30)), RowState::Done, "the same list");
    anew(&mut rig);
    rig.upload(ListKind::Plan, "b");
    assert_eq!(rig.ended(s(30)), RowState::Refused);
    let explanation = rig.explanation();
    assert!(explanation.contains("had not read"), "{explanation}");
    rig.upload(ListKind::Plan, "b");
    assert_eq!(rig.ended(s(30)), RowState::Done);
}

#[test]
fn errors_of_a_check_refuse_an_upload_and_warnings_are_in_its_row() {
    let mut rig = Rig::new(true);
    let mut items = list(ListKind::Plan, 4, 1.0);
    items.remove(0);
    rig.file("open", ListKind::Plan, &items);
    rig.upload(ListKind::Plan, "open");
    assert_eq!(rig.ended(s(30)), RowState::Done);
    let explanation = rig.explanation();
    for part in ["read back", "warnings: ", "takeoff"] {
        assert!(explanation.contains(part), "{explanation}");
    }
    let ring = Item {
        command: command::DO_JUMP,
        params: [5.0, 2.0, 0.0, 0.0],
        ..Item::default()
    };
    items.extend([
        ring,
        Item {
            command: 20,
            ..ring
        },
    ]);
    items[3].params[0] = 4.0;
    rig.file("ring", ListKind::Plan, &items);
    rig.upload(ListKind::Plan, "ring");
    assert_eq!(rig.ended(s(1)), RowState::Refused);
    // A hold that the vehicle would cut to 16 bits.
    let mut held = list(ListKind::Plan, 4, 1.0);
    held[2].params[0] = 70_000.0;
    rig.file("held", ListKind::Plan, &held);
    rig.upload(ListKind::Plan, "held");
    assert_eq!(rig.ended(s(1)), RowState::Refused);
    let explanation = rig.explanation();
    assert!(explanation.contains("would store 4464 s"), "{explanation}");
    // More bytes than the vehicle has for fences.
    rig.file("large", ListKind::Fence, &list(ListKind::Fence, 60, 1.0));
    rig.upload(ListKind::Fence, "large");
    assert_eq!(rig.ended(s(1)), RowState::Refused);
    let explanation = rig.explanation();
    assert!(
        explanation.contains("784 bytes") && explanation.contains("560"),
        "{explanation}"
    );
    assert!(compare::own(ListKind::Fence, &rig.on_board(ListKind::Fence)).is_empty());
}

/// A file with several lists is uploaded list by list, and each upload reports only the warnings
/// about its own list.
#[test]
fn an_upload_warns_of_its_own_list_only() {
    let mut rig = Rig::new(true);
    rig.file("noted", ListKind::Rally, &list(ListKind::Rally, 3, 1.0));
    rig.upload(ListKind::Rally, "noted");
    assert_eq!(rig.ended(s(30)), RowState::Done);
    let explanation = rig.explanation();
    let is_own = explanation.contains("warning: about Rally");
    let is_other = explanation.contains("about Plan") || explanation.contains("about Fence");
    assert!(!is_other && is_own, "{explanation}");
}

#[test]
fn a_file_and_the_list_on_board_have_the_same_hash() {
    for by_file in [true, false] {
        let mut rig = Rig::new(by_file);
        for kind in ListKind::ALL {
            let mut items = list(kind, 8, 1.0);
            if kind == ListKind::Plan {
                items[1].params = [2.5, 7.0, 3.0, 90.0];
                items[2].z = 20.3;
                let z = 21.55;
                items.push(Item {
                    command: 19,
                    z,
                    ..items[1]
                });
                items.push(Item {
                    command: 21,
                    z: 0.0,
                    ..items[1]
                });
            }
            rig.file("a", kind, &items);
            rig.upload(kind, "a");
            assert_eq!(rig.ended(s(30)), RowState::Done, "{:?}", rig.row);
            let mark = compare::mark(&items);
            assert!(
                rig.explanation().contains(&mark),
                "{mark} {}",
                rig.explanation()
            );
            let held = rig.on_board(kind);
            assert_eq!(compare::mark(compare::own(kind, &held)), mark);
        }
    }
}
