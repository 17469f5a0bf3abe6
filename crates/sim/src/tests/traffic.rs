//! ADS-B traffic, as SITL simulates it.

use std::collections::BTreeSet;

use mavlink::dialects::ardupilotmega::{ADSB_VEHICLE_DATA, MavCmd, MavMessage};

use super::arming::rebooted;
use super::*;

/// A ground station that receives traffic, after a reboot with these parameters.
fn watching(seed: u64, parameters: &[(&str, f32)]) -> Ground {
    let config = WorldConfig {
        seed,
        ..WorldConfig::row(1, start())
    };
    let mut ground = Ground::in_world(&config);
    for (name, value) in parameters {
        ground.set(name, *value);
    }
    let mut ground = rebooted(ground);
    ground.long(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, [246.0, 100_000.0]);
    ground
}

const BUSY: [(&str, f32); 4] = [
    ("SIM_ADSB_COUNT", 12.0),
    ("SIM_ADSB_RADIUS", 1500.0),
    ("SIM_ADSB_ALT", 200.0),
    ("ADSB_TYPE", 1.0),
];

fn heard(ground: &Ground, from: usize) -> Vec<ADSB_VEHICLE_DATA> {
    let messages = ground.messages_since(from).into_iter();
    let reports = messages.filter_map(|message| match message {
        MavMessage::ADSB_VEHICLE(data) => Some(data.clone()),
        _ => None,
    });
    reports.collect()
}

#[test]
fn aircraft_appear_after_ten_seconds_once_a_second_each() {
    let mut ground = watching(1, &BUSY);
    ground.run(7.0);
    assert!(heard(&ground, 0).is_empty(), "not before 10 s");
    ground.run(5.0);
    let before = ground.heard.len();
    ground.run(12.0);
    let reports = heard(&ground, before);
    // Twelve aircraft at ten messages per second: a list takes 1.2 s.
    assert!((100..=125).contains(&reports.len()), "{}", reports.len());
    let known: BTreeSet<u32> = reports.iter().map(|it| it.ICAO_address).collect();
    assert!(known.len() >= 12, "{known:?}");
    for report in &reports {
        let at = LatLon::new(f64::from(report.lat) / 1e7, f64::from(report.lon) / 1e7);
        assert!(at.distance_m(start().at) < 1600.0);
        assert!(report.altitude > 0, "{report:?}");
        let name = format!("SIM{}", report.ICAO_address);
        assert_eq!(report.callsign.to_str(), Ok(name.as_str()));
    }
    // Each flies straight: two reports of one aircraft are as far apart as its speed says.
    let icao = reports[0].ICAO_address;
    let own: Vec<_> = reports
        .iter()
        .filter(|it| it.ICAO_address == icao)
        .collect();
    assert!(own.len() > 2 || known.len() > 12);
}

#[test]
fn the_same_seed_has_the_same_traffic() {
    let fly = |seed| {
        let mut ground = watching(seed, &BUSY);
        ground.run(15.0);
        heard(&ground, 0)
    };
    let first = fly(7);
    assert!(!first.is_empty());
    assert_eq!(first, fly(7));
    assert_ne!(first, fly(8));
}

#[test]
fn without_receiver_or_aircraft_there_are_no_reports() {
    for (name, value) in [
        ("ADSB_TYPE", 0.0),
        ("SIM_ADSB_COUNT", -1.0),
        ("SIM_ADSB_TYPES", 0.0),
    ] {
        let mut ground = watching(1, &BUSY);
        ground.set(name, value);
        let mut ground = rebooted(ground);
        ground.long(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, [246.0, 100_000.0]);
        let before = ground.heard.len();
        ground.run(20.0);
        assert_eq!(heard(&ground, before), [], "{name}");
    }
    // The defaults of SITL: no aircraft, and no receiver.
    let mut ground = watching(1, &[]);
    ground.run(20.0);
    assert_eq!(heard(&ground, 0), []);
}

#[test]
fn the_list_has_a_radius_and_a_length() {
    let mut near = BUSY.to_vec();
    near.extend([("ADSB_LIST_RADIUS", 700.0), ("ADSB_LIST_MAX", 3.0)]);
    let mut ground = watching(3, &near);
    ground.run(12.0);
    let before = ground.heard.len();
    ground.run(1.0);
    let reports = heard(&ground, before);
    assert!(reports.len() <= 3, "{}", reports.len());
    for report in reports {
        let at = LatLon::new(f64::from(report.lat) / 1e7, f64::from(report.lon) / 1e7);
        assert!(at.distance_m(start().at) < 850.0);
    }
}
