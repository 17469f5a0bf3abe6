//! What the heads of a record show of it.

use proptest::prelude::*;

use super::*;

/// The mission time of a line that begins with its seconds.
fn time_of(line: &[u8]) -> Option<Duration> {
    let text = std::str::from_utf8(line).ok()?;
    text.split_whitespace().next()?.parse().ok().map(seconds)
}

fn witness(flown: &CandidateTry, record_name: &str, content: &[u8]) -> Witness {
    let record = WrittenRecord {
        name: &record(record_name),
        content,
        time_of,
    };
    Witness::of(flown, &record)
}

#[test]
fn a_replayed_head_hides_no_gap() {
    let mut hall = Hall::flying();
    let content = b"head\n10 one\n20 two\n120 three\n";
    let (early, late) = (
        head_of("flight", &content[..12]),
        head_of("flight", &content[..19]),
    );
    hall.head(name("00", 1), early.clone());
    hall.at += 10;
    hall.head(name("00", 1), late);
    for _ in 0..10 {
        hall.at += 10;
        assert_eq!(hall.head(name("00", 1), early.clone()), DeskHeard::Known);
    }
    hall.head(name("00", 1), head_of("flight", content));
    let flown = &hall.candidate().tries()[0];
    let (heads, gap_s) = (3, 100);
    assert_eq!(
        witness(flown, "flight", content),
        Witness::Part { heads, gap_s }
    );
}

/// Lines of a record with these mission times.
fn lines(times: impl IntoIterator<Item = u64>) -> Vec<u8> {
    let mut content = b"{\"head\":\"a long line\"}\n".to_vec();
    for time in times {
        content.extend(format!("{time} tick\n").bytes());
    }
    content
}

#[test]
fn heads_within_a_line_show_nothing() {
    let mut hall = Hall::flying();
    let content = lines(1..100);
    for bytes in 1..10 {
        hall.at += 10;
        hall.head(name("00", 1), head_of("flight", &content[..bytes]));
    }
    let flown = &hall.candidate().tries()[0];
    assert_eq!(flown.heads.len(), 9);
    assert_eq!(witness(flown, "flight", &content), Witness::Unseen);
}

#[test]
fn reading_the_brief_is_no_gap_but_mission_time_without_heads_is() {
    let mut hall = Hall::flying();
    hall.head(name("00", 1), head_of("flight", &lines([])));
    hall.at += 300;
    for end in [10, 20, 30] {
        hall.at += 10;
        hall.head(name("00", 1), head_of("flight", &lines(1..=end)));
    }
    let flown = &hall.candidate().tries()[0];
    let whole = Witness::Whole { heads: 4 };
    assert_eq!(witness(flown, "flight", &lines(1..=60)), whole);
    let (heads, gap_s) = (4, 70);
    let part = Witness::Part { heads, gap_s };
    assert_eq!(witness(flown, "flight", &lines(1..=100)), part);
}

#[test]
fn a_console_that_was_stopped_in_flight_is_named() {
    let flown = |pause: u64| {
        let mut hall = Hall::flying();
        for end in [10, 20, 30, 40] {
            hall.at += if end == 30 { 10 + pause } else { 10 };
            hall.head(name("00", 1), head_of("flight", &lines(1..=end)));
        }
        // The record is complete long before its last head comes.
        hall.at += 500;
        hall.head(name("00", 1), head_of("flight", &lines(1..=50)));
        witness(&hall.candidate().tries()[0], "flight", &lines(1..=50))
    };
    assert_eq!(flown(5), Witness::Whole { heads: 5 });
    let (heads, stopped_s) = (5, 40);
    assert_eq!(flown(40), Witness::Stopped { heads, stopped_s });
}

#[test]
fn a_record_without_heads_or_with_those_of_another_is_told_apart() {
    let mut hall = Hall::flying();
    let content = b"1 one\n2 two\n";
    let of = |hall: &Hall, name: &str| witness(&hall.candidate().tries()[0], name, content);
    assert_eq!(of(&hall, "flight"), Witness::Unseen);
    hall.head(name("00", 1), head_of("flight", content));
    assert_eq!(of(&hall, "flight"), Witness::Whole { heads: 1 });
    let record = "flight".to_owned();
    assert_eq!(of(&hall, "other"), Witness::OtherRecord { record });
}

#[test]
fn a_record_that_goes_on_after_the_time_of_its_try_is_late_also_without_heads() {
    let mut hall = Hall::flying();
    let flown = &hall.candidate().tries()[0];
    assert!(!Exam::is_late(flown, seconds(60)));
    assert!(Exam::is_late(flown, seconds(90)));
    // By the mission's time it is not, but by the desk's clock.
    hall.at += 120;
    hall.head(name("00", 1), head_of("flight", b"1 one\n"));
    assert!(Exam::is_late(&hall.candidate().tries()[0], seconds(60)));
}

proptest! {
    /// A change of anything before the newest head is noticed, and what comes after it is not its matter.
    #[test]
    fn a_rewritten_record_is_noticed(
        texts in prop::collection::vec("[a-z]{0,9}", 1..40),
        cuts in prop::collection::vec(0_usize..40, 1..6),
        place in 0_usize..400,
    ) {
        let mut hall = Hall::flying();
        let lines: Vec<String> = texts.iter().map(|text| format!("{text}\n")).collect();
        let content = lines.concat().into_bytes();
        let mut ends: Vec<usize> = cuts.iter().map(|cut| lines[..=cut % lines.len()].concat().len()).collect();
        ends.sort_unstable();
        ends.dedup();
        for end in &ends {
            hall.at += 10;
            hall.head(name("00", 1), head_of("flight", &content[..*end]));
        }
        let newest = *ends.last().expect("one at least");
        let of = |hall: &Hall, content: &[u8]| {
            witness(&hall.candidate().tries()[0], "flight", content)
        };
        let whole = of(&hall, &content);
        prop_assert!(whole.fits(), "{whole:?}");
        let place = place % content.len();
        let mut changed = content.clone();
        changed[place] ^= 1;
        prop_assert_eq!(of(&hall, &changed).fits(), place >= newest);
        let cut = of(&hall, &content[..newest - 1]);
        let is_rewritten = matches!(cut, Witness::Rewritten { .. });
        prop_assert!(is_rewritten);
    }
}
