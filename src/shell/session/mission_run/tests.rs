//! Missions that start late, lose vehicles, and have a slow fleet.

use super::*;
use crate::app::event::{ProcessEvent, Started, VehicleEvent};
use crate::app::state::{Activity, Instance};
use crate::app::{App, Setup};
use crate::mission::Mission;
use crate::session::Want;
use crate::text;
use crate::vehicle::Vehicle;

const FORMATION: &str = include_str!("../../../../missions/02-formation.toml");

const STEPS_PER_S: u64 = 100;

const fn s(s: u64) -> Duration {
    Duration::from_secs(s)
}

/// A flight for three vehicles.
fn flight() -> Flight {
    Flight::new(Mission::parse(FORMATION).expect("it is good").into(), 1)
}

struct Console(App);

impl Console {
    /// A session that hears the vehicles `heard`, with this number of simulator processes, if any.
    fn start(processes: Option<usize>, heard: &[u8]) -> Self {
        let mut console = Self(App::new(Setup::default()));
        console.hear(SessionEvent::Started(Box::new(Started {
            activity: Activity::Free,
            mission: None,
            places: [].into(),
            areas: Vec::new(),
            processes,
            speedup: 1.0,
            is_again: false,
        })));
        for &id in heard {
            console.hear(VehicleEvent::Telemetry(Vehicle::new(id, 1).into()));
        }
        console
    }

    fn hear(&mut self, event: impl Into<Event>) {
        // There is no terminal that could ring.
        let _effects = self.0.update(event);
    }

    fn session(&self) -> &FlightView {
        self.0.state().session()
    }
}

/// The view of a session that hears these vehicles and has no processes.
fn shown(heard: &[u8]) -> FlightView {
    Console::start(None, heard).session().clone()
}

fn instance(vehicle: VehicleId, stage: SitlStage) -> Instance {
    Instance {
        vehicle,
        host: None,
        stage,
        parameters: [0, 0],
        pid: None,
        restarts: 0,
        memory_bytes: 0,
        processor_percent: None,
        fault: None,
        hint: None,
        output: Vec::new(),
        folder: String::new(),
    }
}

fn lost(events: &[Event]) -> Vec<VehicleId> {
    let gone = |event: &Event| match event {
        Event::Notice(notice) if notice.text == text!("mission-vehicle-gone") => notice.vehicle,
        _ => None,
    };
    events.iter().filter_map(gone).collect()
}

#[test]
fn a_mission_begins_when_its_vehicles_are_heard_so_that_each_has_its_own_seat() {
    let (passed, steps) = watch::channel(0);
    let mut run = MissionRun::embedded(flight(), steps);
    let fly = |run: &mut MissionRun, simulated_s: u64, heard: &[u8]| {
        passed.send_replace(simulated_s * STEPS_PER_S);
        run.fly(s(1), &shown(heard));
    };
    fly(&mut run, 5, &[2]);
    fly(&mut run, 7, &[2, 3]);
    assert_eq!(run.driver.flight().progress().elapsed, Duration::ZERO);
    fly(&mut run, 8, &[1, 2, 3]);
    fly(&mut run, 10, &[1, 2, 3]);
    assert_eq!(run.driver.flight().progress().elapsed, s(2));
    let progress = run.driver.flight().progress();
    let seats: Vec<VehicleId> = progress.readings.iter().map(|it| it.vehicle).collect();
    assert!(seats.is_sorted(), "{seats:?}");
}

#[test]
fn a_vehicle_that_is_never_heard_does_not_hold_a_mission_up_for_ever() {
    let (passed, steps) = watch::channel(0);
    let mut run = MissionRun::embedded(flight(), steps);
    let fly = |run: &mut MissionRun, simulated_s: u64| {
        passed.send_replace(simulated_s * STEPS_PER_S);
        run.fly(s(1), &shown(&[1, 2]));
    };
    fly(&mut run, 5);
    fly(&mut run, 14);
    assert_eq!(run.driver.flight().progress().elapsed, Duration::ZERO);
    fly(&mut run, 15);
    fly(&mut run, 16);
    assert_eq!(run.driver.flight().progress().elapsed, s(1));
}

#[test]
fn a_mission_stands_still_with_its_simulator_while_the_program_s_clock_goes_on() {
    let (passed, steps) = watch::channel(0);
    let mut run = MissionRun::embedded(flight(), steps);
    run.fly(s(1), &shown(&[1, 2, 3]));
    passed.send_replace(3 * STEPS_PER_S);
    run.fly(s(4), &shown(&[1, 2, 3]));
    run.fly(s(60), &shown(&[1, 2, 3]));
    assert_eq!(run.driver.flight().progress().elapsed, s(3));
}

#[test]
fn a_vehicle_whose_process_has_ended_is_lost_to_the_mission_once() {
    let mut run = MissionRun::of_processes(flight(), 1.0);
    let mut console = Console::start(Some(3), &[1, 2, 3]);
    let mut instances: Vec<Instance> = (1..=3).map(|id| instance(id, SitlStage::Ready)).collect();
    console.hear(ProcessEvent::Instances(instances.clone()));
    assert!(lost(&run.fly(s(1), console.session())).is_empty());
    instances[1] = instance(2, SitlStage::Ended);
    console.hear(ProcessEvent::Instances(instances));
    assert_eq!(lost(&run.fly(s(2), console.session())), [2]);
    assert!(lost(&run.fly(s(3), console.session())).is_empty());
}

fn demand(vehicle: VehicleId, value: f64) -> Demand {
    let want = Want::Parameter {
        name: "SIM_WIND_SPD",
        value,
    };
    Demand { vehicle, want }
}

#[test]
fn a_demand_that_cannot_be_told_stays_before_the_newer_ones() {
    let all = [
        demand(1, 1.0),
        demand(9, 2.0),
        demand(1, 3.0),
        demand(2, 4.0),
    ];
    let mut wanted = VecDeque::from(all.clone());
    let mut told = Vec::new();
    let is_heard = |vehicle| vehicle != 9;
    // The fleet accepts one more, then none.
    tell_demands(&mut wanted, is_heard, |demand| {
        let has_room = told.is_empty();
        told.extend(has_room.then(|| demand.clone()));
        has_room
    });
    assert_eq!(
        (told.as_slice(), wanted.make_contiguous()),
        (&all[..1], &mut all.clone()[1..])
    );
    tell_demands(&mut wanted, is_heard, |demand| {
        told.push(demand.clone());
        true
    });
    let [first, silent, third, last] = all;
    assert_eq!(told, [first, third, last]);
    assert_eq!(wanted, [silent]);
}
