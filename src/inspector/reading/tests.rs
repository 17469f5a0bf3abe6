use mavlink::MavlinkVersion;
use mavlink::dialects::ardupilotmega::*;

use super::*;
use crate::wire::{Encoder, Outgoing};

fn reading(outgoing: &Outgoing) -> MessageReading {
    let mut bytes = Vec::new();
    Encoder::new(3, 1).encode(outgoing, &mut bytes);
    read(&Anatomy::of(&bytes).expect("a frame"))
}

/// A field as the screen shows it.
fn shown(reading: &MessageReading, name: &str) -> String {
    let value = reading.values.iter().find(|value| value.name == name);
    let value = value.unwrap_or_else(|| panic!("{name} of {reading:?}"));
    let parts = [&value.figures(), value.unit, &value.names.join("|")];
    let unknown = if value.is_unknown { " unknown" } else { "" };
    format!("{}{unknown}", parts.join(" ").trim_end())
}

#[test]
fn numbers_have_units_and_values_of_enums_and_bits_have_names() {
    let attitude = MavMessage::ATTITUDE(ATTITUDE_DATA {
        time_boot_ms: 1500,
        roll: -0.125,
        ..ATTITUDE_DATA::default()
    });
    let attitude = reading(&attitude.into());
    assert_eq!(attitude.name, Some("ATTITUDE"));
    assert_eq!(shown(&attitude, "roll"), "-0.125 rad");
    assert_eq!(shown(&attitude, "time_boot_ms"), "1500 ms");

    let beat = MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        mavtype: MavType::MAV_TYPE_QUADROTOR,
        base_mode: MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED
            | MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED,
        ..HEARTBEAT_DATA::default()
    });
    let beat = reading(&beat.into());
    assert_eq!(shown(&beat, "type"), "2  QUADROTOR");
    assert_eq!(
        shown(&beat, "base_mode"),
        "129  CUSTOM_MODE_ENABLED|SAFETY_ARMED"
    );
}

#[test]
fn what_the_sender_does_not_know_is_no_figure() {
    let status = MavMessage::SYS_STATUS(SYS_STATUS_DATA {
        voltage_battery: 65_535,
        current_battery: -1,
        ..SYS_STATUS_DATA::default()
    });
    let status = reading(&status.into());
    assert_eq!(shown(&status, "voltage_battery"), "65535 mV unknown");
    assert_eq!(shown(&status, "current_battery"), "-1 cA unknown");
    assert_eq!(shown(&status, "load"), "0 d%");
}

#[test]
fn text_ends_at_its_first_zero_and_arrays_show_every_element() {
    let mut text = [0; 50];
    text[..5].copy_from_slice(b"Ok\x1b[2");
    let said = MavMessage::STATUSTEXT(STATUSTEXT_DATA {
        severity: MavSeverity::MAV_SEVERITY_WARNING,
        text: text.into(),
        ..STATUSTEXT_DATA::default()
    });
    let said = reading(&said.into());
    assert_eq!(shown(&said, "text"), "\"Ok\u{FFFD}[2\"");
    assert_eq!(shown(&said, "severity"), "4  WARNING");
    let q = MavMessage::ATTITUDE_TARGET(ATTITUDE_TARGET_DATA {
        q: [1.0, 0.0, -0.5, 0.25],
        ..ATTITUDE_TARGET_DATA::default()
    });
    assert_eq!(shown(&reading(&q.into()), "q"), "1 0 -0.5 0.25");
}

#[test]
fn a_value_that_the_dialect_cannot_hold_is_read_all_the_same() {
    // A HEARTBEAT with an unknown vehicle type, which the dialect cannot decode.
    let payload = vec![0, 0, 0, 0, 201, 3, 81, 3, 3];
    let beat = reading(&Outgoing::Raw { id: 0, payload });
    assert_eq!(shown(&beat, "type"), "201");
    assert_eq!(shown(&beat, "autopilot"), "3  ARDUPILOTMEGA");
}

#[test]
fn a_message_of_another_dialect_is_read_if_its_checksum_says_that_the_layout_is_this_one() {
    // `STORM32_GIMBAL_MANAGER_STATUS` (id 60011) is in the table, but not in the dialect.
    let message = Definitions::get().message(60_011).expect("in the table");
    assert_eq!(message.name, "STORM32_GIMBAL_MANAGER_STATUS");
    let mut bytes = vec![0xFD, 2, 0, 0, 0, 9, 1, 0x6B, 0xEA, 0, 7, 8];
    let crc = mavlink::calculate_crc(&bytes[1..], message.seed);
    bytes.extend(crc.to_le_bytes());
    let read_so = read(&Anatomy::of(&bytes).expect("a frame"));
    assert!(read_so.is_verified);
    assert_eq!(read_so.values.len(), message.fields.len());
    bytes[10] ^= 1;
    let damaged = read(&Anatomy::of(&bytes).expect("a frame"));
    assert!(!damaged.is_verified && damaged.values.is_empty());
    assert_eq!(damaged.name, Some(message.name));
}

#[test]
fn an_id_that_nobody_knows_is_shown_by_its_number() {
    let bytes = [0xFD, 1, 0, 0, 0, 9, 1, 0xFF, 0xFF, 0xFE, 7, 0, 0];
    let unknown = read(&Anatomy::of(&bytes).expect("a frame"));
    assert_eq!((unknown.name, unknown.values.len()), (None, 0));
    assert_eq!(name_of(0x00FE_FFFF), "#16711679");
    assert_eq!(name_of(30), "ATTITUDE");
}

#[test]
fn fractions_show_what_their_precision_carries() {
    let table = [
        (ElementReading::Single(0.1), "0.1"),
        (ElementReading::Single(-0.0), "0"),
        (ElementReading::Single(1234.5678), "1234.568"),
        (ElementReading::Single(100.0), "100"),
        (ElementReading::Single(f32::NAN), "NaN"),
        (ElementReading::Single(f32::NEG_INFINITY), "-inf"),
        (ElementReading::Single(1.5e-7), "1.500000e-7"),
        (ElementReading::Double(50.450_112_345_678), "50.4501123457"),
        (ElementReading::Signed(-7), "-7"),
    ];
    for (element, text) in table {
        assert_eq!(element.to_string(), text);
    }
}

#[test]
fn every_message_is_read_in_both_versions_without_a_panic() {
    for (id, message) in Definitions::get().messages() {
        for (version, start) in [(MavlinkVersion::V1, 0xFE), (MavlinkVersion::V2, 0xFD)] {
            if version == MavlinkVersion::V1 && id > 255 {
                continue;
            }
            let [id0, id1, id2, _] = id.to_le_bytes();
            let mut bytes = match version {
                MavlinkVersion::V1 => vec![start, 1, 0, 1, 1, id0],
                MavlinkVersion::V2 => vec![start, 1, 0, 0, 0, 1, 1, id0, id1, id2],
            };
            bytes.push(0xFF);
            let crc = mavlink::calculate_crc(&bytes[1..], message.seed);
            bytes.extend(crc.to_le_bytes());
            let found = read(&Anatomy::of(&bytes).expect("a frame"));
            assert!(found.is_verified, "{}", message.name);
            for value in &found.values {
                let _ = (value.figures(), value.number());
            }
        }
    }
}
