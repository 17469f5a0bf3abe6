//! The room of parameters, as scripts.

use std::sync::Arc;

use sortie::app::effect::{Effect, FileEffect, FileKind};
use sortie::app::event::{FileEvent, VehicleEvent};
use sortie::app::room::parameters::{cursor_row, rows};
use sortie::app::state::{Overlay, Room};
use sortie::commands::{Act, Command, ParameterCommand};
use sortie::ledger::{EntryId, RowState, RowUpdate};
use sortie::parameters::{
    Fetching, HeardParameter, ParameterEncoding, ParameterList, ParameterSnapshot, ParameterType,
};

use crate::harness::Console;

mod batch;
mod files;

/// A list with some parameters of each type.
pub fn list(system: f32, speed: f32) -> ParameterList {
    let all = [
        ("ANGLE_MAX", 3000.0, ParameterType::Int16),
        ("ARMING_CHECK", 1.0, ParameterType::Int32),
        ("BATT_CAPACITY", 3300.0, ParameterType::Int32),
        ("COMPASS_DEV_ID", 97_539.0 + system, ParameterType::Int32),
        ("FENCE_ENABLE", 0.0, ParameterType::Int8),
        ("INS_ACCOFFS_X", 0.001, ParameterType::Real32),
        ("RTL_ALT", 1500.0, ParameterType::Int16),
        ("SYSID_THISMAV", system, ParameterType::Int16),
        ("WPNAV_ACCEL", 250.0, ParameterType::Real32),
        ("WPNAV_SPEED", speed, ParameterType::Real32),
    ];
    let mut list = ParameterList::default();
    for (index, (name, value, kind)) in (0..).zip(all) {
        list.note(&HeardParameter {
            name,
            value: f64::from(value),
            kind,
            encoding: ParameterEncoding::Converted,
            index: Some(index),
            count: all.len() as u16,
        });
    }
    list
}

pub fn complete(list: ParameterList) -> ParameterSnapshot {
    ParameterSnapshot {
        list: Arc::new(list),
        fetching: Fetching::Complete,
        ..ParameterSnapshot::default()
    }
}

/// A console in the room of parameters, with vehicles whose lists are complete.
pub fn in_the_room(vehicles: u16) -> Console {
    let mut console = Console::flying(vehicles);
    console.press("P").at(1);
    for vehicle in 1..=vehicles {
        arrives(&mut console, vehicle, list(f32::from(vehicle), 1000.0));
    }
    console
}

pub fn arrives(console: &mut Console, vehicle: u16, list: ParameterList) {
    let snapshot = complete(list);
    console.hear(VehicleEvent::Parameters { vehicle, snapshot });
}

fn names(console: &Console) -> Vec<String> {
    let rows = rows(console.state());
    rows.iter().map(|row| row.name.to_owned()).collect()
}

fn row(console: &mut Console, entry: u32, vehicle: u16, state: RowState) {
    console.hear(VehicleEvent::Row(RowUpdate {
        entry: EntryId(entry),
        vehicle,
        state,
        tries: 1,
        at: console.state().now(),
        explanation: None,
    }));
}

fn settings(effects: &[Effect]) -> Vec<(String, f32, Vec<u16>)> {
    let set = effects.iter().filter_map(|effect| match effect {
        Effect::Order { order, .. } => match &order.act {
            Act::Command(Command::Parameter(ParameterCommand::Set { name, value })) => {
                Some((name.clone(), *value as f32, order.targets.clone()))
            }
            _ => None,
        },
        _ => None,
    });
    set.collect()
}

fn said(console: &Console) -> String {
    let message = console.state().message();
    message.map_or_else(String::new, |message| message.text.to_string())
}

#[test]
fn the_room_asks_for_the_list_that_is_looked_at_and_for_few_at_a_time() {
    let mut console = Console::flying(9);
    assert!(console.at(1).effects.is_empty(), "nobody looks");
    console.press("P");
    assert_eq!(console.at(2).effects, [Effect::FetchParameters(vec![1])]);
    assert!(console.at(3).effects.is_empty(), "it was asked");
    console.press("*");
    assert!(
        console.state().session().selection().is_empty(),
        "a mark here"
    );
    console.give("select 1-9");
    assert_eq!(
        console.at(4).effects,
        [Effect::FetchParameters(vec![2, 3, 4])],
        "four at a time"
    );
    arrives(&mut console, 2, list(2.0, 1000.0));
    assert_eq!(console.at(5).effects, [Effect::FetchParameters(vec![5])]);
    console.press("r");
    assert!(console.at(5).effects.is_empty(), "there is no free place");
}

#[test]
fn r_asks_again_for_a_list_that_is_there() {
    let mut console = in_the_room(1);
    assert!(console.at(3).effects.is_empty());
    console.press("r");
    assert_eq!(console.at(4).effects, [Effect::FetchParameters(vec![1])]);
    assert!(console.at(5).effects.is_empty());
}

#[test]
fn i_reads_the_documentation_of_the_vehicle_under_the_cursor() {
    let mut console = in_the_room(2);
    console.press("]").press("i");
    let given = console.effects.iter().find_map(|effect| match effect {
        Effect::Order { order, .. } => Some((order.line.as_str(), order.targets.as_slice())),
        _ => None,
    });
    assert_eq!(given, Some(("2 param docs", &[2][..])));
}

#[test]
fn names_are_found_by_letters_and_the_cursor_stays_on_its_name() {
    let mut console = in_the_room(1);
    console.press("end").press("up");
    assert_eq!(console.state().rooms().parameters().cursor(), "WPNAV_ACCEL");
    console.press("/").write("acc");
    assert_eq!(names(&console), ["INS_ACCOFFS_X", "WPNAV_ACCEL"]);
    let shown = rows(console.state());
    assert_eq!(cursor_row(console.state(), &shown), 1);
    console.write(" nav").press("enter");
    assert_eq!(names(&console), ["WPNAV_ACCEL"]);
    console.press("/").press("ctrl-u").write("цзтфм фсс");
    assert_eq!(names(&console), ["WPNAV_ACCEL"], "by its keys");
    console.press("enter").press("esc");
    assert_eq!(names(&console).len(), 10);
}

#[test]
fn a_new_value_goes_the_way_of_every_command_and_shows_what_became_of_it() {
    let mut console = in_the_room(3);
    console.give("select 2-3").press("end").press("enter");
    console.press("ctrl-u").write("640").press("enter");
    let set = ("WPNAV_SPEED".to_owned(), 640.0, vec![2, 3]);
    assert_eq!(settings(&console.effects), [set]);
    let entry = console.state().session().ledger().entries().next_back();
    assert_eq!(
        entry.map(|entry| entry.line.as_str()),
        Some("2-3 param set WPNAV_SPEED 640")
    );
    console.press("o");
    assert!(console.screen(80, 24).contains("640 waiting"));
    row(&mut console, 0, 2, RowState::Sent);
    assert!(console.screen(80, 24).contains("640 sent"));
    row(&mut console, 0, 2, RowState::Done);
    row(&mut console, 0, 3, RowState::TimedOut);
    let screen = console.screen(80, 24);
    assert!(screen.contains("640 confirmed"), "{screen}");
    assert!(screen.contains("640 no answer"), "{screen}");
}

#[test]
fn what_the_type_cannot_hold_stays_in_the_prompt() {
    let mut console = in_the_room(1);
    console.press("home").press("enter");
    for (value, reason) in [
        (
            "40000",
            "not sent: ANGLE_MAX accepts only -32768 to 32767 (int16)",
        ),
        (
            "1.5",
            "not sent: ANGLE_MAX accepts only whole numbers (int16)",
        ),
        ("nan", "not sent: ANGLE_MAX accepts only finite numbers"),
        ("fast", "`fast` is not a number"),
    ] {
        console.press("ctrl-u").write(value).press("enter");
        assert!(console.effects.is_empty(), "{value}");
        let Some(Overlay::Prompt(prompt)) = console.state().overlay() else {
            panic!("the prompt is gone after {value}");
        };
        assert_eq!(prompt.fault().expect("a fault").to_string(), reason);
    }
    console.press("esc");
    assert!(console.state().overlay().is_none());
}

#[test]
fn what_became_of_a_value_is_said_on_the_last_line_once_all_have_answered() {
    let mut console = in_the_room(3);
    console.give("1-3 param set WPNAV_SPEED 640");
    let mut end = |vehicle, state, reason: &str| {
        console.hear(VehicleEvent::Row(RowUpdate {
            entry: EntryId(0),
            vehicle,
            state,
            tries: 1,
            at: console.state().now(),
            explanation: Some(reason.into()),
        }));
        said(&console)
    };
    let before = end(1, RowState::Done, "WPNAV_SPEED = 640");
    assert!(!before.contains("640"), "two have not answered: {before}");
    end(2, RowState::TimedOut, "no answer");
    let told = end(3, RowState::TimedOut, "no answer");
    assert_eq!(told, "vehicles 2-3: timed out, no answer");
    assert!(console.screen(120, 40).contains(&told));
    console.give("1 param set ANGLE_MAX 2000");
    row(&mut console, 1, 1, RowState::Refused);
    assert_eq!(said(&console), "vehicle 1: refused");
    console.press("F").give("1 param set ANGLE_MAX 2000");
    row(&mut console, 2, 1, RowState::Done);
    assert!(
        !said(&console).contains("seen"),
        "other rooms show the ledger"
    );
}

#[test]
fn what_was_confirmed_before_a_reboot_is_not_confirmed_after_it() {
    let mut console = in_the_room(2);
    console.press("end").press("enter");
    console.press("ctrl-u").write("640").press("enter");
    row(&mut console, 0, 1, RowState::Done);
    arrives(&mut console, 1, list(1.0, 640.0));
    assert!(console.screen(80, 24).contains("640 confirmed"));
    console.give("params diff 2");
    // The list arrives anew, and the vehicle has lost the value.
    let mut coming = ParameterList::default();
    coming.note(&HeardParameter {
        name: "WPNAV_SPEED",
        value: 1000.0,
        kind: ParameterType::Real32,
        encoding: ParameterEncoding::Converted,
        index: Some(9),
        count: 10,
    });
    let snapshot = ParameterSnapshot {
        list: Arc::new(coming),
        fetching: Fetching::UnderWay { fruitless: 0 },
        reboots: 1,
        ..ParameterSnapshot::default()
    };
    console.hear(VehicleEvent::Parameters {
        vehicle: 1,
        snapshot,
    });
    assert!(names(&console).is_empty(), "what has not come may be equal");
    let screen = console.screen(80, 24);
    assert!(!screen.contains("confirmed"), "{screen}");
    assert!(screen.contains("no differences so far"), "{screen}");
    console.press("a");
    let wait = "vehicle 1 has sent 1 of 10 parameters: wait for the rest";
    assert_eq!(said(&console), wait);
    console.press("s").press("ctrl-u").write("x").press("enter");
    assert!(console.effects.is_empty(), "half a list is not saved");
}

#[test]
fn vehicles_are_compared_with_each_other() {
    let mut console = in_the_room(2);
    arrives(&mut console, 2, list(2.0, 500.0));
    console.press("d").write("2").press("enter");
    assert_eq!(
        names(&console),
        ["COMPASS_DEV_ID", "SYSID_THISMAV", "WPNAV_SPEED"]
    );
    console.press("*").press("a").press("y");
    let set = ("WPNAV_SPEED".to_owned(), 500.0, vec![1]);
    assert_eq!(settings(&console.effects), [set]);
    console.press("d").write("9").press("enter");
    let Some(Overlay::Prompt(prompt)) = console.state().overlay() else {
        panic!("the prompt stays");
    };
    assert_eq!(prompt.fault().expect("a fault").to_string(), "no vehicle 9");
}

#[test]
fn an_earlier_filter_hides_no_difference() {
    let mut console = in_the_room(2);
    arrives(&mut console, 2, list(2.0, 500.0));
    console.press("/").write("acc").press("enter");
    console.press("d").write("2").press("enter");
    assert_eq!(names(&console).len(), 3);
}

#[test]
fn a_new_search_replaces_the_text_of_the_earlier_one() {
    let mut console = in_the_room(1);
    console.press("/").write("acc").press("enter");
    console.press("/").write("speed").press("enter");
    assert_eq!(names(&console), ["WPNAV_SPEED"]);
}

#[test]
fn names_of_parameters_complete_on_the_command_line() {
    let mut console = in_the_room(1);
    console.press("F").press(":").write("param set WPN");
    let Some(Overlay::Palette(palette)) = console.state().overlay() else {
        panic!("the line is open");
    };
    let texts: Vec<&str> = palette
        .completions()
        .iter()
        .map(|it| it.text.as_str())
        .collect();
    assert_eq!(texts, ["WPNAV_ACCEL", "WPNAV_SPEED"]);
    assert_eq!(palette.completions()[1].hint.to_string(), "= 1000");
}

#[test]
fn a_line_about_parameters_asks_for_their_names() {
    let mut console = Console::flying(2);
    console.press("j").press(":").write("param get ");
    assert_eq!(console.at(2).effects, [Effect::FetchParameters(vec![2])]);
}

#[test]
fn the_list_survives_leaving_the_room_and_not_the_session() {
    let mut console = in_the_room(1);
    console
        .press("/")
        .write("wp")
        .press("enter")
        .press("F")
        .press("P");
    assert_eq!(console.state().room(), Room::Parameters);
    assert_eq!(names(&console), ["WPNAV_ACCEL", "WPNAV_SPEED"]);
    console.give("leave").press("y");
    assert!(console.state().rooms().parameters().lists().is_empty());
    arrives(&mut console, 1, list(1.0, 1.0));
    assert!(
        console.state().rooms().parameters().lists().is_empty(),
        "what comes late belongs to nobody"
    );
}
