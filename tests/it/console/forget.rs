//! Vehicles that are forgotten, and those that are not expected.

use sortie::app::effect::{Effect, SessionEffect};
use sortie::app::event::LinkEvent;
use sortie::app::state::{Activity, Overlay};
use sortie::doctor::{Cause, LinkFinding, Way};
use sortie::ledger::{LedgerEntry, RowState};

use super::selection;
use crate::fixtures;
use crate::harness::Console;

fn message(console: &Console) -> String {
    let message = console.state().message();
    message.map_or(String::new(), |message| message.text.to_string())
}

/// The fault shown for a refused line.
fn fault(console: &Console) -> String {
    match console.state().overlay() {
        Some(Overlay::Palette(palette)) => {
            palette.fault().expect("it is refused").message.to_string()
        }
        other => panic!("the command line is not open: {other:?}"),
    }
}

/// A console connected to vehicles 1 to 4, of which 3 and 4 have become silent.
fn connected(expected: Option<&str>) -> Console {
    let expected = expected.map(|ids| ids.parse().expect("ids"));
    let mut console = Console::set_up(|setup| setup.config.connect.expect = expected);
    console.start(Activity::Connected {
        addresses: vec!["udpin:127.0.0.1:14550".to_owned()],
    });
    for id in 1..=4 {
        let mut vehicle = fixtures::parked(id);
        vehicle.link.lost = id > 2;
        console.vehicle(vehicle);
    }
    console
}

fn known(console: &Console) -> Vec<u16> {
    let vehicles = console.state().session().vehicles();
    vehicles.keys().copied().collect()
}

#[test]
fn vehicles_whose_link_is_lost_can_be_forgotten() {
    let mut console = connected(None);
    console.give("3-4 arm").give("select 2-3");
    console.give("forget 2-9");
    assert!(fault(&console).contains("2: in contact"));
    assert_eq!(known(&console), [1, 2, 3, 4]);
    console.press("esc").give("forget 4-250");
    assert_eq!(
        console.effects,
        [Effect::Session(SessionEffect::Forget(vec![4]))]
    );
    assert!(message(&console).contains("forgotten: 4"));
    console.give("forget");
    assert_eq!(known(&console), [1, 2]);
    assert_eq!(selection(&console), [2]);
    let session = console.state().session();
    assert!(session.ledger().entries().all(LedgerEntry::is_final));
    assert!(session.alerts().pressing().is_none());
    for (line, reason) in [
        ("forget", "no vehicle has lost its link"),
        ("forget 7", "no vehicle 7"),
    ] {
        console.give(line);
        assert!(fault(&console).contains(reason), "{line}");
        console.press("esc");
    }
    console.give("all arm");
    assert_eq!(console.sent_to(), [1, 2]);
}

#[test]
fn simulated_vehicles_are_not_forgotten() {
    let mut console = Console::flying(2);
    console.give("forget 1");
    assert!(fault(&console).contains("simulated vehicles"));
    assert_eq!(known(&console), [1, 2]);
}

#[test]
fn strangers_neither_press_nor_count() {
    let console = connected(Some("1-2,7"));
    assert!(console.state().session().alerts().pressing().is_none());
    let header = console.screen(200, 50).lines().next().map(str::to_owned);
    assert!(header.is_some_and(|line| line.contains("2 vehicles")));
    let mut all = connected(None);
    assert!(all.at(1).state().session().alerts().pressing().is_some());
}

/// ArduCopter answers the station that asks; the others see only the new mode.
#[test]
fn a_mode_that_another_station_may_have_set_names_the_station() {
    let mode = |number| {
        let mut vehicle = fixtures::airborne(1, 0.0, 10.0);
        if let Some(beat) = &mut vehicle.heartbeat {
            beat.mode.number = number;
        }
        vehicle
    };
    let told = |console: &Console| {
        let notices = console.state().notices();
        let mut texts = notices.lines().map(|line| line.notice.text.to_string());
        texts.any(|text| text.contains("was not set by this console; GCS 252/230"))
    };
    for (is_heard, is_own, is_named) in [
        (true, false, true),
        (false, false, false),
        (true, true, false),
    ] {
        let mut console = connected(None);
        console.at(100).vehicle(mode(4));
        if is_heard {
            let finding = |(system, component)| LinkFinding {
                link: 0,
                way: Way::UdpIn,
                cause: Cause::OtherStation(system, component),
                boards: Vec::new(),
            };
            // The first one is the console itself, heard again round a loop of forwards.
            let heard = [(255, 190), (252, 230)].map(finding);
            console.hear(LinkEvent::Findings(heard.into()));
        }
        if is_own {
            console.give("1 mode loiter");
            console.row(1, RowState::Done, None);
        }
        console.vehicle(mode(5));
        assert_eq!(told(&console), is_named, "{is_heard} {is_own}");
    }
}

#[test]
fn of_expected_vehicles_all_means_no_other() {
    let mut console = connected(Some("1-2,7"));
    console.give("all arm");
    assert_eq!(console.sent_to(), [1, 2]);
    console.give("select all");
    assert_eq!(selection(&console), [1, 2]);
    console.give("3 arm");
    assert_eq!(console.sent_to(), [3], "by its number it can be reached");
    let notices = console.state().notices();
    let told = notices
        .lines()
        .find(|line| line.notice.text.to_string().contains("not expected"));
    let strangers = told.expect("it is told").vehicles.iter();
    assert_eq!(strangers.copied().collect::<Vec<_>>(), [3, 4]);
}
