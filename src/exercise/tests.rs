//! The same mission in lock step and on a byte stream.

use std::sync::Arc;

use super::*;
use crate::language::Context;
use crate::ledger::{LedgerRow, RowState};
use crate::mission::Mission;
use crate::mission::record::{Occasion, Stored, WithoutEnd};
use crate::scoring::{EventKind, FlightBackend};
use crate::sim::{PortId, STEP, World};
use crate::text;
use crate::workshop::Design;

mod giving_way;
mod gold;
mod plans;

const MISSION: &str = include_str!("../../missions/01-air-sample.toml");
const PILOT: &str = include_str!("../../missions/pilots/01-air-sample.pilot");

fn mission() -> (Arc<Mission>, Script) {
    mission_with("")
}

/// The first mission with additional sections.
fn mission_with(more: &str) -> (Arc<Mission>, Script) {
    let mission = Arc::new(Mission::parse(&format!("{MISSION}\n{more}")).expect("no faults"));
    let places = mission.places();
    let context = Context {
        places: Some(&places),
        vehicles: &[1],
        ..Context::default()
    };
    let script = Script::parse(PILOT, &context).expect("no faults");
    (mission, script)
}

/// The embedded simulator as a process that runs on its own.
struct Process {
    world: World,
    port: PortId,
    live: Exercise<LiveStreams>,
    /// Seconds of program time per simulated second.
    pace: f64,
}

impl Process {
    fn new(speedup: f64) -> Self {
        Self::flying(mission(), speedup)
    }

    fn flying((mission, script): (Arc<Mission>, Script), speedup: f64) -> Self {
        let mut world = World::new(&mission.world(1));
        Self {
            port: world.connect(0),
            world,
            live: Exercise::live(mission, 1, script, speedup),
            pace: 1.0 / speedup,
        }
    }

    fn now(&self) -> Duration {
        self.world.now().mul_f64(self.pace)
    }

    /// Lets the simulator run for a time without a listener.
    fn run(&mut self, time: Duration) -> Vec<u8> {
        let until = self.world.now() + time;
        while self.world.now() < until {
            self.world.step();
        }
        let mut bytes = Vec::new();
        self.world.take_output(self.port, &mut bytes);
        bytes
    }

    /// Exchanges bytes at intervals of simulated time, until the end or a limit.
    fn fly(&mut self, every: Duration, most: Duration) {
        while !self.live.is_over() && self.world.now() < most {
            let bytes = self.run(every);
            let now = self.now();
            self.live.hear(0, &bytes, now);
            self.live.pass(now);
            let bytes = self.live.take_output(0);
            self.world.receive(self.port, &bytes);
        }
    }
}

fn in_lock_step() -> MissionReport {
    let (mission, script) = mission();
    let mut exercise = Exercise::new(mission, 1, script, Vec::new());
    while !exercise.is_over() {
        exercise.step();
    }
    exercise.report()
}

const HOUR: Duration = Duration::from_secs(3600);

#[test]
fn a_live_flight_scores_as_the_one_in_lock_step() {
    let expected = in_lock_step();
    assert!(expected.passed);
    for (speedup, every) in [(1.0, STEP * 4), (20.0, STEP * 40), (20.0, STEP * 80)] {
        let mut process = Process::new(speedup);
        process.fly(every, HOUR);
        let report = process.live.report();
        assert!(report.passed, "{speedup} {every:?}");
        let (score, wanted) = (i32::from(report.score), i32::from(expected.score));
        assert!((score - wanted).abs() <= 20, "{score} instead of {wanted}");
        let late = report.sim_time_s - expected.sim_time_s;
        assert!((-5.0..15.0).contains(&late), "{late} s at {every:?}");
        assert!(
            report
                .ledger
                .iter()
                .flat_map(|entry| &entry.rows)
                .all(|row| !row.state.is_failure())
        );
    }
}

#[test]
fn a_mission_waits_for_its_vehicle_to_be_heard() {
    let mut process = Process::new(10.0);
    for second in 0..9 {
        process.live.pass(Duration::from_secs(second));
        assert_eq!(process.live.now(), Duration::ZERO);
    }
    process.live.pass(Duration::from_secs(30));
    process.live.pass(Duration::from_secs(31));
    process.live.pass(Duration::from_secs(34));
    assert!(process.live.now() > Duration::ZERO, "but not for ever");
}

#[test]
fn a_mission_ends_when_its_last_vehicle_is_no_more() {
    let mut process = Process::new(10.0);
    process.fly(STEP * 40, Duration::from_secs(60));
    assert!(!process.live.is_over());
    process.live.take_notices();
    assert!(process.live.lose(0));
    assert!(!process.live.lose(0), "it was lost already");
    for step in 0..50 {
        let now = process.now() + Duration::from_millis(100) * step;
        process.live.pass(now);
    }
    assert!(process.live.is_over());
    let report = process.live.report();
    assert!(!report.passed);
    let said = report
        .events
        .iter()
        .filter(|event| event.kind == EventKind::Alert);
    let said: Vec<String> = said.map(|event| event.text.to_string()).collect();
    assert_eq!(said, ["its simulator has ended: the vehicle is lost"]);
}

#[test]
fn mission_time_goes_on_with_the_vehicle_whose_radio_is_cut() {
    let silence = "[[events]]\nid = 'silence'\nat = 60\n\
        do = [{ fault = 'link', vehicle = 1, to = 1, for = 20 }]";
    let mut process = Process::flying(mission_with(silence), 5.0);
    for quarter in 1..=400_u32 {
        process.fly(STEP * 5, STEP * 25 * quarter);
        let behind = process.world.now().abs_diff(process.live.now());
        assert!(behind < Duration::from_secs(2), "{behind:?} at {quarter}");
    }
    let notices = process.live.take_notices();
    let lost = text!("heard-link-lost");
    assert!(notices.iter().any(|notice| notice.text == lost));
}

#[test]
fn a_silent_vehicle_does_not_stop_the_mission_for_ever() {
    let mut process = Process::new(10.0);
    process.fly(STEP * 40, Duration::from_secs(30));
    let mut now = process.now();
    while !process.live.is_over() {
        now += Duration::from_millis(50);
        process.live.pass(now);
        assert!(now < Duration::from_secs(120), "the limit is 480 s");
    }
    assert!(!process.live.report().passed);
}

/// The recorded first mission in lock step with its reference pilot; up to a time, if one is given.
fn recorded(seed: u64, until: Option<Duration>) -> (MissionReport, String) {
    let (mission, script) = mission();
    let mut exercise = Exercise::new(mission, seed, script, Vec::new());
    exercise.flight_mut().start_record(&Occasion {
        backend: FlightBackend::Embedded,
        ..Occasion::default()
    });
    while !exercise.is_over() && until.is_none_or(|until| exercise.now() < until) {
        exercise.step();
    }
    let report = exercise.close();
    (report, exercise.flight_mut().take_record())
}

#[test]
fn a_recorded_run_scores_again_to_the_same_document() {
    for (seed, until_s) in [(1, None), (2, None), (3, Some(95))] {
        let (report, text) = recorded(seed, until_s.map(Duration::from_secs));
        let again = Stored::read(&text)
            .and_then(|stored| stored.rescore(WithoutEnd::Over))
            .expect("a good record")
            .report;
        let document = |report| serde_json::to_string_pretty(report).expect("plain data");
        assert_eq!(document(&again), document(&report), "{seed}");
        let size = text.len();
        assert!(size < 400_000, "{size} bytes for {} s", report.sim_time_s);
    }
}

#[test]
fn a_run_that_was_cut_off_scores_as_it_stood_then() {
    let (whole, text) = recorded(1, None);
    let (_, part) = recorded(1, Some(Duration::from_secs(95)));
    let lines = part.lines().count() - 1;
    let cut: Vec<&str> = text.lines().take(lines).collect();
    let stored = Stored::read(&cut.join("\n")).expect("the head is whole");
    assert!(stored.damage.is_some() && stored.end().is_none());
    let again = stored
        .rescore(WithoutEnd::Over)
        .expect("a good mission")
        .report;
    assert!(again.score < whole.score && !again.passed);
    assert!(
        (again.sim_time_s - 95.0).abs() < 1.0,
        "{}",
        again.sim_time_s
    );
}

/// The first mission with its reference pilot and a changed starter drone.
fn built(changed: impl Fn(Design) -> Design) -> (MissionReport, String) {
    let source = include_str!("../../missions/01-air-sample.toml");
    let design = Design::from_toml(include_str!("../../designs/starter.toml"));
    let design = changed(design.expect("a good design"));
    let mission = Mission::parse(source)
        .expect("it is good")
        .with_fleet(vec![design])
        .expect("it may fly");
    let (_, script) = self::mission();
    let mut exercise = Exercise::new(Arc::new(mission), 1, script, Vec::new());
    exercise.flight_mut().start_record(&Occasion {
        backend: FlightBackend::Embedded,
        ..Occasion::default()
    });
    while !exercise.is_over() {
        exercise.step();
    }
    let report = exercise.close();
    (report, exercise.flight_mut().take_record())
}

#[test]
fn a_drone_that_somebody_built_flies_the_mission_and_its_record_scores_again_the_same() {
    let (report, text) = built(|design| design);
    assert!(report.passed, "{report:#?}");
    let stored = Stored::read(&text).expect("a good record");
    assert_eq!(stored.head.designs.len(), 1);
    let again = stored
        .rescore(WithoutEnd::Over)
        .expect("a good mission")
        .report;
    let document = |report| serde_json::to_string_pretty(report).expect("plain data");
    assert_eq!(document(&again), document(&report));
}

#[test]
fn without_its_sensor_a_mission_cannot_be_passed() {
    let sensor = crate::workshop::part("s_voc").expect("a part");
    let (report, _) = built(|design| design.without(sensor));
    assert!(!report.passed);
}

/// The share of an objective's points that a script earns in a mission.
fn share_of(objective: &str, file: &str, script: &str) -> f64 {
    let mission = Arc::new(Mission::parse(file).expect("no faults"));
    let places = mission.places_to_name();
    let vehicles: Vec<u16> = (1..=mission.seats.count as u16).collect();
    let context = Context {
        places: Some(&places),
        vehicles: &vehicles,
        ..Context::default()
    };
    let script = Script::parse(script, &context).expect("no faults");
    let mut exercise = Exercise::new(mission, 2, script, Vec::new());
    while !exercise.is_over() {
        exercise.step();
        exercise.take_notices();
    }
    let report = exercise.report();
    let found = report.objectives.iter().find(|it| it.id == objective);
    let found = found.expect("it is there");
    found.points / found.points_max
}

/// The reference pilot up to a line, and then reports of all finds without a close look.
fn blind(pilot: &str, until: &str) -> String {
    let (sweep, _) = pilot.split_once(until).expect("it has this line");
    format!("{sweep}3 mark contacts as person\nall rtl\nwait all disarmed timeout 200s\n")
}

#[test]
fn marking_blindly_does_not_pay_in_the_night_search() {
    let mission = include_str!("../../missions/05-night-search.toml");
    let pilot = include_str!("../../missions/pilots/05-night-search.pilot");
    let blind = share_of("find", mission, &blind(pilot, "all speed 10"));
    let looked = share_of("find", mission, pilot);
    assert!(blind < 0.5 && looked > 0.9, "{blind} {looked}");
}

#[test]
fn marking_blindly_does_not_pay_in_the_plant_accident() {
    let mission = include_str!("../../missions/14-combined-final.toml");
    let pilot = include_str!("../../missions/pilots/14-combined-final.pilot");
    let blind = share_of("people", mission, &blind(pilot, "3 goto c1"));
    let looked = share_of("people", mission, pilot);
    assert!(blind < 0.5 && looked > 0.9, "{blind} {looked}");
}

/// For each of `lines`, the rows of the first entry that begins with it, after a script in a mission with two drones.
fn rows_of(script: &str, lines: &[&str]) -> Vec<Vec<(RowState, String)>> {
    let file = include_str!("../../missions/06-lane-survey.toml");
    let mission = Arc::new(Mission::parse(file).expect("no faults"));
    let places = mission.places_to_name();
    let context = Context {
        places: Some(&places),
        vehicles: &[1, 2],
        ..Context::default()
    };
    let script = Script::parse(script, &context).expect("no faults");
    let mut exercise = Exercise::new(mission, 1, script, Vec::new());
    let limit = Duration::from_secs(120);
    while !exercise.is_over() && exercise.now() < limit {
        exercise.step();
        exercise.take_notices();
    }
    let entry = |line: &&str| {
        let mut entries = exercise.ledger.entries();
        let entry = entries.find(|entry| entry.line.starts_with(line));
        let rows = entry.expect("it was given").rows.iter();
        let words = |row: &LedgerRow| {
            let words = row.explanation.as_ref().map(ToString::to_string);
            (row.state, words.unwrap_or_default())
        };
        rows.map(words).collect()
    };
    lines.iter().map(entry).collect()
}

#[test]
fn a_survey_becomes_plans_on_board_which_are_rehearsed() {
    let script = "wait all ready timeout 60s\n\
                  wait 10s\n\
                  1 plan rehearse\n\
                  all plan survey n 20 e -20 to n 60 e 20 spacing 10 up 15\n\
                  wait 40s\n\
                  all plan rehearse\n\
                  wait 5s\n";
    let found = rows_of(
        script,
        &["1 plan rehearse", "all plan survey", "all plan rehearse"],
    );
    assert_eq!(found[0][0].0, RowState::Refused, "no plan: {found:?}");
    for (state, words) in &found[1] {
        assert_eq!(*state, RowState::Done, "{found:?}");
        assert!(words.contains("read back"), "{words}");
    }
    assert_eq!(found[2].len(), 2);
    for (state, words) in &found[2] {
        assert_eq!(*state, RowState::Done, "{found:?}");
        assert!(words.contains("lands after"), "{words}");
    }
}

#[test]
fn a_vehicle_without_a_part_of_a_survey_carries_no_old_plan() {
    let script = "wait all ready timeout 60s\n\
                  all plan survey n 20 e -20 to n 60 e 20 spacing 10 up 15\n\
                  wait 40s\n\
                  all plan survey n 20 e -2 to n 24 e 2 spacing 20 up 15\n\
                  wait 40s\n\
                  all plan rehearse\n\
                  wait 5s\n";
    let found = rows_of(script, &["all plan survey n 20 e -2 ", "all plan rehearse"]);
    for (state, words) in &found[0] {
        assert_eq!(*state, RowState::Done, "{words}");
    }
    let states: Vec<RowState> = found[1].iter().map(|(state, _)| *state).collect();
    assert!(
        states.contains(&RowState::Refused),
        "one has no plan: {found:?}"
    );
}

#[test]
fn a_survey_that_no_vehicle_can_fly_is_refused_with_the_reason() {
    let script = "wait all ready timeout 60s\n\
                  all plan survey n 0 e 0 to n 90000 e 90000 spacing 1\n\
                  wait 2s\n";
    let found = rows_of(script, &["all plan survey"]);
    for (state, words) in &found[0] {
        assert_eq!(*state, RowState::Refused);
        assert!(words.contains("lines"), "{words}");
    }
}
