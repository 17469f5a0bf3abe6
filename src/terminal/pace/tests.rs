use super::*;

/// Draws whenever allowed for `seconds`, on a line with a limited rate and a terminal that answers; returns the number
/// of frames and the largest number of bytes in transit.
fn fly(pace: &mut Pace, seconds: u64, line_bytes_per_s: u64, frame_bytes: u64) -> (u32, u64) {
    let (mut frames, mut most, mut under_way) = (0, 0, 0_u64);
    let mut question_behind: Option<u64> = None;
    for millis in 0..seconds * 1000 {
        let now = Duration::from_millis(millis);
        let carried = line_bytes_per_s * (millis + 1) / 1000 - line_bytes_per_s * millis / 1000;
        under_way = under_way.saturating_sub(carried);
        question_behind = question_behind.map(|behind| behind.saturating_sub(carried));
        if question_behind == Some(0) {
            question_behind = None;
            pace.answered(now);
        }
        if pace.wait(now).is_zero() {
            let asks = pace.asks(now);
            under_way += frame_bytes;
            frames += 1;
            pace.drawn(now, frame_bytes, asks);
            if asks {
                question_behind = Some(under_way);
            }
        }
        most = most.max(under_way);
    }
    (frames, most)
}

#[test]
fn a_fast_line_gets_every_frame_that_is_wanted() {
    for wanted in [1, 10, 30] {
        let (frames, _) = fly(&mut Pace::new(wanted), 10, 1_000_000, 400);
        let expected = u32::from(wanted) * 10;
        assert!(
            (expected * 9 / 10..=expected).contains(&frames),
            "{frames} of {expected}"
        );
    }
}

/// Types this many keys per second for one second after a first frame; returns the number of
/// further frames.
fn type_keys(pace: &mut Pace, keys_per_s: u64) -> u32 {
    let mut frames = 0;
    let mut typed = 0;
    for micros in 0..1_000_000_u64 {
        let now = Duration::from_secs(10) + Duration::from_micros(micros);
        let due = keys_per_s * micros / 1_000_000;
        let has_new = due > typed;
        if has_new {
            pace.pressed();
            typed = due;
        }
        if pace.has_key && pace.wait(now).is_zero() {
            pace.drawn(now, 200, pace.asks(now));
            pace.answered(now);
            frames += 1;
        }
    }
    frames
}

#[test]
fn a_key_is_drawn_at_once_whatever_the_frame_rate() {
    let now = Duration::from_secs(10);
    for wanted in [1, 10, 60] {
        let mut pace = Pace::new(wanted);
        pace.drawn(Duration::from_millis(9990), 200, true);
        pace.answered(Duration::from_millis(9991));
        assert!(pace.wait(now) > Duration::ZERO);
        pace.pressed();
        assert_eq!(pace.wait(now), Duration::ZERO, "{wanted} frames a second");
        pace.drawn(now, 200, false);
        assert!(pace.wait(now) > KEY_INTERVAL, "only the key was in a hurry");
    }
}

#[test]
fn a_flood_of_keys_is_no_flood_of_frames() {
    let frames = type_keys(&mut Pace::new(10), 10_000);
    assert!((110..=121).contains(&frames), "{frames}");
    assert_eq!(type_keys(&mut Pace::new(10), 8), 7);
}

#[test]
fn keys_do_not_hurry_a_line_that_does_not_keep_up() {
    let mut pace = Pace::new(10);
    pace.drawn(Duration::from_secs(1), 200, true);
    pace.answered(Duration::from_secs(1));
    pace.drawn(Duration::from_secs(2), 200, true);
    pace.pressed();
    let wait = pace.wait(Duration::from_secs(3));
    assert!(wait > Duration::from_secs(1), "{wait:?}");
}

#[test]
fn a_slow_line_never_has_a_backlog_to_work_off() {
    let mut pace = Pace::new(10);
    let (_, most) = fly(&mut pace, 60, 1000, 400);
    assert!(most <= 3000, "{most} bytes were under way");
    let mut pace = Pace::new(10);
    let (_, most) = fly(&mut pace, 60, 1000, 2000);
    assert!(most <= 14_000, "{most} bytes were under way");
    let rate = pace.slow_bytes_per_s().expect("frames of two seconds");
    assert!((900.0..1100.0).contains(&rate), "{rate}");
}

#[test]
fn a_stalled_terminal_gets_next_to_nothing_and_then_everything() {
    let mut pace = Pace::new(10);
    fly(&mut pace, 5, 1_000_000, 400);
    let mut frames = 0;
    let stalled_at = Duration::from_secs(5);
    for millis in 0..30_000 {
        let now = stalled_at + Duration::from_millis(millis);
        if pace.wait(now).is_zero() {
            pace.drawn(now, 400, pace.asks(now));
            frames += 1;
        }
    }
    assert!(frames <= 12, "{frames} frames wait to be read");
    let now = stalled_at + Duration::from_secs(30);
    pace.answered(now);
    assert!(pace.wait(now + Duration::from_millis(100)).is_zero());
}

#[test]
fn a_terminal_that_answers_nothing_is_drawn_on_at_full_pace_after_a_while() {
    let mut pace = Pace::new(10);
    let (frames, _) = fly(&mut pace, 5, 0, 400);
    assert!(frames <= 11, "{frames}: trial first");
    let now = Duration::from_secs(6);
    pace.drawn(now, 400, pace.asks(now));
    assert_eq!(pace.wait(now), Duration::from_millis(100));
    assert!(!pace.asks(now), "it has been asked often enough");
}

#[test]
fn a_terminal_that_has_not_answered_yet_has_little_to_read() {
    for (frame_bytes, most_bytes) in [(400, 4400), (1500, 5500), (6000, 6500)] {
        let mut pace = Pace::new(10);
        pace.drawn(Duration::ZERO, 50, true);
        let (_, most) = fly(&mut pace, 5, 0, frame_bytes);
        assert!(most <= most_bytes, "{most} bytes of {frame_bytes} each");
    }
}

#[test]
fn an_answer_that_comes_late_is_believed() {
    let mut pace = Pace::new(10);
    pace.drawn(Duration::ZERO, 400, true);
    let now = Duration::from_secs(7);
    pace.drawn(now, 400, pace.asks(now));
    assert!(!pace.asks(now), "taken for deaf");
    pace.answered(now);
    assert!(pace.asks(now));
}

#[test]
fn after_a_stall_the_newest_state_follows_at_once_and_only_then_a_rest() {
    let mut pace = Pace::new(10);
    pace.drawn(Duration::from_secs(70), 3000, false);
    let now = Duration::from_secs(100);
    pace.written(now, Duration::from_secs(30), 3000);
    assert_eq!(pace.wait(now), Duration::ZERO);
    pace.drawn(now, 3000, false);
    pace.written(now, Duration::from_millis(1), 3000);
    assert_eq!(pace.wait(now), LONGEST_REST);
}

#[test]
fn a_line_on_which_write_after_write_meets_a_full_buffer_rests_after_each() {
    let mut pace = Pace::new(10);
    pace.drawn(Duration::from_secs(8), 3000, false);
    pace.written(Duration::from_secs(10), Duration::from_secs(2), 3000);
    assert_eq!(pace.slow_bytes_per_s(), Some(1500.0));
    pace.drawn(Duration::from_secs(10), 3000, false);
    let now = Duration::from_secs(11);
    pace.written(now, Duration::from_secs(1), 3000);
    assert_eq!(pace.wait(now), Duration::from_secs(1));
}

#[test]
fn a_rate_is_reported_once_it_was_measured() {
    let mut pace = Pace::new(10);
    let at = Duration::from_secs;
    // The console starts, and hears the first answer late.
    pace.drawn(at(0), 3000, true);
    pace.answered(at(3));
    assert_eq!(pace.slow_bytes_per_s(), None);
    // A frame of a few bytes says nothing of the line.
    pace.drawn(at(4), 40, true);
    pace.answered(at(6));
    assert_eq!(pace.slow_bytes_per_s(), None);
    pace.drawn(at(7), 3000, true);
    pace.answered(at(9));
    assert_eq!(pace.slow_bytes_per_s(), Some(1500.0));
}
