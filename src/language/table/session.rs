//! Verbs that start, control and end sessions.

use super::console;
use crate::language::argument::{Argument, Arguments, Kind, Problem, Unit};
use crate::language::console::{
    ConsoleLine, ForwardLine, MessagesLine, ProcessDeed, RadioChoice, Report,
};
use crate::language::names::NameList;
use crate::language::radio::{PRESETS, radio_test};
use crate::language::verb::{Form, Meaning, Scope, VerbRow};
use crate::vehicle::VehicleId;
use crate::vehicle_id::HIGHEST_VEHICLE;
use crate::verb::Verb;

pub(super) static ROWS: &[VerbRow] = &[
    HANGAR, MACRO, FLY, CONNECT, FORWARD, MESSAGES, RADIO, INJECT, PAUSE, CONTINUE, SPEEDUP,
    ABANDON, RESTART, LEAVE, QUIT,
];

const VEHICLE: Kind = Kind::Whole(Unit::None, 1.0, HIGHEST_VEHICLE as f64);

const SPEEDUP_RATE: Kind = Kind::Number(Unit::None, 0.1, 1000.0);

/// A console verb, with or without a screen.
const fn said(
    name: &'static str,
    examples: &'static [&'static str],
    forms: &'static [Form],
) -> VerbRow {
    VerbRow {
        verb: Verb::unsent(name),
        scope: Scope::Console,
        aliases: &[],
        examples,
        forms,
    }
}

const HANGAR: VerbRow = said(
    "hangar",
    &["hangar", "hangar restart 2"],
    &[
        Form::new(&[], |_| console(ConsoleLine::Report(Report::Hangar))),
        Form::new(
            &[Argument::keyed("restart", "vehicle", VEHICLE, "")],
            |given| {
                console(ConsoleLine::Process {
                    deed: ProcessDeed::Restart,
                    vehicle: given.required("vehicle")? as VehicleId,
                })
            },
        ),
        Form::new(
            &[Argument::keyed("stop", "vehicle", VEHICLE, "")],
            |given| {
                console(ConsoleLine::Process {
                    deed: ProcessDeed::Stop,
                    vehicle: given.required("vehicle")? as VehicleId,
                })
            },
        ),
    ],
);

const MACRO: VerbRow = said(
    "macro",
    &["macro launch"],
    &[Form::new(
        &[Argument::value("name", Kind::Name(NameList::Macro), "")],
        |given| console(ConsoleLine::Macro(given.required_word("name")?.to_owned())),
    )],
);

const FLY: VerbRow = said(
    "fly",
    &["fly", "fly 01"],
    &[Form::new(
        &[Argument::value("mission", Kind::Name(NameList::Mission), "").optional()],
        |given| {
            console(match given.word("mission") {
                Some(id) => ConsoleLine::Fly(id.to_owned()),
                None => ConsoleLine::FlyFree,
            })
        },
    )],
);

const CONNECT: VerbRow = said(
    "connect",
    &["connect udpin:0.0.0.0:14550", "connect tcp:127.0.0.1:5760"],
    &[Form::new(
        &[Argument::value("address...", Kind::Rest, "")],
        |given| {
            let addresses = given.required_word("address...")?.split_whitespace();
            console(ConsoleLine::Connect(addresses.map(str::to_owned).collect()))
        },
    )],
);

const FORWARD: VerbRow = said(
    "forward",
    &[
        "forward add udp:192.168.1.20:14550",
        "forward add tcpin:127.0.0.1:5790 read-only rate 2",
        "forward remove tcpin:127.0.0.1:5790",
        "forward",
    ],
    &[
        Form::new(&[], |_| console(ConsoleLine::Report(Report::Links))),
        Form::new(
            &[Argument::keyed(
                "add",
                "address...",
                Kind::Rest,
                "argument-forward",
            )],
            |given| {
                let words = given.required_word("address...")?.to_owned();
                console(ConsoleLine::Forward(ForwardLine::Add(words)))
            },
        ),
        Form::new(
            &[Argument::keyed("remove", "address", Kind::Rest, "")],
            |given| {
                let address = given.required_word("address")?.trim().to_owned();
                console(ConsoleLine::Forward(ForwardLine::Remove(address)))
            },
        ),
    ],
);

const MESSAGES: VerbRow = said(
    "messages",
    &["messages reset", "messages export link.csv"],
    &[
        Form::new(
            &[Argument::flag("reset", "argument-messages-reset")],
            |_| console(ConsoleLine::Messages(MessagesLine::Reset)),
        ),
        Form::new(
            &[Argument::keyed(
                "export",
                "file",
                Kind::Rest,
                "argument-messages-file",
            )],
            |given| {
                let file = given.required_word("file")?.trim().to_owned();
                console(ConsoleLine::Messages(MessagesLine::Export(file)))
            },
        ),
    ],
);

const TARGETS: Argument = Argument::value("targets", Kind::Vehicles, "").optional();
const LINK: Argument = Argument::keyed(
    "link",
    "number",
    Kind::Whole(Unit::None, 1.0, 255.0),
    "argument-radio-link",
);
const RADIO_PRESET: Argument =
    Argument::value("preset", Kind::Choice(PRESETS), "argument-radio-preset");
const RADIO_SETTINGS: Argument = Argument::value("settings", Kind::Rest, "argument-radio-settings");

const RADIO: VerbRow = said(
    "radio",
    &[
        "radio 3 edge",
        "radio all loss=5 delay=80 jitter=20 rate=1200",
        "radio link 2 poor",
        "radio all off",
    ],
    &[
        Form::new(&[TARGETS, RADIO_PRESET, RADIO_SETTINGS.optional()], radio),
        Form::new(&[LINK, RADIO_PRESET, RADIO_SETTINGS.optional()], radio),
        Form::new(&[LINK, RADIO_SETTINGS], radio),
        Form::new(&[TARGETS, RADIO_SETTINGS], radio),
    ],
);

fn radio(given: &Arguments) -> Result<Meaning, Problem> {
    let preset = given.word("preset").unwrap_or_default();
    let settings = given.word("settings").unwrap_or_default();
    let test = radio_test(preset, settings);
    let choice = match (given.number("number"), given.vehicles("targets")) {
        (Some(number), _) => RadioChoice::Link(number as usize),
        (None, Some(vehicles)) => RadioChoice::Vehicles(vehicles),
        (None, None) => RadioChoice::Addressed,
    };
    console(ConsoleLine::Radio {
        choice,
        test: test.map_err(|fault| Problem::within("settings", fault))?,
    })
}

const INJECT: VerbRow = said(
    "inject",
    &["inject gust"],
    &[Form::new(
        &[Argument::value("name", Kind::Name(NameList::Inject), "")],
        |given| console(ConsoleLine::Inject(given.required_word("name")?.to_owned())),
    )],
);

const PAUSE: VerbRow = said(
    "pause",
    &[],
    &[Form::new(&[], |_| console(ConsoleLine::Pause))],
);

const CONTINUE: VerbRow = said(
    "continue",
    &[],
    &[Form::new(&[], |_| console(ConsoleLine::Continue))],
);

const SPEEDUP: VerbRow = said(
    "speedup",
    &["speedup 4", "speedup 1"],
    &[Form::new(
        &[Argument::value("rate", SPEEDUP_RATE, "argument-speedup")],
        |given| console(ConsoleLine::Speedup(given.required("rate")?)),
    )],
);

const ABANDON: VerbRow = said(
    "abandon",
    &[],
    &[Form::new(&[], |_| console(ConsoleLine::Abandon))],
);

const RESTART: VerbRow = said(
    "restart",
    &[],
    &[Form::new(&[], |_| console(ConsoleLine::Restart))],
);

const LEAVE: VerbRow = said(
    "leave",
    &[],
    &[Form::new(&[], |_| console(ConsoleLine::Leave))],
);

const QUIT: VerbRow = said(
    "quit",
    &[],
    &[Form::new(&[], |_| console(ConsoleLine::Quit))],
);
