//! STATUSTEXT messages.

use mavlink::dialects::ardupilotmega::{MavMessage, MavSeverity, STATUSTEXT_DATA};
use mavlink::types::CharArray;

/// Bytes of text in one message.
const CHUNK: usize = 50;

/// Appends a text; one that does not fit is sent in chunks with a common id.
pub(super) fn say(outbox: &mut Vec<MavMessage>, severity: MavSeverity, text: &str) {
    let chunks = text.as_bytes().chunks(CHUNK);
    let id = u16::from(chunks.len() > 1);
    for (sequence, chunk) in chunks.enumerate() {
        let mut bytes = [0; CHUNK];
        bytes[..chunk.len()].copy_from_slice(chunk);
        outbox.push(MavMessage::STATUSTEXT(STATUSTEXT_DATA {
            severity,
            text: CharArray::new(bytes),
            id,
            chunk_seq: sequence as u8,
        }));
    }
}
