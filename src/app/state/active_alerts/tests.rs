use super::*;
use crate::vehicle::{Battery, USUAL_RESERVE_PERCENT};

fn at(seconds: u64) -> Duration {
    Duration::from_secs(seconds)
}

fn charged(id: u8, percent: u8) -> Vehicle {
    let mut vehicle = Vehicle::new(id, 1);
    vehicle.batteries.push(Battery {
        id: 0,
        voltage_v: None,
        current_a: None,
        consumed_mah: None,
        consumed_wh: None,
        remaining_percent: Some(percent),
        at: Duration::ZERO,
    });
    vehicle
}

fn silent(id: u8, heard_s: u64) -> Vehicle {
    let mut vehicle = Vehicle::new(id, 1);
    vehicle.link.lost = true;
    vehicle.link.last_heard = Some(at(heard_s));
    vehicle
}

#[test]
fn an_alert_stands_since_it_became_as_serious_as_it_is() {
    let mut alerts = ActiveAlerts::default();
    alerts.observe(&charged(1, 20), USUAL_RESERVE_PERCENT, at(10));
    alerts.observe(&charged(1, 19), USUAL_RESERVE_PERCENT, at(40));
    assert_eq!(alerts.worst(1).map(|one| one.since), Some(at(10)));
    assert_eq!(alerts.acknowledge(|_, _| true), 1);
    alerts.observe(&charged(1, 9), USUAL_RESERVE_PERCENT, at(70));
    let worst = alerts.worst(1).expect("it is worse now");
    assert_eq!((worst.since, worst.acknowledged), (at(70), false));
    alerts.observe(&silent(2, 55), USUAL_RESERVE_PERCENT, at(60));
    let since = alerts.worst(2).map(|one| one.since);
    assert_eq!(since, Some(at(55)), "since it was heard last");
}

#[test]
fn what_is_acknowledged_stays_but_presses_nobody_and_does_not_ring_again() {
    let mut alerts = ActiveAlerts::default();
    alerts.observe(&silent(1, 1), USUAL_RESERVE_PERCENT, at(5));
    assert!(alerts.due(at(5)).ring);
    alerts.acknowledge(|_, _| true);
    assert_eq!(alerts.pressing(), None);
    alerts.observe(&Vehicle::new(1, 1), USUAL_RESERVE_PERCENT, at(8));
    assert_eq!(alerts.worst(1), None, "it has ended");
    alerts.observe(&silent(1, 8), USUAL_RESERVE_PERCENT, at(12));
    assert!(alerts.worst(1).is_some_and(|one| one.acknowledged));
    assert!(!alerts.due(at(30)).ring, "it only flickered");
    alerts.observe(&Vehicle::new(1, 1), USUAL_RESERVE_PERCENT, at(40));
    alerts.observe(&Vehicle::new(1, 1), USUAL_RESERVE_PERCENT, at(51));
    alerts.observe(&silent(1, 52), USUAL_RESERVE_PERCENT, at(55));
    assert!(alerts.due(at(55)).ring, "a new one");
}

#[test]
fn the_worst_kind_presses_with_all_its_vehicles() {
    let mut alerts = ActiveAlerts::default();
    alerts.observe(&charged(1, 20), USUAL_RESERVE_PERCENT, at(1));
    for id in [4, 2, 3] {
        alerts.observe(&silent(id, 1), USUAL_RESERVE_PERCENT, at(5));
    }
    let pressing = alerts.pressing().expect("four alerts");
    assert_eq!(pressing.vehicles, [2, 3, 4]);
    assert_eq!((pressing.alike, pressing.others), (true, 1));
    alerts.acknowledge(|_, kind| kind == AlertKind::LinkLost);
    assert_eq!(alerts.pressing().map(|it| it.vehicles), Some(vec![1]));
}

#[test]
fn a_muted_kind_is_shown_but_neither_rings_nor_presses() {
    let mut alerts = ActiveAlerts::default();
    alerts.mute(&[AlertKind::LinkLost]);
    alerts.observe(&silent(1, 1), USUAL_RESERVE_PERCENT, at(5));
    assert!(alerts.worst(1).is_some());
    assert_eq!(alerts.pressing(), None);
    assert_eq!(alerts.due(at(30)), Due::default());
    alerts.observe(&charged(1, 20), USUAL_RESERVE_PERCENT, at(6));
    let worst = alerts.worst(1).map(|one| one.alert.kind);
    assert_eq!(
        worst,
        Some(AlertKind::Battery),
        "what is not calm goes first"
    );
}

#[test]
fn a_text_about_an_alert_that_stands_does_not_ring_too() {
    let mut alerts = ActiveAlerts::default();
    alerts.observe(&silent(1, 1), USUAL_RESERVE_PERCENT, at(5));
    assert!(alerts.due(at(5)).ring);
    let call = |kind| BellCall {
        kind,
        severity: Severity::Critical,
        vehicle: Some(1),
        text: "words".into(),
        worse: false,
    };
    alerts.hear(at(20), call(AlertKind::LinkLost));
    assert!(!alerts.due(at(20)).ring);
    alerts.hear(at(20), call(AlertKind::Message));
    assert!(alerts.due(at(20)).ring);
}

#[test]
fn after_a_reboot_the_checks_before_arming_begin_anew() {
    let mut unready = Vehicle::new(1, 1);
    unready.prearm.push("GPS not healthy".to_owned());
    unready.health = Some(crate::vehicle::Health {
        present: crate::vehicle::Health::PREARM,
        enabled: crate::vehicle::Health::PREARM,
        healthy: 0,
        load_percent: 0.0,
        at: Duration::ZERO,
    });
    let mut alerts = ActiveAlerts::default();
    alerts.observe(&unready, USUAL_RESERVE_PERCENT, at(43));
    let since = alerts.worst(1).map(|one| one.since);
    assert_eq!(since, Some(at(43)));
    let mut booted = Vehicle::new(1, 1);
    booted.link.reboots = 1;
    alerts.observe(&booted, USUAL_RESERVE_PERCENT, at(60));
    unready.link.reboots = 1;
    alerts.observe(&unready, USUAL_RESERVE_PERCENT, at(62));
    let since = alerts.worst(1).map(|one| one.since);
    assert_eq!(since, Some(at(62)));
}

#[test]
fn a_jump_and_another_sender_raise_alerts() {
    let mut vehicle = Vehicle::new(1, 1);
    vehicle.jump = Some(crate::vehicle::PositionJump {
        distance_m: 19_900_000.0,
        at: at(10),
    });
    vehicle.link.moved_at = Some(at(10));
    let mut alerts = ActiveAlerts::default();
    alerts.observe(&vehicle, USUAL_RESERVE_PERCENT, at(11));
    let pressing = alerts.pressing().expect("both press");
    assert!(pressing.first.alert.text.to_string().contains("19900.0 km"));
    assert_eq!(pressing.others, 1);
    alerts.acknowledge(|_, _| true);
    assert_eq!(alerts.pressing(), None);
}
