//! What a vehicle documents about itself, read by MAVFTP.

use std::collections::BTreeMap;
use std::sync::Mutex;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    COMPONENT_METADATA_DATA, EVENT_DATA, FILE_TRANSFER_PROTOCOL_DATA,
};

use super::*;
use crate::commands::FileCommand;
use crate::session::ftp::server::FileServer;

const GENERAL: &str = "/etc/extras/component_general.json.xz";
const EVENTS: &[u8] = include_bytes!("../../../fuzz/seeds/documentation/events.json");
const PARAMETERS: &[u8] = include_bytes!("../../../fuzz/seeds/documentation/px4.json.xz");

/// Files kept in memory.
#[derive(Debug, Default)]
struct Kept(Mutex<BTreeMap<u32, Vec<u8>>>);

impl FileDesk for Kept {
    fn read(&self, _file: &str) -> Result<Vec<u8>, Text> {
        Err(Text::default())
    }

    fn write(&self, _file: &str, _bytes: &[u8]) -> Result<String, Text> {
        Err(Text::default())
    }

    fn kept(&self, checksum: u32) -> Option<Vec<u8>> {
        self.0.lock().expect("no panic").get(&checksum).cloned()
    }

    fn keep(&self, checksum: u32, bytes: &[u8]) {
        let mut kept = self.0.lock().expect("no panic");
        kept.insert(checksum, bytes.to_vec());
    }
}

/// A vehicle with a file server.
struct Documented {
    scene: Scene,
    server: FileServer,
    address: &'static str,
}

impl Documented {
    fn new(desk: Option<Arc<Kept>>) -> Self {
        let mut scene = Scene::new();
        if let Some(desk) = desk {
            scene.session = scene.session.clone().with_files(desk);
        }
        let general = include_bytes!("../../../fuzz/seeds/documentation/general.json");
        let mut server = FileServer::with(GENERAL, general);
        for (path, content) in [
            ("/etc/extras/parameters.json.xz", PARAMETERS),
            ("/etc/extras/all_events.json.xz", EVENTS),
        ] {
            server.files.insert(path.to_owned(), content.to_vec());
        }
        Self {
            scene,
            server,
            address: "mftp:///etc/extras/component_general.json.xz",
        }
    }

    fn read(&mut self, entry: u32) {
        let command = Command::File(FileCommand::Documentation);
        self.scene.order(entry, "param", command);
        for _ in 0..200 {
            self.scene.pass(ms(50));
            for sent in std::mem::take(&mut self.scene.sent) {
                match sent {
                    Outgoing::Message(MavMessage::COMMAND_LONG(long))
                        if long.param1 as u32 == COMPONENT_METADATA_DATA::ID
                            && !self.address.is_empty() =>
                    {
                        let told = COMPONENT_METADATA_DATA {
                            file_crc: 99,
                            uri: self.address.into(),
                            ..COMPONENT_METADATA_DATA::DEFAULT
                        };
                        self.scene.hear(MavMessage::COMPONENT_METADATA(told));
                    }
                    Outgoing::Message(MavMessage::FILE_TRANSFER_PROTOCOL(data)) => {
                        self.server.hear(data.payload);
                    }
                    _ => {}
                }
            }
            while let Some(payload) = self.server.say() {
                let answer = FILE_TRANSFER_PROTOCOL_DATA {
                    payload,
                    target_system: 255,
                    ..FILE_TRANSFER_PROTOCOL_DATA::DEFAULT
                };
                self.scene.hear(MavMessage::FILE_TRANSFER_PROTOCOL(answer));
            }
            self.scene.heartbeat(STABILIZE, false);
        }
    }

    fn end(&self, entry: u32) -> (Option<RowState>, String) {
        let state = self.scene.states(entry).last().copied();
        (state, self.scene.explanation(entry))
    }
}

#[test]
fn parameters_and_events_are_documented_by_the_vehicle() {
    let kept = Arc::new(Kept::default());
    let mut vehicle = Documented::new(Some(Arc::clone(&kept)));
    vehicle.read(1);
    assert_eq!(
        vehicle.end(1),
        (
            Some(RowState::Done),
            "3 parameters documented; 5 event texts".to_owned()
        )
    );
    let documents = vehicle.scene.session.parameters().documents;
    let mode = documents.get("COM_RC_IN_MODE").expect("documented");
    assert_eq!(mode.title, "RC input mode");
    vehicle.scene.notices.clear();
    vehicle.scene.hear(MavMessage::EVENT(EVENT_DATA {
        id: (1 << 24) + 1234,
        log_levels: 0x22,
        ..EVENT_DATA::DEFAULT
    }));
    assert_eq!(vehicle.scene.notices, ["ekf2 missing data"]);
    // A second vehicle with the same files is only asked for their checksums.
    assert_eq!(
        kept.0
            .lock()
            .expect("no panic")
            .keys()
            .copied()
            .collect::<Vec<_>>(),
        [7, 8, 99]
    );
    let mut twin = Documented::new(Some(kept));
    twin.server.files.clear();
    twin.read(1);
    assert_eq!(twin.end(1).0, Some(RowState::Done));
    assert!(twin.server.carried_out.is_empty());
}

#[test]
fn bad_files_are_left_out_with_the_reason() {
    let mut vehicle = Documented::new(None);
    let damaged = PARAMETERS[..PARAMETERS.len() - 9].to_vec();
    let path = "/etc/extras/parameters.json.xz".to_owned();
    vehicle.server.files.insert(path.clone(), damaged);
    vehicle.read(1);
    let (state, said) = vehicle.end(1);
    assert_eq!(state, Some(RowState::Done));
    assert!(
        said.starts_with(
            "5 event texts; no documentation of parameters: the compressed file is damaged"
        ),
        "{said}"
    );
    vehicle.server.files.remove(&path);
    vehicle
        .server
        .files
        .remove("/etc/extras/all_events.json.xz");
    vehicle.read(2);
    assert_eq!(vehicle.end(2).0, Some(RowState::Refused));
    vehicle.server.quirks.estimate = 5 * 1024 * 1024;
    vehicle.read(3);
    let (state, said) = vehicle.end(3);
    assert_eq!(state, Some(RowState::Refused));
    assert!(said.contains("4 MB"), "{said}");
}

#[test]
fn a_vehicle_without_metadata_or_with_it_elsewhere_says_so() {
    let mut vehicle = Documented::new(None);
    vehicle.address = "";
    vehicle.read(1);
    let (state, said) = vehicle.end(1);
    assert_eq!(state, Some(RowState::TimedOut));
    assert!(said.contains("COMPONENT_METADATA"), "{said}");
    vehicle.address = "https://example.org/general.json";
    vehicle.read(2);
    let (state, said) = vehicle.end(2);
    assert_eq!(state, Some(RowState::Refused));
    assert!(said.contains("https://example.org"), "{said}");
}
