//! The comparison of two flights of a mission.

use std::sync::Arc;
use std::time::Duration;

use sortie::app::state::Ghost;
use sortie::comparison::{ComparedFlight, FlightBookmark, differences};
use sortie::exercise::{Exercise, fly_compared, read_script};
use sortie::mission::Mission;
use sortie::mission::record::{Occasion, Stored};
use sortie::moment::Alignment;
use sortie::store;
use sortie::text::Text;

const SEED: u64 = 3;

fn first_mission() -> Arc<Mission> {
    Arc::new(store::mission("00").expect("it is shipped"))
}

/// A flight of mission 00 with the lines of a pilot script.
pub fn flown(lines: &str, name: &str) -> ComparedFlight {
    let mission = first_mission();
    let script = read_script(lines, &mission).expect("it is good");
    fly_compared(mission, SEED, script, Text::verbatim(name))
}

/// The reference pilot's flight of mission 00.
pub fn reference() -> ComparedFlight {
    let pilot = store::pilot("00-first-flight").expect("it is shipped");
    flown(&pilot.text, "reference pilot")
}

/// A flight that turns back before the gates.
pub fn short() -> ComparedFlight {
    flown(
        "wait 5s\nall guided\nall arm\nall takeoff 20\nwait all altitude > 19\nwait 12s\nall rtl\nwait all disarmed\n",
        "this flight",
    )
}

#[test]
fn what_differed_is_named_by_its_time_and_its_cost() {
    let (own, other) = (short(), reference());
    let found = differences(&own, &other);
    let times: Vec<Duration> = found.iter().filter_map(|it| it.at).collect();
    assert!(times.is_sorted(), "{found:#?}");
    let gates = found
        .iter()
        .find(|it| it.what.to_string().contains("gates"));
    let gates = gates.expect("the gates differ");
    assert_eq!(gates.own.to_string(), "0/3 gates");
    assert_eq!(gates.other.to_string(), "3/3 gates");
    assert!(gates.points < Some(-10.0), "{gates:?}");
    let takeoff = found
        .iter()
        .any(|it| it.what.to_string() == "first takeoff");
    assert!(takeoff, "{found:#?}");
    assert_eq!(differences(&other, &other), []);
}

#[test]
fn the_same_command_differs_neither_by_its_targets_nor_by_blanks() {
    let lines = "wait 5s\nall guided\nall arm\nwait 5s\nall disarm\n";
    let first_command = |lines: &str| {
        let all = differences(
            &flown(lines, "own"),
            &flown("wait 5s\n1 guided\n1 arm\n", "other"),
        );
        let of = |it: &Text| it.to_string() == "first command that differs";
        let found = all.into_iter().find(|it| of(&it.what));
        found.map(|it| [it.own.to_string(), it.other.to_string()])
    };
    let [own, other] = first_command(lines).expect("one of them disarms");
    assert_eq!([own.as_str(), other.as_str()], ["all disarm", "none"]);
    assert_eq!(first_command("wait 5s\nall  guided\n1 arm\n"), None);
    let with_words = "1 predict 800\n1 goal score 850\nwait 5s\nall guided\n1 arm\n";
    assert_eq!(first_command(with_words), None, "those are no commands");
}

#[test]
fn a_flight_is_the_same_from_its_record() {
    let mission = first_mission();
    let pilot = store::pilot("00-first-flight").expect("it is shipped");
    let script = read_script(&pilot.text, &mission).expect("it is good");
    let mut exercise = Exercise::new(Arc::clone(&mission), SEED, script, Vec::new());
    exercise.flight_mut().start_record(&Occasion::default());
    while !exercise.is_over() {
        exercise.step();
    }
    drop(exercise.close());
    let record = exercise.flight_mut().take_record();
    let stored = Stored::read(&record).expect("it is good");
    let again = ComparedFlight::of_record(&stored, "record".into()).expect("it is good");
    let flown = reference();
    assert_eq!(again.report.score, flown.report.score);
    for second in [0, 30, 60, 90] {
        let time = Duration::from_secs(second);
        let [one, other] = [&again, &flown].map(|it| it.at(time).collect::<Vec<_>>());
        assert_eq!(one.len(), other.len(), "{second}");
        for ((_, one), (_, other)) in one.iter().zip(&other) {
            let apart_m = one.place.distance_m(other.place);
            // Positions of a record come from messages, which are rounded to a centimetre.
            assert!(apart_m < 0.1, "{second}: {apart_m}");
        }
    }
    assert_eq!(differences(&again, &flown), []);
}

#[test]
fn two_flights_are_aligned_by_what_happened_in_both() {
    let (own, other) = (short(), reference());
    let takeoffs = [&own, &other].map(|it| it.anchor(Alignment::Takeoff).expect("it took off"));
    assert!(takeoffs[0] > takeoffs[1], "{takeoffs:?}");
    let mut ghost = Ghost::new(Arc::new(other), Some(Arc::new(own)));
    let at = Duration::from_secs(40);
    assert_eq!(ghost.time(at), Some(at));
    assert!(ghost.align(Alignment::Takeoff));
    let later = takeoffs[0].abs_diff(takeoffs[1]);
    assert_eq!(ghost.time(at + later), Some(at));
    assert_eq!(ghost.time(Duration::ZERO), None);
    assert!(!ghost.align(Alignment::Refusal), "nothing was refused");
    assert_eq!(ghost.alignment(), Alignment::Takeoff);
    let mut under_way = Ghost::new(Arc::clone(&ghost.other), None);
    assert!(!under_way.align(Alignment::Takeoff));
}

fn with_bookmarks(flight: ComparedFlight, bookmarks: &[(u64, &str)]) -> ComparedFlight {
    let bookmark = |&(second, text): &(u64, &str)| FlightBookmark {
        at: Duration::from_secs(second),
        text: text.to_owned(),
    };
    flight.with_bookmarks(bookmarks.iter().map(bookmark).collect())
}

#[test]
fn two_flights_are_aligned_by_the_same_bookmark_else_by_the_first() {
    let own = || with_bookmarks(short(), &[(10, "late"), (30, "gate")]);
    let seconds = Duration::from_secs;
    for (theirs, expected) in [
        (&[(5, "wind"), (20, "gate")][..], Some(seconds(40))),
        (&[(5, "wind")][..], Some(seconds(45))),
        (&[][..], None),
    ] {
        let other = with_bookmarks(reference(), theirs);
        let mut ghost = Ghost::new(Arc::new(other), Some(Arc::new(own())));
        let is_aligned = ghost.align(Alignment::Bookmark);
        assert_eq!(is_aligned, expected.is_some());
        let shown = ghost.time(seconds(50)).filter(|_| is_aligned);
        assert_eq!(shown, expected, "{theirs:?}");
    }
}
