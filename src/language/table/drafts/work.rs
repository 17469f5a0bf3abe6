//! The forms of `draft` that divide work among vehicles, and fly the plans in simulation.

use super::super::plans::tasks::{CIRCLE, MORE, SWEEP, TURNS, course};
use super::super::swarm::{COURSE, LINES, PATTERN, REACH};
use super::{Built, TARGETS, UP, line, says};
use crate::language::argument::{Argument, Arguments, Kind, Problem};
use crate::language::console::{DraftLine, DraftWork};
use crate::language::verb::Form;
use crate::text;

const SURVEY: Argument = says("survey", "argument-draft-survey");
const SEARCH: Argument = says("search", "argument-draft-search");
const DRAWN: Argument =
    Argument::keyed("area", "area", Kind::Area, "argument-draft-drawn").optional();
const AROUND: Argument =
    Argument::keyed("around", "around", Kind::Point, "argument-draft-place").optional();

pub(super) const FORMS: &[Form] = &[
    SURVEY_AREA,
    SEARCH_AREA,
    SEARCH_AROUND,
    LINE,
    ORBIT,
    Form::new(
        &[says("rehearse", "argument-draft-rehearse"), TARGETS],
        |given| attempt(given, false),
    ),
    Form::new(
        &[says("deconflict", "argument-draft-deconflict"), TARGETS],
        |given| attempt(given, true),
    ),
];

fn attempt(given: &Arguments, is_apart: bool) -> Built {
    line(DraftLine::Try {
        is_apart,
        vehicles: given.vehicles("targets"),
    })
}

const SURVEY_AREA: Form = Form::new(&[SURVEY, TARGETS, LINES, UP, COURSE, DRAWN], sweep);

const SEARCH_AREA: Form = Form::new(&[SEARCH, SWEEP, TARGETS, LINES, UP, DRAWN], sweep);

const SEARCH_AROUND: Form = Form::new(
    &[SEARCH, PATTERN, TARGETS, AROUND, REACH, LINES, UP],
    search,
);

const LINE: Form = Form::new(
    &[
        says("line", "argument-draft-line"),
        TARGETS,
        MORE,
        LINES,
        UP,
    ],
    |given| {
        let points = given.points("more");
        if points.len() == 1 {
            return Err(Problem::new("more", text!("draft-line-short")));
        }
        divide(
            given,
            DraftWork::Line {
                points,
                spacing_m: given.number("spacing"),
                up_m: given.number("up"),
            },
        )
    },
);

const ORBIT: Form = Form::new(
    &[
        says("orbit", "argument-draft-orbit"),
        TARGETS,
        AROUND,
        CIRCLE,
        TURNS,
        UP,
    ],
    |given| {
        divide(
            given,
            DraftWork::Orbit {
                centre: given.point("around"),
                radius_m: given.required("radius")?,
                turns: given.number("turns").map(|turns| turns as u8),
                up_m: given.number("up"),
            },
        )
    },
);

fn divide(given: &Arguments, work: DraftWork) -> Built {
    line(DraftLine::Divide {
        work,
        vehicles: given.vehicles("targets"),
    })
}

/// Plans over an area: that of the current draft unless another is named.
fn sweep(given: &Arguments) -> Built {
    let work = DraftWork::Sweep {
        area: given.area("area").cloned(),
        spacing_m: given.number("spacing"),
        up_m: given.number("up"),
        course: course(given)?,
    };
    divide(given, work)
}

/// Plans around a place: the cursor of the map unless another is named.
fn search(given: &Arguments) -> Built {
    let work = DraftWork::Search {
        pattern: given.required_choice("pattern")?,
        datum: given.point("around"),
        radius_m: given.number("radius"),
        spacing_m: given.number("spacing"),
        up_m: given.number("up"),
    };
    divide(given, work)
}
