//! The room of parameters as text.

use std::sync::Arc;

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use sortie::app::effect::FileKind;
use sortie::app::event::{FileEvent, VehicleEvent};
use sortie::ledger::RowState;
use sortie::parameters::{
    Fetching, HeardParameter, ParameterDocuments, ParameterEncoding, ParameterList,
    ParameterSnapshot, ParameterType,
};
use sortie::text::{Language, Locale};
use sortie::ui::{self, Look};

use crate::console::parameters::{arrives, in_the_room, list};
use crate::fixtures;
use crate::harness::Console;

const SIZES: [(u16, u16); 3] = [(80, 24), (120, 40), (200, 50)];

fn check(name: &str, console: &Console) {
    for (width, height) in SIZES {
        insta::assert_snapshot!(
            format!("parameters_{name}_{width}x{height}"),
            console.screen(width, height)
        );
    }
}

/// Vehicle 1 has accepted one value and refused another; 2 and 3 are selected, too.
fn edited() -> Console {
    let mut console = in_the_room(3);
    console.give("select 1-3").press("end");
    console
        .press("enter")
        .press("ctrl-u")
        .write("640")
        .press("enter");
    for vehicle in 1..=3 {
        arrives(&mut console, vehicle, {
            let mut list = list(f32::from(vehicle), 1000.0);
            let value = if vehicle == 2 { 1000.0 } else { 640.0 };
            list.note(&HeardParameter {
                name: "WPNAV_SPEED",
                value,
                kind: ParameterType::Real32,
                encoding: ParameterEncoding::Converted,
                index: None,
                count: 10,
            });
            list
        });
    }
    console
        .row(1, RowState::Done, None)
        .row(
            2,
            RowState::Refused,
            Some("WPNAV_SPEED stayed 1000, it did not take 640"),
        )
        .row(3, RowState::Done, None);
    console
}

const DOCUMENTS: &str = r#"{"Copter": {
  "RTL_ALT": {"DisplayName": "RTL altitude", "Units": "cm", "Range": {"low": "30", "high": "300000"}, "Increment": "1",
    "Description": "The minimum height above home to which the vehicle climbs before it returns."},
  "FENCE_ENABLE": {"DisplayName": "Fence", "Description": "Whether the fence limits the flight.",
    "Values": {"0": "Disabled", "1": "Enabled"}},
  "ARMING_CHECK": {"DisplayName": "Checks before arming", "RebootRequired": "True",
    "Description": "A mask of the checks that the vehicle has to pass before it can be armed. For most users, all of them.",
    "Bitmask": {"0": "All", "1": "Barometer", "2": "Compass", "3": "GPS lock", "4": "INS", "5": "Parameters",
      "6": "RC channels", "7": "Board voltage", "8": "Battery level"}}}}"#;

/// A console in the room of parameters, some of which are documented.
fn documented(language: Language) -> Console {
    let read = ParameterDocuments::read(DOCUMENTS);
    assert_eq!(read.faults, []);
    let console = Console::set_up(|setup| {
        setup.documents = Arc::new(read.documents);
        setup.locale = Arc::new(Locale::new(language));
    });
    let mut console = console.in_flight(1);
    console.press("P").at(1);
    arrives(&mut console, 1, list(1.0, 1000.0));
    console.press("home").press("down");
    console
}

#[test]
fn documented_parameters() {
    let mut console = documented(Language::English);
    check("documented", &console);
    for _ in 0..5 {
        console.press("down");
    }
    console.press("enter").press("ctrl-u").write("10");
    check("doubted", &console);
    console
        .press("esc")
        .press(":")
        .write("param set FENCE_ENABLE 3");
    check("doubted_line", &console);
    console.press("enter");
    check("doubted_question", &console);
    let mut console = documented(Language::Ukrainian);
    console
        .press(":")
        .write("param set RTL_ALT 10")
        .press("enter");
    let screen = ukrainian_screen(&console);
    insta::assert_snapshot!("parameters_doubted_ukrainian_80x24", screen);
}

#[test]
fn parameters_that_differ_from_their_defaults() {
    let mut console = in_the_room(1);
    let mut known = list(1.0, 1000.0);
    let defaults = [
        ("ANGLE_MAX", 3000.0),
        ("RTL_ALT", 3000.0),
        ("WPNAV_SPEED", 500.0),
    ];
    known.note_defaults(
        defaults
            .map(|(name, value)| (name.to_owned(), value))
            .into(),
    );
    arrives(&mut console, 1, known);
    console.press("end");
    check("defaults", &console);
    console.press("o").press("o");
    let screen = console.screen(80, 24);
    insta::assert_snapshot!("parameters_other_than_default_80x24", screen);
    console.press("o");
    assert!(console.screen(80, 24).contains("ANGLE_MAX"));
}

fn compared() -> Console {
    let mut console = in_the_room(1);
    let text = "RTL_ALT,2000\nSYSID_THISMAV,7\nANGLE_MAX,4500\nNEW_ONE,1\nWPNAV_SPEED,1e-7\n";
    console.hear(FileEvent::Read {
        kind: FileKind::Parameters,
        path: "~/parameters/quad-450.parm".to_owned(),
        text: text.to_owned(),
    });
    console
}

#[test]
fn a_list_that_is_coming() {
    let mut console = Console::flying(2);
    console.press("P").at(1);
    check("none", &console);
    let mut half = ParameterList::default();
    for index in 0..500_u16 {
        half.note(&HeardParameter {
            name: &format!("P{index:04}"),
            value: f64::from(f32::from(index) / 3.0),
            kind: ParameterType::Real32,
            encoding: ParameterEncoding::Converted,
            index: Some(index),
            count: 1382,
        });
    }
    let mut lost = fixtures::parked(1);
    lost.link.lost = true;
    let mut hear = |fetching| {
        let list = Arc::new(half.clone());
        let snapshot = ParameterSnapshot {
            list,
            fetching,
            ..ParameterSnapshot::default()
        };
        console.hear(VehicleEvent::Parameters {
            vehicle: 1,
            snapshot,
        });
        console.screen(80, 24)
    };
    insta::assert_snapshot!(
        "parameters_coming_80x24",
        hear(Fetching::UnderWay { fruitless: 0 })
    );
    let repeating = hear(Fetching::UnderWay { fruitless: 5 });
    assert!(
        repeating.contains("500 of 1382; no answer, requested again (5)"),
        "{repeating}"
    );
    let stalled = hear(Fetching::Stalled);
    assert!(
        stalled.contains("500 of 1382 received, then no answer: r requests them again"),
        "{stalled}"
    );
    console.vehicle(lost);
    let list = Arc::new(half);
    let fetching = Fetching::UnderWay { fruitless: 0 };
    let snapshot = ParameterSnapshot {
        list,
        fetching,
        ..ParameterSnapshot::default()
    };
    console.hear(VehicleEvent::Parameters {
        vehicle: 1,
        snapshot,
    });
    let screen = console.screen(80, 24);
    let told = "500 of 1382; link lost: continues when it is back";
    assert!(screen.contains(told), "{screen}");
}

#[test]
fn values_that_were_set_on_several_vehicles() {
    check("edited", &edited());
}

#[test]
fn a_file_beside_the_vehicle() {
    check("compared", &compared());
}

#[test]
fn a_value_that_is_being_written() {
    let mut console = in_the_room(2);
    console
        .press("enter")
        .press("ctrl-u")
        .write("1.5")
        .press("enter");
    check("prompt", &console);
}

fn ukrainian_screen(console: &Console) -> String {
    let look = Look {
        locale: Arc::new(Locale::new(Language::Ukrainian)),
        ..Look::default()
    };
    let mut terminal = Terminal::new(TestBackend::new(80, 24)).expect("a test terminal");
    terminal
        .draw(|frame| ui::draw(console.state(), &look, frame))
        .expect("a test terminal");
    terminal.backend().to_string()
}

#[test]
fn in_ukrainian() {
    type Start = fn() -> Console;
    for (name, start) in [("edited", edited as Start), ("compared", compared)] {
        insta::assert_snapshot!(
            format!("parameters_{name}_ukrainian_80x24"),
            ukrainian_screen(&start())
        );
    }
}
