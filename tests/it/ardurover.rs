//! The console's fleet against a real `ArduRover`, named by `SORTIE_ARDUROVER`, as a rover and as a boat.

use std::collections::BTreeMap;

use sortie::geo::LatLon;
use sortie::ledger::RowState;
use sortie::sim::Start;
use sortie::sitl::{Recipe, SitlKind};

use crate::fleet::Console;
use crate::sitl::{self, Sitl};

/// The SITL instances of these tests: TCP port 5760 plus ten per instance, which avoids ports that other programs
/// usually use.
const ROVER: u16 = 88;
const BOAT: u16 = 89;

/// Starts a model as vehicle 7, as the hangar does, five times as fast as real time.
fn start(model: &str, instance: u16) -> Sitl {
    let recipe = Recipe {
        kind: SitlKind::Rover,
        model: Some(model.to_owned()),
        airframe: None,
        start: Start {
            at: LatLon::new(50.45, 30.52),
            altitude_amsl_m: 120.0,
            heading_deg: 0.0,
        },
        system: 7,
        speedup: 5.0,
        parameters: BTreeMap::new(),
    };
    Sitl::of(&sitl::ardurover(), &recipe, instance)
}

/// A console with the vehicle, once it can be armed.
async fn connected(instance: u16) -> Console {
    let mut console = Console::start();
    console.connect(&format!("tcp:127.0.0.1:{}", 5760 + 10 * instance));
    let is_ready = |console: &Console| console.vehicle(7).is_some_and(|it| it.ready_to_arm());
    console.until("the position is known", is_ready).await;
    console
}

/// Gives lines, each once the one before is done.
async fn done(console: &mut Console, lines: &[&str]) {
    for line in lines {
        let entry = console.give(line, &[7]);
        console.until_done(entry, 7).await;
        eprintln!("{line}: {}", console.explanation(entry, 7));
    }
}

/// Gives a line that the console refuses; returns the reason.
async fn refused(console: &mut Console, line: &str) -> String {
    let entry = console.give(line, &[7]);
    let is_over = |console: &Console| console.state(entry, 7).is_some_and(RowState::is_final);
    console.until("it is refused", is_over).await;
    assert_eq!(console.state(entry, 7), Some(RowState::Refused), "{line}");
    console.explanation(entry, 7)
}

fn away_m(console: &Console) -> f64 {
    let vehicle = console.vehicle(7).expect("it appeared");
    vehicle.distance_home_m().expect("it has a home")
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs SORTIE_ARDUROVER"]
async fn a_real_ardurover_drives_to_places_and_back() {
    let _sitl = start("rover", ROVER);
    let mut console = connected(ROVER).await;
    done(&mut console, &["guided", "arm"]).await;
    for (line, reason) in [
        ("takeoff 10", "it is a rover, which does not take off"),
        ("land", "which does not land"),
        ("altitude 10", "no height to change"),
        ("yaw 90", "turns only as it moves"),
        ("orbit 20", "mode circle"),
        ("resume", "`7 plan resume`"),
        ("speed climb 2", "neither climbs nor descends"),
        // The vehicle refuses this one, without a reason of its own.
        ("speed 3", "`goto` first"),
    ] {
        let why = refused(&mut console, line).await;
        assert!(why.contains(reason), "{line}: {why}");
    }
    done(&mut console, &["goto by n 40 e 10"]).await;
    assert!((away_m(&console) - 41.2).abs() < 5.0);
    let vehicle = console.vehicle(7).expect("it appeared");
    assert!(!vehicle.airborne() && vehicle.is_under_way());
    done(&mut console, &["velocity n 0 e 1.5 for 10"]).await;
    done(&mut console, &["hold", "guided", "rtl"]).await;
    assert!(away_m(&console) < 4.0);
    done(&mut console, &["smartrtl", "disarm"]).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs SORTIE_ARDUROVER"]
async fn a_real_ardurover_is_a_boat_that_holds_its_place() {
    let _sitl = start("motorboat", BOAT);
    let mut console = connected(BOAT).await;
    let vehicle = console.vehicle(7).expect("it appeared");
    assert!(vehicle.is_boat());
    done(&mut console, &["guided", "arm", "goto by n 30 e 0"]).await;
    let reason = refused(&mut console, "takeoff 5").await;
    assert!(reason.contains("it is a boat"), "{reason}");
    done(&mut console, &["hold"]).await;
    let vehicle = console.vehicle(7).expect("it appeared");
    assert_eq!(vehicle.mode_name().as_deref(), Some("LOITER"));
    done(&mut console, &["rtl", "disarm"]).await;
    assert!(away_m(&console) < 5.0);
}
