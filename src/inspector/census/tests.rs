use std::time::Duration;

use mavlink::dialects::ardupilotmega::{ATTITUDE_DATA, MavMessage, TIMESYNC_DATA};
use proptest::prelude::*;

use super::*;
use crate::wire::{Encoder, Outgoing, ground_station_heartbeat};

const IN: FrameWay = FrameWay::received(0);

fn bytes(system: u8, outgoing: &Outgoing) -> Vec<u8> {
    let mut bytes = Vec::new();
    Encoder::new(system, 1).encode(outgoing, &mut bytes);
    bytes
}

fn attitude(system: u8) -> Vec<u8> {
    bytes(
        system,
        &MavMessage::ATTITUDE(ATTITUDE_DATA::default()).into(),
    )
}

fn only(census: &Census) -> &MessageTally {
    let mut tallies = census.tallies();
    let (_, only) = tallies.next().expect("one");
    assert!(tallies.next().is_none());
    only
}

#[test]
fn the_same_system_over_two_peers_or_in_two_directions_is_never_merged() {
    let mut census = Census::default();
    for from in [IN, FrameWay::received(1), FrameWay::sent(0)] {
        census.note(from, &attitude(1), true, Duration::ZERO);
    }
    assert_eq!(census.sources().count(), 3);
    assert!(census.tallies().all(|(_, tally)| tally.count == 1));
}

#[test]
fn the_last_frame_is_kept_whole() {
    let mut census = Census::default();
    let beat = bytes(4, &ground_station_heartbeat());
    census.note(IN, &beat, true, Duration::ZERO);
    assert_eq!(only(&census).last, beat);
}

#[test]
fn kinds_that_noise_invents_are_bounded_and_those_left_out_are_counted() {
    let mut census = Census::default();
    for id in 0..1000u16 {
        let [low, high] = id.to_le_bytes();
        let frame = [0xFD, 0, 0, 0, 0, 9, 1, low, high, 0xFE, 1, 2];
        census.note(IN, &frame, false, Duration::ZERO);
    }
    assert_eq!(census.tallies().count(), MOST_UNVERIFIED);
    assert_eq!(census.uncounted(), 1000 - MOST_UNVERIFIED as u64);
    assert_eq!(census.sources().count(), 0, "noise makes no sender known");
    census.note(IN, &attitude(1), true, Duration::ZERO);
    assert_eq!(census.sources().count(), 1, "real ones still have room");
    let later = STALE + Duration::from_secs(1);
    census.note(
        IN,
        &[0xFD, 0, 0, 0, 0, 9, 1, 1, 2, 0xFF, 1, 2],
        false,
        later,
    );
    assert_eq!(census.tallies().count(), 1, "what was silent made room");
}

#[test]
fn every_frame_of_a_watched_kind_is_kept_until_it_is_taken_and_no_more_than_there_is_room_for() {
    let mut census = Census::default();
    census.note(IN, &attitude(1), true, Duration::ZERO);
    let (key, _) = census.tallies().next().expect("one");
    census.watch(&BTreeSet::from([key]));
    for count in 0..700 {
        census.note(IN, &attitude(1), true, Duration::from_millis(count));
        census.note(IN, &attitude(2), true, Duration::from_millis(count));
    }
    let taken = census.take_watched();
    assert_eq!(taken.len(), 1);
    assert_eq!((taken[0].key, taken[0].frames.len()), (key, MOST_WATCHED));
    assert_eq!(taken[0].dropped, 700 - MOST_WATCHED as u64);
    assert_eq!(
        taken[0].frames.back().expect("one").0,
        Duration::from_millis(699)
    );
    assert_eq!(census.take_watched(), []);
    census.watch(&BTreeSet::new());
    census.note(IN, &attitude(1), true, Duration::ZERO);
    assert_eq!(census.take_watched(), []);
}

#[test]
fn only_answers_show_that_we_are_heard() {
    let mut census = Census::default();
    let sync = |tc1| {
        MavMessage::TIMESYNC(TIMESYNC_DATA {
            tc1,
            ts1: 7,
            ..TIMESYNC_DATA::default()
        })
    };
    let second = Duration::from_secs;
    let note = |census: &mut Census, message: MavMessage, at| {
        census.note(IN, &bytes(1, &message.into()), true, second(at));
        let source = census.sources().next().expect("one");
        census.answered_at(source)
    };
    assert_eq!(note(&mut census, sync(0), 1), None, "a question");
    assert_eq!(note(&mut census, sync(5), 2), Some(second(2)));
    assert_eq!(note(&mut census, sync(0), 3), Some(second(2)));
    let beat = MavMessage::HEARTBEAT(mavlink::dialects::ardupilotmega::HEARTBEAT_DATA::default());
    assert_eq!(note(&mut census, beat, 4), Some(second(2)));
    let ack =
        MavMessage::COMMAND_ACK(mavlink::dialects::ardupilotmega::COMMAND_ACK_DATA::default());
    assert_eq!(note(&mut census, ack, 5), Some(second(5)));
}

proptest! {
    #[test]
    fn a_steady_message_has_its_rate_after_a_few_seconds_and_none_soon_after_it_stops(
        hz in 1u32..200,
        start_ms in 0u64..5000,
    ) {
        let mut census = Census::default();
        let start = Duration::from_millis(start_ms);
        let frame = attitude(1);
        for count in 0..hz * 8 {
            let at = start + Duration::from_secs_f64(f64::from(count) / f64::from(hz));
            census.note(IN, &frame, true, at);
        }
        let tally = only(&census);
        let end = start + Duration::from_secs(8);
        let rate = tally.rate(end);
        prop_assert!((rate.hz - f64::from(hz)).abs() <= 0.21, "{} at {hz} Hz", rate.hz);
        prop_assert!((rate.bytes_s - rate.hz * frame.len() as f64).abs() < 1e-6);
        let late = tally.rate(start + Duration::from_secs(16));
        prop_assert!(late.hz < 0.01);
    }

    #[test]
    fn a_message_that_has_just_begun_is_not_rated_higher_than_it_is(
        hz in 1u32..100,
        start_ms in 0u64..3000,
        age_ms in 0u64..5000,
    ) {
        let mut census = Census::default();
        let start = Duration::from_millis(start_ms);
        let end = start + Duration::from_millis(age_ms);
        for count in 0.. {
            let at = start + Duration::from_secs_f64(f64::from(count) / f64::from(hz));
            if at > end {
                break;
            }
            census.note(IN, &attitude(1), true, at);
        }
        let rate = only(&census).rate(end).hz;
        prop_assert!(rate <= f64::from(hz) + 1.01, "{rate} at {hz} Hz");
    }

    #[test]
    fn no_bytes_upset_the_census(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let mut census = Census::default();
        census.note(IN, &bytes, false, Duration::ZERO);
        census.note_noise(&bytes);
    }
}

#[test]
fn a_reset_begins_new_statistics_once() {
    let second = Duration::from_secs;
    let mut census = Census::default();
    let mut encoder = Encoder::new(1, 1);
    let mut heard = |census: &mut Census, at: u64| {
        let mut beat = Vec::new();
        encoder.encode(&ground_station_heartbeat(), &mut beat);
        census.note(IN, &beat, true, second(at));
    };
    heard(&mut census, 1);
    heard(&mut census, 2);
    census.reset_statistics(1, second(3));
    for at in [5, 6] {
        heard(&mut census, at);
        census.reset_statistics(1, second(at));
    }
    let tally = only(&census);
    assert_eq!((tally.count, tally.statistics.count), (4, 2));
    assert_eq!(tally.statistics.window(second(7)), second(4));
    assert_eq!(tally.statistics.longest_silence(second(6)), second(2));
    let source = census.sources().next().expect("one");
    assert_eq!(census.loss_of(source).map(SenderLoss::lost), Some(0));
    assert_eq!(census.snapshot(), census);
}
