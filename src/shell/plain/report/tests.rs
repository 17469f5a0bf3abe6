use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::*;
use crate::app::event::{CrewEvent, Event, LinkEvent, SessionEvent, Started, VehicleEvent};
use crate::app::state::{Activity, CrewPart, LinkSummary, MemberPlace};
use crate::app::{App, Setup};
use crate::crew::Role;
use crate::crew::protocol::{HostMessage, VERSION};
use crate::doctor::{Cause, LinkFinding, Way};
use crate::ledger::{ForeignCommand, ForeignId, RowState, StationId};
use crate::mission::{Listing, Mission, Stake};
use crate::vehicle::{Battery, Vehicle};
use crate::wire::MavAddress;

/// Starts a flight at the console.
fn start(app: &mut App, activity: Activity, mission: Option<Box<Listing>>) {
    let started = Started {
        activity,
        mission,
        places: BTreeMap::new(),
        areas: Vec::new(),
        processes: None,
        speedup: 1.0,
        is_again: false,
    };
    drop(app.update(SessionEvent::Started(Box::new(started))));
}

/// Lets `app` hear two vehicles, each with `percent` % of charge left.
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
    start(&mut app, Activity::Free, None);
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

#[test]
fn a_command_of_another_station_is_printed_with_its_answer() {
    let mut app = App::new(Setup::default());
    let mut report = PlainReport::default();
    let mut news = |app: &App| -> Vec<String> {
        let texts = report.commands.news(app.state());
        texts.iter().map(ToString::to_string).collect()
    };
    let foreign = |state, count| {
        VehicleEvent::Foreign(ForeignCommand {
            id: ForeignId(0),
            station: StationId(MavAddress {
                system: 254,
                component: 230,
            }),
            vehicle: 3,
            at: Duration::ZERO,
            last_at: Duration::ZERO,
            what: Text::verbatim("mode RTL"),
            count,
            state,
            explanation: None,
        })
    };
    drop(app.update(Event::from(foreign(RowState::Sent, 1))));
    assert_eq!(news(&app), Vec::<String>::new(), "it waits for the answer");
    drop(app.update(Event::from(foreign(RowState::Accepted, 1))));
    assert_eq!(news(&app), ["GCS 254/230: 3 mode RTL: accepted"]);
    drop(app.update(Event::from(foreign(RowState::Accepted, 2))));
    assert_eq!(news(&app), Vec::<String>::new(), "a repetition");
    let listed = commands::newest(app.state());
    assert_eq!(
        listed[0].to_string(),
        "GCS 254/230: 3 mode RTL: accepted, 2 times"
    );
}

#[test]
fn the_faults_of_each_link_stand_below_it() {
    let mut app = App::new(Setup::default());
    start(&mut app, Activity::Free, None);
    let link = |name: &str| LinkSummary {
        name: name.into(),
        up: true,
        ..LinkSummary::default()
    };
    let links = ["udpin:0.0.0.0:14550", "serial:/dev/ttyUSB0:57600"].map(link);
    drop(app.update(LinkEvent::Summaries(links.into())));
    // The findings come worst first.
    let found = [
        (1, Way::Serial, Cause::WrongBaud),
        (0, Way::UdpIn, Cause::Lossy(48)),
    ];
    let found = found.map(|(link, way, cause)| LinkFinding {
        link,
        way,
        cause,
        boards: Vec::new(),
    });
    drop(app.update(LinkEvent::Findings(found.into())));
    let printed: Vec<String> = links::now(app.state())
        .iter()
        .map(ToString::to_string)
        .collect();
    let starts = ["link 1, udpin:", "48 %", "", "link 2, serial:", "", ""];
    for (line, start) in printed.iter().zip(starts) {
        assert!(line.starts_with(start), "{printed:#?}");
    }
    assert!(printed[4].contains("baud"), "{printed:#?}");
    assert_eq!(printed.len(), starts.len());
}

#[test]
fn the_brief_names_only_lines_that_are_open() {
    let source = include_str!("../../../../missions/02-formation.toml");
    let mission = Mission::parse(source).expect("no faults");
    let brief = |crew: CrewPart, role: Option<Role>| {
        let mut app = App::new(Setup {
            crew,
            ..Setup::default()
        });
        if let Some(role) = role {
            let welcome = HostMessage::Welcome {
                protocol: VERSION,
                crew: "alpha".into(),
                host: "bohdan".into(),
                name: "anna".into(),
                role,
            };
            drop(app.update(CrewEvent::Said(welcome)));
        }
        let activity = Activity::Mission {
            id: mission.id.clone(),
            title: mission.title.clone(),
            stake: Stake::Practice,
        };
        start(&mut app, activity, Some(Box::new(mission.listing())));
        let lines = brief::lines(app.state());
        lines.iter().map(ToString::to_string).collect::<String>()
    };
    let member = |role| {
        let place = CrewPart::Member(Box::new(MemberPlace::new("alpha")));
        brief(place, Some(role))
    };
    let alone = brief(CrewPart::None, None);
    for line in ["`1 predict 800`", "`hint`", "`pause`", "`continue`"] {
        assert!(alone.contains(line), "{line}: {alone}");
    }
    let [pilot, observer] = [Role::Pilot, Role::Observer].map(member);
    assert!(pilot.contains("`objectives`") && pilot.contains("`hint`"));
    assert!(observer.contains("`objectives`") && !observer.contains("`hint`"));
    for line in ["predict", "goal", "`pause`", "`continue`"] {
        assert!(!pilot.contains(line), "{line}: {pilot}");
    }
}
