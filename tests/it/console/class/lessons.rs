//! Lessons: at the desk, and at a seat.

use std::sync::Arc;
use std::time::Duration;

use sortie::app::effect::{ClassEffect, Effect, SessionEffect};
use sortie::app::event::{ClassEvent, Event, SessionEvent};
use sortie::app::state::{Activity, SitlStage};
use sortie::campaign::Stake;
use sortie::class::protocol::SeatMessage;
use sortie::class::{
    Deed, Entry, Happening, JournalBatch, LessonWait, NotedStep, OrderId, OrderState, Outcome,
    Refusal,
};
use sortie::lesson_plan::{FaultyLesson, Lesson, LessonList, LessonMissions, LessonSetting};
use sortie::mission::{Expected, Progress};
use sortie::text::{Language, Locale};

use super::desk::{deeds, desk, say};
use super::{flying_mission, joined, order, outcomes, pass, session_effects};
use crate::console::hangar::{self, instance};
use crate::fixtures;
use crate::harness::Console;

const USERS: [&str; 3] = ["anna", "bohdan", "vira"];

/// The shipped first lesson.
pub fn first_lesson(language: Language) -> Arc<Lesson> {
    let missions = LessonMissions::of([
        include_str!("../../../../missions/00-first-flight.toml"),
        include_str!("../../../../missions/01-air-sample.toml"),
    ]);
    let setting = LessonSetting {
        missions: &missions,
        locale: &Locale::new(language),
    };
    let source = include_str!("../../../../lessons/first-lesson.toml");
    let lesson = Lesson::parse("first-lesson", source, &setting);
    Arc::new(lesson.expect("it is good"))
}

/// Begins a lesson with seats.
pub fn begin(console: &mut Console, lesson: &Arc<Lesson>, seats: Vec<usize>) {
    console.hear(ClassEvent::LessonRead {
        name: lesson.plan.name.to_string(),
        lesson: Ok(Arc::clone(lesson)),
        seats,
    });
    carry_out(console, None);
}

/// Seats carry out what is ordered, for two seconds. Conditions of steps hold at one of them only.
pub fn carry_out(console: &mut Console, holds_at: Option<usize>) {
    for _ in 0..20 {
        let now = console.state().wall() + Duration::from_millis(100);
        console.hear(Event::Tick { now, wall: now });
        for (seat, user) in USERS.iter().enumerate() {
            answer(console, seat, user, holds_at == Some(seat));
        }
    }
}

fn answer(console: &mut Console, seat: usize, user: &str, holds: bool) {
    let desk = console.state().class_role().desk().expect("a desk");
    let record = &desk.seats()[seat];
    let number = record.journal.next_number();
    let ended = record.orders().filter_map(|given| {
        let is_armed = given.state == OrderState::Ended(Outcome::Armed);
        let waits = matches!(&given.order.deed, Deed::Step(step) if step.when.is_some());
        let outcome = match given.state {
            OrderState::Waiting if waits => Outcome::Armed,
            OrderState::Waiting => Outcome::Done,
            OrderState::Ended(_) if is_armed && waits && holds => Outcome::Done,
            OrderState::Ended(_) | OrderState::Unanswered => return None,
        };
        Some((given.order.clone(), outcome))
    });
    let entries = (number..)
        .zip(ended)
        .map(|(number, (order, outcome))| Entry {
            number,
            clock_s: Some(31.0),
            what: Happening::Order {
                id: order.id,
                deed: order.deed,
                outcome,
                why: None,
            },
        });
    let entries: Vec<Entry> = entries.collect();
    let batch = JournalBatch {
        kept_from: 1,
        entries,
    };
    say(console, seat as u64 + 1, user, SeatMessage::Entries(batch));
}

fn step_of(console: &Console, seat: usize) -> Option<String> {
    let desk = console.state().class_role().desk().expect("a desk");
    let lesson = desk.seats()[seat].lesson.as_ref()?;
    lesson.step().map(|step| step.id.to_string())
}

fn class_effects(console: &Console) -> Vec<&ClassEffect> {
    let effects = console.effects.iter().filter_map(|effect| match effect {
        Effect::Class(effect) => Some(effect),
        _ => None,
    });
    effects.collect()
}

/// The step that helps a late trainee passed at once, and the instructor was never called.
#[test]
fn the_first_lesson_calls_the_instructor_to_a_trainee_who_is_late() {
    let mut console = desk(Language::English);
    begin(&mut console, &first_lesson(Language::English), vec![0]);
    for _ in ["welcome", "brief"] {
        console.press("n");
        carry_out(&mut console, None);
    }
    assert_eq!(step_of(&console, 0).as_deref(), Some("takeoff"));
    pass(&mut console, 180);
    for _ in ["late", "help"] {
        carry_out(&mut console, None);
    }
    let is_message = |(_, deed): &(String, Deed)| matches!(deed, Deed::Message { text } if text.as_str().contains("“now”"));
    assert!(deeds(&console).iter().any(is_message));
    let screen = console.screen(120, 40);
    // Like a vehicle, a step once was "armed".
    assert!(!screen.contains("armed"), "{screen}");
    console.press("l");
    let screen = console.screen(120, 40);
    assert!(screen.contains("! visit"), "{screen}");
    assert!(screen.contains("waits for you: n continues"), "{screen}");
    console.press("n");
    carry_out(&mut console, None);
    assert_eq!(step_of(&console, 0).as_deref(), Some("takeoff-2"));
}

#[test]
fn a_lesson_is_read_for_the_meant_seats_and_goes_on_by_conditions_and_keys() {
    let mut console = desk(Language::English);
    console.give("class lesson @bohdan first-lesson");
    let name = "first-lesson".to_owned();
    let seats = vec![1];
    let read = ClassEffect::ReadLesson { name, seats };
    assert_eq!(class_effects(&console), [&read]);

    begin(&mut console, &first_lesson(Language::English), vec![0, 1]);
    assert_eq!(step_of(&console, 0).as_deref(), Some("welcome"));
    assert_eq!(step_of(&console, 2), None);
    let screen = console.screen(120, 40);
    assert!(screen.contains("! welcome"), "{screen}");
    assert!(screen.contains("waits for you: n continues"), "{screen}");
    // A step of all seats: the key at one of them is enough.
    console.press("n");
    carry_out(&mut console, None);
    let fly = Deed::Fly {
        mission: "00-first-flight".into(),
        exam: false,
        hold: false,
    };
    for user in ["anna", "bohdan"] {
        assert!(deeds(&console).contains(&(user.to_owned(), fly.clone())));
    }
    console.press("n");
    carry_out(&mut console, Some(0));
    carry_out(&mut console, Some(0));
    assert_eq!(step_of(&console, 1).as_deref(), Some("takeoff"));
    let desk = console.state().class_role().desk().expect("a desk");
    let lesson = desk.seats()[1].lesson.as_ref().expect("a lesson");
    assert_eq!(lesson.wait(), LessonWait::Condition(&"airborne > 0".into()));
    // Every condition holds at anna.
    assert_eq!(step_of(&console, 0).as_deref(), Some("sample"));

    console.give("class lesson back @bohdan");
    assert_eq!(step_of(&console, 1).as_deref(), Some("brief"));
    console.give("class lesson skip @bohdan");
    assert_eq!(step_of(&console, 1).as_deref(), Some("takeoff"));
    console.give("class lesson stop @bohdan");
    assert_eq!(step_of(&console, 1), None);
    console.give("class lesson next @bohdan");
    let screen = console.screen(120, 40);
    assert!(screen.contains("bohdan: no lesson is going on"), "{screen}");
}

#[test]
fn all_seats_that_a_key_starts_are_named() {
    let mut console = desk(Language::English);
    begin(&mut console, &first_lesson(Language::English), vec![0, 1]);
    // It is a step of all seats.
    for seats in ["@all", "@bohdan"] {
        console.give(&format!("class lesson next {seats}"));
        let screen = console.screen(120, 40);
        let notice = "next step of the lesson: anna, bohdan";
        assert!(screen.contains(notice), "{screen}");
        carry_out(&mut console, None);
    }
}

#[test]
fn without_a_lesson_the_lessons_are_listed() {
    let mut console = desk(Language::English);
    console.press("l");
    assert_eq!(class_effects(&console), [&ClassEffect::ListLessons]);
    let screen = console.screen(80, 24);
    assert!(screen.contains("The lessons are being read."), "{screen}");
    let lesson = first_lesson(Language::English);
    console.hear(ClassEvent::Lessons(LessonList {
        good: vec![lesson],
        faulty: vec![FaultyLesson {
            name: "mine".to_owned(),
            file: "lessons/mine.toml".to_owned(),
        }],
    }));
    let screen = console.screen(80, 24);
    assert!(screen.contains("first-lesson: First lesson."), "{screen}");
    let faulty = console.screen(120, 40);
    assert!(
        faulty.contains("sortie check lessons/mine.toml"),
        "{faulty}"
    );
    // It is known, and read again: that says what its faults are.
    console.give("class lesson mine");
    let name = "mine".to_owned();
    let seats = vec![0];
    let read = ClassEffect::ReadLesson { name, seats };
    assert_eq!(class_effects(&console), [&read]);
    console.press("esc");
    assert!(!console.screen(80, 24).contains("first-lesson"));

    console.hear(ClassEvent::LessonRead {
        name: "mine".to_owned(),
        lesson: Err("mine.toml:3:1: a fault".into()),
        seats: vec![0],
    });
    let screen = console.screen(120, 40);
    assert!(
        screen.contains("mine cannot be read: mine.toml:3:1"),
        "{screen}"
    );
}

fn step(mission: Option<&str>, when: Option<&str>) -> Deed {
    Deed::Step(NotedStep {
        lesson: "l".into(),
        step: Some("s".into()),
        mission: mission.map(Into::into),
        when: when.map(Into::into),
        is_held: false,
        before: 0,
    })
}

/// The mission says whether the condition of an order holds.
fn expected(console: &mut Console, number: u32, has_held: bool) {
    let asked_by = OrderId { desk: 1, number };
    let progress = Progress {
        expected: Some(Expected { asked_by, has_held }),
        ..fixtures::progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
}

#[test]
fn a_seat_watches_the_condition_of_a_step_and_does_not_tell_the_trainee() {
    let mut console = flying_mission(Stake::Exam);
    let notices = console.state().notices().lines().len();
    order(&mut console, 1, step(None, Some("airborne > 0")));
    assert_eq!(outcomes(&console), [(1, Outcome::Armed)]);
    let asks = class_effects(&console).into_iter().any(|it| {
        let when = "airborne > 0".to_owned();
        let id = OrderId { desk: 1, number: 1 };
        *it == ClassEffect::Expect { id, when }
    });
    assert!(asks);
    expected(&mut console, 1, false);
    assert!(class_effects(&console).is_empty(), "it is asked once");
    assert_eq!(outcomes(&console).len(), 1);
    expected(&mut console, 1, true);
    assert_eq!(outcomes(&console)[1..], [(1, Outcome::Done)]);
    assert_eq!(console.state().notices().lines().len(), notices);

    // The next step replaces one that still waits.
    order(&mut console, 2, step(None, Some("t > 900")));
    order(&mut console, 3, step(None, None));
    let ended = [
        (2, Outcome::Armed),
        (2, Outcome::Disarmed),
        (3, Outcome::Done),
    ];
    assert_eq!(outcomes(&console)[2..], ended);
}

#[test]
fn a_step_does_not_start_because_the_same_condition_held_for_the_one_before() {
    let mut console = flying_mission(Stake::Graded);
    order(&mut console, 1, step(None, Some("no_command(5)")));
    expected(&mut console, 1, true);
    order(&mut console, 2, step(None, Some("no_command(5)")));
    // The flight has not looked yet.
    pass(&mut console, 1);
    let ended = [(1, Outcome::Armed), (1, Outcome::Done), (2, Outcome::Armed)];
    assert_eq!(outcomes(&console), ended);
    expected(&mut console, 2, true);
    assert_eq!(outcomes(&console)[3..], [(2, Outcome::Done)]);
}

#[test]
fn a_condition_that_the_flight_cannot_watch_is_refused() {
    let mut console = flying_mission(Stake::Graded);
    order(&mut console, 1, step(None, Some("inside('nowhere') > 0")));
    console.hear(ClassEvent::Begun {
        id: OrderId { desk: 1, number: 1 },
        refusal: Some(Refusal::Condition),
    });
    let refused = Outcome::Refused(Refusal::Condition);
    assert_eq!(outcomes(&console)[1..], [(1, refused)]);
}

#[test]
fn the_moments_of_a_flight_are_those_of_the_meant_mission() {
    let mut console = flying_mission(Stake::Graded);
    order(&mut console, 1, step(Some("another"), Some("started")));
    pass(&mut console, 1);
    assert_eq!(outcomes(&console), [(1, Outcome::Armed)]);
}

#[test]
fn the_desk_opens_a_mission_unless_another_flight_would_be_lost() {
    let fly = |exam| Deed::Fly {
        mission: "00-first-flight".into(),
        exam,
        hold: false,
    };
    let mut console = flying_mission(Stake::Graded);
    order(&mut console, 1, fly(false));
    let refused = Outcome::Refused(Refusal::Flying);
    assert_eq!(outcomes(&console), [(1, refused)]);

    let mut console = joined();
    order(&mut console, 1, fly(true));
    let [SessionEffect::StartMission(launch)] = session_effects(&console)[..] else {
        panic!("{:?}", console.effects);
    };
    assert_eq!(launch.mission, "00-first-flight");
    assert_eq!(launch.stake, Stake::Exam);
    assert_eq!(outcomes(&console), []);
    // Another mission is not its effect.
    console.start(Activity::Free);
    assert_eq!(outcomes(&console), []);
    pass(&mut console, 5);
    assert_eq!(outcomes(&console), [(1, Outcome::NoEffect)]);
    order(&mut console, 2, Deed::Start);
    let refused = Outcome::Refused(Refusal::NoMission);
    assert_eq!(outcomes(&console)[1..], [(2, refused)]);
}

#[test]
fn a_flight_is_let_begin_as_soon_as_its_vehicles_have_started() {
    let mission = || Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    };
    let mut console = hangar::start(joined(), mission(), 1);
    order(&mut console, 1, Deed::Start);
    pass(&mut console, 60);
    assert_eq!(outcomes(&console), [], "it waits for the vehicles");
    hangar::hear(&mut console, vec![instance(1, SitlStage::Ready)]);
    assert!(!console.state().session().is_reading());
    assert_eq!(outcomes(&console), [(1, Outcome::Done)]);

    // Another flight is not the one that was meant.
    let mut console = hangar::start(joined(), mission(), 1);
    order(&mut console, 1, Deed::Start);
    console = hangar::start(console, mission(), 1);
    pass(&mut console, 1);
    let refused = Outcome::Refused(Refusal::NoMission);
    assert_eq!(outcomes(&console), [(1, refused)]);
}

/// A mission that is locked would silently be flown for practice.
#[test]
fn a_locked_mission_is_no_exam() {
    let mut console = fixtures::career::opened(joined(), fixtures::career::newcomer());
    let fly = |mission: &str| Deed::Fly {
        mission: mission.into(),
        exam: true,
        hold: false,
    };
    order(&mut console, 1, fly("04-line-inspection"));
    let refused = Outcome::Refused(Refusal::Locked);
    assert_eq!(outcomes(&console), [(1, refused)]);
    order(&mut console, 2, fly("00-first-flight"));
    assert!(matches!(
        session_effects(&console)[..],
        [SessionEffect::StartMission(_)]
    ));
}
