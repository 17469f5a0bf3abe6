//! The seats of a mission.

use super::*;
use crate::app::room::home;
use crate::app::state::Activity;

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
