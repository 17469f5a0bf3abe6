//! The lists that a vehicle carries: its plan, its fence and its rally points.

use super::super::argument::{Argument, Arguments, Kind, Unit};
use super::super::verb::{Form, Scope, VerbRow};
use super::{ASK, Built, CHANGE, ONCE, command};
use crate::commands::{
    Act, Command, DeviceCommand, FlightCommand, PlanCommand, PlanDeed, PlanSource,
};
use crate::language::Meaning;
use crate::plan::ListKind;
use crate::verb::{Arrival, CountsAs, Danger, Movement, Precedence, Verb};

mod tasks;

/// The table's rows of this group.
pub(super) const ROWS: &[VerbRow] = &[PLAN, FENCE, RALLY];

/// A verb about a list.
const fn list_verb(name: &'static str) -> Verb {
    Verb {
        name,
        danger: Danger::None,
        retry: ASK,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Setting,
    }
}

const UPLOAD: Argument = Argument::keyed("upload", "file", Kind::Rest, "argument-plan-file");
const DOWNLOAD: Argument = Argument::keyed("download", "file", Kind::Rest, "argument-plan-file");

fn deed(kind: ListKind, deed: PlanDeed) -> Built {
    command(Command::Plan(PlanCommand { kind, deed }))
}

fn file(given: &Arguments) -> String {
    given.word("file").unwrap_or_default().trim().to_owned()
}

fn upload(kind: ListKind, given: &Arguments) -> Built {
    let source = PlanSource::File(file(given));
    deed(kind, PlanDeed::Upload { source })
}

fn download(kind: ListKind, given: &Arguments) -> Built {
    let file = file(given);
    deed(kind, PlanDeed::Download { file })
}

const START: Verb = Verb {
    precedence: Precedence::Awaited,
    movement: Movement::To(Arrival::Mode),
    counts_as: CountsAs::Task,
    retry: ONCE,
    ..list_verb("plan start")
};

const GOTO: Verb = Verb {
    retry: CHANGE,
    counts_as: CountsAs::Task,
    ..list_verb("plan goto")
};

const REHEARSE: Verb = list_verb("plan rehearse");

const PLAN: VerbRow = VerbRow {
    verb: list_verb("plan"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &[
        "plan upload survey.waypoints",
        "all plan download v{id}.waypoints",
        "plan clear",
        "all plan show",
        "1-4 plan start",
        "plan goto 7",
        "1-6 plan survey lane spacing 20 up 40",
        "1-3 plan search square around 50.4501 30.5234 radius 200",
        "1-4 plan orbit 50.4501 30.5234 radius 40 turns 3",
        "all plan rehearse",
    ],
    forms: &[
        Form::new(&[UPLOAD], |given| upload(ListKind::Plan, given)),
        Form::new(&[DOWNLOAD], |given| download(ListKind::Plan, given)),
        tasks::SURVEY_BETWEEN,
        tasks::SURVEY_AROUND,
        tasks::SURVEY_AREA,
        tasks::SEARCH_AROUND,
        tasks::SEARCH_FROM_ORIGIN,
        tasks::ORBIT,
        Form::new(&[Argument::flag("rehearse", "")], |_| {
            Ok(Meaning::Act(Act::Rehearse))
        })
        .meaning(&REHEARSE),
        Form::new(&[Argument::flag("clear", "")], |_| {
            deed(ListKind::Plan, PlanDeed::Clear)
        }),
        Form::new(&[Argument::flag("show", "")], |_| {
            deed(ListKind::Plan, PlanDeed::Show)
        }),
        Form::new(&[Argument::flag("start", "")], |_| {
            command(Command::Flight(FlightCommand::StartPlan))
        })
        .meaning(&START),
        Form::new(
            &[Argument::keyed(
                "goto",
                "item",
                Kind::Whole(Unit::None, 1.0, u16::MAX as f64),
                "argument-plan-item",
            )],
            |given| {
                let item = given.required("item")? as u16;
                command(Command::Flight(FlightCommand::GotoItem { item }))
            },
        )
        .meaning(&GOTO),
    ],
};

const FENCE_SWITCH: Verb = Verb {
    retry: CHANGE,
    ..list_verb("fence switch")
};

const FENCE: VerbRow = VerbRow {
    verb: list_verb("fence"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &[
        "all fence upload field.plan",
        "fence download field.fence",
        "fence clear",
        "fence show",
        "all fence on",
        "fence off",
    ],
    forms: &[
        Form::new(&[UPLOAD], |given| upload(ListKind::Fence, given)),
        Form::new(&[DOWNLOAD], |given| download(ListKind::Fence, given)),
        Form::new(&[Argument::flag("clear", "")], |_| {
            deed(ListKind::Fence, PlanDeed::Clear)
        }),
        Form::new(&[Argument::flag("show", "")], |_| {
            deed(ListKind::Fence, PlanDeed::Show)
        }),
        Form::new(&[Argument::flag("on", "")], |_| {
            command(Command::Device(DeviceCommand::Fence { on: true }))
        })
        .meaning(&FENCE_SWITCH),
        Form::new(&[Argument::flag("off", "")], |_| {
            command(Command::Device(DeviceCommand::Fence { on: false }))
        })
        .meaning(&FENCE_SWITCH),
    ],
};

const RALLY: VerbRow = VerbRow {
    verb: list_verb("rally"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &[
        "all rally upload field.plan",
        "rally download field.rally",
        "rally clear",
        "rally show",
    ],
    forms: &[
        Form::new(&[UPLOAD], |given| upload(ListKind::Rally, given)),
        Form::new(&[DOWNLOAD], |given| download(ListKind::Rally, given)),
        Form::new(&[Argument::flag("clear", "")], |_| {
            deed(ListKind::Rally, PlanDeed::Clear)
        }),
        Form::new(&[Argument::flag("show", "")], |_| {
            deed(ListKind::Rally, PlanDeed::Show)
        }),
    ],
};
