//! The lesson of a seat, and the list of lessons.

use sortie::app::event::ClassEvent;
use sortie::lesson_plan::{FaultyLesson, LessonList};
use sortie::text::Language;

use crate::console::class::{begin, carry_out, desk, first_lesson, flight, report};

#[test]
fn the_lesson_of_a_seat_is_shown_with_what_it_waits_for() {
    for language in Language::ALL {
        let mut console = desk(language);
        report(&mut console, 1, "anna", flight(5.0));
        report(&mut console, 2, "bohdan", flight(12.0));
        begin(&mut console, &first_lesson(language), vec![0, 1]);
        for (width, height) in [(80, 24), (120, 40)] {
            let name = format!("lesson_manual_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
        console.press("n");
        carry_out(&mut console, None);
        console.press("n");
        carry_out(&mut console, None);
        for (width, height) in [(80, 24), (120, 40)] {
            let name = format!("lesson_condition_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
        assert!(
            console.screen(200, 50).contains("1-2 goto"),
            "the last command has room"
        );
    }
}

#[test]
fn the_lessons_that_can_be_begun_are_listed() {
    for language in Language::ALL {
        let mut console = desk(language);
        console.press("l");
        let faulty = FaultyLesson {
            name: "mine".to_owned(),
            file: "lessons/mine.toml".to_owned(),
        };
        console.hear(ClassEvent::Lessons(LessonList {
            good: vec![first_lesson(language)],
            faulty: vec![faulty],
        }));
        for (width, height) in [(80, 24), (120, 40)] {
            let name = format!("lessons_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
    }
}
