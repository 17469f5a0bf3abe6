//! The keys of the room.

use super::view::{self, layout};
use super::{change, files};
use crate::app::State;
use crate::app::action::{DrawAction, PlansAction, Step};
use crate::app::room::RoomRequest;
use crate::draft::{
    Edit, FenceEdit, Insertion, Items, ItemsChange, NewItem, PlanEdit, PlanFrame, Spot,
};
use crate::plan::edit::HeightChange;
use crate::plan::{ListKind, command, field};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;
use crate::vehicle_id::ranges;

/// Cells that Page Up and Page Down move the map's cursor.
const PAGE: i32 = 8;
/// The step in metres by which a key changes heights and radii.
const STEP_M: f32 = 5.0;
/// The radius of a new circle, in metres.
const RADIUS_M: f32 = 50.0;

/// Moves the map's cursor, or goes to the first or last item.
pub(super) fn step(state: &mut State, step: Step) {
    let (right, down) = match step {
        Step::Left => (-1, 0),
        Step::Right => (1, 0),
        Step::Up => (0, -1),
        Step::Down => (0, 1),
        Step::PageUp => (0, -PAGE),
        Step::PageDown => (0, PAGE),
        Step::Row(row) => return go(state, row),
        Step::First => return go(state, 0),
        Step::Last => return go(state, usize::MAX),
    };
    let size = layout(state.display.grid()).canvas;
    state.rooms.plans.map.step(size, right, down);
}

/// Goes to an item of the list, and moves the map's cursor to its place.
fn go(state: &mut State, row: usize) {
    let room = &mut state.rooms.plans;
    room.row = row;
    room.row = room.row().unwrap_or(0);
    view::point_at_item(state);
}

fn by_one(state: &mut State, forward: bool) {
    let sizes = layout(state.display.grid());
    if state.rooms.plans.scroll_figures(sizes, forward) {
        return;
    }
    let row = state.rooms.plans.row().unwrap_or(0);
    let next = if forward {
        row + 1
    } else {
        row.saturating_sub(1)
    };
    go(state, next);
}

pub(in crate::app::room) fn act(state: &mut State, action: PlansAction) -> Vec<RoomRequest> {
    // The last message is about another item or another draft.
    state.hush();
    match action {
        PlansAction::NextItem => by_one(state, true),
        PlansAction::PreviousItem => by_one(state, false),
        PlansAction::ShowFigures => {
            if !state.rooms.plans.turn_figures() {
                state.say(Severity::Notice, text!("plans-figures-none"));
            }
        }
        PlansAction::MarkItems => {
            let room = &mut state.rooms.plans;
            room.mark = match room.mark {
                Some(_) => None,
                None => room.row(),
            };
        }
        PlansAction::PlanList => show_list(state, ListKind::Plan),
        PlansAction::FenceList => show_list(state, ListKind::Fence),
        PlansAction::RallyList => show_list(state, ListKind::Rally),
        PlansAction::NextDraft => turn(state, 1),
        PlansAction::PreviousDraft => turn(state, -1),
        PlansAction::NewDraft => change::begin(state, "plan"),
        PlansAction::TakePlan => files::take_by_key(state),
        PlansAction::UndoEdit => change::travel(state, true),
        PlansAction::RedoEdit => change::travel(state, false),
        PlansAction::FitDrafts => {
            view::fit(state);
            state.rooms.plans.map.cursor = None;
        }
        PlansAction::CloserDraft => zoom(state, true),
        PlansAction::WiderDraft => zoom(state, false),
        PlansAction::CentreDraft => centre(state),
        PlansAction::OpenDraft => return write(Some("draft open ".to_owned())),
        PlansAction::SaveDraft => return write(saving(state)),
        PlansAction::UploadDraft => return write(uploading(state)),
        PlansAction::TryDrafts => return write(Some("draft rehearse".to_owned())),
        PlansAction::SurveyDraft => return write(Some(surveying(state))),
        PlansAction::WriteHeight => return write(about_marked(state, "height")),
        PlansAction::SetField => {
            if let Some(reason) = no_fields(state) {
                state.say(Severity::Notice, reason);
                return Vec::new();
            }
            return write(about_marked(state, "set"));
        }
        PlansAction::WriteCommand => return write(about_item(state, "command", "")),
        PlansAction::WriteJump => return write(about_item(state, "jump", "to ")),
    }
    Vec::new()
}

fn show_list(state: &mut State, list: ListKind) {
    change::look_at(state, list);
    view::point_at_item(state);
}

fn turn(state: &mut State, by: isize) {
    state.rooms.plans.drafts.turn(by);
    change::look_at(state, ListKind::Plan);
}

fn zoom(state: &mut State, closer: bool) {
    let size = layout(state.display.grid()).canvas;
    state.rooms.plans.map.zoom(size, closer);
}

fn centre(state: &mut State) {
    let size = layout(state.display.grid()).canvas;
    let map = &mut state.rooms.plans.map;
    if let Some(pointed) = map.view(size).map(|view| map.pointed(&view)) {
        map.centre_on(size, pointed);
    }
}

fn write(line: Option<String>) -> Vec<RoomRequest> {
    line.map(RoomRequest::Write).into_iter().collect()
}

fn saving(state: &State) -> Option<String> {
    let draft = state.rooms.plans.drafts.current()?;
    Some(format!("draft save {}", files::proposed(draft)))
}

/// The beginning of a line that uploads. If the current draft is meant for a vehicle, each such draft goes to its own
/// vehicle; otherwise the current one goes to the addressed vehicles.
fn uploading(state: &State) -> Option<String> {
    let drafts = &state.rooms.plans.drafts;
    if drafts.current()?.vehicle().is_some() {
        return Some("draft upload each".to_owned());
    }
    let targets = ranges(state.addressed());
    Some(format!("draft upload {targets}"))
}

/// The beginning of a line that divides the drawn area among the selected vehicles; without a
/// selection, among all.
fn surveying(state: &State) -> String {
    let selected = &state.session.choice.selection;
    if selected.is_empty() {
        "draft survey all ".to_owned()
    } else {
        format!("draft survey {} ", ranges(selected.iter().copied()))
    }
}

/// The beginning of a line about the marked items.
fn about_marked(state: &State, verb: &str) -> Option<String> {
    let room = &state.rooms.plans;
    let marked = words(room.marked()?);
    // Without the name of a list, a line is about the plan.
    Some(match room.list {
        ListKind::Plan => format!("draft {verb} {marked} "),
        list @ (ListKind::Fence | ListKind::Rally) => {
            format!("draft {verb} {} {marked} ", list.name())
        }
    })
}

/// The reason why the item under the cursor has no parameter to set; `None` if it has one.
fn no_fields(state: &State) -> Option<Text> {
    let room = &state.rooms.plans;
    let command = room.items().get(room.row()?)?.command;
    let word = field::word(command).unwrap_or_default();
    let has_none = field::fields(command).is_empty();
    has_none.then(|| text!("draft-no-fields", command = word))
}

/// The beginning of a line about the item under the cursor; `None` unless the plan is shown.
fn about_item(state: &State, verb: &str, then: &str) -> Option<String> {
    let room = &state.rooms.plans;
    let row = room.row().filter(|_| room.list == ListKind::Plan)?;
    Some(format!("draft {verb} {} {then}", row + 1))
}

/// Item numbers as written in a line: `2`, `2-4`.
fn words(items: Items) -> String {
    if items.first == items.last {
        items.first.to_string()
    } else {
        format!("{}-{}", items.first, items.last)
    }
}

/// Changes the current draft.
pub(in crate::app::room) fn draw(state: &mut State, action: DrawAction) -> Vec<RoomRequest> {
    state.hush();
    let is_rally = state.rooms.plans.list == ListKind::Rally;
    match meant(state, action) {
        Some(edit) => change::try_edit(state, &edit),
        None if is_rally && action == DrawAction::NextFrame => {
            state.say(Severity::Notice, text!("draft-rally-frame"));
        }
        None => {}
    }
    Vec::new()
}

/// The change that an action makes to the list shown; `None` if it makes none there.
fn meant(state: &State, action: DrawAction) -> Option<Edit> {
    let room = &state.rooms.plans;
    let (list, marked, number) = (room.list, room.marked(), room.row().map(|row| row + 1));
    let about = |change| {
        let items = marked?;
        Some(Edit::Items {
            list,
            items,
            change,
        })
    };
    let raise = |metres| about(ItemsChange::Height(HeightChange::By(metres)));
    Some(match action {
        DrawAction::AddItem => added(list, number),
        DrawAction::InsertItem => inserted(list, number),
        DrawAction::MoveItem => about(ItemsChange::Place(Spot::Cursor))?,
        DrawAction::DeleteItem => about(ItemsChange::Delete)?,
        DrawAction::SplitLeg => {
            Edit::Plan(PlanEdit::Split(number.filter(|_| list == ListKind::Plan)?))
        }
        DrawAction::Higher => raise(STEP_M)?,
        DrawAction::Lower => raise(-STEP_M)?,
        DrawAction::NextFrame => return frame(state, marked?),
        DrawAction::AddTakeoff => plain(command::TAKEOFF, None, number),
        DrawAction::AddLand => plain(command::LAND, Some(Spot::Cursor), number),
        DrawAction::AddReturn => plain(command::RETURN_TO_LAUNCH, None, number),
        DrawAction::BeginPolygon => Edit::Fence(FenceEdit::Polygon {
            keeps_in: true,
            corners: vec![Spot::Cursor],
        }),
        DrawAction::AddCircle => Edit::Fence(FenceEdit::Circle {
            keeps_in: true,
            spot: Spot::Cursor,
            radius_m: RADIUS_M,
        }),
    })
}

fn behind(number: Option<usize>) -> Insertion {
    number.map_or(Insertion::Last, Insertion::After)
}

/// The edit that adds a plan command after the item with this number; at the end without one.
fn plain(command: u16, spot: Option<Spot>, number: Option<usize>) -> Edit {
    Edit::Plan(PlanEdit::Add {
        item: NewItem {
            spot,
            ..NewItem::new(command)
        },
        at: behind(number),
    })
}

/// The edit that adds a waypoint, a corner or a rally point at the map's cursor.
fn added(list: ListKind, number: Option<usize>) -> Edit {
    match list {
        ListKind::Plan => plain(command::WAYPOINT, Some(Spot::Cursor), number),
        ListKind::Fence => Edit::Fence(FenceEdit::Corner {
            spot: Spot::Cursor,
            after: number,
        }),
        ListKind::Rally => Edit::Rally {
            spot: Spot::Cursor,
            height_m: None,
        },
    }
}

/// The edit that inserts an item at the map's cursor, before the item with this number; in a list
/// without an order, after the others.
fn inserted(list: ListKind, number: Option<usize>) -> Edit {
    match (list, number) {
        (ListKind::Plan, Some(number)) => Edit::Plan(PlanEdit::Add {
            item: NewItem {
                spot: Some(Spot::Cursor),
                ..NewItem::new(command::WAYPOINT)
            },
            at: Insertion::Before(number),
        }),
        (ListKind::Fence, Some(number)) => added(list, Some(number.saturating_sub(1))),
        _ => added(list, number),
    }
}

/// The edit that sets the next frame for the marked items; in a fence, the edit that swaps keep-in
/// and keep-out borders; `None` for rally points.
fn frame(state: &State, items: Items) -> Option<Edit> {
    let room = &state.rooms.plans;
    match room.list {
        ListKind::Plan => {
            let first = room.items().get(items.first - 1)?;
            let frame = PlanFrame::of(first).unwrap_or(PlanFrame::Sea).next();
            Some(Edit::Plan(PlanEdit::Frame { items, frame }))
        }
        ListKind::Fence => Some(Edit::Fence(FenceEdit::Flip(items.first))),
        ListKind::Rally => None,
    }
}
