//! Rehearsals: their wind, their fence, and their findings.

use super::*;
use crate::commands::{PlanCommand, PlanDeed, PlanSource};
use crate::parameters::{HeardParameter, ParameterEncoding, ParameterList, ParameterType};
use crate::plan::Item;
use crate::sim::Airframe;
use crate::vehicle::{GlobalPosition, Health, Plan, Stored, Transfer, Wind};

/// A vehicle on the ground whose plan leads to a place this far north, and back.
fn carrying(id: VehicleId, north_m: f64) -> Vehicle {
    let home = LatLon::new(50.45, 30.52).moved(0.0, 20.0 * f64::from(id));
    let item = |command, north_m, z| {
        let (x, y) = home.moved(north_m, 0.0).to_e7();
        Item {
            command,
            frame: 3,
            x,
            y,
            z,
            ..Item::default()
        }
    };
    let back = Item {
        command: 20,
        frame: 3,
        ..Item::default()
    };
    let way = [
        item(16, 0.0, 0.0),
        item(22, 0.0, 20.0),
        item(16, north_m, 20.0),
        back,
    ];
    let mut vehicle = Vehicle::new(id as u8, 1);
    vehicle.global = Some(GlobalPosition {
        at_point: home,
        altitude_amsl_m: 170.0,
        altitude_m: 0.0,
        north_m_s: 0.0,
        east_m_s: 0.0,
        down_m_s: 0.0,
        heading_deg: None,
        at: Duration::ZERO,
    });
    vehicle.plans.plan = Stored {
        content: Some(Arc::new(Plan {
            items: way.to_vec(),
            home_first: true,
        })),
        transfer: Transfer::Done,
    };
    vehicle
}

fn prepared(line: &str, vehicles: impl IntoIterator<Item = Vehicle>) -> PlanRehearsal {
    let order = read(line).expect("a good line");
    let vehicles = vehicles.into_iter();
    let scene = OperatorScene {
        now: Duration::ZERO,
        vehicles: &vehicles.map(|it| (it.id, it.into())).collect(),
        flight: None,
        pilots: &PilotsInCommand::default(),
    };
    let mut ledger = Ledger::new();
    let entry = ledger.open(Duration::ZERO, order.given(), &order.targets);
    let work = Operator::default().carry_out(entry, &order, scene);
    let mut rehearsals = work.into_iter().filter_map(|work| match work {
        Dispatch::Rehearse(rehearsal) => Some(rehearsal),
        _ => None,
    });
    rehearsals.next().expect("a rehearsal")
}

fn parameters(values: &[(&str, f32)]) -> Arc<ParameterList> {
    let mut list = ParameterList::default();
    for (index, (name, value)) in values.iter().enumerate() {
        list.note(&HeardParameter {
            name,
            value: f64::from(*value),
            kind: ParameterType::Real32,
            encoding: ParameterEncoding::Converted,
            index: Some(index as u16),
            count: values.len() as u16,
        });
    }
    Arc::new(list)
}

/// The first notice: the conditions.
fn conditions(rehearsal: &PlanRehearsal) -> String {
    rehearsal.fly(Duration::ZERO).notices[0].text.to_string()
}

fn rows(rehearsed: &Rehearsed) -> Vec<(RowState, String)> {
    let rows = rehearsed.rows.iter();
    let words = |row: &RowUpdate| row.explanation.as_ref().map(ToString::to_string);
    rows.map(|row| (row.state, words(row).unwrap_or_default()))
        .collect()
}

#[test]
fn the_wind_is_that_of_the_best_source_and_named() {
    let calm = prepared("1 plan rehearse", [carrying(1, 60.0)]);
    assert!(
        conditions(&calm).contains("parameters of 1 not read"),
        "{}",
        conditions(&calm)
    );
    assert!(
        conditions(&calm).contains("wind unknown"),
        "{}",
        conditions(&calm)
    );
    let mut simulated = calm.clone();
    let weather = [("SIM_WIND_SPD", 6.0), ("SIM_WIND_DIR", 90.0)];
    simulated.set_parameters(1, &parameters(&weather));
    let said = conditions(&simulated);
    assert!(
        said.contains("6.0 m/s from 90°") && said.contains("SIM_WIND_SPD"),
        "{said}"
    );
    let blown = |speed_m_s| Vehicle {
        wind: Some(Wind {
            from_deg: 180.0,
            speed_m_s,
        }),
        ..carrying(1, 60.0)
    };
    let mut estimated = prepared("1 plan rehearse", [blown(4.0)]);
    estimated.set_parameters(1, &parameters(&weather));
    let said = conditions(&estimated);
    assert!(
        said.contains("4.0 m/s from 180°") && said.contains("estimated by 1"),
        "{said}"
    );
    let no_estimate = prepared("1 plan rehearse", [blown(0.0)]);
    assert!(conditions(&no_estimate).contains("unknown"));
    let given = prepared("1 plan rehearse wind 270 8", [blown(4.0)]);
    let said = conditions(&given);
    assert!(said.contains("8.0 m/s from 270° (given)"), "{said}");
}

/// The wind of a flight at 20 m depends on the height at which the given speed is reached.
#[test]
fn the_profile_of_the_wind_is_that_of_the_vehicle_and_of_the_estimate() {
    let used = |rehearsal: &PlanRehearsal| {
        let outcome = rehearsal.outcome().expect("it can fly");
        outcome.vehicles[0].energy_used_percent
    };
    let blown = |parameter: f32| {
        let mut rehearsal = prepared("1 plan rehearse wind 0 9", [carrying(1, 600.0)]);
        rehearsal.set_parameters(1, &parameters(&[("SIM_WIND_T_ALT", parameter)]));
        used(&rehearsal)
    };
    assert!(
        blown(10.0) > blown(60.0) + 0.5,
        "{} {}",
        blown(10.0),
        blown(60.0)
    );
    let usual = prepared("1 plan rehearse wind 0 9", [carrying(1, 600.0)]);
    assert!((used(&usual) - blown(60.0)).abs() < 0.1);
    // Estimated at 20 m, the wind is 9 m/s there; without a height, it is 9 m/s everywhere.
    let estimated = |height_m| {
        let vehicle = Vehicle {
            wind: Some(Wind {
                from_deg: 0.0,
                speed_m_s: 9.0,
            }),
            wind_height_m: height_m,
            ..carrying(1, 600.0)
        };
        prepared("1 plan rehearse", [vehicle])
    };
    let full = blown(20.0);
    for height_m in [Some(20.0), None] {
        let found = used(&estimated(height_m));
        assert!((found - full).abs() < 0.5, "{height_m:?}: {found} {full}");
    }
    let said = conditions(&estimated(Some(20.0)));
    assert!(said.contains("9.0 m/s from 0° at 20 m"), "{said}");
}

#[test]
fn wind_and_airframe_change_what_is_used() {
    let used = |rehearsal: &PlanRehearsal| {
        let (state, words) = rows(&rehearsal.fly(Duration::ZERO)).remove(0);
        assert_eq!(state, RowState::Done, "{words}");
        let used = words.split("uses ").nth(1).expect("how much");
        used.split(' ')
            .next()
            .expect("a number")
            .parse::<f64>()
            .expect("a number")
    };
    let calm = prepared("1 plan rehearse", [carrying(1, 600.0)]);
    let windy = prepared("1 plan rehearse wind 0 9", [carrying(1, 600.0)]);
    assert!(
        used(&windy) > used(&calm),
        "{} {}",
        used(&windy),
        used(&calm)
    );
    let mut heavy = calm.clone();
    heavy.set_airframes(&[Airframe::shared_default()]);
    assert!(conditions(&calm).contains("standard airframe"));
    assert!(conditions(&heavy).contains("session's drones"));
}

#[test]
fn a_fence_that_was_switched_on_after_its_parameter_was_read_counts() {
    let read = parameters(&[
        ("FENCE_ENABLE", 0.0),
        ("FENCE_TYPE", 2.0),
        ("FENCE_RADIUS", 60.0),
        ("FENCE_ACTION", 1.0),
    ]);
    let rehearsed = |enabled| {
        let mut vehicle = carrying(1, 120.0);
        vehicle.health = Some(Health {
            present: Health::FENCE,
            enabled,
            healthy: Health::FENCE,
            load_percent: 0.0,
            at: Duration::ZERO,
        });
        let mut rehearsal = prepared("1 plan rehearse", [vehicle]);
        rehearsal.set_parameters(1, &read);
        rehearsal.fly(Duration::ZERO)
    };
    assert_eq!(rows(&rehearsed(0))[0].0, RowState::Done);
    let broken = rehearsed(Health::FENCE);
    let (state, words) = rows(&broken).remove(0);
    assert_eq!(state, RowState::NoEffect);
    assert!(words.contains("fence"), "{words}");
    assert!(!broken.notices[0].text.to_string().contains("not read"));
    let [failed] = &broken.findings.failed[..] else {
        panic!("{:?}", broken.findings)
    };
    assert_eq!((failed.vehicle, broken.findings.passed.len()), (1, 0));
}

#[test]
fn only_the_known_limits_of_a_fence_count() {
    let rehearsed = |read: &[(&str, f32)]| {
        let mut vehicle = carrying(1, 300.0);
        vehicle.health = Some(Health {
            present: Health::FENCE,
            enabled: Health::FENCE,
            healthy: Health::FENCE,
            load_percent: 0.0,
            at: Duration::ZERO,
        });
        let mut rehearsal = prepared("1 plan rehearse", [vehicle]);
        rehearsal.set_parameters(1, &parameters(read));
        rows(&rehearsal.fly(Duration::ZERO)).remove(0).0
    };
    assert_eq!(rehearsed(&[]), RowState::Done);
    assert_eq!(rehearsed(&[("FENCE_TYPE", 2.0)]), RowState::Done);
    let circle = [("FENCE_TYPE", 2.0), ("FENCE_RADIUS", 100.0)];
    assert_eq!(rehearsed(&circle), RowState::NoEffect);
}

/// The states of the rows among some work, and the number of rehearsals.
fn told(work: &[Dispatch]) -> (Vec<RowState>, usize) {
    let rows = work.iter().filter_map(|work| match work {
        Dispatch::Row(row) => Some(row.state),
        _ => None,
    });
    let is_rehearsal = |work: &&Dispatch| matches!(work, Dispatch::Rehearse(_));
    (rows.collect(), work.iter().filter(is_rehearsal).count())
}

#[test]
fn a_rehearsal_waits_for_plans_that_are_being_read() {
    let read = [carrying(1, 60.0), carrying(2, 60.0)];
    let mut unread = read.clone();
    unread[1].plans.plan = Stored::default();
    let swarm = |of: &[Vehicle]| -> Vehicles {
        let vehicles = of.iter().cloned();
        vehicles.map(|it| (it.id, it.into())).collect()
    };
    let mut operator = Operator::default();
    let order = super::read("1-2 plan rehearse").expect("a good line");
    let mut give = |entry, vehicles: &Vehicles| {
        let scene = OperatorScene {
            now: Duration::ZERO,
            vehicles,
            flight: None,
            pilots: &PilotsInCommand::default(),
        };
        operator.carry_out(EntryId(entry), &order, scene)
    };
    let waits = give(1, &swarm(&unread));
    assert_eq!(told(&waits), (vec![RowState::Queued; 2], 0));
    let _ = give(2, &swarm(&unread));
    let s = Duration::from_secs;
    assert_eq!(told(&conducted(&mut operator, &swarm(&unread), s(5))).1, 0);
    let begun = conducted(&mut operator, &swarm(&read), s(6));
    assert_eq!(told(&begun), (vec![RowState::InProgress(0); 4], 2));
    // A plan that never arrives is refused after a minute.
    let mut operator = Operator::default();
    let scene = OperatorScene {
        now: Duration::ZERO,
        vehicles: &swarm(&unread),
        flight: None,
        pilots: &PilotsInCommand::default(),
    };
    let _ = operator.carry_out(EntryId(3), &order, scene);
    assert_eq!(told(&conducted(&mut operator, &swarm(&unread), s(59))).1, 0);
    let (rows, flown) = told(&conducted(&mut operator, &swarm(&unread), s(60)));
    assert_eq!(
        (rows.as_slice(), flown),
        (&[RowState::InProgress(0), RowState::Refused][..], 1)
    );
}

/// The plan on board is the old one until the upload has ended.
#[test]
fn a_rehearsal_waits_for_the_end_of_an_upload() {
    let vehicles: Vehicles = [(1, carrying(1, 60.0).into())].into();
    let mut operator = Operator::default();
    let give = |operator: &mut Operator, entry, line: &str| {
        let scene = OperatorScene {
            now: Duration::ZERO,
            vehicles: &vehicles,
            flight: None,
            pilots: &PilotsInCommand::default(),
        };
        let order = super::read(line).expect("a good line");
        operator.carry_out(EntryId(entry), &order, scene)
    };
    let _ = give(&mut operator, 1, "1 plan upload a.plan");
    let waits = give(&mut operator, 2, "1 plan rehearse");
    assert_eq!(told(&waits), (vec![RowState::Queued], 0));
    let s = Duration::from_secs;
    assert_eq!(told(&conducted(&mut operator, &vehicles, s(100))).1, 0);
    operator.note_row(&RowUpdate {
        entry: EntryId(1),
        vehicle: 1,
        state: RowState::Done,
        tries: 1,
        at: s(100),
        explanation: None,
    });
    assert_eq!(told(&conducted(&mut operator, &vehicles, s(101))).1, 0);
    assert_eq!(told(&conducted(&mut operator, &vehicles, s(102))).1, 1);
    let at_once = give(&mut operator, 3, "1 plan rehearse");
    assert_eq!(told(&at_once).1, 1);
}

/// A task for fewer vehicles leaves earlier plans on the vehicles that have no part in it: the row
/// and a notice say so.
#[test]
fn smaller_work_names_the_vehicles_that_keep_an_old_plan() {
    let vehicles: Vehicles = [1, 2, 3].map(|id| (id, carrying(id, 60.0).into())).into();
    let mut operator = Operator::default();
    let mut give = |entry, line: &str| {
        let scene = OperatorScene {
            now: Duration::ZERO,
            vehicles: &vehicles,
            flight: None,
            pilots: &PilotsInCommand::default(),
        };
        let order = super::read(line).expect("a good line");
        operator.carry_out(EntryId(entry), &order, scene)
    };
    let told = |work: &[Dispatch]| -> (Vec<String>, Vec<String>) {
        let notices = work.iter().filter_map(|work| match work {
            Dispatch::Notice(notice) => Some(notice.text.to_string()),
            _ => None,
        });
        let remarks = work.iter().filter_map(|work| match work {
            Dispatch::Command(_, command) => match &command.command {
                Command::Plan(PlanCommand {
                    deed:
                        PlanDeed::Upload {
                            source:
                                PlanSource::Document {
                                    remark: Some(remark),
                                    ..
                                },
                        },
                    ..
                }) => Some(remark.to_string()),
                _ => None,
            },
            _ => None,
        });
        (notices.collect(), remarks.collect())
    };
    let small = "all plan search square around 50.4515 30.5206 radius 20";
    let (notices, remarks) = told(&give(0, small));
    assert_eq!(remarks.len(), 1, "{remarks:?}");
    assert!(
        remarks[0].starts_with("parts for 1 of 3: no part for"),
        "{remarks:?}"
    );
    assert_eq!(notices.len(), 2, "one for each without a part: {notices:?}");
    let nothing = (Vec::new(), Vec::new());
    let area = "search square around 50.4515 30.5206 radius 200";
    assert_eq!(told(&give(1, &format!("all plan {area}"))), nothing);
    let (notices, remarks) = told(&give(2, &format!("1 plan {area}")));
    assert!(notices[0].contains("`2-3 plan clear`"), "{notices:?}");
    assert_eq!(notices, remarks);
    let _ = give(3, "2-3 plan clear");
    assert_eq!(told(&give(4, &format!("1 plan {area}"))), nothing);
}
