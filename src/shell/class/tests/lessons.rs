//! Lessons over a real socket: a condition, the instructor's key, a branch, a kill of the desk, and trainees who are ahead.

use super::*;
use crate::class::{HoldReason, LessonPosition, LessonWait};

const PLAN: &str = r#"
schema = 1
title = "Test"
about = "A test"
[[steps]]
id = "brief"
when = "manual"
together = true
text = "Say hello."
message = "Hello"
do = ["fly 00"]
[[steps]]
id = "start"
when = "manual"
text = "Let them start."
do = ["start"]
[[steps]]
id = "guided"
when = "vehicle(1).mode == 'GUIDED'"
within = 20
otherwise = "help"
text = "They command GUIDED."
do = ["mark guided"]
then = "over"
[[steps]]
id = "help"
text = "Help."
message = "Type guided"
[[steps]]
id = "over"
when = "over"
text = "Wait."
"#;

fn lesson(member: &Member, seat: usize) -> &LessonPosition {
    let lesson = member.seats()[seat].lesson.as_ref();
    lesson.unwrap_or_else(|| panic!("{:?}", member.console.app.state().message()))
}

fn at(member: &Member, seat: usize) -> &str {
    let step = lesson(member, seat).step().expect("a step");
    step.id.as_str()
}

/// The seat at the desk that a member has, by the orders in its journal.
fn done(member: &Member) -> Vec<Deed> {
    let entries = member.place().seat().journal().entries();
    let done = entries.filter_map(|it| match &it.what {
        Noted::Order {
            deed,
            outcome: Outcome::Done,
            ..
        } if !matches!(deed, Deed::Step(_)) => Some(deed.clone()),
        _ => None,
    });
    done.collect()
}

async fn at_home(folder: &Path) -> Member {
    Box::pin(Member::new(Opening::Home, seat_options(folder))).await
}

fn message(text: &str) -> Deed {
    Deed::Message { text: text.into() }
}

#[tokio::test(start_paused = true)]
async fn a_lesson_goes_on_by_conditions_keys_and_branches_over_a_kill_of_the_desk() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = folder.path().join("test.toml");
    std::fs::write(&plan, PLAN).expect("written");
    let mut desk = Box::pin(self::desk(folder.path())).await;
    let mut anna = Box::pin(at_home(folder.path())).await;
    run(&mut [&mut desk, &mut anna], 4).await;
    let mut bohdan = Box::pin(at_home(folder.path())).await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 4).await;

    desk.say(&format!("class lesson @all {}", plan.display()))
        .await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 2).await;
    for seat in [0, 1] {
        let wait = lesson(&desk, seat).wait();
        assert_eq!(
            (at(&desk, seat), wait),
            ("brief", LessonWait::Instructor(None))
        );
    }
    // One key for all: it is a step of all seats.
    desk.say("class lesson next").await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 4).await;
    for member in [&anna, &bohdan] {
        let state = member.console.app.state();
        let flown = state.flown_mission().map(|it| it.id.as_str());
        assert_eq!(flown, Some("00-first-flight"));
        assert!(state.session().is_reading());
    }
    desk.say("class lesson next @all").await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 3).await;
    assert!(anna.console.app.state().session().has_flight_begun());
    assert_eq!((at(&desk, 0), at(&desk, 1)), ("guided", "guided"));

    // The desk is killed, and the condition comes to hold at one seat meanwhile.
    drop(desk);
    anna.say("all guided").await;
    run(&mut [&mut anna, &mut bohdan], 3).await;
    let mut desk = Box::pin(self::desk(folder.path())).await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 6).await;
    let fly = Deed::Fly {
        mission: "00-first-flight".into(),
        exam: false,
        hold: false,
    };
    let mark = Deed::Mark {
        text: "guided".into(),
    };
    let begun = [fly, message("Hello"), Deed::Start];
    let all = |more: &[Deed]| [&begun, more].concat();
    // Without a folder for records, a bookmark is refused; that does not stop the lesson.
    let anna_done = done(&anna);
    assert!(
        anna_done == all(&[]) || anna_done == all(&[mark]),
        "{anna_done:?}"
    );
    let named = |desk: &Member, step: &str| (0..2).filter(|&it| at(desk, it) == step).count();
    assert_eq!((named(&desk, "over"), named(&desk, "guided")), (1, 1));
    // The other seat is late.
    run(&mut [&mut desk, &mut anna, &mut bohdan], 20).await;
    assert_eq!(done(&bohdan), all(&[message("Type guided")]));
    assert_eq!(named(&desk, "over"), 2);
    desk.say("class end @all").await;
    desk.console.feed(key(KeyCode::Char('y'))).await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 3).await;
    for seat in [0, 1] {
        assert!(lesson(&desk, seat).has_ended());
    }
}

/// Begins the lesson of the test at the only seat.
async fn taught(pair: &mut Pair) {
    let plan = pair.folder.path().join("test.toml");
    std::fs::write(&plan, PLAN).expect("written");
    let line = format!("class lesson @all {}", plan.display());
    pair.desk.say(&line).await;
    pair.run(2).await;
}

/// Ends the flight from the desk.
async fn end(pair: &mut Pair) {
    pair.desk.say("class end @all").await;
    pair.desk.console.feed(key(KeyCode::Char('y'))).await;
    pair.run(2).await;
}

#[tokio::test(start_paused = true)]
async fn a_lesson_counts_the_flight_of_a_trainee_who_was_faster() {
    let mut pair = Box::pin(Pair::flying(FIRST)).await;
    taught(&mut pair).await;
    for step in ["start", "guided"] {
        pair.desk.say("class lesson next").await;
        pair.run(2).await;
        assert_eq!(at(&pair.desk, 0), step, "{:?}", pair.newest());
    }
    let entries = pair.anna.place().seat().journal().entries();
    let begun = entries.filter(|it| matches!(it.what, Noted::Started { .. }));
    assert!(begun.count() <= 1, "it is the same flight");
    // The condition cannot hold any more.
    end(&mut pair).await;
    assert!(lesson(&pair.desk, 0).has_ended());
    assert_eq!(
        done(&pair.anna).last(),
        Some(&message("Type guided")),
        "those who are late have a step of their own"
    );
}

#[tokio::test(start_paused = true)]
async fn a_start_leads_on_when_the_mission_is_over_already() {
    let mut pair = Box::pin(Pair::flying(FIRST)).await;
    taught(&mut pair).await;
    pair.desk.say("class lesson next").await;
    end(&mut pair).await;
    assert_eq!(at(&pair.desk, 0), "start");
    pair.desk.say("class lesson next").await;
    pair.run(2).await;
    assert!(lesson(&pair.desk, 0).has_ended());
}

#[tokio::test(start_paused = true)]
async fn another_flight_is_not_ended_by_a_lesson() {
    let mut pair = Box::pin(Pair::flying(WITH_INJECTS)).await;
    taught(&mut pair).await;
    pair.desk.say("class lesson next").await;
    pair.run(2).await;
    let held = LessonWait::Instructor(Some(HoldReason::NotFlown));
    assert_eq!(lesson(&pair.desk, 0).wait(), held);
    pair.desk.say("class lesson next").await;
    pair.run(2).await;
    assert_eq!(at(&pair.desk, 0), "start");
    assert!(pair.anna.console.app.state().session().has_flight_begun());
}
