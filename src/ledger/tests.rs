//! Rows of the operator's own commands, and of those of other stations.

use super::*;
use crate::verb::{CountsAs, CrewDuty, Danger, Movement, Precedence, Retry};
use crate::wire::MavAddress;

#[test]
fn the_revision_tells_whether_anything_has_changed() {
    let mut ledger = Ledger::new();
    let before = ledger.revision();
    let entry = ledger.open(Duration::ZERO, given("all arm"), &[1]);
    let opened = ledger.revision();
    assert!(opened > before);
    let _ = ledger.entries().count();
    assert_eq!(ledger.revision(), opened);
    ledger.apply(&RowUpdate {
        entry,
        vehicle: 1,
        state: RowState::Done,
        tries: 1,
        at: Duration::ZERO,
        explanation: None,
    });
    assert!(ledger.revision() > opened);
}

const ARM: Verb = Verb {
    name: "arm",
    danger: Danger::None,
    retry: Retry::new(3, 1000, 3500),
    precedence: Precedence::Awaited,
    movement: Movement::None,
    counts_as: CountsAs::Task,
    duty: CrewDuty::Flying,
    unsuited: &[],
};

fn given(line: &str) -> Given<'_> {
    Given {
        line,
        verb: &ARM,
        risk: Risk::None,
        by: None,
    }
}

fn update(entry: EntryId, vehicle: VehicleId, state: RowState, at_s: u64) -> RowUpdate {
    RowUpdate {
        entry,
        vehicle,
        state,
        tries: 1,
        at: Duration::from_secs(at_s),
        explanation: None,
    }
}

#[test]
fn each_vehicle_has_its_own_outcome() {
    let mut ledger = Ledger::new();
    let id = ledger.open(Duration::from_secs(10), given("1-2 arm"), &[1, 2]);
    ledger.apply(&update(id, 2, RowState::Sent, 10));
    ledger.apply(&update(id, 2, RowState::Refused, 11));
    let entry = ledger.entry(id).expect("just opened");
    assert_eq!(entry.rows[0].state, RowState::Queued);
    assert_eq!(entry.rows[1].state, RowState::Refused);
    assert_eq!(entry.rows[1].answered_after, Some(Duration::from_secs(1)));
    assert!(!entry.is_final());
}

#[test]
fn a_finished_row_never_changes_again() {
    let mut ledger = Ledger::new();
    let id = ledger.open(Duration::ZERO, given("1 arm"), &[1]);
    ledger.apply(&update(id, 1, RowState::TimedOut, 1));
    ledger.apply(&update(id, 1, RowState::Accepted, 2));
    assert_eq!(
        ledger.entry(id).map(|entry| entry.rows[0].state),
        Some(RowState::TimedOut)
    );
}

#[test]
fn the_oldest_entries_fall_out() {
    let mut ledger = Ledger::new();
    let first = ledger.open(Duration::ZERO, given("1 arm"), &[1]);
    for _ in 0..ENTRIES_KEPT {
        ledger.open(Duration::ZERO, given("2 arm"), &[2]);
    }
    assert_eq!(ledger.entry(first), None);
    assert_eq!(ledger.entries().len(), ENTRIES_KEPT);
}

fn foreign(id: u32, at_s: u64) -> ForeignCommand {
    ForeignCommand {
        id: ForeignId(id),
        station: StationId(MavAddress {
            system: 254,
            component: 230,
        }),
        vehicle: 3,
        at: Duration::from_secs(at_s),
        last_at: Duration::from_secs(at_s),
        what: Text::verbatim("mode RTL"),
        count: 1,
        state: RowState::Sent,
        explanation: None,
    }
}

#[test]
fn foreign_commands_are_beside_the_own_ones_in_the_order_of_time() {
    let mut ledger = Ledger::new();
    ledger.open(Duration::from_secs(1), given("1 arm"), &[1]);
    ledger.note_foreign(foreign(0, 2));
    ledger.open(Duration::from_secs(3), given("2 arm"), &[2]);
    ledger.note_foreign(foreign(1, 4));
    let order: Vec<LedgerNumber> = ledger
        .newest_first()
        .map(|item| item.key().number())
        .collect();
    assert_eq!(
        order,
        [
            LedgerNumber::Foreign(ForeignId(1)),
            LedgerNumber::Own(EntryId(1)),
            LedgerNumber::Foreign(ForeignId(0)),
            LedgerNumber::Own(EntryId(0)),
        ]
    );
    assert_eq!(ledger.entries().len(), 2, "the operator's own");
    let mut answered = foreign(0, 2);
    answered.state = RowState::Accepted;
    answered.count = 3;
    ledger.note_foreign(answered);
    let item = ledger.item(LedgerItem::Foreign(&foreign(0, 2)).key());
    let Some(LedgerItem::Foreign(command)) = item else {
        panic!("{item:?}");
    };
    assert_eq!(command.line().to_string(), "GCS 254/230: 3 mode RTL");
    assert_eq!(command.outcome().to_string(), "accepted, 3 times");
    assert_eq!(ledger.foreign().len(), 2);
}

#[test]
fn the_oldest_foreign_commands_fall_out() {
    let mut ledger = Ledger::new();
    for id in 0..=FOREIGN_KEPT as u32 {
        ledger.note_foreign(foreign(id, u64::from(id)));
    }
    assert_eq!(ledger.foreign().len(), FOREIGN_KEPT);
    let first = ledger.foreign().next().map(|it| it.id);
    assert_eq!(first, Some(ForeignId(1)));
    // A later answer to the dropped one does not bring it back at the end.
    ledger.note_foreign(foreign(0, 5000));
    let ids: Vec<_> = ledger.foreign().map(|it| it.id).collect();
    assert_eq!(ids.len(), FOREIGN_KEPT);
    assert!(ids.is_sorted() && ids[0] == ForeignId(1));
}

#[test]
fn a_raw_command_is_called_accepted_because_no_effect_is_watched() {
    const LONG: Verb = Verb {
        name: "long",
        ..ARM
    };
    for (verb, word) in [(&LONG, "accepted"), (&ARM, "effect seen")] {
        let mut ledger = Ledger::new();
        let line = Given {
            verb,
            ..given("1 it")
        };
        let id = ledger.open(Duration::ZERO, line, &[1]);
        ledger.apply(&update(id, 1, RowState::Done, 1));
        let entry = ledger.entries().next().expect("one");
        assert_eq!(entry.state_of(&entry.rows[0]).to_string(), word);
    }
}
