use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::*;
use crate::app::event::{Event, SessionEvent, Started, VehicleEvent};
use crate::app::state::Activity;
use crate::app::{App, Setup};
use crate::vehicle::{Battery, Vehicle};

/// A console that has heard two vehicles, each with this percentage of charge left.
fn heard(app: &mut App, percent: u8) {
    for id in [1, 2] {
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
        let event: Event = VehicleEvent::Telemetry(Arc::new(vehicle)).into();
        drop(app.update(event));
    }
}

#[test]
fn an_alert_is_printed_when_it_is_raised_and_when_it_becomes_worse() {
    let mut app = App::new(Setup::default());
    let started = Started {
        activity: Activity::Free,
        mission: None,
        places: BTreeMap::new(),
        areas: Vec::new(),
        processes: None,
        speedup: 1.0,
        is_again: false,
    };
    drop(app.update(SessionEvent::Started(Box::new(started))));
    let mut report = PlainReport::default();
    let mut news = |app: &App| -> Vec<String> {
        let texts = report.alerts.news(app.state());
        texts.iter().map(ToString::to_string).collect()
    };
    heard(&mut app, 80);
    assert_eq!(news(&app), Vec::<String>::new());
    heard(&mut app, 18);
    assert_eq!(news(&app), ["00:00 1-2: warning: battery low 18 %"]);
    heard(&mut app, 18);
    assert_eq!(news(&app), Vec::<String>::new());
    heard(&mut app, 8);
    assert_eq!(news(&app), ["00:00 1-2: CRITICAL: BATTERY 8 %"]);
}
