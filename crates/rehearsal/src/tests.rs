use sortie_geo::LatLon;
use sortie_plan::{Home, Item, command};

use super::*;

mod apart;
mod fences;

const HOME: LatLon = LatLon::new(50.4501, 30.5234);

fn item(number: u16, (north_m, east_m): (f64, f64), z: f32) -> Item {
    let (x, y) = HOME.moved(north_m, east_m).to_e7();
    let (x, y) = if command::has_place(number) {
        (x, y)
    } else {
        (0, 0)
    };
    Item {
        command: number,
        frame: 3,
        auto_continue: true,
        params: [0.0; 4],
        x,
        y,
        z,
    }
}

/// A vehicle that starts at a place, flies to others at 20 m and returns.
fn vehicle(start: (f64, f64), way: &[(f64, f64)]) -> Participant {
    let (x, y) = HOME.moved(start.0, start.1).to_e7();
    let mut plan = vec![item(command::TAKEOFF, start, 20.0)];
    plan.extend(way.iter().map(|at| item(command::WAYPOINT, *at, 20.0)));
    plan.push(item(command::RETURN_TO_LAUNCH, start, 0.0));
    Participant {
        document: Document {
            home: Some(Home { x, y, z: 170.0 }),
            plan,
            ..Document::default()
        },
        airframe: None,
        charge_percent: None,
        delay_s: 0.0,
        parameters: Vec::new(),
        fence_switch: None,
    }
}

/// Two vehicles that reach the crossing of their paths at the same time.
fn crossing() -> [Participant; 2] {
    [
        vehicle((0.0, 0.0), &[(100.0, 100.0)]),
        vehicle((0.0, 100.0), &[(100.0, 0.0)]),
    ]
}

fn calm() -> Conditions {
    Conditions::default()
}

#[test]
fn a_plan_takes_its_time_and_its_energy_and_ends_where_it_began() {
    let outcome = rehearse(&[vehicle((0.0, 0.0), &[(200.0, 0.0)])], &calm()).expect("it can fly");
    let flown = outcome.vehicles[0];
    assert_eq!(flown.ending, FlightEnding::Landed);
    assert!((flown.farthest_m - 200.0).abs() < 3.0, "{flown:?}");
    // Up, there, back and down: about 20 + 2 * 24 + 40 s.
    assert!((80.0..160.0).contains(&flown.time_s), "{flown:?}");
    assert!(
        (0.5..50.0).contains(&flown.energy_used_percent),
        "{flown:?}"
    );
    assert_eq!((flown.broke_fence_s, outcome.closest.len()), (None, 0));
    assert_eq!(
        rehearse(&[vehicle((0.0, 0.0), &[(200.0, 0.0)])], &calm()),
        Ok(outcome)
    );
}

#[test]
fn a_plan_without_an_end_ends_in_the_air_and_one_without_a_takeoff_on_the_ground() {
    let mut open = vehicle((0.0, 0.0), &[(50.0, 0.0)]);
    open.document.plan.pop();
    let mut grounded = vehicle((0.0, 50.0), &[(50.0, 50.0)]);
    grounded.document.plan.remove(0);
    let outcome = rehearse(
        &[open, grounded],
        &Conditions {
            limit_s: 200.0,
            ..calm()
        },
    )
    .expect("they can try");
    let endings: Vec<FlightEnding> = outcome.vehicles.iter().map(|flown| flown.ending).collect();
    assert_eq!(endings, [FlightEnding::InAir, FlightEnding::Grounded]);
}

#[test]
fn vehicles_of_one_home_stand_side_by_side_and_wind_costs_energy() {
    let two = [
        vehicle((0.0, 0.0), &[(60.0, 0.0)]),
        vehicle((0.0, 0.0), &[(0.0, 150.0)]),
    ];
    let outcome = rehearse(&two, &calm()).expect("they can fly");
    let moved: Vec<f64> = outcome
        .vehicles
        .iter()
        .map(|flown| flown.moved_east_m)
        .collect();
    assert_eq!(moved, [0.0, 8.0]);
    let windy = Conditions {
        wind_m_s: 9.0,
        wind_from_deg: 90.0,
        ..calm()
    };
    let blown = rehearse(&two[1..], &windy).expect("they can fly").vehicles[0];
    let still = rehearse(&two[1..], &calm()).expect("they can fly").vehicles[0];
    assert!(
        blown.energy_used_percent > still.energy_used_percent,
        "{blown:?} {still:?}"
    );
}

#[test]
fn what_cannot_be_flown_is_said() {
    let mut homeless = vehicle((0.0, 0.0), &[(10.0, 0.0)]);
    homeless.document.home = None;
    assert_eq!(
        rehearse(&[homeless], &calm()),
        Err(RehearsalError::NoHome(0))
    );
    let empty = Participant {
        document: Document::default(),
        ..vehicle((0.0, 0.0), &[])
    };
    assert_eq!(rehearse(&[empty], &calm()), Err(RehearsalError::NoPlan(0)));
    let mut refused = vehicle((0.0, 0.0), &[(10.0, 0.0)]);
    refused.document.plan[1].command = 195;
    assert_eq!(
        rehearse(&[refused], &calm()),
        Err(RehearsalError::Refused(0, ListKind::Plan))
    );
    let wrong = Conditions {
        parameters: vec![("NO_SUCH".to_owned(), 1.0)],
        ..calm()
    };
    let one = vehicle((0.0, 0.0), &[(10.0, 0.0)]);
    assert_eq!(
        rehearse(&[one], &wrong),
        Err(RehearsalError::NoParameter("NO_SUCH".to_owned()))
    );
}

/// The voltage follows the charge, so a failsafe acts as early as on the vehicle.
#[test]
fn a_partly_used_battery_fails_where_a_full_one_does_not() {
    let mut hover = vehicle((0.0, 0.0), &[(30.0, 0.0)]);
    hover.document.plan[1].command = command::LOITER_TIME;
    hover.document.plan[1].params = [120.0, 0.0, 0.0, 0.0];
    let ending = |charge_percent| {
        let mut one = hover.clone();
        one.charge_percent = charge_percent;
        rehearse(&[one], &calm()).expect("it can fly").vehicles[0].ending
    };
    assert_eq!(ending(None), FlightEnding::Landed);
    assert_eq!(ending(Some(100.0)), FlightEnding::Landed);
    assert!(matches!(ending(Some(40.0)), FlightEnding::LeftPlan(_)));
}

/// Without battery failsafes, the vehicle sinks to the ground with its motors on.
#[test]
fn a_plan_that_empties_the_battery_does_not_fly_on_for_ever() {
    let mut long = vehicle((0.0, 0.0), &[(30.0, 0.0)]);
    long.document.plan[1].command = command::LOITER_TIME;
    long.document.plan[1].params = [900.0, 0.0, 0.0, 0.0];
    long.parameters = ["BATT_FS_LOW_ACT", "BATT_FS_CRT_ACT"]
        .map(|name| (name.to_owned(), 0.0))
        .into();
    let flown = rehearse(&[long], &calm()).expect("it can fly").vehicles[0];
    assert!(
        matches!(flown.ending, FlightEnding::HitGround(_)) && flown.time_s < 1000.0,
        "{flown:?}"
    );
}

/// An item far below home, as with a wrong height reference: the vehicle flies into the ground on
/// the way to it.
#[test]
fn a_plan_that_leads_into_the_ground_does_not_land() {
    let mut low = vehicle((0.0, 0.0), &[(60.0, 0.0), (120.0, 0.0), (180.0, 0.0)]);
    low.document.plan[2].frame = 0;
    low.document.plan[2].z = 60.0;
    let waits = Item {
        params: [3.0, -1.0, -1.0, -1.0],
        ..item(command::DELAY, (0.0, 0.0), 0.0)
    };
    let mut waiting = low.clone();
    waiting.document.plan.insert(0, waits);
    for (plan, item) in [(low, 3), (waiting, 4)] {
        let flown = rehearse(&[plan], &calm()).expect("it can fly").vehicles[0];
        assert_eq!(flown.ending, FlightEnding::HitGround(item), "{flown:?}");
        assert!(flown.time_s < 60.0, "{flown:?}");
    }
}

/// The telemetry of a rehearsal comes from all vehicles, and listening changes nothing.
#[test]
fn a_rehearsal_can_be_heard() {
    let both = crossing();
    let mut heard = [0; 2];
    let mut last_s = 0.0;
    let outcome = rehearse_heard(&both, &calm(), &mut |it: Heard<'_>| {
        assert!(it.at_s >= last_s);
        last_s = it.at_s;
        heard[it.vehicle] += it.bytes.len();
    });
    let outcome = outcome.expect("they can fly");
    assert!(heard.iter().all(|bytes| *bytes > 20_000), "{heard:?}");
    assert!((last_s - outcome.simulated_s).abs() < 1.0, "{last_s}");
    assert_eq!(rehearse(&both, &calm()), Ok(outcome));
}
