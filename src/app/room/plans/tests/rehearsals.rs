//! Drafts flown together in simulation.

use super::area::{draw_field, standing};
use super::*;
use crate::draft::{PlanVerdict, Trial, TrialDraft, TrialFlight, TrialPilot};
use crate::plan::ContentHash;
use crate::rehearsal::{FlightEnding, Flown};
use crate::text::Text;

/// A plan on board counts as failed if it failed as a draft.
#[test]
fn a_failed_rehearsal_of_drafts_makes_the_start_of_their_plans_dangerous() {
    let mut desk = Desk::new();
    standing(&mut desk, 1);
    draw_field(&mut desk);
    desk.give("draft survey 1");
    let plan = desk.room().items().to_vec();
    let content = std::iter::once(Item::default()).chain(plan.clone());
    let content = Arc::new(Plan {
        items: content.collect(),
        home_first: true,
    });
    desk.vehicle(1, |vehicle| {
        read_empty(vehicle);
        vehicle.plans.plan.content = Some(content);
    });
    let verdict = |failure: Option<&str>| Tried {
        text: "conflicts: 1".into(),
        is_sound: failure.is_none(),
        is_awaited: true,
        verdicts: vec![PlanVerdict {
            plan: ContentHash::of(&plan),
            failure: failure.map(Text::verbatim),
        }],
        ..Tried::default()
    };
    let _ = desk.app.update(Event::Tried(verdict(Some("meets 2"))));
    assert!(desk.give("1 plan start").is_empty());
    let asked = matches!(desk.app.state().overlay(), Some(Overlay::Confirm(_)));
    assert!(asked, "{}", desk.said());
    let _ = desk.key(KeyCode::Esc);
    let _ = desk.app.update(Event::Tried(verdict(None)));
    assert_eq!(desk.give("1 plan start").len(), 1, "{}", desk.said());
}

#[test]
fn drafts_fly_together_before_an_upload() {
    let mut desk = Desk::new();
    assert!(desk.give("draft rehearse").is_empty(), "nothing to fly");
    let _ = desk.key(KeyCode::Esc);
    standing(&mut desk, 1);
    standing(&mut desk, 2);
    draw_field(&mut desk);
    let divided = desk.give("draft survey all");
    let [Effect::TryDrafts(first)] = &divided[..] else {
        panic!("{divided:?}");
    };
    assert!(!first.is_apart && !first.is_awaited, "{first:?}");
    desk.press("R");
    assert_eq!(desk.line(), "draft rehearse");
    let effects = desk.key(KeyCode::Enter);
    let [Effect::TryDrafts(trial)] = &effects[..] else {
        panic!("{effects:?}");
    };
    let names: Vec<&str> = trial.drafts.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["vehicle-1", "vehicle-2"], "the field has no plan");
    let longer = Arc::clone(&trial.drafts[1].document);
    let tried = Tried {
        text: "vehicle-1 starts later".into(),
        is_sound: true,
        is_awaited: true,
        changed: vec![TrialDraft {
            name: "vehicle-1".to_owned(),
            sharer: None,
            document: Arc::clone(&longer),
            source: Arc::clone(&trial.drafts[0].source),
        }],
        ..Tried::default()
    };
    let before = desk.plan();
    let _ = desk.app.update(Event::Tried(tried));
    assert_eq!(desk.plan().len(), longer.plan.len());
    let shown = desk.room().tried().expect("the outcome");
    assert!(shown.text.contains("starts later"), "{shown:?}");
    desk.press("u");
    assert_eq!(desk.plan(), before);
    assert!(desk.room().tried().is_none(), "the draft is another one");
}

#[test]
fn a_draft_for_a_plane_is_not_flown_as_a_copter() {
    let mut desk = Desk::new();
    standing(&mut desk, 1);
    desk.vehicle(2, |vehicle| {
        read_empty(vehicle);
        let class = VehicleClass::Plane;
        vehicle.heartbeat = Some(Heartbeat {
            mav_type: 1,
            autopilot: 3,
            class,
            mode: Mode { class, number: 0 },
            armed: false,
            status: SystemStatus::Standby,
            at: std::time::Duration::ZERO,
        });
    });
    desk.give("draft add takeoff 20");
    desk.give("draft add n 50 e 0 up 20");
    desk.give("select 2");
    let words = "a rehearsal can fly copters only";
    for line in ["draft rehearse", "draft rehearse 2", "draft rehearse 1-2"] {
        assert!(desk.give(line).is_empty(), "{line}");
        assert!(refusal(&desk).contains(words), "{line}: {}", refusal(&desk));
        let _ = desk.key(KeyCode::Esc);
    }
    assert_eq!(desk.give("draft rehearse 1").len(), 1, "{}", desk.said());
    desk.give("draft take 2");
    desk.give("draft add n 50 e 0 up 20");
    assert!(desk.give("draft rehearse").is_empty());
    assert!(refusal(&desk).contains(words), "{}", refusal(&desk));
}

/// Why the line was refused.
fn refusal(desk: &Desk) -> String {
    match desk.app.state().overlay() {
        Some(Overlay::Palette(palette)) => palette.fault().map(|it| it.message.to_string()),
        _ => None,
    }
    .unwrap_or_default()
}

/// A draft shared by several vehicles is flown by each of them, from its own position.
#[test]
fn a_shared_draft_is_flown_by_each_vehicle_that_would_get_it() {
    let mut desk = Desk::new();
    for id in [1, 2, 3] {
        standing(&mut desk, id);
    }
    desk.give("draft add takeoff 20");
    desk.give("draft add n 50 e 0 up 20");
    let flown = |effects: &[Effect]| -> Vec<(String, Option<VehicleId>)> {
        let [Effect::TryDrafts(trial)] = effects else {
            panic!("{effects:?}");
        };
        let places = trial
            .drafts
            .iter()
            .map(|it| it.document.home.map(|home| home.y));
        let places: std::collections::BTreeSet<Option<i32>> = places.collect();
        assert_eq!(places.len(), trial.drafts.len(), "each from its own place");
        let names = trial.drafts.iter();
        names.map(|it| (it.name.clone(), it.sharer)).collect()
    };
    let own = |id: VehicleId| (format!("vehicle-{id}"), Some(id));
    let one = flown(&desk.give("draft rehearse"));
    assert_eq!(one, [("plan".to_owned(), None)], "no vehicle is selected");
    assert_eq!(flown(&desk.give("draft rehearse 1,3")), [own(1), own(3)]);
    desk.give("select all");
    let all = desk.give("draft deconflict");
    assert_eq!(flown(&all), [own(1), own(2), own(3)]);
    let [Effect::TryDrafts(trial)] = &all[..] else {
        panic!("{all:?}");
    };
    let tried = Tried {
        text: "vehicle-2 starts later".into(),
        is_sound: true,
        is_awaited: true,
        changed: trial.drafts.clone(),
        ..Tried::default()
    };
    let _ = desk.app.update(Event::Tried(tried));
    let drafts = desk.room().drafts().all().iter();
    let vehicles: Vec<Option<VehicleId>> = drafts.map(Draft::vehicle).collect();
    assert_eq!(vehicles, [None, Some(1), Some(2), Some(3)]);
    let again = flown(&desk.give("draft rehearse"));
    assert_eq!(again.len(), 3, "{again:?}");
}

/// The drafts and vehicles that a line leaves out of a rehearsal.
fn left_out(effects: &[Effect]) -> Option<String> {
    let [Effect::TryDrafts(trial)] = effects else {
        panic!("{effects:?}");
    };
    trial.left_out.as_ref().map(Text::to_string)
}

/// Drafts and vehicles that a rehearsal leaves out are named with the reason.
#[test]
fn what_is_not_flown_is_named() {
    let mut desk = Desk::new();
    for id in [1, 2] {
        standing(&mut desk, id);
    }
    for name in ["north", "south"] {
        desk.give(&format!("draft new {name}"));
        desk.give("draft add takeoff 20");
    }
    assert_eq!(left_out(&desk.give("draft rehearse")), None, "both fly");
    desk.give("select all");
    let shared = left_out(&desk.give("draft rehearse")).expect("a note");
    assert!(shared.contains("north (the selected"), "{shared}");
    let divided = desk.give("draft orbit 1 around tower radius 60");
    assert_eq!(left_out(&divided), None, "the draft that was divided");
    let unassigned = left_out(&desk.give("draft rehearse")).expect("a note");
    assert!(unassigned.contains("north, south"), "{unassigned}");
    assert!(unassigned.contains("`draft use north`"), "{unassigned}");
    let idle = left_out(&desk.give("draft rehearse 1-2")).expect("a note");
    assert!(idle.contains("not flown: 2"), "{idle}");
    assert_eq!(left_out(&desk.give("draft rehearse 1")), None);
}

/// The room shows the outcome among its reports; a message would only repeat it and cover the keys.
#[test]
fn the_outcome_is_no_message_in_the_room() {
    let mut desk = Desk::new();
    let failed = || {
        Event::Tried(Tried {
            text: "plan ends in the air".into(),
            is_awaited: true,
            ..Tried::default()
        })
    };
    let _ = desk.app.update(failed());
    assert_eq!(desk.said(), "");
    let mut lines = desk.app.state().notices().lines();
    assert!(lines.any(|line| line.notice.text.contains("ends in the air")));
    drop(lines);
    desk.press("F");
    let _ = desk.app.update(failed());
    assert_eq!(desk.said(), "plan ends in the air");
}

/// Drafts can change while they are flown in simulation.
#[test]
fn the_outcome_of_drafts_that_have_changed_is_discarded() {
    let mut desk = Desk::new();
    standing(&mut desk, 1);
    desk.give("draft add takeoff 20");
    let effects = desk.give("draft deconflict");
    let [Effect::TryDrafts(trial)] = &effects[..] else {
        panic!("{effects:?}");
    };
    let rehearsed = Trial {
        is_apart: false,
        ..trial.clone()
    };
    let tried = Tried {
        changed: trial.drafts.clone(),
        ..rehearsed.fly()
    };
    assert_eq!(tried.verdicts.len(), 1);
    let flown = desk.room().items().to_vec();
    desk.give("draft add n 50 e 0");
    let _ = desk.app.update(Event::Tried(tried.clone()));
    assert_eq!(desk.plan().len(), 2, "the newer content stays");
    assert!(desk.room().tried().is_none() && desk.room().figures().is_none());
    assert!(desk.said().contains("discarded"), "{}", desk.said());
    // The plan that was flown has failed all the same.
    desk.vehicle(1, |vehicle| {
        read_empty(vehicle);
        vehicle.plans.plan.content = Some(Arc::new(Plan {
            items: std::iter::once(Item::default()).chain(flown).collect(),
            home_first: true,
        }));
    });
    assert!(desk.give("1 plan start").is_empty());
    let _ = desk.key(KeyCode::Esc);
    desk.press("u");
    let _ = desk.app.update(Event::Tried(tried));
    assert!(desk.room().tried().is_some(), "the drafts are as they were");
}

/// The figures scroll to their last line, and one key press back scrolls at once.
#[test]
fn the_figures_scroll_to_their_last_line() {
    let pilot = |ending| TrialPilot {
        name: "plan".to_owned(),
        sharer: None,
        flown: Flown {
            time_s: 60.0,
            energy_used_percent: 10.0,
            farthest_m: 100.0,
            broke_fence_s: None,
            has_fence: false,
            was_kept_armed: false,
            ending,
            moved_east_m: 0.0,
        },
    };
    let top = |count: usize, ending, keys: &str| {
        let mut desk = Desk::new();
        let size = TerminalEvent::Resize {
            columns: 80,
            rows: 24,
        };
        let _ = desk.app.update(Event::from(size));
        let _ = desk.app.update(Event::Tried(Tried {
            is_awaited: true,
            flight: Some(TrialFlight {
                pilots: vec![pilot(ending); count],
                closest: Vec::new(),
            }),
            ..Tried::default()
        }));
        desk.press(keys);
        let visible = layout(desk.app.state().display().grid()).canvas.rows;
        let (_, top) = desk.room().figures().expect("figures");
        (top, usize::from(visible))
    };
    // A heading, and two lines for each draft.
    let (last, visible) = top(20, FlightEnding::InAir, &"j".repeat(60));
    assert_eq!(last + visible, 41);
    let (before, _) = top(20, FlightEnding::InAir, &format!("{}k", "j".repeat(60)));
    assert_eq!(before, last - 1);
    assert_eq!(top(6, FlightEnding::Landed, "jjj").0, 0, "all lines fit");
}
