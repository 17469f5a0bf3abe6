//! Tests of hints, the prediction and the goal.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::*;
use crate::commands::{Deed, Goal, GoalComponent, Spot, Subject};
use crate::language;
use crate::ledger::{EntryId, Given, Risk, RowState};
use crate::mission::ObjectiveState;
use crate::mission::fake::{Pilot, fly_the_cells};
use crate::scoring::{AlertFact, SafetyEvent, SafetyKind};
use crate::text::Text;
use crate::vehicle::{Ekf, EkfFlags, Health, LandedState, SystemStatus, Unheard, Vehicle};

impl Flight {
    pub(in crate::mission) fn alert_facts(&self) -> &[AlertFact] {
        self.threats.engine().alert_facts()
    }

    pub(in crate::mission) fn broken_rules(&self) -> &[SafetyEvent] {
        self.journal.broken_rules()
    }
}

/// The second mission with two test clues instead of its own.
fn with_clues() -> Mission {
    let clues = "[[hints]]\nlevel = 2\nobjective = \"cells\"\ntext = \"Fly {next_cell} next.\"\n\
                 [[hints]]\nlevel = 1\nphase = \"ground\"\ntext = \"Look at the wind.\"\n";
    let source = include_str!("../../../missions/01-air-sample.toml");
    let (before, own) = source
        .split_once("[[hints]]\nlevel")
        .expect("it has hints to be asked for");
    let (_, scoring) = own.split_once("[scoring]").expect("it is scored");
    let source = format!("{before}{clues}[scoring]{scoring}");
    Mission::parse(&source).expect("it is good")
}

fn ask(flight: &mut Flight) -> (RowState, String) {
    let row = flight.act(EntryId(0), &Deed::Hint, &[1, 2]).remove(0);
    let words = row.explanation.map(|text| text.to_string());
    (row.state, words.unwrap_or_default())
}

#[test]
fn hints_come_one_by_one_and_cost_from_the_second_try_on() {
    for (attempt, factor) in [(1, 1.0), (2, 0.93)] {
        let mut flight = Flight::new(Arc::new(with_clues()), 1);
        flight.set_attempt(attempt);
        assert!(ask(&mut flight).1.contains("Look at the wind."));
        assert!(ask(&mut flight).1.contains("Fly A1 next."));
        assert_eq!(ask(&mut flight).0, RowState::Refused);
        assert_eq!(flight.progress().clues.next, None);
        let report = flight.report(&Ledger::new());
        assert_eq!(
            report.hints.len(),
            2,
            "two vehicles asked, one hint each time"
        );
        assert!((report.hint_factor - factor).abs() < 1e-9);
        assert_eq!(flight.progress().clues.given.len(), 2);
    }
}

#[test]
fn an_exam_says_that_it_gives_no_hints() {
    let mission = with_clues().flown_for(Stake::Exam);
    let mut flight = Flight::new(Arc::new(mission), 1);
    let refused = (RowState::Refused, "exams give no hints".to_owned());
    assert_eq!(ask(&mut flight), refused);
}

#[test]
fn a_prediction_is_compared_with_what_came() {
    let mut pilot = Pilot::new(1);
    let deed = Deed::Predict { points: 400 };
    drop(pilot.flight.act(EntryId(0), &deed, &[1]));
    let prediction = pilot.report().prediction.expect("it was given");
    let score = i32::from(pilot.report().score);
    assert_eq!((prediction.predicted, prediction.error), (400, score - 400));
}

#[test]
fn a_goal_is_reached_by_a_flight_that_passes_only() {
    let seconds = Duration::from_secs;
    for (goal, reached) in [
        (Goal::Time(seconds(470)), true),
        (Goal::Time(seconds(20)), false),
        (Goal::Battery(25.0), true),
        (Goal::Battery(99.0), false),
        (Goal::Faultless(GoalComponent::Safety), true),
        (Goal::Faultless(GoalComponent::Commands), true),
        (Goal::Faultless(GoalComponent::Attention), true),
        (Goal::Score(500), true),
        (Goal::Score(1000), false),
    ] {
        let mut pilot = fly_the_cells(1);
        pilot.flight.pledge.goal = Some(goal);
        let report = pilot.report().goal.expect("it was set");
        assert_eq!(report.reached, reached, "{goal:?}: {}", report.result);
        let mut idle = Pilot::new(1);
        idle.flight.pledge.goal = Some(goal);
        idle.flight.abandon();
        assert!(!idle.report().goal.expect("it was set").reached);
    }
}

#[test]
fn who_holds_a_place_is_at_work_and_who_was_dismissed_is_idle() {
    for (verb, is_at_work) in [
        ("relay to", true),
        ("formation", true),
        ("orbit", true),
        ("survey", false),
        ("relay", false),
        ("formation off", false),
    ] {
        let mut pilot = Pilot::new(1);
        pilot.take_off(20.0);
        let given = Given {
            line: verb,
            verb: language::verb(verb).expect(verb),
            risk: Risk::None,
            by: None,
        };
        pilot.ledger.open(pilot.now, given, &[1]);
        pilot.wait(60.0);
        let idle = pilot.flight.vehicle_uses()[0].idle;
        assert_eq!(idle.is_zero(), is_at_work, "{verb}: {idle:?}");
    }
}

#[test]
fn who_flies_on_unheard_is_not_idle() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    let start = pilot.flight.mission().starts()[0].at;
    pilot.vehicle().link.lost = true;
    for second in 0..60 {
        pilot.vehicle().unheard = Some(Unheard {
            at: start.moved(3.0 * f64::from(second), 0.0),
            altitude_m: 20.0,
            boot_ms: 0,
        });
        pilot.wait(1.0);
    }
    assert_eq!(pilot.flight.vehicle_uses()[0].idle, Duration::ZERO);
}

#[test]
fn vehicles_that_nobody_has_heard_have_numbers_of_their_own() {
    let source = include_str!("../../../missions/12-relay-chain.toml");
    let mission = Arc::new(Mission::parse(source).expect("it is good"));
    let count = mission.seats.count;
    let mut flight = Flight::new(mission, 1);
    let heard = BTreeMap::from([(2, Arc::new(Vehicle::new(2, 1)))]);
    drop(flight.step(Duration::ZERO, &heard, &Ledger::new()));
    let ids: Vec<VehicleId> = flight.vehicle_uses().iter().map(|it| it.vehicle).collect();
    assert_eq!((ids.len(), &ids[..3]), (count, &[2, 1, 3][..]));
}

#[test]
fn a_hint_that_is_not_there_is_no_refused_command() {
    let mut pilot = Pilot::new(1);
    for (line, rejected) in [("1 hint", (0, 0)), ("1 arm", (1, 1))] {
        pilot.command(line, RowState::Refused);
        pilot.tick();
        let events = pilot.report().events;
        let told = events
            .iter()
            .filter(|event| event.kind == EventKind::Rejected);
        let found = (pilot.flight.orders.tally().rejected, told.count());
        assert_eq!(found, rejected, "{line}");
    }
}

/// The rules broken by flying until `left_percent` of the battery is left, and then landing or
/// giving up.
fn broken_at_the_end(left_percent: u8, lands: bool) -> Vec<SafetyKind> {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    let is_above = |pilot: &mut Pilot| {
        let battery = pilot.vehicle().battery();
        battery.and_then(|it| it.remaining_percent) > Some(left_percent)
    };
    // Back and forth: the vehicle reports its battery while it flies.
    while is_above(&mut pilot) && !pilot.flight.is_over() {
        pilot.goto(10.0, 0.0, 5.0);
        pilot.goto(0.0, 0.0, 5.0);
    }
    if lands {
        pilot.land();
    }
    pilot.flight.abandon();
    let rules = pilot.flight.broken_rules();
    rules.iter().map(|rule| rule.kind).collect()
}

#[test]
fn not_to_land_is_never_safer_than_to_land() {
    let value = |left_percent, lands| {
        let broken = broken_at_the_end(left_percent, lands);
        let at_once = |&kind: &SafetyKind| SafetyEvent {
            kind,
            vehicle: 1,
            at: Duration::ZERO,
            lasted: Duration::ZERO,
            text: Text::default(),
        };
        let events: Vec<SafetyEvent> = broken.iter().map(at_once).collect();
        crate::scoring::safety_value(&events)
    };
    for left_percent in [60, 16] {
        assert!(value(left_percent, false) < value(left_percent, true));
    }
    assert_eq!(broken_at_the_end(60, true), []);
    assert_eq!(broken_at_the_end(60, false), [SafetyKind::NotLanded]);
    assert_eq!(
        broken_at_the_end(16, false),
        [SafetyKind::NotLanded, SafetyKind::LowReserve]
    );
}

#[test]
fn a_vehicle_in_the_air_when_the_time_is_up_breaks_a_rule() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    while !pilot.flight.is_over() {
        pilot.tick();
    }
    let rules = pilot.flight.broken_rules();
    assert!(rules.iter().any(|rule| rule.kind == SafetyKind::NotLanded));
}

#[test]
fn a_landed_vehicle_is_not_called_home() {
    let source = include_str!("../../../missions/03-plume-source.toml");
    let mut pilot = Pilot::flying(Mission::parse(source).expect("it is good"), 1);
    pilot.take_off(20.0);
    // A report without a kind counts as one of the kind that the mission requires.
    let subject = Subject::Spot(Spot::Here);
    let deed = Deed::Mark {
        subject,
        kind: None,
    };
    drop(pilot.flight.act(EntryId(0), &deed, &[1]));
    pilot.wait(1.0);
    let hint = |pilot: &Pilot| pilot.flight.progress().hint.map(|it| it.to_string());
    let home = hint(&pilot).expect("a hint");
    assert!(home.contains("rtl"), "{home}");
    pilot.set_landed(LandedState::OnGround);
    pilot.set_armed(false);
    pilot.wait(1.0);
    let down = hint(&pilot).expect("a hint");
    assert!(down.starts_with("Landed."), "{down}");
}

/// "hint: all drones return…" was once shown in exams, which have no hints.
#[test]
fn an_exam_shows_no_advice_by_itself() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(10.0);
    pilot.flight.set_stake(Stake::Exam);
    assert_eq!(pilot.flight.progress().hint, None, "of the mission");
    pilot.set_mode("RTL");
    pilot.wait(1.0);
    assert_eq!(pilot.flight.progress().hint, None, "about the return");
    pilot.flight.set_stake(Stake::Graded);
    assert!(pilot.flight.progress().hint.is_some());
}

#[test]
fn vehicles_that_return_are_not_told_to_go_on() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    let hint = |pilot: &Pilot| pilot.flight.progress().hint.map(|it| it.to_string());
    let on_task = hint(&pilot).expect("a hint");
    for mode in ["RTL", "LAND"] {
        pilot.set_mode(mode);
        pilot.wait(1.0);
        let returning = hint(&pilot).expect("a hint");
        assert!(
            returning.contains("objectives are still open"),
            "{returning}"
        );
    }
    pilot.set_mode("GUIDED");
    pilot.wait(1.0);
    assert_eq!(hint(&pilot).expect("a hint"), on_task);
}

#[test]
fn vehicles_that_return_with_a_low_battery_are_left_alone() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    pilot.set_mode("RTL");
    let least = pilot.flight.mission().rules.land_reserve_percent as u8;
    for (percent, words) in [(least + 20, "`guided` stops"), (least + 5, "let them land")] {
        let battery = pilot.vehicle().batteries.first_mut();
        battery.expect("it has one").remaining_percent = Some(percent);
        pilot.tick();
        let hint = pilot.flight.progress().hint.expect("a hint").to_string();
        assert!(hint.contains(words), "{percent} %: {hint}");
    }
}

#[test]
fn after_a_landing_with_an_empty_battery_the_hint_names_the_end() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    pilot.land();
    let hint = |pilot: &Pilot| pilot.flight.progress().hint.map(|it| it.to_string());
    let charged = hint(&pilot).expect("a hint");
    assert!(!charged.contains("`abandon`"), "{charged}");
    let battery = pilot.vehicle().batteries.first_mut();
    battery.expect("it has one").remaining_percent = Some(5);
    pilot.wait(1.0);
    let spent = hint(&pilot).expect("a hint");
    assert!(spent.contains("`abandon` ends it now"), "{spent}");
}

#[test]
fn after_the_last_landing_the_hint_sends_no_drone_home() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    pilot.survey();
    pilot.look_above();
    pilot.set_landed(LandedState::OnGround);
    pilot.set_armed(false);
    pilot.wait(1.0);
    let hint = pilot.flight.progress().hint.expect("a hint").to_string();
    assert!(hint.starts_with("Landed: the flight ends"), "{hint}");
}

#[test]
fn a_fleet_that_waits_on_the_ground_for_the_time_limit_has_run_out_of_time() {
    let source = include_str!("../../../missions/05-night-search.toml");
    let mut pilot = Pilot::flying(Mission::parse(source).expect("it is good"), 1);
    pilot.take_off(20.0);
    pilot.land();
    while !pilot.flight.is_over() {
        pilot.tick();
    }
    assert_eq!(pilot.flight.outcome(), FlightOutcome::TimedOut);
}

#[test]
fn on_the_way_home_only_what_the_flight_can_still_do_is_open() {
    let drill = include_str!("../../../missions/drills/d05-tell-apart.toml");
    let tables: Vec<&str> = drill.split("[[").collect();
    let without_area = tables
        .into_iter()
        .filter(|it| !it.contains("id = \"area\""));
    let source = without_area.collect::<Vec<_>>().join("[[");
    let mut pilot = Pilot::flying(Mission::parse(&source).expect("it is good"), 1);
    pilot.take_off(20.0);
    pilot.set_mode("RTL");
    pilot.wait(1.0);
    let hint = |pilot: &Pilot| pilot.flight.progress().hint.map(|it| it.to_string());
    let early = hint(&pilot).expect("a hint");
    assert!(early.contains("objectives are still open"), "{early}");
    let subject = Subject::Spot(Spot::Here);
    let deed = Deed::Mark {
        subject,
        kind: None,
    };
    drop(pilot.flight.act(EntryId(0), &deed, &[1]));
    pilot.wait(1.0);
    let home = hint(&pilot).expect("a hint");
    assert!(home.contains("ends after the last landing"), "{home}");
}

#[test]
fn an_objective_out_of_reach_is_missed_at_once() {
    let source = include_str!("../../../missions/00-first-flight.toml");
    let mut pilot = Pilot::flying(Mission::parse(source).expect("it is good"), 1);
    let state = |pilot: &Pilot| pilot.flight.progress().objectives[0].state;
    let vehicle = pilot.vehicle();
    vehicle.health = Some(Health {
        present: Health::PREARM,
        enabled: Health::PREARM,
        healthy: Health::PREARM,
        load_percent: f32::NAN,
        at: Duration::ZERO,
    });
    vehicle.ekf = Some(Ekf {
        flags: EkfFlags(EkfFlags::POSITION_HORIZONTAL_ABSOLUTE),
        velocity_variance: 0.0,
        position_horizontal_variance: 0.0,
        position_vertical_variance: 0.0,
        compass_variance: 0.0,
        at: Duration::ZERO,
    });
    pilot.wait(50.0);
    assert_eq!(state(&pilot), ObjectiveState::Open);
    pilot.wait(30.0);
    assert!(!pilot.flight.is_over());
    assert_eq!(state(&pilot), ObjectiveState::Missed);
}

#[test]
fn a_return_by_failsafe_is_not_to_be_cancelled() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    pilot.set_mode("RTL");
    let heartbeat = pilot.vehicle().heartbeat.as_mut();
    heartbeat.expect("there from the start").status = SystemStatus::Critical;
    pilot.wait(1.0);
    let hint = pilot.flight.progress().hint.expect("a hint").to_string();
    assert!(!hint.contains("guided"), "{hint}");
    assert!(hint.contains("let it land"), "{hint}");
}

#[test]
fn a_landed_vehicle_whose_motors_still_run_is_not_told_to_take_off() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    pilot.set_mode("RTL");
    pilot.set_landed(LandedState::OnGround);
    pilot.wait(1.0);
    let hint = pilot.flight.progress().hint.expect("a hint").to_string();
    assert!(hint.starts_with("Landed: the motors stop"), "{hint}");
}

#[test]
fn a_flight_ends_itself_once_all_are_down_and_only_time_is_missing() {
    let source = include_str!("../../../missions/03-plume-source.toml");
    for is_reported in [true, false] {
        let mut pilot = Pilot::flying(Mission::parse(source).expect("it is good"), 1);
        pilot.take_off(20.0);
        if is_reported {
            let subject = Subject::Spot(Spot::Here);
            let deed = Deed::Mark {
                subject,
                kind: None,
            };
            drop(pilot.flight.act(EntryId(0), &deed, &[1]));
        }
        pilot.wait(1.0);
        assert!(!pilot.flight.progress().ends_itself, "it flies");
        pilot.set_landed(LandedState::OnGround);
        pilot.set_armed(false);
        pilot.wait(1.0);
        assert_eq!(pilot.flight.progress().ends_itself, is_reported);
        assert!(!pilot.flight.is_over());
        pilot.wait(30.0);
        assert_eq!(pilot.flight.is_over(), is_reported);
        assert!(!is_reported || !pilot.flight.progress().ends_itself);
    }
}
