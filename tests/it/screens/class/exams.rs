//! The exam of the seats on the board.

use std::sync::Arc;
use std::time::Duration;

use sortie::app::effect::{ClassEffect, Effect};
use sortie::app::event::{ClassEvent, ExamEvent};
use sortie::app::state::Overlay;
use sortie::class::{
    CandidateStage, Exam, ExamDeed, ExamLayout, ExamMission, ExamNote, ExamPlan, ExamSecret,
    TryName,
};
use sortie::text::Language;

use crate::console::class::{desk, flight, report};
use crate::harness::Console;

/// When the desk was opened, in seconds since 1970.
const BEGUN: u64 = 1_800_000_000;

/// An exam that began when the desk was opened, in which anna takes part.
fn exam(name: &str) -> Exam {
    begun(name, &["anna"])
}

/// An exam that began when the desk was opened.
fn begun(name: &str, users: &[&str]) -> Exam {
    let mission = |id: &str, tries| ExamMission {
        mission: id.into(),
        tries,
        limit: Duration::from_secs(900),
    };
    let plan = Arc::new(ExamPlan {
        name: name.into(),
        title: format!("Exam {name}").as_str().into(),
        title_uk: Some(format!("Іспит {name}").as_str().into()),
        layout: ExamLayout::Own,
        opens: None,
        closes: None,
        missions: vec![mission("00-first-flight", 2), mission("01-air-sample", 1)],
    });
    let note = |what| ExamNote { at: BEGUN, what };
    let begun = note(ExamDeed::Begun {
        exam: name.to_owned(),
        source: String::new(),
        secret: ExamSecret::from([7; 32]),
    });
    let seated = users.iter().map(|user| {
        let user = (*user).to_owned();
        note(ExamDeed::Seated { user })
    });
    let notes: Vec<ExamNote> = std::iter::once(begun).chain(seated).collect();
    Exam::of(plan, &notes, BEGUN).expect("it began")
}

#[test]
fn the_board_has_the_exam_of_each_seat() {
    for language in Language::ALL {
        let mut console = desk(language);
        report(&mut console, 1, "anna", flight(5.0));
        report(&mut console, 2, "bohdan", flight(12.0));
        console.hear(ClassEvent::Exam(ExamEvent::Found(Box::new(exam("final")))));
        console.press("esc");
        let desk = console.state().class_role().desk().expect("a desk");
        let now = console.state().wall();
        let of_anna = desk.candidacy(&desk.seats()[0], now);
        let (_, candidate) = of_anna.expect("anna takes part");
        assert_eq!(candidate.stage(), CandidateStage::Waits);
        assert!(desk.candidacy(&desk.seats()[1], now).is_none());
        for (width, height) in [(80, 24), (120, 40)] {
            let name = format!("exam_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
    }
}

/// `E` once began an exam for the seat under the cursor alone, without a question.
#[test]
fn an_exam_begins_after_a_question_that_names_it_and_its_seats() {
    let candidates = |console: &Console| {
        let desk = console.state().class_role().desk().expect("a desk");
        desk.exam().map_or(0, |exam| exam.candidates().len())
    };
    let read = |console: &mut Console, name: &str, seats: &[usize]| {
        let exam = Ok(Box::new(begun(name, &[])));
        let (name, seats) = (name.to_owned(), seats.to_vec());
        console.hear(ClassEvent::Exam(ExamEvent::Read { name, exam, seats }));
    };
    let asks = |console: &Console, question: &str| {
        let Some(Overlay::Confirm(asked)) = console.state().overlay() else {
            panic!("nothing is asked");
        };
        assert_eq!(asked.question().to_string(), question);
    };
    let mut console = desk(Language::English);
    read(&mut console, "final", &[0]);
    let one = "BEGIN the exam “Exam final” with 1 of 3 connected seats: anna";
    asks(&console, one);
    console.press("esc");
    let role = console.state().class_role();
    assert!(role.desk().expect("a desk").exam().is_none());

    read(&mut console, "final", &[0]);
    console.press("y");
    assert_eq!(candidates(&console), 1);
    // By name, whatever the order of the board.
    read(&mut console, "final", &[2, 1]);
    let others = "BEGIN the exam “Exam final” with 2 of 3 connected seats: bohdan, vira";
    asks(&console, others);
    console.press("y");
    assert_eq!(candidates(&console), 3);
    // Another one is not asked about: it cannot begin.
    read(&mut console, "rehearsal", &[0]);
    assert!(console.state().overlay().is_none());
    let said = console.state().message().expect("a message");
    let text = said.text.to_string();
    assert!(text.contains("the exam “Exam final” is going on"), "{text}");
}

#[test]
fn an_earlier_exam_that_is_not_continued_is_named() {
    let mut console = desk(Language::English);
    console.hear(ClassEvent::Exam(ExamEvent::Found(Box::new(exam("final")))));
    console.hear(ClassEvent::Exam(ExamEvent::Found(Box::new(exam(
        "rehearsal",
    )))));
    let held = console.state().class_role().desk().expect("a desk").exam();
    assert_eq!(held.expect("an exam").plan().name.as_str(), "final");
    let mut lines = console.state().notices().lines();
    let newest = lines.next_back().expect("a notice").notice.text.to_string();
    assert!(
        newest.contains("an earlier exam, “Exam rehearsal”, has not ended"),
        "{newest}"
    );
}

/// Nothing once said that the exam had ended with the desk, and that its tries were still watched.
#[test]
fn a_desk_says_that_it_watches_the_tries_of_an_exam_that_has_ended() {
    let name = TryName {
        exam: "final".into(),
        begun: BEGUN,
        mission: "00-first-flight".into(),
        number: 1,
        opening: 1,
    };
    let user = || "anna".to_owned();
    let mut exam = exam("final");
    for what in [
        ExamDeed::Asked {
            user: user(),
            name: name.clone(),
            until: BEGUN + 900,
        },
        ExamDeed::Opened { user: user(), name },
        ExamDeed::Stopped,
    ] {
        exam.take_in(&ExamNote { at: BEGUN, what });
    }
    let mut console = desk(Language::English);
    console.hear(ClassEvent::Exam(ExamEvent::Found(Box::new(exam))));
    assert!(console.state().overlay().is_none(), "it has ended already");
    let mut lines = console.state().notices().lines();
    let newest = lines.next_back().expect("a notice").notice.text.to_string();
    let ended = "the exam “Exam final” has ended, so no more tries are opened; \
        those under way are still watched: anna";
    assert_eq!(newest, ended);
    let screen = console.screen(120, 40);
    assert!(screen.contains("00 1/2 15:00"), "{screen}");
}

#[test]
fn an_exam_of_an_earlier_lesson_goes_on_only_if_the_instructor_does_not_end_it() {
    let is_stopped = |console: &Console| {
        let desk = console.state().class_role().desk().expect("a desk");
        desk.exam().expect("an exam").is_stopped()
    };
    for (key, ends) in [("y", true), ("n", false)] {
        let mut console = desk(Language::English);
        console.hear(ClassEvent::Exam(ExamEvent::Found(Box::new(exam("final")))));
        let screen = console.screen(80, 24);
        let question = "End the exam “Exam final” of 2027-01-15 08:00 UTC?";
        assert!(screen.contains(question), "{screen}");
        console.press(key);
        assert_eq!(is_stopped(&console), ends);
        console.effects.clear();
        console.press("q");
        assert_eq!(console.effects.contains(&Effect::Quit), ends);
        if !ends {
            let screen = console.screen(80, 24);
            assert!(screen.contains("the exam “Exam final” ends"), "{screen}");
            console.press("y");
            assert!(is_stopped(&console));
            assert!(console.effects.contains(&Effect::Quit));
            // The end is noted before the program ends.
            let is_note = |it: &Effect| matches!(it, Effect::Class(ClassEffect::KeepNotes { .. }));
            assert!(console.effects.iter().any(is_note));
        }
    }
}
