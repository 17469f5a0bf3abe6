//! Radios under test.

use std::time::Duration;

use sortie::app::effect::{Effect, SessionEffect};
use sortie::app::event::LinkEvent;
use sortie::app::state::{Activity, LinkSummary};
use sortie::mission::Stake;
use sortie::vehicle::{RadioPreset, RadioTraffic, TestedRadio};

use crate::fixtures::airborne;
use crate::harness::Console;

fn connected(count: u16) -> Console {
    let mut console = Console::flying(count);
    console.hear(LinkEvent::Summaries(vec![LinkSummary {
        name: "udpin:0.0.0.0:14550".into(),
        up: true,
        ..LinkSummary::default()
    }]));
    console
}

fn asked(console: &Console) -> (Vec<u16>, bool) {
    match console.effects.as_slice() {
        [Effect::Session(SessionEffect::Radio { vehicles, test })] => {
            (vehicles.clone(), test.is_some())
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_test_is_for_vehicles_or_for_all_on_a_link() {
    let mut console = connected(3);
    assert_eq!(asked(console.give("radio 2-3 edge")), (vec![2, 3], true));
    assert_eq!(asked(console.give("radio all off")), (vec![1, 2, 3], false));
    console.give("radio link 2 poor");
    assert!(console.screen(80, 24).contains("no link 2"));
}

#[test]
fn faults_are_marked_and_explained() {
    let mut console = connected(1);
    console.give("radio 1 egde");
    let screen = console.screen(100, 30);
    assert!(screen.contains("unknown setting `egde`"), "{screen}");
    assert!(screen.contains("did you mean `edge`?"), "{screen}");
}

#[test]
fn missions_decide_about_the_radio_themselves() {
    let mut console = Console::flying(1);
    console.start(Activity::Mission {
        id: "00".to_owned(),
        title: "x".into(),
        stake: Stake::Practice,
    });
    console.vehicle(airborne(1, 0.0, 20.0)).give("radio 1 edge");
    assert!(console.effects.is_empty());
    assert!(console.screen(100, 30).contains("a mission decides"));
}

#[test]
fn links_show_what_was_asked_for_and_what_is_measured() {
    let mut console = connected(1);
    let mut vehicle = airborne(1, 0.0, 20.0);
    vehicle.link.via = Some(0);
    vehicle.link.round_trip = Some(Duration::from_millis(171));
    vehicle.link.radio = Some(TestedRadio {
        test: RadioPreset::Edge.test(),
        lasts: Duration::from_secs(10),
        received: RadioTraffic {
            passed: 96,
            lost: 4,
            bytes: 12_000,
        },
        sent: RadioTraffic::default(),
    });
    console.vehicle(vehicle).press("L");
    let screen = console.screen(200, 50);
    for text in [
        "radio of 1",
        "loss 5 %, delay 80 ms, jitter 0 ms; measured: lost 4 % in, 0 % out; round trip 171 ms; 1200 B/s in",
    ] {
        assert!(screen.contains(text), "{text}:\n{screen}");
    }
}
