//! Transfers of files and flight logs to a ground station.

use mavlink::dialects::ardupilotmega::{
    FILE_TRANSFER_PROTOCOL_DATA, LOG_ERASE_DATA, LOG_REQUEST_DATA_DATA, LOG_REQUEST_LIST_DATA,
    MavCmd, MavMessage, MavResult, PARAM_REQUEST_READ_DATA,
};
use mavlink::types::CharArray;

use super::Ground;
use super::transfers::{MISSION, count, download, flight, parameter, upload};

/// Sends an FTP request and returns opcode, offset and data of the answers.
fn ftp(ground: &mut Ground, head: [u8; 4], offset: u32, data: &[u8]) -> Vec<(u8, u32, Vec<u8>)> {
    let first = ground.heard.len();
    let [seq, session, opcode, size] = head;
    let mut payload = [0; 251];
    payload[..5].copy_from_slice(&[seq, 0, session, opcode, size]);
    payload[8..12].copy_from_slice(&offset.to_le_bytes());
    payload[12..12 + data.len()].copy_from_slice(data);
    ground.say(MavMessage::FILE_TRANSFER_PROTOCOL(
        FILE_TRANSFER_PROTOCOL_DATA {
            target_system: 1,
            payload,
            ..Default::default()
        },
    ));
    ftp_answers(ground, first)
}

fn ftp_answers(ground: &Ground, first: usize) -> Vec<(u8, u32, Vec<u8>)> {
    let said = ground.messages_since(first);
    said.iter()
        .filter_map(|message| match message {
            MavMessage::FILE_TRANSFER_PROTOCOL(data) => {
                let p = &data.payload;
                let offset = u32::from_le_bytes([p[8], p[9], p[10], p[11]]);
                Some((p[3], offset, p[12..12 + usize::from(p[4])].to_vec()))
            }
            _ => None,
        })
        .collect()
}

#[test]
fn the_parameters_come_as_a_file_in_a_burst() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let name = b"@PARAM/param.pck";
    let opened = ftp(&mut ground, [1, 0, 4, name.len() as u8], 0, name);
    assert_eq!(opened, [(128, 0, 16_584_u32.to_le_bytes().to_vec())]);
    let first = ground.heard.len();
    ftp(&mut ground, [2, 0, 15, 239], 0, b"");
    // The real vehicle takes 0.35 s.
    ground.run(0.4);
    let mut answers = ftp_answers(&ground, first);
    assert_eq!(answers.pop(), Some((129, 15_140, vec![6])));
    let file: Vec<u8> = answers.into_iter().flat_map(|(_, _, data)| data).collect();
    assert_eq!((file.len(), &file[..4]), (15_140, &b"\x1bg\x66\x05"[..]));
}

#[test]
fn a_request_that_comes_again_gets_the_same_answer() {
    let mut ground = Ground::new();
    ground.heartbeat();
    let made = ftp(&mut ground, [1, 0, 9, 1], 0, b"d");
    assert_eq!(made, [(128, 0, vec![])]);
    assert_eq!(ftp(&mut ground, [1, 0, 9, 1], 0, b"d"), made);
    // The same operation with another sequence number is a new request: the folder exists.
    let exists = ftp(&mut ground, [2, 0, 9, 1], 0, b"d");
    assert_eq!(exists, [(129, 0, vec![8])]);
}

#[test]
fn files_written_to_the_parameters_and_the_mission_take_effect() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let name = b"@PARAM/param.pck";
    let mut file = b"\x1bg\x01\x00\x11\x00\x02\x60RTL_ALT\xd0\x07".to_vec();
    file[4] = file.len() as u8;
    ftp(&mut ground, [1, 0, 6, name.len() as u8], 0, name);
    ftp(&mut ground, [2, 0, 7, file.len() as u8], 0, &file);
    ftp(&mut ground, [3, 0, 1, 0], 0, b"");
    ground.say(MavMessage::PARAM_REQUEST_READ(PARAM_REQUEST_READ_DATA {
        param_index: -1,
        param_id: CharArray::from("RTL_ALT"),
        ..Default::default()
    }));
    assert_eq!(parameter(&ground, "RTL_ALT"), [2000.0]);
    upload(&mut ground, MISSION, &flight());
    let name = b"@MISSION/mission.dat";
    ftp(&mut ground, [7, 0, 4, name.len() as u8], 0, name);
    let mission = ftp(&mut ground, [8, 0, 5, 239], 0, b"")[0].2.clone();
    assert_eq!(mission.len(), 10 + 4 * 38);
    ftp(&mut ground, [9, 0, 1, 0], 0, b"");
    count(&mut ground, MISSION, 0);
    assert!(download(&mut ground, MISSION, 2).is_none());
    ftp(&mut ground, [10, 0, 6, name.len() as u8], 0, name);
    ftp(&mut ground, [11, 0, 7, mission.len() as u8], 0, &mission);
    ftp(&mut ground, [12, 0, 1, 0], 0, b"");
    let point = download(&mut ground, MISSION, 2).expect("there again");
    assert!((point.z - 25.0).abs() < f32::EPSILON);
}

/// The number of the only log and the number of logs, as the vehicle lists them.
fn listed_logs(ground: &mut Ground) -> Option<(u16, u16)> {
    let first = ground.heard.len();
    ground.say(MavMessage::LOG_REQUEST_LIST(LOG_REQUEST_LIST_DATA {
        end: u16::MAX,
        ..Default::default()
    }));
    let said = ground.messages_since(first).into_iter();
    said.rev().find_map(|message| match message {
        MavMessage::LOG_ENTRY(entry) => Some((entry.id, entry.num_logs)),
        _ => None,
    })
}

#[test]
fn erasing_the_logs_begins_a_new_one_while_the_vehicle_still_writes() {
    let mut ground = Ground::armed();
    ground.run(3.0);
    ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [0.0]);
    ground.run(2.0);
    let erase = || MavMessage::LOG_ERASE(LOG_ERASE_DATA::default());
    for (wait_s, logs) in [(1.0, (1, 1)), (20.0, (0, 0))] {
        ground.run(wait_s);
        ground.say(erase());
        ground.run(1.0);
        assert_eq!(listed_logs(&mut ground), Some(logs), "after {wait_s} s");
    }
}

#[test]
fn a_flight_leaves_a_log_that_can_be_downloaded_and_survives_a_reboot() {
    let mut ground = Ground::armed();
    ground.takeoff(5.0);
    ground.run(5.0);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [0.0, 21196.0]),
        MavResult::MAV_RESULT_ACCEPTED
    );
    ground.run(16.0);
    let first = ground.heard.len();
    ground.say(MavMessage::LOG_REQUEST_LIST(LOG_REQUEST_LIST_DATA {
        end: u16::MAX,
        ..Default::default()
    }));
    let said = ground.messages_since(first);
    let MavMessage::LOG_ENTRY(entry) = &said[0] else {
        panic!("{said:?}");
    };
    assert_eq!((entry.id, entry.num_logs), (1, 1));
    ground.say(MavMessage::LOG_REQUEST_DATA(LOG_REQUEST_DATA_DATA {
        count: u32::MAX,
        id: 1,
        ..Default::default()
    }));
    ground.run(1.0);
    let said = ground.messages_since(first);
    let log: Vec<u8> = said
        .iter()
        .filter_map(|message| match message {
            MavMessage::LOG_DATA(data) => Some(data.data[..usize::from(data.count)].to_vec()),
            _ => None,
        })
        .flatten()
        .collect();
    assert_eq!(log.len(), entry.size as usize);
    assert_eq!(&log[..7], &[0xA3, 0x95, 0x80, 0x80, 89, b'F', b'M']);
    // ArduCopter writes a log for 15 s after disarming, and nothing after that.
    ground.run(30.0);
    let first = ground.heard.len();
    ground.say(MavMessage::LOG_REQUEST_LIST(LOG_REQUEST_LIST_DATA {
        end: u16::MAX,
        ..Default::default()
    }));
    let said = ground.messages_since(first);
    let is_same =
        |it: &MavMessage| matches!(it, MavMessage::LOG_ENTRY(later) if later.size == entry.size);
    assert!(said.iter().any(is_same), "{said:?}");
    ground.long(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [1.0]);
    ground.run(1.0);
    ground.port = ground.world.connect(0);
    ground.heartbeat();
    let listed = ftp(&mut ground, [1, 0, 3, 4], 0, b"logs");
    let listed = String::from_utf8_lossy(&listed[0].2).into_owned();
    assert!(listed.contains("F00000001.BIN\t"), "{listed:?}");
}

#[test]
fn a_board_that_hands_out_no_files_neither_says_so_nor_answers() {
    let mut ground = Ground::new();
    ground.heartbeat();
    let name = b"@SYS";
    assert_eq!(ftp(&mut ground, [1, 0, 3, 4], 0, name)[0].0, 128);
    ground.set("BRD_OPTIONS", 2.0);
    assert_eq!(ftp(&mut ground, [2, 0, 3, 4], 0, name), []);
    let first = ground.heard.len();
    ground.long(MavCmd::MAV_CMD_REQUEST_MESSAGE, [148.0]);
    let said = ground.messages_since(first);
    let bits = said.iter().find_map(|message| match message {
        MavMessage::AUTOPILOT_VERSION(version) => Some(version.capabilities.bits()),
        _ => None,
    });
    assert_eq!(bits, Some(0xFBCF));
}
