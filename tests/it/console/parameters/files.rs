//! Parameters in files.

use super::*;

#[test]
fn a_list_is_saved_when_it_is_whole_and_never_over_another_file_unasked() {
    let mut console = Console::flying(1);
    console.press("P");
    console.give("params save x.parm");
    assert!(console.effects.is_empty());
    let Some(Overlay::Palette(palette)) = console.state().overlay() else {
        panic!("the line stays");
    };
    let fault = palette.fault().expect("a fault");
    assert_eq!(fault.message.to_string(), "no parameters received yet");
    console.press("esc");
    arrives(&mut console, 1, list(1.0, 1000.0));
    console
        .press("s")
        .press("ctrl-u")
        .write("my file.parm")
        .press("enter");
    let [
        Effect::File(FileEffect::Write {
            kind: FileKind::Parameters,
            path,
            text,
            replace,
        }),
    ] = &console.effects[..]
    else {
        panic!("{:?}", console.effects);
    };
    assert_eq!((path.as_str(), *replace), ("my file.parm", false));
    assert!(text.starts_with("# vehicle 1, 10 parameters\nANGLE_MAX,3000\n"));
    let (path, text) = (path.clone(), text.clone());
    console.hear(FileEvent::Exists {
        kind: FileKind::Parameters,
        path,
        text,
    });
    assert!(console.press("y").effects.iter().any(|effect| matches!(
        effect,
        Effect::File(FileEffect::Write { kind: FileKind::Parameters, replace: true, path, .. }) if path == "my file.parm"
    )));
}

#[test]
fn a_file_shows_what_differs_first_and_sets_what_was_confirmed() {
    let mut console = in_the_room(2);
    console.give("params load other.parm");
    let path = "other.parm".to_owned();
    assert_eq!(
        console.effects,
        [Effect::File(FileEffect::Read {
            kind: FileKind::Parameters,
            path: path.clone()
        })]
    );
    let text = "RTL_ALT,2000\nWPNAV_SPEED,1000\nSYSID_THISMAV,7\nANGLE_MAX,4500\nNEW_ONE,1\n";
    console.hear(FileEvent::Read {
        kind: FileKind::Parameters,
        path,
        text: text.to_owned(),
    });
    assert_eq!(
        names(&console),
        ["ANGLE_MAX", "NEW_ONE", "RTL_ALT", "SYSID_THISMAV"]
    );
    console.press("o");
    let missing = [
        "ARMING_CHECK",
        "BATT_CAPACITY",
        "COMPASS_DEV_ID",
        "FENCE_ENABLE",
    ];
    assert!(
        missing
            .iter()
            .all(|name| names(&console).iter().any(|it| it == name))
    );
    assert!(
        !names(&console).contains(&"WPNAV_SPEED".to_owned()),
        "it is equal"
    );
    console.press("home").press("space");
    assert!(console.press("a").effects.is_empty(), "it asks first");
    console.press("y");
    let set = ("RTL_ALT".to_owned(), 2000.0, vec![1]);
    assert_eq!(
        settings(&console.effects),
        [set],
        "ANGLE_MAX was unmarked; a system id, and what the vehicle lacks, never were marked"
    );
    row(&mut console, 0, 1, RowState::Done);
    assert_eq!(said(&console), "parameters set: 1 confirmed");
    assert!(
        names(&console).contains(&"RTL_ALT".to_owned()),
        "it stays in sight"
    );
}

#[test]
fn a_faulty_file_is_told_with_line_and_column_and_changes_nothing() {
    let mut console = in_the_room(1);
    let text = "RTL_ALT,2000\nANGLE_MAX;45\n".to_owned();
    let path = "bad.parm".to_owned();
    console.hear(FileEvent::Read {
        kind: FileKind::Parameters,
        path,
        text,
    });
    assert_eq!(
        said(&console),
        "bad.parm:2:13: ANGLE_MAX;45 has no value (nothing was loaded)"
    );
    assert!(console.state().rooms().parameters().comparison().is_none());
}
