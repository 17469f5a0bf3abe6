//! Building on the bench, and its limits.

use super::*;

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
        bench
            .design()
            .to_toml()
            .replace("New design", "Starter 450"),
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
fn a_part_on_board_changes_nothing() {
    let mut state = workshop(None);
    put(&mut state, PartSlot::Battery, "b3s5000");
    state.rooms.workshop.pane = Pane::Slots;
    press(&mut state, "home");
    while state.rooms.workshop.bench.slot() != PartSlot::Battery {
        press(&mut state, "j");
    }
    let bench = &state.rooms.workshop.bench;
    let on_board = bench.candidates().iter().find(|it| it.on_board > 0);
    let on_board = on_board.expect("it was put in");
    assert_eq!(on_board.sheet, *bench.sheet());
}
