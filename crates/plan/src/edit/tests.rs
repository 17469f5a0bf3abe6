use proptest::prelude::*;

use super::*;

/// A waypoint identified by its height.
fn waypoint(number: usize) -> Item {
    Item {
        command: command::WAYPOINT,
        frame: 3,
        auto_continue: true,
        params: [0.0; 4],
        x: 500_000_000 + number as i32 * 10_000,
        y: 300_000_000,
        z: number as f32 + 10.0,
    }
}

fn jump(to: usize) -> Item {
    Item {
        command: command::DO_JUMP,
        params: [to as f32 + 1.0, 3.0, 0.0, 0.0],
        x: 0,
        y: 0,
        z: 0.0,
        ..waypoint(0)
    }
}

/// Waypoints, some of which are replaced by jumps to other items.
fn plans() -> impl Strategy<Value = Vec<Item>> {
    prop::collection::vec(prop::option::of(0..20_usize), 2..15).prop_map(|jumps| {
        let length = jumps.len();
        let item =
            |(at, to): (usize, Option<usize>)| to.map_or(waypoint(at), |to| jump(to % length));
        jumps.into_iter().enumerate().map(item).collect()
    })
}

/// For each item: the height of the item that it jumps to, if any, and its own height.
fn aims(items: &[Item]) -> Vec<(Option<f32>, f32)> {
    let aim = |item: &Item| (target_of(item).map(|to| items[to].z), item.z);
    items.iter().map(aim).collect()
}

proptest! {
    #[test]
    fn jumps_lead_to_the_same_item_after_every_change(items in plans(), a in 0..15_usize, b in 0..15_usize, to in 0..15_usize) {
        let before = aims(&items);
        let at = a % (items.len() + 1);
        let changed = insert(&items, at, &[waypoint(900), waypoint(901)]).expect("it is inside");
        let mut found = aims(&changed);
        found.drain(at..at + 2);
        prop_assert_eq!(&found, &before);
        // Deleting the inserted items restores the list.
        let back = delete(&changed, at..at + 2).expect("nothing jumps there");
        prop_assert_eq!(&back, &items);

        let start = a % items.len();
        let end = start + 1 + b % (items.len() - start);
        let to = to % (items.len() - (end - start) + 1);
        let moved = relocate(&items, start..end, to).expect("it is inside");
        prop_assert_eq!(relocate(&moved, to..to + end - start, start).expect("back"), items.clone());
        let mut found = aims(&moved);
        let taken: Vec<_> = found.drain(to..to + end - start).collect();
        found.splice(start..start, taken);
        prop_assert_eq!(&found, &before);

        match delete(&items, start..end) {
            Ok(shorter) => {
                let mut expected = before;
                expected.drain(start..end);
                prop_assert_eq!(aims(&shorter), expected);
            }
            Err(error) => {
                let EditError::JumpTarget(from) = error else { panic!("{error}") };
                prop_assert!(!(start..end).contains(&from));
                prop_assert!((start..end).contains(&target_of(&items[from]).expect("a jump")));
            }
        }
    }
}

#[test]
fn a_split_leg_has_a_waypoint_in_its_middle() {
    let items = [waypoint(0), jump(2), waypoint(4)];
    let split = super::split(&items, 2).expect("a leg");
    assert_eq!((split[2].x, split[2].z), (500_020_000, 12.0));
    assert_eq!(target_of(&split[1]), Some(3));
    assert_eq!(super::split(&items, 0), Err(EditError::NoLeg));
    let across = [
        Item {
            y: 1_799_999_000,
            ..waypoint(0)
        },
        Item {
            y: -1_799_997_000,
            ..waypoint(2)
        },
    ];
    assert_eq!(
        super::split(&across, 1).expect("a leg")[1].y,
        -1_799_999_000
    );
}

#[test]
fn heights_and_frames_change_only_where_there_is_a_height() {
    let items = [waypoint(0), jump(0), waypoint(1)];
    let higher = change_height(&items, 0..2, HeightChange::By(5.0)).expect("there");
    let heights: Vec<f32> = higher.iter().map(|item| item.z).collect();
    assert_eq!(heights, [15.0, 0.0, 11.0]);
    let home = Some(Home {
        x: 0,
        y: 0,
        z: 170.0,
    });
    let ground = |_: &Item| None;
    let keep = FrameChange::KeepHeights {
        home,
        ground_amsl_m: &ground,
    };
    let above_sea = change_frame(&items, 0..3, 0, &keep).expect("home is known");
    assert_eq!(
        (above_sea[2].frame, above_sea[2].z, above_sea[1].frame),
        (0, 181.0, 3)
    );
    assert_eq!(
        change_frame(&items, 0..1, 10, &keep),
        Err(EditError::UnknownHeight)
    );
    let same = change_frame(&items, 0..1, 10, &FrameChange::KeepNumbers).expect("there");
    assert_eq!((same[0].frame, same[0].z), (10, 10.0));
    assert_eq!(
        change_height(&items, 2..4, HeightChange::To(1.0)),
        Err(EditError::NoItem(3))
    );
}
