//! Drafts of plans, fences and rally points.

use strum::VariantNames as _;

use super::{Built, console};
use crate::draft::{Edit, FenceEdit, Insertion, ItemsChange, NewItem, PlanEdit, PlanFrame, Spot};
use crate::geo::{LatLon, Outline};
use crate::language::argument::{Argument, Arguments, Kind, Problem, Unit};
use crate::language::console::{ConsoleLine, DraftLine};
use crate::language::names::NameList;
use crate::language::read::field_value;
use crate::language::verb::{Form, Scope, VerbRow};
use crate::plan::edit::HeightChange;
use crate::plan::{ListKind, command};
use crate::verb::Verb;

mod work;

pub(super) static ROWS: &[VerbRow] = &[DRAFT];

/// The lists of a draft, in the order of [`ListKind::ALL`].
const LISTS: &[&str] = &["plan", "fence", "rally"];

const WAY: Kind = Kind::Number(Unit::Metres, -100_000.0, 100_000.0);
const HEIGHT_KIND: Kind = Kind::Number(Unit::Metres, -1000.0, 10_000.0);
const RADIUS_KIND: Kind = Kind::Number(Unit::Metres, 1.0, 100_000.0);
const NUMBER: Kind = Kind::Whole(Unit::None, 1.0, 9999.0);

const FILE: &str = "argument-plan-file";
const ITEMS: Argument = Argument::value("items", Kind::Items, "argument-draft-items");
const ITEM: Argument = Argument::value("item", NUMBER, "argument-draft-item");
const LIST: Argument =
    Argument::value("list", Kind::Choice(LISTS), "argument-draft-list").optional();
const COMMAND: Argument = Argument::value("type", Kind::PlanCommand, "argument-draft-command");
const POINT: Argument = Argument::value("point", Kind::Point, "argument-draft-place").optional();
const NORTH: Argument = Argument::keyed("n", "north", WAY, "argument-draft-north").optional();
const EAST: Argument = Argument::keyed("e", "east", WAY, "argument-draft-east").optional();
const UP: Argument = Argument::keyed("up", "up", HEIGHT_KIND, "argument-draft-height").optional();
const HEIGHT: Argument = Argument::value("up", HEIGHT_KIND, "argument-draft-height");
const FRAMES: Kind = Kind::Choice(PlanFrame::VARIANTS);
const FRAME: Argument =
    Argument::keyed("frame", "frame", FRAMES, "argument-draft-frame").optional();
const OUT: Argument = Argument::flag("out", "argument-draft-out").optional();
const FENCE: Argument = Argument::flag("fence", "argument-draft-fence");
const TARGETS: Argument = Argument::value("targets", Kind::Vehicles, "").optional();

const fn says(keyword: &'static str, help: &'static str) -> Argument {
    Argument::flag(keyword, help)
}

const ADD: Argument = says("add", "argument-draft-add");
const MOVE: Argument = says("move", "argument-draft-move");
const CHANGE_HEIGHT: Argument = says("height", "argument-draft-change-height");
const INSERT: Argument = says("insert", "argument-draft-insert");
const BEFORE: Argument = Argument::value("before", NUMBER, "argument-draft-item");

fn line(line: DraftLine) -> Built {
    console(ConsoleLine::Draft(line))
}

fn edit(edit: Edit) -> Built {
    line(DraftLine::Edit(edit))
}

/// A change to the items that a line names.
fn items(given: &Arguments, change: ItemsChange) -> Built {
    edit(Edit::Items {
        list: list(given),
        items: given.required_items("items")?,
        change,
    })
}

fn rest(given: &Arguments, name: &str) -> Option<String> {
    let text = given.word(name).map(str::trim);
    text.filter(|text| !text.is_empty()).map(str::to_owned)
}

fn number(given: &Arguments, name: &'static str) -> Result<usize, Problem> {
    given.required(name).map(|number| number as usize)
}

fn list(given: &Arguments) -> ListKind {
    let at = given
        .word("list")
        .and_then(|word| LISTS.iter().position(|it| *it == word));
    at.and_then(|at| ListKind::ALL.get(at).copied())
        .unwrap_or(ListKind::Plan)
}

/// The place that a line names, if it names one.
fn spot(given: &Arguments) -> Option<Spot> {
    let offset = (given.number("north"), given.number("east"));
    match (given.point("point"), offset) {
        (Some(point), _) => Some(Spot::At(point)),
        (None, (None, None)) => None,
        (None, (north_m, east_m)) => Some(Spot::FromHome {
            north_m: north_m.unwrap_or(0.0),
            east_m: east_m.unwrap_or(0.0),
        }),
    }
}

fn here(given: &Arguments) -> Spot {
    spot(given).unwrap_or(Spot::Cursor)
}

fn height_m(given: &Arguments) -> Option<f32> {
    given.number("up").map(|metres| metres as f32)
}

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
    let item = NewItem {
        params: [given.required("to")? as f32, times as f32, 0.0, 0.0],
        ..NewItem::new(command::DO_JUMP)
    };
    let at = Insertion::After(number(given, "item")?);
    edit(Edit::Plan(PlanEdit::Add { item, at }))
}

fn area(given: &Arguments) -> Built {
    let keeps_in = !given.flag("out");
    match given.required_area("name")? {
        Outline::Polygon(corners) => edit(Edit::Fence(FenceEdit::Polygon {
            keeps_in,
            corners: corners.iter().copied().map(Spot::At).collect(),
        })),
        Outline::Circle { centre, radius_m } => circle(keeps_in, *centre, *radius_m),
    }
}

fn circle(keeps_in: bool, centre: LatLon, radius_m: f64) -> Built {
    edit(Edit::Fence(FenceEdit::Circle {
        keeps_in,
        spot: Spot::At(centre),
        radius_m: radius_m as f32,
    }))
}

fn attempt(given: &Arguments, is_apart: bool) -> Built {
    line(DraftLine::Try {
        is_apart,
        vehicles: given.vehicles("targets"),
    })
}

const DRAFT: VerbRow = VerbRow {
    verb: Verb::unsent("draft"),
    scope: Scope::Console,
    aliases: &[],
    examples: &[
        "draft new survey",
        "draft open survey.plan",
        "draft save survey.plan",
        "draft take 1-4",
        "draft add takeoff 30",
        "draft add n 100 e 50 up 30",
        "draft insert 3 spline n 50 e 50",
        "draft delete 3-5",
        "draft move 4 n 20 e 0",
        "draft height 2-6 40",
        "draft height 2-6 by -5",
        "draft frame 2-6 terrain",
        "draft command 4 turns",
        "draft set 4 hold 5s",
        "draft jump 6 to 2 times 3",
        "draft fence circle 150 n 0 e 0",
        "draft rally n 20 e 20",
        "draft survey all",
        "draft survey 1-6 spacing 20 up 40 course 90",
        "draft search parallel 1-4",
        "draft rehearse",
        "draft rehearse 1-4",
        "draft deconflict",
        "draft ground srtm",
        "draft undo",
        "draft upload 1-4",
    ],
    forms: FORMS,
};

const FORMS: &[Form] = &[
    Form::new(&[], |_| line(DraftLine::Show)),
    Form::new(
        &[
            says("new", "argument-draft-new"),
            Argument::value("name", Kind::Rest, "argument-draft-name").optional(),
        ],
        |given| line(DraftLine::New(rest(given, "name"))),
    ),
    Form::new(
        &[Argument::keyed("open", "file", Kind::PlanFile, FILE)],
        |given| line(DraftLine::Open(rest(given, "file").unwrap_or_default())),
    ),
    Form::new(
        &[
            says("save", "argument-draft-save"),
            Argument::value("file", Kind::PlanFile, FILE).optional(),
        ],
        |given| line(DraftLine::Save(rest(given, "file"))),
    ),
    Form::new(&[says("take", "argument-draft-take"), TARGETS], |given| {
        line(DraftLine::Take(given.vehicles("targets")))
    }),
    Form::new(
        &[Argument::keyed(
            "use",
            "draft",
            Kind::Name(NameList::Draft),
            "argument-draft-use",
        )],
        |given| line(DraftLine::Use(given.required_word("draft")?.to_owned())),
    ),
    Form::new(&[says("close", "argument-draft-close")], |_| {
        line(DraftLine::Close)
    }),
    Form::new(
        &[says("upload", "argument-draft-upload"), TARGETS],
        |given| line(DraftLine::Upload(given.vehicles("targets"))),
    ),
    Form::new(
        &[
            says("upload", "argument-draft-upload"),
            says("each", "argument-draft-each"),
        ],
        |_| line(DraftLine::UploadEach),
    ),
    work::SURVEY_AREA,
    work::SEARCH_AREA,
    work::SEARCH_AROUND,
    Form::new(
        &[says("rehearse", "argument-draft-rehearse"), TARGETS],
        |given| attempt(given, false),
    ),
    Form::new(
        &[says("deconflict", "argument-draft-deconflict"), TARGETS],
        |given| attempt(given, true),
    ),
    Form::new(&[says("undo", "argument-draft-undo")], |_| {
        line(DraftLine::Undo)
    }),
    Form::new(&[says("redo", "argument-draft-redo")], |_| {
        line(DraftLine::Redo)
    }),
    Form::new(
        &[
            says("speed", "argument-draft-speed"),
            Argument::value(
                "pace",
                Kind::Number(Unit::MetresPerSecond, 0.5, 100.0),
                "argument-draft-speed",
            )
            .optional(),
        ],
        |given| line(DraftLine::Speed(given.number("pace"))),
    ),
    Form::new(
        &[
            says("ground", "argument-draft-ground"),
            Argument::value("folder", Kind::Rest, "argument-draft-ground-folder").optional(),
        ],
        |given| line(DraftLine::Ground(rest(given, "folder"))),
    ),
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
    Form::new(
        &[
            FENCE,
            says("corner", "argument-draft-corner"),
            POINT,
            NORTH,
            EAST,
        ],
        |given| {
            edit(Edit::Fence(FenceEdit::Corner {
                spot: here(given),
                after: None,
            }))
        },
    ),
    Form::new(
        &[
            FENCE,
            says("polygon", "argument-draft-polygon"),
            OUT,
            POINT,
            NORTH,
            EAST,
        ],
        |given| {
            edit(Edit::Fence(FenceEdit::Polygon {
                keeps_in: !given.flag("out"),
                corners: vec![here(given)],
            }))
        },
    ),
    Form::new(
        &[
            FENCE,
            says("area", "argument-draft-area"),
            Argument::value("name", Kind::Area, "argument-draft-area"),
            OUT,
        ],
        area,
    ),
    Form::new(
        &[
            FENCE,
            says("circle", "argument-draft-circle"),
            Argument::value("radius", RADIUS_KIND, "argument-draft-radius"),
            OUT,
            POINT,
            NORTH,
            EAST,
        ],
        |given| {
            edit(Edit::Fence(FenceEdit::Circle {
                keeps_in: !given.flag("out"),
                spot: here(given),
                radius_m: given.required("radius")? as f32,
            }))
        },
    ),
    Form::new(
        &[FENCE, says("reverse", "argument-draft-reverse"), ITEM],
        |given| edit(Edit::Fence(FenceEdit::Flip(number(given, "item")?))),
    ),
    Form::new(
        &[
            says("rally", "argument-draft-rally"),
            POINT,
            NORTH,
            EAST,
            UP,
        ],
        |given| {
            edit(Edit::Rally {
                spot: here(given),
                height_m: height_m(given),
            })
        },
    ),
];
