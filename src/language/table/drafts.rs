//! Drafts of plans, fences and rally points.

use super::{Built, console};
use crate::draft::{Edit, EditPart, Spot};
use crate::language::argument::{Argument, Arguments, Kind, Problem, Unit};
use crate::language::console::{ConsoleLine, DraftLine};
use crate::language::verb::{Form, Scope, VerbRow};
use crate::verb::Verb;

mod items;
mod limits;
mod whole;
mod work;

pub(super) static ROWS: &[VerbRow] = &[DRAFT];

const WAY: Kind = Kind::Number(Unit::Metres, -100_000.0, 100_000.0);
const HEIGHT_KIND: Kind = Kind::Number(Unit::Metres, -1000.0, 10_000.0);
const NUMBER: Kind = Kind::Whole(Unit::None, 1.0, 9999.0);

const ITEM: Argument = Argument::value("item", NUMBER, "argument-draft-item");
const POINT: Argument = Argument::value("point", Kind::Point, "argument-draft-place").optional();
const NORTH: Argument = Argument::keyed("n", "north", WAY, "argument-draft-north").optional();
const EAST: Argument = Argument::keyed("e", "east", WAY, "argument-draft-east").optional();
const UP: Argument = Argument::keyed("up", "up", HEIGHT_KIND, "argument-draft-height").optional();
const TARGETS: Argument = Argument::value("targets", Kind::Vehicles, "").optional();

const fn says(keyword: &'static str, help: &'static str) -> Argument {
    Argument::flag(keyword, help)
}

fn line(line: DraftLine) -> Built {
    console(ConsoleLine::Draft(line))
}

fn edit(edit: Edit) -> Built {
    line(DraftLine::Edit(edit))
}

fn number(given: &Arguments, name: &'static str) -> Result<usize, Problem> {
    given.required(name).map(|number| number as usize)
}

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

/// The arguments that may name a part of a change.
pub(in crate::language) const fn arguments_of(part: EditPart) -> &'static [&'static str] {
    match part {
        EditPart::Whole => &[],
        EditPart::Items => &["items", "item", "before"],
        EditPart::Target => &["to"],
        EditPart::Place => &["point", "north", "east", "around"],
        EditPart::Field => &["field"],
        EditPart::Vehicles => &["targets"],
    }
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
        "draft line 1-3 spacing 20",
        "draft orbit 1-3 around 50.4501 30.5234 radius 40 turns 2",
        "draft rehearse",
        "draft rehearse 1-4",
        "draft deconflict",
        "draft ground srtm",
        "draft undo",
        "draft upload 1-4",
    ],
    forms: &FORMS,
};

const PARTS: &[&[Form]] = &[whole::FORMS, work::FORMS, items::FORMS, limits::FORMS];

static FORMS: [Form; count(PARTS)] = joined(PARTS);

const fn count(parts: &[&[Form]]) -> usize {
    let (mut count, mut part) = (0, 0);
    while part < parts.len() {
        count += parts[part].len();
        part += 1;
    }
    count
}

/// The forms of all parts, one after the other.
const fn joined<const COUNT: usize>(parts: &[&[Form]]) -> [Form; COUNT] {
    let mut forms = [parts[0][0]; COUNT];
    let (mut filled, mut part) = (0, 0);
    while part < parts.len() {
        let mut at = 0;
        while at < parts[part].len() {
            forms[filled] = parts[part][at];
            (filled, at) = (filled + 1, at + 1);
        }
        part += 1;
    }
    forms
}
