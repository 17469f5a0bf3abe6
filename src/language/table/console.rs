//! Verbs about the screen and the selection of vehicles.

use strum::VariantNames as _;

use super::{Built, console};
use crate::alert::AlertKind;
use crate::config::{Column, LiveSetting, Setting, Symbols, TableSort};
use crate::language::argument::{Argument, Arguments, Kind, Problem, Switch, Unit};
use crate::language::console::{AlertLine, ConsoleLine, ParametersLine, Report, TableLine};
use crate::language::names::NameList;
use crate::language::verb::{Form, Scope, VerbRow};
use crate::text;
use crate::text::Language;
use crate::verb::Verb;

pub(super) static ROWS: &[VerbRow] = &[
    SHOW, SELECT, GROUP, UNGROUP, FORGET, SORT, FILTER, COLUMNS, ACK, MUTE, UNMUTE, PARAMS, SET,
    THEME, HELP, LINKS, LEDGER, NOTICES, TRAFFIC, BRIEF, STATUS, OBJECTIVES, CONTACTS,
];

const VEHICLES: Argument = Argument::value("targets", Kind::Vehicles, "");
const ALERT: Argument = Argument::value("kind", Kind::Choice(AlertKind::NAMES), "argument-alert");
const THEME_NAME: Argument = Argument::value("name", Kind::Name(NameList::Theme), "setting-theme");
const FPS: Kind = Kind::Whole(
    Unit::None,
    Setting::FPS_LEAST as f64,
    Setting::FPS_MOST as f64,
);

/// A verb that only shows a report, as text if there is no screen.
const fn shows(
    name: &'static str,
    aliases: &'static [&'static str],
    forms: &'static [Form],
) -> VerbRow {
    VerbRow {
        aliases,
        ..said(name, Scope::Console, forms)
    }
}

/// A console verb that needs no example.
const fn said(name: &'static str, scope: Scope, forms: &'static [Form]) -> VerbRow {
    VerbRow {
        verb: Verb::unsent(name),
        scope,
        aliases: &[],
        examples: &[],
        forms,
    }
}

fn report(report: Report) -> Built {
    console(ConsoleLine::Report(report))
}

fn table(line: TableLine) -> Built {
    console(ConsoleLine::Table(line))
}

fn alerts(line: AlertLine) -> Built {
    console(ConsoleLine::Alerts(line))
}

fn parameters(line: ParametersLine) -> Built {
    console(ConsoleLine::Parameters(line))
}

fn set(setting: LiveSetting) -> Built {
    console(ConsoleLine::Set(setting))
}

/// The value of a word that its kind has accepted.
fn meant<T>(
    given: &Arguments,
    name: &'static str,
    read: impl FnOnce(&str) -> Option<T>,
) -> Result<T, Problem> {
    read(given.required_word(name)?)
        .ok_or_else(|| Problem::new(name, text!("grammar-unknown-word")))
}

fn alert(given: &Arguments) -> Option<AlertKind> {
    given.choice("kind").ok().flatten()
}

fn path(given: &Arguments) -> Result<String, Problem> {
    given.required_word("file").map(str::to_owned)
}

const SHOW: VerbRow = VerbRow {
    examples: &["show map"],
    ..said(
        "show",
        Scope::Screen,
        &[Form::new(
            &[Argument::value("room", Kind::Name(NameList::Room), "")],
            |given| console(ConsoleLine::Show(given.required_word("room")?.to_owned())),
        )],
    )
};

const SELECT: VerbRow = VerbRow {
    examples: &["select 1-4", "select @red", "select none"],
    ..said(
        "select",
        Scope::Console,
        &[Form::new(&[VEHICLES], |given| {
            console(ConsoleLine::Select(given.required_vehicles("targets")?))
        })],
    )
};

const GROUP: VerbRow = VerbRow {
    examples: &["group red 1-3", "group blue"],
    ..said(
        "group",
        Scope::Console,
        &[Form::new(
            &[
                Argument::value("name", Kind::Group, ""),
                VEHICLES.optional(),
            ],
            |given| {
                console(ConsoleLine::Group {
                    name: given.required_word("name")?.to_owned(),
                    vehicles: given.vehicles("targets"),
                })
            },
        )],
    )
};

const UNGROUP: VerbRow = VerbRow {
    examples: &["ungroup red"],
    ..said(
        "ungroup",
        Scope::Console,
        &[Form::new(
            &[Argument::value("name", Kind::Group, "")],
            |given| {
                console(ConsoleLine::Ungroup(
                    given.required_word("name")?.to_owned(),
                ))
            },
        )],
    )
};

const FORGET: VerbRow = VerbRow {
    examples: &["forget", "forget 7-250"],
    ..said(
        "forget",
        Scope::Console,
        &[Form::new(&[VEHICLES.optional()], |given| {
            console(ConsoleLine::Forget(given.vehicles("targets")))
        })],
    )
};

const SORT: VerbRow = VerbRow {
    examples: &["sort", "sort bat", "sort -alt"],
    ..said(
        "sort",
        Scope::Screen,
        &[Form::new(
            &[Argument::value("column", Kind::Sort, "").optional()],
            |given| {
                let wanted = given.word("column").map(TableSort::read).transpose();
                let sort = wanted.map_err(|fault| Problem::new("column", fault.message))?;
                table(TableLine::Sort(sort.unwrap_or_default()))
            },
        )],
    )
};

const FILTER: VerbRow = VerbRow {
    examples: &["filter", "filter @red air", "filter bat<30"],
    ..said(
        "filter",
        Scope::Screen,
        &[Form::new(
            &[Argument::value("words", Kind::Rest, "").optional()],
            |given| {
                let rest = given.word("words").unwrap_or_default();
                let words: Vec<&str> = rest.split_whitespace().collect();
                table(TableLine::Filter(words.join(" ")))
            },
        )],
    )
};

const COLUMNS: VerbRow = VerbRow {
    examples: &["columns", "columns id mode bat alt"],
    ..said(
        "columns",
        Scope::Screen,
        &[Form::new(
            &[Argument::value("column", Kind::Choice(Column::NAMES), "").repeated()],
            |given| {
                let read = |word| Column::read(word);
                let wanted: Result<Vec<Column>, _> =
                    given.words("column").into_iter().map(read).collect();
                let columns = wanted.map_err(|fault| Problem::new("column", fault.message))?;
                table(TableLine::Columns(columns))
            },
        )],
    )
};

const ACK: VerbRow = VerbRow {
    examples: &["ack", "ack battery", "ack 3"],
    ..said(
        "ack",
        Scope::Console,
        &[
            Form::new(&[], |_| alerts(AlertLine::AcknowledgeWorst)),
            Form::new(&[ALERT], |given| {
                let kind = given.required_choice("kind")?;
                alerts(AlertLine::AcknowledgeKind(kind))
            }),
            Form::new(&[VEHICLES], |given| {
                let vehicles = given.required_vehicles("targets")?;
                alerts(AlertLine::AcknowledgeOf(vehicles))
            }),
        ],
    )
};

const MUTE: VerbRow = VerbRow {
    examples: &["mute", "mute gps"],
    ..said(
        "mute",
        Scope::Console,
        &[Form::new(&[ALERT.optional()], |given| {
            alerts(AlertLine::Mute(alert(given)))
        })],
    )
};

const UNMUTE: VerbRow = VerbRow {
    examples: &["unmute", "unmute gps"],
    ..said(
        "unmute",
        Scope::Console,
        &[Form::new(&[ALERT.optional()], |given| {
            alerts(AlertLine::Unmute(alert(given)))
        })],
    )
};

const PARAMS: VerbRow = VerbRow {
    examples: &["params fetch", "params save before.param", "params diff 2"],
    ..said(
        "params",
        Scope::Screen,
        &[
            Form::new(&[], |_| parameters(ParametersLine::Show)),
            Form::new(&[Argument::flag("fetch", "")], |_| {
                parameters(ParametersLine::Fetch)
            }),
            Form::new(
                &[Argument::keyed("save", "file", Kind::Rest, "argument-file")],
                |given| parameters(ParametersLine::Save(path(given)?)),
            ),
            Form::new(
                &[Argument::keyed("load", "file", Kind::Rest, "argument-file")],
                |given| parameters(ParametersLine::Compare(path(given)?)),
            ),
            Form::new(
                &[Argument::keyed(
                    "diff",
                    "file",
                    Kind::Rest,
                    "argument-file-or-vehicle",
                )],
                |given| parameters(ParametersLine::Compare(path(given)?)),
            ),
        ],
    )
};

const SET: VerbRow = VerbRow {
    examples: &["set lang uk", "set fps 10", "set bell off"],
    ..said(
        "set",
        Scope::Console,
        &[
            Form::new(
                &[Argument::keyed(
                    "theme",
                    "name",
                    Kind::Name(NameList::Theme),
                    "setting-theme",
                )],
                set_theme,
            ),
            Form::new(
                &[Argument::keyed(
                    "lang",
                    "value",
                    Kind::Choice(Language::CODES),
                    "setting-lang",
                )],
                |given| set(LiveSetting::Lang(meant(given, "value", Language::of)?)),
            ),
            Form::new(
                &[Argument::keyed(
                    "symbols",
                    "value",
                    Kind::Choice(Symbols::VARIANTS),
                    "setting-symbols",
                )],
                |given| set(LiveSetting::Symbols(given.required_choice("value")?)),
            ),
            Form::new(
                &[Argument::keyed("fps", "number", FPS, "setting-fps")],
                |given| set(LiveSetting::Fps(given.required("number")? as u8)),
            ),
            Form::new(
                &[Argument::keyed(
                    "bell",
                    "value",
                    Switch::KIND,
                    "setting-bell",
                )],
                |given| set(LiveSetting::Bell(given.required_switch("value")?)),
            ),
            Form::new(
                &[Argument::keyed(
                    "notify",
                    "value",
                    Switch::KIND,
                    "setting-notify",
                )],
                |given| set(LiveSetting::Notify(given.required_switch("value")?)),
            ),
        ],
    )
};

const THEME: VerbRow = VerbRow {
    examples: &["theme dark"],
    ..said(
        "theme",
        Scope::Screen,
        &[Form::new(&[THEME_NAME], set_theme).shortcut()],
    )
};

fn set_theme(given: &Arguments) -> Built {
    set(LiveSetting::Theme(given.required_word("name")?.to_owned()))
}

const HELP: VerbRow = shows("help", &[], &[Form::new(&[], |_| report(Report::Help))]);

const LINKS: VerbRow = shows("links", &[], &[Form::new(&[], |_| report(Report::Links))]);

const LEDGER: VerbRow = shows(
    "ledger",
    &["commands"],
    &[Form::new(&[], |_| report(Report::Ledger))],
);

const NOTICES: VerbRow = shows(
    "notices",
    &[],
    &[Form::new(&[], |_| report(Report::Notices))],
);

const TRAFFIC: VerbRow = shows(
    "traffic",
    &["adsb"],
    &[Form::new(&[], |_| report(Report::Traffic))],
);

const BRIEF: VerbRow = shows("brief", &[], &[Form::new(&[], |_| report(Report::Brief))]);

const STATUS: VerbRow = VerbRow {
    examples: &["status", "status 1-3"],
    ..said(
        "status",
        Scope::Plain,
        &[Form::new(&[VEHICLES.optional()], |given| {
            report(Report::Status(given.vehicles("targets")))
        })],
    )
};

const OBJECTIVES: VerbRow = said(
    "objectives",
    Scope::Plain,
    &[Form::new(&[], |_| report(Report::Objectives))],
);

const CONTACTS: VerbRow = said(
    "contacts",
    Scope::Plain,
    &[Form::new(&[], |_| report(Report::Contacts))],
);
