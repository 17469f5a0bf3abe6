//! The forms of `draft` about whole drafts: their files, the vehicles, undo.

use super::{TARGETS, line, says};
use crate::language::argument::{Argument, Arguments, Kind, Unit};
use crate::language::console::DraftLine;
use crate::language::names::NameList;
use crate::language::verb::Form;

const FILE: &str = "argument-plan-file";

pub(super) const FORMS: &[Form] = &[
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
];

fn rest(given: &Arguments, name: &str) -> Option<String> {
    let text = given.word(name).map(str::trim);
    text.filter(|text| !text.is_empty()).map(str::to_owned)
}
