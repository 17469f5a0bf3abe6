//! The verb of the after-action review: its answers and its points.

use super::{Built, console};
use crate::language::argument::{Argument, Arguments, Kind, Unit};
use crate::language::console::{ConsoleLine, ReviewLine};
use crate::language::verb::{Form, Scope, VerbRow};
use crate::verb::Verb;

pub(super) static ROWS: &[VerbRow] = &[REVIEW];

/// The number of a point, from 1.
const POINT: Kind = Kind::Whole(Unit::None, 1.0, 6.0);

const REVIEW: VerbRow = VerbRow {
    verb: Verb::unsent("review"),
    scope: Scope::Screen,
    aliases: &[],
    examples: &[
        "review",
        "review why the wind was behind us",
        "review improve watch the battery earlier",
        "review export review.md",
    ],
    forms: &[
        Form::new(&[], |_| review(ReviewLine::Open)),
        Form::new(
            &[Argument::keyed("why", "text", Kind::Rest, "").optional()],
            |given| review(ReviewLine::Why(words(given))),
        ),
        Form::new(
            &[Argument::keyed("next", "text", Kind::Rest, "").optional()],
            |given| review(ReviewLine::Next(words(given))),
        ),
        Form::new(
            &[Argument::keyed("sustain", "text", Kind::Rest, "")],
            |given| review(ReviewLine::Sustain(words(given))),
        ),
        Form::new(
            &[Argument::keyed("improve", "text", Kind::Rest, "")],
            |given| review(ReviewLine::Improve(words(given))),
        ),
        Form::new(
            &[Argument::keyed(
                "remove",
                "number",
                POINT,
                "argument-review-point",
            )],
            |given| review(ReviewLine::Remove(given.required("number")? as usize)),
        ),
        Form::new(
            &[Argument::keyed(
                "export",
                "file",
                Kind::Rest,
                "argument-file",
            )],
            |given| {
                review(ReviewLine::Export(
                    given.required_word("file")?.trim().to_owned(),
                ))
            },
        ),
    ],
};

fn review(line: ReviewLine) -> Built {
    console(ConsoleLine::Review(line))
}

fn words(given: &Arguments) -> String {
    given.word("text").unwrap_or_default().trim().to_owned()
}
