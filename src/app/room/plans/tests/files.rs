//! Files of drafts: saved, opened, and their names on the command line.

use super::*;
use crate::vehicle::Severity;

fn written(effects: &[Effect]) -> (String, String) {
    match effects {
        [
            Effect::File(FileEffect::Write {
                kind: FileKind::Plan,
                path,
                text,
                ..
            }),
        ] => (path.clone(), text.clone()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_draft_is_saved_and_opened_again() {
    let mut desk = Desk::new();
    desk.press("ta");
    assert!(!is_kept(desk.app.state()));
    let (path, text) = written(&desk.give("draft save field"));
    assert_eq!(path, "field.plan");
    let _ = desk
        .app
        .update(Event::from(FileEvent::Written { path: path.clone() }));
    assert!(is_kept(desk.app.state()));
    desk.press("n");
    desk.read(&path, &text);
    assert_eq!(desk.room().drafts().all().len(), 2);
    assert_eq!(desk.plan(), [command::TAKEOFF, command::WAYPOINT]);
    desk.press("\t");
    desk.give("draft use plan");
    assert_eq!(
        desk.room().drafts().current().map(Draft::name),
        Some("plan")
    );
    desk.read("bad.plan", "QGC WPL 110\n0\tx\n");
    assert!(desk.said().starts_with("bad.plan:2:"), "{}", desk.said());
}

/// A home without a height is a warning, as in `sortie plan check`, and stays in the notices.
#[test]
fn a_file_without_the_height_of_home_is_a_warning() {
    let mut desk = Desk::new();
    let home = "\"plannedHomePosition\": [50.45, 30.52, null]";
    let text = format!(
        "{{ \"fileType\": \"Plan\", \"mission\": {{ \"items\": [], {home}, \"version\": 2 }}, \"version\": 1 }}"
    );
    desk.read("low.plan", &text);
    assert_eq!(
        desk.said(),
        "low.plan: home has no height: 0 m above sea level is assumed"
    );
    let is_noted = desk
        .app
        .state()
        .notices()
        .lines()
        .any(|line| line.notice.text.contains("home has no height"));
    assert!(is_noted);
    desk.read("level.plan", &text.replace("null", "170"));
    assert!(!desk.said().contains("height"), "{}", desk.said());
}

#[test]
fn a_draft_stays_with_the_file_that_it_was_saved_to() {
    let mut desk = Desk::new();
    desk.press("ta");
    let (path, _) = written(&desk.give("draft save second.waypoints"));
    let _ = desk.app.update(Event::from(FileEvent::Written { path }));
    let name = desk.room().drafts().current().map(Draft::name);
    assert_eq!(name, Some("second.waypoints"));
    desk.press("a");
    let effects = desk.give("draft save");
    assert_eq!(written(&effects).0, "second.waypoints");
    let replaces = matches!(
        effects[..],
        [Effect::File(FileEffect::Write { replace: true, .. })]
    );
    assert!(replaces, "its own file needs no question");
    desk.press("w");
    assert_eq!(desk.line(), "draft save second.waypoints");
    let _ = desk.key(KeyCode::Esc);
    let other = desk.give("draft save third.plan");
    let replaces = matches!(
        other[..],
        [Effect::File(FileEffect::Write { replace: true, .. })]
    );
    assert!(
        !replaces,
        "a file that the draft did not come from is not replaced"
    );
}

#[test]
fn a_file_that_is_opened_again_loses_no_changes() {
    let mut desk = Desk::new();
    desk.press("ta");
    let (path, text) = written(&desk.give("draft save field.plan"));
    let _ = desk
        .app
        .update(Event::from(FileEvent::Written { path: path.clone() }));
    desk.press("aa");
    assert_eq!(desk.plan().len(), 4);
    desk.read(&path, &text);
    assert_eq!(
        (desk.plan().len(), desk.room().drafts().all().len()),
        (2, 1)
    );
    desk.press("u");
    assert_eq!(desk.plan().len(), 4, "undo brings the changes back");
}

#[test]
fn names_of_files_are_completed_by_tab() {
    let mut desk = Desk::new();
    desk.press("t");
    let list = |folder: &str| {
        vec![Effect::File(FileEffect::List {
            folder: folder.to_owned(),
        })]
    };
    let listed = |desk: &mut Desk, folder: &str, names: &[&str]| {
        let names = names.iter().map(|name| (*name).to_owned()).collect();
        let folder = folder.to_owned();
        let _ = desk
            .app
            .update(Event::from(FileEvent::Listed { folder, names }));
    };
    for line in [
        "draft open ",
        "draft save ",
        "1 plan upload ",
        "1 fence upload ",
        "1 rally upload ",
    ] {
        desk.press(":");
        let mut effects = Vec::new();
        for letter in line.chars() {
            effects.extend(desk.key(KeyCode::Char(letter)));
        }
        assert_eq!(effects, list(""), "{line}");
        listed(&mut desk, "", &["field.kml", "plans/", "readme.md"]);
        desk.press("p");
        assert_eq!(desk.key(KeyCode::Tab), list("plans/"), "{line}");
        assert_eq!(desk.line(), format!("{line}plans/"));
        listed(&mut desk, "plans/", &["one.plan", "two.waypoints"]);
        let _ = desk.key(KeyCode::Tab);
        assert!(
            desk.line().starts_with(&format!("{line}plans/one.plan")),
            "{}",
            desk.line()
        );
        let _ = desk.key(KeyCode::Esc);
    }
}

/// The number of damaged files of each format.
const DAMAGED: usize = 60;

/// A text with some characters replaced, removed or inserted. `dice` is the state of a generator, so that every run
/// damages it in the same way.
fn damaged(text: &str, dice: &mut u64) -> String {
    let mut letters: Vec<char> = text.chars().collect();
    let mut below = |most: usize| {
        *dice = dice
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (*dice >> 33) as usize % most.max(1)
    };
    for _ in 0..=below(2) {
        let at = below(letters.len());
        match below(4) {
            0 => letters[at] = char::from(b"0123456789-.eN"[below(14)]),
            1 => drop(letters.remove(at)),
            2 => letters.insert(at, char::from(b"-9e{}[],&;"[below(10)])),
            _ => {
                let end = (at + below(40)).min(letters.len());
                letters.drain(at..end);
            }
        }
    }
    letters.into_iter().collect()
}

#[test]
fn damaged_files_become_drafts_or_a_fault_with_line_and_column() {
    let mut desk = Desk::new();
    for line in [
        "draft add takeoff 20",
        "draft add n 100 e 0",
        "draft add n 100 e 100 up 30 frame terrain",
        "draft jump 3 to 2 times 2",
        "draft add rtl",
        "draft fence polygon n -50 e -50",
        "draft fence corner n 200 e -50",
        "draft fence corner n 200 e 200",
        "draft fence circle 30 out n 60 e 60",
        "draft rally n 20 e 20",
    ] {
        desk.give(line);
    }
    let endings = ["plan", "kml", "geojson"];
    let texts = endings.map(|ending| written(&desk.give(&format!("draft save whole.{ending}"))));
    let mut dice = 7;
    let (mut opened, mut refused) = (0, 0);
    for (path, text) in texts {
        for _ in 0..DAMAGED {
            desk.read(&path, &damaged(&text, &mut dice));
            let severity = desk.app.state().message().map(|it| it.severity);
            if severity == Some(Severity::Error) {
                refused += 1;
                let place = desk.said()[path.len() + 1..].to_owned();
                let numbers = place
                    .split(':')
                    .take(2)
                    .map(|it| it.trim().parse::<usize>());
                assert!(
                    numbers.into_iter().all(|it| it.is_ok_and(|it| it > 0)),
                    "{place}"
                );
            } else {
                opened += 1;
            }
            desk.press("2jkz3j1jkz");
            let state = desk.app.state();
            let document = Arc::clone(desk.room().drafts().current().expect("a draft").document());
            drop(findings(state, &document));
            drop(crate::draft::profile(
                &document,
                pace(state),
                desk.room().ground(),
            ));
            drop(desk.room().drawn());
        }
    }
    assert!(
        opened > 20 && refused > 20,
        "{opened} opened, {refused} refused"
    );
}
