//! Lists as vehicles carry them and as files contain them.

use super::compare;
use crate::plan::{Document, Home, Item, ListKind, command, frame};
use crate::text::Text;

/// The state that an order should reach.
#[derive(Debug, Default)]
pub(super) struct PlanOrderGoal {
    /// The list that the vehicle is to carry; `None` if the order only reads.
    pub items: Option<Vec<Item>>,
    /// Warnings about the list.
    pub warnings: Vec<Text>,
}

/// A list as a vehicle carries it: with home as item 0 of a plan, which the vehicle replaces by its own.
pub(super) fn whole(document: &Document, kind: ListKind) -> Vec<Item> {
    let home = document.home.unwrap_or(Home { x: 0, y: 0, z: 0.0 });
    let first = Item {
        command: command::WAYPOINT,
        frame: frame::SEA_LEVEL,
        auto_continue: true,
        params: [0.0; 4],
        x: home.x,
        y: home.y,
        z: home.z,
    };
    let of_plan = (kind == ListKind::Plan).then_some(first);
    of_plan
        .into_iter()
        .chain(document.list(kind).iter().copied())
        .collect()
}

/// The content of a file with a vehicle's list.
pub(super) fn document_of(kind: ListKind, items: &[Item]) -> Document {
    let first = items.first().filter(|_| kind == ListKind::Plan);
    let mut document = Document {
        home: first.map(|home| Home {
            x: home.x,
            y: home.y,
            z: home.z,
        }),
        ..Document::default()
    };
    document.list_mut(kind).extend(compare::own(kind, items));
    document
}
