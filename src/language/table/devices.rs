//! Verbs about outputs, messages, parameters, logs and keys.

use strum::VariantNames as _;

use super::{Built, command, confirmed, question, raw, setting, swarm};
use crate::commands::{
    Act, Command, ControlChange, DeviceCommand, FileCommand, LogChoice, LogCommand, LogGroup,
    ParameterCommand, QueryCommand, StickChange,
};
use crate::language::argument::{Argument, Arguments, Kind, Switch, Unit};
use crate::language::verb::{Form, Meaning, Scope, VerbRow};
use crate::signing::SigningChange;
use crate::verb::{CountsAs, CrewDuty, Verb};

pub(super) static ROWS: &[VerbRow] = &[
    SERVO,
    RELAY,
    REBOOT,
    INTERVAL,
    REQUEST,
    PARAM,
    raw::LONG,
    raw::INT,
    raw::SEND,
    LOGS,
    SIGNING,
    CONTROL,
    RC,
];

const SERVO: VerbRow = VerbRow {
    verb: setting("servo"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["servo 9 1500us"],
    forms: &[Form::new(
        &[
            Argument::value(
                "output",
                Kind::Whole(Unit::None, 1.0, 16.0),
                "argument-output",
            ),
            Argument::value(
                "pulse",
                Kind::Whole(Unit::Microseconds, 500.0, 2500.0),
                "argument-pulse",
            ),
        ],
        |given| {
            command(Command::Device(DeviceCommand::Servo {
                output: given.required("output")? as u8,
                pulse_us: given.required("pulse")? as u16,
            }))
        },
    )],
};

const RELAY: VerbRow = VerbRow {
    verb: setting("relay"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &[
        "relay 0 on",
        "2-4 relay to n 900 e 0 up 60",
        "2-4 relay to vehicle 1",
    ],
    forms: &[
        Form::new(
            &[
                Argument::value(
                    "relay",
                    Kind::Whole(Unit::None, 0.0, 15.0),
                    "argument-relay",
                ),
                Argument::value("state", Switch::KIND, ""),
            ],
            |given| {
                command(Command::Device(DeviceCommand::Relay {
                    relay: given.required("relay")? as u8,
                    on: given.required_switch("state")?,
                }))
            },
        ),
        swarm::CHAIN_TO_PLACE,
        swarm::CHAIN_TO_VEHICLE,
        swarm::CHAIN_TO_POINT,
    ],
};

const REBOOT: VerbRow = VerbRow {
    verb: confirmed("reboot"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["2 reboot"],
    forms: &[Form::new(&[], |_| {
        command(Command::Device(DeviceCommand::Reboot))
    })],
};

const INTERVAL: VerbRow = VerbRow {
    verb: question("interval"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["interval ATTITUDE 10", "interval 33 2Hz"],
    forms: &[Form::new(
        &[
            Argument::value("message", Kind::Message, "argument-name-or-id"),
            Argument::value("rate", Kind::Number(Unit::Hertz, 0.0, 1000.0), ""),
        ],
        |given| {
            command(Command::Query(QueryCommand::Interval {
                message: given.required("message")? as u32,
                rate_hz: given.required("rate")?,
            }))
        },
    )],
};

const REQUEST: VerbRow = VerbRow {
    verb: question("request"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["request AUTOPILOT_VERSION", "1 request 242"],
    forms: &[Form::new(
        &[Argument::value(
            "message",
            Kind::Message,
            "argument-name-or-id",
        )],
        |given| {
            command(Command::Query(QueryCommand::Request {
                message: given.required("message")? as u32,
            }))
        },
    )],
};

const PARAM: VerbRow = VerbRow {
    verb: setting("param"),
    scope: Scope::Everywhere,
    aliases: &["parameter"],
    examples: &[
        "param get WPNAV_SPEED",
        "all param set WPNAV_SPEED 500",
        "param docs",
    ],
    forms: &[
        Form::new(
            &[
                Argument::flag("get", "argument-parameter-get"),
                Argument::value("name", Kind::Parameter, "argument-parameter-name"),
            ],
            |given| {
                let name = given.required_word("name")?.to_owned();
                command(Command::Parameter(ParameterCommand::Get { name }))
            },
        ),
        Form::new(
            &[
                Argument::flag("set", "argument-parameter-set"),
                Argument::value("name", Kind::Parameter, "argument-parameter-name"),
                Argument::value("value", raw::ANY, "argument-parameter-value"),
            ],
            |given| {
                command(Command::Parameter(ParameterCommand::Set {
                    name: given.required_word("name")?.to_owned(),
                    value: given.required("value")?,
                }))
            },
        ),
        Form::new(&[Argument::flag("docs", "argument-parameter-docs")], |_| {
            command(Command::File(FileCommand::Documentation))
        }),
    ],
};

const TO_FOLDER: Argument =
    Argument::keyed("to", "folder", Kind::Rest, "argument-log-folder").optional();

const LOGS: VerbRow = VerbRow {
    verb: question("logs"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &[
        "logs list",
        "all logs download",
        "logs download 12 to ~/logs",
        "logs download all",
        "all logs stop",
    ],
    forms: &[
        Form::new(&[Argument::flag("list", "")], |_| {
            command(Command::Log(LogCommand::List))
        }),
        Form::new(&[Argument::flag("stop", "")], |_| {
            command(Command::Log(LogCommand::Stop))
        }),
        Form::new(
            &[
                Argument::flag("download", ""),
                Argument::value("which", Kind::Choice(LogGroup::VARIANTS), "").optional(),
                TO_FOLDER,
            ],
            |given| {
                let group: Option<LogGroup> = given.choice("which")?;
                Ok(download(LogChoice::Group(group.unwrap_or_default()), given))
            },
        ),
        Form::new(
            &[
                Argument::flag("download", ""),
                Argument::value(
                    "number",
                    Kind::Whole(Unit::None, 0.0, u16::MAX as f64),
                    "argument-log-number",
                ),
                TO_FOLDER,
            ],
            |given| {
                let number = given.required("number")? as u16;
                Ok(download(LogChoice::Number(number), given))
            },
        ),
    ],
};

fn download(which: LogChoice, given: &Arguments) -> Meaning {
    let folder = given.word("folder").map(str::to_owned);
    let download = LogCommand::Download { which, folder };
    Meaning::Act(Act::Command(Command::Log(download)))
}

/// The signing key crosses the link in clear text, so each change must be confirmed with a second
/// key press.
const SIGNING: VerbRow = VerbRow {
    verb: Verb {
        counts_as: CountsAs::Setting,
        duty: CrewDuty::Flying,
        unsuited: &[],
        ..confirmed("signing")
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["3 signing setup", "all signing rotate", "signing remove"],
    forms: &[
        Form::new(&[Argument::flag("setup", "argument-signing-setup")], |_| {
            command(Command::Signing(SigningChange::SetUp))
        }),
        Form::new(
            &[Argument::flag("rotate", "argument-signing-rotate")],
            |_| command(Command::Signing(SigningChange::Rotate)),
        ),
        Form::new(
            &[Argument::flag("remove", "argument-signing-remove")],
            |_| command(Command::Signing(SigningChange::Remove)),
        ),
    ],
};

const CONTROL: VerbRow = VerbRow {
    verb: setting("control"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &[
        "3 control request",
        "3 control allow 10",
        "all control release",
    ],
    forms: &[
        Form::new(
            &[
                Argument::flag("request", "argument-control-request"),
                Argument::flag("takeover", "argument-control-takeover").optional(),
            ],
            |given| {
                let takeover = given.flag("takeover");
                control(ControlChange::Request { takeover })
            },
        ),
        Form::new(
            &[Argument::flag("release", "argument-control-release")],
            |_| control(ControlChange::Release),
        ),
        Form::new(
            &[
                Argument::flag("allow", "argument-control-allow"),
                Argument::value(
                    "seconds",
                    Kind::Whole(Unit::Seconds, 3.0, 60.0),
                    "argument-control-seconds",
                )
                .optional(),
            ],
            |given| {
                let seconds = given.number("seconds").unwrap_or(ALLOWED_S) as u16;
                control(ControlChange::Allow { seconds })
            },
        ),
    ],
};

/// How long another station may take control, if the line does not say, in seconds.
const ALLOWED_S: f64 = 10.0;

fn control(change: ControlChange) -> Built {
    command(Command::Device(DeviceCommand::Control(change)))
}

const RC: VerbRow = VerbRow {
    verb: setting("rc"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["rc 3 1500us", "rc release"],
    forms: &[
        Form::new(&[Argument::flag("release", "argument-rc-release")], |_| {
            sticks(StickChange::Release)
        }),
        Form::new(
            &[
                Argument::value(
                    "channel",
                    Kind::Whole(Unit::None, 1.0, 16.0),
                    "argument-rc-channel",
                ),
                Argument::value(
                    "pulse",
                    Kind::Whole(Unit::Microseconds, 800.0, 2200.0),
                    "argument-pulse",
                ),
            ],
            |given| {
                sticks(StickChange::Hold {
                    channel: given.required("channel")? as u8,
                    pulse_us: given.required("pulse")? as u16,
                })
            },
        ),
    ],
};

fn sticks(change: StickChange) -> Built {
    command(Command::Device(DeviceCommand::Sticks(change)))
}
