//! MAVLink 2 signing on the console's side: keys and timestamps.
//!
//! A [`Keyring`] owns both. It checks the signature of a received frame, signs the frames to a
//! vehicle with the key that the vehicle has proved, and keeps a new key beside the old one until
//! the vehicle has proved the new one: at any time, one of the two keys fits. It has no clock and
//! no files; times are units of 10 microseconds since the beginning of 2015, as on the wire.

use std::collections::BTreeMap;
use std::fmt;

use mavlink::dialects::ardupilotmega::{MavMessage, SETUP_SIGNING_DATA};

use crate::wire::{
    ComponentId, Frame, MavAddress, Outgoing, Seal, SigningKey, Stamp, SystemId, is_signed_with,
};

mod file;
#[cfg(test)]
mod tests;

pub use file::KeyringFault;

/// One second in units of a timestamp.
pub const SECOND: u64 = 100_000;
/// The beginning of 2015 (UTC), from which timestamps count, in seconds since 1970.
pub const EPOCH_UNIX_S: u64 = 1_420_070_400;
/// How far the first frame of a stream may be behind the newest frame of its vehicle, as in the
/// MAVLink guide.
const MARGIN: u64 = 60 * SECOND;
/// How many timestamps are reserved in the file in advance, so that they never go back after a
/// crash.
const AHEAD: u64 = 60 * SECOND;
/// The smallest reserve, 100 000 timestamps, for a machine whose clock is behind the timestamps.
const LEAST_AHEAD: u64 = SECOND;

/// A secret key. `Debug` does not show it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct SecretKey(SigningKey);

impl SecretKey {
    /// A key from 32 random bytes.
    pub const fn new(bytes: SigningKey) -> Self {
        Self(bytes)
    }
}

impl fmt::Debug for SecretKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("SecretKey(..)")
    }
}

/// A change to the signing of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SigningChange {
    /// Give the vehicle a key.
    SetUp,
    /// Replace the vehicle's key.
    Rotate,
    /// Let the vehicle accept and send unsigned frames again.
    Remove,
}

/// The key to send to a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SentKey {
    /// The new key of a change that has not been proved yet.
    Next,
    /// The key that the vehicle had before a change.
    Current,
    /// No key: signing is switched off.
    Off,
}

impl SigningChange {
    /// The key to send for the change.
    pub fn forward(self) -> SentKey {
        match self {
            Self::SetUp | Self::Rotate => SentKey::Next,
            Self::Remove => SentKey::Off,
        }
    }

    /// The key to send to undo the change.
    pub fn back(self) -> SentKey {
        match self {
            Self::SetUp => SentKey::Off,
            Self::Rotate | Self::Remove => SentKey::Current,
        }
    }

    /// Whether a frame with this seal proves that its vehicle has carried out the change. A missing
    /// signature can be forged, so the keyring keeps a removed key.
    pub fn shows_in(self, seal: Seal) -> bool {
        match self {
            Self::SetUp | Self::Rotate => seal == Seal::RightWithNext,
            Self::Remove => seal == Seal::Unsigned,
        }
    }
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
enum KeyInUse {
    #[default]
    Nothing,
    Current,
    Next,
}

/// Identifies the frames of one component on one of its links, by the link id in their signatures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct SignedStream {
    component: ComponentId,
    link: u8,
}

/// The keys of one vehicle, and the last timestamp of each of its streams.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
struct VehicleKeys {
    /// The key that the vehicle has proved.
    current: Option<SecretKey>,
    /// The key that the vehicle may have received, but has not proved.
    next: Option<SecretKey>,
    uses: KeyInUse,
    heard: BTreeMap<SignedStream, u64>,
}

impl VehicleKeys {
    fn in_use(&self) -> Option<SecretKey> {
        match self.uses {
            KeyInUse::Nothing => None,
            KeyInUse::Current => self.current,
            KeyInUse::Next => self.next,
        }
    }

    fn verify(&self, bytes: &[u8]) -> Option<KeyInUse> {
        let fits =
            |key: &Option<SecretKey>| key.is_some_and(|SecretKey(key)| is_signed_with(&key, bytes));
        if fits(&self.current) {
            Some(KeyInUse::Current)
        } else {
            fits(&self.next).then_some(KeyInUse::Next)
        }
    }

    /// How far `timestamp` is below the lowest valid one of its stream; 0 if it is valid.
    fn behind(&self, stream: SignedStream, timestamp: u64) -> u64 {
        let least = if let Some(last) = self.heard.get(&stream) {
            last.saturating_add(1)
        } else {
            let newest = self.heard.values().max().copied().unwrap_or_default();
            newest.saturating_sub(MARGIN)
        };
        least.saturating_sub(timestamp)
    }

    /// Makes the new key the current one, if the vehicle has proved it.
    fn settle(&mut self) {
        if self.uses == KeyInUse::Next {
            self.current = self.next.take();
            self.uses = KeyInUse::Current;
        }
    }
}

/// The keys of vehicles, and the console's timestamps.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Keyring {
    /// The last timestamp sent, or a later one received from a vehicle.
    clock: u64,
    /// The last timestamp that may be sent before the keyring is written again.
    reserved: u64,
    /// Whether keys have changed since the keyring was last written.
    has_changed: bool,
    /// Whether a write has been requested since the keyring was last written.
    is_asked: bool,
    /// The keys of the vehicles, by the address of their link and by system id.
    links: BTreeMap<String, BTreeMap<SystemId, VehicleKeys>>,
}

impl Keyring {
    /// Checks a frame's signature. A valid signature proves which key the vehicle has; the
    /// timestamp then counts as used.
    pub fn check(&mut self, link: &str, frame: &Frame, bytes: &[u8]) -> Seal {
        let Some(stamp) = Stamp::of(bytes).filter(|_| frame.seal.is_signature()) else {
            return frame.seal;
        };
        let system = frame.system;
        let verify = |keys: Option<&VehicleKeys>| keys?.verify(bytes);
        let known = self.links.get(link).and_then(|all| all.get(&system));
        let Some(fits) = verify(known).or_else(|| self.adopt(link, system, bytes)) else {
            return Seal::Foreign;
        };
        let vehicles = self.links.entry(link.to_owned()).or_default();
        let keys = vehicles.entry(system).or_default();
        let stream = SignedStream {
            component: frame.component,
            link: stamp.link,
        };
        let behind = keys.behind(stream, stamp.timestamp);
        if behind > 0 {
            return Seal::Old(behind);
        }
        keys.heard.insert(stream, stamp.timestamp);
        self.clock = self.clock.max(stamp.timestamp);
        self.has_changed |= keys.uses != fits;
        keys.uses = fits;
        match fits {
            KeyInUse::Next => Seal::RightWithNext,
            KeyInUse::Current | KeyInUse::Nothing => Seal::Right,
        }
    }

    /// Takes over the key of the same vehicle from another link, if a frame was signed with it: a vehicle has one key
    /// for all its links.
    fn adopt(&mut self, link: &str, system: SystemId, bytes: &[u8]) -> Option<KeyInUse> {
        let others = self.links.iter().filter(|(other, _)| *other != link);
        let mut same = others.filter_map(|(_, vehicles)| vehicles.get(&system));
        let known = same.find(|keys| keys.verify(bytes).is_some())?.clone();
        let fits = known.verify(bytes);
        let vehicles = self.links.entry(link.to_owned()).or_default();
        vehicles.insert(system, known);
        self.has_changed = true;
        fits
    }

    /// The signatures for a message to these vehicles of a link, one for each key in use; none if
    /// it is sent unsigned. `stamp` holds the console's number for the link and this machine's
    /// time.
    pub fn seal(
        &mut self,
        link: &str,
        systems: impl IntoIterator<Item = SystemId>,
        stamp: Stamp,
    ) -> Vec<(SigningKey, Stamp)> {
        let Some(vehicles) = self.links.get(link) else {
            return Vec::new();
        };
        let mut keys: Vec<SigningKey> = Vec::new();
        for system in systems {
            let key = vehicles.get(&system).and_then(VehicleKeys::in_use);
            if let Some(SecretKey(key)) = key
                && !keys.contains(&key)
            {
                keys.push(key);
            }
        }
        let sealed = keys.into_iter().map(|key| {
            let timestamp = self.stamp(stamp.timestamp);
            (key, Stamp { timestamp, ..stamp })
        });
        sealed.collect()
    }

    /// The next timestamp. It never goes back, even if the clock of this machine does.
    fn stamp(&mut self, wall: u64) -> u64 {
        self.clock = wall.max(self.clock.saturating_add(1));
        self.clock
    }

    /// Prepares a change: the key to send is added to the keyring, which has to be written before
    /// the key is sent. `fresh` is a new random key; a key that was sent earlier and not proved is
    /// sent again instead.
    pub fn begin(&mut self, link: &str, system: SystemId, change: SigningChange, fresh: SecretKey) {
        let vehicles = self.links.entry(link.to_owned()).or_default();
        let keys = vehicles.entry(system).or_default();
        keys.settle();
        match change {
            SigningChange::SetUp | SigningChange::Rotate => {
                keys.next.get_or_insert(fresh);
            }
            SigningChange::Remove => {}
        }
        self.has_changed = true;
    }

    /// The message that gives a vehicle a key or removes its key; `None` if there is no such key.
    pub fn message(
        &mut self,
        link: &str,
        vehicle: MavAddress,
        which: SentKey,
        wall: u64,
    ) -> Option<Outgoing> {
        let keys = self.links.get(link)?.get(&vehicle.system)?;
        let (secret_key, initial_timestamp) = match which {
            SentKey::Off => ([0; 32], 0),
            SentKey::Next => (keys.next?.0, self.stamp(wall)),
            SentKey::Current => (keys.current?.0, self.stamp(wall)),
        };
        let message = MavMessage::SETUP_SIGNING(SETUP_SIGNING_DATA {
            initial_timestamp,
            target_system: vehicle.system,
            target_component: vehicle.component,
            secret_key,
        });
        Some(message.into())
    }

    /// Notes that a vehicle has proved a change: an old key is deleted. A removed key stays, in case the vehicle still
    /// has it.
    pub fn proved(&mut self, link: &str, system: SystemId, change: SigningChange) {
        let vehicles = self.links.get_mut(link);
        let Some(keys) = vehicles.and_then(|vehicles| vehicles.get_mut(&system)) else {
            return;
        };
        match change {
            SigningChange::SetUp | SigningChange::Rotate => keys.settle(),
            SigningChange::Remove => keys.uses = KeyInUse::Nothing,
        }
        self.has_changed = true;
    }

    /// The vehicles of a link whose frames should be signed.
    pub fn keyed(&self, link: &str) -> impl Iterator<Item = SystemId> {
        let vehicles = self.links.get(link).into_iter().flatten();
        let keyed = vehicles.filter(|(_, keys)| keys.in_use().is_some());
        keyed.map(|(&system, _)| system)
    }

    /// The number of keys in use: one for each link of each vehicle.
    pub fn count(&self) -> usize {
        let vehicles = self.links.values().flat_map(BTreeMap::values);
        vehicles.filter(|keys| keys.in_use().is_some()).count()
    }

    /// Whether the keyring should be written soon and no write has been requested since the last
    /// one. Returns `true` once; then `false` until the next write.
    pub fn take_due(&mut self) -> bool {
        self.is_due() && !std::mem::replace(&mut self.is_asked, true)
    }

    /// Whether the keyring has to be written before another frame is sent.
    pub fn is_spent(&self) -> bool {
        self.clock > self.reserved
    }

    /// Whether the keyring should be written soon.
    pub fn is_due(&self) -> bool {
        self.has_changed || self.clock.saturating_add(AHEAD / 2) > self.reserved
    }

    /// The last stamp that may be used once a file written now is in place.
    fn reserve(&self, wall: u64) -> u64 {
        let least = self.clock.saturating_add(LEAST_AHEAD);
        // Not before the last reserve, even if the clock of this machine was set back in the meantime.
        least.max(wall.saturating_add(AHEAD)).max(self.reserved)
    }
}
