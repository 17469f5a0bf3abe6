//! Drafts that meet, and drafts that stay apart.

use super::*;
use crate::geo::LatLon;
use crate::plan::{Home, Item, command};

const HOME: LatLon = LatLon::new(50.45, 30.52);

/// A flight from one place to another at 20 m, and a landing there.
fn flight(name: &str, from_m: f64, to_m: f64) -> TrialDraft {
    let at = |east_m: f64| HOME.moved(0.0, east_m).to_e7();
    let item = |command, (x, y), z| Item {
        command,
        frame: 3,
        auto_continue: true,
        x,
        y,
        z,
        ..Item::default()
    };
    let (x, y) = at(from_m);
    let document = Document {
        home: Some(Home { x, y, z: 170.0 }),
        plan: vec![
            item(command::TAKEOFF, (0, 0), 20.0),
            item(command::WAYPOINT, at(to_m), 20.0),
            item(command::LAND, at(to_m), 0.0),
        ],
        ..Document::default()
    };
    let document = Arc::new(document);
    TrialDraft {
        name: name.to_owned(),
        sharer: None,
        source: Arc::clone(&document),
        document,
    }
}

#[test]
fn drafts_that_meet_are_found_and_kept_apart() {
    let meeting = vec![flight("east", 0.0, 100.0), flight("west", 100.0, 0.0)];
    let mut trial = Trial {
        drafts: meeting,
        is_apart: false,
        is_awaited: true,
        left_out: None,
    };
    let tried = trial.fly();
    assert!(!tried.is_sound && tried.changed.is_empty());
    let failures = tried.verdicts.iter().map(|it| it.failure.as_ref());
    assert_eq!(failures.flatten().count(), 2, "both meet: {tried:?}");
    assert!(tried.text.to_string().contains("east"), "{}", tried.text);
    trial.is_apart = true;
    let tried = trial.fly();
    assert!(tried.is_sound, "{}", tried.text);
    assert_eq!(tried.changed.len(), 1);
    trial
        .drafts
        .retain(|draft| draft.name != tried.changed[0].name);
    trial.drafts.extend(tried.changed);
    trial.is_apart = false;
    let again = trial.fly();
    assert!(again.is_sound, "{}", again.text);
    assert!(again.verdicts.iter().all(|it| it.failure.is_none()));
}

/// Vehicles that fly the same plan meet at its first place; a change gives each a draft of its own.
#[test]
fn a_shared_draft_is_flown_and_changed_for_each_vehicle() {
    let shared = |id: VehicleId| {
        let flown = flight(&format!("vehicle-{id}"), 8.0 * f64::from(id), 100.0);
        let mut document = Document::clone(&flown.document);
        if let Some(last) = document.plan.last_mut() {
            last.command = command::RETURN_TO_LAUNCH;
        }
        TrialDraft {
            sharer: Some(id),
            document: Arc::new(document),
            ..flown
        }
    };
    let mut trial = Trial {
        drafts: vec![shared(1), shared(2), shared(3)],
        is_apart: false,
        is_awaited: true,
        left_out: None,
    };
    let tried = trial.fly();
    let said = tried.text.to_string();
    assert!(!tried.is_sound && said.contains("3 conflicts"), "{said}");
    trial.is_apart = true;
    let tried = trial.fly();
    assert!(tried.is_sound, "{}", tried.text);
    let changed = tried.changed.iter().map(|draft| draft.sharer);
    assert_eq!(changed.collect::<Vec<_>>(), [Some(1), Some(2), Some(3)]);
    trial.drafts = tried.changed;
    trial.is_apart = false;
    let again = trial.fly();
    assert!(again.is_sound, "{}", again.text);
}

#[test]
fn all_pairs_that_come_too_close_are_named() {
    let drafts = [
        ("a", 0.0, 100.0),
        ("b", 100.0, 0.0),
        ("c", 1000.0, 1100.0),
        ("d", 1100.0, 1000.0),
    ];
    let trial = Trial {
        drafts: drafts.map(|(name, from, to)| flight(name, from, to)).into(),
        is_apart: false,
        is_awaited: true,
        left_out: None,
    };
    let tried = trial.fly();
    let text = tried.text.to_string();
    assert!(text.contains("a + b") && text.contains("c + d"), "{text}");
    assert_eq!(tried.details.len(), 2);
    assert!(
        text.starts_with("2 conflicts: ") && text.len() < 80,
        "{text}"
    );
}

/// The text names one failure and counts the others; the failures of vehicles that collide are part
/// of their conflict.
#[test]
fn further_failures_are_counted() {
    let endless = |name, from_m| {
        let flown = flight(name, from_m, from_m + 60.0);
        let mut document = Document::clone(&flown.document);
        document.plan.pop();
        TrialDraft {
            document: Arc::new(document),
            ..flown
        }
    };
    let mut trial = Trial {
        drafts: vec![
            flight("sound", 0.0, 60.0),
            endless("first", 1000.0),
            endless("second", 2000.0),
            endless("third", 3000.0),
        ],
        is_apart: false,
        is_awaited: true,
        left_out: Some(Text::verbatim("left out: north")),
    };
    let tried = trial.fly();
    assert_eq!(tried.further, 2, "{}", tried.text);
    let words = tried.words().to_string();
    assert!(words.starts_with("first ends in the air"), "{words}");
    assert!(
        words.ends_with("; 2 more drafts fail; left out: north"),
        "{words}"
    );
    trial.drafts = vec![
        flight("east", 0.0, 100.0),
        flight("west", 100.0, 0.0),
        endless("first", 1000.0),
    ];
    let tried = trial.fly();
    assert_eq!(tried.further, 1, "{}", tried.text);
}

#[test]
fn drafts_that_are_apart_stay_as_they_are() {
    let trial = Trial {
        drafts: vec![flight("north", 0.0, 60.0), flight("south", 200.0, 300.0)],
        is_apart: true,
        is_awaited: true,
        left_out: None,
    };
    let tried = trial.fly();
    assert!(tried.is_sound && tried.changed.is_empty(), "{}", tried.text);
}
