//! Transfers to the embedded simulator in lock step: over a bad link, by files and by items.

use mavlink::dialects::ardupilotmega::{MavMessage, PARAM_SET_DATA};

use super::*;
use crate::commands::{PlanCommand, PlanDeed, PlanSource};
use crate::geo::LatLon;
use crate::language;
use crate::ledger::EntryId;
use crate::ledger::RowUpdate;
use crate::plan::{Item, ListKind, command};
use crate::session::{Session, Want};
use crate::text::Text;
use crate::vehicle::Transfer;
use crate::vehicle::VehicleId;
use crate::wire::Encoder;

mod broken;
mod cuts;
mod flying;
mod judged;
mod rehearsed;
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

/// A list of `count` items, some metres apart.
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

#[test]
fn lists_of_a_mission_come_on_board_without_a_row_and_before_orders() {
    let mut rig = Rig::new(true);
    let document = Document {
        plan: list(ListKind::Plan, 6, 1.0),
        fence: list(ListKind::Fence, 2, 1.0),
        ..Document::default()
    };
    rig.session
        .carry_out(Want::Lists(Arc::new(document.clone())));
    rig.pass(s(10));
    assert!(rig.row.is_none(), "{:?}", rig.row);
    for kind in [ListKind::Plan, ListKind::Fence] {
        let held = known(rig.session.vehicle(), kind).expect("it was read");
        let own = compare::own(kind, &held);
        assert_eq!(own.len(), document.list(kind).len(), "{kind:?}");
        assert_eq!(own[1].command, document.list(kind)[1].command);
    }
    // Orders after it work as usual.
    rig.file("other", ListKind::Plan, &list(ListKind::Plan, 3, 2.0));
    rig.upload(ListKind::Plan, "other");
    assert_eq!(rig.ended(s(30)), RowState::Done);
}

#[test]
fn lists_of_a_mission_arrive_over_a_bad_link() {
    let mut rig = Rig::new(false);
    rig.radio(0.3, 100, 7);
    let document = Document {
        plan: list(ListKind::Plan, 8, 1.0),
        ..Document::default()
    };
    rig.session.carry_out(Want::Lists(Arc::new(document)));
    rig.pass(s(120));
    assert_eq!(rig.on_board(ListKind::Plan).len(), 9);
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
fn a_list_that_differs_by_a_rounding_is_replaced_so_that_its_name_is_that_of_the_file() {
    let mut rig = Rig::new(true);
    let items = list(ListKind::Plan, 6, 1.0);
    let mut rounded = items.clone();
    rounded[2].x += 1;
    rig.file("a", ListKind::Plan, &items);
    rig.file("rounded", ListKind::Plan, &rounded);
    for file in ["rounded", "a"] {
        rig.upload(ListKind::Plan, file);
        assert_eq!(rig.ended(s(30)), RowState::Done);
        assert!(rig.explanation().contains("read back and compared"));
    }
    let held = rig.on_board(ListKind::Plan);
    let name = compare::mark(compare::own(ListKind::Plan, &held));
    assert_eq!(name, compare::mark(&items));
}

#[test]
fn a_draft_goes_on_board_without_a_file() {
    let mut rig = Rig::new(true);
    let mut document = Document::default();
    for kind in ListKind::ALL {
        // The exclusion areas are away from the plan.
        let seed = if kind == ListKind::Fence { 20.0 } else { 2.0 };
        *document.list_mut(kind) = list(kind, 5, seed);
    }
    let document = Arc::new(document);
    for kind in ListKind::ALL {
        let source = PlanSource::document(Arc::clone(&document));
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
        rig.explanation()
            .contains("changed the list since this console"),
        "{}",
        rig.explanation()
    );
    rig.upload(ListKind::Rally, "c");
    assert_eq!(rig.ended(s(30)), RowState::Done);
}

#[test]
fn a_list_that_is_known_already_is_read_again_to_show_it() {
    for by_file in [true, false] {
        let mut rig = Rig::new(by_file);
        for kind in ListKind::ALL {
            let (old, new) = (list(kind, 5, 1.0), list(kind, 5, 2.0));
            rig.file("old", kind, &old);
            rig.file("new", kind, &new);
            rig.upload(kind, "old");
            assert_eq!(rig.ended(s(30)), RowState::Done, "{:?}", rig.row);
            rig.pass(s(10));
            // Another program's upload, which the console has not noticed.
            let before = rig.session.clone();
            rig.upload(kind, "new");
            assert_eq!(rig.ended(s(30)), RowState::Done, "{:?}", rig.row);
            rig.session = before;
            let mark = |rig: &Rig| {
                let held = known(rig.session.vehicle(), kind).expect("it is known");
                compare::mark(compare::own(kind, &held))
            };
            assert_eq!(mark(&rig), compare::mark(&old));
            rig.order(kind, PlanDeed::Show);
            assert_eq!(rig.ended(s(30)), RowState::Done, "{:?}", rig.row);
            assert_eq!(mark(&rig), compare::mark(&new));
            let explanation = rig.explanation();
            assert!(explanation.contains(&mark(&rig)), "{explanation}");
        }
    }
}

fn said(rig: &mut Rig) -> Vec<String> {
    let notices = std::mem::take(&mut rig.notices);
    notices.iter().map(|it| it.text.to_string()).collect()
}
