use std::collections::BTreeMap;

use super::*;

fn themes() -> Vec<String> {
    ["dark", "light"].map(str::to_owned).to_vec()
}

/// Runs a test with some themes, a mission, a macro and a group.
fn with_names<T>(work: impl FnOnce(&Names<'_>) -> T) -> T {
    let themes = themes();
    let source = include_str!("../../../missions/01-air-sample.toml");
    let missions = [crate::mission::Mission::parse(source)
        .expect("it is good")
        .listing()];
    let macros = BTreeMap::from([("up".to_owned(), vec!["all arm".to_owned()])]);
    let groups = BTreeMap::from([("red".to_owned(), vec![1, 2])]);
    work(&Names {
        injects: Some(&[]),
        themes: &themes,
        missions: &missions,
        macros: &macros,
        groups: &groups,
    })
}

fn read_line(line: &str) -> Option<Result<ConsoleLine, Diagnostic>> {
    with_names(|names| parse(line, names))
}

#[test]
fn a_word_that_is_neither_vehicle_nor_kind_of_alert_is_told_both() {
    let fault = |line| {
        let read = read_line(line).expect("it is the console's own");
        let fault = read.expect_err(line);
        let help = fault.help.unwrap_or_default();
        (fault.message.to_string(), help.to_string())
    };
    let (message, help) = fault("ack foo");
    assert_eq!(message, "`foo` is neither a vehicle nor a kind of alert");
    assert!(
        help.starts_with("kinds: crash process link-lost "),
        "{help}"
    );
    assert_eq!(fault("ack batery").1, "did you mean `battery`?");
    assert_eq!(fault("sort -battery").1, "did you mean `bat`?");
    for line in ["ack", "ack 3", "ack @red", "ack all", "ack gps"] {
        assert!(read_line(line).is_some_and(|read| read.is_ok()), "{line}");
    }
}

#[test]
fn only_the_consoles_own_lines_are_taken() {
    assert_eq!(read_line("1-2 arm"), None);
    assert_eq!(read_line(""), None);
    let cases = [
        (
            " theme  light ",
            ConsoleLine::Set(Setting::Theme("light".to_owned())),
        ),
        (
            "set lang uk",
            ConsoleLine::Set(Setting::Lang(crate::text::Language::Ukrainian)),
        ),
        ("set fps 5", ConsoleLine::Set(Setting::Fps(5))),
        ("show map", ConsoleLine::Show(Room::Map)),
        ("fly", ConsoleLine::Fly(None)),
        (
            "fly 01-air-sample",
            ConsoleLine::Fly(Some("01-air-sample".to_owned())),
        ),
        ("fly 01", ConsoleLine::Fly(Some("01-air-sample".to_owned()))),
        (
            "fly 01-ai",
            ConsoleLine::Fly(Some("01-air-sample".to_owned())),
        ),
        ("macro up", ConsoleLine::Macro("up".to_owned())),
        (
            "group @red 1-3",
            ConsoleLine::Group {
                name: "red".to_owned(),
                targets: "1-3".to_owned(),
            },
        ),
    ];
    for (line, meant) in cases {
        assert_eq!(read_line(line), Some(Ok(meant)), "{line}");
    }
}

#[test]
fn no_verb_of_the_console_hides_one_for_vehicles() {
    for own in CONSOLE_VERBS {
        assert!(crate::language::row(own.name).is_none(), "{}", own.name);
    }
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
    ];
    for (line, span) in cases {
        let fault = read_line(line).expect("its own").expect_err(line);
        assert_eq!(fault.span, span, "{line}");
        assert!(fault.help.is_some(), "{line}");
    }
    let fault = read_line("set fps 900")
        .expect("its own")
        .expect_err("too many");
    assert!(fault.message.contains("60"), "{fault:?}");
}

#[test]
fn every_line_that_is_offered_can_be_given() {
    with_names(|names| {
        let lines = lines(names);
        assert!(lines.len() > 20);
        for (line, _) in lines {
            assert!(matches!(parse(&line, names), Some(Ok(_))), "{line}");
        }
    });
}

#[test]
fn blanks_longer_than_a_byte_part_words_too() {
    with_names(|names| {
        for line in ["arm\u{a0}", "theme\u{3000}l", "\u{2003}"] {
            complete(line, line.len(), names);
        }
    });
}

#[test]
fn words_complete_from_their_beginning() {
    let texts = |line: &str| -> Vec<String> {
        let found = with_names(|names| complete(line, line.len(), names));
        found
            .into_iter()
            .map(|completion| completion.text)
            .collect()
    };
    assert_eq!(texts("th"), ["theme"]);
    assert_eq!(texts("theme l"), ["light"]);
    assert_eq!(texts("set la"), ["lang"]);
    assert_eq!(texts("set lang "), ["en", "uk"]);
    assert_eq!(texts("show ma"), ["map"]);
    assert_eq!(texts("1 th"), Vec::<String>::new());
}
