//! The verb that delays a script.

use std::time::Duration;

use strum::VariantNames as _;

use super::Built;
use crate::language::argument::{Argument, Arguments, Kind, Unit};
use crate::language::verb::{Form, Meaning, Scope, VerbRow};
use crate::language::wait::{DEFAULT_TIMEOUT, Field, Relation, Situation, Until, Wait};
use crate::verb::Verb;

pub(super) static ROWS: &[VerbRow] = &[WAIT];

/// Times in scripts: up to a day.
const TIME: Kind = Kind::Number(Unit::Seconds, 0.0, 86_400.0);
const TIMEOUT: Argument =
    Argument::keyed("timeout", "timeout", TIME, "argument-timeout").optional();
const RELATION: Argument = Argument::value("relation", Kind::Choice(Relation::VARIANTS), "");

const WAIT: VerbRow = VerbRow {
    verb: Verb::unsent("wait"),
    scope: Scope::Scripts,
    aliases: &[],
    examples: &[
        "wait 5s",
        "wait all altitude > 19 timeout 30s",
        "wait all arrived",
        "wait 1-3 mode GUIDED timeout 10s",
        "wait all disarmed timeout 3min",
        "wait contacts >= 3 timeout 2min",
        "wait 1 reading > 20",
        "wait alerts >= 1 timeout 2min",
    ],
    forms: &[
        Form::new(
            &[Argument::value("time", TIME, "argument-pause")],
            |given| wait(given, Until::Passed(seconds(given.required("time")?))),
        ),
        Form::new(
            &[
                Argument::value("situation", Kind::Choice(Situation::VARIANTS), ""),
                TIMEOUT,
            ],
            |given| wait(given, Until::Situation(given.required_choice("situation")?)),
        ),
        Form::new(
            &[
                Argument::flag("mode", "argument-in-mode"),
                Argument::value("name", Kind::Mode, "argument-name-or-number"),
                TIMEOUT,
            ],
            |given| wait(given, Until::Mode(given.required_word("name")?.to_owned())),
        ),
        Form::new(
            &[
                Argument::value(
                    "field",
                    Kind::Choice(&[Field::Altitude.into_str(), Field::Distance.into_str()]),
                    "argument-altitude-or-distance",
                ),
                RELATION,
                Argument::value("value", Kind::Number(Unit::Metres, -10_000.0, 1e6), ""),
                TIMEOUT,
            ],
            compare,
        ),
        Form::new(
            &[
                Argument::value(
                    "field",
                    Kind::Choice(&[Field::Speed.into_str()]),
                    "argument-ground-speed",
                ),
                RELATION,
                Argument::value(
                    "value",
                    Kind::Number(Unit::MetresPerSecond, 0.0, 1000.0),
                    "",
                ),
                TIMEOUT,
            ],
            compare,
        ),
        Form::new(
            &[
                Argument::value(
                    "field",
                    Kind::Choice(&[Field::Battery.into_str()]),
                    "argument-charge",
                ),
                RELATION,
                Argument::value("value", Kind::Number(Unit::Percent, 0.0, 100.0), ""),
                TIMEOUT,
            ],
            compare,
        ),
        Form::new(
            &[
                Argument::value(
                    "field",
                    Kind::Choice(&[Field::Heading.into_str()]),
                    "argument-heading",
                ),
                RELATION,
                Argument::value("value", Kind::Number(Unit::Degrees, 0.0, 360.0), ""),
                TIMEOUT,
            ],
            compare,
        ),
        Form::new(
            &[
                Argument::value(
                    "field",
                    Kind::Choice(&[Field::Reading.into_str()]),
                    "argument-reading",
                ),
                RELATION,
                Argument::value("value", Kind::Number(Unit::None, 0.0, 1e9), ""),
                TIMEOUT,
            ],
            compare,
        ),
        Form::new(
            &[
                Argument::value(
                    "field",
                    Kind::Choice(&[Field::Contacts.into_str()]),
                    "argument-contact-count",
                ),
                RELATION,
                Argument::value("value", Kind::Whole(Unit::None, 0.0, 1e6), ""),
                TIMEOUT,
            ],
            compare,
        ),
        Form::new(
            &[
                Argument::value(
                    "field",
                    Kind::Choice(&[Field::Alerts.into_str()]),
                    "argument-alert-count",
                ),
                RELATION,
                Argument::value("value", Kind::Whole(Unit::None, 0.0, 1e6), ""),
                TIMEOUT,
            ],
            compare,
        ),
        Form::new(
            &[
                Argument::value(
                    "field",
                    Kind::Choice(&[Field::Satellites.into_str()]),
                    "argument-satellites",
                ),
                RELATION,
                Argument::value("value", Kind::Whole(Unit::None, 0.0, 255.0), ""),
                TIMEOUT,
            ],
            compare,
        ),
    ],
};

fn compare(given: &Arguments) -> Built {
    wait(
        given,
        Until::Compared {
            field: given.required_choice("field")?,
            relation: given.required_choice("relation")?,
            value: given.required("value")?,
        },
    )
}

#[expect(
    clippy::unnecessary_wraps,
    reason = "it is the last expression of functions that can fail"
)]
fn wait(given: &Arguments, until: Until) -> Built {
    let timeout = given.number("timeout").map_or(DEFAULT_TIMEOUT, seconds);
    Ok(Meaning::Wait(Wait { until, timeout }))
}

/// Converts a time; the ranges of the table exclude negative and infinite times.
fn seconds(time: f64) -> Duration {
    Duration::try_from_secs_f64(time).unwrap_or(DEFAULT_TIMEOUT)
}
