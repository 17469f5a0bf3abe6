//! Several values set one after the other.

use sortie::app::effect::FileKind;
use sortie::app::event::{FileEvent, VehicleEvent};
use sortie::ledger::{EntryId, RowState, RowUpdate};
use sortie::parameters::{HeardParameter, ParameterEncoding, ParameterList, ParameterType};

use super::{arrives, in_the_room, row, said, settings};
use crate::harness::Console;

#[test]
fn many_values_go_out_a_few_at_a_time_with_a_result_for_each() {
    let mut console = Console::flying(1);
    console.press("P").at(1);
    let mut many = ParameterList::default();
    let names: Vec<String> = (0..100).map(|at| format!("P{at:02}")).collect();
    for (index, name) in (0..).zip(&names) {
        many.note(&HeardParameter {
            name,
            value: 0.0,
            kind: ParameterType::Real32,
            encoding: ParameterEncoding::Converted,
            index: Some(index),
            count: 100,
        });
    }
    arrives(&mut console, 1, many);
    let lines: Vec<String> = names.iter().map(|name| format!("{name},1")).collect();
    let text = lines.join("\n");
    let path = "all.parm".to_owned();
    console.hear(FileEvent::Read {
        kind: FileKind::Parameters,
        path,
        text,
    });
    console.press("a").press("y");
    let mut sent = settings(&console.effects).len();
    assert_eq!(sent, 1, "it begins gently");
    let mut most = 0;
    for entry in 0..100 {
        let state = if entry == 50 {
            RowState::Refused
        } else {
            RowState::Done
        };
        row(&mut console, entry, 1, state);
        sent += settings(&console.effects).len();
        most = most.max(sent - entry as usize - 1);
    }
    assert_eq!(most, 8);
    assert_eq!(sent, 100);
    assert_eq!(
        said(&console),
        "parameters set: 99 confirmed, 1 not: the list shows why"
    );
}

#[test]
fn what_waited_too_long_to_be_sent_is_given_again() {
    let mut console = in_the_room(1);
    let path = "all.parm".to_owned();
    let text = "ANGLE_MAX,1\nRTL_ALT,1\nWPNAV_ACCEL,1\nWPNAV_SPEED,1\n".to_owned();
    console.hear(FileEvent::Read {
        kind: FileKind::Parameters,
        path,
        text,
    });
    console.press("a").press("y");
    row(&mut console, 0, 1, RowState::Done);
    assert_eq!(settings(&console.effects).len(), 2);
    row(&mut console, 1, 1, RowState::Refused);
    assert!(console.effects.is_empty(), "the other one first");
    console.hear(VehicleEvent::Row(RowUpdate {
        entry: EntryId(2),
        vehicle: 1,
        state: RowState::TimedOut,
        tries: 0,
        at: console.state().now(),
        explanation: None,
    }));
    for (entry, name) in [(3, "WPNAV_SPEED"), (4, "WPNAV_ACCEL")] {
        assert_eq!(settings(&console.effects)[0].0, name);
        row(&mut console, entry, 1, RowState::Done);
    }
    assert_eq!(
        said(&console),
        "parameters set: 3 confirmed, 1 not: the list shows why"
    );
}

#[test]
fn escape_stops_what_has_not_been_given_yet() {
    let mut console = in_the_room(1);
    let path = "three.parm".to_owned();
    let text = "ANGLE_MAX,1\nRTL_ALT,1\nWPNAV_SPEED,1\n".to_owned();
    console.hear(FileEvent::Read {
        kind: FileKind::Parameters,
        path,
        text,
    });
    console.press("a").press("y").press("esc");
    assert_eq!(said(&console), "stopped: 2 not set");
    row(&mut console, 0, 1, RowState::Done);
    assert!(console.effects.is_empty());
    assert_eq!(said(&console), "parameters set: 1 confirmed");
}

#[test]
fn a_value_that_was_not_answered_is_given_again_unless_the_vehicle_lacks_it() {
    let mut console = in_the_room(1);
    let path = "two.parm".to_owned();
    let text = "ANGLE_MAX,1\nNEW_ONE,1\n".to_owned();
    console.hear(FileEvent::Read {
        kind: FileKind::Parameters,
        path,
        text,
    });
    console.press("*").press("a").press("y");
    for (entry, name) in ["ANGLE_MAX", "NEW_ONE", "ANGLE_MAX", "ANGLE_MAX"]
        .into_iter()
        .enumerate()
    {
        assert_eq!(settings(&console.effects)[0].0, name);
        row(&mut console, entry as u32, 1, RowState::TimedOut);
    }
    assert!(console.effects.is_empty());
    assert_eq!(
        said(&console),
        "parameters set: 0 confirmed, 2 not: the list shows why"
    );
}
