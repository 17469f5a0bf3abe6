//! Losses, delays and rates of a radio under test.

use super::*;
use crate::vehicle::RadioPreset;
use crate::wire::{AUTOPILOT_COMPONENT, Decoder, ground_station_heartbeat};

fn frame() -> Frame {
    let mut bytes = Vec::new();
    Encoder::new(1, AUTOPILOT_COMPONENT).encode(&ground_station_heartbeat(), &mut bytes);
    let mut decoder = Decoder::new();
    decoder.push(&bytes);
    decoder.next_frame().expect("a whole frame")
}

fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

/// The times in milliseconds at which frames sent every `every_ms` arrive.
fn arrivals(test: RadioTest, count: u64, every_ms: u64) -> Vec<(u64, u64)> {
    let mut bench = Bench::new();
    bench.set(Some(test), 1, Duration::ZERO);
    let heard = frame();
    let mut arrived = Vec::new();
    for now in 0..count * every_ms + 20_000 {
        if now % every_ms == 0 && now / every_ms < count {
            bench.hear(&heard, ms(now));
        }
        while bench.arrived(ms(now)).is_some() {
            arrived.push((arrived.len() as u64, now));
        }
    }
    assert!(bench.inbound.queue.is_empty());
    arrived
}

#[test]
fn a_preset_loses_and_delays_as_much_as_it_says() {
    let edge = RadioPreset::Edge.test();
    let arrived = arrivals(edge, 10_000, 10);
    assert!(
        (9_400..=9_600).contains(&arrived.len()),
        "{}",
        arrived.len()
    );
    assert_eq!(arrived[0].1 % 10, 0, "80 ms and no jitter");
    let satellite = arrivals(RadioPreset::Satellite.test(), 5, 100);
    let times: Vec<u64> = satellite.iter().map(|(_, at)| *at).collect();
    assert_eq!(times, [600, 700, 800, 900, 1000]);
}

#[test]
fn jitter_spreads_the_delays_and_keeps_the_order() {
    let test = RadioTest {
        delay: ms(200),
        jitter: ms(100),
        ..RadioTest::default()
    };
    let late: Vec<u64> = arrivals(test, 500, 200)
        .into_iter()
        .map(|(index, at)| at - index * 200)
        .collect();
    let (least, most) = (
        late.iter().min().expect("some"),
        late.iter().max().expect("some"),
    );
    assert!(
        (200..215).contains(least) && (285..=300).contains(most),
        "{least} to {most}"
    );
    // Denser than the jitter, none overtakes another.
    assert_eq!(arrivals(test, 500, 1).len(), 500);
}

#[test]
fn a_slow_radio_passes_its_rate_and_drops_what_waits_too_long() {
    let narrow = RadioPreset::Narrow.test();
    let len = u64::from(frame().wire_len);
    // 2100 bytes per second are sent to a radio of 1200.
    let arrived = arrivals(narrow, 2_000, 10);
    let within: u64 = arrived
        .iter()
        .filter(|(_, at)| (10_000..20_000).contains(at))
        .count() as u64;
    assert!(
        (11_900..=12_100).contains(&(within * len)),
        "{} bytes in 10 s",
        within * len
    );
    assert!(arrived.len() < 2_000, "some were dropped");
    let longest = arrived.last().expect("some").1;
    assert!(longest < 20_000 + 5_100, "{longest}");
}

#[test]
fn the_same_seed_gives_the_same_losses_to_each_vehicle_and_others_to_another() {
    let run = |vehicle: VehicleId, seed: u64| {
        let mut bench = Bench::new();
        let test = RadioTest {
            loss: 0.5,
            seed,
            ..RadioTest::default()
        };
        bench.set(Some(test), vehicle, Duration::ZERO);
        let passes = |now| {
            bench.hear(&frame(), ms(now));
            bench.arrived(ms(now)).is_some()
        };
        (0..200).map(passes).collect::<Vec<bool>>()
    };
    assert_eq!(run(1, 3), run(1, 3));
    assert_ne!(run(1, 3), run(2, 3));
    assert_ne!(run(1, 3), run(1, 4));
}

#[test]
fn messages_to_the_vehicle_are_impaired_and_counted_as_well() {
    let mut bench = Bench::new();
    bench.set(Some(RadioPreset::Satellite.test()), 1, ms(0));
    let say = |bench: &mut Bench, now| bench.say(vec![ground_station_heartbeat()], ms(now)).len();
    assert_eq!([say(&mut bench, 0), say(&mut bench, 600)], [0, 1]);
    let tested = bench.tested(ms(2_000)).expect("a test");
    assert_eq!((tested.sent.passed, tested.sent.bytes), (1, 21));
    assert_eq!(tested.lasts, ms(2_000));
}

#[test]
fn at_the_end_of_a_test_everything_in_transit_arrives_at_once() {
    let mut bench = Bench::new();
    bench.set(Some(RadioPreset::Satellite.test()), 1, ms(0));
    bench.hear(&frame(), ms(0));
    assert!(bench.arrived(ms(1)).is_none());
    bench.set(None, 1, ms(1));
    assert!(!bench.is_clear());
    assert!(bench.arrived(ms(1)).is_some());
    assert!(bench.is_clear() && bench.tested(ms(1)).is_none());
}
