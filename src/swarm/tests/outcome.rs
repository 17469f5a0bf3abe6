//! What the ledger says.

use super::*;

#[test]
fn who_does_not_fly_is_refused_with_the_reason() {
    let mut stage = Stage::new(2, 10.0);
    stage.run(20.0);
    stage.say("all survey lane");
    let rows = stage.rows("survey");
    assert!(
        rows.iter().all(|(_, state, _)| *state == RowState::Refused),
        "{rows:?}"
    );
    assert!(rows[0].2.contains("GUIDED"), "{rows:?}");
    assert!(!stage.conductor.has(1));
}
