//! Tests of the routes of frames, and of the texts of forwards. Tests of the stations' commands are
//! in `tests/watched.rs`.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, COMMAND_LONG_DATA, HEARTBEAT_DATA, MavCmd, MavMessage, MavResult,
    STATUSTEXT_DATA,
};

use super::*;
use crate::wire::{Decoder, Encoder, Frame, MavAddress, Outgoing};

mod loops;
mod watched;

const OWN: MavAddress = address(255, 190);
const VEHICLE: Port = Port::Vehicle { link: 0, peer: 0 };
const STATION: Port = Port::Station {
    forward: 0,
    peer: 4,
};
const OTHER: Port = Port::Station {
    forward: 1,
    peer: 0,
};

const fn address(system: u8, component: u8) -> MavAddress {
    MavAddress { system, component }
}

fn ms(ms: u64) -> Duration {
    Duration::from_millis(ms)
}

fn beat() -> Outgoing {
    MavMessage::HEARTBEAT(HEARTBEAT_DATA::default()).into()
}

fn command(system: u8, command: MavCmd, param1: f32, param2: f32) -> Outgoing {
    MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        target_system: system,
        target_component: 1,
        command,
        param1,
        param2,
        ..COMMAND_LONG_DATA::default()
    })
    .into()
}

fn ack(to: MavAddress, command: MavCmd) -> Outgoing {
    MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
        command,
        result: MavResult::MAV_RESULT_ACCEPTED,
        target_system: to.system,
        target_component: to.component,
        ..COMMAND_ACK_DATA::default()
    })
    .into()
}

fn framed(sender: MavAddress, outgoing: &Outgoing) -> (Vec<u8>, Frame) {
    numbered(sender, outgoing, 0)
}

/// A frame with a sequence number.
fn numbered(sender: MavAddress, outgoing: &Outgoing, sequence: u8) -> (Vec<u8>, Frame) {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(sender.system, sender.component);
    for _ in 0..=sequence {
        bytes.clear();
        encoder.encode(outgoing, &mut bytes);
    }
    let mut decoder = Decoder::new();
    decoder.push(&bytes);
    let frame = decoder.next_frame().expect("a frame");
    (bytes, frame)
}

/// A router that has heard vehicle 3, and stations 254 and 253 on their forwards.
fn learned() -> Router {
    let mut router = Router::new(OWN);
    for (from, sender) in [
        (VEHICLE, address(3, 1)),
        (STATION, address(254, 1)),
        (OTHER, address(253, 1)),
    ] {
        way(&mut router, from, sender, &beat(), 0);
    }
    router
}

/// The route of a message at a time; a sender numbers its frames by their times.
fn way(router: &mut Router, from: Port, sender: MavAddress, what: &Outgoing, at: u64) -> Route {
    let (bytes, frame) = numbered(sender, what, (at / 50) as u8);
    let facts = FrameFacts::of(&frame, &bytes).expect("facts");
    router.route(from, &facts, ms(at))
}

fn to(vehicles: Reach, stations: Reach) -> Route {
    Route::To { vehicles, stations }
}

#[test]
fn a_message_for_all_goes_to_all_and_one_for_a_receiver_to_where_that_was_heard() {
    let mut router = learned();
    let arm = |system| command(system, MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, 1.0, 0.0);
    let station = address(254, 1);
    let cases = [
        (
            VEHICLE,
            address(3, 1),
            beat(),
            to(Reach::Nobody, Reach::Everyone),
        ),
        (
            STATION,
            station,
            beat(),
            to(Reach::Everyone, Reach::Everyone),
        ),
        (
            STATION,
            station,
            arm(3),
            to(Reach::These(vec![VEHICLE]), Reach::Nobody),
        ),
        (
            STATION,
            station,
            arm(0),
            to(Reach::Everyone, Reach::Everyone),
        ),
        (STATION, station, arm(9), Route::Unknown),
        (STATION, station, arm(255), to(Reach::Nobody, Reach::Nobody)),
        (
            STATION,
            station,
            arm(253),
            to(Reach::Nobody, Reach::These(vec![OTHER])),
        ),
    ];
    for (number, (from, sender, what, expected)) in cases.into_iter().enumerate() {
        let at = 2000 * (number as u64 + 1);
        assert_eq!(
            way(&mut router, from, sender, &what, at),
            expected,
            "case {number}"
        );
    }
    let answers = [
        (address(254, 1), Reach::These(vec![STATION])),
        // The answer to a component that was not heard goes to the station that was heard with its
        // system id.
        (address(253, 7), Reach::These(vec![OTHER])),
        (OWN, Reach::Nobody),
    ];
    for (receiver, stations) in answers {
        let answer = ack(receiver, MavCmd::MAV_CMD_NAV_TAKEOFF);
        let found = way(&mut router, VEHICLE, address(3, 1), &answer, 20_000);
        assert_eq!(found, to(Reach::Nobody, stations), "{receiver:?}");
    }
}

#[test]
fn a_command_that_the_dialect_has_no_name_for_finds_its_receiver() {
    let mut router = learned();
    let mut payload = vec![0; 33];
    payload[28..30].copy_from_slice(&65_000_u16.to_le_bytes());
    (payload[30], payload[31]) = (3, 1);
    let unnamed = Outgoing::Raw { id: 76, payload };
    let (_, frame) = framed(address(254, 1), &unnamed);
    assert!(matches!(
        frame.content,
        crate::wire::Content::Undecoded { .. }
    ));
    let found = way(&mut router, STATION, address(254, 1), &unnamed, 5000);
    assert_eq!(found, to(Reach::These(vec![VEHICLE]), Reach::Nobody));
    assert_eq!(
        deed_of(&frame.content),
        Some(Deed::Command(NamedCommand {
            number: 65_000,
            name: "65000".to_owned()
        }))
    );
}

#[test]
fn what_comes_back_on_another_way_is_not_passed_on_again() {
    let mut router = learned();
    let vehicle = address(3, 1);
    let text: Outgoing = MavMessage::STATUSTEXT(STATUSTEXT_DATA::default()).into();
    let passed = to(Reach::Nobody, Reach::Everyone);
    assert_eq!(way(&mut router, VEHICLE, vehicle, &text, 5000), passed);
    assert_eq!(
        way(&mut router, STATION, vehicle, &text, 5001),
        Route::Repeated
    );
    assert_eq!(
        way(&mut router, OTHER, vehicle, &text, 5900),
        Route::Repeated
    );
    // The vehicle itself may send the same text twice.
    assert_eq!(way(&mut router, VEHICLE, vehicle, &text, 5950), passed);
    // An echo does not change the known route to the vehicle.
    let arm = command(3, MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, 1.0, 0.0);
    let found = way(&mut router, OTHER, address(253, 1), &arm, 6000);
    assert_eq!(found, to(Reach::These(vec![VEHICLE]), Reach::Nobody));
    // The console's own message, renumbered on its way back.
    let (bytes, _) = framed(OWN, &arm);
    router.note_own(&bytes, ms(8000));
    let mut encoder = Encoder::new(OWN.system, OWN.component);
    let mut echo = Vec::new();
    encoder.encode(&beat(), &mut echo);
    echo.clear();
    encoder.encode(&arm, &mut echo);
    let mut decoder = Decoder::new();
    decoder.push(&echo);
    let frame = decoder.next_frame().expect("a frame");
    let facts = FrameFacts::of(&frame, &echo).expect("facts");
    assert_eq!(router.route(OTHER, &facts, ms(8100)), Route::Repeated);
    assert_ne!(router.route(OTHER, &facts, ms(9100)), Route::Repeated);
}

#[test]
fn an_own_frame_that_comes_back_is_told_from_those_of_a_station_with_the_same_address() {
    let mut router = learned();
    let heartbeat = |skipped: usize| {
        let mut encoder = Encoder::new(OWN.system, OWN.component);
        let mut bytes = Vec::new();
        for _ in 0..=skipped {
            bytes.clear();
            encoder.encode(&beat(), &mut bytes);
        }
        let mut decoder = Decoder::new();
        decoder.push(&bytes);
        let frame = decoder.next_frame().expect("a frame");
        let facts = FrameFacts::of(&frame, &bytes).expect("facts");
        (bytes, facts)
    };
    let (sent, own) = heartbeat(0);
    router.note_own(&sent, ms(8000));
    assert_eq!(router.route(OTHER, &own, ms(8100)), Route::Returned);
    let (_, other) = heartbeat(5);
    assert_eq!(router.route(OTHER, &other, ms(8100)), Route::Repeated);
}

#[test]
fn forged_senders_fill_no_memory_and_unverified_ones_teach_nothing() {
    let mut router = learned();
    for system in 1..=255 {
        for component in 1..=255 {
            let at = u64::from(component);
            way(&mut router, OTHER, address(system, component), &beat(), at);
        }
    }
    let found = way(
        &mut router,
        OTHER,
        address(253, 1),
        &command(3, MavCmd::MAV_CMD_NAV_LAND, 0.0, 0.0),
        5000,
    );
    assert!(matches!(
        found,
        Route::To {
            vehicles: Reach::These(_),
            ..
        }
    ));
    let mut unknown = framed(address(77, 1), &beat());
    unknown.1.content = crate::wire::Content::Unknown { id: 11_111 };
    let facts = FrameFacts::of(&unknown.1, &unknown.0).expect("facts");
    let mut router = learned();
    router.route(VEHICLE, &facts, ms(5000));
    let land = command(77, MavCmd::MAV_CMD_NAV_LAND, 0.0, 0.0);
    let found = way(&mut router, STATION, address(254, 1), &land, 5100);
    assert_eq!(found, Route::Unknown);
}

#[test]
fn a_forward_reads_as_it_is_written_and_says_what_is_wrong() {
    let written = "tcpin:127.0.0.1:0 read-only only ATTITUDE,GPS_RAW_INT except 30 rate 2";
    let spec: ForwardSpec = written.parse().expect("it is right");
    assert!(spec.read_only);
    assert_eq!(
        (spec.only.as_slice(), spec.except.as_slice()),
        (&[30, 24][..], &[30][..])
    );
    let again: ForwardSpec = spec.to_string().parse().expect("it is right");
    assert_eq!(again, spec);
    let passing = [0, 24, 30, 33].map(|id| spec.passes(id));
    assert_eq!(passing, [true, true, false, false]);
    assert!(spec.is_paced(24) && !spec.is_paced(22) && !spec.is_paced(0));
    for (faulty, words) in [
        ("", "the address is missing"),
        ("udp:a:1 only", "after `only`"),
        ("udp:a:1 only NO_SUCH", "NO_SUCH"),
        ("udp:a:1 rate 0", "`0` is not a rate"),
        ("udp:a:1 rate nan", "`nan` is not a rate"),
        ("udp:a:1 readonly", "`readonly`"),
    ] {
        let fault = faulty.parse::<ForwardSpec>().expect_err(faulty);
        assert!(fault.to_string().contains(words), "{faulty}: {fault}");
    }
}
