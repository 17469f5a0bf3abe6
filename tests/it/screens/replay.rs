//! The console during a replay: its timeline, its keys, its answers, and how it ends.

use std::sync::Arc;
use std::time::Duration;

use sortie::app::effect::{Effect, Launch, ReplayEffect, SessionEffect};
use sortie::app::event::{ReplayEvent, SessionEvent};
use sortie::app::room::Room;
use sortie::app::state::{Activity, ReplayPosition, ReplayView};
use sortie::campaign::Stake;
use sortie::mission::Progress;
use sortie::moment::{Moment, MomentKind};
use sortie::scoring::Report;
use sortie::text::Text;

use super::{check, debrief};
use crate::fixtures;
use crate::harness::Console;

const LENGTH: Duration = Duration::from_secs(312);

fn mission() -> Activity {
    Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    }
}

fn view() -> ReplayView {
    ReplayView::new("2026-11-20_m01".to_owned(), 1_763_647_402_000_000, LENGTH)
}

fn moment(at_s: u64, kind: MomentKind, text: &str) -> Moment {
    Moment {
        at: Duration::from_secs(at_s),
        vehicles: std::iter::empty().collect(),
        kind,
        by: None,
        text: Text::verbatim(text),
    }
}

/// A replayed mission with three moments.
fn replaying() -> Console {
    let mut console = Console::new();
    console.at(100);
    console.replay(view(), mission());
    let gap = Duration::from_secs(140)..Duration::from_secs(180);
    console.hear(ReplayEvent::Gaps(Arc::new(vec![gap])));
    console.hear(ReplayEvent::Known {
        length: LENGTH,
        moments: Arc::new(vec![
            moment(10, MomentKind::Bookmark, "into the wind"),
            moment(70, MomentKind::Refusal, "outside the fence"),
            moment(290, MomentKind::Objective, "the air is measured"),
        ]),
        report: Some(Arc::new(fixtures::report())),
    });
    console.vehicle(fixtures::airborne(1, 30.0, 20.0));
    shows(&mut console, ReplayPosition::default());
    console
}

fn shows(console: &mut Console, position: ReplayPosition) {
    console.hear(ReplayEvent::At(ReplayPosition {
        indexed: LENGTH,
        ..position
    }));
}

fn stopped_at(seconds: f64) -> ReplayPosition {
    ReplayPosition {
        at: Duration::from_secs_f64(seconds),
        is_playing: false,
        ..ReplayPosition::default()
    }
}

/// The last line of the screen, which has the timeline.
fn last_line(console: &Console) -> String {
    let screen = console.screen(80, 24);
    screen.lines().last().unwrap_or_default().to_owned()
}

#[test]
fn a_session_that_starts_in_a_replay_ends_it() {
    for is_review in [false, true] {
        let mut console = Console::new();
        console.at(100);
        let view = ReplayView {
            is_review,
            ..view()
        };
        console.replay(view, mission());
        shows(&mut console, stopped_at(40.0));
        console.start(mission());
        console.at(101);
        assert!(console.state().replay().is_none());
        assert_eq!(console.state().room(), Room::Mission, "the brief is shown");
        assert!(console.state().session().is_reading(), "its clock waits");
        let screen = console.screen(80, 24);
        assert!(!screen.contains("REPLAY"), "{screen}");
        console.press("F");
        console.vehicle(fixtures::parked(1)).give("all arm");
        assert!(
            matches!(console.effects.as_slice(), [Effect::Order { .. }]),
            "it accepts commands: {:?}",
            console.effects
        );
        console.replay(
            ReplayView {
                is_review,
                ..self::view()
            },
            mission(),
        );
        assert!(console.state().replay().is_some(), "another one opens");
    }
}

#[test]
fn a_session_after_a_replay_begins_at_the_time_of_the_console() {
    let mut console = replaying();
    shows(&mut console, stopped_at(40.0));
    console.at(150);
    console.start(Activity::Free);
    assert_eq!(console.state().now(), Duration::from_secs(150));
}

#[test]
fn the_truth_is_reached_in_the_debrief_of_a_replay() {
    let mut console = replaying();
    console.hear(SessionEvent::MissionEnded(Box::new(Report {
        truth: debrief::truth(),
        ..fixtures::report()
    })));
    console.press("D").at(120);
    let footer = last_line(&console);
    assert!(footer.contains("g truth"), "{footer}");
    let stops = vec![MomentKind::Refusal, MomentKind::Alert];
    shows(
        &mut console,
        ReplayPosition {
            stops,
            ..stopped_at(40.0)
        },
    );
    let footer = last_line(&console);
    assert!(
        footer.contains("g truth") && footer.contains('●'),
        "{footer}"
    );
    console.press("g");
    let debrief = console.state().rooms().debrief().shown();
    assert!(debrief.expect("a debrief").shows_map());
    console.press("m");
    assert!(console.screen(80, 24).contains("Moments"));
}

/// A console after a mission with this report.
fn debriefed(report: Report) -> Console {
    let mut console = Console::new();
    console.start(mission());
    console.hear(SessionEvent::MissionEnded(Box::new(report)));
    console.at(5);
    assert_eq!(console.state().room(), Room::Debrief);
    console
}

#[test]
fn a_review_leads_back_to_the_debrief_from_which_it_was_opened() {
    let report = fixtures::report();
    let mut console = debriefed(report.clone());
    let again = [Effect::Session(SessionEffect::StartMission(
        Launch::graded(report.mission.clone()),
    ))];
    console.press("a");
    let view = ReplayView {
        is_review: true,
        ..view()
    };
    console.replay(view, mission());
    assert_eq!(console.state().room(), Room::Review);
    // The replay reaches the result of the same flight.
    console.hear(SessionEvent::MissionEnded(Box::new(report)));
    console.press("esc");
    assert_eq!(console.state().room(), Room::Debrief);
    assert!(console.state().rooms().debrief().shows_earlier());
    let screen = console.screen(80, 24);
    assert!(screen.contains("r new try"), "{screen}");
    assert_eq!(console.press("r").effects, again);
    // From elsewhere, the review leads to the replay.
    console.press("F").press("A").press("esc");
    assert_eq!(console.state().room(), Room::Fly);
}

#[test]
fn the_last_debrief_is_shown_in_later_sessions() {
    let first = fixtures::report();
    let is_shown = |console: &Console| {
        let shown = console.state().rooms().debrief().shown();
        shown.is_some_and(|it| it.report().seed == fixtures::report().seed)
    };
    let mut console = debriefed(first.clone());
    console.start(Activity::Free);
    console.at(10).press("D");
    assert!(is_shown(&console));
    console.press("esc");
    assert_eq!(console.state().room(), Room::Fly, "the flight goes on");
    console.replay(view(), mission());
    let other = Report {
        seed: first.seed + 1,
        ..first
    };
    console.hear(SessionEvent::MissionEnded(Box::new(other)));
    console.at(15).press("D");
    assert!(!is_shown(&console), "the debrief of the flight replayed");
    console.press("Q").press("D");
    assert!(console.state().replay().is_none());
    assert!(is_shown(&console));
}

#[test]
fn the_keys_of_rooms_apart_from_the_flight_are_above_the_time_line() {
    let mut console = replaying();
    for (room, keys) in [("H", ": command"), ("W", "Tab lists"), ("T", "Tab page")] {
        let screen = console.press(room).screen(80, 24);
        let lines: Vec<&str> = screen.lines().collect();
        assert!(lines[22].contains(keys), "{room}: {screen}");
        let bar = lines[23];
        assert!(bar.contains('●') && bar.contains("Q leave"), "{bar}");
    }
}

#[test]
fn the_list_of_moments_opens_at_the_moment_shown() {
    let mut console = replaying();
    shows(&mut console, stopped_at(80.0));
    console.press("m").press("enter");
    let shown = |at_s| {
        [Effect::Replay(ReplayEffect::Show(Duration::from_secs(
            at_s,
        )))]
    };
    assert_eq!(console.effects, shown(70));
    shows(&mut console, stopped_at(5.0));
    console.press("m").press("enter");
    assert_eq!(console.effects, shown(10));
}

#[test]
fn tenths_of_a_second_are_shown_while_it_is_stopped() {
    let mut console = replaying();
    shows(&mut console, stopped_at(83.4));
    assert!(last_line(&console).contains("01:23.4"));
    let playing = ReplayPosition {
        is_playing: true,
        ..stopped_at(83.4)
    };
    shows(&mut console, playing);
    assert!(!last_line(&console).contains("01:23.4"));
}

#[test]
fn the_keys_for_the_rate_meet_real_time() {
    let mut console = replaying();
    let mut rate = 0.1;
    let mut press = |key: &str| {
        let position = ReplayPosition {
            rate,
            ..ReplayPosition::default()
        };
        shows(&mut console, position);
        console.press(key);
        if let [Effect::Replay(ReplayEffect::Rate(set))] = console.effects.as_slice() {
            rate = *set;
        }
        rate
    };
    let up: Vec<f64> = (0..10).map(|_| press(">")).collect();
    assert_eq!(
        up,
        vec![0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 64.0]
    );
    assert_eq!(vec![press("<")], vec![32.0]);
}

#[test]
fn what_a_replay_is_told_is_confirmed() {
    let mut console = replaying();
    for (line, said) in [
        (
            "stopat refusal alert",
            "the replay stops at: refusal, alert",
        ),
        ("stopat off", "the replay does not stop at moments"),
        ("loop off", "nothing is repeated"),
        ("restart", "a replay cannot be flown again"),
    ] {
        console.give(line);
        let screen = console.screen(80, 24);
        assert!(screen.contains(said), "{line}: {screen}");
    }
    let position = ReplayPosition {
        stops: vec![MomentKind::Refusal, MomentKind::Alert],
        ..ReplayPosition::default()
    };
    shows(&mut console, position);
    console.at(130);
    let line = last_line(&console);
    assert!(line.contains("stops at r !"), "{line}");
}

#[test]
fn the_pages_of_the_review_leave_the_replay_where_it_is() {
    let mut console = replaying();
    let playing = ReplayPosition {
        at: Duration::from_secs(80),
        ..ReplayPosition::default()
    };
    shows(&mut console, playing);
    console.press("A").press("tab");
    assert!(console.effects.is_empty(), "{:?}", console.effects);
    console.press("up");
    let first = ReplayEffect::Show(Duration::from_secs(10));
    assert_eq!(console.effects.last(), Some(&Effect::Replay(first)));
    assert!(console.screen(80, 24).contains("+ sustain"));
    console.press("shift-tab");
    assert!(console.screen(80, 24).contains("objectives"), "a page back");
}

#[test]
fn a_gap_leaves_the_time_line_in_sight() {
    let mut console = replaying();
    let position = ReplayPosition {
        gap: Some(Duration::from_secs(5)),
        ..stopped_at(100.0)
    };
    shows(&mut console, position);
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    let line = last_line(&console);
    assert!(line.contains('●') && line.contains("05:12"), "{line}");
    console.give("bookmark here");
    let screen = console.screen(80, 24);
    assert!(screen.contains("bookmark set"), "{screen}");
    assert!(last_line(&console).contains('●'), "{screen}");
    let wide = console.screen(200, 50);
    assert!(wide.contains("nothing recorded for 5 s"), "{wide}");
}

#[test]
fn a_replay_offers_no_hint() {
    let mut console = replaying();
    let mut progress = Progress {
        hint: Some("fly higher".into()),
        ..fixtures::progress()
    };
    progress.clues.next = Some((1, 0.1));
    console.hear(SessionEvent::Mission(Box::new(progress)));
    for room in ["F", "B"] {
        console.press(room);
        let screen = console.screen(200, 50);
        for unwanted in ["fly higher", "costs"] {
            assert!(!screen.contains(unwanted), "{room}: {unwanted}: {screen}");
        }
    }
}

#[test]
fn a_replay_is_no_flight_under_way() {
    let mut console = replaying();
    console.press("H");
    let screen = console.screen(200, 50);
    assert!(!screen.contains("still running"), "{screen}");
    assert!(screen.contains("Replay of Air sample"), "{screen}");
    console.press("u");
    let screen = console.screen(200, 50);
    assert!(!screen.contains("under way"), "{screen}");
}

#[test]
fn lines_for_a_replay_are_offered_only_in_one() {
    let offers = |console: &mut Console| {
        console.press(":").write("stopat");
        let screen = console.screen(120, 40);
        console.press("esc");
        screen.contains("stopat arming")
    };
    assert!(offers(&mut replaying()));
    assert!(!offers(&mut Console::flying(1)));
}

#[test]
fn the_time_line_with_its_gaps_and_stops() {
    let mut console = replaying();
    let position = ReplayPosition {
        gap: Some(Duration::from_secs(40)),
        stops: vec![MomentKind::Refusal],
        looped: Some((Duration::from_secs(60), Duration::from_secs(200))),
        ..stopped_at(150.2)
    };
    shows(&mut console, position);
    check("replay_gap", &console);
}
