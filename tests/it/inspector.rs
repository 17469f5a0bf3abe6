//! The inspector's reading of real frames, compared with the dialect's.

use std::io::BufReader;

use mavlink::dialects::ardupilotmega::MavMessage;
use sortie::inspector::{MessageReading, read};
use sortie::link::TlogReader;
use sortie::wire::{Anatomy, Content, Decoder};

fn field(reading: &MessageReading, name: &str) -> f64 {
    let value = reading.values.iter().find(|value| value.name == name);
    let value = value.unwrap_or_else(|| panic!("{name} of {reading:?}"));
    value.elements[0].number()
}

/// Some fields of a message as decoded by the dialect.
fn expected(message: &MavMessage) -> Vec<(&'static str, f64)> {
    match message {
        MavMessage::ATTITUDE(it) => {
            vec![("roll", it.roll.into()), ("yawspeed", it.yawspeed.into())]
        }
        MavMessage::GLOBAL_POSITION_INT(it) => vec![
            ("lat", it.lat.into()),
            ("vz", it.vz.into()),
            ("hdg", it.hdg.into()),
        ],
        MavMessage::SYS_STATUS(it) => vec![
            ("voltage_battery", it.voltage_battery.into()),
            ("current_battery", it.current_battery.into()),
            ("battery_remaining", it.battery_remaining.into()),
        ],
        MavMessage::EKF_STATUS_REPORT(it) => vec![
            ("flags", it.flags.bits().into()),
            ("airspeed_variance", it.airspeed_variance.into()),
        ],
        MavMessage::GPS_RAW_INT(it) => vec![
            ("time_usec", it.time_usec as f64),
            ("eph", it.eph.into()),
            ("yaw", it.yaw.into()),
        ],
        MavMessage::PARAM_VALUE(it) => vec![
            ("param_value", it.param_value.into()),
            ("param_index", it.param_index.into()),
        ],
        _ => Vec::new(),
    }
}

#[test]
fn every_frame_that_was_ever_recorded_is_read_as_the_dialect_reads_it() {
    let folder = format!("{}/tests/data/recordings", env!("CARGO_MANIFEST_DIR"));
    let (mut frames, mut compared) = (0, 0);
    for entry in std::fs::read_dir(folder).expect("readable").flatten() {
        let path = entry.path();
        if path.extension().is_none_or(|ending| ending != "tlog") {
            continue;
        }
        let file = std::fs::File::open(&path).expect("readable");
        let mut decoder = Decoder::new();
        for record in TlogReader::new(BufReader::new(file)) {
            decoder.push(&record.expect("intact").bytes);
            while let Some(frame) = decoder.next_frame() {
                frames += 1;
                let bytes = decoder.bytes_of(&frame);
                assert_eq!(bytes.len(), usize::from(frame.wire_len));
                let anatomy = Anatomy::of(bytes).expect("a frame");
                let reading = read(&anatomy);
                assert!(reading.is_verified, "{anatomy:?}");
                let Content::Message(message) = &frame.content else {
                    continue;
                };
                for (name, value) in expected(message) {
                    let found = field(&reading, name);
                    assert!((found - value).abs() < 1e-9, "{name}: {found}, not {value}");
                    compared += 1;
                }
            }
        }
    }
    assert!(
        frames > 3000 && compared > 3000,
        "{frames} frames, {compared} fields"
    );
}
