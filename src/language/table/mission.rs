//! Verbs for a mission: payloads, reports, and the trainee's prediction and goal.

use std::time::Duration;

use strum::VariantNames as _;

use super::{Built, ONCE, deed};
use crate::commands::{Deed, FindKind, Goal, GoalComponent, Spot, Subject};
use crate::language::argument::{Argument, Arguments, Kind, Switch, Unit};
use crate::language::verb::{Form, Scope, VerbRow};
use crate::verb::{CountsAs, CrewDuty, Danger, Movement, Precedence, Verb};

pub(super) static ROWS: &[VerbRow] = &[
    MARK, UNMARK, SAMPLE, DROP, SPRAY, PREDICT, GOAL, HINT, WORKLOAD,
];

const WAY: Kind = Kind::Number(Unit::Metres, -20_000.0, 20_000.0);
const POINTS: Kind = Kind::Whole(Unit::None, 0.0, 1000.0);
const AS: Argument =
    Argument::keyed("as", "kind", Kind::Choice(FindKind::NAMES), "argument-kind").optional();
const NORTH: Argument = Argument::keyed("n", "north", WAY, "argument-north-of-origin");
const EAST: Argument = Argument::keyed("e", "east", WAY, "argument-east-of-origin");
const PLACE: Argument = Argument::value("point", Kind::Point, "argument-place");

fn mark(given: &Arguments, subject: Subject) -> Built {
    deed(Deed::Mark {
        subject,
        kind: given.choice("kind")?,
    })
}

fn offset(given: &Arguments) -> Result<Spot, super::Problem> {
    Ok(Spot::Offset {
        north_m: given.required("north")?,
        east_m: given.required("east")?,
    })
}

const MARK: VerbRow = VerbRow {
    verb: Verb {
        name: "mark",
        danger: Danger::None,
        retry: ONCE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Report,
        duty: CrewDuty::Sensors,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &["report"],
    examples: &[
        "1 mark",
        "1 mark c3 as mine",
        "2 mark confirmed as mine",
        "1 mark n 40 e -12 as source",
    ],
    forms: &[
        Form::new(
            &[Argument::flag("contacts", "argument-contacts"), AS],
            |given| mark(given, Subject::Contacts { confirmed: false }),
        ),
        Form::new(
            &[Argument::flag("confirmed", "argument-confirmed"), AS],
            |given| mark(given, Subject::Contacts { confirmed: true }),
        ),
        Form::new(&[NORTH, EAST, AS], |given| {
            mark(given, Subject::Spot(offset(given)?))
        }),
        Form::new(&[PLACE, AS], |given| {
            let place = given.required_point("point")?;
            mark(given, Subject::Spot(Spot::At(place)))
        }),
        Form::new(&[AS], |given| mark(given, Subject::Spot(Spot::Here))),
    ],
};

const UNMARK: VerbRow = VerbRow {
    verb: Verb {
        name: "unmark",
        danger: Danger::None,
        retry: ONCE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Report,
        duty: CrewDuty::Sensors,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["1 unmark", "1 unmark c3"],
    forms: &[
        Form::new(&[NORTH, EAST], |given| {
            deed(Deed::Unmark {
                spot: offset(given)?,
            })
        }),
        Form::new(&[PLACE], |given| {
            let spot = Spot::At(given.required_point("point")?);
            deed(Deed::Unmark { spot })
        }),
        Form::new(&[], |_| deed(Deed::Unmark { spot: Spot::Here })),
    ],
};

const SAMPLE: VerbRow = VerbRow {
    verb: Verb {
        name: "sample",
        danger: Danger::None,
        retry: ONCE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Task,
        duty: CrewDuty::Sensors,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["1 sample"],
    forms: &[Form::new(&[], |_| deed(Deed::Sample))],
};

const DROP: VerbRow = VerbRow {
    verb: Verb {
        name: "drop",
        danger: Danger::None,
        retry: ONCE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Task,
        duty: CrewDuty::Sensors,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["3 drop"],
    forms: &[Form::new(&[], |_| deed(Deed::Drop))],
};

const SPRAY: VerbRow = VerbRow {
    verb: Verb {
        name: "spray",
        danger: Danger::None,
        retry: ONCE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Setting,
        duty: CrewDuty::Sensors,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["3 spray on", "all spray off"],
    forms: &[Form::new(
        &[Argument::value("state", Switch::KIND, "")],
        |given| {
            deed(Deed::Spray {
                on: given.required_switch("state")?,
            })
        },
    )],
};

const PREDICT: VerbRow = VerbRow {
    verb: Verb {
        name: "predict",
        danger: Danger::None,
        retry: ONCE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Pledge,
        duty: CrewDuty::Flying,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["1 predict 800"],
    forms: &[Form::new(
        &[Argument::value("points", POINTS, "argument-points")],
        |given| {
            let points = given.required("points")? as u16;
            deed(Deed::Predict { points })
        },
    )],
};

const GOAL: VerbRow = VerbRow {
    verb: Verb {
        name: "goal",
        danger: Danger::None,
        retry: ONCE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Pledge,
        duty: CrewDuty::Flying,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &[
        "1 goal time 200s",
        "1 goal battery 35%",
        "1 goal score 850",
        "1 goal safety",
    ],
    forms: &[
        Form::new(
            &[Argument::keyed(
                "time",
                "duration",
                Kind::Number(Unit::Seconds, 1.0, 86_400.0),
                "argument-goal-time",
            )],
            |given| {
                let time = Duration::from_secs_f64(given.required("duration")?);
                deed(Deed::Goal(Goal::Time(time)))
            },
        ),
        Form::new(
            &[Argument::keyed(
                "battery",
                "percent",
                Kind::Number(Unit::Percent, 0.0, 100.0),
                "argument-goal-battery",
            )],
            |given| deed(Deed::Goal(Goal::Battery(given.required("percent")?))),
        ),
        Form::new(
            &[Argument::keyed(
                "score",
                "points",
                POINTS,
                "argument-goal-score",
            )],
            |given| deed(Deed::Goal(Goal::Score(given.required("points")? as u16))),
        ),
        Form::new(
            &[Argument::value(
                "component",
                Kind::Choice(GoalComponent::VARIANTS),
                "argument-goal-component",
            )],
            |given| {
                let component = given.required_choice("component")?;
                deed(Deed::Goal(Goal::Faultless(component)))
            },
        ),
    ],
};

const WORKLOAD: VerbRow = VerbRow {
    verb: Verb {
        name: "workload",
        danger: Danger::None,
        retry: ONCE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::SelfReport,
        duty: CrewDuty::Sensors,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["1 workload 3"],
    forms: &[Form::new(
        &[Argument::value(
            "level",
            Kind::Whole(Unit::None, 1.0, 5.0),
            "argument-workload",
        )],
        |given| {
            let level = given.required("level")? as u8;
            deed(Deed::Workload { level })
        },
    )],
};

const HINT: VerbRow = VerbRow {
    verb: Verb {
        name: "hint",
        danger: Danger::None,
        retry: ONCE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Word,
        duty: CrewDuty::Sensors,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["1 hint"],
    forms: &[Form::new(&[], |_| deed(Deed::Hint))],
};
