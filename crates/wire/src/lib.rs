//! MAVLink framing: bytes to frames and back, with a count of everything that is dropped.
//!
//! The mavlink crate supplies the dialect (payload layouts and CRC seeds). Framing is done here because a console for
//! debugging links has to report what it dropped and why: the crate's reader silently skips bad CRCs, unknown message
//! ids and noise.
//!
//! # How the parts fit
//! - Reading: `decoder` finds frames, `checksum` and `signature` prove them, `loss` counts what never arrived, and `boot` tells that a sender has
//!   restarted.
//!   Writing: `encoder`.
//! - What the dialect lacks or hides: `beyond` (messages read by hand), `channels`, `board_id`. For display:
//!   `anatomy`.

#![warn(missing_docs)]

use mavlink::dialects::ardupilotmega::{
    AUTH_KEY_DATA, CELLULAR_CONFIG_DATA, CHANGE_OPERATOR_CONTROL_DATA, HEARTBEAT_DATA,
    MavAutopilot, MavMessage, MavModeFlag, MavState, MavType, SETUP_SIGNING_DATA,
    WIFI_CONFIG_AP_DATA,
};
use mavlink::{MavlinkVersion, Message as _, MessageData as _};

mod anatomy;
mod beyond;
mod board_id;
mod boot;
#[macro_use]
mod channels;
mod checksum;
mod decoder;
mod encoder;
mod loss;
mod signature;

pub use anatomy::{Anatomy, frame_len, without_payload};
pub use beyond::CONTROL_STATUS;
pub use board_id::BoardId;
pub use boot::{CLOCK_STEP_BACK_MS, boot_ms, is_clock_step_back};
pub use checksum::FtpChecksum;
pub use decoder::{Counters, Decoder, is_frame_start};
pub use encoder::{Encoder, Outgoing};
pub use loss::{LossMeter, SenderLoss, SequenceStep};
pub use signature::{Seal, SigningKey, Stamp, is_signed_with};

/// A MAVLink system id. 0 addresses all systems and is never a sender.
pub type SystemId = u8;
/// A MAVLink component id. 1 is the autopilot, 0 addresses every component.
pub type ComponentId = u8;

/// The receiver of a message: a component of a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MavAddress {
    /// The system; 0 for all.
    pub system: SystemId,
    /// The component; 0 for all.
    pub component: ComponentId,
}

/// The component id of an autopilot (`MAV_COMP_ID_AUTOPILOT1`).
pub const AUTOPILOT_COMPONENT: ComponentId = 1;
/// The system id that ground stations use by convention and ArduPilot's `SYSID_MYGCS` expects.
pub const GROUND_STATION_SYSTEM: SystemId = 255;
/// The component id of a ground station's mission planner (`MAV_COMP_ID_MISSIONPLANNER`).
pub const GROUND_STATION_COMPONENT: ComponentId = 190;

/// Messages with secrets: keys (`SETUP_SIGNING`, `AUTH_KEY`), passwords (`WIFI_CONFIG_AP`, `CHANGE_OPERATOR_CONTROL`),
/// PINs (`CELLULAR_CONFIG`).
const SECRET: [u32; 5] = [
    SETUP_SIGNING_DATA::ID,
    AUTH_KEY_DATA::ID,
    WIFI_CONFIG_AP_DATA::ID,
    CHANGE_OPERATOR_CONTROL_DATA::ID,
    CELLULAR_CONFIG_DATA::ID,
];

/// Whether messages with this id carry secrets, which must not be recorded.
pub fn is_secret(id: u32) -> bool {
    SECRET.contains(&id)
}

/// The heartbeat by which a vehicle recognises a ground station. ArduPilot sends only heartbeats until it has received
/// one.
pub fn ground_station_heartbeat() -> Outgoing {
    MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        custom_mode: 0,
        mavtype: MavType::MAV_TYPE_GCS,
        autopilot: MavAutopilot::MAV_AUTOPILOT_INVALID,
        base_mode: MavModeFlag::empty(),
        system_status: MavState::MAV_STATE_ACTIVE,
        mavlink_version: 3,
    })
    .into()
}

/// One frame: intact, unless its content is [`Content::Unknown`].
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// The sender's system id.
    pub system: SystemId,
    /// The sender's component id.
    pub component: ComponentId,
    /// The sender's sequence number.
    pub sequence: u8,
    /// MAVLink 1 or 2.
    pub version: MavlinkVersion,
    /// The frame's signature. The decoder has no keys, so it reports a signed frame as
    /// [`Seal::Foreign`].
    pub seal: Seal,
    /// Bytes on the wire, header, checksum and signature included.
    pub wire_len: u16,
    /// The payload, decoded as far as the dialect allows.
    pub content: Content,
}

/// The payload of a frame.
#[derive(Debug, Clone, PartialEq)]
#[expect(
    clippy::large_enum_variant,
    reason = "nearly every frame is a message; boxing it would cost an allocation per packet"
)]
pub enum Content {
    /// A message of the dialect.
    Message(MavMessage),
    /// A message of the dialect whose payload holds an enum value that the dialect lacks (a vehicle
    /// type or a command newer than this program), or [`CONTROL_STATUS`]. Its checksum was right, so
    /// single fields can be read from the payload.
    Undecoded {
        /// The message id in the header.
        id: u32,
        /// The payload in wire order, padded with zeros to the maximum length.
        payload: Box<[u8; 255]>,
    },
    /// A message id that the dialect lacks, so the checksum cannot be verified, or a message that
    /// cannot be parsed. The content is not reliable; only the sequence number is used.
    Unknown {
        /// The message id in the header.
        id: u32,
    },
}

impl Frame {
    /// Whether the checksum was right and the sender and the content are therefore reliable.
    pub fn is_verified(&self) -> bool {
        !matches!(self.content, Content::Unknown { .. })
    }
}

impl Content {
    /// The message id in the header.
    pub fn id(&self) -> u32 {
        match self {
            Self::Message(message) => message.message_id(),
            Self::Undecoded { id, .. } | Self::Unknown { id } => *id,
        }
    }
}
