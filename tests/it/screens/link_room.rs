//! The room of links, and other places that report their state.

use std::time::Duration;

use sortie::app::event::LinkEvent;
use sortie::app::state::{Activity, LinkCounters, LinkSummary, Room};
use sortie::doctor::{Cause, LinkFinding, SealCounts, Way};
use sortie::vehicle::Vehicle;

use super::inspector::shows;
use crate::fixtures;
use crate::harness::Console;

fn link(name: &str, up: bool) -> LinkSummary {
    LinkSummary {
        name: name.to_owned().into(),
        state: if up { "up" } else { "down, next try in 4.0 s" }.into(),
        up,
        error: (!up).then(|| "port 14550 on 0.0.0.0 is in use".into()),
        bytes_in_per_s: 4123.0,
        bytes_out_per_s: 52.0,
        messages_in_per_s: 96.0,
        counters: Some(LinkCounters {
            peers: 1,
            bad_crc: 3,
            skipped_bytes: 1205,
            lost: vec![((1, 1), 0), ((3, 1), 17)],
            ..LinkCounters::default()
        }),
        round_trip: Some(Duration::from_millis(4)),
        ..LinkSummary::default()
    }
}

fn finding(link: usize, way: Way, cause: Cause) -> LinkFinding {
    LinkFinding {
        link,
        way,
        cause,
        boards: Vec::new(),
    }
}

/// A console in the room of links, with one faulty link and one closed link.
pub(super) fn ailing() -> Console {
    let mut console = Console::flying(0);
    let links = vec![
        link("serial:/dev/ttyUSB0:57600", true),
        link("udpin:0.0.0.0:14550", false),
    ];
    console.hear(LinkEvent::Summaries(links));
    for second in 1..=30 {
        console.at(second);
        console.hear(LinkEvent::Findings(vec![
            finding(0, Way::Serial, Cause::WrongBaud),
            finding(1, Way::UdpIn, Cause::NotOpen),
        ]));
    }
    console.press("L");
    console
}

#[test]
fn the_room_of_links_names_the_cause_and_what_to_try() {
    let mut console = ailing();
    shows(
        &console,
        &[
            "FAULT: garbage arrives",
            "Try another rate",
            "peak 4123",
            "noise 1205 B",
            "3/1: 17",
        ],
    );
    console.press("j");
    shows(
        &console,
        &["FAULT: the link is not open", "in use", "next try in 4.0 s"],
    );
    console.press("F").press("L");
    shows(&console, &["the link is not open"]);
    console.press("F").give("links");
    assert_eq!(console.state().room(), Room::Links);
}

/// A recording contains the frames of a link, but not its counters.
#[test]
fn what_a_recording_does_not_contain_is_a_dash() {
    let mut console = Console::flying(0);
    let recorded = LinkSummary {
        counters: None,
        round_trip: None,
        ..link("flight", true)
    };
    console.hear(LinkEvent::Summaries(vec![recorded]));
    console.press("L");
    let screen = console.screen(80, 24);
    let line = |label: &str| {
        let mut lines = screen.lines();
        lines.find(|line| line.contains(label)).unwrap_or_default()
    };
    assert!(line("sent").contains("52 B/s"), "{screen}");
    for label in ["round trip", "dropped", "never arrived", "other"] {
        assert_eq!(line(label).trim_end().chars().last(), Some('-'), "{screen}");
    }
    assert!(line("1 flight").contains(" - "), "{screen}");
}

#[test]
fn many_links_and_many_losses_are_counted_where_they_do_not_fit() {
    let mut console = Console::flying(0);
    let mut links: Vec<_> = (0..9)
        .map(|at| link(&format!("udpin:0.0.0.0:{}", 14550 + at), true))
        .collect();
    links[0].counters = Some(LinkCounters {
        lost: (1..=59).map(|id| ((id, 1), u64::from(id))).collect(),
        ..LinkCounters::default()
    });
    console.hear(LinkEvent::Summaries(links));
    console.press("L");
    let screen = console.screen(80, 24);
    for shown in ["1-5 of 9", "59/1: 59, 58/1: 58", "55/1: 55, +54"] {
        assert!(screen.contains(shown), "{shown}: {screen}");
    }
}

#[test]
fn a_finding_is_told_once_when_no_vehicle_has_come_for_five_seconds() {
    let mut console = Console::new();
    console.start(Activity::Free);
    console.hear(LinkEvent::Summaries(vec![link(
        "udpin:0.0.0.0:14550",
        true,
    )]));
    let findings = || LinkEvent::Findings(vec![finding(0, Way::UdpIn, Cause::Nothing)]);
    let told = |console: &Console| console.state().notices().lines().len();
    console.at(4).hear(findings());
    assert_eq!(told(&console), 0, "too early");
    shows(&console, &["link doctor: no data arrives"]);
    console.at(5).hear(findings());
    console.at(6).hear(findings());
    assert_eq!(told(&console), 1);
    shows(&console, &["udpin:0.0.0.0:14550: no data arrives"]);
}

#[test]
fn a_link_without_a_vehicle_is_told_and_not_counted_as_up_beside_one_that_has_one() {
    let mut console = Console::new();
    console.start(Activity::Free);
    let mut vehicle: Vehicle = fixtures::airborne(1, 20.0, 20.1);
    vehicle.link.via = Some(1);
    console.vehicle(vehicle);
    let addresses = ["serial:/dev/ttyUSB0:57600", "udpin:0.0.0.0:14550"];
    let links = addresses.map(|address| link(address, true));
    console.hear(LinkEvent::Summaries(links.into()));
    console.at(9).hear(LinkEvent::Findings(vec![
        finding(0, Way::Serial, Cause::WrongBaud),
        // The vehicle is silent: its own alert says so.
        finding(1, Way::UdpIn, Cause::Nothing),
    ]));
    let notices = console.state().notices().lines();
    assert_eq!(notices.len(), 1);
    shows(&console, &["serial:/dev/ttyUSB0:57600: ", "1/2"]);
}

#[test]
fn a_vehicle_that_does_not_hear_us_is_told_at_any_time() {
    let mut console = Console::flying(1);
    console.hear(LinkEvent::Summaries(vec![link(
        "udpin:0.0.0.0:14550",
        true,
    )]));
    for second in 20..25 {
        console.at(second);
        console.hear(LinkEvent::Findings(vec![finding(
            0,
            Way::UdpIn,
            Cause::OneWay(1),
        )]));
    }
    let lines = console.state().notices().lines();
    assert_eq!(lines.len(), 1);
    shows(&console, &["never answers"]);
}

#[test]
fn what_a_vehicle_does_not_know_is_no_figure() {
    let mut console = Console::new();
    console.start(Activity::Free);
    let mut vehicle: Vehicle = fixtures::airborne(1, 20.0, 20.1);
    let unknown = f32::NAN;
    vehicle.ekf = vehicle.ekf.map(|ekf| sortie::vehicle::Ekf {
        velocity_variance: unknown,
        ..ekf
    });
    vehicle.vibration = Some(sortie::vehicle::Vibration {
        level_m_s2: [unknown, 3.0, f32::INFINITY],
        clipping: Some([0; 3]),
    });
    vehicle.health = vehicle.health.map(|health| sortie::vehicle::Health {
        load_percent: unknown,
        ..health
    });
    console.vehicle(vehicle);
    let screen = console.screen(200, 50);
    assert!(
        screen.contains("- 3 - m/s²") && screen.contains("BAD  vel -"),
        "{screen}"
    );
    assert!(
        !screen.contains("NaN") && !screen.contains("inf "),
        "{screen}"
    );
}

#[test]
fn signatures_are_counted_where_they_are_used() {
    let mut console = Console::flying(0);
    let mut signed = link("udpin:0.0.0.0:14550", true);
    if let Some(counters) = &mut signed.counters {
        counters.seals = Some(SealCounts {
            right: 1840,
            unsigned: 12,
            foreign: 3,
            old: 40,
            behind: 1_250_000,
        });
    }
    console.hear(LinkEvent::Summaries(vec![signed]));
    let found = [
        Cause::Unsigned(3),
        Cause::WrongKey(3),
        Cause::OldStamps(3, 12),
    ];
    let found = found.map(|cause| finding(0, Way::UdpIn, cause));
    console.hear(LinkEvent::Findings(found.into()));
    console.press("L");
    for (width, height) in [(80, 24), (200, 50)] {
        let name = format!("link_room_signing_{width}x{height}");
        insta::assert_snapshot!(name, console.screen(width, height));
    }
}
