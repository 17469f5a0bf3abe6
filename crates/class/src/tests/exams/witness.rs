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
    assert!(!Exam::is_late(flown, 100, seconds(60)));
    assert!(Exam::is_late(flown, 100, seconds(90)));
    // By the mission's time it is not, but by the desk's clock.
    hall.at += 120;
    hall.head(name("00", 1), head_of("flight", b"1 one\n"));
    assert!(Exam::is_late(
        &hall.candidate().tries()[0],
        100,
        seconds(60)
    ));
}

#[test]
fn a_record_whose_end_is_seen_late_is_not_late() {
    let mut hall = Hall::flying();
    let content = lines(1..=20);
    // The desk was closed, and a new connection begins with the head of the whole record.
    hall.at += 60 + 60;
    hall.head(name("00", 1), head_of("flight", &content));
    let flown = &hall.candidate().tries()[0];
    let length = content.len() as u64;
    assert!(!Exam::is_late(flown, length, seconds(20)));
    // If it is not the whole record, the flight went on.
    assert!(Exam::is_late(flown, length + 1, seconds(20)));
}

#[test]
fn the_head_after_the_flight_is_noted_at_once_and_once() {
    let mut hall = Hall::flying();
    let over = |content: &[u8]| TryHead {
        name: name("00", 1),
        is_over: true,
        head: head_of("flight", content),
    };
    hall.head(name("00", 1), head_of("flight", b"1 one\n"));
    let end = hall.try_head(over(b"1 one\n2 two\n"));
    assert!(matches!(end, DeskHeard::Witnessed(_)), "{end:?}");
    let again = hall.try_head(over(b"1 one\n2 two\n3 three\n"));
    assert_eq!(again, DeskHeard::Known, "a seat cannot fill the notes");
    let flown = &hall.candidate().tries()[0];
    assert!(flown.has_end_seen(12) && !flown.has_end_seen(20));
}

#[test]
fn a_desk_that_was_away_may_have_missed_the_end_until_it_sees_a_head_again() {
    let mut hall = Hall::flying();
    hall.head(name("00", 1), head_of("flight", b"1 one\n"));
    assert!(!hall.candidate().tries()[0].was_desk_away);
    let found = Exam::of(plan(ExamLayout::Own), &hall.notes, EPOCH).expect("it began");
    hall.desk = desk();
    joined(&mut hall.desk, 1, "anna", 10);
    assert!(hall.desk.hold(found));
    assert!(hall.candidate().tries()[0].was_desk_away);
    hall.at += 10;
    hall.head(name("00", 1), head_of("flight", b"1 one\n2 two\n"));
    assert!(!hall.candidate().tries()[0].was_desk_away);
}

/// A seat that flies a try.
struct Flying {
    is_over: bool,
}

impl SeatSource for Flying {
    fn report(&self) -> SeatReport {
        SeatReport::default()
    }

    fn picture(&self) -> Option<Picture> {
        None
    }

    fn insight(&self) -> Option<Insight> {
        None
    }

    fn head(&self) -> Option<TryHead> {
        Some(TryHead {
            name: name("00", 1),
            is_over: self.is_over,
            head: head_of("flight", b"1 one\n"),
        })
    }

    fn piece(&self, _: &PieceRequest) -> Option<Piece> {
        None
    }
}

#[test]
fn a_seat_sends_the_head_of_a_whole_record_at_once() {
    let mut seat = Seat::new(1, Consent::Given);
    seat.enter("9-A".into(), "anna".into(), &"petro".into());
    let mut line = SeatLine::default();
    let mut said = |is_over: bool, at: Duration| -> Vec<bool> {
        let source = Flying { is_over };
        let messages = std::iter::from_fn(|| line.next(&seat, &source, at));
        let heads = messages.filter_map(|it| match it {
            SeatMessage::Head(head) => Some(head.is_over),
            _ => None,
        });
        heads.collect()
    };
    assert_eq!(said(false, seconds(1)), [false]);
    assert_eq!(said(false, seconds(2)), [false; 0]);
    assert_eq!(said(true, seconds(2)), [true]);
    assert_eq!(said(true, seconds(3)), [false; 0]);
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
