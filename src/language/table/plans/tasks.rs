//! The forms of `plan` that give each target a plan of its own.

use strum::{EnumString, VariantNames};

use super::super::swarm::{
    AROUND, COURSE, EAST, HEIGHT, LINES, NORTH, PATTERN, POINT, RADIUS, REACH, WAY, local,
};
use super::super::{Built, plans};
use crate::commands::{Datum, Ground, PlanTask};
use crate::language::argument::{Argument, Arguments, Kind, Problem, Unit};
use crate::language::verb::Form;
use crate::plan::generate::Course;

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

pub(super) const SEARCH_AREA: Form = Form::new(
    &[
        SEARCH,
        SWEEP,
        Argument::value("area", Kind::Area, "argument-area"),
        LINES,
        UP,
    ],
    |given| survey(given, Ground::Outline(given.required_area("area")?.clone())),
);

fn survey(given: &Arguments, ground: Ground) -> Built {
    plans(PlanTask::Survey {
        ground,
        spacing_m: given.number("spacing"),
        up_m: given.number("up"),
        course: course(given)?,
    })
}

/// The searches that cover an area by parallel lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub(in crate::language::table) enum Sweep {
    Parallel,
    Creeping,
}

pub(in crate::language::table) const SWEEP: Argument = Argument::value(
    "sweep",
    Kind::Choice(Sweep::VARIANTS),
    "argument-plan-sweep",
);

/// The direction of lines: given by the kind of search or in degrees, otherwise the one that takes
/// the least energy.
pub(in crate::language::table) fn course(given: &Arguments) -> Result<Course, Problem> {
    let sweep: Option<Sweep> = given.choice("sweep")?;
    Ok(match (sweep, given.number("course")) {
        (Some(Sweep::Parallel), _) => Course::Long,
        (Some(Sweep::Creeping), _) => Course::Short,
        (None, Some(degrees)) => Course::Degrees(degrees),
        (None, None) => Course::Best,
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

pub(super) const LINE: Form = Form::new(
    &[
        Argument::flag("line", "argument-plan-line"),
        Argument::value("from", Kind::Point, "argument-line-from"),
        Argument::value("to", Kind::Point, "argument-line-to"),
        MORE,
        LINES,
        UP,
    ],
    |given| {
        let ends = [given.required_point("from")?, given.required_point("to")?];
        plans(PlanTask::Line {
            points: ends.into_iter().chain(given.points("more")).collect(),
            spacing_m: given.number("spacing"),
            up_m: given.number("up"),
        })
    },
);

pub(in crate::language::table) const MORE: Argument =
    Argument::value("more", Kind::Point, "argument-line-more").repeated();

pub(in crate::language::table) const CIRCLE: Argument =
    Argument::keyed("radius", "radius", RADIUS, "argument-circle-radius");

pub(in crate::language::table) const TURNS: Argument = Argument::keyed(
    "turns",
    "turns",
    Kind::Whole(Unit::None, 1.0, 255.0),
    "argument-plan-turns",
)
.optional();

pub(super) const ORBIT: Form = Form::new(
    &[
        Argument::flag("orbit", "argument-plan-orbit"),
        POINT,
        CIRCLE,
        TURNS,
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
