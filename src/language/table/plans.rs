//! The lists that a vehicle carries: its plan, its fence and its rally points.

use super::super::argument::{Argument, Arguments, Kind, Unit};
use super::super::console::ConsoleLine;
use super::super::targets::Targets;
use super::super::verb::{Form, Scope, VerbRow};
use super::swarm::HEADING;
use super::{ASK, Built, CHANGE, COME_DOWN, ONCE, command, console};
use crate::commands::{Act, Command, DeviceCommand, PlanCommand, PlanDeed, PlanFlight, PlanSource};
use crate::language::Meaning;
use crate::plan::ListKind;
use crate::vehicle::Wind;
use crate::verb::{Arrival, CountsAs, CrewDuty, Danger, Movement, Precedence, Verb};

pub(super) mod tasks;

/// The table's rows of this group.
pub(super) const ROWS: &[VerbRow] = &[PLAN, FENCE, RALLY];

const fn list_verb(name: &'static str) -> Verb {
    Verb {
        name,
        danger: Danger::None,
        retry: ASK,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Setting,
        duty: CrewDuty::Flying,
        unsuited: &[],
    }
}

/// The number of an item, from 1: 0 is home.
const ITEM: Kind = Kind::Whole(Unit::None, 1.0, u16::MAX as f64);

/// The mean wind of a rehearsal.
const WIND_SPEED: Kind = Kind::Number(Unit::MetresPerSecond, 0.0, 60.0);

const UPLOAD: Argument = Argument::keyed("upload", "file", Kind::PlanFile, "argument-plan-file");
const DOWNLOAD: Argument =
    Argument::keyed("download", "file", Kind::PlanFile, "argument-plan-file");

fn deed(kind: ListKind, deed: PlanDeed) -> Built {
    command(Command::Plan(PlanCommand { kind, deed }))
}

fn flight(flight: PlanFlight) -> Built {
    command(Command::PlanFlight(flight))
}

fn resume(item: Option<f64>) -> Built {
    let item = item.map(|item| item as u16);
    flight(PlanFlight::Resume { item })
}

/// A comparison of the lists of the targets, which are filled in once the whole line is read.
fn carried(kind: ListKind) -> Built {
    let targets = Targets::Selection;
    console(ConsoleLine::Carried { kind, targets })
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

const REHEARSE: Verb = Verb {
    counts_as: CountsAs::Rehearsal,
    ..list_verb("plan rehearse")
};

/// The verb of lines that put another plan on board.
const PUT: Verb = Verb {
    counts_as: CountsAs::PlanChange,
    ..list_verb("plan change")
};

const PAUSE: Verb = Verb {
    retry: CHANGE,
    precedence: Precedence::Urgent,
    movement: Movement::To(Arrival::Done),
    counts_as: CountsAs::Task,
    ..list_verb("plan pause")
};

const RESUME: Verb = Verb {
    name: "plan resume",
    retry: CHANGE,
    ..START
};

const SKIP: Verb = Verb {
    retry: CHANGE,
    counts_as: CountsAs::Task,
    ..list_verb("plan skip")
};

const ABORT: Verb = Verb {
    retry: COME_DOWN,
    precedence: Precedence::Urgent,
    movement: Movement::To(Arrival::Landed),
    counts_as: CountsAs::Task,
    ..list_verb("plan abort")
};

const PLAN: VerbRow = VerbRow {
    verb: list_verb("plan"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &[
        "plan upload survey.waypoints",
        "all plan download v{id}.waypoints",
        "plan clear",
        "all plan show",
        "all plan status",
        "1-4 plan start",
        "plan goto 7",
        "1-6 plan survey lane spacing 20 up 40",
        "1-4 plan search parallel lane",
        "1-3 plan search square around 50.4501 30.5234 radius 200",
        "1-3 plan line 50.4501 30.5234 50.4521 30.5234 spacing 20",
        "1-4 plan orbit 50.4501 30.5234 radius 40 turns 3",
        "all plan rehearse",
        "all plan rehearse wind 270 8",
        "all plan pause",
        "all plan resume",
        "4 plan resume from 7",
        "plan skip",
        "all plan abort",
    ],
    forms: &[
        Form::new(&[UPLOAD], |given| upload(ListKind::Plan, given)).meaning(&PUT),
        Form::new(&[DOWNLOAD], |given| download(ListKind::Plan, given)),
        tasks::SURVEY_BETWEEN.meaning(&PUT),
        tasks::SURVEY_AROUND.meaning(&PUT),
        tasks::SURVEY_AREA.meaning(&PUT),
        tasks::SEARCH_AREA.meaning(&PUT),
        tasks::SEARCH_AROUND.meaning(&PUT),
        tasks::SEARCH_FROM_ORIGIN.meaning(&PUT),
        tasks::LINE.meaning(&PUT),
        tasks::ORBIT.meaning(&PUT),
        Form::new(
            &[
                Argument::flag("rehearse", ""),
                Argument::keyed("wind", "from", HEADING, "argument-wind-from"),
                Argument::value("speed", WIND_SPEED, "argument-wind-speed"),
            ],
            |given| {
                let wind = Wind {
                    from_deg: given.required("from")? as f32,
                    speed_m_s: given.required("speed")? as f32,
                };
                Ok(Meaning::Act(Act::Rehearse { wind: Some(wind) }))
            },
        )
        .meaning(&REHEARSE),
        Form::new(&[Argument::flag("rehearse", "")], |_| {
            Ok(Meaning::Act(Act::Rehearse { wind: None }))
        })
        .meaning(&REHEARSE),
        Form::new(&[Argument::flag("clear", "")], |_| {
            deed(ListKind::Plan, PlanDeed::Clear)
        })
        .meaning(&PUT),
        Form::new(&[Argument::flag("show", "")], |_| {
            deed(ListKind::Plan, PlanDeed::Show)
        }),
        Form::new(&[Argument::flag("status", "")], |_| carried(ListKind::Plan)),
        Form::new(&[Argument::flag("start", "")], |_| {
            flight(PlanFlight::Start)
        })
        .meaning(&START),
        Form::new(
            &[
                Argument::flag("goto", ""),
                Argument::value("item", ITEM, "argument-plan-item"),
            ],
            |given| {
                let item = given.required("item")? as u16;
                flight(PlanFlight::Goto { item })
            },
        )
        .meaning(&GOTO),
        Form::new(&[Argument::flag("pause", "")], |_| {
            flight(PlanFlight::Pause)
        })
        .meaning(&PAUSE),
        Form::new(
            &[
                Argument::flag("resume", ""),
                Argument::keyed("from", "item", ITEM, "argument-plan-item").optional(),
            ],
            |given| resume(given.number("item")),
        )
        .meaning(&RESUME),
        Form::new(
            &[
                Argument::flag("resume", ""),
                Argument::value("item", ITEM, "argument-plan-item"),
            ],
            |given| resume(Some(given.required("item")?)),
        )
        .meaning(&RESUME)
        .shortcut(),
        Form::new(&[Argument::flag("skip", "")], |_| flight(PlanFlight::Skip)).meaning(&SKIP),
        Form::new(&[Argument::flag("abort", "")], |_| {
            flight(PlanFlight::Abort)
        })
        .meaning(&ABORT),
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
        "all fence status",
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
        Form::new(&[Argument::flag("status", "")], |_| {
            carried(ListKind::Fence)
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
        "all rally status",
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
        Form::new(&[Argument::flag("status", "")], |_| {
            carried(ListKind::Rally)
        }),
    ],
};
