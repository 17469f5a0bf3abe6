//! The room of the review, and the document made from it.

use std::sync::Arc;
use std::time::Duration;

use sortie::app::effect::{Effect, FileEffect, FileKind, ReplayEffect, SessionEffect};
use sortie::app::event::{CareerEvent, Event, ReplayEvent, SessionEvent};
use sortie::app::state::{Activity, Ghost, ReplayView};
use sortie::campaign::Stake;
use sortie::language::GhostSource;
use sortie::mission::Progress;
use sortie::moment::{Moment, MomentKind};
use sortie::review::{PointKind, Review};
use sortie::scoring::{Report, VehicleLoad, WorkloadCourse, WorkloadReport};
use sortie::text::Text;

use super::check;
use crate::comparisons;
use crate::fixtures;
use crate::harness::Console;

fn moment(at_s: u64, kind: MomentKind, vehicle: Option<u16>, text: &str) -> Moment {
    Moment {
        at: Duration::from_secs(at_s),
        vehicles: vehicle.into_iter().collect(),
        kind,
        by: None,
        text: Text::verbatim(text),
    }
}

/// A mission under review, with its result.
fn reviewing() -> Console {
    let mut console = Console::new();
    let length = Duration::from_secs(312);
    let mut view = ReplayView::new("2026-11-20_m01".to_owned(), 1_763_647_402_000_000, length);
    view.is_review = true;
    view.position.is_playing = false;
    let activity = Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    };
    console.replay(view, activity);
    console.hear(ReplayEvent::Known {
        length,
        moments: Arc::new(vec![
            moment(1, MomentKind::Arming, Some(1), "armed"),
            moment(12, MomentKind::Bookmark, None, "into the wind"),
            moment(
                70,
                MomentKind::Refusal,
                Some(2),
                "2 goto n 900: refused: outside the fence",
            ),
            moment(150, MomentKind::Rule, Some(2), "flew higher than 60 m"),
            moment(
                290,
                MomentKind::Objective,
                None,
                "objective reached: measure the air",
            ),
        ]),
        report: Some(Arc::new(fixtures::report())),
    });
    console.vehicle(fixtures::airborne(1, 30.0, 20.0));
    console.vehicle(fixtures::airborne(2, 60.0, 25.0));
    console
}

/// The review that was stored last.
fn kept(console: &Console) -> Option<Review> {
    let kept = console
        .effects
        .iter()
        .rev()
        .find_map(|effect| match effect {
            Effect::Replay(ReplayEffect::Keep(review)) => Some(review),
            _ => None,
        });
    kept.map(|review| *review.clone())
}

#[test]
fn a_review_asks_four_questions_before_it_explains() {
    let mut console = reviewing();
    check("review_planned", &console);
    console.press("tab").press("j").press("j");
    let shown = Effect::Replay(ReplayEffect::Show(Duration::from_secs(150)));
    assert!(console.effects.contains(&shown), "{:?}", console.effects);
    console
        .press("-")
        .write("stay below the limit")
        .press("enter");
    check("review_happened", &console);
    console
        .press("tab")
        .press("enter")
        .write("too high in the turns")
        .press("enter");
    check("review_why", &console);
    console.press("right").press("right");
    assert!(
        console
            .screen(80, 24)
            .contains("Answer both questions first")
    );
    console
        .press("left")
        .press("enter")
        .write("climb after the turn")
        .press("enter");
    let review = kept(&console).expect("it is stored");
    check("review_next", &console);
    console.press("right");
    check("review_explained", &console);
    assert_eq!(review.why, "too high in the turns");
    let point = &review.points()[0];
    assert_eq!(
        (point.kind, point.at()),
        (PointKind::Improve, Duration::from_secs(150))
    );
}

#[test]
fn another_flight_is_compared_and_drawn_on_the_map() {
    let mut console = reviewing();
    console.give("ghost reference");
    let fetched = Effect::Session(SessionEffect::Ghost(GhostSource::Reference));
    assert_eq!(console.effects.last(), Some(&fetched));
    let ghost = Ghost::new(
        Arc::new(comparisons::reference()),
        Some(Arc::new(comparisons::short())),
    );
    console.hear(SessionEvent::Ghost(Box::new(ghost)));
    console.press("left");
    assert!(console.screen(80, 24).contains("Planned"));
    for _ in 0..5 {
        console.press("right");
    }
    check("review_compared", &console);
    console.give("ghost by takeoff");
    assert!(
        console
            .screen(80, 24)
            .contains("aligned by the first takeoff")
    );
    console.give("ghost off");
    assert!(console.screen(80, 24).contains("Compare this flight"));
}

#[test]
fn a_flight_that_counts_has_no_ghost_of_another_pilot() {
    for (stake, line, said) in [
        (
            Stake::Graded,
            "ghost reference",
            "without the ghost of another pilot",
        ),
        (
            Stake::Graded,
            "ghost 1.run.jsonl",
            "without the ghost of another pilot",
        ),
        (Stake::Graded, "ghost best", "fetching"),
        (Stake::Practice, "ghost reference", "fetching"),
        (
            Stake::Exam,
            "ghost best",
            "an exam is flown without a ghost",
        ),
    ] {
        let mut console = Console::new();
        console.start(Activity::Mission {
            id: "m01".to_owned(),
            title: "Air sample at the yard".into(),
            stake,
        });
        console.press("F").give(line);
        let screen = console.screen(120, 40);
        assert!(screen.contains(said), "{stake:?} {line}\n{screen}");
    }
}

#[test]
fn a_bookmark_is_set_and_removed_after_the_flight() {
    let mut console = reviewing();
    console.give("bookmark turn");
    let texts = |review: &Review| -> Vec<String> {
        let bookmarks = review.bookmarks(&[]).into_iter();
        bookmarks.map(|it| it.text.to_string()).collect()
    };
    assert_eq!(
        texts(&kept(&console).expect("stored")),
        ["turn", "into the wind"]
    );
    console.give("bookmark off");
    assert_eq!(
        texts(&kept(&console).expect("stored")),
        ["into the wind"],
        "the one of the moment shown is removed"
    );
    console.give("bookmark off");
    assert_eq!(console.effects, []);
    assert!(
        console
            .screen(80, 24)
            .contains("the moment shown has no bookmark")
    );
}

#[test]
fn without_a_replay_the_last_flight_is_reviewed() {
    let mut console = Console::new();
    console.press("A");
    assert!(console.screen(80, 24).contains("No review is open."));
    console.give("review");
    let review = Effect::Session(SessionEffect::Replay {
        path: None,
        review: true,
    });
    assert_eq!(console.effects.last(), Some(&review));
    console.give("review why because");
    assert!(console.screen(80, 24).contains("no review is open"));
}

#[test]
fn the_document_explains_nothing_before_the_questions_are_answered() {
    let mut console = reviewing();
    let document = |console: &mut Console| {
        console.give("review export review.md");
        match console.effects.last() {
            Some(Effect::File(FileEffect::Write {
                kind: FileKind::Review,
                text,
                ..
            })) => text.clone(),
            other => panic!("{other:?}"),
        }
    };
    console.give("review why too fast");
    let before = document(&mut console);
    assert!(
        before.contains("- 00:12 bookmark: into the wind\n"),
        "{before}"
    );
    assert!(
        !before.contains("armed") && !before.contains("COMPONENTS"),
        "{before}"
    );
    console.give("review next slower");
    insta::assert_snapshot!("review_document", document(&mut console));
}

#[test]
fn the_next_brief_repeats_the_points_of_the_last_review() {
    let mut console = Console::new();
    let mut review = Review::default();
    let text = "stay below the limit".to_owned();
    review
        .add(PointKind::Improve, Duration::ZERO, text)
        .expect("there is room");
    console.hear(CareerEvent::Reviews([("m01".to_owned(), review)].into()));
    console.start(Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    });
    let screen = console.screen(80, 24);
    assert!(screen.contains("from your last review"), "{screen}");
    assert!(screen.contains("- stay below the limit"), "{screen}");
}

/// A workload of five minutes with a busy period and two answers.
fn workload() -> WorkloadReport {
    let mut course = WorkloadCourse::default();
    let commands: Vec<Duration> = (6..20).map(|at| Duration::from_secs(at * 10)).collect();
    for point in 0..32 {
        course.note(VehicleLoad {
            waiting: u16::from(point > 20) * 2,
            neglected: Duration::from_secs(point * 12),
            waited: Duration::from_secs(point.saturating_sub(20) * 20),
        });
    }
    for (second, level) in [(125, 4), (244, 2)] {
        course.answer(Duration::from_secs(second), level);
    }
    course.report(&commands)
}

#[test]
fn the_workload_of_a_recorded_flight_is_shown_at_the_moment_shown() {
    let mut console = reviewing();
    let report = Report {
        workload: workload(),
        ..fixtures::report()
    };
    console.hear(ReplayEvent::Known {
        length: Duration::from_secs(312),
        moments: Arc::new(vec![moment(150, MomentKind::Rule, Some(2), "too high")]),
        report: Some(Arc::new(report)),
    });
    console.hear(SessionEvent::Mission(Box::new(Progress {
        elapsed: Duration::from_secs(150),
        ..fixtures::progress()
    })));
    console.press("tab");
    check("review_workload", &console);
    console.give("show mission");
    check("mission_replayed_workload", &console);
}

#[test]
fn a_mission_asks_for_the_workload_every_two_minutes_unless_it_is_an_exam() {
    let asks = |stake, elapsed_s, answered_question| {
        let mut console = Console::new();
        console.start(Activity::Mission {
            id: "m01".to_owned(),
            title: "Air sample at the yard".into(),
            stake,
        });
        console.vehicle(fixtures::airborne(1, 30.0, 20.0));
        console.hear(SessionEvent::Mission(Box::new(Progress {
            elapsed: Duration::from_secs(elapsed_s),
            answered_question,
            ..fixtures::progress()
        })));
        let screens = ["show fly", "show mission"].map(|room| {
            console.give(room);
            console.screen(80, 24).contains("Your workload, from 1")
        });
        assert_eq!(screens[0], screens[1]);
        screens[0]
    };
    assert!(asks(Stake::Graded, 121, None));
    assert!(asks(Stake::Practice, 254, Some(1)));
    assert!(!asks(Stake::Graded, 121, Some(1)), "it was answered");
    assert!(!asks(Stake::Graded, 135, None), "15 s are over");
    assert!(!asks(Stake::Graded, 60, None));
    assert!(!asks(Stake::Exam, 121, None));
}

#[test]
fn a_message_leaves_the_time_line_of_a_replay_in_sight() {
    let mut console = reviewing();
    console.hear(Event::Answer("bookmark set".into()));
    let screen = console.screen(80, 24);
    let last = screen.trim_end().lines().last().unwrap_or_default();
    for part in ["00:00", "05:12", "●", "◆", "bookmark set"] {
        assert!(last.contains(part), "{part}: {last}");
    }
    let long = "no moment of this kind comes after this one; try another kind of moment";
    console.hear(Event::Answer(long.into()));
    let screen = console.screen(80, 24);
    let last: Vec<&str> = screen.trim_end().lines().rev().take(2).collect();
    assert!(last[1].contains(long) && last[0].contains("●"), "{last:?}");
}

#[test]
fn the_time_line_is_long_enough_on_a_small_screen() {
    let console = reviewing();
    let screen = console.screen(80, 24);
    let last = screen.trim_end().lines().last().unwrap_or_default();
    let cells = last
        .split_once("00:00.0 ")
        .and_then(|(_, rest)| rest.split_once(" 05:12"));
    let (cells, keys) = cells.expect("a timeline");
    assert!(cells.chars().count() >= 30, "{last}");
    assert!(keys.contains("Space play"), "{last}");
}

#[test]
fn the_list_of_moments_shows_the_whole_reason_of_a_refusal() {
    let mut console = reviewing();
    let why =
        "all takeoff 25: takeoff refused: it is not armed, and the filter has no position yet";
    console.hear(ReplayEvent::Known {
        length: Duration::from_secs(312),
        moments: Arc::new(vec![moment(70, MomentKind::Refusal, Some(2), why)]),
        report: None,
    });
    console.press("m");
    let screen = console.screen(80, 24);
    let words: Vec<&str> = screen.split_whitespace().collect();
    let words = words.join(" ").replace(" │ │ ", " ");
    assert!(
        words.contains("not armed, and the filter has no position yet"),
        "{screen}"
    );
}

#[test]
fn the_review_names_its_keys_on_every_page() {
    let mut console = reviewing();
    for _ in 0..6 {
        let screen = console.screen(80, 24);
        for keys in ["Tab page", "e export", "g other flight"] {
            assert!(screen.contains(keys), "{keys}: {screen}");
        }
        console.press("tab");
    }
}
