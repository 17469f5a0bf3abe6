//! Verbs of the after-action review: its answers and points, and another flight to compare with.

use super::{Built, console};
use crate::language::argument::{Argument, Arguments, Kind, Unit};
use crate::language::console::{ConsoleLine, GhostLine, GhostSource, ReviewLine};
use crate::language::verb::{Form, Scope, VerbRow};
use crate::moment::Alignment;
use crate::verb::Verb;

pub(super) static ROWS: &[VerbRow] = &[REVIEW, GHOST];

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

const GHOST: VerbRow = VerbRow {
    verb: Verb::unsent("ghost"),
    scope: Scope::Screen,
    aliases: &[],
    examples: &[
        "ghost best",
        "ghost reference",
        "ghost by takeoff",
        "ghost off",
    ],
    forms: &[
        Form::new(&[Argument::flag("best", "argument-ghost-best")], |_| {
            ghost(GhostLine::Show(GhostSource::Best))
        }),
        Form::new(
            &[Argument::flag("reference", "argument-ghost-reference")],
            |_| ghost(GhostLine::Show(GhostSource::Reference)),
        ),
        Form::new(&[Argument::flag("off", "")], |_| ghost(GhostLine::Off)),
        Form::new(
            &[Argument::keyed(
                "by",
                "moment",
                Kind::Choice(Alignment::NAMES),
                "argument-ghost-by",
            )],
            |given| {
                let name = given.required_word("moment")?;
                let alignment = Alignment::named(name).unwrap_or_default();
                ghost(GhostLine::AlignedBy(alignment))
            },
        ),
        Form::new(
            &[Argument::value("file", Kind::Rest, "argument-file")],
            |given| {
                let path = given.required_word("file")?.trim().to_owned();
                ghost(GhostLine::Show(GhostSource::File(path)))
            },
        ),
    ],
};

fn ghost(line: GhostLine) -> Built {
    console(ConsoleLine::Ghost(line))
}

fn review(line: ReviewLine) -> Built {
    console(ConsoleLine::Review(line))
}

fn words(given: &Arguments) -> String {
    given.word("text").unwrap_or_default().trim().to_owned()
}
