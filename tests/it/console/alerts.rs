//! Alerts: their duration, acknowledgement, and sound.

use sortie::app::effect::{Effect, TerminalEffect};
use sortie::vehicle::{Severity, Vehicle};

use crate::fixtures;
use crate::harness::Console;

fn silent(id: u16, heard_s: u64) -> Vehicle {
    let mut vehicle = fixtures::airborne(id, 50.0, 20.0);
    vehicle.link.lost = true;
    vehicle.link.last_heard = Some(std::time::Duration::from_secs(heard_s));
    vehicle
}

fn first_lines(console: &Console) -> String {
    let screen = console.screen(80, 24);
    screen.lines().take(8).collect::<Vec<_>>().join("\n")
}

#[test]
fn an_alert_says_what_and_since_when_until_it_is_over() {
    let mut console = Console::flying(3);
    console.at(45).vehicle(silent(2, 42));
    let screen = first_lines(&console);
    assert!(
        screen.contains("! 2: LINK LOST, since 0:42  x acknowledges"),
        "{screen}"
    );
    assert!(screen.contains("! LINK LOST (0:42)") || screen.contains("! LINK LOST, since 0:42"));
    console.at(60).press("x");
    let screen = first_lines(&console);
    assert!(!screen.contains("acknowledges"), "{screen}");
    assert!(
        screen.contains(" LINK LOST") && !screen.contains("! LINK"),
        "{screen}"
    );
    console.vehicle(fixtures::airborne(2, 50.0, 20.0));
    assert!(!first_lines(&console).contains("LINK LOST"));
}

#[test]
fn alerts_of_many_vehicles_are_one_line_one_ring_and_one_note() {
    let mut console = Console::set_up(|setup| setup.config.alerts.notify = true).in_flight(5);
    console.at(10);
    let mut effects = Vec::new();
    for id in 1..=4 {
        effects.extend(console.vehicle(silent(id, 7)).effects.clone());
    }
    assert_eq!(effects, [Effect::Terminal(TerminalEffect::Bell)]);
    assert!(first_lines(&console).contains("! 4 vehicles: LINK LOST, since 0:07: 1-4"));
    let [Effect::Terminal(TerminalEffect::Notify(note))] = console.at(11).effects.as_slice() else {
        panic!("one note: {:?}", console.effects);
    };
    assert_eq!(note.to_string(), "4 vehicles: LINK LOST");
    for seconds in 12..60 {
        assert!(console.at(seconds).effects.is_empty(), "at {seconds} s");
    }
}

#[test]
fn kinds_can_be_muted_and_heard_again() {
    let mut console = Console::flying(2);
    console.give("mute link-lost").at(10).vehicle(silent(1, 7));
    assert!(console.effects.is_empty(), "{:?}", console.effects);
    let screen = first_lines(&console);
    assert!(screen.contains("LINK LOST") && !screen.contains("acknowledges"));
    console.notice(Severity::Critical, Some(2), "link lost");
    assert!(console.effects.is_empty());
    console.give("unmute link-lost");
    assert!(first_lines(&console).contains("acknowledges"));
    console.give("mute lnik-lost");
    assert!(console.screen(80, 24).contains("did you mean `link-lost`?"));
}

#[test]
fn alerts_are_acknowledged_by_kind_and_by_vehicle() {
    let mut console = Console::flying(4);
    console.at(10);
    for id in 1..=3 {
        console.vehicle(silent(id, 7));
    }
    let open = |console: &Console| {
        let pressing = console.state().session().alerts().pressing();
        pressing.map_or(0, |pressing| pressing.vehicles.len())
    };
    assert_eq!(open(&console), 3);
    console.give("ack 1");
    assert_eq!(open(&console), 2);
    console.give("ack battery");
    assert_eq!(open(&console), 2);
    console.give("ack link-lost");
    assert_eq!(open(&console), 0);
}

#[test]
fn reasons_not_to_arm_never_ring() {
    let mut console = Console::flying(1);
    console.notice(
        Severity::Critical,
        Some(1),
        "PreArm: Need Position Estimate",
    );
    assert!(console.effects.is_empty());
}

#[test]
fn a_bell_that_is_switched_off_is_silent() {
    let mut console = Console::set_up(|setup| setup.config.alerts.bell = false).in_flight(1);
    console.notice(Severity::Emergency, Some(1), "Crash: Disarming");
    assert!(console.effects.is_empty());
}

fn notices(console: &Console) -> Vec<String> {
    let lines = console.state().notices().lines();
    lines.map(|line| line.notice.text.to_string()).collect()
}

/// No message of a vehicle announces that another one is too close, so the console does.
#[test]
fn vehicles_that_come_too_close_leave_one_notice() {
    let mut console = Console::flying(3);
    let fly = |console: &mut Console, north_m| {
        let mut near = fixtures::airborne(1, 50.0, 20.0);
        near.global = fixtures::airborne(2, north_m, 20.0).global;
        console.vehicle(near);
    };
    console.vehicle(fixtures::airborne(2, 50.0, 20.0));
    fly(&mut console, 90.0);
    console.at(10);
    assert!(notices(&console).is_empty(), "{:?}", notices(&console));
    fly(&mut console, 53.0);
    console.at(11).at(12).at(13);
    let said = notices(&console);
    assert!(said.len() == 1 && said[0].contains("3 m"), "{said:?}");
}

#[test]
fn motors_that_stop_in_the_air_leave_a_notice_unless_a_message_has_told() {
    let mut console = Console::flying(2);
    let falling = |id| {
        let mut vehicle = fixtures::airborne(id, 50.0, 20.0);
        if let Some(heartbeat) = &mut vehicle.heartbeat {
            heartbeat.armed = false;
        }
        vehicle
    };
    console.at(10).vehicle(falling(1));
    let said = notices(&console);
    assert!(said.len() == 1 && said[0].contains("MOTORS"), "{said:?}");
    console.notice(Severity::Emergency, Some(2), "Crash: Disarming");
    console.vehicle(falling(2));
    let said = notices(&console);
    assert!(said.len() == 2, "{said:?}");
}

#[test]
fn other_rooms_count_the_alerts_in_their_first_line() {
    let mut console = Console::flying(3);
    console.at(10).vehicle(silent(1, 7)).vehicle(silent(2, 7));
    assert!(console.press("C").screen(120, 40).contains("2 alerts"));
}
