//! Transfers to the embedded simulator in lock step: over a bad link, by files and by items.

use mavlink::dialects::ardupilotmega::{MavMessage, PARAM_SET_DATA};

use super::*;
use crate::geo::LatLon;
use crate::language;
use crate::ledger::EntryId;
use crate::session::Session;
use crate::vehicle::Transfer;
use crate::wire::Encoder;

mod broken;
mod cuts;
mod flying;
mod rig;

use rig::Rig;

const STEP: Duration = Duration::from_millis(10);
const HOME: LatLon = LatLon {
    lat_deg: 50.4501,
    lon_deg: 30.5234,
};

fn s(seconds: u64) -> Duration {
    Duration::from_secs(seconds)
}

/// The list in the vehicle model, if it is known to be complete.
fn known(vehicle: &Vehicle, kind: ListKind) -> Option<Vec<Item>> {
    let plans = &vehicle.plans;
    let (items, transfer) = match kind {
        ListKind::Plan => {
            let items = plans.plan.content.as_ref().map(|it| it.items.clone());
            (items, plans.plan.transfer)
        }
        ListKind::Fence => {
            let items = plans.fence.content.as_ref().map(|it| it.items.clone());
            (items, plans.fence.transfer)
        }
        ListKind::Rally => {
            let items = plans.rally.content.as_ref().map(|it| it.items.clone());
            (items, plans.rally.transfer)
        }
    };
    items.filter(|_| transfer == Transfer::Done)
}

/// A list of so many items, some metres apart.
fn list(kind: ListKind, count: usize, seed: f64) -> Vec<Item> {
    let item = |at: usize| {
        let place = HOME.moved(
            40.0 + 7.0 * at as f64 * seed,
            60.0 * crate::geo::maths::cos(at as f64 + seed),
        );
        let (x, y) = place.to_e7();
        let (command, params) = match kind {
            ListKind::Plan if at == 0 => (22, [0.0, 0.0, 0.0, f32::NAN]),
            ListKind::Plan if at % 5 == 3 => (178, [1.0, 4.0 + at as f32, -1.0, 0.0]),
            ListKind::Plan => (16, [3.9, 2.0, 0.0, f32::NAN]),
            ListKind::Fence => (5004, [30.0 + at as f32, 0.0, 0.0, 0.0]),
            ListKind::Rally => (5100, [0.0; 4]),
        };
        Item {
            command,
            frame: if kind == ListKind::Fence { 0 } else { 6 },
            auto_continue: true,
            params,
            x,
            y,
            z: 20.257 + at as f32,
        }
    };
    (0..count).map(item).collect()
}

fn hands_out(rig: &Rig) -> bool {
    crate::session::logs::hands_out_files(rig.session.vehicle())
}

#[test]
fn every_list_goes_up_is_held_comes_down_and_is_cleared() {
    for by_file in [true, false] {
        let mut rig = Rig::new(by_file);
        for kind in ListKind::ALL {
            let items = list(kind, 9, 1.0);
            rig.file("a", kind, &items);
            rig.upload(kind, "a");
            assert_eq!(rig.ended(s(30)), RowState::Done, "{:?}", rig.row);
            assert!(rig.percent >= 70);
            let held = rig.on_board(kind);
            let sent = whole(&rig.shelf.read("a").expect("it is there").document, kind);
            assert!(compare::is_held(kind, &sent, &held), "{held:?}");
            rig.upload(kind, "a");
            assert_eq!(rig.ended(s(30)), RowState::Done);
            assert!(
                rig.explanation().contains("were already on board"),
                "{}",
                rig.explanation()
            );
            let file = "v{id}".to_owned();
            rig.order(kind, PlanDeed::Download { file });
            assert_eq!(rig.ended(s(30)), RowState::Done);
            let saved = rig.shelf.read("v1").expect("saved").document;
            let saved = whole(&saved, kind);
            assert!(compare::is_same(kind, &saved, &held));
            rig.order(kind, PlanDeed::Clear);
            assert_eq!(rig.ended(s(30)), RowState::Done);
            assert!(compare::own(kind, &rig.on_board(kind)).is_empty());
        }
    }
}

#[test]
fn a_draft_goes_on_board_without_a_file() {
    let mut rig = Rig::new(true);
    let mut document = Document::default();
    for kind in ListKind::ALL {
        // The areas to stay out of are away from the plan.
        let seed = if kind == ListKind::Fence { 20.0 } else { 2.0 };
        *document.list_mut(kind) = list(kind, 5, seed);
    }
    let document = Arc::new(document);
    for kind in ListKind::ALL {
        let source = PlanSource::Document(Arc::clone(&document));
        rig.order(kind, PlanDeed::Upload { source });
        assert_eq!(rig.ended(s(30)), RowState::Done, "{:?}", rig.row);
        let held = rig.on_board(kind);
        assert!(compare::is_held(kind, &whole(&document, kind), &held));
    }
}

#[test]
fn what_the_vehicle_would_refuse_is_not_sent() {
    let mut rig = Rig::new(true);
    let mut items = list(ListKind::Plan, 6, 1.0);
    items[4].command = 195;
    rig.file("bad", ListKind::Plan, &items);
    for file in ["bad", "missing"] {
        rig.upload(ListKind::Plan, file);
        assert_eq!(rig.ended(s(1)), RowState::Refused);
    }
    rig.upload(ListKind::Fence, "bad");
    assert_eq!(rig.ended(s(1)), RowState::Refused);
    assert!(compare::own(ListKind::Plan, &rig.on_board(ListKind::Plan)).is_empty());
}

#[test]
fn a_list_that_another_program_has_changed_is_replaced_only_by_a_second_order() {
    let mut rig = Rig::new(true);
    for (file, seed) in [("a", 1.0), ("b", 2.0), ("c", 3.0)] {
        rig.file(file, ListKind::Rally, &list(ListKind::Rally, 5, seed));
    }
    rig.upload(ListKind::Rally, "a");
    rig.ended(s(30));
    rig.pass(s(10));
    // Another program's upload of the same length, which the console has not noticed.
    let before = rig.session.clone();
    rig.upload(ListKind::Rally, "b");
    rig.ended(s(30));
    rig.session = before;
    rig.pass(s(1));
    rig.upload(ListKind::Rally, "c");
    assert_eq!(rig.ended(s(30)), RowState::Refused);
    assert!(
        rig.explanation().contains("changed since it was read"),
        "{}",
        rig.explanation()
    );
    rig.upload(ListKind::Rally, "c");
    assert_eq!(rig.ended(s(30)), RowState::Done);
}

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
        explanation.contains("changed since it was read"),
        "{explanation}"
    );
    rig.upload(kind, "c");
    assert_eq!(rig.ended(s(30)), RowState::Done);
}

/// A console that has just begun does not know the list on board: it asks only if there is one to lose.
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
    assert!(explanation.contains("was not known"), "{explanation}");
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

/// What the console has said since the last call, as text.
fn said(rig: &mut Rig) -> Vec<String> {
    let notices = std::mem::take(&mut rig.notices);
    notices.iter().map(|it| it.text.to_string()).collect()
}
