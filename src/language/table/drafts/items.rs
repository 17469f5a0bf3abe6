//! The forms of `draft` that change the items of a list, and home.

use strum::VariantNames as _;

use super::{
    Built, EAST, HEIGHT_KIND, ITEM, NORTH, NUMBER, POINT, UP, WAY, edit, height_m, here, number,
    says, spot,
};
use crate::draft::{Edit, Insertion, ItemsChange, NewItem, PlanEdit, PlanFrame};
use crate::language::argument::{Argument, Arguments, Kind, Problem, Unit};
use crate::language::read::field_value;
use crate::language::verb::Form;
use crate::plan::edit::HeightChange;
use crate::plan::{ListKind, command};
use crate::text;

/// The lists of a draft, in the order of [`ListKind::ALL`].
const LISTS: &[&str] = &["plan", "fence", "rally"];

const ITEMS: Argument = Argument::value("items", Kind::Items, "argument-draft-items");
const LIST: Argument =
    Argument::value("list", Kind::Choice(LISTS), "argument-draft-list").optional();
const COMMAND: Argument = Argument::value("type", Kind::PlanCommand, "argument-draft-command");
const HEIGHT: Argument = Argument::value("up", HEIGHT_KIND, "argument-draft-height");
const FRAMES: Kind = Kind::Choice(PlanFrame::VARIANTS);
const FRAME: Argument =
    Argument::keyed("frame", "frame", FRAMES, "argument-draft-frame").optional();
const ADD: Argument = says("add", "argument-draft-add");
const MOVE: Argument = says("move", "argument-draft-move");
const CHANGE_HEIGHT: Argument = says("height", "argument-draft-change-height");
const INSERT: Argument = says("insert", "argument-draft-insert");
const BEFORE: Argument = Argument::value("before", NUMBER, "argument-draft-item");

pub(super) const FORMS: &[Form] = &[
    Form::new(
        &[ADD, COMMAND.optional(), POINT, NORTH, EAST, UP, FRAME],
        add,
    ),
    Form::new(&[ADD, COMMAND, HEIGHT, FRAME], add),
    Form::new(
        &[
            INSERT,
            BEFORE,
            COMMAND.optional(),
            POINT,
            NORTH,
            EAST,
            UP,
            FRAME,
        ],
        add,
    ),
    Form::new(&[INSERT, BEFORE, COMMAND, HEIGHT, FRAME], add),
    Form::new(
        &[says("delete", "argument-draft-delete"), LIST, ITEMS],
        |given| items(given, ItemsChange::Delete),
    ),
    Form::new(&[MOVE, LIST, ITEMS, POINT], shift),
    Form::new(&[MOVE, LIST, ITEMS, NORTH, EAST], shift),
    Form::new(
        &[
            says("order", "argument-draft-order"),
            ITEMS,
            Argument::keyed("to", "to", NUMBER, "argument-draft-item"),
        ],
        |given| {
            edit(Edit::Plan(PlanEdit::Reorder {
                items: given.required_items("items")?,
                to: number(given, "to")?,
            }))
        },
    ),
    Form::new(&[says("split", "argument-draft-split"), ITEM], |given| {
        edit(Edit::Plan(PlanEdit::Split(number(given, "item")?)))
    }),
    Form::new(&[CHANGE_HEIGHT, LIST, ITEMS, HEIGHT], height),
    Form::new(
        &[
            CHANGE_HEIGHT,
            LIST,
            ITEMS,
            Argument::keyed("by", "by", WAY, "argument-draft-by"),
        ],
        height,
    ),
    Form::new(
        &[
            says("frame", "argument-draft-frame"),
            ITEMS,
            Argument::value("to", FRAMES, "argument-draft-frame"),
        ],
        |given| {
            edit(Edit::Plan(PlanEdit::Frame {
                items: given.required_items("items")?,
                frame: given.required_choice("to")?,
            }))
        },
    ),
    Form::new(
        &[
            says("command", "argument-draft-change-command"),
            ITEM,
            COMMAND,
        ],
        |given| {
            edit(Edit::Plan(PlanEdit::Command {
                item: number(given, "item")?,
                command: given.required("type")? as u16,
            }))
        },
    ),
    Form::new(
        &[
            says("set", "argument-draft-set"),
            LIST,
            ITEMS,
            Argument::value("field", Kind::PlanField, "argument-draft-field"),
            Argument::value("value", Kind::Rest, "argument-draft-value"),
        ],
        set,
    ),
    Form::new(
        &[
            says("jump", "argument-draft-jump"),
            ITEM,
            Argument::keyed("to", "to", NUMBER, "argument-draft-item"),
            Argument::keyed(
                "times",
                "times",
                Kind::Whole(Unit::None, -1.0, 1000.0),
                "argument-draft-times",
            )
            .optional(),
        ],
        jump,
    ),
    Form::new(
        &[says("home", "argument-draft-home"), POINT, NORTH, EAST],
        |given| edit(Edit::Home(here(given))),
    ),
];

fn new_item(given: &Arguments) -> Result<NewItem, Problem> {
    let command = given.number("type").map(|number| number as u16);
    Ok(NewItem {
        spot: spot(given),
        height_m: height_m(given),
        frame: given.choice("frame")?,
        ..NewItem::new(command.unwrap_or(command::WAYPOINT))
    })
}

fn add(given: &Arguments) -> Built {
    let at = match given.number("before") {
        Some(number) => Insertion::Before(number as usize),
        None => Insertion::Last,
    };
    let item = new_item(given)?;
    edit(Edit::Plan(PlanEdit::Add { item, at }))
}

fn shift(given: &Arguments) -> Built {
    let (north_m, east_m) = (given.number("north"), given.number("east"));
    if (north_m, east_m) == (None, None) {
        return items(given, ItemsChange::Place(here(given)));
    }
    let change = ItemsChange::Shift {
        north_m: north_m.unwrap_or(0.0),
        east_m: east_m.unwrap_or(0.0),
    };
    items(given, change)
}

fn height(given: &Arguments) -> Built {
    let change = match given.number("by") {
        Some(metres) => HeightChange::By(metres as f32),
        None => HeightChange::To(given.required("up")? as f32),
    };
    items(given, ItemsChange::Height(change))
}

fn set(given: &Arguments) -> Built {
    let field = given.required_word("field")?.to_owned();
    let value = field_value(&field, given.required_word("value")?.trim())
        .map_err(|message| Problem::new("value", message))?;
    items(given, ItemsChange::Set { field, value })
}

fn jump(given: &Arguments) -> Built {
    let times = given.number("times").unwrap_or(1.0);
    if times == 0.0 {
        return Err(Problem::new("times", text!("draft-jump-never")));
    }
    let item = NewItem {
        params: [given.required("to")? as f32, times as f32, 0.0, 0.0],
        ..NewItem::new(command::DO_JUMP)
    };
    let at = Insertion::After(number(given, "item")?);
    edit(Edit::Plan(PlanEdit::Add { item, at }))
}

/// A change to the items that a line names.
fn items(given: &Arguments, change: ItemsChange) -> Built {
    edit(Edit::Items {
        list: list(given),
        items: given.required_items("items")?,
        change,
    })
}

fn list(given: &Arguments) -> ListKind {
    let at = given
        .word("list")
        .and_then(|word| LISTS.iter().position(|it| *it == word));
    at.and_then(|at| ListKind::ALL.get(at).copied())
        .unwrap_or(ListKind::Plan)
}
