//! One test for each diagnosis.

mod senders;

use super::*;
use rand::{Rng as _, SeedableRng as _};

#[tokio::test(start_paused = true)]
async fn nothing_arrives() {
    let (mut patient, _remote) = Patient::listening().await;
    patient.note();
    assert_eq!(patient.causes(), [Cause::Listening], "too early to say");
    for _ in 0..6 {
        patient.second().await;
    }
    assert_eq!(patient.causes(), [Cause::Nothing]);
}

#[tokio::test(start_paused = true)]
async fn a_link_that_is_not_open() {
    let nobody = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = nobody.local_addr().expect("bound").port();
    drop(nobody);
    let address = format!("tcp:127.0.0.1:{port}").parse().expect("an address");
    let mut patient = Patient::over(Transport::Address(address), Way::Tcp);
    patient.until(|status| status.last_error.is_some()).await;
    patient.note();
    assert_eq!(patient.causes(), [Cause::NotOpen]);
}

#[tokio::test(start_paused = true)]
async fn bytes_without_a_frame_are_told_from_text_and_from_a_wrong_baud_rate() {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(3);
    let (mut patient, remote) = Patient::listening().await;
    for _ in 0..8 {
        let mut noise = [0; 700];
        random.fill_bytes(&mut noise);
        remote.send(&noise).await.expect("sent");
        patient.given += 700;
        patient.second().await;
    }
    assert_eq!(patient.causes(), [Cause::NoFrame]);

    let (mut patient, mut far) = Patient::piped(Way::Tcp);
    let text = b"U-Boot 2020.01 (Apr 20 2020 - 16:04:10 +0000)\r\nDRAM:  1 GiB\r\n".repeat(8);
    patient.feed(&mut far, &text, 8).await;
    assert_eq!(patient.causes(), [Cause::Text]);
}

#[tokio::test(start_paused = true)]
async fn a_serial_port_at_any_wrong_baud_rate() {
    let flight = recording("flight.tlog");
    // 57600 received at 115200, 115200 at 57600, and larger ratios.
    for ratio in [0.5, 2.0, 0.25, 4.0, 1.5, 6.0, 1.0 / 3.0] {
        let garbage = uart::heard(&flight[..8000], ratio);
        let (mut patient, mut far) = Patient::piped(Way::Serial);
        patient.feed(&mut far, &garbage, 10).await;
        assert_eq!(patient.causes(), [Cause::WrongBaud], "{ratio}");
    }
}

/// The wrong baud rate on a real serial device: the other side of a pseudo-terminal.
#[cfg(feature = "serial")]
#[tokio::test(start_paused = true)]
async fn a_real_device_at_the_wrong_baud_rate() {
    use portable_pty::{PtySize, native_pty_system};
    use std::io::Write as _;

    let pair = native_pty_system()
        .openpty(PtySize::default())
        .expect("a pseudo-terminal");
    let device = pair.master.tty_name().expect("a name");
    let address = format!("serial:{}:57600", device.display());
    let address = address.parse().expect("an address");
    let mut patient = Patient::over(Transport::Address(address), Way::Serial);
    patient.until(|status| status.state == LinkState::Up).await;
    let mut line = pair.master.take_writer().expect("a writer");
    let garbage = uart::heard(&recording("flight.tlog")[..6000], 0.5);
    for part in garbage.chunks(600).take(8) {
        line.write_all(part).expect("written");
        line.flush().expect("written");
        patient.given += part.len() as u64;
        patient.second().await;
    }
    assert_eq!(patient.causes(), [Cause::WrongBaud]);
}

#[tokio::test(start_paused = true)]
async fn frames_of_an_unknown_dialect() {
    let (mut patient, remote) = Patient::listening().await;
    for second in 0..8u8 {
        // Messages of a private dialect, with checksums from an unknown seed.
        let mut frames = Vec::new();
        for number in 0..3 {
            let from = frames.len();
            frames.extend([0xFD, 4, 0, 0, second * 3 + number, 1, 1, 0x30, 0xEF, 0]);
            frames.extend([1, 2, 3, second]);
            let crc = mavlink::calculate_crc(&frames[from + 1..], 99);
            frames.extend(crc.to_le_bytes());
        }
        remote.send(&frames).await.expect("sent");
        patient.given += frames.len() as u64;
        patient.second().await;
    }
    assert_eq!(patient.causes(), [Cause::UnknownDialect]);
}

#[tokio::test(start_paused = true)]
async fn only_other_ground_stations_and_only_our_own_echo() {
    for (component, way, cause) in [
        (230, Way::UdpIn, Cause::OnlyGroundStations),
        (190, Way::Serial, Cause::OwnEcho),
    ] {
        let (mut patient, mut far) = Patient::piped(way);
        let mut station = Voice::new(255, component);
        for _ in 0..6 {
            let bytes = station.say(ground_station_heartbeat());
            patient.feed(&mut far, &bytes, 1).await;
        }
        assert_eq!(patient.causes(), [cause]);
    }
}

#[tokio::test(start_paused = true)]
async fn a_component_without_an_autopilot() {
    let (mut patient, mut far) = Patient::piped(Way::UdpIn);
    let mut camera = Voice::new(1, 100);
    for _ in 0..6 {
        let beat = MavMessage::HEARTBEAT(HEARTBEAT_DATA {
            mavtype: MavType::MAV_TYPE_CAMERA,
            autopilot: MavAutopilot::MAV_AUTOPILOT_INVALID,
            ..HEARTBEAT_DATA::default()
        });
        let bytes = camera.say(beat);
        patient.feed(&mut far, &bytes, 1).await;
    }
    assert_eq!(patient.causes(), [Cause::NoAutopilot]);
}

#[tokio::test(start_paused = true)]
async fn signed_frames_of_a_real_vehicle_that_does_not_take_ours() {
    let signed = recording("signing.tlog");
    let (mut patient, mut far) = Patient::piped(Way::Serial);
    let frames = frames_of(&signed);
    // Its answers were to the ground station that signed, not to us.
    let is_signed = |frame: &&Vec<u8>| frame[2] & 1 == 1 && ![77, 111].contains(&frame[7]);
    let frames: Vec<&Vec<u8>> = frames.iter().filter(is_signed).collect();
    // A heartbeat a second, as a vehicle sends them; the recording omits most of a flight.
    for part in frames.chunk_by(|_, next| next[7..10] != [0, 0, 0]).take(20) {
        let bytes: Vec<u8> = part
            .iter()
            .flat_map(|frame| frame.iter().copied())
            .collect();
        patient.ask();
        patient.feed(&mut far, &bytes, 1).await;
    }
    assert_eq!(patient.causes()[0], Cause::Signed(36));
}

#[tokio::test(start_paused = true)]
async fn a_vehicle_that_never_answers_is_one_way_until_it_does() {
    let (mut patient, remote) = Patient::listening().await;
    let mut voice = Voice::new(7, 1);
    let mut said = Vec::new();
    for at in 0..40 {
        patient.ask();
        let mut bytes = voice.second();
        if at >= 30 {
            bytes.extend(voice.answer());
        }
        remote.send(&bytes).await.expect("sent");
        patient.given += bytes.len() as u64;
        patient.second().await;
        said.push(patient.causes());
    }
    assert_eq!(said[5], [Cause::Unanswered(1)], "it may still answer");
    assert_eq!(said[28], [Cause::OneWay(7)]);
    assert_eq!(said[39], [Cause::Well(1)]);
}

#[tokio::test(start_paused = true)]
async fn a_vehicle_that_has_answered_may_lose_some_answers() {
    let (mut patient, remote) = Patient::listening().await;
    let mut voice = Voice::new(7, 1);
    for at in 0..40 {
        patient.ask();
        let mut bytes = voice.second();
        if at == 5 || at == 20 {
            bytes.extend(voice.answer());
        }
        remote.send(&bytes).await.expect("sent");
        patient.given += bytes.len() as u64;
        patient.second().await;
        let causes = patient.causes();
        assert!(!causes.contains(&Cause::OneWay(7)), "after {at} s");
    }
}

/// At 30 % loss, half of the queries remain unanswered: a minute without an answer is not chance,
/// half a minute may be.
#[tokio::test(start_paused = true)]
async fn a_lossy_link_needs_more_evidence() {
    let (mut patient, remote) = Patient::listening().await;
    let mut voice = Voice::new(7, 1);
    for at in 0..120 {
        patient.ask();
        let mut bytes = voice.second();
        if at == 5 {
            bytes.extend(voice.answer());
        }
        let is_lost = [0, 3, 6].contains(&(at % 10));
        if !is_lost {
            remote.send(&bytes).await.expect("sent");
            patient.given += bytes.len() as u64;
        }
        patient.second().await;
        let is_one_way = patient.causes().contains(&Cause::OneWay(7));
        match at {
            ..=50 => assert!(!is_one_way, "after {at} s"),
            110.. => assert!(is_one_way, "after {at} s"),
            _ => {}
        }
    }
}

#[tokio::test(start_paused = true)]
async fn after_a_pause_a_vehicle_has_time_to_answer() {
    let (mut patient, remote) = Patient::listening().await;
    let mut voice = Voice::new(7, 1);
    for at in 0..100 {
        patient.ask();
        // For a minute the simulator is stopped.
        if !(20..80).contains(&at) {
            let mut bytes = voice.second();
            if at % 5 == 0 && at != 80 {
                bytes.extend(voice.answer());
            }
            remote.send(&bytes).await.expect("sent");
            patient.given += bytes.len() as u64;
        }
        patient.second().await;
        let causes = patient.causes();
        assert!(!causes.contains(&Cause::OneWay(7)), "after {at} s");
    }
}

#[tokio::test(start_paused = true)]
async fn many_that_never_answer_are_one_finding_and_hide_no_other() {
    let (mut patient, remote) = Patient::listening().await;
    let mut voice = Voice::new(1, 1);
    let mut ghosts: Vec<Voice> = (7..=250).map(|system| Voice::new(system, 1)).collect();
    for _ in 0..20 {
        patient.ask();
        let mut said = vec![[voice.second(), voice.answer()].concat()];
        said.extend(ghosts.iter_mut().map(|ghost| ghost.say(heartbeat())));
        for bytes in said {
            remote.send(&bytes).await.expect("sent");
            patient.given += bytes.len() as u64;
            // Only a few fit into a socket's buffer at a time.
            tokio::task::yield_now().await;
        }
        patient.second().await;
    }
    assert_eq!(patient.causes(), [Cause::OneWayVehicles(244)]);
}

#[tokio::test(start_paused = true)]
async fn noise_around_a_vehicle_is_told() {
    let (mut patient, mut far) = Patient::piped(Way::Udp);
    let mut voice = Voice::new(2, 1);
    for _ in 0..10 {
        let bytes = [voice.answer(), voice.second(), vec![0x55; 4000]].concat();
        patient.feed(&mut far, &bytes, 1).await;
    }
    let causes = patient.causes();
    assert!(matches!(causes[..], [Cause::Noise(85..=99)]), "{causes:?}");
}

#[tokio::test(start_paused = true)]
async fn a_vehicle_that_speaks_mavlink_1_only() {
    let (mut patient, mut far) = Patient::piped(Way::Serial);
    let mut voice = Voice::new(2, 1);
    voice.0.set_version(MavlinkVersion::V1);
    for _ in 0..6 {
        let bytes = [voice.second(), voice.answer()].concat();
        patient.feed(&mut far, &bytes, 1).await;
    }
    assert_eq!(patient.causes(), [Cause::Version1(2)]);
}

#[tokio::test(start_paused = true)]
async fn damaged_and_missing_frames() {
    let (mut patient, mut far) = Patient::piped(Way::Serial);
    let mut voice = Voice::new(2, 1);
    for _ in 0..10 {
        let mut bytes = [voice.answer(), voice.second()].concat();
        // One frame in twelve has a wrong bit.
        let last = bytes.len() - 3;
        bytes[last] ^= 4;
        patient.feed(&mut far, &bytes, 1).await;
    }
    assert!(
        matches!(patient.causes()[..], [Cause::Damaged(7..=10)]),
        "{:?}",
        patient.causes()
    );

    let (mut patient, mut far) = Patient::piped(Way::Serial);
    let mut voice = Voice::new(2, 1);
    for _ in 0..10 {
        let mut bytes = [voice.answer(), voice.second()].concat();
        for _ in 0..4 {
            voice.answer();
        }
        bytes.extend(voice.second());
        patient.feed(&mut far, &bytes, 1).await;
    }
    assert!(
        matches!(patient.causes()[..], [Cause::Lossy(13..=16)]),
        "{:?}",
        patient.causes()
    );
}

#[tokio::test(start_paused = true)]
async fn messages_of_another_dialect_among_those_of_ours_are_remarked() {
    let (mut patient, mut far) = Patient::piped(Way::Serial);
    let mut voice = Voice::new(2, 1);
    for second in 0..10 {
        let mut bytes = [voice.answer(), voice.second()].concat();
        bytes.extend([0xFD, 1, 0, 0, second, 2, 1, 0x30, 0xEF, 0, 5, 1, 2]);
        bytes.extend(voice.say(heartbeat()));
        patient.feed(&mut far, &bytes, 1).await;
    }
    let causes = patient.causes();
    assert!(
        matches!(causes[0], Cause::ForeignMessages(6..=9)),
        "{causes:?}"
    );
    assert_eq!(causes[0].weight(), Weight::Remark);
}

#[tokio::test(start_paused = true)]
async fn everything_is_well_with_a_real_flight() {
    let flight = recording("flight.tlog");
    let (mut patient, mut far) = Patient::piped(Way::Tcp);
    patient.feed(&mut far, &flight, 12).await;
    let worst = patient.causes()[0].weight();
    assert_eq!(patient.until(|_| true).await.state, LinkState::Up);
    assert!(worst >= Weight::Remark, "{:?}", patient.causes());
}

fn frames_of(bytes: &[u8]) -> Vec<Vec<u8>> {
    let mut decoder = sortie::wire::Decoder::new();
    decoder.push(bytes);
    let mut frames = Vec::new();
    while let Some(frame) = decoder.next_frame() {
        frames.push(decoder.bytes_of(&frame).to_vec());
    }
    frames
}

#[tokio::test(start_paused = true)]
async fn no_mixture_of_noise_and_frames_upsets_the_doctor() {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(9);
    let flight = recording("flight.tlog");
    let (mut patient, mut far) = Patient::piped(Way::Serial);
    let (mut reading, mut writing) = tokio::io::split(&mut far);
    for part in flight.chunks(900).take(20) {
        let mut noise = vec![0; random.next_u32() as usize % 900];
        random.fill_bytes(&mut noise);
        let bytes = [part, &noise[..]].concat();
        patient.feed(&mut writing, &bytes, 1).await;
        assert!(!patient.causes().is_empty());
    }
    let mut heard = [0; 21];
    reading.read_exact(&mut heard).await.expect("our heartbeat");
}
