//! Verbs that a mission understands: payloads, reports, and the trainee's word before launch.

use std::time::Duration;

use super::{Built, ONCE};
use crate::commands::{Deed, Goal, Spot, Subject};
use crate::language::argument::{Argument, Arguments, Kind, Unit};
use crate::language::verb::{Danger, Form, Meaning, Verb};

const WAY: Kind = Kind::Number(Unit::Metres, -20_000.0, 20_000.0);
const POINTS: Kind = Kind::Whole(Unit::None, 0.0, 1000.0);
const AS: Argument =
    Argument::keyed("as", "kind", Kind::Choice(Deed::KINDS), "argument-kind").optional();
const NORTH: Argument = Argument::keyed("n", "north", WAY, "argument-north-of-origin");
const EAST: Argument = Argument::keyed("e", "east", WAY, "argument-east-of-origin");
const PLACE: Argument = Argument::value("point", Kind::Point, "argument-place");

#[expect(
    clippy::unnecessary_wraps,
    reason = "it is the last expression of functions that can fail"
)]
fn deed(deed: Deed) -> Built {
    Ok(Meaning::Deed(deed))
}

/// The kind that was written, as the table spells it.
fn kind(given: &Arguments) -> Option<&'static str> {
    let word = given.word("kind")?;
    Deed::KINDS.iter().copied().find(|known| *known == word)
}

fn mark(given: &Arguments, subject: Subject) -> Built {
    deed(Deed::Mark {
        subject,
        kind: kind(given),
    })
}

fn offset(given: &Arguments) -> Result<Spot, super::Problem> {
    Ok(Spot::Offset {
        north_m: given.required("north")?,
        east_m: given.required("east")?,
    })
}

pub(super) const MARK: Verb = Verb {
    name: "mark",
    aliases: &["report"],
    examples: &[
        "1 mark",
        "1 mark c3 as mine",
        "2 mark confirmed as mine",
        "1 mark n 40 e -12 as source",
    ],
    forms: &[
        Form {
            arguments: &[Argument::flag("contacts", "argument-contacts"), AS],
            build: |given| mark(given, Subject::Contacts { confirmed: false }),
        },
        Form {
            arguments: &[Argument::flag("confirmed", "argument-confirmed"), AS],
            build: |given| mark(given, Subject::Contacts { confirmed: true }),
        },
        Form {
            arguments: &[NORTH, EAST, AS],
            build: |given| mark(given, Subject::Spot(offset(given)?)),
        },
        Form {
            arguments: &[PLACE, AS],
            build: |given| {
                let place = given.required_point("point")?;
                mark(given, Subject::Spot(Spot::At(place)))
            },
        },
        Form {
            arguments: &[AS],
            build: |given| mark(given, Subject::Spot(Spot::Here)),
        },
    ],
    danger: Danger::None,
    retry: ONCE,
};

pub(super) const UNMARK: Verb = Verb {
    name: "unmark",
    aliases: &[],
    examples: &["1 unmark", "1 unmark c3"],
    forms: &[
        Form {
            arguments: &[NORTH, EAST],
            build: |given| {
                deed(Deed::Unmark {
                    spot: offset(given)?,
                })
            },
        },
        Form {
            arguments: &[PLACE],
            build: |given| {
                let spot = Spot::At(given.required_point("point")?);
                deed(Deed::Unmark { spot })
            },
        },
        Form {
            arguments: &[],
            build: |_| deed(Deed::Unmark { spot: Spot::Here }),
        },
    ],
    danger: Danger::None,
    retry: ONCE,
};

pub(super) const SAMPLE: Verb = Verb {
    name: "sample",
    aliases: &[],
    examples: &["1 sample"],
    forms: &[Form {
        arguments: &[],
        build: |_| deed(Deed::Sample),
    }],
    danger: Danger::None,
    retry: ONCE,
};

pub(super) const DROP: Verb = Verb {
    name: "drop",
    aliases: &[],
    examples: &["3 drop"],
    forms: &[Form {
        arguments: &[],
        build: |_| deed(Deed::Drop),
    }],
    danger: Danger::None,
    retry: ONCE,
};

pub(super) const SPRAY: Verb = Verb {
    name: "spray",
    aliases: &[],
    examples: &["3 spray on", "all spray off"],
    forms: &[Form {
        arguments: &[Argument::value("state", Kind::Choice(&["on", "off"]), "")],
        build: |given| {
            let on = given.required_word("state")? == "on";
            deed(Deed::Spray { on })
        },
    }],
    danger: Danger::None,
    retry: ONCE,
};

pub(super) const PREDICT: Verb = Verb {
    name: "predict",
    aliases: &[],
    examples: &["1 predict 800"],
    forms: &[Form {
        arguments: &[Argument::value("points", POINTS, "argument-points")],
        build: |given| {
            let points = given.required("points")? as u16;
            deed(Deed::Predict { points })
        },
    }],
    danger: Danger::None,
    retry: ONCE,
};

pub(super) const GOAL: Verb = Verb {
    name: "goal",
    aliases: &[],
    examples: &[
        "1 goal time 200s",
        "1 goal battery 35%",
        "1 goal score 850",
        "1 goal safety",
    ],
    forms: &[
        Form {
            arguments: &[Argument::keyed(
                "time",
                "duration",
                Kind::Number(Unit::Seconds, 1.0, 86_400.0),
                "argument-goal-time",
            )],
            build: |given| {
                let time = Duration::from_secs_f64(given.required("duration")?);
                deed(Deed::Goal(Goal::Time(time)))
            },
        },
        Form {
            arguments: &[Argument::keyed(
                "battery",
                "percent",
                Kind::Number(Unit::Percent, 0.0, 100.0),
                "argument-goal-battery",
            )],
            build: |given| deed(Deed::Goal(Goal::Battery(given.required("percent")?))),
        },
        Form {
            arguments: &[Argument::keyed(
                "score",
                "points",
                POINTS,
                "argument-goal-score",
            )],
            build: |given| deed(Deed::Goal(Goal::Score(given.required("points")? as u16))),
        },
        Form {
            arguments: &[Argument::value(
                "component",
                Kind::Choice(&["safety", "commands", "attention"]),
                "argument-goal-component",
            )],
            build: |given| {
                deed(Deed::Goal(match given.required_word("component")? {
                    "safety" => Goal::Safety,
                    "commands" => Goal::Commands,
                    _ => Goal::Attention,
                }))
            },
        },
    ],
    danger: Danger::None,
    retry: ONCE,
};

pub(super) const HINT: Verb = Verb {
    name: "hint",
    aliases: &[],
    examples: &["1 hint"],
    forms: &[Form {
        arguments: &[],
        build: |_| deed(Deed::Hint),
    }],
    danger: Danger::None,
    retry: ONCE,
};
