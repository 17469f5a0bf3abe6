//! Signing, in the order of the trials with the real vehicle.

use mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, HEARTBEAT_DATA, MavCmd, MavMessage, RADIO_STATUS_DATA, SETUP_SIGNING_DATA,
};

use super::*;
use sortie_wire::{Content, Decoder, Encoder, Outgoing, SigningKey, Stamp, is_signed_with};

const KEY: SigningKey = [7; 32];
const SECOND: u64 = 100_000;
/// The timestamp at the beginning of a test.
const NOW: u64 = 37_512_928_000_000;

struct Bench {
    world: World,
    encoder: Encoder,
}

impl Bench {
    fn new() -> Self {
        let mut world = World::new(&WorldConfig::row(1, start()));
        for _ in 0..200 {
            world.step();
        }
        Self {
            world,
            encoder: Encoder::new(255, 190),
        }
    }

    /// A vehicle with the key set at [`NOW`].
    fn signing() -> Self {
        let mut bench = Self::new();
        let port = bench.world.connect(0);
        bench.tell(port, &setup(KEY, NOW), None);
        bench.world.disconnect(port);
        bench
    }

    fn tell(&mut self, port: PortId, message: &MavMessage, seal: Option<(SigningKey, u8, u64)>) {
        if let Some((key, link, timestamp)) = seal {
            self.encoder.sign_next(&key, Stamp { link, timestamp });
        }
        let mut bytes = Vec::new();
        self.encoder.encode_message(message, &mut bytes);
        self.world.receive(port, &bytes);
    }

    /// The frames that wait on a port, as bytes.
    fn take(&mut self, port: PortId) -> Vec<Vec<u8>> {
        let (mut bytes, mut decoder) = (Vec::new(), Decoder::new());
        self.world.take_output(port, &mut bytes);
        decoder.push(&bytes);
        let mut frames = Vec::new();
        while let Some(frame) = decoder.next_frame() {
            frames.push(decoder.bytes_of(&frame).to_vec());
        }
        frames
    }

    /// Whether a request on that port is answered.
    fn asks(&mut self, port: PortId, seal: Option<(SigningKey, u8, u64)>) -> bool {
        self.take(port);
        let request = MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            command: MavCmd::MAV_CMD_REQUEST_MESSAGE,
            param1: 148.0,
            target_system: 1,
            ..Default::default()
        });
        self.tell(port, &request, seal);
        !self.take(port).is_empty()
    }
}

fn setup(secret_key: SigningKey, initial_timestamp: u64) -> MavMessage {
    MavMessage::SETUP_SIGNING(SETUP_SIGNING_DATA {
        initial_timestamp,
        target_system: 1,
        target_component: 1,
        secret_key,
    })
}

#[test]
fn without_a_key_signatures_do_not_matter() {
    let mut bench = Bench::new();
    for serial in Serial::ALL {
        let port = bench.world.connect_to(0, serial);
        assert!(bench.asks(port, None) && bench.asks(port, Some((KEY, 1, NOW))));
    }
}

#[test]
fn everything_that_goes_out_is_signed_with_the_port_as_link() {
    let mut bench = Bench::signing();
    for serial in Serial::ALL {
        let port = bench.world.connect_to(0, serial);
        for _ in 0..400 {
            bench.world.step();
        }
        let frames = bench.take(port);
        assert!(frames.len() >= 4);
        let heartbeat = frames.iter().find(|frame| frame[7] == 0).expect("beats");
        assert_eq!(heartbeat.len(), 34);
        for (count, frame) in frames.iter().enumerate() {
            let stamp = Stamp::of(frame).expect("signed");
            assert!(is_signed_with(&KEY, frame));
            assert_eq!(usize::from(stamp.link), serial.index());
            assert_eq!(stamp.timestamp, NOW + 60 * SECOND + count as u64);
        }
    }
}

#[test]
fn serial_0_accepts_everything_and_the_others_only_what_is_signed_rightly() {
    let mut bench = Bench::signing();
    let cable = bench.world.connect(0);
    let radio = bench.world.connect_to(0, Serial::One);
    let wrong = [9; 32];
    let later = NOW + 70 * SECOND;
    for (seal, on_radio) in [
        (None, false),
        (Some((KEY, 2, later)), true),
        (Some((KEY, 2, later)), false),
        (Some((KEY, 2, later + 1)), true),
        (Some((wrong, 2, later + 2)), false),
        (Some((KEY, 2, later - 30 * SECOND)), false),
        // A new link that is more than a minute behind the vehicle's clock.
        (Some((KEY, 50, later - 61 * SECOND)), false),
        (Some((KEY, 50, later - 30 * SECOND)), true),
        // A timestamp an hour ahead is accepted and moves the vehicle's clock, so new senders with
        // the current time are refused.
        (Some((KEY, 52, later + 3600 * SECOND)), true),
        (Some((KEY, 2, later + 3)), true),
        (Some((KEY, 53, later + 4)), false),
        (Some((KEY, 54, later + 3600 * SECOND)), true),
    ] {
        assert_eq!(bench.asks(radio, seal), on_radio, "{seal:?}");
        assert!(bench.asks(cable, seal), "{seal:?} on serial 0");
    }
}

#[test]
fn the_table_of_senders_is_shared_by_the_ports_and_has_room_for_16() {
    let mut bench = Bench::signing();
    let [zero, one, two] = Serial::ALL.map(|serial| bench.world.connect_to(0, serial));
    let later = NOW + 100 * SECOND;
    assert!(bench.asks(zero, Some((KEY, 1, later + 9))));
    assert!(!bench.asks(one, Some((KEY, 1, later))), "behind another");
    for link in 2..=16 {
        assert!(bench.asks(one, Some((KEY, link, later))), "{link}");
    }
    assert!(!bench.asks(two, Some((KEY, 17, later))));
    assert!(bench.asks(two, Some((KEY, 16, later + 1))));
}

#[test]
fn a_key_of_zeros_ends_signing() {
    let mut bench = Bench::signing();
    let radio = bench.world.connect_to(0, Serial::Two);
    bench.tell(radio, &setup([0; 32], 0), None);
    assert!(
        !bench.asks(radio, None),
        "an unsigned key is not taken over"
    );
    let later = NOW + 99 * SECOND;
    bench.tell(radio, &setup([0; 32], 0), Some((KEY, 3, later)));
    assert!(bench.asks(radio, None));
    for _ in 0..200 {
        bench.world.step();
    }
    let frames = bench.take(radio);
    assert!(frames.iter().all(|frame| frame[2] == 0) && !frames.is_empty());
}

#[test]
fn modems_open_a_port_without_a_signature_and_others_do_not() {
    let mut bench = Bench::signing();
    let cable = bench.world.connect(0);
    let radio = bench.world.connect_to(0, Serial::Two);
    let banner = MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        command: MavCmd::MAV_CMD_DO_SEND_BANNER,
        target_system: 1,
        ..Default::default()
    });
    for (message, texts) in [
        (MavMessage::HEARTBEAT(HEARTBEAT_DATA::default()), 0),
        (MavMessage::RADIO_STATUS(RADIO_STATUS_DATA::default()), 3),
    ] {
        bench.take(radio);
        bench.tell(radio, &message, None);
        bench.tell(cable, &banner, None);
        let frames = bench.take(radio);
        let heard = frames.iter().filter(|frame| frame[7] == 253).count();
        assert_eq!(heard, texts, "{message:?}");
    }
}

#[test]
fn the_key_and_the_time_survive_a_reboot_and_the_senders_do_not() {
    let mut bench = Bench::signing();
    let port = bench.world.connect(0);
    let later = NOW + 100 * SECOND;
    assert!(bench.asks(port, Some((KEY, 1, later))));
    let reboot = MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        command: MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN,
        param1: 1.0,
        target_system: 1,
        ..Default::default()
    });
    bench.tell(port, &reboot, None);
    for _ in 0..30 {
        bench.world.step();
    }
    assert!(!bench.world.is_open(port));
    let port = bench.world.connect_to(0, Serial::One);
    assert!(!bench.asks(port, None));
    assert!(
        !bench.asks(port, Some((KEY, 1, later - SECOND))),
        "replayed"
    );
    assert!(bench.asks(port, Some((KEY, 1, later + SECOND))));
}

#[test]
fn a_strict_vehicle_refuses_unsigned_packets_on_serial_0_too() {
    let mut bench = Bench::new();
    bench.world.require_signatures();
    let port = bench.world.connect(0);
    assert!(bench.asks(port, None), "there is no key yet");
    bench.tell(port, &setup(KEY, NOW), None);
    assert!(!bench.asks(port, None));
    assert!(!bench.asks(port, Some(([1; 32], 1, NOW + 90 * SECOND))));
    assert!(bench.asks(port, Some((KEY, 1, NOW + 90 * SECOND))));
    assert!(!bench.asks(port, Some((KEY, 1, NOW + 90 * SECOND))));
}

#[test]
fn keys_are_not_taken_over_while_armed_or_for_others() {
    let mut ground = Ground::armed();
    ground.say(setup(KEY, NOW));
    assert!(
        ground
            .texts()
            .contains(&"ERROR: Won't setup signing when armed".to_owned())
    );
    let foreign = MavMessage::SETUP_SIGNING(SETUP_SIGNING_DATA {
        target_system: 9,
        secret_key: KEY,
        ..Default::default()
    });
    let mut parked = Ground::new();
    parked.run(1.0);
    parked.say(foreign);
    for ground in [&mut ground, &mut parked] {
        let before = ground.heard.len();
        ground.run(2.0);
        assert!(
            ground.heard[before..]
                .iter()
                .all(|frame| !frame.seal.is_signature())
        );
    }
    let broadcast = MavMessage::SETUP_SIGNING(SETUP_SIGNING_DATA {
        secret_key: KEY,
        ..Default::default()
    });
    parked.send(&Outgoing::Message(broadcast));
    let before = parked.heard.len();
    parked.run(2.0);
    let signed = &parked.heard[before..];
    assert!(signed.iter().all(|frame| frame.seal.is_signature()) && !signed.is_empty());
    assert!(matches!(signed[0].content, Content::Message(_)));
}
