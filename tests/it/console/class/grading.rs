//! Grades of flights at the desk.

use std::sync::Arc;
use std::time::Duration;

use sortie::app::effect::{ClassEffect, Effect};
use sortie::app::event::ClassEvent;
use sortie::comparison::FlightBookmark;
use sortie::grading::{GradeSheet, GradedFlight, Mark, Rubric};
use sortie::store;
use sortie::text::{Language, Text};

use super::desk;
use crate::harness::Console;

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
    let bookmarks = bookmarks.map(|(seconds, text)| FlightBookmark {
        at: Duration::from_secs(seconds),
        text: text.to_owned(),
    });
    GradedFlight {
        user: "anna".to_owned(),
        record: "2026-11-20T14-03-22Z_06-lane-survey".to_owned(),
        title: "Lane survey".into(),
        when: "2026-11-20T14:03:22Z".to_owned(),
        score: 812,
        number: 2,
        flights: 2,
        evidence: evidence.collect(),
        sheet: GradeSheet::new(&rubric, "petro"),
        bookmarks: bookmarks.into(),
        rubric: Arc::new(rubric),
    }
}

/// A desk on which that flight is being graded.
pub fn grading(language: Language) -> Console {
    let mut console = desk(language);
    console.hear(ClassEvent::Graded(Ok(Box::new(graded_flight()))));
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

/// How many flights are newer than the one that was last asked for, and whose it is.
fn asked(console: &Console) -> Option<(&str, usize)> {
    console
        .effects
        .iter()
        .rev()
        .find_map(|effect| match effect {
            Effect::Class(ClassEffect::ReadGraded { user, back, .. }) => {
                Some((user.as_str(), *back))
            }
            _ => None,
        })
}

#[test]
fn keys_grade_the_element_under_the_cursor_and_each_change_is_kept() {
    let mut console = desk(Language::English);
    console.press("g");
    assert_eq!(asked(&console), Some(("anna", 0)));
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
    console
        .give("class remark")
        .press("c")
        .write("2")
        .press("enter");
    let sheet = kept(&console).expect("kept");
    assert_eq!(sheet.grades["informing"].text, "");
    assert_eq!(sheet.grades["informing"].bookmarks_s, [143.0]);
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
    assert!(screen.contains("first give a mark"), "{screen}");
}

#[test]
fn left_and_right_ask_for_older_and_newer_flights() {
    let mut console = grading(Language::English);
    console.effects.clear();
    console.press("right");
    assert_eq!(asked(&console), None, "it is the newest");
    console.press("left");
    assert_eq!(asked(&console), Some(("anna", 1)));
    console.hear(ClassEvent::Graded(Ok(Box::new(GradedFlight {
        number: 1,
        ..graded_flight()
    }))));
    console.effects.clear();
    console.press("left");
    assert_eq!(asked(&console), None, "it is the oldest");
    console.press("right");
    assert_eq!(asked(&console), Some(("anna", 0)));
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
    assert_eq!(asked(&console), Some(("bohdan", 0)));
    console.hear(ClassEvent::Graded(Err("no flight of bohdan".into())));
    assert!(console.screen(120, 40).contains("no flight of bohdan"));
    console.hear(ClassEvent::GradesLost("no space left".into()));
    let screen = console.screen(120, 40);
    assert!(
        screen.contains("grades were not kept: no space left"),
        "{screen}"
    );
}
