//! Written files read back the same, as far as each format can hold them.

use proptest::prelude::*;

use crate::{
    Document, FileFormat, Home, Item, ListKind, ReadOptions, Unwritable, command, read, write,
};

/// A number that a parameter can have in every format, including "not set".
fn parameter() -> impl Strategy<Value = f32> {
    prop_oneof![
        Just(0.0_f32),
        Just(f32::NAN),
        -1000.0..1000.0_f32,
        any::<f32>().prop_filter("finite", |number| number.is_finite()),
    ]
}

fn place() -> impl Strategy<Value = (i32, i32)> {
    prop_oneof![
        Just((0, 0)),
        (-900_000_000..=900_000_000, -1_800_000_000..=1_800_000_000),
    ]
}

fn any_item(commands: impl Strategy<Value = u16>) -> impl Strategy<Value = Item> {
    let params = [parameter(), parameter(), parameter(), parameter()];
    let frames = prop_oneof![
        Just(0),
        Just(3),
        Just(10),
        Just(5),
        Just(6),
        Just(11),
        0..22_u8
    ];
    (
        commands,
        frames,
        any::<bool>(),
        params,
        place(),
        parameter(),
    )
        .prop_map(|(command, frame, auto_continue, params, (x, y), z)| Item {
            command,
            frame,
            auto_continue,
            params,
            x,
            y,
            z,
        })
}

pub(super) fn plan_items() -> impl Strategy<Value = Vec<Item>> {
    let usual = prop_oneof![
        Just(16),
        Just(22),
        Just(20),
        Just(177),
        Just(178),
        Just(201),
        0..4000_u16
    ];
    prop::collection::vec(any_item(usual), 0..12).prop_map(|mut items| {
        let length = items.len();
        for (index, item) in items.iter_mut().enumerate() {
            if item.command == command::DO_JUMP {
                item.params[0] = ((index * 7) % length + 1) as f32;
            }
        }
        items
    })
}

/// Polygons, circles and a return point as `.plan` files store them.
fn whole_fence() -> impl Strategy<Value = Vec<Item>> {
    let item = |command, frame, param1, (x, y), z| Item {
        command,
        frame,
        auto_continue: true,
        params: [param1, 0.0, 0.0, 0.0],
        x,
        y,
        z,
    };
    let polygon = (5001..=5002_u16, prop::collection::vec(place(), 3..7)).prop_map(
        move |(command, corners)| -> Vec<Item> {
            let count = corners.len() as f32;
            corners
                .into_iter()
                .map(|at| item(command, 0, count, at, 0.0))
                .collect()
        },
    );
    let circle = (5003..=5004_u16, place(), 0.1..900.0_f32)
        .prop_map(move |(command, at, radius)| item(command, 0, radius, at, 0.0));
    let back = (place(), -10.0..90.0_f32).prop_map(move |(at, z)| item(5000, 3, 0.0, at, z));
    let polygons = prop::collection::vec(polygon, 0..3);
    let circles = prop::collection::vec(circle, 0..3);
    (polygons, circles, prop::option::of(back)).prop_map(|(polygons, circles, back)| {
        polygons
            .concat()
            .into_iter()
            .chain(circles)
            .chain(back)
            .collect()
    })
}

fn rally() -> impl Strategy<Value = Vec<Item>> {
    let point = (place(), parameter()).prop_map(|((x, y), z)| Item {
        command: command::RALLY_POINT,
        frame: 3,
        auto_continue: true,
        params: [0.0; 4],
        x,
        y,
        z,
    });
    prop::collection::vec(point, 0..4)
}

fn home() -> impl Strategy<Value = Option<Home>> {
    let some = (place(), 1.0..3000.0_f32).prop_map(|((x, y), z)| Home { x, y, z });
    prop::option::of(some)
}

/// A document that every format can hold: it has at least one list, since a file without any is a
/// fault.
pub(super) fn document() -> impl Strategy<Value = Document> {
    let lists = (home(), plan_items(), whole_fence(), rally());
    let document = lists.prop_map(|(home, plan, fence, rally)| Document {
        home,
        plan,
        fence,
        rally,
        origin: None,
    });
    document.prop_filter("a list", |it| {
        !(it.plan.is_empty() && it.fence.is_empty() && it.rally.is_empty())
    })
}

fn back(document: &Document, format: FileFormat) -> Document {
    let text = write(document, format).expect("the format can hold it");
    match read(text.as_bytes(), &ReadOptions::default()) {
        Ok(loaded) => loaded.document,
        Err((text, faults)) => panic!("{format:?}: {faults:?} in\n{text}"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn every_format_with_all_lists_reads_back_what_was_written(document in document()) {
        for format in [FileFormat::QgcPlan, FileFormat::Kml, FileFormat::GeoJson] {
            let found = back(&document, format);
            let empty = Document::default();
            if document.is_same(&empty) && format != FileFormat::QgcPlan {
                continue;
            }
            prop_assert!(found.is_same(&document), "{format:?}\n{found:#?}\n{document:#?}");
        }
    }

    #[test]
    fn a_file_by_way_of_another_format_is_the_same(document in document()) {
        prop_assume!(!document.is_same(&Document::default()));
        for (a, b) in [
            (FileFormat::QgcPlan, FileFormat::GeoJson),
            (FileFormat::Kml, FileFormat::QgcPlan),
            (FileFormat::GeoJson, FileFormat::Kml),
        ] {
            let first = write(&document, a).expect("it can hold it");
            let round = back(&back(&document, a), b);
            let round = Document { origin: back(&document, a).origin, ..round };
            prop_assert_eq!(&write(&round, a).expect("it can hold it"), &first);
        }
    }

    /// Includes infinite numbers, and fences and rally points in any frame and order.
    #[test]
    fn wpl_reads_back_each_list(
        home in home(),
        plan in plan_items(),
        fence in prop::collection::vec(any_item(5000..=5004_u16), 1..9),
        rally in prop::collection::vec(any_item(Just(5100_u16)), 1..5),
        infinite in any::<bool>(),
    ) {
        let mut plan = Document { home, plan, ..Document::default() };
        if let Some(item) = plan.plan.iter_mut().find(|item| item.command != command::DO_JUMP && infinite) {
            item.params[1] = f32::NEG_INFINITY;
        }
        for (kind, document) in [
            (ListKind::Plan, plan),
            (ListKind::Fence, Document { fence, ..Document::default() }),
            (ListKind::Rally, Document { rally, ..Document::default() }),
        ] {
            let found = back(&document, FileFormat::Wpl(kind));
            prop_assert!(found.is_same(&document), "{found:#?}\n{document:#?}");
        }
    }
}

#[test]
fn a_format_refuses_what_it_would_lose() {
    let item = |command, frame| Item {
        command,
        frame,
        auto_continue: true,
        params: [0.0; 4],
        x: 1,
        y: 1,
        z: 10.0,
    };
    let both = Document {
        plan: vec![item(16, 3)],
        rally: vec![item(5100, 10)],
        ..Document::default()
    };
    let refused = |format| write(&both, format).expect_err("it would be lost");
    assert_eq!(
        refused(FileFormat::Wpl(ListKind::Plan)),
        Unwritable::List(ListKind::Rally)
    );
    assert_eq!(refused(FileFormat::QgcPlan), Unwritable::RallyFrame(0));
    let broken = Document {
        fence: vec![item(5003, 0), item(5001, 0)],
        ..Document::default()
    };
    let refused = write(&broken, FileFormat::QgcPlan).expect_err("it is not whole");
    assert_eq!(refused, Unwritable::FenceShape(1));
}
