use super::{context, groups, places};
use crate::alert::AlertKind;
use crate::config::{LiveSetting, TableSort};
use crate::diagnostic::Diagnostic;
use crate::language::{
    AlertLine, Channel, ConsoleLine, Context, Listed, Meaning, NameList, Named, Names,
    ParametersLine, ProcessDeed, Report, Script, TableLine, Targets, VehicleChoice, complete,
    lines, parse, rows,
};
use crate::plan::ListKind;
use crate::text;
use crate::text::{Language, Text};

#[derive(Debug)]
struct Known {
    has_injects: bool,
}

impl Names for Known {
    fn listed(&self, list: NameList) -> Listed {
        let names: &[&str] = match list {
            NameList::Room => &["fly", "map"],
            NameList::Theme => &["dark", "light"],
            NameList::Mission => &["01-air-sample", "02-grid"],
            NameList::Macro => &["up"],
            NameList::Draft => &["north", "south"],
            NameList::ItemField => &["hold", "radius"],
            NameList::PlanFile => &["plans/", "survey.plan"],
            NameList::Seat => &["@all", "@anna"],
            NameList::Lesson => &["first-lesson"],
            NameList::Trainee => &["anna"],
            NameList::Rubric => &["notechs"],
            NameList::Exam => &["two-missions"],
            NameList::Situation => &["1", "turn"],
            NameList::Crew => &["anna", "bohdan"],
            NameList::Inject | NameList::SeatInject if self.has_injects => &["gust"],
            NameList::Inject | NameList::SeatInject => {
                return Listed::Nothing(text!("console-no-mission"));
            }
        };
        let named = |name: &&str| Named {
            name: (*name).to_owned(),
            meaning: Text::default(),
        };
        Listed::Names(names.iter().map(named).collect())
    }
}

fn on<T>(channel: Channel, has_injects: bool, work: impl FnOnce(&Context<'_>) -> T) -> T {
    let (groups, places) = (groups(), places());
    work(&Context {
        names: &Known { has_injects },
        channel,
        ..context(&groups, &places)
    })
}

fn read(line: &str) -> Result<ConsoleLine, Diagnostic> {
    let statement = on(Channel::Screen, true, |context| parse(line, context))?;
    match statement.meaning {
        Meaning::Console(own) => Ok(own),
        other @ (Meaning::Act(_) | Meaning::Wait(_)) => panic!("{line}: {other:?}"),
    }
}

fn fault(line: &str) -> (String, String) {
    let fault = read(line).expect_err(line);
    let help = fault.help.unwrap_or_default();
    (fault.message.to_string(), help.to_string())
}

#[test]
fn a_question_about_lists_on_board_has_targets_and_is_for_the_console() {
    for (line, kind, targets) in [
        ("plan status", ListKind::Plan, Targets::Selection),
        ("all fence status", ListKind::Fence, Targets::All),
        (
            "1-2 rally status",
            ListKind::Rally,
            Targets::Ids(vec![1, 2]),
        ),
    ] {
        assert_eq!(read(line), Ok(ConsoleLine::Carried { kind, targets }));
    }
    let in_script = Script::parse("all plan status\n", &Context::default());
    let faults = in_script.expect_err("no console reads it");
    assert!(faults[0].message.to_string().contains("all plan status"));
}

#[test]
fn lines_to_the_console_become_what_they_say() {
    let cases = [
        (
            " theme  light ",
            ConsoleLine::Set(LiveSetting::Theme("light".to_owned())),
        ),
        (
            "set lang uk",
            ConsoleLine::Set(LiveSetting::Lang(Language::Ukrainian)),
        ),
        ("set fps 5", ConsoleLine::Set(LiveSetting::Fps(5))),
        ("SET bell OFF", ConsoleLine::Set(LiveSetting::Bell(false))),
        ("show map", ConsoleLine::Show("map".to_owned())),
        ("commands", ConsoleLine::Report(Report::Ledger)),
        ("fly", ConsoleLine::FlyFree),
        ("fly 01", ConsoleLine::Fly("01-air-sample".to_owned())),
        ("fly 01-ai", ConsoleLine::Fly("01-air-sample".to_owned())),
        ("macro up", ConsoleLine::Macro("up".to_owned())),
        (
            "group @red 1-3",
            ConsoleLine::Group {
                name: "red".to_owned(),
                vehicles: Some(VehicleChoice::Ids(vec![1, 2, 3])),
            },
        ),
        (
            "filter @red   bat<30",
            ConsoleLine::Table(TableLine::Filter("@red bat<30".to_owned())),
        ),
        (
            "connect tcp:a:1?x=2 udp:b:3  # both",
            ConsoleLine::Connect(vec!["tcp:a:1?x=2".to_owned(), "udp:b:3".to_owned()]),
        ),
        (
            "params save my  file.param ",
            ConsoleLine::Parameters(ParametersLine::Save("my  file.param".to_owned())),
        ),
        (
            "hangar stop 3",
            ConsoleLine::Process {
                deed: ProcessDeed::Stop,
                vehicle: 3,
            },
        ),
        (
            "ack 3",
            ConsoleLine::Alerts(AlertLine::AcknowledgeOf(VehicleChoice::Ids(vec![3]))),
        ),
        (
            "ack gps",
            ConsoleLine::Alerts(AlertLine::AcknowledgeKind(AlertKind::Gps)),
        ),
        (
            "sort",
            ConsoleLine::Table(TableLine::Sort(TableSort::BY_ID)),
        ),
    ];
    for (line, meant) in cases {
        assert_eq!(read(line), Ok(meant), "{line}");
    }
    let columns = read("columns id BAT alt");
    assert!(
        matches!(&columns, Ok(ConsoleLine::Table(TableLine::Columns(all))) if all.len() == 3),
        "{columns:?}"
    );
}

#[test]
fn faults_point_at_the_word() {
    let cases = [
        ("theme drak", 6..10),
        ("quit now", 5..8),
        ("select", 6..6),
        ("show mpa", 5..8),
        ("fly 99", 4..6),
        ("macro down", 6..10),
        ("set lagn uk", 4..8),
        ("set lang xx", 9..11),
        ("set fps 900", 8..11),
        ("columns id bta", 11..14),
        ("1 theme dark", 0..1),
    ];
    for (line, span) in cases {
        let fault = read(line).expect_err(line);
        assert_eq!(fault.span, span, "{line}");
    }
    assert!(fault("set fps 900").0.contains("60"));
    assert!(fault("set lang xx").0.contains("en, uk"));
    assert!(fault("fly 99").1.contains("01-air-sample, 02-grid"));
}

#[test]
fn what_was_probably_meant_is_named() {
    for (line, meant) in [
        ("theme drak", "dark"),
        ("ack batery", "battery"),
        ("sort -battery", "-bat"),
        ("set lagn uk", "lang"),
        ("qiut", "quit"),
        ("theem dark", "theme"),
    ] {
        assert_eq!(fault(line).1, format!("did you mean `{meant}`?"), "{line}");
    }
    let (message, help) = fault("ack foo");
    assert!(message.contains("crash, process, link-lost"), "{message}");
    assert!(message.contains("TARGETS"), "{message}");
    assert_eq!(help, "");
}

#[test]
fn what_cannot_be_named_now_says_why() {
    for line in ["inject", "inject gust"] {
        let read = on(Channel::Screen, false, |context| parse(line, context));
        let fault = read.expect_err(line);
        assert_eq!(fault.message, text!("console-no-mission"), "{line}");
    }
}

#[test]
fn a_verb_is_refused_where_it_may_not_be_said() {
    for (channel, line, said) in [
        (Channel::Script, "theme dark", "a script cannot use it"),
        (Channel::Screen, "status", "plain console only"),
        (Channel::Screen, "wait 5s", "pilot scripts"),
    ] {
        let fault = on(channel, true, |context| parse(line, context)).expect_err(line);
        assert!(fault.message.contains(said), "{line}: {fault:?}");
        let offered = on(channel, true, |context| complete("", 0, context));
        let word = line.split(' ').next().unwrap_or_default();
        assert!(offered.iter().all(|it| it.text != word), "{line}");
    }
    for line in ["status 1-3", "wait 5s", "objectives", "theme dark"] {
        assert!(
            on(Channel::Plain, true, |context| parse(line, context)).is_ok(),
            "{line}"
        );
    }
}

#[test]
fn every_line_that_is_offered_can_be_given() {
    on(Channel::Screen, true, |context| {
        let lines = lines(context);
        assert!(lines.len() > 20);
        for (line, _) in &lines {
            assert!(parse(line, context).is_ok(), "{line}");
        }
        let has = |line: &str| lines.iter().any(|(known, _)| known == line);
        assert!(has("quit") && has("show map") && has("set theme dark"));
        assert!(!has("theme dark"), "it is offered as a setting");
    });
}

#[test]
fn words_of_console_lines_complete() {
    let texts = |line: &str| -> Vec<String> {
        let found = on(Channel::Screen, true, |context| {
            complete(line, line.len(), context)
        });
        found.into_iter().map(|found| found.text).collect()
    };
    assert_eq!(texts("the"), ["theme"]);
    assert_eq!(texts("theme l"), ["light"]);
    assert_eq!(texts("set la"), ["lang"]);
    assert_eq!(texts("set lang "), ["en", "uk"]);
    assert_eq!(texts("show ma"), ["map"]);
    assert_eq!(texts("group r"), ["red"]);
    assert_eq!(texts("columns id mod"), ["mode"]);
    assert!(!texts("1 th").contains(&"theme".to_owned()));
}

#[test]
fn a_verb_to_the_console_commands_no_vehicle() {
    for row in rows() {
        let only_act = |meaning: &Meaning| matches!(meaning, Meaning::Act(_));
        for example in row.examples {
            let statement = on(Channel::Plain, true, |context| parse(example, context));
            let Ok(statement) = statement else { continue };
            let is_order = only_act(&statement.meaning);
            assert!(!is_order || row.scope.takes_targets(), "{example}");
        }
    }
}
