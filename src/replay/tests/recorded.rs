//! A record for the tests.

use std::path::PathBuf;

use super::*;
use crate::ledger::RowState;
use crate::link::TlogWriter;
use crate::record::{
    EntryLine, ForeignLine, Happening, Head, JournalLine, PathLine, RowLine, Subject,
};
use crate::sim::{PortId, Start, World, WorldConfig};
use crate::wire::{Decoder, Encoder};
use mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, HEARTBEAT_DATA, MISSION_REQUEST_LIST_DATA, MavAutopilot, MavCmd, MavMessage,
    MavMissionType, MavParamType, MavType, PARAM_SET_DATA,
};

/// A record of two vehicles of the embedded simulator, one of which is armed at 16 s and takes off; nothing is recorded
/// between 20 s and 35 s.
pub(super) struct Recorded {
    pub(super) _folder: tempfile::TempDir,
    pub(super) frames: PathBuf,
}

pub(super) fn beat() -> MavMessage {
    MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        mavtype: MavType::MAV_TYPE_GCS,
        autopilot: MavAutopilot::MAV_AUTOPILOT_INVALID,
        ..HEARTBEAT_DATA::default()
    })
}

pub(super) fn command(command: MavCmd, params: [f32; 3]) -> MavMessage {
    MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        command,
        target_system: 1,
        target_component: 1,
        param1: params[0],
        param2: params[1],
        param7: params[2],
        ..COMMAND_LONG_DATA::default()
    })
}

/// The ground station's messages in one tick of a tenth of a second.
pub(super) fn said(tick: u64) -> Vec<MavMessage> {
    let order = |what, params: [f32; 3]| command(what, params);
    let mut said = Vec::new();
    if tick.is_multiple_of(10) {
        said.push(beat());
    }
    match tick {
        20 => said.push(order(
            MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL,
            [33.0, 200_000.0, 0.0],
        )),
        120 | 380 => said.push(MavMessage::PARAM_SET(PARAM_SET_DATA {
            param_id: "WPNAV_SPEED".into(),
            param_value: tick as f32,
            target_system: 1,
            target_component: 1,
            param_type: MavParamType::MAV_PARAM_TYPE_REAL32,
        })),
        // All three lists are asked for at once, as by a console whose requests a slow recording would miss.
        33 => said.extend(
            [
                MavMissionType::MAV_MISSION_TYPE_MISSION,
                MavMissionType::MAV_MISSION_TYPE_FENCE,
                MavMissionType::MAV_MISSION_TYPE_RALLY,
            ]
            .map(|mission_type| {
                MavMessage::MISSION_REQUEST_LIST(MISSION_REQUEST_LIST_DATA {
                    target_system: 1,
                    target_component: 1,
                    mission_type,
                })
            }),
        ),
        150 => said.push(order(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0, 0.0])),
        160 => said.push(order(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0, 0.0])),
        165 => said.push(order(MavCmd::MAV_CMD_NAV_TAKEOFF, [0.0, 0.0, 12.0])),
        _ => {}
    }
    said
}

pub(super) fn record() -> Recorded {
    let folder = tempfile::tempdir().expect("a folder");
    let frames = folder.path().join("flight.tlog");
    let start = Start {
        at: crate::geo::LatLon::new(50.45, 30.52),
        altitude_amsl_m: 180.0,
        heading_deg: 0.0,
    };
    let mut world = World::new(&WorldConfig::row(2, start));
    let ports: Vec<PortId> = (0..2).map(|vehicle| world.connect(vehicle)).collect();
    let mut encoder = Encoder::new(255, 190);
    let mut file = std::fs::File::create(&frames).expect("writable");
    let mut tlog = TlogWriter::new(&mut file);
    for tick in 0..450_u64 {
        let at_us = BEGAN_US + tick * 100_000;
        let is_gap = (200..350).contains(&tick);
        let mut write = |bytes: &[u8]| {
            if !is_gap {
                tlog.write(at_us, bytes).expect("writable");
            }
        };
        for message in said(tick) {
            let mut bytes = Vec::new();
            encoder.encode(&message.into(), &mut bytes);
            for &port in &ports {
                world.receive(port, &bytes);
            }
            write(&bytes);
        }
        while world.now() < FRAME * (tick as u32 + 1) {
            world.step();
        }
        for (vehicle, &port) in ports.iter().enumerate() {
            // After the gap, the second vehicle is heard one second later.
            let is_late = vehicle == 1 && (350..360).contains(&tick);
            let mut output = Vec::new();
            world.take_output(port, &mut output);
            let mut decoder = Decoder::new();
            decoder.push(&output);
            while let Some(frame) = decoder.next_frame() {
                if !is_late {
                    write(decoder.bytes_of(&frame));
                }
            }
        }
    }
    write_journal(&frames);
    Recorded {
        _folder: folder,
        frames,
    }
}

/// Writes a journal with a refused command, a command of another station, and a bookmark.
pub(super) fn write_journal(frames: &std::path::Path) {
    let head = Head::new(Subject::Free, BEGAN_US);
    let verb = crate::language::verb("arm").expect("it is one");
    let entry = EntryLine {
        id: 0,
        line: "2 arm".to_owned(),
        verb,
        risk: crate::ledger::Risk::None,
        by: None,
        vehicles: vec![2],
    };
    let row = |state| {
        Happening::Row(RowLine {
            id: 0,
            vehicle: 2,
            state,
            tries: 1,
            why: Some("it is tired".to_owned()),
            text: None,
        })
    };
    let foreign = |count| {
        Happening::Foreign(ForeignLine {
            id: 0,
            station: [254, 230],
            vehicle: 2,
            what: "mode RTL".to_owned(),
            count,
            state: RowState::Accepted,
            why: None,
        })
    };
    let path = PathLine {
        vehicle: 1,
        points: vec![[50.46, 30.52]],
    };
    let lines = [
        (s(6), Happening::Entry(entry)),
        (s(6), row(RowState::Sent)),
        (s(7), row(RowState::Refused)),
        (s(8), Happening::Paths(vec![path])),
        (s(9), foreign(1)),
        (s(11), foreign(2)),
        (
            s(12),
            Happening::Bookmark {
                text: "here".to_owned(),
            },
        ),
        (s(38), Happening::Paths(Vec::new())),
        (s(40), Happening::End),
    ];
    let mut text = head.to_line();
    for (at, what) in lines {
        text.push_str(&JournalLine::new(at, what).to_line());
    }
    std::fs::write(frames.with_extension("flight.jsonl"), text).expect("writable");
}
