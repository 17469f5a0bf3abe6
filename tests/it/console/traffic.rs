//! Other aircraft: alerts, the map, and the list.

use std::time::Duration;

use sortie::alert::AlertKind;
use sortie::app::state::Activity;
use sortie::vehicle::{Aircraft, Severity, Vehicle};

use crate::fixtures;
use crate::harness::Console;

/// A vehicle 30 m above home. Its receiver reports an eastbound aircraft 800 m to the west and
/// `north_m` to the north of the vehicle.
fn watcher(north_m: f64, seconds: u64) -> Vehicle {
    let mut vehicle = fixtures::airborne(1, 0.0, 30.0);
    let here = vehicle.global.as_mut().expect("a place");
    here.north_m_s = 0.0;
    let here = *here;
    let (icao, callsign) = (0x50_80_12, "MEDEVAC1".to_owned());
    let aircraft = Aircraft {
        icao: Some(icao),
        callsign,
        at_point: here.at_point.moved(north_m, -800.0),
        altitude_amsl_m: here.altitude_amsl_m + 20.0,
        velocity_m_s: Some([0.0, 40.0]),
        climb_m_s: Some(0.0),
        at: Duration::from_secs(seconds),
    };
    vehicle.traffic.note(icao, aircraft);
    vehicle
}

fn free() -> Console {
    let mut console = Console::new();
    console.start(Activity::Free);
    console
}

fn alert(console: &Console) -> Option<(Severity, String)> {
    let alerts = console.state().session().alerts();
    let found = alerts.of(1).find(|it| it.alert.kind == AlertKind::Traffic);
    found.map(|it| (it.alert.severity, it.alert.text.to_string()))
}

#[test]
fn an_aircraft_that_comes_close_raises_an_alert_that_is_acknowledged_like_others() {
    let mut console = free();
    console.vehicle(watcher(200.0, 10)).at(10);
    let (severity, text) = alert(&console).expect("it comes within 300 m");
    assert_eq!(severity, Severity::Warning);
    assert_eq!(
        text,
        "TRAFFIC MEDEVAC1: closest 200 m, +20 m vertical, in 20 s"
    );
    let notices = |console: &Console| {
        let lines = console.state().notices().lines();
        lines
            .filter(|line| line.notice.text.to_string().contains("MEDEVAC1"))
            .count()
    };
    assert_eq!(notices(&console), 1);
    console.press("x").at(11);
    assert!(console.state().session().alerts().pressing().is_none());
    // Within 100 m it is worse, and calls again.
    console.vehicle(watcher(50.0, 20)).at(20);
    assert_eq!(alert(&console).map(|it| it.0), Some(Severity::Critical));
    assert!(console.state().session().alerts().pressing().is_some());
    assert_eq!(notices(&console), 2);
    // Far away, and on the ground, there is none.
    console.vehicle(watcher(900.0, 24)).at(24);
    assert_eq!(alert(&console), None);
    let parked = Vehicle {
        landed: sortie::vehicle::LandedState::OnGround,
        ..watcher(50.0, 28)
    };
    console.vehicle(parked).at(28);
    assert_eq!(alert(&console), None);
}

#[test]
fn traffic_is_on_the_map_and_in_a_list() {
    let mut console = free();
    console.vehicle(watcher(50.0, 10)).at(10);
    for (columns, rows) in [(80, 24), (200, 50)] {
        console.press("M").screen(columns, rows);
        console.press("f");
        for _ in 0..12 {
            if console.screen(columns, rows).contains("MEDEVAC1") {
                break;
            }
            console.press("-");
        }
        let screen = console.screen(columns, rows);
        assert!(screen.contains("A→MEDEVAC1 +20 m"), "{screen}");
        console.press("z");
    }
    console.at(15);
    let screen = console.give("traffic").screen(120, 24);
    for part in [
        "MEDEVAC1",
        "course 090, 40 m/s",
        "5 s old",
        "vehicle 1: now 602 m, +20 m vertical; closest in 15 s: 50 m, +20 m vertical",
    ] {
        assert!(screen.contains(part), "{part}: {screen}");
    }
    let narrow = console.screen(80, 24);
    assert!(narrow.contains("MEDEVAC1"), "{narrow}");
    console.press("esc");
    // Without reports it drops out.
    let mut silent = fixtures::airborne(1, 0.0, 30.0);
    silent.traffic = sortie::vehicle::Traffic::default();
    console.vehicle(silent).at(30);
    let screen = console.give("traffic").screen(80, 24);
    assert!(!screen.contains("MEDEVAC1"), "{screen}");
}
