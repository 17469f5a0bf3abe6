use mavlink::dialects::ardupilotmega::{MavMessage, MavSeverity};
use mavlink::types::CharArray;
use proptest::prelude::*;

use super::super::testing::Bench;
use super::*;
use crate::wire::Content;

const CHUNK_LEN: usize = 50;

fn data(id: u16, chunk_seq: u8, bytes: &[u8]) -> STATUSTEXT_DATA {
    let mut text = [0; CHUNK_LEN];
    text[..bytes.len()].copy_from_slice(bytes);
    STATUSTEXT_DATA {
        severity: MavSeverity::MAV_SEVERITY_WARNING,
        text: CharArray::new(text),
        id,
        chunk_seq,
    }
}

fn message(id: u16, chunk_seq: u8, text: &str) -> MavMessage {
    MavMessage::STATUSTEXT(data(id, chunk_seq, text.as_bytes()))
}

/// A text split as a sender does it: full chunks, and a shorter one at the end.
fn cut(id: u16, bytes: &[u8]) -> Vec<Chunk> {
    let full = bytes.chunks_exact(CHUNK_LEN);
    let rest = full.remainder();
    full.chain([rest])
        .zip(0..)
        .map(|(piece, sequence)| Chunk::new(1, &data(id, sequence, piece)))
        .collect()
}

fn at(seconds: u64) -> Duration {
    Duration::from_secs(seconds)
}

#[test]
fn a_text_of_two_chunks_is_said_once_and_whole() {
    let mut bench = Bench::new();
    bench.hear(message(
        1,
        0,
        "Mode change to AUTO RTL failed: No return path or ",
    ));
    assert_eq!(bench.said(), Vec::<String>::new());
    bench.hear(message(1, 1, "landing sequence found"));
    let expected = "Mode change to AUTO RTL failed: No return path or landing sequence found";
    assert_eq!(bench.said(), [expected]);
    assert_eq!(bench.vehicle.texts[0].text, expected);
    assert_eq!(bench.vehicle.texts[0].severity, Severity::Warning);
}

#[test]
fn a_lost_chunk_is_marked_after_a_second() {
    let full = "x".repeat(CHUNK_LEN);
    for (chunks, expected) in [
        (vec![(0, full.as_str())], format!("{full}...")),
        (vec![(1, "tail")], "...tail".to_owned()),
        (
            vec![(0, full.as_str()), (2, "tail")],
            format!("{full}...tail"),
        ),
    ] {
        let mut bench = Bench::new();
        for (sequence, text) in chunks {
            bench.hear(message(9, sequence, text));
        }
        bench.poll_after(900);
        assert_eq!(bench.said(), Vec::<String>::new());
        bench.poll_after(100);
        assert_eq!(bench.said(), [expected]);
        bench.poll_after(5000);
        assert_eq!(bench.said(), Vec::<String>::new());
    }
}

#[test]
fn an_id_that_is_used_again_does_not_mix_two_texts() {
    let (first, second) = ("a".repeat(CHUNK_LEN), "b".repeat(CHUNK_LEN));
    let mut bench = Bench::new();
    bench.hear(message(3, 0, &first));
    bench.hear(message(3, 0, &second));
    bench.hear(message(3, 1, "end"));
    assert_eq!(
        bench.said(),
        [format!("{first}..."), format!("{second}end")]
    );
}

#[test]
fn texts_of_other_components_are_heard_and_cleaned() {
    let mut bench = Bench::new();
    bench.hear_from(154, Content::Message(message(0, 0, "gimbal \u{1b}[31mhot")));
    assert_eq!(bench.said(), ["gimbal ?[31mhot"]);
}

#[test]
fn reasons_that_come_together_replace_those_before() {
    let mut bench = Bench::new();
    bench.hear(message(0, 0, "PreArm: Need Alt Estimate"));
    bench.hear(message(0, 0, "PreArm: Gyros not healthy"));
    bench.hear(message(0, 0, "PreArm: Gyros not healthy"));
    assert_eq!(
        bench.vehicle.prearm,
        ["Need Alt Estimate", "Gyros not healthy"]
    );
    bench.hear_after(30_000, message(0, 0, "Arm: Need Position Estimate"));
    assert_eq!(bench.vehicle.prearm, ["Need Position Estimate"]);
}

#[test]
fn only_the_last_texts_are_kept() {
    let mut bench = Bench::new();
    for number in 0..TEXTS_KEPT + 5 {
        bench.hear(message(0, 0, &format!("text {number}")));
    }
    assert_eq!(bench.vehicle.texts.len(), TEXTS_KEPT);
    assert_eq!(bench.vehicle.texts[0].text, "text 5");
}

#[test]
fn many_half_texts_take_no_more_than_a_few_places() {
    let mut assembly = Assembly::default();
    let mut out = 0;
    for id in 1..=1000 {
        out += assembly
            .accept(Chunk::new(1, &data(id, 7, b"x")), at(1))
            .len();
    }
    assert_eq!(out, 1000 - MOST_UNFINISHED);
}

proptest! {
    #[test]
    fn any_text_joins_again_in_any_order_and_with_repeats(
        text in "[^\\x00]{1,400}",
        order in prop::collection::vec(any::<u32>(), 40),
        repeat in 0usize..40,
    ) {
        let mut chunks = cut(5, text.as_bytes());
        let mut keys = order.into_iter();
        chunks.sort_by_cached_key(|_| keys.next());
        // All chunks except the last may arrive twice; after the last one the text is complete and removed.
        if repeat + 1 < chunks.len() {
            chunks.insert(repeat, chunks[repeat].clone());
        }
        let mut assembly = Assembly::default();
        let out: Vec<Joined> = chunks.into_iter().flat_map(|chunk| assembly.accept(chunk, at(1))).collect();
        prop_assert_eq!(out, [Joined { severity: Severity::Warning, text }]);
        prop_assert_eq!(assembly.expire(at(9)), []);
    }

    #[test]
    fn a_lost_chunk_never_holds_a_text_back_for_longer_than_a_second(
        text in "[a-z]{51,400}",
        lost in any::<prop::sample::Index>(),
    ) {
        let mut chunks = cut(5, text.as_bytes());
        let gone = chunks.remove(lost.index(chunks.len()));
        let mut assembly = Assembly::default();
        for chunk in chunks {
            prop_assert_eq!(assembly.accept(chunk, at(1)), []);
        }
        let start = usize::from(gone.sequence) * CHUNK_LEN;
        let expected = format!("{}...{}", &text[..start], &text[start + gone.bytes.len()..]);
        let out = assembly.expire(at(2));
        prop_assert_eq!(&out[0].text, &expected);
        prop_assert_eq!(out.len(), 1);
        prop_assert_eq!(assembly.expire(at(9)), []);
    }

    #[test]
    fn any_chunks_at_all_come_out_within_a_second(
        pieces in prop::collection::vec((1u16..4, any::<u8>(), "[a-z]{1,50}"), 0..60),
    ) {
        let mut assembly = Assembly::default();
        for (id, sequence, text) in pieces {
            assembly.accept(Chunk::new(1, &data(id, sequence, text.as_bytes())), at(1));
            prop_assert!(assembly.unfinished.len() <= MOST_UNFINISHED);
        }
        assembly.expire(at(2));
        prop_assert!(assembly.unfinished.is_empty());
    }
}
