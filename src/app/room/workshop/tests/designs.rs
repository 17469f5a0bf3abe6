//! Designs: stored, listed and compared.

use super::*;

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
fn typing_replaces_a_name_that_is_only_proposed_and_an_edit_keeps_it() {
    for (keys, name) in [
        ("s Mine enter", "Mine"),
        ("s left right 2 enter", "Starter 4502"),
    ] {
        let mut state = workshop(Some(career()));
        let effects = press(&mut state, keys);
        let kept = starter().named(name).expect("a name");
        assert_eq!(
            effects,
            [Effect::Career(CareerEffect::KeepDesign(kept))],
            "{keys}"
        );
    }
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
fn prompts_of_the_room_open_and_close() {
    let mut state = workshop(Some(career()));
    press(&mut state, "s clear enter");
    let Some(Overlay::Prompt(prompt)) = &state.overlay else {
        panic!("an empty name is refused in the prompt");
    };
    assert_eq!(prompt.purpose, Purpose::SaveDesign);
    assert!(prompt.fault.is_some());
}
