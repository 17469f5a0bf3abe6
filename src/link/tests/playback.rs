//! Recordings as links.

use std::io::Write as _;

use super::*;

/// A recording of heartbeats of system 3, half a second apart.
fn recording(count: u64, damage: impl FnOnce(&mut Vec<u8>)) -> tempfile::NamedTempFile {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(3, 1);
    let mut writer = TlogWriter::new(&mut bytes);
    for number in 0..count {
        let mut frame = Vec::new();
        let message = MavMessage::HEARTBEAT(HEARTBEAT_DATA::default());
        encoder.encode(&message.into(), &mut frame);
        let unix_us = 1_700_000_000_000_000 + number * 500_000;
        writer.write(unix_us, &frame).expect("memory is writable");
    }
    damage(&mut bytes);
    let mut file = tempfile::NamedTempFile::new().expect("a temporary file");
    file.write_all(&bytes).expect("written");
    file
}

fn play(file: &tempfile::NamedTempFile, playback: Playback) -> Rig {
    let (sender, inbound) = mpsc::channel(8);
    let cancel = CancellationToken::new();
    let path = file.path().to_owned();
    let config = LinkConfig {
        playback,
        ..LinkConfig::default()
    };
    let transport = Transport::Address(Address::File { path });
    let link = open_with(LinkId(1), transport, config, sender, cancel.clone());
    Rig {
        link,
        inbound,
        cancel,
    }
}

#[tokio::test(start_paused = true)]
async fn a_recording_is_played_at_the_speed_asked_for() {
    for (speed, seconds) in [(1.0, 5.0), (2.0, 2.5)] {
        let file = recording(11, |_| {});
        let mut rig = play(&file, Playback::Speed(speed));
        let first = rig.next().await.at;
        let mut last = first;
        for _ in 1..11 {
            last = rig.next().await.at;
        }
        let took = (last - first).as_secs_f64();
        assert!((took - seconds).abs() < 0.05, "{took} s at speed {speed}");
        let status = rig.until(|s| s.state == LinkState::Ended).await;
        assert_eq!(status.rates, Rates::default(), "nothing flows any more");
        assert_eq!(status.last_error, None);
        assert_eq!(status.sent_messages, 0, "a recording hears no heartbeat");
    }
}

#[tokio::test(start_paused = true)]
async fn a_recording_without_pauses_loses_no_frame() {
    let file = recording(5000, |_| {});
    let mut rig = play(&file, Playback::AsFastAsPossible);
    let mut frames = 0;
    while frames < 5000 {
        frames += rig.next().await.frames.len();
    }
    assert!(
        !rig.link.send(To::Everyone, attitude()),
        "a recording takes nothing"
    );
    let status = rig.until(|s| s.state == LinkState::Ended).await;
    assert_eq!((status.decoder.frames, status.lost()), (5000, 0));
}

#[tokio::test(start_paused = true)]
async fn a_spoilt_recording_is_played_up_to_the_fault_and_says_where_it_is() {
    let record = 8 + heartbeat(3).len();
    let cut = recording(4, |bytes| bytes.truncate(bytes.len() - 1));
    let bad = recording(4, |bytes| bytes[3 * record + 8] = 0x11);
    for (file, what) in [(cut, "cut off"), (bad, "damaged")] {
        let mut rig = play(&file, Playback::Speed(1.0));
        let status = rig.until(|s| s.state == LinkState::Ended).await;
        let reason = status.last_error.expect("a reason");
        assert!(reason.contains(what), "{reason}");
        assert!(reason.contains(&format!("byte {}", 3 * record)), "{reason}");
        assert_eq!(status.decoder.frames, 3);
    }
}

#[tokio::test(start_paused = true)]
async fn a_recording_is_played_on_behind_its_damaged_stretches() {
    let record = 8 + heartbeat(3).len();
    let no_start = |bytes: &mut Vec<u8>| bytes[2 * record + 8] = 0x11;
    let wrong_length = |bytes: &mut Vec<u8>| bytes[2 * record + 9] = 200;
    let hole = |bytes: &mut Vec<u8>| drop(bytes.drain(2 * record + 5..3 * record - 3));
    let noise = |bytes: &mut Vec<u8>| drop(bytes.splice(2 * record..3 * record, [0xFD; 5000]));
    for (damage, passed_over) in [
        (&no_start as &dyn Fn(&mut Vec<u8>), record),
        (&wrong_length, record),
        (&hole, 8),
        (&noise, 5000),
    ] {
        let file = recording(40, damage);
        let mut rig = play(&file, Playback::Speed(1.0));
        let told = rig.until(|s| s.last_error.is_some()).await;
        assert_eq!(told.state, LinkState::Up);
        let status = rig.until(|s| s.state == LinkState::Ended).await;
        assert_eq!(status.decoder.frames, 39);
        assert_eq!(status.decoder.skipped_bytes, passed_over as u64);
        let reason = status.last_error.expect("a reason");
        let place = format!("damaged at byte {}: {passed_over} bytes", 2 * record);
        assert!(reason.contains(&place), "{reason}");
    }
}

#[tokio::test(start_paused = true)]
async fn several_faults_are_told_together() {
    let record = 8 + heartbeat(3).len();
    let file = recording(40, |bytes| {
        bytes[8] = 0;
        bytes[5 * record + 8] = 0;
        bytes.truncate(39 * record + 12);
    });
    let mut rig = play(&file, Playback::AsFastAsPossible);
    let status = rig.until(|s| s.state == LinkState::Ended).await;
    assert_eq!(status.decoder.frames, 37);
    let reason = status.last_error.expect("a reason");
    assert!(
        reason.contains("in 2 places, first at byte 0: "),
        "{reason}"
    );
    assert!(reason.contains("cut off"), "{reason}");
}

#[tokio::test(start_paused = true)]
async fn a_frame_with_a_bad_checksum_is_the_decoders_business() {
    let record = 8 + heartbeat(3).len();
    let file = recording(4, |bytes| bytes[2 * record + 20] ^= 1);
    let mut rig = play(&file, Playback::AsFastAsPossible);
    let status = rig.until(|s| s.state == LinkState::Ended).await;
    assert_eq!((status.decoder.frames, status.decoder.crc_errors), (3, 1));
    assert_eq!(status.last_error, None);
}

#[tokio::test(start_paused = true)]
async fn a_file_that_is_no_recording_is_called_none() {
    let text = b"name = \"a mission\"\n".repeat(50);
    let raw: Vec<u8> = (0..50).flat_map(heartbeat).collect();
    for content in [&text[..], &raw, b"short"] {
        let file = recording(0, |bytes| bytes.extend_from_slice(content));
        let mut rig = play(&file, Playback::Speed(1.0));
        let status = rig.until(|s| s.state == LinkState::Ended).await;
        assert_eq!(status.decoder.frames, 0);
        let reason = status.last_error.expect("a reason");
        assert!(reason.contains("is it a tlog?"), "{reason}");
    }
}

#[tokio::test(start_paused = true)]
async fn a_recording_that_is_not_there_is_named() {
    let mut rig = Rig::open("file:absent.tlog");
    let status = rig.until(|s| s.state == LinkState::Ended).await;
    let reason = status.last_error.expect("a reason");
    assert!(reason.contains("cannot open absent.tlog"), "{reason}");
}
