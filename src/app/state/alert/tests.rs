use super::*;
use crate::text::said::without_words;
use crate::vehicle::{
    Battery, Fence, Health, Heartbeat, StatusText, SystemStatus, USUAL_RESERVE_PERCENT,
    VehicleClass,
};

fn vehicle() -> Vehicle {
    let mut vehicle = Vehicle::new(1, 1);
    vehicle.health = Some(Health {
        present: 0,
        enabled: 0,
        healthy: Health::PREARM,
        load_percent: 0.0,
        at: Duration::ZERO,
    });
    vehicle
}

fn heartbeat(status: SystemStatus) -> Heartbeat {
    Heartbeat {
        mav_type: 2,
        autopilot: 3,
        class: VehicleClass::Copter,
        mode: VehicleClass::Copter.mode("GUIDED").expect("a mode"),
        armed: false,
        status,
        at: Duration::ZERO,
    }
}

fn text_of(vehicle: &Vehicle) -> Option<String> {
    alert(vehicle, USUAL_RESERVE_PERCENT, Duration::from_secs(10))
        .map(|alert| alert.text.to_string())
}

#[test]
fn a_healthy_vehicle_has_no_alert() {
    assert_eq!(text_of(&vehicle()), None);
    assert_eq!(
        text_of(&Vehicle::new(1, 1)),
        None,
        "nothing known is nothing wrong"
    );
}

#[test]
fn the_most_serious_condition_wins() {
    let mut vehicle = vehicle();
    vehicle.health = vehicle.health.map(|health| Health {
        healthy: 0,
        ..health
    });
    assert_eq!(text_of(&vehicle).as_deref(), Some("not ready to arm"));
    vehicle.prearm.push("Need Position Estimate".to_owned());
    assert_eq!(text_of(&vehicle).as_deref(), Some("Need Position Estimate"));
    vehicle.fence = Some(Fence {
        breached: true,
        breaches: 1,
        breach_type: 1,
    });
    assert_eq!(text_of(&vehicle).as_deref(), Some("outside fence"));
    vehicle.batteries.push(Battery {
        id: 0,
        voltage_v: None,
        current_a: None,
        consumed_mah: None,
        consumed_wh: None,
        remaining_percent: Some(9),
        at: Duration::ZERO,
    });
    assert_eq!(text_of(&vehicle).as_deref(), Some("BATTERY 9 %"));
    vehicle.link.lost = true;
    vehicle.link.last_heard = Some(Duration::from_secs(4));
    assert_eq!(text_of(&vehicle).as_deref(), Some("LINK LOST"));
    vehicle.texts.push(StatusText {
        severity: Severity::Critical,
        text: "Crash: Disarming: AngErr=179>30".to_owned(),
        at: Duration::from_secs(9),
    });
    assert_eq!(text_of(&vehicle).as_deref(), Some("CRASHED, disarmed"));
}

#[test]
fn a_crash_is_shown_until_the_vehicle_is_armed_again() {
    let hear = |vehicle: &mut Vehicle, text: &str| {
        vehicle.texts.push(StatusText {
            severity: Severity::Critical,
            text: text.to_owned(),
            at: Duration::ZERO,
        });
    };
    let long_after = Duration::from_secs(1000);
    let shown = |vehicle: &Vehicle| {
        alert(vehicle, USUAL_RESERVE_PERCENT, long_after).map(|alert| alert.text.to_string())
    };
    let mut vehicle = vehicle();
    hear(&mut vehicle, "SIM Hit ground at 0.48 m/s");
    assert_eq!(shown(&vehicle), None, "a landing");
    hear(&mut vehicle, "SIM Hit ground at 15.97 m/s");
    hear(&mut vehicle, "Disarming motors");
    assert_eq!(shown(&vehicle).as_deref(), Some("CRASHED at 16 m/s"));
    hear(&mut vehicle, "Arming motors");
    assert_eq!(shown(&vehicle), None);
}

#[test]
fn a_vehicle_that_came_down_hard_and_stays_armed_has_crashed() {
    let mut vehicle = vehicle();
    vehicle.heartbeat = Some(Heartbeat {
        armed: true,
        ..heartbeat(SystemStatus::Active)
    });
    for (text, expected) in [
        ("SIM Hit ground at 13.6 m/s", None),
        ("Arming motors", None),
        ("SIM Hit ground at 12.662 m/s", Some("CRASHED at 13 m/s")),
        ("Arming motors", None),
    ] {
        vehicle.texts.push(StatusText {
            severity: Severity::Info,
            text: text.to_owned(),
            at: Duration::ZERO,
        });
        assert_eq!(text_of(&vehicle).as_deref(), expected, "after {text}");
    }
}

#[test]
fn a_vehicle_that_falls_says_so() {
    let mut vehicle = vehicle();
    vehicle.landed = LandedState::InAir;
    assert_eq!(text_of(&vehicle), None, "whether it is armed is not known");
    vehicle.heartbeat = Some(heartbeat(SystemStatus::Active));
    assert_eq!(
        text_of(&vehicle).as_deref(),
        Some("MOTORS STOPPED in the air")
    );
}

#[test]
fn a_failsafe_that_is_over_or_that_only_forbids_arming_is_no_reason_for_the_alert() {
    let mut vehicle = vehicle();
    vehicle.heartbeat = Some(heartbeat(SystemStatus::Critical));
    for (text, alert) in [
        (
            "EKF Failsafe: changed to LAND Mode",
            "EKF Failsafe: changed to LAND Mode",
        ),
        ("EKF Failsafe Cleared", "FAILSAFE active"),
        ("Battery Failsafe", "Battery Failsafe"),
        ("PreArm: Battery failsafe on", "Battery Failsafe"),
        ("Arm: Battery failsafe on", "Battery Failsafe"),
    ] {
        vehicle.texts.push(StatusText {
            severity: Severity::Critical,
            text: text.to_owned(),
            at: Duration::from_secs(9),
        });
        assert_eq!(text_of(&vehicle).as_deref(), Some(alert));
    }
}

/// Vehicles with every possible fault, by their STATUSTEXTs and values.
fn troubled() -> Vec<Vehicle> {
    let said = [
        "Crash: Disarming: AngErr=57>30",
        "SIM Hit ground at 9.1 m/s",
        "Battery Failsafe",
        "PreArm: GPS 1 not healthy",
    ];
    let mut all: Vec<Vehicle> = said
        .iter()
        .map(|text| {
            let mut vehicle = vehicle();
            vehicle.heartbeat = Some(heartbeat(SystemStatus::Critical));
            vehicle.texts.push(StatusText {
                severity: Severity::Critical,
                text: (*text).to_owned(),
                at: Duration::ZERO,
            });
            vehicle
        })
        .collect();
    let mut silent = vehicle();
    silent.link.lost = true;
    let mut unready = vehicle();
    unready.health = unready.health.map(|health| Health {
        enabled: Health::PREARM,
        present: Health::PREARM,
        healthy: 0,
        ..health
    });
    let mut falling = vehicle();
    falling.heartbeat = Some(heartbeat(SystemStatus::Active));
    falling.landed = LandedState::InAir;
    all.extend([silent, unready, falling]);
    all
}

#[test]
fn the_kind_of_an_alert_does_not_depend_on_the_words() {
    let kinds = || -> Vec<Vec<(AlertKind, Severity)>> {
        let all = troubled();
        let kinds = all.iter().map(|vehicle| {
            alerts(vehicle, USUAL_RESERVE_PERCENT, Duration::from_secs(10))
                .map(|it| (it.kind, it.severity))
        });
        kinds.map(Iterator::collect).collect()
    };
    assert!(kinds().iter().all(|kinds| !kinds.is_empty()));
    assert_eq!(without_words(kinds), kinds());
}

#[test]
fn the_way_home_is_watched_until_the_vehicle_is_on_it() {
    let mut vehicle = vehicle();
    let home = crate::geo::LatLon::new(50.0, 30.0);
    vehicle.home = Some(crate::vehicle::Place {
        at_point: home,
        altitude_amsl_m: 180.0,
    });
    vehicle.global = Some(crate::vehicle::GlobalPosition {
        at_point: home.moved(400.0, 0.0),
        altitude_amsl_m: 200.0,
        altitude_m: 20.0,
        north_m_s: 0.0,
        east_m_s: 0.0,
        down_m_s: 0.0,
        heading_deg: None,
        at: Duration::ZERO,
    });
    vehicle.landed = LandedState::InAir;
    let mut said = |mode: &str, left: u8| {
        vehicle.heartbeat = Some(Heartbeat {
            mode: VehicleClass::Copter.mode(mode).expect("a mode"),
            armed: true,
            ..heartbeat(SystemStatus::Active)
        });
        // 4 Ah at 30 A: 0.2 % a second, and the way home takes 84 s.
        let now = Duration::from_secs(1);
        vehicle.load = crate::vehicle::MeanCurrent::after(None, 30.0, now);
        vehicle.batteries = vec![Battery {
            id: 0,
            voltage_v: Some(11.0),
            current_a: Some(30.0),
            consumed_mah: Some(40.0 * (99.5 - f32::from(left))),
            consumed_wh: None,
            remaining_percent: Some(left),
            at: now,
        }];
        let found = alerts(&vehicle, USUAL_RESERVE_PERCENT, now)
            .find(|alert| alert.kind == AlertKind::WayHome);
        found.map(|alert| (alert.severity, alert.text.to_string()))
    };
    assert_eq!(said("GUIDED", 60), None);
    let warning = Some((
        Severity::Warning,
        "turn back: 35 % left, 38 % needed".to_owned(),
    ));
    assert_eq!(said("GUIDED", 35), warning);
    assert_eq!(said("RTL", 35), None);
    let critical = Some((Severity::Critical, "HOME OUT OF REACH".to_owned()));
    assert_eq!(said("RTL", 12), critical);
    assert_eq!(said("LAND", 12), None);
}
