//! The forms of `plan` that give each target a plan of its own.

use super::super::swarm::{
    AROUND, COURSE, EAST, HEIGHT, LINES, NORTH, PATTERN, POINT, RADIUS, REACH, WAY, local,
};
use super::super::{Built, plans};
use crate::commands::{Datum, Ground, PlanTask};
use crate::language::argument::{Argument, Arguments, Kind, Unit};
use crate::language::verb::Form;

const SURVEY: Argument = Argument::flag("survey", "argument-plan-survey");
const SEARCH: Argument = Argument::flag("search", "argument-plan-search");
const UP: Argument = Argument::keyed("up", "up", HEIGHT, "argument-plan-height").optional();

pub(super) const SURVEY_BETWEEN: Form = Form::new(
    &[
        SURVEY,
        NORTH,
        EAST,
        Argument::flag("to", "argument-opposite-corner"),
        Argument::keyed("n", "far north", WAY, "argument-north-of-origin"),
        Argument::keyed("e", "far east", WAY, "argument-east-of-origin"),
        LINES,
        UP,
        COURSE,
    ],
    |given| {
        let from = local(given, "north", "east")?;
        let to = local(given, "far north", "far east")?;
        survey(given, Ground::Between(from, to))
    },
);

pub(super) const SURVEY_AROUND: Form = Form::new(
    &[
        SURVEY,
        AROUND,
        POINT,
        Argument::keyed("radius", "radius", RADIUS, "argument-circle-radius"),
        LINES,
        UP,
        COURSE,
    ],
    |given| {
        let centre = Datum::Global(given.required_point("point")?);
        let radius_m = given.required("radius")?;
        survey(given, Ground::Around { centre, radius_m })
    },
);

pub(super) const SURVEY_AREA: Form = Form::new(
    &[
        SURVEY,
        Argument::value("area", Kind::Area, "argument-area"),
        LINES,
        UP,
        COURSE,
    ],
    |given| survey(given, Ground::Outline(given.required_area("area")?.clone())),
);

fn survey(given: &Arguments, ground: Ground) -> Built {
    plans(PlanTask::Survey {
        ground,
        spacing_m: given.number("spacing"),
        up_m: given.number("up"),
        course_deg: given.number("course"),
    })
}

pub(super) const SEARCH_AROUND: Form = Form::new(
    &[SEARCH, PATTERN, AROUND, POINT, REACH, LINES, UP],
    |given| search(given, Datum::Global(given.required_point("point")?)),
);

pub(super) const SEARCH_FROM_ORIGIN: Form =
    Form::new(&[SEARCH, PATTERN, NORTH, EAST, REACH, LINES, UP], |given| {
        search(given, local(given, "north", "east")?)
    });

fn search(given: &Arguments, datum: Datum) -> Built {
    plans(PlanTask::Search {
        pattern: given.required_choice("pattern")?,
        datum,
        radius_m: given.number("radius"),
        spacing_m: given.number("spacing"),
        up_m: given.number("up"),
    })
}

pub(super) const ORBIT: Form = Form::new(
    &[
        Argument::flag("orbit", "argument-plan-orbit"),
        POINT,
        Argument::keyed("radius", "radius", RADIUS, "argument-circle-radius"),
        Argument::keyed(
            "turns",
            "turns",
            Kind::Whole(Unit::None, 1.0, 255.0),
            "argument-plan-turns",
        )
        .optional(),
        UP,
    ],
    |given| {
        plans(PlanTask::Orbit {
            centre: Datum::Global(given.required_point("point")?),
            radius_m: given.required("radius")?,
            turns: given.number("turns").map(|turns| turns as u8),
            up_m: given.number("up"),
        })
    },
);
