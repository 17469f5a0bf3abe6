//! `MAVLink` 2 signing as the vehicle implements it.
//!
//! All serial ports share one key and the table against replays. Each has a clock that counts the
//! packets sent and follows later timestamps of other senders. Serial 0 is meant for a cable and
//! still accepts everything; the others silently drop packets without a valid signature.

use super::Serial;
use sortie_wire::{Frame, SigningKey, Stamp, is_signed_with};

/// One second in timestamps, which count tens of microseconds.
const SECOND: u64 = 100_000;
/// A new sender may be this far behind the vehicle's clock. After a boot the clock begins this far after the stored
/// timestamp, so that old packets cannot be replayed.
const MARGIN: u64 = 60 * SECOND;
/// The number of senders in the table against replays.
const STREAMS: usize = 16;
/// `RADIO_STATUS` and `RADIO` come from modems, which cannot sign.
const ALWAYS_ACCEPTED: [u32; 2] = [109, 166];

/// A sender on a link, and the timestamp that it last used.
#[derive(Debug, Clone)]
struct SignedStream {
    system: u8,
    component: u8,
    link: u8,
    timestamp: u64,
}

/// The signing of one vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct Signing {
    key: Option<SigningKey>,
    clocks: [u64; Serial::ALL.len()],
    streams: Vec<SignedStream>,
    /// Whether serial 0 also drops unsigned packets.
    strict: bool,
}

impl Signing {
    /// Drops unsigned packets on every port once a key is set.
    pub(super) fn be_strict(&mut self) {
        self.strict = true;
    }

    /// Switches signing on; a key and a timestamp of zero switch signing off.
    pub(super) fn load(&mut self, key: SigningKey, timestamp: u64) {
        let off = key == [0; 32] && timestamp == 0;
        self.key = (!off).then_some(key);
        self.clocks = [timestamp.saturating_add(MARGIN); Serial::ALL.len()];
    }

    /// Handles a reboot: the key and the time survive it, the known senders do not.
    pub(super) fn reboot(&mut self) {
        self.streams.clear();
        let stored = self.clocks.into_iter().max().unwrap_or_default();
        if let Some(key) = self.key {
            self.load(key, stored);
        }
    }

    /// The signature for a port's next packet, if signing is on.
    pub(super) fn seal(&mut self, serial: Serial) -> Option<(SigningKey, Stamp)> {
        let key = self.key?;
        let clock = self.clocks.get_mut(serial.index())?;
        let stamp = Stamp {
            link: serial.index() as u8,
            timestamp: *clock,
        };
        *clock = clock.wrapping_add(1);
        Some((key, stamp))
    }

    /// Whether a frame is accepted: it has a new, valid signature, arrives by USB without strict signing, or is of a
    /// kind that needs none. Without a key, every frame is accepted.
    pub(super) fn admits(&mut self, serial: Serial, frame: &Frame, bytes: &[u8]) -> bool {
        let Some(key) = self.key else {
            return true;
        };
        // The table records valid signatures, even if everything is accepted.
        let is_signed_rightly = frame.seal.is_signature()
            && is_signed_with(&key, bytes)
            && Stamp::of(bytes).is_some_and(|stamp| self.is_new(serial, frame, stamp));
        let is_cable = serial == Serial::Zero && !self.strict;
        is_signed_rightly || is_cable || ALWAYS_ACCEPTED.contains(&frame.content.id())
    }

    fn is_new(&mut self, serial: Serial, frame: &Frame, stamp: Stamp) -> bool {
        let clock = &mut self.clocks[serial.index()];
        let is_full = self.streams.len() >= STREAMS;
        let known = self.streams.iter_mut().find(|known| {
            (known.system, known.component, known.link)
                == (frame.system, frame.component, stamp.link)
        });
        if let Some(known) = known {
            if stamp.timestamp <= known.timestamp {
                return false;
            }
            known.timestamp = stamp.timestamp;
        } else {
            if is_full || stamp.timestamp + MARGIN < *clock {
                return false;
            }
            self.streams.push(SignedStream {
                system: frame.system,
                component: frame.component,
                link: stamp.link,
                timestamp: stamp.timestamp,
            });
        }
        *clock = stamp.timestamp.max(*clock);
        true
    }
}
