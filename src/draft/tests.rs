use std::sync::Arc;

use proptest::prelude::*;

use super::*;
use crate::geo::{LatLon, Terrain};
use crate::plan::edit::HeightChange;
use crate::plan::effort::Pace;
use crate::plan::{Fence, Home, Item, ListKind, command};

const HOME: LatLon = LatLon::new(50.45, 30.52);

fn around() -> Surroundings {
    let (x, y) = HOME.to_e7();
    Surroundings {
        cursor: Some(HOME.moved(100.0, 0.0)),
        home: Some(Home { x, y, z: 170.0 }),
        ground: Terrain::default(),
    }
}

fn at(north_m: f64, east_m: f64) -> Spot {
    Spot::FromHome { north_m, east_m }
}

fn waypoint(spot: impl Into<Option<Spot>>) -> Edit {
    Edit::Plan(PlanEdit::Add {
        item: NewItem {
            spot: spot.into(),
            ..NewItem::new(command::WAYPOINT)
        },
        at: Insertion::Last,
    })
}

fn takeoff(height_m: f32) -> Edit {
    Edit::Plan(PlanEdit::Add {
        item: NewItem {
            height_m: Some(height_m),
            ..NewItem::new(command::TAKEOFF)
        },
        at: Insertion::Last,
    })
}

fn drawn(edits: &[Edit]) -> Draft {
    let mut draft = Draft::new("test", Arc::default(), None);
    for edit in edits {
        draft.edit(edit, &around()).expect("possible");
    }
    draft
}

/// A square of 100 m with a takeoff and a return.
fn square() -> Vec<Edit> {
    let rtl = Edit::Plan(PlanEdit::Add {
        item: NewItem::new(command::RETURN_TO_LAUNCH),
        at: Insertion::Last,
    });
    vec![
        takeoff(20.0),
        waypoint(at(100.0, 0.0)),
        waypoint(at(100.0, 100.0)),
        waypoint(at(0.0, 100.0)),
        rtl,
    ]
}

#[test]
fn new_items_take_what_they_lack_from_those_before() {
    let draft = drawn(&[takeoff(25.0), waypoint(None)]);
    let document = draft.document();
    let [first, second] = [document.plan[0], document.plan[1]];
    assert_eq!((first.x, first.y, first.z), (0, 0, 25.0), "straight up");
    assert_eq!(second.z as i32, 25, "the height of the takeoff");
    assert_eq!((second.x, second.y), HOME.moved(100.0, 0.0).to_e7());
    assert_eq!(
        document.home.map(|home| home.z),
        Some(170.0),
        "the vehicle's home"
    );
}

#[test]
fn the_profile_has_lengths_times_and_slopes() {
    let mut edits = square();
    edits.push(Edit::Items {
        list: ListKind::Plan,
        items: Items { first: 3, last: 3 },
        change: ItemsChange::Height(HeightChange::To(30.0)),
    });
    let draft = drawn(&edits);
    let course = profile(draft.document(), Pace::default(), &Terrain::default());
    let [up, north, east, south, home] = course.stops[..] else {
        panic!("five stops: {course:?}");
    };
    assert_eq!((up.leg_m, up.climb_m, up.leg_s), (0.0, 20.0, 8.0));
    assert!((north.leg_m - 100.0).abs() < 0.1 && (north.leg_s - 16.5).abs() < 0.1);
    assert!((east.slope_percent().expect("a slope") - 10.0).abs() < 0.1);
    assert!((south.climb_m + 10.0).abs() < 0.01);
    assert!(home.lands && (home.leg_m - 100.0).abs() < 0.1);
    assert!((course.length_m - 400.0).abs() < 0.5);
    // The vehicle accelerates again on each leg, as the corners are right angles; the return waits, and lands slowly.
    let return_s = 10.0 + 10.0 + 10.0 / 1.5 + 10.0 / 0.5 + 2.0;
    assert!(
        (course.time_s - (8.0 + 3.0 * 16.5 + return_s)).abs() < 0.1,
        "{}",
        course.time_s
    );
    assert!(!course.repeats);
}

#[test]
fn a_speed_in_the_plan_counts_from_there_on() {
    let mut edits = square();
    let slow = NewItem {
        params: [0.0, 5.0, 0.0, 0.0],
        ..NewItem::new(command::DO_CHANGE_SPEED)
    };
    edits.push(Edit::Plan(PlanEdit::Add {
        item: slow,
        at: Insertion::Before(3),
    }));
    let course = profile(
        drawn(&edits).document(),
        Pace::default(),
        &Terrain::default(),
    );
    let legs: Vec<f64> = course.stops.iter().map(|stop| stop.leg_s.round()).collect();
    assert_eq!(legs[1..4], [17.0, 25.0, 25.0]);
}

/// Turns are as slow as the vehicle flies them, and a landing slows down near the ground.
#[test]
fn turns_and_landings_take_the_time_that_they_take_in_flight() {
    let item = |command, params: [f32; 4]| {
        let item = NewItem {
            params,
            height_m: Some(30.0),
            ..NewItem::new(command)
        };
        Edit::Plan(PlanEdit::Add {
            item,
            at: Insertion::Last,
        })
    };
    let draft = drawn(&[
        item(command::TAKEOFF, [0.0; 4]),
        item(command::LOITER_TURNS, [2.0, 0.0, 25.0, 0.0]),
        item(command::LAND, [0.0; 4]),
    ]);
    let course = profile(draft.document(), Pace::default(), &Terrain::default());
    let legs: Vec<f64> = course.stops.iter().map(|stop| stop.leg_s.round()).collect();
    // 100 m from rest, and two turns of 28 s.
    assert_eq!(legs, [12.0, 73.0, 33.0]);
}

#[test]
fn jumps_lead_to_the_same_item_after_every_change() {
    let mut edits = square();
    let jump = NewItem {
        params: [3.0, 2.0, 0.0, 0.0],
        ..NewItem::new(command::DO_JUMP)
    };
    edits.push(Edit::Plan(PlanEdit::Add {
        item: jump,
        at: Insertion::After(4),
    }));
    edits.push(Edit::Plan(PlanEdit::Add {
        item: NewItem::new(command::WAYPOINT),
        at: Insertion::Before(2),
    }));
    edits.push(Edit::Items {
        list: ListKind::Plan,
        items: Items::one(1),
        change: ItemsChange::Delete,
    });
    edits.push(Edit::Plan(PlanEdit::Split(2)));
    let draft = drawn(&edits);
    let plan = &draft.document().plan;
    let jump = plan.iter().find(|item| item.command == command::DO_JUMP);
    let target = jump.expect("a jump").params[0] as usize;
    assert_eq!(
        plan[target - 1].point().to_e7(),
        HOME.moved(100.0, 100.0).to_e7()
    );
    assert!(profile(draft.document(), Pace::default(), &Terrain::default()).repeats);
    let into = Edit::Items {
        list: ListKind::Plan,
        items: Items::one(target),
        change: ItemsChange::Delete,
    };
    let reason = draft.clone().edit(&into, &around()).expect_err("a target");
    assert!(reason.to_string().contains("jump"), "{reason}");
}

#[test]
fn a_range_moves_as_a_whole() {
    let mut draft = drawn(&square());
    let edit = Edit::Items {
        list: ListKind::Plan,
        items: Items { first: 2, last: 4 },
        change: ItemsChange::Place(Spot::FromHome {
            north_m: 150.0,
            east_m: 50.0,
        }),
    };
    draft.edit(&edit, &around()).expect("possible");
    let offsets: Vec<(i32, i32)> = draft.document().plan[1..4]
        .iter()
        .map(|item| HOME.offset_to(item.point()))
        .map(|(north_m, east_m)| (north_m.round() as i32, east_m.round() as i32))
        .collect();
    assert_eq!(offsets, [(150, 50), (150, 150), (50, 150)]);
}

#[test]
fn a_frame_changes_the_number_only_towards_sea_level() {
    let mut draft = drawn(&square());
    let frame = |frame| {
        Edit::Plan(PlanEdit::Frame {
            items: Items { first: 2, last: 2 },
            frame,
        })
    };
    let height = |draft: &Draft| (draft.document().plan[1].frame, draft.document().plan[1].z);
    draft
        .edit(&frame(PlanFrame::Sea), &around())
        .expect("home is known");
    assert_eq!(height(&draft), (0, 190.0));
    draft
        .edit(&frame(PlanFrame::Home), &around())
        .expect("home is known");
    assert_eq!(height(&draft), (3, 20.0));
    draft
        .edit(&frame(PlanFrame::Terrain), &around())
        .expect("level ground");
    assert_eq!(height(&draft), (10, 20.0));
    draft
        .edit(&frame(PlanFrame::Sea), &around())
        .expect("level ground");
    assert_eq!(height(&draft), (0, 190.0));
    let nowhere = Surroundings {
        home: None,
        ..around()
    };
    let document = Document {
        home: None,
        ..Document::clone(draft.document())
    };
    let to_home = frame(PlanFrame::Home);
    assert!(to_home.apply(&document, &nowhere).is_err(), "no home");
}

#[test]
fn parameters_are_set_by_name_and_commands_change_in_place() {
    let mut draft = drawn(&square());
    let set = |name: &str, value| Edit::Items {
        list: ListKind::Plan,
        items: Items { first: 2, last: 4 },
        change: ItemsChange::Set {
            field: name.to_owned(),
            value,
        },
    };
    draft
        .edit(&set("hold", 5.0), &around())
        .expect("waypoints hold");
    assert!(
        draft.document().plan[1..4]
            .iter()
            .all(|item| item.params[0] as i32 == 5)
    );
    let reason = draft.edit(&set("turns", 2.0), &around()).expect_err("none");
    assert!(reason.to_string().contains("hold"), "{reason}");
    let turns = Edit::Plan(PlanEdit::Command {
        item: 3,
        command: command::LOITER_TURNS,
    });
    let before = draft.document().plan[2];
    draft.edit(&turns, &around()).expect("possible");
    let after = draft.document().plan[2];
    assert_eq!((after.x, after.y, after.z), (before.x, before.y, before.z));
    assert_eq!(after.params.map(|it| it as i32), [1, 0, 0, 0], "one turn");
}

fn corner(north_m: f64, east_m: f64, after: Option<usize>) -> Edit {
    Edit::Fence(FenceEdit::Corner {
        spot: Spot::FromHome { north_m, east_m },
        after,
    })
}

#[test]
fn fences_are_drawn_corner_by_corner() {
    let mut draft = drawn(&[
        corner(-100.0, -100.0, None),
        corner(100.0, -100.0, Some(1)),
        corner(100.0, 100.0, Some(2)),
        corner(-100.0, 100.0, Some(3)),
        Edit::Fence(FenceEdit::Circle {
            keeps_in: false,
            spot: Spot::Cursor,
            radius_m: 10.0,
        }),
        // After a circle, a corner is added to the last polygon.
        corner(-120.0, 0.0, Some(5)),
    ]);
    let fence = Fence::check(&draft.document().fence).expect("valid");
    assert_eq!(fence.areas.len(), 2);
    assert_eq!(areas(&draft.document().fence), [0..5, 5..6]);
    let gone = Edit::Items {
        list: ListKind::Fence,
        items: Items::one(2),
        change: ItemsChange::Delete,
    };
    draft.edit(&gone, &around()).expect("possible");
    draft
        .edit(&Edit::Fence(FenceEdit::Flip(1)), &around())
        .expect("possible");
    let fence = Fence::check(&draft.document().fence).expect("valid");
    assert!(fence.areas.iter().all(|area| !area.keeps_in));
    let wider = Edit::Items {
        list: ListKind::Fence,
        items: Items::one(5),
        change: ItemsChange::Height(HeightChange::By(5.0)),
    };
    draft.edit(&wider, &around()).expect("a circle");
    assert_eq!(draft.document().fence[4].params[0] as i32, 15);
}

#[test]
fn places_that_are_not_known_are_refused() {
    let nothing = Surroundings::default();
    let document = Document::default();
    for edit in [waypoint(None), waypoint(at(10.0, 0.0))] {
        assert!(edit.apply(&document, &nothing).is_err(), "{edit:?}");
    }
    for items in [Items::one(0), Items::one(1), Items { first: 3, last: 2 }] {
        let edit = Edit::Items {
            list: ListKind::Plan,
            items,
            change: ItemsChange::Delete,
        };
        assert!(edit.apply(&document, &nothing).is_err(), "{edit:?}");
    }
}

#[test]
fn drafts_are_chosen_by_name_and_in_order() {
    let mut drafts = Drafts::default();
    let named = |name: &str| Draft::new(name, Arc::default(), None);
    drafts.put([named("north"), named("south")]);
    assert_eq!(drafts.current().map(Draft::name), Some("north"));
    drafts.turn(-1);
    assert_eq!(drafts.current().map(Draft::name), Some("south"));
    assert_eq!(drafts.free_name("south"), "south-2");
    assert!(!drafts.choose("east") && drafts.choose("north"));
    drafts.close();
    assert_eq!(drafts.current().map(Draft::name), Some("south"));
    drafts.close();
    drafts.close();
    assert!(drafts.current().is_none());
}

/// Changes that may or may not be possible.
fn any_edit() -> impl Strategy<Value = Edit> {
    let items = || (0..8usize, 0..8usize).prop_map(|(first, last)| Items { first, last });
    let list = || prop::sample::select(ListKind::ALL.to_vec());
    let jump = (0..8u8).prop_map(|to| {
        Edit::Plan(PlanEdit::Add {
            item: NewItem {
                params: [f32::from(to), 1.0, 0.0, 0.0],
                ..NewItem::new(command::DO_JUMP)
            },
            at: Insertion::Last,
        })
    });
    prop_oneof![
        (-90.0..90.0, -90.0..90.0).prop_map(|(n, e)| waypoint(at(n, e))),
        jump,
        (list(), items()).prop_map(|(list, items)| Edit::Items {
            list,
            items,
            change: ItemsChange::Delete
        }),
        (items(), 0..8usize).prop_map(|(items, to)| Edit::Plan(PlanEdit::Reorder { items, to })),
        (0..8usize).prop_map(|number| Edit::Plan(PlanEdit::Split(number))),
        (list(), items()).prop_map(|(list, items)| Edit::Items {
            list,
            items,
            change: ItemsChange::Shift {
                north_m: 5.0,
                east_m: -5.0
            }
        }),
        (0..8usize).prop_map(|after| corner(1.0, 2.0, Some(after))),
        (0..8usize).prop_map(|number| Edit::Fence(FenceEdit::Flip(number))),
        Just(Edit::Fence(FenceEdit::Polygon {
            keeps_in: false,
            corners: vec![Spot::Cursor]
        })),
        Just(Edit::Rally {
            spot: Spot::Cursor,
            height_m: None
        }),
    ]
}

proptest! {
    #[test]
    fn every_change_can_be_undone_and_redone(edits in proptest::collection::vec(any_edit(), 0..40)) {
        let mut draft = Draft::new("test", Arc::default(), None);
        let mut contents = vec![Arc::clone(draft.document())];
        for edit in &edits {
            if draft.edit(edit, &around()).is_ok() {
                contents.push(Arc::clone(draft.document()));
            }
        }
        for before in contents.iter().rev().skip(1) {
            prop_assert!(draft.undo());
            prop_assert!(draft.document().is_same(before));
        }
        prop_assert!(!draft.undo());
        for after in contents.iter().skip(1) {
            prop_assert!(draft.redo());
            prop_assert!(draft.document().is_same(after));
        }
        prop_assert!(!draft.redo());
    }

    #[test]
    fn corners_always_count_their_polygon(edits in proptest::collection::vec(any_edit(), 0..40)) {
        let mut draft = Draft::new("test", Arc::default(), None);
        for edit in &edits {
            draft.edit(edit, &around()).ok();
        }
        let fence: &[Item] = &draft.document().fence;
        for area in areas(fence) {
            for item in fence[area.clone()].iter().filter(|it| command::is_corner(it.command)) {
                prop_assert_eq!(item.params[0] as usize, area.len());
            }
        }
    }
}
