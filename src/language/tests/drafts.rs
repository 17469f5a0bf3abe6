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
use crate::plan::field::short_plan_words;
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

fn changed(list: ListKind, first: usize, last: usize, change: ItemsChange) -> Edit {
    let items = Items { first, last };
    Edit::Items {
        list,
        items,
        change,
    }
}

#[test]
fn items_are_changed_by_range_and_list() {
    let plan = ListKind::Plan;
    let tower = Spot::At(LatLon::new(50.45, 30.52));
    let shift = ItemsChange::Shift {
        north_m: 20.0,
        east_m: 0.0,
    };
    let hold = ItemsChange::Set {
        field: "hold".to_owned(),
        value: 120.0,
    };
    let height = |change| changed(plan, 2, 6, ItemsChange::Height(change));
    let cases = [
        ("delete 3-5", changed(plan, 3, 5, ItemsChange::Delete)),
        (
            "delete fence 2",
            changed(ListKind::Fence, 2, 2, ItemsChange::Delete),
        ),
        ("move 4 n 20 e 0", changed(plan, 4, 4, shift)),
        (
            "move 4 tower",
            changed(plan, 4, 4, ItemsChange::Place(tower)),
        ),
        (
            "move rally 1",
            changed(ListKind::Rally, 1, 1, ItemsChange::Place(Spot::Cursor)),
        ),
        ("height 6-2 40", height(HeightChange::To(40.0))),
        ("height 2-6 by -5m", height(HeightChange::By(-5.0))),
        ("set 4 hold 2min", changed(plan, 4, 4, hold)),
    ];
    for (line, wanted) in cases {
        assert_eq!(edit(&format!("draft {line}")), wanted, "{line}");
    }
}

#[test]
fn plans_fences_and_rally_points_have_changes_of_their_own() {
    let spot = Spot::FromHome {
        north_m: 10.0,
        east_m: 20.0,
    };
    let frame = PlanEdit::Frame {
        items: Items { first: 2, last: 6 },
        frame: PlanFrame::Terrain,
    };
    let turns = PlanEdit::Command {
        item: 4,
        command: command::LOITER_TURNS,
    };
    let order = PlanEdit::Reorder {
        items: Items { first: 4, last: 5 },
        to: 2,
    };
    let circle = FenceEdit::Circle {
        keeps_in: false,
        spot,
        radius_m: 50.0,
    };
    let rally = Edit::Rally {
        spot,
        height_m: Some(15.0),
    };
    let cases = [
        ("frame 2-6 terrain", Edit::Plan(frame)),
        ("command 4 turns", Edit::Plan(turns)),
        ("split 4", Edit::Plan(PlanEdit::Split(4))),
        ("order 4-5 to 2", Edit::Plan(order)),
        ("fence reverse 3", Edit::Fence(FenceEdit::Flip(3))),
        ("fence circle 50 out n 10 e 20", Edit::Fence(circle)),
        ("rally n 10 e 20 up 15", rally),
        ("home n 10 e 20", Edit::Home(spot)),
    ];
    for (line, wanted) in cases {
        assert_eq!(edit(&format!("draft {line}")), wanted, "{line}");
    }
    let area = edit("draft fence area lane out");
    let Edit::Fence(FenceEdit::Polygon { corners, keeps_in }) = area else {
        panic!("a polygon: {area:?}");
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

#[test]
fn the_guide_lists_the_short_words_of_commands() {
    let guide = include_str!("../../../docs/plans.md");
    let list = guide.split_once("The words of commands are ");
    let list = list.and_then(|(_, rest)| rest.split_once("; Tab completes"));
    let (list, _) = list.expect("the list of words");
    let written: Vec<&str> = list.split('`').skip(1).step_by(2).collect();
    let known: Vec<&str> = short_plan_words().collect();
    assert_eq!(written, known);
}
