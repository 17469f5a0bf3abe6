use std::collections::BTreeMap;
use std::sync::Arc;

use super::*;
use crate::language::{Findings, OfferedModes};
use crate::ledger::{Given, Ledger, Risk, RowState, RowUpdate};
use crate::vehicle::{
    AnnouncedMode, Heartbeat, LandedState, Mode, SystemStatus, Vehicle, VehicleClass, Vehicles,
};

const SCRIPT: &str = "# up and away
all guided
all arm

wait all armed timeout 5s   # or not
1 goto n 10 e 0
wait 1 arrived
wait 2s
all rtl
";

fn swarm(armed: bool) -> Vehicles {
    [1, 2]
        .into_iter()
        .map(|id| {
            let class = VehicleClass::Copter;
            let mut vehicle = Vehicle::new(id, 1);
            vehicle.heartbeat = Some(Heartbeat {
                mav_type: 2,
                autopilot: 3,
                class,
                mode: Mode { class, number: 4 },
                armed,
                status: SystemStatus::Standby,
                at: Duration::ZERO,
            });
            (vehicle.id, vehicle.into())
        })
        .collect()
}

fn pilot(source: &str) -> Pilot {
    Pilot::new(Script::parse(source, &Context::default()).expect("a good script"))
}

/// A pilot's actions without a mission.
fn step(pilot: &mut Pilot, seconds: f64, vehicles: &Vehicles, ledger: &Ledger) -> Vec<PilotEvent> {
    let findings = Findings::default();
    let seen = Seen {
        vehicles,
        ledger,
        findings: &findings,
    };
    pilot.step(at(seconds), seen)
}

fn given<'a>(line: &'a str, verb: &'a str) -> Given<'a> {
    Given {
        line,
        verb: crate::language::verb(verb).expect(verb),
        risk: Risk::None,
        by: None,
    }
}

fn lines(events: &[PilotEvent]) -> Vec<String> {
    events
        .iter()
        .map(|event| match event {
            PilotEvent::Do(statement) => statement.line.clone(),
            PilotEvent::WaitTimedOut { line, text } => format!("line {line} timed out: {text}"),
            PilotEvent::Finished => "finished".to_owned(),
        })
        .collect()
}

fn at(seconds: f64) -> Duration {
    Duration::from_secs_f64(seconds)
}

#[test]
fn a_script_runs_from_wait_to_wait() {
    let mut pilot = pilot(SCRIPT);
    let mut ledger = Ledger::new();
    let (idle, armed) = (swarm(false), swarm(true));
    let mut step =
        |seconds, vehicles, ledger: &Ledger| lines(&step(&mut pilot, seconds, vehicles, ledger));
    assert_eq!(step(1.0, &idle, &ledger), ["all guided", "all arm"]);
    assert_eq!(step(2.0, &idle, &ledger), [""; 0]);
    assert_eq!(step(3.0, &armed, &ledger), ["1 goto n 10 e 0"]);
    let entry = ledger.open(at(3.0), given("1 goto n 10 e 0", "goto"), &[1]);
    assert_eq!(step(4.0, &armed, &ledger), [""; 0]);
    ledger.apply(&RowUpdate {
        entry,
        vehicle: 1,
        state: RowState::Done,
        tries: 1,
        at: at(9.0),
        explanation: None,
    });
    assert_eq!(step(9.0, &armed, &ledger), [""; 0]);
    assert_eq!(step(10.9, &armed, &ledger), [""; 0]);
    assert_eq!(step(11.0, &armed, &ledger), ["all rtl", "finished"]);
    assert_eq!(step(12.0, &armed, &ledger), [""; 0]);
}

#[test]
fn a_wait_that_never_comes_true_times_out_and_the_script_goes_on() {
    let mut pilot = pilot("wait all armed timeout 5s\nall rtl\nwait all landed");
    let (ledger, idle) = (Ledger::new(), swarm(false));
    assert!(step(&mut pilot, 0.0, &idle, &ledger).is_empty());
    assert!(step(&mut pilot, 4.9, &idle, &ledger).is_empty());
    assert_eq!(
        lines(&step(&mut pilot, 5.0, &idle, &ledger)),
        ["line 1 timed out: wait all armed timeout 5s", "all rtl"]
    );
    // The rtl is not in the ledger yet at the end of its own step; at the next step, the vehicles are on the ground.
    assert_eq!(lines(&step(&mut pilot, 5.1, &idle, &ledger)), ["finished"]);
}

#[test]
fn a_condition_holds_only_when_it_does_for_every_vehicle_there_is() {
    let ledger = Ledger::new();
    let mut mixed = swarm(true);
    mixed.insert(3, Vehicle::new(3, 1).into());
    for (line, met) in [
        ("wait all armed", false),
        ("wait 1-2 armed", true),
        ("wait 1,9 armed", false),
        ("wait 1 mode guided", true),
        ("wait 1 mode 4", true),
        ("wait 1 mode LOITER", false),
        ("wait 3 disarmed", false),
        ("wait 1 altitude < 1", false),
    ] {
        assert_eq!(
            step(&mut pilot(line), 0.0, &mixed, &ledger).len(),
            usize::from(met),
            "{line}"
        );
    }
    assert!(step(&mut pilot("wait all armed"), 0.0, &BTreeMap::new(), &ledger).is_empty());
}

#[test]
fn a_mode_that_the_vehicle_has_announced_can_be_waited_for() {
    let mut own = Vehicle::new(1, 1);
    own.heartbeat = swarm(true)[&1].heartbeat;
    if let Some(heartbeat) = &mut own.heartbeat {
        heartbeat.mode.number = 65;
    }
    for (index, number, name) in [(1, 65, "LAWN_MOWER"), (2, 66, "HIDE")] {
        let mode = AnnouncedMode {
            index,
            number,
            name: name.to_owned(),
            is_selectable: true,
        };
        own.modes.add(mode, 2);
    }
    let modes = OfferedModes::of(std::iter::once(&own));
    let context = Context {
        modes: modes.as_ref(),
        ..Context::default()
    };
    let vehicles = Vehicles::from([(1, own.into())]);
    for (line, met) in [
        ("wait 1 mode LAWN_MOWER", true),
        ("wait all mode lawnmower", true),
        ("wait 1 mode HIDE", false),
    ] {
        let mut pilot = Pilot::new(Script::parse(line, &context).expect(line));
        let steps = step(&mut pilot, 0.0, &vehicles, &Ledger::new());
        assert_eq!(steps.len(), usize::from(met), "{line}");
    }
}

#[test]
fn nobody_has_arrived_while_the_order_is_on_its_way() {
    let mut ledger = Ledger::new();
    let entry = ledger.open(at(0.0), given("all land", "land"), &[1, 2]);
    ledger.open(at(1.0), given("all yaw 90", "yaw"), &[1, 2]);
    let mut pilot = pilot("wait all arrived");
    let idle = swarm(false);
    assert!(step(&mut pilot, 1.0, &idle, &ledger).is_empty());
    for vehicle in [1, 2] {
        ledger.apply(&RowUpdate {
            entry,
            vehicle,
            state: RowState::Done,
            tries: 1,
            at: at(2.0),
            explanation: None,
        });
    }
    assert_eq!(lines(&step(&mut pilot, 2.0, &idle, &ledger)), ["finished"]);
}

#[test]
fn a_vehicle_with_a_newer_movement_has_arrived_when_that_is_done() {
    for (line, verb) in [
        ("1 orbit 30", "orbit"),
        ("1 velocity n 1 for 5s", "velocity"),
        ("1 hold", "hold"),
        ("1 guided", "mode"),
    ] {
        let mut ledger = Ledger::new();
        let goto = ledger.open(at(0.0), given("1 goto n 10 e 0", "goto"), &[1]);
        let newer = ledger.open(at(1.0), given(line, verb), &[1]);
        let mut ends = |entry, state, seconds| {
            ledger.apply(&RowUpdate {
                entry,
                vehicle: 1,
                state,
                tries: 1,
                at: at(seconds),
                explanation: None,
            });
            ledger.clone()
        };
        let (mut pilot, flying) = (pilot("wait 1 arrived"), swarm(true));
        let before = ends(goto, RowState::Done, 1.0);
        assert!(step(&mut pilot, 1.0, &flying, &before).is_empty(), "{line}");
        let after = ends(newer, RowState::Done, 2.0);
        let said = lines(&step(&mut pilot, 2.0, &flying, &after));
        assert_eq!(said, ["finished"], "{line}");
    }
}

#[test]
fn whoever_is_to_come_down_by_mode_has_arrived_on_the_ground() {
    let mut ledger = Ledger::new();
    let entry = ledger.open(at(0.0), given("1 mode rtl", "mode"), &[1]);
    ledger.apply(&RowUpdate {
        entry,
        vehicle: 1,
        state: RowState::Done,
        tries: 1,
        at: at(1.0),
        explanation: None,
    });
    let mut flying = swarm(true);
    let vehicle = Arc::make_mut(flying.get_mut(&1).expect("it is there"));
    let class = VehicleClass::Copter;
    let mode = class.mode("RTL").expect("copters have it");
    vehicle.heartbeat = vehicle.heartbeat.map(|beat| Heartbeat { mode, ..beat });
    vehicle.landed = LandedState::InAir;
    let mut pilot = pilot("wait 1 arrived");
    assert!(step(&mut pilot, 1.0, &flying, &ledger).is_empty());
    if let Some(vehicle) = flying.get_mut(&1) {
        Arc::make_mut(vehicle).landed = LandedState::OnGround;
    }
    assert_eq!(
        lines(&step(&mut pilot, 2.0, &flying, &ledger)),
        ["finished"]
    );
}

#[test]
fn every_fault_is_reported_where_it_is_in_the_source() {
    let source = "all guided\r\nall takeof 20\n\n  arm\n# fine\nwait 5s\n@red arm\nall takeoff 20";
    let faults = Script::parse(source, &Context::default()).expect_err("three faults");
    let found: Vec<(&str, (usize, usize))> = faults
        .iter()
        .map(|fault| (&source[fault.span.clone()], fault.line_column(source)))
        .collect();
    assert_eq!(
        found,
        [("takeof", (2, 5)), ("arm", (4, 3)), ("@red", (7, 1))]
    );
    let help = faults[1].help.as_ref().map(ToString::to_string);
    assert_eq!(help.as_deref(), Some("name the vehicles, as in `all arm`"));
}

#[test]
fn a_script_waits_for_what_sensors_have_found() {
    let (ledger, swarm) = (Ledger::new(), swarm(true));
    let findings = Findings {
        contacts: 3,
        readings: BTreeMap::from([(1, 20.5), (2, 4.0)]),
        alerts: vec![Some(2), None],
    };
    for (line, met) in [
        ("wait contacts >= 3", true),
        ("wait 1 contacts > 3", false),
        ("wait 1 reading > 20", true),
        ("wait 2 reading > 20", false),
        ("wait all reading > 3.9 timeout 2min", true),
        ("wait 3 reading < 1", false),
        ("wait alerts >= 2", true),
        ("wait alerts > 2", false),
        ("wait 2 alerted", true),
        ("wait 1-2 alerted", false),
    ] {
        let seen = Seen {
            vehicles: &swarm,
            ledger: &ledger,
            findings: &findings,
        };
        let events = pilot(line).step(at(0.0), seen);
        assert_eq!(events.len(), usize::from(met), "{line}");
    }
}

#[test]
fn a_line_with_a_condition_is_left_out_unless_it_holds() {
    let (ledger, swarm) = (Ledger::new(), swarm(true));
    let findings = Findings {
        alerts: vec![Some(2)],
        ..Findings::default()
    };
    let seen = Seen {
        vehicles: &swarm,
        ledger: &ledger,
        findings: &findings,
    };
    let source =
        "if 1 alerted then 1 land\nif 2 alerted then 2 land\nif alerts >= 1 then all rtl\n";
    let mut pilot = pilot(source);
    let mut lines = Vec::new();
    for tenth in 0..4 {
        let events = pilot.step(at(f64::from(tenth) / 10.0), seen);
        lines.extend(events.into_iter().filter_map(|event| match event {
            PilotEvent::Do(statement) => Some(statement.line),
            PilotEvent::WaitTimedOut { .. } | PilotEvent::Finished => None,
        }));
    }
    assert_eq!(lines, ["2 land", "all rtl"]);
}

#[test]
fn a_condition_is_judged_once_before_a_wait() {
    let (ledger, findings) = (Ledger::new(), Findings::default());
    let mut pilot = pilot("if all armed then wait all disarmed timeout 20s\nall land\n");
    let mut done = |armed: bool, s: f64| {
        let swarm = swarm(armed);
        let seen = Seen {
            vehicles: &swarm,
            ledger: &ledger,
            findings: &findings,
        };
        let events = pilot.step(at(s), seen);
        events
            .iter()
            .filter(|it| matches!(it, PilotEvent::Do(_)))
            .count()
    };
    assert_eq!(
        (done(true, 0.0), done(true, 1.0), done(false, 2.0)),
        (0, 0, 1)
    );
}

#[test]
fn faults_of_a_condition_are_where_they_are_written() {
    let source =
        "if 1 alarmed then 1 rtl\nif 1 armed 1 rtl\nif 1 armed then 1 rtll\nif 5s then all rtl\n";
    let faults = Script::parse(source, &Context::default()).expect_err("four faults");
    let found: Vec<&str> = faults
        .iter()
        .map(|fault| source[fault.span.clone()].trim())
        .collect();
    assert_eq!(found, ["alarmed", "if", "rtll", "5s"]);
}
