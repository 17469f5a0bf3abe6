//! The seats of a mission.

use super::*;
use crate::app::room::home;
use crate::app::state::Activity;
use crate::workshop::DesignKind;

#[test]
fn a_fleet_is_chosen_given_back_and_flown() {
    let mut state = workshop(None);
    press(&mut state, "f enter");
    let id = state.training.missions[0].id.clone();
    assert_eq!(state.training.fleets[&id], [starter()]);
    let effects = press(&mut state, "g");
    let launch = state.training().launch(&id);
    assert_eq!(launch.fleet, [starter()]);
    assert_eq!(
        effects,
        [Effect::Session(SessionEffect::StartMission(launch))]
    );
    press(&mut state, "x");
    assert!(state.training.fleets.is_empty());
}

#[test]
fn another_mission_is_built_for_once_the_flown_one_is_over() {
    let mut state = workshop(None);
    let more = state.training.missions[0].clone();
    state.training.missions.push(more);
    state.session.activity = Some(Activity::Free);
    press(&mut state, "]");
    assert_eq!(state.rooms.home.cursor, 0);
    state.session.task.over = true;
    press(&mut state, "]");
    assert_eq!(state.rooms.home.cursor, 1);
    let said = state.message().expect("the other mission is named");
    assert!(said.text.contains("Air sample"), "{}", said.text);
}

#[test]
fn without_a_mission_the_next_one_is_the_first() {
    for (key, title) in [("]", "Air sample"), ("[", "The last one")] {
        let mut state = workshop(None);
        let mut more = state.training.missions[0].clone();
        more.title = "The last one".into();
        state.training.missions.push(more);
        state.rooms.home.cursor = 2;
        assert!(home::under_cursor(&state).is_none(), "no mission");
        press(&mut state, key);
        let mission = home::under_cursor(&state).expect("a mission");
        assert_eq!(mission.title.to_string(), title);
    }
}

#[test]
fn the_mission_says_what_it_needs_and_what_a_part_would_bring() {
    let mut state = workshop(None);
    let met = |state: &State| -> Vec<bool> {
        let fit = state.rooms.workshop.fit.as_ref().expect("a mission");
        let stands = fit.groups.iter().flat_map(|(_, stands)| stands);
        stands.map(|stand| stand.line.met).collect()
    };
    let needs = &state.training.missions[0].needs;
    let first = needs[0].sensors.first().copied();
    let sensor = first.and_then(crate::workshop::part).expect("it needs one");
    let before = met(&state).iter().filter(|met| **met).count();
    let has = design(&state).has(sensor.id);
    if has {
        press(&mut state, "n");
    }
    put(&mut state, PartSlot::Payload, sensor.id);
    let after = met(&state).iter().filter(|met| **met).count();
    assert!(has || after == before + 1, "{before} {after}");
    let design = design(&state).without(sensor);
    assert!(met(&state)[0] && !state.training.missions[0].needs[0].fit(&design)[0].met);
}

#[test]
fn what_does_not_fly_or_is_not_owned_takes_no_seat() {
    let mut state = workshop(Some(career()));
    put(&mut state, PartSlot::Motor, "m2215_900");
    press(&mut state, "f enter");
    assert!(state.training.fleets.is_empty(), "the motors are not owned");
    let mut state = workshop(None);
    press(&mut state, "x f enter");
    assert!(state.training.fleets.is_empty(), "a frame is missing");
}

#[test]
fn a_design_that_does_not_fly_in_the_air_of_the_mission_takes_no_seat() {
    let mut state = workshop(None);
    for need in &mut state.training.missions[0].needs {
        need.air.altitude_m = 9000.0;
    }
    press(&mut state, "f enter");
    assert!(state.training.fleets.is_empty(), "the air is too thin");
}

#[test]
fn a_fleet_beyond_the_budget_stays_on_the_ground() {
    let mut state = workshop(None);
    state.training.missions[0].outlay.budget = Some(starter().credits() - 1);
    assert_eq!(press(&mut state, "f * g"), []);
    state.training.missions[0].outlay.budget = Some(starter().credits());
    assert_eq!(press(&mut state, "g").len(), 1);
}

/// A console that builds for a mission with two drones and a robot.
fn for_the_lane() -> State {
    let mut state = workshop(None);
    let lane = include_str!("../../../../../missions/18-robot-lane.toml");
    let mission = crate::mission::Mission::parse(lane).expect("it is good");
    state.training.missions = vec![mission.listing()];
    state.training.missions[0].outlay.budget = None;
    state
}

fn sapper() -> Design {
    let source = include_str!("../../../../../designs/sapper.toml");
    Design::from_toml(source).expect("it is good")
}

#[test]
fn a_seat_takes_only_a_design_of_its_kind_and_says_so() {
    let mut state = for_the_lane();
    press(&mut state, "f j j enter");
    assert!(state.training.fleets.is_empty());
    let said = state.message().expect("a reason").text.to_string();
    assert!(
        said.contains("seat 3") && said.contains("ground robot"),
        "{said}"
    );
    press(&mut state, "k enter");
    let id = state.training.missions[0].id.clone();
    assert_eq!(state.training.fleets[&id], [starter(), starter()]);
    state.rooms.workshop.bench.open(sapper(), None, air());
    press(&mut state, "enter");
    assert_eq!(
        state.training.fleets[&id],
        [starter(), starter()],
        "a drone's seat"
    );
    press(&mut state, "*");
    assert_eq!(state.training.fleets[&id], [starter(), starter(), sapper()]);
    let said = state
        .message()
        .expect("the seats are named")
        .text
        .to_string();
    assert!(said.contains("ground robots"), "{said}");
    let mission = &state.training.missions[0];
    let price = 2 * starter().credits() + sapper().credits();
    assert_eq!(bill(&state, mission), price);
}

#[test]
fn a_chassis_on_the_bench_begins_a_robot_and_undo_brings_the_drone_back() {
    let mut state = workshop(None);
    put(&mut state, PartSlot::Frame, "ch_410k");
    let bench = &state.rooms.workshop.bench;
    assert_eq!(bench.sheet().kind, DesignKind::Robot);
    let slots: Vec<PartSlot> = bench.rows().iter().map(|row| row.slot).collect();
    assert!(!slots.contains(&PartSlot::Propeller) && slots.contains(&PartSlot::Motor));
    put(&mut state, PartSlot::Motor, "gm_37");
    let bench = &state.rooms.workshop.bench;
    assert_eq!(bench.findings(), []);
    assert!(bench.curves().polar.len() > 10 && bench.curves().endurance.len() > 10);
    let ids = bench.candidates().iter().map(|it| it.part.id);
    assert!(
        ids.clone().all(|id| id.starts_with("gm_")),
        "{:?}",
        ids.collect::<Vec<_>>()
    );
    press(&mut state, "u u");
    assert_eq!(design(&state), &starter());
}
