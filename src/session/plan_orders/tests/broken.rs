//! Transfers that are interrupted because the console ends.

use super::rig::kept_name;
use super::*;

#[test]
fn the_old_list_survives_a_console_that_is_killed_in_the_middle_of_a_transfer() {
    let mut rig = Rig::new(false);
    let lists = [list(ListKind::Plan, 12, 1.0), list(ListKind::Plan, 17, 2.0)];
    rig.file("old", ListKind::Plan, &lists[0]);
    rig.file("new", ListKind::Plan, &lists[1]);
    rig.upload(ListKind::Plan, "old");
    assert_eq!(rig.ended(s(60)), RowState::Done);
    assert_eq!(rig.shelf.kept(1), []);
    rig.upload(ListKind::Plan, "new");
    while rig.percent < 40 {
        rig.step();
    }
    assert_eq!(rig.shelf.kept(1).len(), 1);
    // The console is killed, and started again later.
    rig.session =
        Session::new(1, 1, rig.now).with_plan_files(Arc::clone(&rig.shelf) as Arc<dyn PlanShelf>);
    said(&mut rig);
    rig.pass(s(30));
    let name = kept_name(1, ListKind::Plan);
    let told = said(&mut rig);
    let told = told
        .iter()
        .filter(|text| text.contains(&format!("`plan upload {name}`")));
    assert_eq!(told.count(), 1);
    // The list on board is now an incomplete transfer: it does not replace the whole list.
    rig.upload(ListKind::Plan, &name);
    assert_eq!(rig.ended(s(60)), RowState::Done, "{:?}", rig.row);
    let held = rig.on_board(ListKind::Plan);
    let old = whole(
        &rig.shelf.read("old").expect("it is there").document,
        ListKind::Plan,
    );
    assert!(compare::is_held(ListKind::Plan, &old, &held));
    assert_eq!(rig.shelf.kept(1), []);
}
