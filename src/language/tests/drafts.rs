//! Lines about drafts.

use super::{context, groups, places};
use crate::draft::{
    Edit, FenceEdit, Insertion, Items, ItemsChange, NewItem, PlanEdit, PlanFrame, Spot,
};
use crate::geo::LatLon;
use crate::language::{
    Channel, ConsoleLine, Context, DraftLine, Meaning, VehicleChoice, parse, row,
};
use crate::plan::edit::HeightChange;
use crate::plan::{ListKind, command};

fn read(line: &str) -> Result<DraftLine, String> {
    let (groups, places) = (groups(), places());
    let context = Context {
        channel: Channel::Screen,
        ..context(&groups, &places)
    };
    match parse(line, &context).map(|statement| statement.meaning) {
        Ok(Meaning::Console(ConsoleLine::Draft(line))) => Ok(line),
        Ok(other) => Err(format!("{other:?}")),
        Err(fault) => Err(fault.message.to_string()),
    }
}

fn edit(line: &str) -> Edit {
    match read(line) {
        Ok(DraftLine::Edit(edit)) => edit,
        other => panic!("{line}: {other:?}"),
    }
}

fn added(line: &str) -> (NewItem, Insertion) {
    match edit(line) {
        Edit::Plan(PlanEdit::Add { item, at }) => (item, at),
        other => panic!("{line}: {other:?}"),
    }
}

#[test]
fn items_are_added_by_word_place_and_height() {
    let from_home = |north_m, east_m| Some(Spot::FromHome { north_m, east_m });
    let (item, at) = added("draft add takeoff 30");
    assert_eq!(
        (item.command, item.height_m),
        (command::TAKEOFF, Some(30.0))
    );
    assert_eq!((item.spot, at), (None, Insertion::Last));
    let (item, _) = added("draft add n 100 e 50 up 30 frame terrain");
    assert_eq!(item.spot, from_home(100.0, 50.0));
    assert_eq!(
        (item.command, item.height_m),
        (command::WAYPOINT, Some(30.0))
    );
    assert_eq!(item.frame, Some(PlanFrame::Terrain));
    let (item, _) = added("draft add 50.4501 30.5234");
    assert_eq!(item.spot, Some(Spot::At(LatLon::new(50.4501, 30.5234))));
    let (item, at) = added("draft insert 3 spline tower up 12m");
    assert_eq!(
        (item.command, at),
        (command::SPLINE_WAYPOINT, Insertion::Before(3))
    );
    assert_eq!(item.height_m, Some(12.0));
    let (item, _) = added("draft add");
    assert_eq!(item.spot, None, "the cursor");
    let (item, at) = added("draft jump 6 to 2 times 3");
    assert_eq!(
        (item.params, at),
        ([2.0, 3.0, 0.0, 0.0], Insertion::After(6))
    );
    assert_eq!(added("draft add NAV_LAND").0.command, command::LAND);
}

#[test]
fn items_are_changed_by_range_and_list() {
    let plan = ListKind::Plan;
    let cases = [
        (
            "draft delete 3-5",
            Edit::Items {
                list: plan,
                items: Items { first: 3, last: 5 },
                change: ItemsChange::Delete,
            },
        ),
        (
            "draft delete fence 2",
            Edit::Items {
                list: ListKind::Fence,
                items: Items::one(2),
                change: ItemsChange::Delete,
            },
        ),
        (
            "draft move 4 n 20 e 0",
            Edit::Items {
                list: plan,
                items: Items::one(4),
                change: ItemsChange::Shift {
                    north_m: 20.0,
                    east_m: 0.0,
                },
            },
        ),
        (
            "draft move 4 tower",
            Edit::Items {
                list: plan,
                items: Items::one(4),
                change: ItemsChange::Place(Spot::At(LatLon::new(50.45, 30.52))),
            },
        ),
        (
            "draft move rally 1",
            Edit::Items {
                list: ListKind::Rally,
                items: Items::one(1),
                change: ItemsChange::Place(Spot::Cursor),
            },
        ),
        (
            "draft height 2-6 40",
            Edit::Items {
                list: plan,
                items: Items { first: 2, last: 6 },
                change: ItemsChange::Height(HeightChange::To(40.0)),
            },
        ),
        (
            "draft height 2-6 by -5m",
            Edit::Items {
                list: plan,
                items: Items { first: 2, last: 6 },
                change: ItemsChange::Height(HeightChange::By(-5.0)),
            },
        ),
        (
            "draft frame 2-6 terrain",
            Edit::Plan(PlanEdit::Frame {
                items: Items { first: 2, last: 6 },
                frame: PlanFrame::Terrain,
            }),
        ),
        (
            "draft set 4 hold 2min",
            Edit::Items {
                list: plan,
                items: Items::one(4),
                change: ItemsChange::Set {
                    field: "hold".to_owned(),
                    value: 120.0,
                },
            },
        ),
        (
            "draft command 4 turns",
            Edit::Plan(PlanEdit::Command {
                item: 4,
                command: command::LOITER_TURNS,
            }),
        ),
        ("draft split 4", Edit::Plan(PlanEdit::Split(4))),
        (
            "draft order 4-5 to 2",
            Edit::Plan(PlanEdit::Reorder {
                items: Items { first: 4, last: 5 },
                to: 2,
            }),
        ),
        ("draft fence reverse 3", Edit::Fence(FenceEdit::Flip(3))),
        (
            "draft fence circle 50 out n 10 e 20",
            Edit::Fence(FenceEdit::Circle {
                keeps_in: false,
                spot: Spot::FromHome {
                    north_m: 10.0,
                    east_m: 20.0,
                },
                radius_m: 50.0,
            }),
        ),
        (
            "draft rally n 10 e 20 up 15",
            Edit::Rally {
                spot: Spot::FromHome {
                    north_m: 10.0,
                    east_m: 20.0,
                },
                height_m: Some(15.0),
            },
        ),
    ];
    for (line, wanted) in cases {
        assert_eq!(edit(line), wanted, "{line}");
    }
    let Edit::Fence(FenceEdit::Polygon { corners, keeps_in }) = edit("draft fence area lane out")
    else {
        panic!("a polygon");
    };
    assert_eq!((corners.len(), keeps_in), (4, false));
}

#[test]
fn drafts_are_opened_and_uploaded_by_lines() {
    assert_eq!(read("draft"), Ok(DraftLine::Show));
    assert_eq!(read("draft new"), Ok(DraftLine::New(None)));
    let name = || Some("survey".to_owned());
    assert_eq!(read("draft new survey"), Ok(DraftLine::New(name())));
    assert_eq!(
        read("draft open my survey.plan"),
        Ok(DraftLine::Open("my survey.plan".to_owned()))
    );
    assert_eq!(read("draft save"), Ok(DraftLine::Save(None)));
    assert_eq!(read("draft upload"), Ok(DraftLine::Upload(None)));
    let some = VehicleChoice::Ids(vec![1, 2]);
    assert_eq!(read("draft upload 1-2"), Ok(DraftLine::Upload(Some(some))));
    assert_eq!(read("draft upload each"), Ok(DraftLine::UploadEach));
    assert_eq!(read("draft speed 8m/s"), Ok(DraftLine::Speed(Some(8.0))));
    assert_eq!(read("draft speed"), Ok(DraftLine::Speed(None)));
}

#[test]
fn faults_name_what_is_wrong() {
    for line in [
        "draft delete",
        "draft delete x",
        "draft delete 0",
        "draft set 4 hold 5m",
        "draft set 4 nothing 5",
        "draft set 4 hold",
        "draft command 4 fly-away",
        "draft frame 2 moon",
        "draft height 2",
        "draft add takeoff high",
        "draft jump 3",
        "draft fence",
    ] {
        assert!(read(line).is_err(), "{line}");
    }
}

#[test]
fn every_example_can_be_read() {
    for example in row("draft").expect("a verb").examples {
        assert!(read(example).is_ok(), "{example}: {:?}", read(example));
    }
}
