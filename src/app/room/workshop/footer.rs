//! The keys that the last line of the screen shows in the workshop.

use crate::app::action::{Action, WorkshopAction};
use crate::app::keymap::{KeyHint, hint};
use crate::app::room::footer_keys;

pub(super) const BENCH_HINTS: &[KeyHint] = &[
    hint(
        &[Action::Workshop(WorkshopAction::OtherPane)],
        "bench-hint-lists",
    ),
    hint(&[Action::Submit], "bench-hint-put-in"),
    hint(
        &[Action::Workshop(WorkshopAction::TakeOut)],
        "bench-hint-take-out",
    ),
    hint(&[Action::Workshop(WorkshopAction::Undo)], "bench-hint-undo"),
    hint(
        &[Action::Workshop(WorkshopAction::SaveDesign)],
        "bench-hint-save",
    ),
    hint(
        &[Action::Workshop(WorkshopAction::Designs)],
        "bench-hint-designs",
    ),
    hint(
        &[Action::Workshop(WorkshopAction::NextView)],
        "bench-hint-view",
    ),
    hint(
        &[Action::Workshop(WorkshopAction::Seats)],
        "bench-hint-fleet",
    ),
    footer_keys::HELP,
    hint(
        &[Action::Workshop(WorkshopAction::BuyPart)],
        "bench-hint-buy",
    ),
    hint(
        &[Action::Workshop(WorkshopAction::CompareDesign)],
        "bench-hint-compare",
    ),
    hint(
        &[Action::Workshop(WorkshopAction::NewDesign)],
        "bench-hint-new",
    ),
    hint(
        &[
            Action::Workshop(WorkshopAction::MissionBefore),
            Action::Workshop(WorkshopAction::MissionAfter),
        ],
        "bench-hint-mission",
    ),
    hint(
        &[
            Action::Workshop(WorkshopAction::ExportDesign),
            Action::Workshop(WorkshopAction::ImportDesign),
        ],
        "bench-hint-files",
    ),
];

pub(super) const SHELF_HINTS: &[KeyHint] = &[
    hint(&[Action::Submit], "bench-hint-open"),
    hint(
        &[Action::Workshop(WorkshopAction::CompareDesign)],
        "bench-hint-compare",
    ),
    hint(
        &[Action::Workshop(WorkshopAction::CopyDesign)],
        "bench-hint-copy",
    ),
    hint(
        &[Action::Workshop(WorkshopAction::RenameDesign)],
        "bench-hint-rename",
    ),
    hint(
        &[Action::Workshop(WorkshopAction::TakeOut)],
        "bench-hint-delete",
    ),
    footer_keys::BACK,
    footer_keys::HELP,
];

pub(super) const COMPARISON_HINTS: &[KeyHint] = &[
    footer_keys::SCROLL,
    hint(
        &[Action::Workshop(WorkshopAction::Designs)],
        "bench-hint-other",
    ),
    footer_keys::BACK,
    footer_keys::HELP,
];

pub(super) const FLEET_HINTS: &[KeyHint] = &[
    hint(&[Action::Submit], "bench-hint-assign"),
    hint(
        &[Action::Workshop(WorkshopAction::AllSeats)],
        "bench-hint-all",
    ),
    hint(
        &[Action::Workshop(WorkshopAction::TakeOut)],
        "bench-hint-lend",
    ),
    hint(
        &[Action::Workshop(WorkshopAction::FlyFleet)],
        "bench-hint-fly",
    ),
    hint(
        &[
            Action::Workshop(WorkshopAction::MissionBefore),
            Action::Workshop(WorkshopAction::MissionAfter),
        ],
        "bench-hint-mission",
    ),
    footer_keys::BACK,
    footer_keys::HELP,
];
