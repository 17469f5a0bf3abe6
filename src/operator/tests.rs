//! Tests of lines, and of the work that follows from them.

use super::*;
use crate::commands::Setpoint;
use crate::geo::LatLon;
use crate::ledger::Ledger;
use crate::mission::{Flight, Mission, Stake};
use crate::pilot_in_command::Person;
use crate::vehicle::Vehicle;
use std::sync::Arc;

mod rehearsing;

const FLEET: [VehicleId; 3] = [1, 2, 3];

fn vehicles() -> Vehicles {
    FLEET
        .map(|id| (id, Vehicle::new(id as u8, 1).into()))
        .into()
}

fn read(line: &str) -> Result<Order, Diagnostic> {
    let context = Context {
        vehicles: &FLEET,
        ..Context::default()
    };
    read_order(line, &context, &[2])
}

/// The work for a line without a mission, with its entry.
fn said(operator: &mut Operator, line: &str) -> Vec<Dispatch> {
    let order = read(line).expect("a good line");
    let mut ledger = Ledger::new();
    let entry = ledger.open(Duration::ZERO, order.given(), &order.targets);
    let scene = OperatorScene {
        now: Duration::from_secs(7),
        vehicles: &vehicles(),
        flight: None,
        pilots: &PilotsInCommand::default(),
    };
    operator.carry_out(entry, &order, scene)
}

/// The work that is due at a time.
fn conducted(operator: &mut Operator, vehicles: &Vehicles, now: Duration) -> Vec<Dispatch> {
    operator.conduct(ConductorScene {
        now,
        vehicles,
        pilots: &PilotsInCommand::default(),
    })
}

fn steering(altitude_m: f64) -> Steering {
    Steering {
        verb: crate::language::verb("formation").expect("it is in the table"),
        setpoint: Setpoint {
            at_point: LatLon::new(50.0, 30.0),
            altitude_m,
            velocity_m_s: None,
        },
    }
}

#[test]
fn a_line_without_targets_is_for_the_selection() {
    let order = read("land").expect("a good line");
    assert_eq!((order.targets, order.line.as_str()), (vec![2], "2 land"));
}

#[test]
fn a_report_that_is_the_same_for_all_has_one_row() {
    for (line, targets) in [
        ("all mark contacts", vec![1]),
        ("all mark n 5 e 5 as mine", vec![1]),
        ("all mark as mine", vec![1, 2, 3]),
        ("all drop", vec![1, 2, 3]),
    ] {
        assert_eq!(read(line).expect(line).targets, targets, "{line}");
    }
}

#[test]
fn a_report_that_is_the_same_for_all_is_made_by_a_vehicle_that_its_giver_flies() {
    let context = Context {
        vehicles: &FLEET,
        ..Context::default()
    };
    let targets = |line: &str, own: &[VehicleId]| {
        let statement = language::parse(line, &context).expect(line);
        let order = order_of(statement, line, &context, &[], |id| own.contains(&id));
        order.expect(line).targets
    };
    assert_eq!(targets("all mark contacts", &[2, 3]), [2]);
    assert_eq!(targets("all mark contacts", &[]), [1]);
    assert_eq!(targets("all drop", &[3]), [1, 2, 3]);
}

#[test]
fn a_line_is_refused_where_its_first_word_is() {
    let groups = [("gone".to_owned(), vec![1, 9])].into();
    let context = Context {
        groups: &groups,
        vehicles: &FLEET,
        ..Context::default()
    };
    let missing = read_order("  @gone land", &context, &[]).expect_err("vehicle 9 is no more");
    assert_eq!(missing.message, text!("order-no-vehicle", vehicle = 9));
    assert_eq!(missing.span, 2..7);
}

#[test]
fn each_target_of_a_command_gets_it() {
    let work = said(&mut Operator::default(), "1,3 land");
    let vehicles = work.iter().map(|work| match work {
        Dispatch::Command(vehicle, command) => (*vehicle, command.verb.name),
        other => panic!("{other:?}"),
    });
    assert_eq!(vehicles.collect::<Vec<_>>(), [(1, "land"), (3, "land")]);
}

#[test]
fn without_a_mission_a_deed_is_refused_with_a_reason() {
    let work = said(&mut Operator::default(), "1-2 sample");
    let [
        Dispatch::Row(first),
        Dispatch::Row(second),
        Dispatch::Refused(reason),
    ] = &work[..]
    else {
        panic!("{work:?}");
    };
    for (row, vehicle) in [(first, 1), (second, 2)] {
        assert_eq!((row.vehicle, row.state), (vehicle, RowState::Refused));
        assert_eq!(row.at, Duration::from_secs(7));
    }
    let expected = vec!["1-2 sample".into(), text!("deed-no-mission")];
    assert_eq!(*reason, Text::joined(": ", expected));
}

#[test]
fn steering_that_is_not_delivered_comes_again_until_it_is_void() {
    let mut operator = Operator::default();
    for id in FLEET {
        operator.note_delivery(id, steering(f64::from(id)), false);
    }
    // Vehicle 2 has other orders by now.
    assert_eq!(said(&mut operator, "2 land").len(), 1);
    let work = conducted(&mut operator, &vehicles(), Duration::from_secs(8));
    assert_eq!(
        work,
        [1, 3].map(|id| Dispatch::Steer(id, steering(f64::from(id))))
    );
    operator.note_delivery(1, steering(1.0), true);
    operator.note_delivery(3, steering(3.0), false);
    let work = conducted(&mut operator, &vehicles(), Duration::from_secs(9));
    assert_eq!(work, [Dispatch::Steer(3, steering(3.0))]);
    operator.note_delivery(3, steering(3.0), true);
    assert!(conducted(&mut operator, &vehicles(), Duration::from_secs(10)).is_empty());
}

/// The states of the rows for `2 param set NAME 0` in a flight.
fn setting(name: &str, stake: Stake, rules: &str) -> Vec<RowState> {
    answered(&format!("2 param set {name} 0"), stake, rules)
}

/// The states of a line's rows in a flight; none if the line goes to the vehicle.
fn answered(line: &str, stake: Stake, rules: &str) -> Vec<RowState> {
    let source = include_str!("../../missions/00-first-flight.toml");
    let source = source.replacen("[rules]\n", &format!("[rules]\n{rules}\n"), 1);
    let mission = Mission::parse(&source).expect("no faults");
    let mut flight = Flight::new(Arc::new(mission), 1);
    flight.set_stake(stake);
    let order = read(line).expect("a good line");
    let mut ledger = Ledger::new();
    let entry = ledger.open(Duration::ZERO, order.given(), &order.targets);
    let scene = OperatorScene {
        now: Duration::ZERO,
        vehicles: &vehicles(),
        flight: Some(&mut flight),
        pilots: &PilotsInCommand::default(),
    };
    let work = Operator::default().carry_out(entry, &order, scene);
    let rows = work.into_iter().filter_map(|work| match work {
        Dispatch::Row(row) => Some(row.state),
        Dispatch::Command(..)
        | Dispatch::Steer(..)
        | Dispatch::Notice(_)
        | Dispatch::Rehearse(_)
        | Dispatch::Refused(_) => None,
    });
    rows.collect()
}

#[test]
fn a_flight_that_counts_keeps_the_world_and_the_safety_net_as_they_are() {
    for name in [
        "SIM_WIND_SPD",
        "sim_wind_spd",
        "BATT_CAPACITY",
        "FENCE_ENABLE",
        "FS_THR_ENABLE",
        "LAND_SPEED",
        "WPNAV_SPEED",
    ] {
        assert_eq!(
            setting(name, Stake::Graded, ""),
            [RowState::Refused],
            "{name}"
        );
        assert_eq!(
            setting(name, Stake::Exam, ""),
            [RowState::Refused],
            "{name}"
        );
        assert_eq!(setting(name, Stake::Practice, ""), [], "{name}");
    }
    let open = "parameters = ['SIM_WIND_SPD']";
    assert_eq!(setting("SIM_WIND_SPD", Stake::Graded, open), []);
    assert_eq!(
        setting("LAND_SPEED", Stake::Graded, open),
        [RowState::Refused]
    );
}

#[test]
fn a_flight_that_counts_keeps_its_home_and_takes_no_raw_commands() {
    let lines = [
        "2 home here",
        "2 home 50.45 30.52 180",
        "2 long MAV_CMD_DO_SET_HOME 1",
        "2 long MAV_CMD_DO_FENCE_ENABLE 0",
        "2 fence off",
    ];
    for line in lines {
        for stake in [Stake::Graded, Stake::Exam] {
            assert_eq!(answered(line, stake, ""), [RowState::Refused], "{line}");
        }
        assert_eq!(answered(line, Stake::Practice, ""), [], "{line}");
    }
    assert_eq!(answered("2 param get LAND_SPEED", Stake::Graded, ""), []);
}

#[test]
fn a_vehicle_that_somebody_else_flies_takes_no_part_and_says_who_flies_it() {
    let petro = Person::named("petro");
    let mut pilots = PilotsInCommand::default();
    pilots.take_over(&[2], &petro);
    let carry_out = |line: &str, by: Option<&Person>| {
        let order = Order {
            by: by.cloned(),
            ..read(line).expect("a good line")
        };
        let entry = Ledger::new().open(Duration::ZERO, order.given(), &order.targets);
        let scene = OperatorScene {
            now: Duration::ZERO,
            vehicles: &vehicles(),
            flight: None,
            pilots: &pilots,
        };
        let work = Operator::default().carry_out(entry, &order, scene);
        let commanded = work.iter().filter_map(|work| match work {
            Dispatch::Command(vehicle, _) => Some(*vehicle),
            _ => None,
        });
        let commanded: Vec<VehicleId> = commanded.collect();
        let refused = work.iter().filter_map(|work| match work {
            Dispatch::Row(row) if row.state == RowState::Barred => row.explanation.clone(),
            _ => None,
        });
        let refused: Vec<String> = refused.map(|it| it.to_string()).collect();
        (commanded, refused.join("; "))
    };
    let others: Vec<VehicleId> = FLEET.into_iter().filter(|&id| id != 2).collect();
    let (commanded, refused) = carry_out("all arm", None);
    assert_eq!((commanded, refused.as_str()), (others, "petro flies 2"));
    let (commanded, refused) = carry_out("2 rtl", Some(&petro));
    assert_eq!((commanded, refused.as_str()), (vec![2], ""));
    let (commanded, refused) = carry_out("1 rtl", Some(&petro));
    assert_eq!(
        (commanded, refused.as_str()),
        (vec![], "vehicle 1 is not taken over")
    );
    // Nor does it for questions that change what the vehicle sends, and for reports of what it sees.
    for line in ["2 interval GLOBAL_POSITION_INT 0", "2 mark"] {
        let (commanded, refused) = carry_out(line, None);
        assert_eq!(
            (commanded, refused.as_str()),
            (vec![], "petro flies 2"),
            "{line}"
        );
    }
    let (commanded, refused) = carry_out("2 request HOME_POSITION", None);
    assert_eq!((commanded, refused.as_str()), (vec![2], ""));
    // Joint manoeuvres go on without it.
    let (_, refused) = carry_out("all formation line spacing 10", None);
    assert!(refused.starts_with("petro flies 2"), "{refused}");
}
