//! Grades of flights at the desk.

use std::sync::Arc;
use std::time::Duration;

use sortie::app::effect::{ClassEffect, Effect};
use sortie::app::event::ClassEvent;
use sortie::grading::{
    FlightChoice, GradeSheet, GradedFlight, GradedRequest, Mark, RecordBookmark, Rubric,
};
use sortie::store;
use sortie::text::{Language, Text};

use super::desk;
use crate::harness::Console;

const RECORD: &str = "2026-11-20T14-03-22Z_06-lane-survey";

/// A flight of anna, the second of two, with two bookmarks.
pub fn graded_flight() -> GradedFlight {
    let rubric: Rubric = store::rubric("notechs").expect("it ships");
    let evidence = rubric.elements().map(|element| {
        let alerts = "2 of 3 alerts answered in time, the slowest after 14 s";
        let says = |kind: &str| Text::verbatim(kind.to_owned());
        match element.id.as_str() {
            "planning" => vec![
                says("vehicles waited for 31 % of their time in the air"),
                says("23 commands, 4.2 a minute, 35 % of them for several vehicles"),
                says("time 82 %: 5:41, full points up to 5:00"),
            ],
            "vehicles" => vec![says(alerts)],
            _ => Vec::new(),
        }
    });
    let bookmarks = [(61, "looked away"), (143, "turned back in time")];
    let bookmarks = bookmarks.map(|(seconds, text)| RecordBookmark {
        recorded: Duration::from_secs(seconds + 20),
        at: Duration::from_secs(seconds),
        text: text.to_owned(),
    });
    GradedFlight {
        user: "anna".to_owned(),
        profile: Some("Anna K.".to_owned()),
        record: RECORD.to_owned(),
        title: "Lane survey".into(),
        when: "2026-11-20T14:03:22Z".to_owned(),
        score: 812,
        number: 2,
        flights: 2,
        evidence: evidence.collect(),
        sheet: GradeSheet::new(&rubric, "petro"),
        bookmarks: bookmarks.into(),
        rubric: Arc::new(rubric),
        skipped: Vec::new(),
    }
}

/// Answers what the desk has asked for last.
fn answer(console: &mut Console, flight: Result<GradedFlight, Text>) {
    let asked = asked(console).expect("a flight is asked for").clone();
    let flight = flight.map(Box::new);
    console.hear(ClassEvent::Graded { asked, flight });
}

/// A desk on which that flight is being graded.
pub fn grading(language: Language) -> Console {
    let mut console = desk(language);
    console.press("g");
    answer(&mut console, Ok(graded_flight()));
    console
}

/// The sheet that was last to be kept.
fn kept(console: &Console) -> Option<&GradeSheet> {
    console
        .effects
        .iter()
        .rev()
        .find_map(|effect| match effect {
            Effect::Class(ClassEffect::KeepGrades { sheet, .. }) => Some(sheet),
            _ => None,
        })
}

/// The flight that was last asked for.
fn asked(console: &Console) -> Option<&GradedRequest> {
    console
        .effects
        .iter()
        .rev()
        .find_map(|effect| match effect {
            Effect::Class(ClassEffect::ReadGraded(asked)) => Some(asked),
            _ => None,
        })
}

/// Whose flight was last asked for, and which one.
fn choice(console: &Console) -> Option<(&str, &FlightChoice)> {
    asked(console).map(|it| (it.user.as_str(), &it.choice))
}

#[test]
fn keys_grade_the_element_under_the_cursor_and_each_change_is_kept() {
    let mut console = desk(Language::English);
    console.press("g");
    assert_eq!(choice(&console), Some(("anna", &FlightChoice::Newest)));
    let mut console = grading(Language::English);
    console.press("down").press("down").press("4");
    let sheet = kept(&console).expect("kept");
    assert_eq!(sheet.grades["planning"].mark, Mark::try_from(4).ok());
    console.press("down").press("0");
    let sheet = kept(&console).expect("kept");
    assert_eq!(sheet.grades["standards"].mark, None);
    console.give("class rate clear");
    let sheet = kept(&console).expect("kept");
    assert!(!sheet.grades.contains_key("standards"));
}

#[test]
fn a_one_wants_a_reason_a_remark_or_a_bookmark() {
    let mut console = grading(Language::English);
    console.press("1");
    let screen = console.screen(120, 40);
    assert!(screen.contains("1 and 5 need a remark"), "{screen}");
    console.press("enter").write("said nothing").press("enter");
    let sheet = kept(&console).expect("kept");
    assert_eq!(sheet.grades["informing"].text, "said nothing");
    let screen = console.screen(120, 40);
    assert!(!screen.contains("1 and 5 need a remark"), "{screen}");
    console.press("c").write("2").press("enter");
    let sheet = kept(&console).expect("kept");
    assert_eq!(sheet.grades["informing"].bookmarks_ms, [163_000]);
    console.give("class cite 3");
    let screen = console.screen(120, 40);
    assert!(screen.contains("choose a bookmark from 1 to 2"), "{screen}");
}

#[test]
fn a_remark_comes_after_a_mark() {
    let mut console = grading(Language::English);
    console.give("class remark quick");
    assert_eq!(kept(&console), None);
    let screen = console.screen(120, 40);
    assert!(screen.contains("first rate the element"), "{screen}");
}

#[test]
fn left_and_right_ask_for_older_and_newer_flights_and_keys_wait_for_them() {
    let mut console = grading(Language::English);
    console.press("left");
    let older = FlightChoice::Older(RECORD.to_owned());
    assert_eq!(choice(&console), Some(("anna", &older)));
    let request = asked(&console).expect("asked").clone();
    console.press("4");
    assert_eq!(kept(&console), None, "the other flight is not graded");
    let screen = console.screen(120, 40);
    assert!(screen.contains("another flight is being read"), "{screen}");
    console.press("enter");
    assert!(!console.screen(120, 40).contains(": class remark"));
    let older = GradedFlight {
        record: "2026-11-20T13-00-00Z_06-lane-survey".to_owned(),
        number: 1,
        skipped: vec!["one in between is damaged".into()],
        ..graded_flight()
    };
    let flight = Ok(Box::new(older.clone()));
    console.hear(ClassEvent::Graded {
        asked: request,
        flight,
    });
    let screen = console.screen(120, 40);
    assert!(screen.contains("one in between is damaged"), "{screen}");
    assert!(screen.contains("(1/2)"), "{screen}");
    console.press("right");
    let newer = FlightChoice::Newer(older.record);
    assert_eq!(choice(&console), Some(("anna", &newer)));
    answer(&mut console, Err("there is no newer flight".into()));
    console.press("4");
    assert!(kept(&console).is_some(), "the shown flight is graded again");
}

#[test]
fn a_flight_that_comes_after_escape_is_not_shown() {
    let mut console = desk(Language::English);
    console.press("g");
    let asked = asked(&console).expect("asked").clone();
    console.press("esc");
    let flight = Ok(Box::new(graded_flight()));
    console.hear(ClassEvent::Graded { asked, flight });
    assert!(!console.screen(120, 40).contains("Lane survey"));
}

#[test]
fn another_page_closes_the_flight() {
    for key in ["t", "l", "i"] {
        let mut console = grading(Language::English);
        console.press(key).press("4");
        assert_eq!(kept(&console), None, "{key}");
        assert!(!console.screen(120, 40).contains("Lane survey"), "{key}");
    }
}

#[test]
fn enter_changes_a_remark_also_without_seats() {
    let mut console = grading(Language::English);
    console.press("3").give("class remark quick");
    console.press("enter").write(" and calm").press("enter");
    let sheet = kept(&console).expect("kept");
    assert_eq!(sheet.grades["informing"].text, "quick and calm");
}

#[test]
fn escape_shows_the_board_again_where_keys_grade_nothing() {
    let mut console = grading(Language::English);
    console.press("esc");
    console.effects.clear();
    console.press("4");
    assert_eq!(kept(&console), None);
    let screen = console.screen(120, 40);
    assert!(screen.contains("no flight is being graded"), "{screen}");
}

#[test]
fn a_trainee_without_flights_and_a_full_disk_are_said() {
    let mut console = desk(Language::English);
    console.give("class grade bohdan");
    assert_eq!(choice(&console), Some(("bohdan", &FlightChoice::Newest)));
    answer(&mut console, Err("no flight of bohdan".into()));
    assert!(console.screen(120, 40).contains("no flight of bohdan"));
    let waits = |count, fault: Option<&str>| ClassEvent::GradesWait {
        count,
        fault: fault.map(Into::into),
    };
    console.hear(waits(1, Some("no space left")));
    let screen = console.screen(120, 40);
    let said = "the grades of 1 flight are not written yet; the desk keeps them";
    assert!(screen.contains(said), "{screen}");
    // They would be lost with the desk.
    console.press("q");
    let screen = console.screen(120, 40);
    assert!(
        screen.contains("could not be written and are lost"),
        "{screen}"
    );
    console.press("esc");
    console.hear(waits(0, None));
    assert!(
        console
            .screen(120, 40)
            .contains("all grades are written now")
    );
    console.effects.clear();
    console.press("q");
    assert!(console.effects.contains(&Effect::Quit));
}
