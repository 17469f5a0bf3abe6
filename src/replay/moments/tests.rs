//! What becomes a moment.

use super::*;
use crate::app::{App, Setup};
use crate::exercise::Exercise;
use crate::language::{Context, Script, verb};
use crate::ledger::{EntryId, Risk};
use crate::mission::Mission;
use crate::pilot_in_command::Person;
use crate::scoring::{EventReport, EventSubject};

#[test]
fn a_line_that_another_pilot_bars_again_and_again_is_one_moment() {
    let (mut app, mut lookout) = (App::new(Setup::default()), Lookout::default());
    let mut number = 0;
    let mut refuse = |at_s, vehicle, state, line: &str, by| {
        let verb = line.split(' ').nth(1).expect("a verb");
        let given = given(line, verb, Risk::None, by, vehicle);
        let VehicleEvent::Row(row) = row(number, vehicle, state, &format!("anna flies {vehicle}"))
        else {
            panic!("it is a row");
        };
        let at = Duration::from_secs(at_s);
        let row = VehicleEvent::Row(RowUpdate { at, ..row });
        number += 1;
        for event in [given, row].map(Event::from) {
            drop(app.update(event.clone()));
            lookout.watch(at, &[event], app.state());
        }
    };
    refuse(10, 3, RowState::Barred, "3 rtl", None);
    refuse(15, 2, RowState::Barred, "2 rtl", None);
    refuse(20, 3, RowState::Barred, "3 rtl", None);
    refuse(30, 3, RowState::Barred, "3 rtl", None);
    refuse(35, 3, RowState::Barred, "3 rtl", Some("vera"));
    // What a vehicle itself refuses stays where it was.
    refuse(40, 1, RowState::Refused, "1 arm", None);
    refuse(50, 1, RowState::Refused, "1 arm", None);
    let found = lookout.found().expect("moments").into_iter();
    let found: Vec<_> = found
        .map(|it| (it.at.as_secs(), it.said().to_string()))
        .collect();
    let expected = [
        (10, "3 rtl: refused: anna flies 3 (3 times)"),
        (15, "2 rtl: refused: anna flies 2"),
        (35, "vera: 3 rtl: refused: anna flies 3"),
        (40, "1 arm: anna flies 1"),
        (50, "1 arm: anna flies 1"),
    ];
    assert_eq!(found, expected.map(|(at, text)| (at, text.to_owned())));
}

#[test]
fn an_alert_of_the_mission_is_a_moment() {
    let source = include_str!("../../../missions/00-first-flight.toml");
    let mission = Arc::new(Mission::parse(source).expect("no faults"));
    let script = Script::parse("", &Context::default()).expect("nothing to do");
    let mut report = Exercise::new(mission, 1, script, Vec::new()).report();
    let alert = |vehicle, about, text| EventReport {
        at_s: 60.0,
        kind: EventKind::Alert,
        vehicle,
        text: Text::verbatim(text),
        about,
    };
    report.events = vec![
        alert(None, None, "60 s left"),
        alert(
            Some(1),
            Some(EventSubject::Alert(0)),
            "an aircraft comes near",
        ),
        alert(Some(1), None, "the process has ended"),
    ];
    let mut lookout = Lookout::default();
    lookout.close(&report);
    let found = lookout.found().expect("moments");
    let found = found.into_iter().filter(|it| it.kind == MomentKind::Alert);
    let found: Vec<String> = found.map(|it| it.text.to_string()).collect();
    assert_eq!(found, ["60 s left", "an aircraft comes near"]);
}

/// The moments of commands, each with the text of its kind.
fn of_commands(events: &[VehicleEvent]) -> Vec<(MomentKind, String)> {
    let (mut app, mut lookout) = (App::new(Setup::default()), Lookout::default());
    for event in events {
        let event = Event::from(event.clone());
        drop(app.update(event.clone()));
        lookout.watch(Duration::ZERO, &[event], app.state());
    }
    let found = lookout.found().expect("moments").into_iter();
    found.map(|it| (it.kind, it.said().to_string())).collect()
}

fn given(line: &str, name: &str, risk: Risk, by: Option<&str>, vehicle: VehicleId) -> VehicleEvent {
    VehicleEvent::Given {
        at: Duration::ZERO,
        line: line.to_owned(),
        verb: verb(name).expect("a verb"),
        risk,
        by: by.map(Person::named),
        vehicles: vec![vehicle],
    }
}

fn row(entry: u32, vehicle: VehicleId, state: RowState, why: &str) -> VehicleEvent {
    VehicleEvent::Row(RowUpdate {
        entry: EntryId(entry),
        vehicle,
        state,
        tries: 0,
        at: Duration::ZERO,
        explanation: Some(Text::verbatim(why)),
    })
}

#[test]
fn what_another_person_commanded_has_the_name() {
    let found = of_commands(&[
        given("4 rtl", "rtl", Risk::None, Some("carl"), 4),
        row(0, 4, RowState::Barred, "dora flies 4"),
        given("1 arm", "arm", Risk::None, None, 1),
        row(1, 1, RowState::Refused, "no GPS"),
        given("3 kill", "kill", Risk::Unsafe, Some("carl"), 3),
    ]);
    let expected = [
        (MomentKind::Barred, "carl: 4 rtl: refused: dora flies 4"),
        (MomentKind::Refusal, "1 arm: no GPS"),
        (MomentKind::Event, "carl: 3 kill"),
    ];
    assert_eq!(found, expected.map(|(kind, text)| (kind, text.to_owned())));
}
