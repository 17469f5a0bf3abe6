//! Tests of the findings about signatures.

use std::collections::BTreeSet;

use super::*;
use crate::inspector::Direction;
use crate::vehicle_id::VehicleId;
use crate::wire::Seal;

/// The chart of a link on which vehicle 3 is heard with these signatures, every second for the window.
fn chart(seals: &[Seal], keyed: &[SystemId], is_signing_required: bool) -> Chart {
    let mut chart = Chart::new(Way::Udp);
    let mut frames = NumberedFrames::default();
    for second in 0..=WINDOW.as_secs() {
        for seal in seals {
            frames.came += 1;
            frames.seals.note(*seal);
        }
        let sender = Sender {
            source: FrameSource {
                direction: Direction::In,
                peer: 0,
                system: 3,
                component: 1,
            },
            role: HeartbeatRole::Autopilot,
            known_for: Duration::from_secs(60),
            heartbeat_hz: 1.0,
            signed: seals.iter().any(|seal| seal.is_signature()),
            version1: false,
            answered_ago: Some(Duration::ZERO),
            asked: 10,
            board: None,
        };
        let observation = Observation {
            up: true,
            counters: Counters::default(),
            numbered: [((3, 1), frames)].into(),
            senders: vec![sender],
            noise: Vec::new(),
            peers: BTreeMap::new(),
            keyed: keyed.to_vec(),
            is_signing_required,
        };
        chart.note(observation, Duration::from_secs(second));
    }
    chart
}

fn causes(chart: Chart) -> Vec<Cause> {
    let findings = diagnose(&[chart], &BTreeSet::new()).into_iter();
    findings.map(|finding| finding.cause).collect()
}

#[test]
fn signatures_that_are_missing_wrong_or_old_are_named() {
    let late = Seal::Old(1_250_000);
    for (seals, keyed, expected) in [
        (&[Seal::Right][..], &[3][..], vec![Cause::Well(1)]),
        (
            &[Seal::Right, Seal::Unsigned],
            &[3],
            vec![Cause::Unsigned(3)],
        ),
        (
            &[Seal::Right, Seal::Foreign],
            &[3],
            vec![Cause::WrongKey(3)],
        ),
        (&[Seal::Right, late], &[3], vec![Cause::OldStamps(3, 12)]),
        (&[Seal::Foreign], &[3], vec![Cause::WrongKey(3)]),
        (&[Seal::Foreign], &[], vec![Cause::SignedButAnswers(3)]),
        (&[Seal::Unsigned], &[], vec![Cause::Well(1)]),
        // Datagrams that overtook each other.
        (&[Seal::Right, Seal::Old(300)], &[3], vec![Cause::Well(1)]),
    ] {
        assert_eq!(causes(chart(seals, keyed, false)), expected, "{seals:?}");
    }
    let required = chart(&[Seal::Unsigned], &[], true);
    assert_eq!(causes(required), [Cause::Unsigned(3)]);
}

#[test]
fn frames_from_before_a_key_are_not_a_fault() {
    let mut chart = chart(&[Seal::Unsigned], &[], false);
    let mut last = chart.last().expect("noted").clone();
    last.keyed = vec![3];
    last.numbered
        .values_mut()
        .for_each(|frames| frames.seals.note(Seal::Right));
    chart.note(last, WINDOW + Duration::from_secs(1));
    assert_eq!(causes(chart), [Cause::Well(1)]);
}

/// The same chart, with this change to each of its senders.
fn altered(mut chart: Chart, alter: impl Fn(&mut Sender)) -> Chart {
    for (_, observation) in &mut chart.seen {
        observation.senders.iter_mut().for_each(&alter);
    }
    chart
}

#[test]
fn a_vehicle_with_another_key_that_does_not_answer_has_one_cause() {
    let silent = |seals: &[Seal]| {
        altered(chart(seals, &[3], false), |sender| {
            sender.answered_ago = None;
        })
    };
    assert_eq!(causes(silent(&[Seal::Foreign])), [Cause::WrongKey(3)]);
    // A forged frame does not hide that the vehicle itself does not answer.
    assert_eq!(
        causes(silent(&[Seal::Right, Seal::Foreign])),
        [Cause::OneWay(3), Cause::WrongKey(3)]
    );
}

#[test]
fn one_board_on_two_links_is_one_vehicle() {
    let on_board = |number: u64| {
        let board = BoardId::of(number, &[0; 18]);
        altered(chart(&[Seal::Unsigned], &[], false), |sender| {
            sender.board = board;
        })
    };
    let said = |boards: [u64; 2]| {
        let findings = diagnose(&boards.map(on_board), &BTreeSet::new());
        let said = findings
            .iter()
            .map(|it| (it.cause.clone(), it.boards.len()));
        said.collect::<Vec<_>>()
    };
    assert_eq!(said([7, 7]), vec![(Cause::HeardTwice(3), 2); 2]);
    assert_eq!(said([7, 8]), vec![(Cause::DuplicateSystem(3), 2); 2]);
    assert_eq!(said([0, 0]), vec![(Cause::DuplicateSystem(3), 2); 2]);
}

#[test]
fn expected_vehicles_that_were_never_heard_are_named() {
    let said = |expected: &[VehicleId]| {
        let link = chart(&[Seal::Unsigned], &[], false);
        let findings = diagnose(&[link], &expected.iter().copied().collect());
        let said = findings.iter().map(|it| it.says().to_string());
        said.collect::<Vec<_>>()
    };
    assert_eq!(said(&[2, 3, 4]), ["expected, but never heard: 2,4"]);
    assert_eq!(
        said(&[1, 2, 4]),
        ["expected, but never heard: 1-2,4; heard, but not expected: 3"]
    );
    for fine in [&[3][..], &[]] {
        assert_eq!(
            said(fine),
            ["all is well: 1 vehicle is in contact and answers"]
        );
    }
}

#[test]
fn a_vehicle_with_system_id_0_is_named() {
    let zero = altered(chart(&[Seal::Unsigned], &[], false), |sender| {
        sender.source.system = 0;
    });
    assert_eq!(causes(zero), [Cause::SystemZero]);
}
