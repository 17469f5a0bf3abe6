//! The keys that the room shows: those for drafts on the last line, those for items on the line above it.

use super::{drawing, own};
use crate::app::State;
use crate::app::action::{DrawAction, PlansAction};
use crate::app::keymap::{KeyHint, hint};
use crate::app::room::footer_keys;
use crate::plan::ListKind;

const ITEM: KeyHint = hint(
    &[own(PlansAction::NextItem), own(PlansAction::PreviousItem)],
    "plans-hint-item",
);
const ADD: KeyHint = hint(&[drawing(DrawAction::AddItem)], "plans-hint-add");
const MOVE: KeyHint = hint(&[drawing(DrawAction::MoveItem)], "plans-hint-move");
const DELETE: KeyHint = hint(&[drawing(DrawAction::DeleteItem)], "plans-hint-delete");
const UNDO: KeyHint = hint(&[own(PlansAction::UndoEdit)], "plans-hint-undo");
const HEIGHT: KeyHint = hint(
    &[
        drawing(DrawAction::Higher),
        drawing(DrawAction::Lower),
        own(PlansAction::WriteHeight),
    ],
    "plans-hint-height",
);
const MARK: KeyHint = hint(&[own(PlansAction::MarkItems)], "plans-hint-mark");
const INSERT: KeyHint = hint(&[drawing(DrawAction::InsertItem)], "plans-hint-insert");
const SURVEY: KeyHint = hint(&[own(PlansAction::SurveyDraft)], "plans-hint-survey");
const REHEARSE: KeyHint = hint(&[own(PlansAction::TryDrafts)], "plans-hint-rehearse");
const SAVE: KeyHint = hint(&[own(PlansAction::SaveDraft)], "plans-hint-save");
const UPLOAD: KeyHint = hint(&[own(PlansAction::UploadDraft)], "plans-hint-upload");
const NEXT: KeyHint = hint(&[own(PlansAction::NextDraft)], "plans-hint-draft");
const NEW: KeyHint = hint(&[own(PlansAction::NewDraft)], "plans-hint-new");
const OPEN: KeyHint = hint(&[own(PlansAction::OpenDraft)], "plans-hint-open");
const TAKE: KeyHint = hint(&[own(PlansAction::TakePlan)], "plans-hint-take");
const ZOOM: KeyHint = hint(
    &[
        own(PlansAction::CloserDraft),
        own(PlansAction::WiderDraft),
        own(PlansAction::FitDrafts),
    ],
    "plans-hint-zoom",
);

const PLAN_ITEMS: &[KeyHint] = &[
    ITEM,
    ADD,
    MOVE,
    DELETE,
    hint(&[drawing(DrawAction::SplitLeg)], "plans-hint-split"),
    hint(&[drawing(DrawAction::AddTakeoff)], "plans-hint-takeoff"),
    hint(&[drawing(DrawAction::AddLand)], "plans-hint-land"),
    hint(&[drawing(DrawAction::AddReturn)], "plans-hint-return"),
    UNDO,
    MARK,
    INSERT,
    hint(&[own(PlansAction::WriteJump)], "plans-hint-jump"),
    hint(&[own(PlansAction::WriteCommand)], "plans-hint-command"),
];

const FENCE_ITEMS: &[KeyHint] = &[
    ITEM,
    hint(&[drawing(DrawAction::BeginPolygon)], "plans-hint-area"),
    hint(&[drawing(DrawAction::AddItem)], "plans-hint-corner"),
    hint(&[drawing(DrawAction::AddCircle)], "plans-hint-circle"),
    MOVE,
    DELETE,
    hint(&[drawing(DrawAction::NextFrame)], "plans-hint-reverse"),
    hint(
        &[drawing(DrawAction::Higher), drawing(DrawAction::Lower)],
        "plans-hint-radius",
    ),
    UNDO,
    MARK,
    INSERT,
];

const RALLY_ITEMS: &[KeyHint] = &[ITEM, ADD, MOVE, DELETE, HEIGHT, UNDO, MARK];

const PLAN: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    SURVEY,
    REHEARSE,
    UPLOAD,
    SAVE,
    HEIGHT,
    hint(&[drawing(DrawAction::NextFrame)], "plans-hint-frame"),
    hint(&[own(PlansAction::SetField)], "plans-hint-set"),
    NEXT,
    NEW,
    OPEN,
    TAKE,
    ZOOM,
];

const OTHERS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    SURVEY,
    REHEARSE,
    UPLOAD,
    SAVE,
    NEXT,
    NEW,
    OPEN,
    TAKE,
    ZOOM,
];

const NOTHING: &[KeyHint] = &[footer_keys::COMMAND, footer_keys::HELP, NEW, OPEN, TAKE];

/// The keys for drafts.
pub(super) fn of_drafts(state: &State) -> &'static [KeyHint] {
    let room = &state.rooms.plans;
    match (room.drafts.current(), room.list) {
        (None, _) => NOTHING,
        (Some(_), ListKind::Plan) => PLAN,
        (Some(_), ListKind::Fence | ListKind::Rally) => OTHERS,
    }
}

/// The keys for the items of the list that is shown.
pub fn of_items(state: &State) -> &'static [KeyHint] {
    let room = &state.rooms.plans;
    match (room.drafts.current(), room.list) {
        (None, _) => &[],
        (Some(_), ListKind::Plan) => PLAN_ITEMS,
        (Some(_), ListKind::Fence) => FENCE_ITEMS,
        (Some(_), ListKind::Rally) => RALLY_ITEMS,
    }
}
