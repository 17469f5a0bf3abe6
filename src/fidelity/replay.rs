//! The commands of a recording, given to the embedded simulator.

use std::collections::BTreeMap;
use std::time::Duration;

use mavlink::Message as _;

use super::{Observed, Recording, Timed};
use crate::geo::LatLon;
use crate::sim::{Airframe, STEP, Start, World, WorldConfig};
use crate::wire::{
    AUTOPILOT_COMPONENT, ComponentId, Content, Decoder, Encoder, Frame, Outgoing, SystemId,
};

/// The simulated vehicle's system id.
const SYSTEM: u8 = 1;
/// How long the simulated vehicle is heard after the recording's end: its answers may come a little later.
pub(super) const AFTERWARDS: Duration = Duration::from_secs(3);
/// The longest payload of any message, in bytes.
const LONGEST: usize = 255;
/// The offset of the target system in `COMMAND_LONG` (76) and `COMMAND_INT` (75), for commands with a number that the
/// dialect lacks.
const TARGET_OF_A_COMMAND: usize = 30;
/// The field near Canberra where SITL starts by default.
const SITL_HOME: Start = Start {
    at: LatLon::new(-35.363_262, 149.165_237),
    altitude_amsl_m: 584.0,
    heading_deg: 0.0,
};

/// Sends the ground station's frames of a recording at the same times, and returns the simulated vehicle's frames until
/// 3 s after the recording's end. The vehicle starts at the place of the real one, ready to fly.
pub fn replay(recording: &Recording, real: &Observed) -> Vec<Timed> {
    let start = real.start().unwrap_or(SITL_HOME);
    // The recorded vehicles had no frame file.
    let mut world = World::new(&WorldConfig {
        airframes: vec![Airframe::shared_default()],
        kinds: vec![real.kind()],
        ..WorldConfig::row(1, start)
    });
    let mut port = world.connect(0);
    let mut decoder = Decoder::new();
    let mut ground = RecordedStations {
        encoders: BTreeMap::new(),
        recorded: system_of(recording),
    };
    let mut sent = recording.sent.iter().peekable();
    let mut heard = Vec::new();
    let mut bytes = Vec::new();
    let last = recording.heard.last();
    let end = last.map_or(Duration::ZERO, |last| last.at + AFTERWARDS);
    while world.now() < end {
        let now = world.now();
        while let Some(Timed { frame, .. }) = sent.next_if(|next| next.at < now + STEP) {
            bytes.clear();
            ground.encode(frame, &mut bytes);
            world.receive(port, &bytes);
        }
        world.step();
        bytes.clear();
        world.take_output(port, &mut bytes);
        decoder.push(&bytes);
        while let Some(frame) = decoder.next_frame() {
            let at = world.now();
            heard.push(Timed { at, frame });
        }
        if !world.is_open(port) {
            // The vehicle reboots. If the recording continues, its ground station connects again.
            if world.now() + AFTERWARDS >= end {
                break;
            }
            world.disconnect(port);
            port = world.connect(0);
        }
    }
    heard
}

/// The ground stations of a recording, as the simulated vehicle hears them.
struct RecordedStations {
    encoders: BTreeMap<(SystemId, ComponentId), Encoder>,
    /// The recorded vehicle's system id.
    recorded: SystemId,
}

impl RecordedStations {
    /// Encodes a message of the recording for the simulated vehicle.
    fn encode(&mut self, frame: &Frame, bytes: &mut Vec<u8>) {
        if let Some(outgoing) = readdressed(&frame.content, self.recorded) {
            let (system, component) = (frame.system, frame.component);
            self.encoders
                .entry((system, component))
                .or_insert_with(|| Encoder::new(system, component))
                .encode(&outgoing, bytes);
        }
    }
}

fn system_of(recording: &Recording) -> SystemId {
    let own = |timed: &&Timed| timed.frame.component == AUTOPILOT_COMPONENT;
    recording
        .heard
        .iter()
        .find(own)
        .map_or(SYSTEM, |timed| timed.frame.system)
}

/// The same message, addressed to the simulated vehicle if it was addressed to the recorded one;
/// other addresses were wrong on purpose and stay wrong. `None` for messages that the dialect
/// lacks.
fn readdressed(content: &Content, recorded: SystemId) -> Option<Outgoing> {
    match content {
        Content::Message(message) => {
            let mut message = message.clone();
            if let Some(target) = message
                .target_system_id_mut()
                .filter(|target| **target == recorded)
            {
                *target = SYSTEM;
            }
            Some(message.into())
        }
        Content::Undecoded { id, payload } => {
            let mut payload = payload[..LONGEST].to_vec();
            if matches!(id, 75 | 76) && payload[TARGET_OF_A_COMMAND] == recorded {
                payload[TARGET_OF_A_COMMAND] = SYSTEM;
            }
            Some(Outgoing::Raw { id: *id, payload })
        }
        Content::Unknown { .. } => None,
    }
}
