//! The recording of all links' frames, until a recorder fetches them.

use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::record::push_frame;

/// The maximum number of bytes that wait for the recorder; further frames are dropped and counted.
const MOST_WAITING: usize = 32 * 1024 * 1024;

/// Collects frames as tlog entries, ordered by time. All clones share one sink.
#[derive(Clone)]
pub struct FrameSink(Arc<SinkInner>);

struct SinkInner {
    /// Microseconds since 1970 (UTC).
    clock: Box<dyn Fn() -> u64 + Send + Sync>,
    waiting: Mutex<WaitingFrames>,
}

/// Frames that wait for the recorder.
#[derive(Debug, Default)]
pub struct WaitingFrames {
    /// Entries of a tlog.
    pub bytes: Vec<u8>,
    dropped: u64,
    /// Whether recording has ended.
    is_closed: bool,
}

impl fmt::Debug for FrameSink {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("FrameSink")
            .field(&self.waiting().bytes.len())
            .finish()
    }
}

impl FrameSink {
    /// A sink whose clock returns microseconds since 1970 (UTC).
    pub fn new(clock: impl Fn() -> u64 + Send + Sync + 'static) -> Self {
        Self(Arc::new(SinkInner {
            clock: Box::new(clock),
            waiting: Mutex::default(),
        }))
    }

    /// Records a frame, unless it contains a secret.
    pub fn note(&self, frame: &[u8]) {
        let mut waiting = self.waiting();
        if waiting.is_closed {
            return;
        }
        if waiting.bytes.len() > MOST_WAITING {
            waiting.dropped += 1;
            return;
        }
        // The clock is read under the lock, so that times never go back.
        let stamp = (self.0.clock)();
        push_frame(&mut waiting.bytes, stamp, frame);
    }

    /// The frames since the last call.
    pub fn take(&self) -> WaitingFrames {
        let mut waiting = self.waiting();
        let (dropped, is_closed) = (waiting.dropped, waiting.is_closed);
        let empty = WaitingFrames {
            bytes: Vec::new(),
            dropped,
            is_closed,
        };
        std::mem::replace(&mut *waiting, empty)
    }

    /// Frames dropped so far because the disk is too slow.
    pub fn dropped(&self) -> u64 {
        self.waiting().dropped
    }

    pub fn close(&self) {
        self.waiting().is_closed = true;
    }

    fn waiting(&self) -> MutexGuard<'_, WaitingFrames> {
        // A panic while recording loses only one frame.
        self.0
            .waiting
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use mavlink::dialects::ardupilotmega::{
        AUTH_KEY_DATA, CELLULAR_CONFIG_DATA, CHANGE_OPERATOR_CONTROL_DATA, HEARTBEAT_DATA,
        MavMessage, SETUP_SIGNING_DATA, WIFI_CONFIG_AP_DATA,
    };

    use super::*;
    use crate::link::TlogReader;
    use crate::wire::Encoder;

    fn frame(message: MavMessage) -> Vec<u8> {
        let mut bytes = Vec::new();
        Encoder::new(255, 190).encode(&message.into(), &mut bytes);
        bytes
    }

    #[test]
    fn frames_are_entries_of_a_tlog_and_keys_are_left_out() {
        let sink = FrameSink::new(|| 1_700_000_000_000_000);
        let beat = frame(MavMessage::HEARTBEAT(HEARTBEAT_DATA::default()));
        sink.note(&beat);
        for secret in [
            MavMessage::SETUP_SIGNING(SETUP_SIGNING_DATA::default()),
            MavMessage::WIFI_CONFIG_AP(WIFI_CONFIG_AP_DATA::default()),
            MavMessage::AUTH_KEY(AUTH_KEY_DATA::default()),
            MavMessage::CHANGE_OPERATOR_CONTROL(CHANGE_OPERATOR_CONTROL_DATA::default()),
            MavMessage::CELLULAR_CONFIG(CELLULAR_CONFIG_DATA::default()),
        ] {
            sink.clone().note(&frame(secret));
        }
        sink.note(&beat);
        let waiting = sink.take();
        let read: Result<Vec<_>, _> = TlogReader::new(&waiting.bytes[..]).collect();
        let read = read.expect("a sound tlog");
        assert_eq!(read.len(), 2);
        assert!(read.iter().all(|it| it.bytes == beat));
        assert_eq!(read[0].unix_us, 1_700_000_000_000_000);
        assert!(sink.take().bytes.is_empty());
    }
}
