//! What keys do in the workshop.

mod properties;

use super::*;
use crate::app::Setup;
use crate::app::effect::{CareerEffect, Effect, FileEffect, FileKind, SessionEffect};
use crate::app::event::{CareerEvent, Event, FileEvent, TerminalEvent};
use crate::app::room::Room;
use crate::app::state::{Career, Overlay, Purpose};
use crate::app::update::update;
use crate::campaign::{MissionCourse, Offer};
use crate::mission::Mission;
use crate::workshop::PartSlot;
use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

const STARTER: &str = include_str!("../../../../designs/starter.toml");
const MISSION: &str = include_str!("../../../../missions/01-air-sample.toml");

fn starter() -> Design {
    Design::from_toml(STARTER).expect("it is good")
}

/// In the workshop with one design on offer, and one mission.
fn workshop(career: Option<Career>) -> State {
    let mission = Mission::parse(MISSION).expect("it is good");
    let mut state = State::new(Setup {
        missions: vec![mission.listing()],
        stock: vec![starter()],
        ..Setup::default()
    });
    state.size = (200, 50);
    state.career = career;
    press(&mut state, "W");
    state
}

fn career() -> Career {
    let mission = Mission::parse(MISSION).expect("it is good");
    Career::new(
        "Olena",
        Vec::new(),
        MissionCourse::new([Offer::of(&mission)]),
    )
}

fn hear(state: &mut State, event: impl Into<Event>) -> Vec<Effect> {
    update(state, event.into()).into_vec()
}

fn press(state: &mut State, keys: &str) -> Vec<Effect> {
    let mut effects = Vec::new();
    for word in keys.split(' ') {
        let code = match word {
            "enter" => KeyCode::Enter,
            "esc" => KeyCode::Esc,
            "tab" => KeyCode::Tab,
            "home" => KeyCode::Home,
            "ctrl-r" => {
                let key = KeyEvent::new(KeyCode::Char('r'), KeyModifiers::CONTROL);
                effects.extend(hear(state, TerminalEvent::Key(key)));
                continue;
            }
            "clear" => {
                let key = KeyEvent::new(KeyCode::Char('u'), KeyModifiers::CONTROL);
                effects.extend(hear(state, TerminalEvent::Key(key)));
                continue;
            }
            word => {
                for c in word.chars() {
                    let key = KeyEvent::new(KeyCode::Char(c), KeyModifiers::NONE);
                    effects.extend(hear(state, TerminalEvent::Key(key)));
                }
                continue;
            }
        };
        let key = KeyEvent::new(code, KeyModifiers::NONE);
        effects.extend(hear(state, TerminalEvent::Key(key)));
    }
    effects
}

/// Moves to a slot and puts a part in as a user would.
fn put(state: &mut State, slot: PartSlot, part: &str) {
    state.rooms.workshop.pane = Pane::Slots;
    press(state, "home");
    while state.rooms.workshop.bench.slot() != slot {
        press(state, "j");
    }
    press(state, "tab home");
    while state.rooms.workshop.bench.candidate().map(|it| it.part.id) != Some(part) {
        let before = state.rooms.workshop.bench.at();
        press(state, "j");
        assert_ne!(
            state.rooms.workshop.bench.at(),
            before,
            "there is no {part}"
        );
    }
    press(state, "enter");
    state.rooms.workshop.pane = Pane::Slots;
}

fn design(state: &State) -> &Design {
    state.rooms.workshop.bench.design()
}

#[test]
fn the_room_begins_with_a_design_that_everybody_may_fly() {
    let state = workshop(None);
    assert_eq!(state.room, Room::Workshop);
    assert_eq!(design(&state), &starter());
    assert!(is_saved(&state), "nothing was changed yet");
}

#[test]
fn a_drone_is_built_from_nothing_and_its_figures_follow() {
    let mut state = workshop(None);
    press(&mut state, "n");
    assert!(design(&state).is_empty());
    assert_eq!(state.rooms.workshop.bench.findings().len(), 9);
    for (slot, part) in [
        (PartSlot::Frame, "fr_450q"),
        (PartSlot::Motor, "m2212_920"),
        (PartSlot::Propeller, "p10x4.5p"),
        (PartSlot::Esc, "e30opto"),
        (PartSlot::Battery, "b3s5000"),
        (PartSlot::Autopilot, "fc_h7"),
        (PartSlot::Navigation, "gps_m8n"),
        (PartSlot::Power, "pm_02"),
        (PartSlot::Radio, "r_sik915"),
        (PartSlot::Payload, "s_voc"),
    ] {
        put(&mut state, slot, part);
    }
    let bench = &state.rooms.workshop.bench;
    assert_eq!(bench.findings(), []);
    assert_eq!(bench.sheet(), &Sheet::of(&starter(), air()));
    assert_eq!(
        bench.design().to_toml().replace("New drone", "Starter 450"),
        starter().to_toml()
    );
}

#[test]
fn the_cursor_goes_on_to_what_is_still_empty() {
    let mut state = workshop(None);
    press(&mut state, "n enter enter");
    let room = &state.rooms.workshop;
    assert_eq!(
        (room.pane, room.bench.slot()),
        (Pane::Slots, PartSlot::Motor)
    );
    press(&mut state, "home enter j enter");
    let room = &state.rooms.workshop;
    assert_eq!(
        (room.pane, room.bench.slot()),
        (Pane::Slots, PartSlot::Frame)
    );
}

#[test]
fn a_change_is_taken_back_and_made_again() {
    let mut state = workshop(None);
    put(&mut state, PartSlot::Battery, "b3s5000");
    assert_eq!(
        design(&state).in_slot(PartSlot::Battery).len(),
        2,
        "in parallel"
    );
    let changed = design(&state).clone();
    assert!(!is_saved(&state));
    press(&mut state, "u");
    assert_eq!(design(&state), &starter());
    press(&mut state, "ctrl-r");
    assert_eq!(design(&state), &changed);
    press(&mut state, "x");
    assert_eq!(design(&state), &starter(), "the cursor was on the battery");
}

#[test]
fn what_is_not_saved_is_replaced_only_after_a_question_and_comes_back() {
    let mut state = workshop(None);
    put(&mut state, PartSlot::Payload, "s_rgb");
    let changed = design(&state).clone();
    press(&mut state, "n");
    assert!(matches!(state.overlay, Some(Overlay::Confirm(_))));
    press(&mut state, "esc");
    assert_eq!(design(&state), &changed);
    press(&mut state, "n y");
    assert!(design(&state).is_empty());
    press(&mut state, "u");
    assert_eq!(design(&state), &changed);
}

#[test]
fn what_lies_on_the_bench_survives_leaving_the_room_and_a_session() {
    let mut state = workshop(None);
    put(&mut state, PartSlot::Payload, "s_rgb");
    let changed = design(&state).clone();
    press(&mut state, "esc");
    assert_eq!(state.room, Room::Home);
    let left = hear(&mut state, TerminalEvent::Line("leave".to_owned()));
    assert_eq!(left, [Effect::Session(SessionEffect::Leave)]);
    press(&mut state, "W");
    assert_eq!(design(&state), &changed);
    let effects = press(&mut state, "esc q");
    assert_eq!(effects, [], "quitting asks");
    assert!(matches!(state.overlay, Some(Overlay::Confirm(_))));
}

#[test]
fn a_licence_is_bought_after_a_question_that_says_what_is_left() {
    let mut state = workshop(Some(career()));
    assert_eq!(lacking(&state, design(&state)), Vec::<&Part>::new());
    put(&mut state, PartSlot::Motor, "m2215_900");
    let lacking_now = lacking(&state, design(&state));
    assert_eq!(lacking_now.len(), 1);
    let effects = press(&mut state, "b");
    assert_eq!(effects, []);
    let Some(Overlay::Confirm(question)) = &state.overlay else {
        panic!("{:?}", state.message());
    };
    assert!(question.reason.contains("500"), "{}", question.reason);
    let effects = press(&mut state, "y");
    assert_eq!(
        effects,
        [Effect::Career(CareerEffect::BuyPart(
            "m2215_900".to_owned()
        ))]
    );
}

#[test]
fn what_is_locked_says_by_which_mission() {
    let mut state = workshop(Some(career()));
    let mission = Mission::parse(MISSION).expect("it is good");
    let locked = Offer::of(&mission).parts.first().cloned();
    let part = locked
        .and_then(|id| crate::workshop::part(&id))
        .expect("it unlocks one");
    put(&mut state, part.slot(), part.id);
    assert_eq!(
        licence(&state, part),
        Licence::Locked(mission.title.clone())
    );
    assert_eq!(press(&mut state, "tab b"), []);
    let said = state.message().map(|it| it.text.to_string());
    let title = mission.title.to_string();
    assert!(
        said.as_ref().is_some_and(|it| it.contains(&title)),
        "{said:?}"
    );
}

#[test]
fn a_design_is_saved_under_a_name_and_another_of_that_name_only_after_a_question() {
    let mut state = workshop(Some(career()));
    let effects = press(&mut state, "s clear Mine enter");
    let mine = starter().named("Mine").expect("a name");
    assert_eq!(
        effects,
        [Effect::Career(CareerEffect::KeepDesign(mine.clone()))]
    );
    let mut after = career();
    after.designs = vec![mine.clone()];
    hear(
        &mut state,
        CareerEvent::Career(Some(Box::new(after.clone()))),
    );
    assert!(is_saved(&state));
    put(&mut state, PartSlot::Payload, "s_rgb");
    assert_eq!(
        press(&mut state, "s enter").len(),
        1,
        "it is the same design"
    );
    press(&mut state, "n y");
    assert_eq!(press(&mut state, "s clear mine enter"), []);
    assert!(matches!(state.overlay, Some(Overlay::Confirm(_))));
    let effects = press(&mut state, "y");
    assert!(matches!(
        effects.as_slice(),
        [Effect::Career(CareerEffect::KeepDesign(_))]
    ));
}

#[test]
fn without_a_profile_nothing_is_kept_but_files_are_written() {
    let mut state = workshop(None);
    assert_eq!(press(&mut state, "s"), []);
    assert!(state.overlay.is_none());
    let effects = press(&mut state, "e enter");
    assert_eq!(
        effects,
        [Effect::File(FileEffect::Write {
            kind: FileKind::Design,
            path: "starter-450.toml".to_owned(),
            text: starter().to_toml(),
            replace: false,
        })]
    );
    let effects = press(&mut state, "i mine.toml enter");
    let path = "mine.toml".to_owned();
    assert_eq!(
        effects,
        [Effect::File(FileEffect::Read {
            kind: FileKind::Design,
            path: path.clone()
        })]
    );
    let text = starter().named("Mine").expect("a name").to_toml();
    hear(
        &mut state,
        FileEvent::Read {
            kind: FileKind::Design,
            path,
            text,
        },
    );
    assert_eq!(design(&state).name, "Mine");
    let path = "bad.toml".to_owned();
    let text = "schema = 1\nname = \"x\"\nframe = \"none\"\n".to_owned();
    hear(
        &mut state,
        FileEvent::Read {
            kind: FileKind::Design,
            path,
            text,
        },
    );
    let said = state.message().map(|it| it.text.to_string());
    assert!(said.is_some_and(|it| it.contains("bad.toml:3")));
    assert_eq!(design(&state).name, "Mine");
}

#[test]
fn designs_are_copied_renamed_and_deleted_in_the_list() {
    let mut career = career();
    career.designs = vec![starter().named("Mine").expect("a name")];
    let mut state = workshop(Some(career));
    press(&mut state, "o home");
    let effects = press(&mut state, "y enter");
    let copy = starter().named("Mine 2").expect("a name");
    assert_eq!(effects, [Effect::Career(CareerEffect::KeepDesign(copy))]);
    let effects = press(&mut state, "r clear Other enter");
    let other = starter().named("Other").expect("a name");
    let from = "Mine".to_owned();
    let renamed = Effect::Career(CareerEffect::RenameDesign {
        from: from.clone(),
        design: other,
    });
    assert_eq!(effects, [renamed]);
    assert_eq!(press(&mut state, "x"), []);
    assert_eq!(
        press(&mut state, "y"),
        [Effect::Career(CareerEffect::DropDesign(from))]
    );
    press(&mut state, "j x");
    assert!(state.overlay.is_none(), "sortie's own stay");
}

#[test]
fn two_designs_lie_side_by_side() {
    let mut state = workshop(None);
    put(&mut state, PartSlot::Payload, "s_rgb");
    press(&mut state, "d d");
    let room = &state.rooms.workshop;
    assert_eq!(room.page, Page::Compare);
    assert_eq!(room.compared.as_ref().map(|it| &it.0), Some(&starter()));
    press(&mut state, "esc");
    assert_eq!(state.rooms.workshop.page, Page::Bench);
}

#[test]
fn a_fleet_is_chosen_given_back_and_flown() {
    let mut state = workshop(None);
    press(&mut state, "f enter");
    let id = state.missions[0].id.clone();
    assert_eq!(state.fleets[&id], [starter()]);
    let effects = press(&mut state, "g");
    let launch = state.launch(&id);
    assert_eq!(launch.fleet, [starter()]);
    assert_eq!(
        effects,
        [Effect::Session(SessionEffect::StartMission(launch))]
    );
    press(&mut state, "x");
    assert!(state.fleets.is_empty());
}

#[test]
fn the_mission_says_what_it_needs_and_what_a_part_would_bring() {
    let mut state = workshop(None);
    let met = |state: &State| -> Vec<bool> {
        let fit = state.rooms.workshop.fit.as_ref().expect("a mission");
        let stands = fit.groups.iter().flat_map(|(_, stands)| stands);
        stands.map(|stand| stand.line.met).collect()
    };
    let needs = &state.missions[0].needs;
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
    assert!(met(&state)[0] && !state.missions[0].needs[0].fit(&design)[0].met);
}

#[test]
fn what_does_not_fly_or_is_not_owned_takes_no_seat() {
    let mut state = workshop(Some(career()));
    put(&mut state, PartSlot::Motor, "m2215_900");
    press(&mut state, "f enter");
    assert!(state.fleets.is_empty(), "the motors are not owned");
    let mut state = workshop(None);
    press(&mut state, "x f enter");
    assert!(state.fleets.is_empty(), "a frame is missing");
}

#[test]
fn a_design_that_does_not_fly_in_the_air_of_the_mission_takes_no_seat() {
    let mut state = workshop(None);
    for need in &mut state.missions[0].needs {
        need.air.altitude_m = 9000.0;
    }
    press(&mut state, "f enter");
    assert!(state.fleets.is_empty(), "the air is too thin");
}

#[test]
fn a_fleet_beyond_the_budget_stays_on_the_ground() {
    let mut state = workshop(None);
    state.missions[0].outlay.budget = Some(starter().credits() - 1);
    assert_eq!(press(&mut state, "f * g"), []);
    state.missions[0].outlay.budget = Some(starter().credits());
    assert_eq!(press(&mut state, "g").len(), 1);
}

#[test]
fn prompts_of_the_room_open_and_close() {
    let mut state = workshop(Some(career()));
    press(&mut state, "s clear enter");
    let Some(Overlay::Prompt(prompt)) = &state.overlay else {
        panic!("an empty name is refused in the prompt");
    };
    assert_eq!(prompt.purpose, Purpose::SaveDesign);
    assert!(prompt.fault.is_some());
}
