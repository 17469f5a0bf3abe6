//! Verbs that start, end and interrupt a flight.

use super::{AT_ONCE, Built, CHANGE, COME_DOWN, STOP_MOTORS, command};
use crate::commands::{ArmingCommand, Command, FlightCommand};
use crate::language::argument::{Argument, Arguments, Kind, Unit};
use crate::language::verb::{Form, Scope, VerbRow};
use crate::verb::{Arrival, CountsAs, CrewDuty, Danger, Movement, Precedence, Unsuited, Verb};

pub(super) static ROWS: &[VerbRow] = &[ARM, DISARM, KILL, MODE, TAKEOFF, LAND, RTL, HOLD, RESUME];

const ARM: VerbRow = VerbRow {
    verb: Verb {
        name: "arm",
        danger: Danger::None,
        retry: AT_ONCE,
        precedence: Precedence::Awaited,
        movement: Movement::None,
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["arm", "all arm"],
    forms: &[Form::new(&[], |_| {
        command(Command::Arming(ArmingCommand::Arm))
    })],
};

const DISARM: VerbRow = VerbRow {
    verb: Verb {
        name: "disarm",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::Urgent,
        movement: Movement::To(Arrival::Landed),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Safety,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["disarm"],
    forms: &[Form::new(&[], |_| {
        command(Command::Arming(ArmingCommand::Disarm))
    })],
};

const KILL: VerbRow = VerbRow {
    verb: Verb {
        name: "kill",
        danger: Danger::Confirm,
        retry: STOP_MOTORS,
        precedence: Precedence::Urgent,
        movement: Movement::To(Arrival::Landed),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Safety,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["3 kill"],
    forms: &[Form::new(&[], |_| {
        command(Command::Arming(ArmingCommand::Kill))
    })],
};

const MODE: VerbRow = VerbRow {
    verb: Verb {
        name: "mode",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::ByMode,
        movement: Movement::To(Arrival::Mode),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["mode guided", "all loiter"],
    forms: &[Form::new(
        &[Argument::value(
            "mode",
            Kind::Mode,
            "argument-name-or-number",
        )],
        |given| {
            let name = given.required_word("mode")?.to_owned();
            command(Command::Flight(FlightCommand::SetMode { name }))
        },
    )],
};

const TAKEOFF: VerbRow = VerbRow {
    verb: Verb {
        name: "takeoff",
        danger: Danger::None,
        retry: AT_ONCE,
        precedence: Precedence::InTurn,
        movement: Movement::To(Arrival::Done),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: &[
            Unsuited::surface("unsuited-takeoff-surface"),
            Unsuited::fixed_wing("unsuited-takeoff-plane"),
        ],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["takeoff 20", "all takeoff 20m"],
    forms: &[Form::new(
        &[Argument::value(
            "altitude",
            Kind::Number(Unit::Metres, 0.5, 1000.0),
            "argument-height",
        )],
        takeoff,
    )],
};

fn takeoff(given: &Arguments) -> Built {
    command(Command::Flight(FlightCommand::Takeoff {
        altitude_m: given.required("altitude")?,
    }))
}

const LAND: VerbRow = VerbRow {
    verb: Verb {
        name: "land",
        danger: Danger::None,
        retry: COME_DOWN,
        precedence: Precedence::Urgent,
        movement: Movement::To(Arrival::Landed),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Safety,
        unsuited: &[
            Unsuited::surface("unsuited-land-surface"),
            Unsuited::plane("unsuited-land-plane"),
        ],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["land"],
    forms: &[Form::new(&[], |_| {
        command(Command::Flight(FlightCommand::Land))
    })],
};

const RTL: VerbRow = VerbRow {
    verb: Verb {
        name: "rtl",
        danger: Danger::None,
        retry: COME_DOWN,
        precedence: Precedence::Urgent,
        movement: Movement::To(Arrival::Landed),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Safety,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["all rtl"],
    forms: &[Form::new(&[], |_| {
        command(Command::Flight(FlightCommand::ReturnToLaunch))
    })],
};

const HOLD: VerbRow = VerbRow {
    verb: Verb {
        name: "hold",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::Urgent,
        movement: Movement::To(Arrival::Done),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Safety,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &["stop"],
    examples: &["all hold"],
    forms: &[Form::new(&[], |_| {
        command(Command::Flight(FlightCommand::Hold))
    })],
};

const RESUME: VerbRow = VerbRow {
    verb: Verb {
        name: "resume",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::InTurn,
        movement: Movement::To(Arrival::AtTarget),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: &[
            Unsuited::surface("unsuited-resume"),
            Unsuited::plane("unsuited-resume"),
        ],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["resume", "1-2 resume"],
    forms: &[Form::new(&[], |_| {
        command(Command::Flight(FlightCommand::Resume))
    })],
};
