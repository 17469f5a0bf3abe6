//! Verbs that start, end and interrupt a flight.

use super::{AT_ONCE, Built, CHANGE, COME_DOWN, STOP_MOTORS, command};
use crate::commands::Command;
use crate::language::argument::{Argument, Arguments, Kind, Unit};
use crate::language::verb::{Danger, Form, Verb};

pub(super) const ARM: Verb = Verb {
    name: "arm",
    aliases: &[],
    examples: &["arm", "all arm"],
    forms: &[Form {
        arguments: &[],
        build: |_| command(Command::Arm),
    }],
    danger: Danger::None,
    retry: AT_ONCE,
};

pub(super) const DISARM: Verb = Verb {
    name: "disarm",
    aliases: &[],
    examples: &["disarm"],
    forms: &[Form {
        arguments: &[],
        build: |_| command(Command::Disarm),
    }],
    danger: Danger::None,
    retry: CHANGE,
};

pub(super) const KILL: Verb = Verb {
    name: "kill",
    aliases: &[],
    examples: &["3 kill"],
    forms: &[Form {
        arguments: &[],
        build: |_| command(Command::Kill),
    }],
    danger: Danger::Confirm,
    retry: STOP_MOTORS,
};

pub(super) const MODE: Verb = Verb {
    name: "mode",
    aliases: &[],
    examples: &["mode guided", "all loiter"],
    forms: &[Form {
        arguments: &[Argument::value(
            "mode",
            Kind::Mode,
            "argument-name-or-number",
        )],
        build: |given| {
            let name = given.required_word("mode")?.to_owned();
            command(Command::SetMode { name })
        },
    }],
    danger: Danger::None,
    retry: CHANGE,
};

pub(super) const TAKEOFF: Verb = Verb {
    name: "takeoff",
    aliases: &[],
    examples: &["takeoff 20", "all takeoff 20m"],
    forms: &[Form {
        arguments: &[Argument::value(
            "altitude",
            Kind::Number(Unit::Metres, 0.5, 1000.0),
            "argument-height",
        )],
        build: takeoff,
    }],
    danger: Danger::None,
    retry: AT_ONCE,
};

fn takeoff(given: &Arguments) -> Built {
    command(Command::Takeoff {
        altitude_m: given.required("altitude")?,
    })
}

pub(super) const LAND: Verb = Verb {
    name: "land",
    aliases: &[],
    examples: &["land"],
    forms: &[Form {
        arguments: &[],
        build: |_| command(Command::Land),
    }],
    danger: Danger::None,
    retry: COME_DOWN,
};

pub(super) const RTL: Verb = Verb {
    name: "rtl",
    aliases: &[],
    examples: &["all rtl"],
    forms: &[Form {
        arguments: &[],
        build: |_| command(Command::ReturnToLaunch),
    }],
    danger: Danger::None,
    retry: COME_DOWN,
};

pub(super) const HOLD: Verb = Verb {
    name: "hold",
    aliases: &["stop"],
    examples: &["all hold"],
    forms: &[Form {
        arguments: &[],
        build: |_| command(Command::Hold),
    }],
    danger: Danger::None,
    retry: CHANGE,
};

pub(super) const RESUME: Verb = Verb {
    name: "resume",
    aliases: &[],
    examples: &["resume", "1-2 resume"],
    forms: &[Form {
        arguments: &[],
        build: |_| command(Command::Resume),
    }],
    danger: Danger::None,
    retry: CHANGE,
};
